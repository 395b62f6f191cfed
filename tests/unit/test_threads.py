"""One world belongs to one thread at a time; different worlds step in different threads."""

from __future__ import annotations

import subprocess
import sys
import threading
from collections.abc import Callable
from pathlib import Path

import pytest

import pydart2
from physics.models import arm, floor, make_world
from pydart2 import PydartError

IN_USE = "world 0 is in use by another thread; give each thread a world of its own"


def stepping(world: pydart2.World) -> tuple[threading.Thread, list[BaseException]]:
    """A thread that is inside a long step of the world."""
    errors: list[BaseException] = []

    def work() -> None:
        try:
            world.step(60_000)
        except BaseException as error:
            errors.append(error)

    thread = threading.Thread(target=work)
    thread.start()
    with pytest.raises(PydartError, match="in use by another thread"):
        while thread.is_alive():
            world.time()
    return thread, errors


USES: dict[str, Callable[[pydart2.World], object]] = {
    "step": lambda w: w.step(),
    "check_collision": lambda w: w.check_collision(),
    "reset": lambda w: w.reset(),
    "read the time": lambda w: w.t,
    "read q": lambda w: w.skeletons[0].q,
    "write q": lambda w: setattr(w.skeletons[0], "q", [0, 0]),
    "read a body": lambda w: w.skeletons[0].bodynodes[0].T,
    "snapshot": lambda w: w.snapshot(),
    "clone": lambda w: w.clone(),
    "add": lambda w: w.add_skeleton(pydart2.data_path("skel/ground.skel")),
    "remove": lambda w: w.remove_skeleton(w.skeletons[0]),
    "change the detector": lambda w: w.set_collision_detector(1),
    "destroy": lambda w: w.destroy(),
    "init": lambda w: pydart2.init(verbose=False),
}


def test_a_second_thread_is_refused(tmp_path: Path) -> None:
    pydart2.init(verbose=False)
    world = make_world(tmp_path, arm(), floor())
    thread, errors = stepping(world)
    refused = {}
    for name, use in USES.items():
        with pytest.raises(PydartError) as info:
            use(world)
        refused[name] = str(info.value)
    assert thread.is_alive(), "the steps were over too soon to tell"
    thread.join()
    assert set(refused.values()) == {IN_USE} and errors == [], (refused, errors)
    world.step()
    assert world.frame == 60_001


def test_many_threads_on_one_world(tmp_path: Path) -> None:
    """Each call works or is refused, and no step is lost or counted twice."""
    pydart2.init(verbose=False)
    world = make_world(tmp_path, arm())
    done, wrong = [0] * 4, []

    def work(index: int) -> None:
        for _ in range(400):
            try:
                world.step(3)
                done[index] += 3
            except PydartError as error:
                if str(error) != IN_USE:
                    wrong.append(error)

    threads = [threading.Thread(target=work, args=(i,)) for i in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert wrong == [] and world.frame == sum(done) > 0


@pytest.mark.parametrize("detector", (0, 1, 2, 3, 10))
def test_worlds_in_threads_end_as_alone(detector: int) -> None:
    """Bit for bit, with worlds made, cloned and freed at the same time."""

    def run(results: list[bytes]) -> None:
        world = pydart2.World(0.001, pydart2.data_path("skel/fullbody1.skel"))
        world.set_collision_detector(detector)
        world.set_recording(False)
        for _ in range(25):
            world.step(4)
            world = world.clone()
        results.append(world.states().tobytes())

    alone: list[bytes] = []
    run(alone)
    together: list[bytes] = []
    threads = [threading.Thread(target=run, args=(together,)) for _ in range(3)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert together == alone * 3


def test_making_and_destroying_worlds_in_threads() -> None:
    """Ids are given once, and init() in between ends some of them."""
    code = """
import threading, pydart2
ids, errors = [], []
def work():
    for i in range(60):
        try:
            world = pydart2.World(0.001, pydart2.data_path("skel/cubes.skel"))
            ids.append(world.id)
            world.step(2)
            if i % 3 == 0:
                world.destroy()
            if i == 30:
                pydart2.init(verbose=False)
        except pydart2.DestroyedError:
            pass
        except pydart2.PydartError as error:
            if "in use by another thread" not in str(error):
                errors.append(error)
threads = [threading.Thread(target=work) for _ in range(4)]
[t.start() for t in threads]
[t.join() for t in threads]
assert not errors, errors
"""
    done = subprocess.run(
        [sys.executable, "-X", "faulthandler", "-c", code], capture_output=True, text=True, timeout=300
    )
    assert done.returncode == 0, done.stderr[-3000:]
