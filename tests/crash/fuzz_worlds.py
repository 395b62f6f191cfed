"""Builds, changes, asks, copies, saves and steps worlds as scripts do, with values that are mostly sensible.

    python tests/crash/fuzz_worlds.py 1000000 [FIRST]    a million calls, or what an hour takes
    python tests/crash/fuzz_worlds.py --again SEED       the calls of one process again, each printed before it is made

Where fuzz_api.py calls everything with anything, the calls here are mostly accepted and build on one another: bodies
and constraints are removed between steps, detectors, solvers and integrators change on the way, copies must go on bit
for bit.
"""

from __future__ import annotations

import contextlib
import faulthandler
import logging
import subprocess
import sys
import tempfile
import time
import traceback
import warnings
from collections import Counter
from collections.abc import Callable
from pathlib import Path

if __name__ == "__main__":
    sys.path.insert(0, str(Path(__file__).parents[1]))

import numpy as np

import pydart2
from crash import deeds_that_ask, deeds_that_change  # noqa: F401 (they fill DEEDS)
from crash.fuzz_api import DOCUMENTED, ENVIRONMENT
from crash.world_hands import DEEDS, Hands

CALLS_PER_WORLD = 120
WORLDS_PER_PROCESS = 25
STEPS_AMONG_DEEDS = 8
MOST_SECONDS = 20.0  # of the processor for one call
MOST_SECONDS_IN_ALL = 3600.0
MOST_CONTACTS = 200  # with an exact solver
HANGS_AFTER = 240.0  # s for all of a world


def play(seed: int, tell: Callable[[str], None]) -> tuple[Counter[str], list[str]]:
    """Do some calls on one world; how often each deed was accepted, or any refused, and what went wrong."""
    hands = Hands(seed)
    names = [*DEEDS, *["step"] * STEPS_AMONG_DEEDS]
    counts, troubles = Counter[str](), list[str]()
    for number in range(CALLS_PER_WORLD):
        name = hands.random.choice(names)
        tell(f"{number} {name}")
        start = time.process_time()
        try:
            DEEDS[name](hands)
            counts[name] += 1
        except DOCUMENTED as error:
            counts["refused"] += 1
            tell(f"    {error!r:.200}")
        except Exception as error:
            where = " < ".join(f"{f.name}:{f.lineno}" for f in reversed(traceback.extract_tb(error.__traceback__)))
            troubles.append(f"world {seed}, call {number}, {name}: {error!r:.400} in {where:.300}")
        if time.process_time() - start > MOST_SECONDS:
            troubles.append(
                f"world {seed}, call {number}, {name}: took {time.process_time() - start:.1f} s of the processor"
            )
        with contextlib.suppress(*DOCUMENTED):
            hands.world.frame  # noqa: B018 (raises if the world is gone)
            relieve(hands.world)
            continue
        hands.new_world()
    return counts, troubles


def relieve(world: pydart2.World) -> None:
    """Where an exact solver would take seconds a step, do as the world's warning says."""
    if len(world.collision_result.contacts) > MOST_CONTACTS:
        world.set_constraint_solver("iterative")


def work(seed: int, tell: Callable[[str], None]) -> None:
    """Some worlds in this process; prints counts and troubles."""
    logging.disable(logging.CRITICAL)
    warnings.simplefilter("ignore")
    np.seterr(all="ignore")
    for number in range(WORLDS_PER_PROCESS):
        faulthandler.dump_traceback_later(HANGS_AFTER, exit=True)
        counts, troubles = play(seed * WORLDS_PER_PROCESS + number, tell)
        print(*(f"{count} {name}" for name, count in counts.items()), sep="\n")
        print(*(f"TROUBLE {trouble}" for trouble in troubles), sep="\n", end="\n" * bool(troubles), flush=True)
    healthy = pydart2.World(0.001, "skel/cubes.skel")
    healthy.step(2)
    if not np.isfinite(healthy.x).all() or healthy.frame != 2:
        print("TROUBLE the next world does not step")


def run(calls: int, first: int) -> tuple[Counter[str], list[str]]:
    """So many calls, in other processes, or what an hour takes.

    How often each deed was accepted, or any refused, and troubles.
    """
    counts, troubles = Counter[str](), list[str]()
    seed, end = first, time.monotonic() + MOST_SECONDS_IN_ALL
    while counts.total() < calls and seed - first <= 2 * calls and time.monotonic() < end:
        command = [sys.executable, "-X", "faulthandler", __file__, "--work", str(seed)]
        with tempfile.TemporaryDirectory() as folder:  # for the files that calls write
            done = subprocess.run(
                command, capture_output=True, text=True, errors="replace", env=ENVIRONMENT, cwd=folder
            )
        for line in done.stdout.splitlines():
            word, _, rest = line.partition(" ")
            if word == "TROUBLE":
                troubles.append(f"seed {seed}: {rest.replace(chr(10), ' ')}")
            elif word.isdigit():
                counts[rest] += int(word)
        if done.returncode != 0:
            troubles.append(
                f"seed {seed}, code {done.returncode}:\n{done.stderr[:1500]}\n...\n{done.stderr[1500:][-1500:]}"
            )
        seed += 1
    return counts, troubles


def main() -> None:
    """Make as many calls as asked for; exit code 1 if there was trouble."""
    counts, troubles = run(int(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 0)
    print(f"{counts.total()} calls, {counts['refused']} refused, {len(troubles)} troubles", dict(counts))
    print(*troubles, sep="\n")
    sys.exit(bool(troubles))


if __name__ == "__main__":
    if sys.argv[1] == "--work":
        work(int(sys.argv[2]), lambda _: None)
    elif sys.argv[1] == "--again":
        work(int(sys.argv[2]), lambda text: print(text, flush=True))
    else:
        main()
