"""Ctrl-C ends long calls between two steps, and the state says how far they came."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import pytest

import pydart2


@pytest.fixture(autouse=True)
def _handle_interrupts() -> Iterator[None]:
    """A shell starts what runs behind its back with interrupts ignored, and then no test would end."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


def interrupted(call: Callable[[], object], after: float = 0.3) -> float:
    """How long the call goes on after the signal, s."""
    sent = []

    def send() -> None:
        sent.append(time.monotonic())
        os.kill(os.getpid(), signal.SIGINT)

    timer = threading.Timer(after, send)
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        call()
    timer.join()
    return time.monotonic() - sent[0]


def test_many_steps() -> None:
    world = pydart2.World(0.001, "skel/fullbody1.skel")
    world.disable_recording()
    assert interrupted(lambda: world.step(1_000_000)) < 0.2
    frame = world.frame
    assert 0 < frame < 1_000_000
    other = pydart2.World(0.001, "skel/fullbody1.skel")
    other.step(frame)
    np.testing.assert_array_equal(world.x, other.x)
    world.step(2)
    assert world.frame == frame + 2


@pytest.mark.parametrize("threads", [1, 2])
def test_a_batch(threads: int) -> None:
    batch = pydart2.Batch(pydart2.World(0.001, "skel/chain.skel"), 4, threads=threads)
    assert interrupted(lambda: batch.step(10_000_000)) < 0.2
    assert batch.failed == {}
    assert min(world.frame for world in batch.worlds) < 10_000_000
    actions = np.zeros((100, batch.skeleton.ndofs))
    assert interrupted(lambda: batch.rollout(None, actions, hold=100_000)) < 0.2
    batch.reset()
    batch.step(2)
    assert [world.frame for world in batch.worlds] == [2] * 4


def test_a_handler_of_the_users_runs_in_the_middle_of_a_call() -> None:
    world = pydart2.World(0.001, "skel/chain.skel")
    world.disable_recording()
    ran = []
    before = signal.signal(signal.SIGUSR1, lambda *_: ran.append(time.monotonic()))
    try:
        timer = threading.Timer(0.1, os.kill, (os.getpid(), signal.SIGUSR1))
        timer.start()
        world.step(600_000)
        end = time.monotonic()
    finally:
        timer.join()
        signal.signal(signal.SIGUSR1, before)
    assert len(ran) == 1
    assert ran[0] < end
    assert world.frame == 600_000


def test_a_pipe_is_no_model(tmp_path: Path) -> None:
    """Nobody may ever write to it."""
    pipe = tmp_path / "robot.urdf"
    os.mkfifo(pipe)
    for load in (lambda: pydart2.World(0.001, str(pipe)), lambda: pydart2.World(0.001).add_skeleton(str(pipe))):
        with pytest.raises(pydart2.LoadError, match="pipe or a device"):
            load()


LOAD = """
import sys, time
from pathlib import Path
import pydart2
from pydart2.loading import trial
from unit.test_loading_time import long_chain, long_chain_world

folder = Path(sys.argv[1])
world = pydart2.World(0.001, "skel/cubes.skel")
before = world.num_skeletons()
{prepare}
print("begins", flush=True)
try:
    {load}
except KeyboardInterrupt:
    print(time.monotonic(), flush=True)
    assert world.num_skeletons() == before
    world.add_skeleton(long_chain(3).replace("chain", "next", 1), safe=False)
    world.step(2)
    sys.exit(7)
"""
MESH = """<robot name="m"><link name="l"><inertial><mass value="1"/>
<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
<visual><geometry><mesh filename="big.obj"/></geometry></visual></link></robot>"""
WRITE_MESH = f"""
model = folder / "big.urdf"
model.write_text({MESH!r})
faces = "".join(f"v {{i}} 0 0\\nv {{i}} 1 0\\nv {{i}} 0 {{i % 7 + 1}}\\nf -1 -2 -3\\n" for i in range(500_000))
(folder / "big.obj").write_text(faces)
"""
LOADS = {
    "a trial that waits": ("trial.HELPER = folder / 'idle'; model = long_chain(3)", "world.add_skeleton(model)"),
    "a trial": ("model = long_chain(5000)", "world.add_skeleton(model, load_seconds=99)"),
    "a skeleton": ("model = long_chain(5000)", "world.add_skeleton(model, safe=False, load_seconds=99)"),
    "a world": (
        "model = long_chain_world(4000, 'ode')",
        "pydart2.World(0.001, model, safe=False, load_seconds=99)",
    ),
    "a mesh": (WRITE_MESH, "world.add_skeleton(model, safe=False, load_seconds=99)"),
}


@pytest.mark.parametrize("what", LOADS)
@pytest.mark.parametrize("after", [0.3, 0.8])
def test_loading(what: str, after: float, tmp_path: Path) -> None:
    """The world is as it was before."""
    idle = tmp_path / "idle"
    idle.write_text("#!/bin/sh\nexec 3<&0\n(sleep 99) <&3 &\n")
    idle.chmod(0o755)
    prepare, load = LOADS[what]
    command = [sys.executable, "-c", LOAD.format(prepare=prepare, load=load), str(tmp_path)]
    environment = os.environ | {"PYTHONPATH": os.pathsep.join([str(Path(__file__).parents[1]), *sys.path])}
    child = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=environment)
    assert child.stdout is not None and child.stdout.readline() == "begins\n"
    time.sleep(after)
    sent = time.monotonic()
    child.send_signal(signal.SIGINT)
    out, err = child.communicate(timeout=60.0)
    assert child.returncode == 7, out + err
    assert float(out) - sent < 0.2
