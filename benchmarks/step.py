"""What world.step() costs besides the engine, and next to the other bindings."""

from __future__ import annotations

from harness import DEBIAN, LOOP, OURS, PYPI, Ratio, competitors, loop_player, met, microseconds, rounds, table
from scenes import scenes


def main() -> None:
    """Ratios of times to that of the plain C++ loop."""
    players = {LOOP: loop_player(), **competitors()}
    rows: list[list[object]] = []
    for scene in scenes().values():
        found = rounds(players, "step", scene)

        def to_loop(player: str, figure: str, found: list = found) -> Ratio:
            return Ratio([r[player][figure] / r[LOOP]["step"] for r in found])

        off, on = to_loop(OURS, "recording off"), to_loop(OURS, "recording on")
        loop = microseconds([r[LOOP]["step"] for r in found])
        others = to_loop(DEBIAN, "step"), to_loop(PYPI, "step")
        rows.append([scene.name, loop, off, met(off, 1.03), on, met(on, 1.1), *others])
    print("## A step\n\nTime of a step as a ratio to the plain C++ loop over Debian's engine; median (range).\n")
    print(table(["scene", LOOP, OURS, "bar", "recording", "bar", DEBIAN, PYPI + ", another engine"], rows))
    print(
        "\nThe call from Python, with the interpreter's lock released meanwhile, takes 0.2 µs; that sets the limit on\n"
        "the chain, whose step is short. `world.step(n)` makes one call."
    )


if __name__ == "__main__":
    main()
