"""What world.step() costs besides the engine, and next to the other bindings.

The C++ loop and this project's worlds step in turn in this process, twenty steps at a time, a call for each: without
recording, with it, and without but in one call; all go through the same states. So do two loops stepped from Python by
the least code that can: they tell what a call costs. The other bindings cannot be in one process with them. Arguments
name some of the scenes.
"""

from __future__ import annotations

import statistics
import sys
import time
from collections.abc import Callable
from dataclasses import asdict
from functools import partial

from harness import DEBIAN, LOOP, OURS, PLAYERS, PYPI, Ratio, competitors, rounds, table
from loop import Loop, loop_player
from scenes import Scene, scenes

import pydart2

sys.path.append(str(PLAYERS))
from ours import Model

PIECE = 20  # steps
STEPS = {"cubes": 10_000, "chain": 20_000, "fullbody1": 2_000, "softBodies": 600, "Atlas": 2_000, "PR2": 4_000}


class Method:
    """A world with nothing but a step."""

    def __init__(self, step: Callable[[], None]) -> None:
        self._step = step

    def step(self) -> None:
        """One step."""
        self._step()


def seconds(step: Callable[[], None]) -> float:
    """CPU time of a piece."""
    begin = time.thread_time()
    for _ in range(PIECE):
        step()
    return time.thread_time() - begin


def seconds_at_once(world: pydart2.World) -> float:
    """CPU time of a piece in one call."""
    begin = time.thread_time()
    world.step(PIECE)
    return time.thread_time() - begin


def ours(scene: Scene, recording: bool) -> pydart2.World:
    """The scene after its first steps."""
    world = Model(asdict(scene)).world
    world.step(scene.warm)
    world.set_recording(recording)
    return world


def in_turn(scene: Scene) -> list[list[float]]:
    """Times of the pieces: the loop's, ours, with recording, the loop's by a function and by a method, ours at once."""
    loop, function, method = Loop(scene), Loop(scene), Loop(scene)
    off, on, at_once = ours(scene, False), ours(scene, True), ours(scene, False)
    steps = [off.step, on.step, function.bare_step(), Method(method.bare_step()).step]
    calls = [lambda: loop.steps(PIECE), *(partial(seconds, step) for step in steps), lambda: seconds_at_once(at_once)]
    times: list[list[float]] = [[] for _ in calls]
    for piece in range(STEPS[scene.name] // PIECE):
        for which in range(len(calls))[:: 1 if piece % 2 else -1]:
            times[which].append(calls[which]())
        positions = {world.skeletons[-1].q[0] for world in (off, on, at_once)}
        assert positions == {loop.position()} == {function.position()} == {method.position()}
    return times


def ratio(times: list[float], loop: list[float]) -> tuple[float, str]:
    """Over all steps, and in words with the quartiles of the pieces."""
    found = sum(times) / sum(loop)
    low, _, high = statistics.quantiles((a / b for a, b in zip(times, loop)), n=4)
    return found, f"{found:.3f} ({low:.2f} to {high:.2f})"


def compared(times: list[float], loop: list[float], bar: float) -> list[str]:
    """The ratio and whether it is below the bar."""
    found, words = ratio(times, loop)
    return [words, f"≤ {bar:g} {'met' if found <= bar else '**missed**'}"]


def main() -> None:
    """Ratios of times to that of the plain C++ loop."""
    others = competitors()
    del others[OURS]
    players = {LOOP: loop_player(), **others}
    rows: list[list[object]] = []
    for scene in scenes().values():
        if sys.argv[1:] and scene.name not in sys.argv[1:]:
            continue
        loop, off, on, function, method, at_once = in_turn(scene)
        step = f"{sum(loop) / STEPS[scene.name] * 1e6:.3g} µs"
        found = rounds(players, "step", scene)
        to_loop = [Ratio([r[name]["step"] / r[LOOP]["step"] for r in found]) for name in (DEBIAN, PYPI)]
        limits = [ratio(times, loop)[1] for times in (function, method, at_once)]
        rows.append([scene.name, step, *compared(off, loop, 1.03), *compared(on, loop, 1.1), *limits, *to_loop])
    print(
        "## A step\n\n"
        "Time of a step as a ratio to the plain C++ loop over Debian's engine: in the same process, in turn,\n"
        "over all steps (quartiles of the pieces); the other bindings in processes of their own, median (range).\n"
    )
    limits = ["function", "method", f"step({PIECE})"]
    heads = ["scene", LOOP, OURS, "bar", "recording", "bar", *limits, DEBIAN, PYPI + ", another engine"]
    print(table(heads, rows))
    print(
        "\nThe limits: the loop's own step in a C function that Python calls and that lets go of the interpreter's\n"
        f"lock, without any check; the same function in an empty Python method; `step({PIECE})`, one call of ours for\n"
        "so many steps."
    )


if __name__ == "__main__":
    main()
