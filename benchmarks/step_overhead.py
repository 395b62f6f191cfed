"""What world.step() costs besides the engine: 10,000 calls against a plain C++ loop over the same world.

Prints the ratio of the times (the lower, the better; 1 is nothing besides the engine), its median and its spread.
"""

from __future__ import annotations

import statistics
import time

import pydart2

STEPS = 10_000
ROUNDS = 7


def seconds(world: pydart2.World, start: object, in_python: bool) -> float:
    """Time of STEPS steps from a given state."""
    world.set_states(start)
    begin = time.perf_counter()
    if in_python:
        for _ in range(STEPS):
            world.step()
    else:
        world.step(STEPS)  # one loop in C++
    return time.perf_counter() - begin


def main() -> None:
    """Run both in turn, several times."""
    world = pydart2.World(0.001, pydart2.data_path("skel/cubes.skel"))
    world.step(2000)  # at rest, with contacts
    start = world.states()
    for recording in (False, True):
        world.set_recording(recording)
        ratios = []
        for _ in range(ROUNDS):
            loop = seconds(world, start, in_python=False)
            ratios.append(seconds(world, start, in_python=True) / loop)
        low, middle, high = min(ratios), statistics.median(ratios), max(ratios)
        state = "on" if recording else "off"
        print(f"cubes, recording {state}: step() / C++ loop = {middle:.3f} ({low:.3f} to {high:.3f})")


if __name__ == "__main__":
    main()
