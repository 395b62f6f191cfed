"""The engine that `make engine` builds with -O3 -DNDEBUG next to Debian's: steps per second, and the same states."""

from __future__ import annotations

import sys
from pathlib import Path

from harness import (
    BUILD,
    DEBIAN,
    OURS,
    PLAYERS,
    ROOT,
    PythonPlayer,
    Ratio,
    competitors,
    met,
    output,
    rounds,
    table,
    turns,
)
from scenes import scenes, standing_human

PREFIX = ROOT / "build" / "engine" / "prefix"
OPTIMISED = "optimised engine"


def package() -> Path:
    """This project built against the optimised engine."""
    folder = BUILD / "optimised"
    install = [sys.executable, "-m", "pip", "install", "--quiet", "--no-deps", "--no-build-isolation", "--upgrade"]
    output(*install, "--target", folder, ROOT, PYDART2_DART_PREFIX=str(PREFIX))
    return folder


def main() -> None:
    """Ratios of steps per second."""
    print("## The optimised engine\n")
    if not (PREFIX / ".version").exists():
        print("Not built: `make engine`, which takes a quarter of an hour or longer, then `make bench` again.")
        return
    path = {"PYTHONPATH": str(package())}
    players = {name: play for name, play in competitors().items() if name in (OURS, DEBIAN)}
    players[OPTIMISED] = PythonPlayer(sys.executable, "ours.py", path)
    rows: list[list[object]] = []
    for name in ("cubes", "chain", "fullbody1", "Atlas"):
        scene = scenes()[name]
        found = rounds(players, "step", scene)
        ratio = Ratio([r[OURS]["recording off"] / r[OPTIMISED]["recording off"] for r in found])
        states = [output(sys.executable, PLAYERS / "ours.py", "states", scene.dump(), **env) for env in ({}, path)]
        rows.append([name, ratio, met(ratio, 1.25, at_least=True), "yes" if states[0] == states[1] else "**no**"])
    print("Steps per second, with Debian's engine as 1; whether the states are bitwise equal after 1,000 steps.\n")
    print(table(["scene", OPTIMISED, "bar", "same states"], rows))
    found = turns(players, "control", standing_human())
    ratio = Ratio([r[DEBIAN]["stable PD"] / r[OPTIMISED]["stable PD"] for r in found])
    bar = met(ratio, 1.9, at_least=True)
    print(f"\nStable PD loop on fullbody1, steps per second to Debian's dartpy: {ratio}; {bar}.")


if __name__ == "__main__":
    main()
