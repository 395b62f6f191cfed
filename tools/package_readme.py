"""README.md as package indexes show it, where links into the repository lead nowhere.

With `Source` among the project's URLs in pyproject.toml they lead there; until the project has an address, pictures are
left out and links are plain text.
"""

from __future__ import annotations

import re
import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
_IMAGE = re.compile(r'<img src="(?!\w+:)([^"]+)"([^>]*)>\n?')
_LINK = re.compile(r"\[([^\]]+)\]\((?!\w+:)([^)]+)\)")


def readme(source: str | None) -> str:
    """The text with links below the address of the repository, or without them."""
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    if source is None:
        return _LINK.sub(r"\1", _IMAGE.sub("", text))
    text = _IMAGE.sub(rf'<img src="{source}/raw/HEAD/\1"\2>\n', text)
    return _LINK.sub(rf"[\1]({source}/blob/HEAD/\2)", text)


def source() -> str | None:
    """The address of the repository, if pyproject.toml has one."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    found: str | None = project.get("urls", {}).get("Source")
    return found and found.rstrip("/")
