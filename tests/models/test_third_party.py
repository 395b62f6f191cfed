"""Models that others made: none ends the process, and what the engine loads alone, we load with the same numbers.

DART's own (Debian's dart-doc) and PyPI's airo-models in each run; ``pybullet``'s by ``make test-third-party``.
"""

from __future__ import annotations

import importlib.util
from pathlib import Path
from typing import Any

import pytest

from models.third_party import differences, model_files, outcome, report
from oracle.models import dart_data

PYBULLET = Path(__file__).parents[2] / "build" / "third-party" / "pybullet_data"


def folder_of(name: str) -> Path:
    if name == "dart-doc":
        return dart_data()
    if name == "pybullet":
        assert PYBULLET.is_dir(), "run `make test-third-party`, which brings pybullet's models"
        return PYBULLET
    found = importlib.util.find_spec(name.replace("-", "_"))
    assert found and found.origin, f"{name} is not installed: pip install {name}"
    return Path(found.origin).parent


def chosen(files: list[Path]) -> list[Path]:
    """All, but of pybullet's thousand random bodies every fiftieth."""
    random = [path for path in files if "random_urdfs" in path.parts]
    return [path for path in files if path not in set(random)] + random[::50]


@pytest.mark.parametrize(
    ("name", "least"),
    [("dart-doc", 100), ("airo-models", 16), pytest.param("pybullet", 80, marks=pytest.mark.third_party)],
)
def test_models(name: str, least: int, capsys: Any) -> None:
    results = [outcome(path) for path in chosen(model_files(folder_of(name)))]
    with capsys.disabled():
        print("\n" + report(Path(name), results))
    assert [difference for result in results for difference in differences(result)] == []
    assert [str(result.path) for result in results if result.kind == "only the engine loads"] == []
    assert all(result.reason for result in results if result.ours is None)
    assert sum(result.kind == "both load" for result in results) >= least
