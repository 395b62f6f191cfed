"""A PD and a stable PD loop on fullbody1, as a user would write them on each binding."""

from __future__ import annotations

from harness import DEBIAN, OURS, PYPI, Ratio, competitors, met, microseconds, table, turns
from scenes import standing_human


def main() -> None:
    """Steps per second as ratios to Debian's dartpy."""
    found = turns(competitors(), "control", standing_human())
    rows: list[list[object]] = []
    for name in found[0][OURS]:
        times = [microseconds([r[player][name] for r in found]) for player in (OURS, DEBIAN, PYPI)]
        ratio = Ratio([r[DEBIAN][name] / r[OURS][name] for r in found])
        rows.append([name, *times, ratio, met(ratio, 1.2, at_least=True) if name == "stable PD" else ""])
    print("## Control loops\n\nfullbody1, one step with its controller; the ratio is of steps per second.\n")
    print(table(["controller", OURS, DEBIAN, PYPI, "pydart2 / dartpy 6.12", "bar"], rows))


if __name__ == "__main__":
    main()
