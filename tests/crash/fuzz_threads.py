"""Threads make, share, change and drop worlds at once: a call works or raises what the documentation promises.

    python tests/crash/fuzz_threads.py 300 [FIRST]    for 300 seconds

Half of the calls are to worlds that all threads use, half to the thread's own. Every process of ten seconds has
another seed; the threads' turns are as they come, so a seed repeats the calls and not the run.
"""

from __future__ import annotations

import gc
import logging
import pickle
import random
import subprocess
import sys
import tempfile
import threading
import time
import traceback
import warnings
from collections import Counter
from collections.abc import Callable
from pathlib import Path
from typing import Any

if __name__ == "__main__":
    sys.path.insert(0, str(Path(__file__).parents[1]))

import numpy as np

import pydart2
from crash.fuzz_api import DOCUMENTED, ENVIRONMENT, VALUES, do, members, things_of

THREADS = 4
SECONDS_PER_PROCESS = 10.0
MODELS = ("cubes", "cubes", "cubes", "chain", "chain", "shapes", "fullbody1", "softBodies")
BOX = """<robot name="box">
  <link name="box">
    <inertial><mass value="1"/><inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/></inertial>
    <collision><geometry><box size="0.2 0.2 0.2"/></geometry></collision>
  </link>
</robot>
"""


class Hands:
    """One thread: its worlds, and what it keeps of worlds that may be gone."""

    def __init__(self, seed: int, shared: list[pydart2.World], batches: list[pydart2.Batch]) -> None:
        self.random = random.Random(seed)
        self.shared, self.own = shared, [self.new_world()]
        self.batches = batches
        self.kept: list[Any] = []
        self.calls: Counter[str] = Counter()
        self.troubles: list[str] = []

    def new_world(self) -> pydart2.World:
        return pydart2.World(0.001, f"skel/{self.random.choice(MODELS)}.skel")

    def replace(self, world: pydart2.World) -> None:
        """Another world takes the place of one of the own or shared worlds, which is dropped."""
        worlds = self.random.choice([self.own, self.shared])
        worlds[self.random.randrange(len(worlds))] = world

    def remove_skeleton(self, world: pydart2.World) -> None:
        self.keep(world)
        world.remove_skeleton(self.random.choice(world.skeletons))

    def resize(self, world: pydart2.World) -> None:
        """Shapes of equal sizes share their triangles, whichever thread's they are."""
        node = self.random.choice(self.random.choice(self.random.choice(world.skeletons).bodynodes).shapenodes)
        size = self.random.choice([0.1, 0.2, 0.3])
        if hasattr(node.shape, "set_size"):
            node.shape.set_size([size] * 3)
        elif hasattr(node.shape, "set_radius"):
            node.shape.set_radius(size)

    def keep(self, world: pydart2.World) -> None:
        """Handles that outlive their world are used later."""
        self.kept.append(self.random.choice(things_of(world)))
        del self.kept[:-5]

    def use_kept(self, world: pydart2.World) -> None:
        self.hostile_call(self.random.choice(self.kept or [world]))

    def hostile_call(self, thing: Any) -> None:
        kind, name = self.random.choice(members(thing))
        do(thing, kind, name, self.random.choices(VALUES, k=self.random.randrange(4)))

    def new_batch(self, world: pydart2.World) -> None:
        batch = pydart2.Batch(world, 3, threads=2)
        batch.step(3)
        self.batches[0] = batch

    def use_batch(self, _world: pydart2.World) -> None:
        """All threads use one batch."""
        batch = self.batches[0]
        deeds: list[Callable[[], Any]] = [
            lambda: batch.step(self.random.randrange(8)),
            lambda: batch.failed,
            lambda: batch.reset(),
            lambda: setattr(batch, "x", batch.x),
            lambda: batch.contacts,
            lambda: batch.rollout(None, np.ones((4, batch.skeleton.ndofs)), hold=2),
            lambda: batch.worlds[1].remove_skeleton(batch.worlds[1].skeletons[0]),
            lambda: batch.worlds[2].destroy(),
        ]
        self.random.choice(deeds)()

    def blow_up(self, world: pydart2.World) -> None:
        """A thread asks why worlds failed while they do."""
        batch = pydart2.Batch(world, 8, threads=2)
        batch.dq = np.full(batch.skeleton.ndofs, 1e20)
        done = threading.Event()

        def ask() -> None:
            while not done.is_set():
                _ = batch.failed

        asking = threading.Thread(target=ask)
        asking.start()
        try:
            batch.step(3)
        finally:
            done.set()
            asking.join()

    def snapshot(self, world: pydart2.World) -> None:
        snapshot = world.snapshot(exact=self.random.random() < 0.5)
        world.step(3)
        world.restore(snapshot)

    def deeds(self) -> dict[str, Callable[[pydart2.World], Any]]:
        draw = self.random.randrange
        return {
            "step": lambda world: world.step(draw(8)),
            "step again": lambda world: world.step(draw(8)),
            "check_collision": lambda world: world.check_collision(),
            "detector": lambda world: world.set_collision_detector(draw(4)),
            "solver": lambda world: world.set_constraint_solver(self.random.choice(["dart", "fast"])),
            "add": lambda world: world.add_skeleton(BOX, safe=False),
            "remove": self.remove_skeleton,
            "resize": self.resize,
            "weld": lambda world: self.random.choice(world.skeletons).set_root_joint_to_weld(),
            "keep": self.keep,
            "use kept": self.use_kept,
            "hostile call": lambda world: self.hostile_call(self.random.choice(things_of(world))),
            "snapshot": self.snapshot,
            "clone": lambda world: self.replace(world.clone()),
            "pickle": lambda world: self.replace(pickle.loads(pickle.dumps(world))),
            "new batch": self.new_batch,
            "blow up": self.blow_up,
            "use batch": self.use_batch,
            "use batch again": self.use_batch,
            "reset": lambda world: world.reset(),
            "new": lambda world: self.replace(self.new_world()),
            "destroy": lambda world: world.destroy() if draw(4) == 0 else None,
            "init": lambda world: pydart2.init(verbose=False) if draw(20) == 0 else None,
            "collect": lambda world: gc.collect() if draw(5) == 0 else None,
        }

    def work(self, end: float) -> None:
        deeds = self.deeds()
        destroyed = False
        while time.monotonic() < end:
            name = "new" if destroyed else self.random.choice(list(deeds))
            destroyed = False
            world = self.random.choice(self.random.choice([self.own, self.shared]))
            try:
                deeds[name](world)
                self.calls[name] += 1
            except DOCUMENTED as error:
                destroyed = isinstance(error, pydart2.DestroyedError)
                self.calls["refused"] += 1
            except Exception as error:
                where = " < ".join(f"{f.name}:{f.lineno}" for f in reversed(traceback.extract_tb(error.__traceback__)))
                self.troubles.append(f"{name}: {error!r:.300} in {where:.300}")


