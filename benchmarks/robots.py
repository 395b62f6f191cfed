"""Many robots in one world, and what copies cost: python benchmarks/robots.py.

Atlas, 3 m apart, falling without contact, steps of 1 ms. CPU time a robot.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from functools import partial

from harness import ROUNDS, Ratio, met, table

import pydart2

COUNTS = (1, 16, 64, 256)
APART = 3.0  # m
BARS = {"native": {1: 15.0, 16: 15.0, 256: 20.0}, "fcl": {1: 15.0, 16: 15.0, 256: 30.0}}  # µs a robot and step
SNAPSHOT_BAR, CLONE_BAR, COPIED = 0.1, 2.0, 64  # ms a robot


def robots(count: int, detector: str) -> pydart2.World:
    """In rows of 16."""
    world = pydart2.World(0.001)
    world.set_recording(False)
    for i in range(count):
        skel = world.add_skeleton(pydart2.data_path("sdf/atlas/atlas_v3_no_head.sdf"))
        q = skel.q
        q[3:5] = APART * (i % 16), APART * (i // 16)
        skel.set_positions(q)
    world.set_collision_detector(detector)
    return world


def per_robot(world: pydart2.World, call: Callable[[], object], calls: int, unit: float) -> Ratio:
    """CPU time of a call in units, for each robot, over some rounds, without freeing what it makes."""
    call()
    times = []
    for _ in range(ROUNDS):
        begin = time.thread_time()
        made = [call() for _ in range(calls)]
        times.append((time.thread_time() - begin) / (calls * unit * len(world.skeletons)))
        del made
    return Ratio(times)


def main() -> None:
    """Two tables."""
    print("## Many robots\n\nAtlas, 3 m apart, without contact: µs of CPU time a robot and step, median (range).\n")
    rows: list[list[object]] = []
    for count in COUNTS:
        row: list[object] = [count]
        for detector, bars in BARS.items():
            world = robots(count, detector)
            found = per_robot(world, partial(world.step, 10), max(1, 16 // count), 10e-6)
            row += [found, met(found, bars[count]) if count in bars else ""]
        rows.append(row)
    print(table(["robots", "native", "bar", "FCL", "bar"], rows))
    world = robots(COPIED, "fcl")
    world.step(3)
    rows = [
        [name, found, met(found, bar)]
        for name, bar, found in (
            ("snapshot", SNAPSHOT_BAR, per_robot(world, world.snapshot, 3, 1e-3)),
            ("clone", CLONE_BAR, per_robot(world, world.clone, 1, 1e-3)),
        )
    ]
    print(f"\nA copy of {COPIED} of them, ms of CPU time a robot:\n")
    print(table(["copy", "ms", "bar"], rows))


if __name__ == "__main__":
    main()
