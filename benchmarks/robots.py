"""Many robots in one world, and what copies cost: python benchmarks/robots.py.

Atlas, 3 m apart, falling without contact, steps of 1 ms. CPU time a robot.
"""

from __future__ import annotations

import ctypes
import subprocess
import sys
import time
from collections.abc import Callable
from functools import partial

from harness import ENVIRONMENT, PLAYERS, ROUNDS, Ratio, met, output, table

import pydart2

ATLAS = pydart2.data_path("sdf/atlas/atlas_v3_no_head.sdf")
COUNTS = (1, 16, 64, 256)
STEPS = 10
APART = 3.0  # m
BARS = {"native": {1: 15.0, 16: 15.0, 256: 20.0}, "fcl": {1: 15.0, 16: 15.0, 256: 30.0}}  # µs a robot and step
NO_LARGE_PAGES = 41  # PR_SET_THP_DISABLE, for a process and what it starts
SNAPSHOT_BAR, CLONE_BAR, COPIED = 0.1, 2.0, 64  # ms a robot


def robots(count: int, detector: str) -> pydart2.World:
    """In rows of 16."""
    world = pydart2.World(0.001)
    world.set_recording(False)
    for i in range(count):
        skel = world.add_skeleton(ATLAS)
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


def of_a_step(count: int, detector: str) -> Ratio:
    """µs of a robot and step."""
    world = robots(count, detector)
    return per_robot(world, partial(world.step, STEPS), max(1, 16 // count), STEPS * 1e-6)


def in_small_pages(count: int, detector: str) -> str:
    """The same, in a process that has no pages of 2 MB."""
    command = [sys.executable, __file__, str(count), detector]
    disable = partial(ctypes.CDLL(None).prctl, NO_LARGE_PAGES, 1, 0, 0, 0)
    done = subprocess.run(command, env=ENVIRONMENT, preexec_fn=disable, capture_output=True, text=True, check=True)
    return done.stdout.strip()


def in_two_orders(count: int) -> tuple[Ratio, Ratio]:
    """µs of a robot and step, in worlds with one each: many steps of each in turn, and one step of each in turn."""
    worlds = [robots(1, "native") for _ in range(count)]

    def one_by_one() -> None:
        for world in worlds:
            world.step(STEPS)

    def in_turn() -> None:
        for _ in range(STEPS):
            for world in worlds:
                world.step()

    hot, cold = (per_robot(worlds[0], call, 1, STEPS * count * 1e-6) for call in (one_by_one, in_turn))
    return hot, cold


def copy_by_engine() -> Ratio:
    """ms of the engine's own copy of the skeleton alone, by Debian's dartpy."""
    command = ["/usr/bin/python3", str(PLAYERS / "clone_player.py"), str(ATLAS), str(COPIED), str(ROUNDS)]
    return Ratio([float(line) for line in output(*command).split()])


def main() -> None:
    """Two tables."""
    print("## Many robots\n\nAtlas, 3 m apart, without contact: µs of CPU time a robot and step, median (range).\n")
    rows: list[list[object]] = []
    for count in COUNTS:
        row: list[object] = [count]
        for detector, bars in BARS.items():
            found = of_a_step(count, detector)
            row += [found, met(found, bars[count]) if count in bars else ""]
        rows.append(row)
    print(table(["robots", "native", "bar", "FCL", "bar"], rows))
    small = {detector: in_small_pages(COUNTS[-1], detector) for detector in BARS}
    print(f"\n{COUNTS[-1]} where no page has 2 MB: native {small['native']}, FCL {small['fcl']}.")
    hot, cold = in_two_orders(COUNTS[-1])
    print(
        f"\nThe wait for memory: in {COUNTS[-1]} worlds with a robot each, native, {STEPS} steps of each in turn take\n"
        f"{hot} µs a step, one step of each in turn {cold}. The work is the same, but no longer in the cache."
    )
    world = robots(COPIED, "fcl")
    world.step(3)
    rows = [
        [name, found, met(found, bar)]
        for name, bar, found in (
            ("snapshot", SNAPSHOT_BAR, per_robot(world, world.snapshot, 3, 1e-3)),
            ("clone", CLONE_BAR, per_robot(world, world.clone, 1, 1e-3)),
        )
    ]
    rows.append(["the engine's `cloneSkeleton()`, of a robot alone", copy_by_engine(), ""])
    print(f"\nA copy of {COPIED} of them, ms of CPU time a robot:\n")
    print(table(["copy", "ms", "bar"], rows))


if __name__ == "__main__":
    if len(sys.argv) > 1:
        print(of_a_step(int(sys.argv[1]), sys.argv[2]))
    else:
        main()