def work(seed: int) -> None:
    """Let the threads of this process at it; prints the number of calls of each kind, and troubles."""
    logging.disable(logging.CRITICAL)
    warnings.simplefilter("ignore")
    shared = [pydart2.World(0.001, f"skel/{name}.skel") for name in MODELS[:2]]
    batches = [pydart2.Batch(shared[0], 3, threads=2)]
    hands = [Hands(seed * THREADS + number, shared, batches) for number in range(THREADS)]
    end = time.monotonic() + SECONDS_PER_PROCESS
    threads = [threading.Thread(target=hand.work, args=(end,)) for hand in hands]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    healthy = pydart2.World(0.001, "skel/cubes.skel")
    healthy.step(2)
    assert healthy.frame == 2
    for hand in hands:
        for name, count in hand.calls.items():
            print(count, name)
        for trouble in hand.troubles:
            print("TROUBLE", trouble.replace("\n", " "))


def run(seconds: float, first: int) -> tuple[Counter[str], list[str]]:
    """How often each kind of call was accepted, or any refused, in processes of ten seconds; and what went wrong."""
    calls: Counter[str] = Counter()
    troubles: list[str] = []
    for seed in range(first, first + max(1, round(seconds / SECONDS_PER_PROCESS))):
        command = [sys.executable, "-X", "faulthandler", __file__, "--work", str(seed)]
        try:
            with tempfile.TemporaryDirectory() as folder:  # for the files that calls write
                done = subprocess.run(
                    command, capture_output=True, text=True, errors="replace", env=ENVIRONMENT, cwd=folder, timeout=120
                )
        except subprocess.TimeoutExpired:
            troubles.append(f"seed {seed}: it hangs")
            continue
        for line in done.stdout.splitlines():
            word, _, rest = line.partition(" ")
            if word == "TROUBLE":
                troubles.append(f"seed {seed}: {rest}")
            else:
                calls[rest] += int(word)
        if done.returncode != 0:
            reason, stacks = done.stderr[:1000], done.stderr[1000:][-3000:]
            troubles.append(f"seed {seed}, code {done.returncode}:\n{reason}\n...\n{stacks}")
    return calls, troubles


def main() -> None:
    """Run as long as asked for; exit code 1 if there was trouble."""
    calls, troubles = run(float(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 0)
    print(f"{calls.total()} calls of {THREADS} threads, {calls['refused']} refused, {len(troubles)} troubles")
    print(*troubles, sep="\n")
    sys.exit(bool(troubles))


if __name__ == "__main__":
    if sys.argv[1] == "--work":
        work(int(sys.argv[2]))
    else:
        main()
