"""The notebooks of the documentation run, show what they are about, and are kept without what they printed."""

from __future__ import annotations

import ast
import json
from pathlib import Path
from typing import Any

import pytest

import pydart2

DOCS = Path(__file__).resolve().parents[2] / "docs"
NOTEBOOKS = sorted(path for path in DOCS.glob("*.ipynb"))


def cells(path: Path) -> list[dict[str, Any]]:
    found: list[dict[str, Any]] = json.loads(path.read_text(encoding="utf-8"))["cells"]
    return [cell for cell in found if cell["cell_type"] == "code"]


def run(source: str, names: dict[str, Any]) -> object:
    """What a cell ends with, as a notebook shows it."""
    tree = ast.parse(source)
    last = tree.body.pop() if isinstance(tree.body[-1], ast.Expr) else None
    exec(compile(tree, "cell", "exec"), names)
    return eval(compile(ast.Expression(last.value), "cell", "eval"), names) if isinstance(last, ast.Expr) else None


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.name)
def test_it_is_kept_without_outputs(path: Path) -> None:
    assert [(cell["outputs"], cell["execution_count"]) for cell in cells(path)] == [([], None)] * len(cells(path))


def test_first_steps(monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.chdir(tmp_path)
    names: dict[str, Any] = {}
    values = [run("".join(cell["source"]), names) for cell in cells(DOCS / "first-steps.ipynb")]
    shown = [value for value in values if value is not None]
    assert [type(value) for value in shown] == [
        *(pydart2.World, pydart2.Skeleton, pydart2.World),
        pydart2.SkelVector,
    ]
    first, skeleton, second, vector = shown
    assert isinstance(first, pydart2.World) and (picture := first._repr_png_()) is not None
    assert picture.startswith(b"\x89PNG") and second is first
    assert isinstance(skeleton, pydart2.Skeleton) and "<td>root_rot_x</td>" in skeleton._repr_html_()
    assert isinstance(vector, pydart2.SkelVector) and "<td>root_rot_x</td>" in (vector._repr_html_() or "")
    # The motors have held the arm at 1.2 rad, with the gravity compensated.
    assert names["robot"].q["l_arm_shx"] == pytest.approx(-1.2, abs=0.01)
    assert capsys.readouterr().out.endswith("the left shoulder is at -1.20 rad\n")
