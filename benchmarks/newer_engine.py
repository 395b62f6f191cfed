"""The fast constraint solver next to the newer engine in PyPI's dartpy: steps per second, and the contacts of each."""

from __future__ import annotations

import statistics
import sys

from engine import OPTIMISED, PREFIX, package
from harness import OURS, PYPI, Ratio, competitors, met, python_player, rounds, table
from scenes import atlas_with_meshes, scenes

BARS = {"cubes": 1.0, "chain": 1.0, "fullbody1": 1.0, "Atlas": 3.0, "Atlas with meshes": 3.0}


def main() -> None:
    """Ratios of steps per second, with PyPI's dartpy as 1."""
    print("## The fast constraint solver and the newer engine\n")
    players = {
        PYPI: competitors()[PYPI],
        OURS: python_player(sys.executable, "ours.py", PYDART2_SOLVER="fast"),
    }
    if (PREFIX / ".version").exists():
        path = str(package())
        players[OPTIMISED] = python_player(sys.executable, "ours.py", PYDART2_SOLVER="fast", PYTHONPATH=path)
    else:
        print("The optimised engine is not built (`make engine`).\n")
    rows: list[list[object]] = []
    for scene in [*scenes().values(), *atlas_with_meshes()]:
        if (bar := BARS.get(scene.name)) is None:
            continue
        found = rounds(players, "step", scene)

        def figures(player: str, figure: str, found: list = found) -> list[float]:
            return [r[player][figure] for r in found]

        row: list[object] = [scene.name]
        for player in list(players)[1:]:
            steps = zip(figures(PYPI, "step"), figures(player, "recording off"), strict=True)
            ratio = Ratio([theirs / ours for theirs, ours in steps])
            row += [ratio, met(ratio, bar, at_least=True)]
        row += [f"{statistics.median(figures(player, 'contacts')):g}" for player in (OURS, PYPI)]
        rows.append(row)
    print("Steps per second with the fast solver, with PyPI's dartpy as 1 (sleeping off; its states differ).\n")
    pairs = [cell for player in list(players)[1:] for cell in (player, "bar")]
    print(table(["scene", *pairs, "contacts", "contacts there"], rows))


if __name__ == "__main__":
    main()
