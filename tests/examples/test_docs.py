"""Every block of Python in the documentation runs as printed, and prints what is below it."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

import pydart2

ROOT = Path(__file__).resolve().parents[2]
GENERATED = {"examples", "api", "generated", "_build"}
PAGES = [
    path for path in sorted((ROOT / "docs").rglob("*.md")) if path.relative_to(ROOT / "docs").parts[0] not in GENERATED
]
PAGES.append(ROOT / "README.md")
PROGRAMS = {"many-worlds.md"}  # its blocks are programs of their own: tests/unit/test_many_worlds.py
PAGES = [path for path in PAGES if "```python" in path.read_text(encoding="utf-8") and path.name not in PROGRAMS]
BLOCK = re.compile(r"^```(?P<kind>\w+)\n(?P<code>.*?)^```", re.DOTALL | re.MULTILINE)
MARK = "----8<----"


def script(page: Path) -> tuple[str, list[str]]:
    """The code of a page, on its own lines, and what each block is to print."""
    text = page.read_text(encoding="utf-8")
    lines = [""] * len(text.splitlines())
    expected: list[str] = []
    runs = False  # what other libraries print is theirs
    for match in BLOCK.finditer(text):
        start = text.count("\n", 0, match.start()) + 1
        if match["kind"] == "python":
            for i, line in enumerate(match["code"].splitlines()):
                lines[start + i] = line
            lines[start - 1] = f"print({MARK!r}, flush=True)"
            expected.append("")
        elif match["kind"] == "text" and runs:
            expected[-1] = match["code"]
        runs = match["kind"] == "python"
    return "\n".join(lines), expected


@pytest.mark.parametrize("page", PAGES, ids=lambda path: str(path.relative_to(ROOT)))
def test_page(page: Path, tmp_path: Path) -> None:
    code, expected = script(page)
    path = tmp_path / f"page_{page.stem}.py"  # mujoco.py would hide mujoco
    path.write_text(code, encoding="utf-8")
    # Windows open without a display and close by themselves.
    env = {**os.environ, "QT_QPA_PLATFORM": "offscreen", "PYDART2_VIEWER_SECONDS": "1", "MUJOCO_GL": "egl"}
    command = [sys.executable, "-W", "error", str(path)]
    done = subprocess.run(command, cwd=tmp_path, env=env, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr
    printed = [part.removeprefix("\n") for part in done.stdout.split(MARK)[1:]]
    assert printed == expected


def test_the_ten_first_scripts_have_as_many_lines_as_their_page_says() -> None:
    """And none of ours has more than twelve."""
    here, *others = (lines_of_scripts(name) for name in ("first-scripts", "migration/mujoco", "migration/pybullet"))
    text = (ROOT / "docs" / "first-scripts.md").read_text(encoding="utf-8")
    table = re.findall(r"^\| \[(.+?)\]\(.*?\) \| (\d+) \| (\d+) \| (\d+) \|$", text, re.MULTILINE)
    assert len(table) == 10
    assert table == [(name, *(str(page[name]) for page in (here, *others))) for name in here]
    assert max(here.values()) <= 12


def lines_of_scripts(page: str) -> dict[str, int]:
    """Heading → lines of the code below it that are neither empty nor comments."""
    text = (ROOT / "docs" / f"{page}.md").read_text(encoding="utf-8")
    found = re.findall(r"^##+ ([^\n]+)\n(?:(?!^#).)*?^```py(?:thon)?\n(.*?)^```", text, re.DOTALL | re.MULTILINE)
    counts = {name: sum(1 for x in code.splitlines() if x.strip() and x.lstrip()[0] != "#") for name, code in found}
    return {name: n for name, n in counts.items() if name not in ("The same script", "Ten first scripts")}


def test_no_page_is_left_out() -> None:
    names = {path.stem for path in PAGES}
    assert {"index", "install", "tutorial", "concepts", "controllers", "learning"} <= names


def migration_rows() -> list[list[str]]:
    """The names in backticks of each column."""
    text = "".join((ROOT / f"docs/migration/{name}.md").read_text(encoding="utf-8") for name in ("original", "dartpy"))
    rows = [line.strip("|").split("|") for line in text.splitlines() if line.startswith("|")]
    return [[re.findall(r"`([^`]+)`", cell) for cell in row] for row in rows]  # type: ignore[misc]


def test_names_here_exist() -> None:
    names = [re.split(r"[(\[ ]", name)[0] for row in migration_rows() for name in row[-1]]
    assert len(names) > 60
    assert [name for name in names if not exists(name)] == []


def exists(name: str) -> bool:
    """Whether pydart2 has it; what is an instance's own is among the annotations of its class."""
    owner: object = pydart2
    for part in name.split("."):
        if part in getattr(owner, "__annotations__", {}):
            return True
        if not hasattr(owner, part):
            return False
        owner = getattr(owner, part)
    return True


DARTPY = """
import sys
import dartpy

classes = {"world": dartpy.simulation.World, "skel": dartpy.dynamics.Skeleton, "body": dartpy.dynamics.BodyNode,
           "joint": dartpy.dynamics.Joint, "dof": dartpy.dynamics.DegreeOfFreedom, "contact": dartpy.collision.Contact}
for name in sys.stdin.read().split():
    first, *rest = name.split(".")
    owner = classes.get(first) or getattr(dartpy, first)
    for part in rest:
        owner = getattr(owner, part, None)
    if owner is None:
        print(name)
"""


def test_names_of_dartpy_exist() -> None:
    """In Debian's python3-dartpy."""
    names = [re.sub(r"\(.*?\)", "", name) for row in migration_rows() if len(row) == 2 for name in row[0]]
    assert len(names) > 50
    done = subprocess.run(
        ["/usr/bin/python3", "-c", DARTPY], input="\n".join(names), capture_output=True, text=True, timeout=60
    )
    assert done.returncode == 0, done.stderr
    assert done.stdout.split() == []
