"""What world.step() costs besides the engine, and next to the other bindings.

The C++ loop and this project's worlds, without recording and with it, step in turn in this process, twenty steps at a
time; all go through the same states. The other bindings cannot be in one process with them. Arguments name some of the
scenes.
"""

from __future__ import annotations

import statistics
import sys
import time
from dataclasses import asdict

from harness import DEBIAN, LOOP, OURS, PLAYERS, PYPI, Ratio, competitors, rounds, table
from loop import Loop, loop_player
from scenes import Scene, scenes

import pydart2

sys.path.append(str(PLAYERS))
from ours import Model

PIECE = 20  # steps
STEPS = {"cubes": 10_000, "chain": 20_000, "fullbody1": 2_000, "softBodies": 600, "Atlas": 2_000, "PR2": 4_000}


def seconds(world: pydart2.World) -> float:
    """CPU time of a piece."""
    step = world.step
    begin = time.thread_time()
    for _ in range(PIECE):
        step()
    return time.thread_time() - begin


def ours(scene: Scene, recording: bool) -> pydart2.World:
    """The scene after its first steps."""
    world = Model(asdict(scene)).world
    world.step(scene.warm)
    world.set_recording(recording)
    return world


def in_turn(scene: Scene) -> list[list[float]]:
    """Times of the pieces: the loop's, ours, ours with recording."""
    loop, off, on = Loop(scene), ours(scene, False), ours(scene, True)
    calls = [lambda: loop.steps(PIECE), lambda: seconds(off), lambda: seconds(on)]
    times: list[list[float]] = [[], [], []]
    for piece in range(STEPS[scene.name] // PIECE):
        for which in range(3)[:: 1 if piece % 2 else -1]:
            times[which].append(calls[which]())
        assert loop.position() == off.skeletons[-1].q[0] == on.skeletons[-1].q[0]
    return times


def ratio(times: list[float], loop: list[float], bar: float) -> list[str]:
    """Over all steps, with the quartiles of the pieces; and the bar."""
    found = sum(times) / sum(loop)
    low, _, high = statistics.quantiles((a / b for a, b in zip(times, loop)), n=4)
    return [f"{found:.3f} ({low:.2f} to {high:.2f})", f"≤ {bar:g} {'met' if found <= bar else '**missed**'}"]


def main() -> None:
    """Ratios of times to that of the plain C++ loop."""
    others = competitors()
    del others[OURS]
    players = {LOOP: loop_player(), **others}
    rows: list[list[object]] = []
    for scene in scenes().values():
        if sys.argv[1:] and scene.name not in sys.argv[1:]:
            continue
        loop, off, on = in_turn(scene)
        step = f"{sum(loop) / STEPS[scene.name] * 1e6:.3g} µs"
        found = rounds(players, "step", scene)
        to_loop = [Ratio([r[name]["step"] / r[LOOP]["step"] for r in found]) for name in (DEBIAN, PYPI)]
        rows.append([scene.name, step, *ratio(off, loop, 1.03), *ratio(on, loop, 1.1), *to_loop])
    print(
        "## A step\n\n"
        "Time of a step as a ratio to the plain C++ loop over Debian's engine: in the same process, in turn,\n"
        "over all steps (quartiles of the pieces); the other bindings in processes of their own, median (range).\n"
    )
    print(table(["scene", LOOP, OURS, "bar", "recording", "bar", DEBIAN, PYPI + ", another engine"], rows))
    print(
        "\nThe call from Python, with the interpreter's lock released meanwhile, takes 0.2 µs; that sets the limit on\n"
        "the chain, whose step is short. `world.step(n)` makes one call."
    )


if __name__ == "__main__":
    main()
