"""Draws docs/images/house.svg, the rooms of the code and who includes whom: python tools/draw_house.py.

A box is a room with the number of its files, a line goes from a room down to one that it includes or imports, the
thicker the oftener. That nothing runs back is kept by tests/unit/test_architecture.py.
"""

from __future__ import annotations

import ast
import re
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).parents[1]
PICTURE = ROOT / "docs" / "images" / "house.svg"
WIDTH, HEIGHT, STEP = 150, 44, 92

#: Where each room stands: column, floor.
PLACES = {
    "cli": (0.6, 0), "gui": (1.8, 0), "flat": (3.0, 0),
    "mjcf": (0.0, 1), "exporting": (1.0, 1), "building": (2.0, 1), "muscle": (3.0, 1), "utils": (4.0, 1),
    "simulation": (0.6, 2), "multibody": (1.8, 2), "loading (Python)": (3.4, 2),
    "pydart2": (1.8, 3),
    "swig": (1.6, 4), "python": (3.2, 4),
    "handles": (1.6, 5), "state": (1.6, 6), "contact": (1.0, 7), "loading": (2.8, 8), "dynamics": (0.4, 8),
    "collision": (1.6, 9), "engine": (1.6, 10), "base": (1.6, 11),
}  # fmt: skip

PYTHON_ROOMS = ("building", "cli", "exporting", "flat", "gui", "mjcf", "multibody", "muscle", "simulation", "utils")


def python_arrows() -> Iterator[tuple[str, str]]:
    """Room of the importing module, room of the imported one; what only type checkers import is left out."""
    for path in python_files():
        room = python_room(path.relative_to(ROOT / "pydart2").parts)
        for node in run_time_nodes(ast.parse(path.read_text())):
            if isinstance(node, ast.ImportFrom) and node.module and node.module.split(".")[0] == "pydart2":
                target = python_room((*node.module.split(".")[1:], ""))
                yield room, "swig" if node.module.endswith("pydart2_api") else target


def python_files() -> list[Path]:
    return [path for path in (ROOT / "pydart2").rglob("*.py") if path.name != "pydart2_api.py"]


def python_room(parts: tuple[str, ...]) -> str:
    name = parts[0] if len(parts) > 1 else "pydart2"
    return "loading (Python)" if name == "loading" else name if name in PYTHON_ROOMS else "pydart2"


def run_time_nodes(node: ast.AST) -> Iterator[ast.AST]:
    for child in ast.iter_child_nodes(node):
        if not (isinstance(child, ast.If) and "TYPE_CHECKING" in ast.unparse(child.test)):
            yield child
            yield from run_time_nodes(child)


def cpp_arrows() -> Iterator[tuple[str, str]]:
    """As python_arrows(), of src/cpp and swig."""
    for path in cpp_files():
        for target in re.findall(r'#include "(\w+)/', path.read_text()):
            yield cpp_room(path), target


def cpp_files() -> list[Path]:
    return [*(ROOT / "src" / "cpp").rglob("*.?pp"), *(path for path in (ROOT / "swig").glob("*") if path.is_file())]


def cpp_room(path: Path) -> str:
    return path.parent.name


def drawing() -> str:
    """The picture as SVG."""
    files = Counter(python_room(path.relative_to(ROOT / "pydart2").parts) for path in python_files())
    files.update(cpp_room(path) for path in cpp_files())
    arrows = Counter([*python_arrows(), *cpp_arrows()])
    curves = [
        curve(room, target, count)
        for (room, target), count in sorted(arrows.items())
        if room != target and target in PLACES
    ]
    boxes = []
    for room in PLACES:
        x, y = corner(room)
        boxes.append(
            f'<rect x="{x:.0f}" y="{y:.0f}" width="{WIDTH}" height="{HEIGHT}" rx="5" fill="#f4f6f8" stroke="#445"/>'
            f'<text x="{x + WIDTH / 2:.0f}" y="{y + 19:.0f}" font-weight="bold" font-size="14">{room}</text>'
            f'<text x="{x + WIDTH / 2:.0f}" y="{y + 35:.0f}">{files[room]} files</text>'
        )
    head = (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 825 {12 * STEP}" font-family="sans-serif" '
        'font-size="12" text-anchor="middle" fill="#223">\n'
    )
    return head + "\n".join([*curves, *boxes]) + "\n</svg>\n"


def curve(room: str, target: str, count: int) -> str:
    """An arrow; one that passes floors swings out to the left, one to a room beside goes straight."""
    (x1, y1), (x2, y2) = middle(room), middle(target)
    down = PLACES[target][1] - PLACES[room][1]
    if down > 0:
        y1, y2 = y1 + HEIGHT / 2, y2 - HEIGHT / 2
    x, y = (x1 + x2) / 2 - 60 * (down - 1), (y1 + y2) / 2
    return (
        f'<path d="M {x1:.0f} {y1:.0f} Q {x:.0f} {y:.0f} {x2:.0f} {y2:.0f}" fill="none" stroke="#89a" '
        f'stroke-width="{0.6 + count**0.5 / 4:.1f}"/>'
    )


def corner(room: str) -> tuple[float, float]:
    column, floor = PLACES[room]
    return 10 + 165 * column, 10 + STEP * floor


def middle(room: str) -> tuple[float, float]:
    x, y = corner(room)
    return x + WIDTH / 2, y + HEIGHT / 2


if __name__ == "__main__":
    PICTURE.write_text(drawing())
    print(PICTURE)
