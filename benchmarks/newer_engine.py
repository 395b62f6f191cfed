"""The fast constraint solver next to the newer engine in PyPI's dartpy: steps per second, and the contacts of each."""

from __future__ import annotations

import statistics
import sys

from engine import OPTIMISED, PREFIX, package
from harness import OURS, PYPI, Player, PythonPlayer, Ratio, competitors, met, rounds, table
from loop import parts_player
from scenes import atlas_with_meshes, scenes

BARS = {
    "cubes": 1.3,
    "chain": 1.5,
    "fullbody1": 1.5,
    "softBodies": 1.0,
    "Atlas": 3.0,
    "PR2": 1.5,
    "Atlas with meshes": 3.0,
}


NATIVE = "native detector"


def main() -> None:
    """Ratios of steps per second, with PyPI's dartpy as 1."""
    print("## The fast constraint solver and the newer engine\n")
    fast = {"PYDART2_SOLVER": "fast"}
    players: dict[str, Player] = {
        PYPI: competitors()[PYPI],
        OURS: PythonPlayer(sys.executable, "ours.py", fast),
        NATIVE: PythonPlayer(sys.executable, "ours.py", {**fast, "BENCH_DETECTOR": "native"}),
        "engine": parts_player(),
    }
    shown = {OURS: "recording off", NATIVE: "recording off"}
    limits = {"only contacts and LCP": ("engine", "contacts and LCP")}
    if (PREFIX / ".version").exists():
        players[OPTIMISED] = PythonPlayer(sys.executable, "ours.py", {**fast, "PYTHONPATH": str(package())})
        players["parts"] = parts_player(PREFIX)
        shown[OPTIMISED] = "recording off"
        limits |= {"of the solver only our LCP": ("parts", "only LCP"), "without the solver": ("parts", "no solver")}
    else:
        print("The optimised engine is not built (`make engine`).\n")
    rows: list[list[object]] = []
    for scene in [*scenes().values(), *atlas_with_meshes()]:
        if (bar := BARS.get(scene.name)) is None:
            continue
        found = rounds(players, "step", scene)

        def ratio(player: str, figure: str, found: list = found) -> Ratio:
            return Ratio([r[PYPI]["step"] / r[player][figure] for r in found])

        row: list[object] = [scene.name]
        for player, figure in shown.items():
            row += [ratio(player, figure), met(ratio(player, figure), bar, at_least=True)]
        row += [statistics.median(r[player]["contacts"] for r in found) for player in (OURS, PYPI)]
        row += [f"{ratio(*limit).median:.3g}" for limit in limits.values()]
        rows.append(row)
    print("Steps per second with the fast solver, with PyPI's dartpy as 1 (sleeping off; its states differ).\n")
    pairs = [cell for player in shown for cell in (player, "bar")]
    print(table(["scene", *pairs, "contacts", "contacts there", *limits], rows))
    print(
        "\nThe native detector finds other contacts: the difference is what the bits of the engine's cost.\n"
        "The last columns set limits: what would be reached if only the engine's search for contacts and our LCP\n"
        "cost time, without which the states do not have its bits."
    )
    if OPTIMISED in shown:
        print(
            "Then what the optimised engine's own C++ loop would reach if of its constraint solver only our LCP cost\n"
            "time, and if that cost nothing either."
        )


if __name__ == "__main__":
    main()
