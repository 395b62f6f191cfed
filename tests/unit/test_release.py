"""What has to agree when the package is released."""

from __future__ import annotations

import re
import sys
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture
def readme(monkeypatch: pytest.MonkeyPatch) -> object:
    monkeypatch.syspath_prepend(ROOT / "tools")
    import package_readme  # type: ignore[import-not-found]

    yield package_readme
    sys.modules.pop("package_readme")


def targets(text: str) -> list[str]:
    """Where links and pictures lead."""
    return re.findall(r"\]\(([^)]+)\)", text) + re.findall(r'src="([^"]+)"', text)


def test_links_of_the_readme_work_outside_the_repository(readme: object) -> None:
    here = targets((ROOT / "README.md").read_text(encoding="utf-8"))
    assert any(not target.startswith("http") for target in here)
    base = "https://example.org/us/pydart2"
    whole = readme.readme(base)  # type: ignore[attr-defined]
    assert f'<img src="{base}/raw/HEAD/docs/images/atlas.png" width="480" alt="Atlas stands' in whole
    assert f"]({base}/blob/HEAD/docs/howto/many-worlds.md)" in whole
    assert len(targets(whole)) == len(here)
    for text in (whole, readme.readme(None), readme.readme(readme.source())):  # type: ignore[attr-defined]
        assert all(target.startswith("http") for target in targets(text))
        assert "```python" in text and "make demo" in text


def test_versions_agree() -> None:
    version = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["version"]
    assert f"\nversion: {version}\n" in (ROOT / "CITATION.cff").read_text()
    final = re.sub(r"(\.0)?(a|b|rc)\d+$|\.0$", "", version)
    newest = re.search(r"^## (.+)$", (ROOT / "docs/changelog.md").read_text(), re.MULTILINE)
    assert newest is not None and newest[1] == final
