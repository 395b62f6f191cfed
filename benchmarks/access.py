"""What reading and writing costs next to the other bindings, fullbody1 with 37 dofs."""

from __future__ import annotations

from statistics import median

from harness import DEBIAN, OURS, PYPI, Ratio, competitors, met, microseconds, table, turns
from scenes import scenes


def bar(name: str) -> float:
    """What the time may be of the better of the others."""
    if name.endswith("after q ="):
        return 0.2 if name.startswith("M") else 1.0
    return 0.65 if name == "C" else 0.5


def main() -> None:
    """Ratios of times to the better of the others."""
    found = turns(competitors(), "access", scenes()["fullbody1"])
    rows: list[list[object]] = []
    for name in found[0][OURS]:
        better = min((DEBIAN, PYPI), key=lambda other, name=name: median(r[other][name] for r in found))
        ratio = Ratio([r[OURS][name] / r[better][name] for r in found])
        times = [microseconds([r[player][name] for r in found]) for player in (OURS, DEBIAN, PYPI)]
        rows.append([f"`{name}`", *times, ratio, met(ratio, bar(name))])
    print("## Reading and writing\n\nfullbody1, 37 dofs; the last column compares with the better of the others.\n")
    print(table(["call", OURS, DEBIAN, PYPI, "ratio", "bar"], rows))
    print(
        "\n`contacts` are points and forces as one array (`collision_result.rows`), `contact_objects` two arrays for\n"
        "each contact. On Python 3.11 a short name takes some 15 ns more to look up than in a class that does not\n"
        "answer wrong names (`pydart2.assignment`), and a method 80 ns."
    )


if __name__ == "__main__":
    main()
