"""How a process ends: with its status whatever a thread is doing, whole after fork(), with a sentence where it must."""

from __future__ import annotations

import ctypes
import subprocess
import sys
from pathlib import Path

import pytest

DAEMON = """
import threading, time
import pydart2

started = threading.Event()

def work():
    world = pydart2.World(0.001, "skel/cubes.skel")
    {prepare}
    while True:
        {deed}
        started.set()

threading.Thread(target=work, daemon=True).start()
started.wait()
time.sleep({pause})
"""

DEEDS = {
    "step": ("", "world.step(3)"),
    "ode": ("world.set_collision_detector(world.ODE_COLLISION_DETECTOR)", "world.step(3)"),
    "load": ("", 'pydart2.World(0.001, "skel/chain.skel")'),
    "batch": ("batch = pydart2.Batch(world, 4, threads=2)", "batch.step(3)"),
}


def run(script: str, seconds: float = 60.0) -> subprocess.CompletedProcess[str]:
    return subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=seconds)


@pytest.mark.parametrize("deed", DEEDS)
@pytest.mark.parametrize("pause", [0.0, 0.05])
def test_a_daemon_thread_does_not_spoil_the_end(deed: str, pause: float) -> None:
    prepare, call = DEEDS[deed]
    done = run(DAEMON.format(prepare=prepare, deed=call, pause=pause))
    assert (done.returncode, done.stderr) == (0, "")


def test_a_status_is_kept() -> None:
    prepare, deed = DEEDS["step"]
    done = run(DAEMON.format(prepare=prepare, deed=deed, pause=0.05) + "print('said')\nraise SystemExit(3)")
    assert (done.returncode, done.stdout) == (3, "said\n")


FORK = """
import os, threading, warnings
import pydart2

warnings.simplefilter("ignore")  # newer Pythons warn of fork() beside threads
world = pydart2.World(0.001, "skel/fullbody1.skel")
world.set_collision_detector("ode")
stepping = threading.Event()

def work():
    while True:
        stepping.set()
        world.step(20)

threading.Thread(target=work, daemon=True).start()
stepping.wait()
for _ in range(8):
    child = os.fork()
    if child == 0:
        own = pydart2.World(0.001, "skel/cubes.skel")
        own.set_collision_detector("ode")
        own.step(3)
        try:
            world.step()
        except pydart2.PydartError as error:
            assert "in use by another thread" in str(error)
        os._exit(0)
    assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 0
"""


def test_a_child_forked_in_the_middle_of_a_step_works() -> None:
    done = run(FORK)
    assert (done.returncode, done.stderr) == (0, "")


SLOW_STATIC = """
#include <unistd.h>

static int slow() { usleep(300000); return 42; }

extern "C" int value()
{
  static const int once = slow();
  return once;
}
"""
FORK_AT_A_STATIC = """
import ctypes, os, threading, time, warnings
warnings.simplefilter("ignore")
library = ctypes.CDLL("{library}")  # by its name one of the engine's, whose calls are redirected at import
import pydart2

thread = threading.Thread(target=library.value)
thread.start()
time.sleep(0.05)
child = os.fork()
if child == 0:
    os._exit(library.value())
assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 42
thread.join()
"""


def test_a_child_forked_in_the_first_time_of_a_static_can_use_it(tmp_path: Path) -> None:
    library = tmp_path / "libdart-slow.so"
    compiler = ["c++", "-shared", "-fPIC", "-x", "c++", "-", "-o", str(library)]
    subprocess.run(compiler, input=SLOW_STATIC, text=True, check=True)
    done = run(FORK_AT_A_STATIC.format(library=library))
    assert (done.returncode, done.stderr) == (0, "")


FUNCTION = "_ZN4dart4math15computeRotationERKN5Eigen6MatrixIdLi3ELi1ELi0ELi3ELi1EEENS0_8AxisTypeE"
NOBODY_CATCHES = """
import ctypes, faulthandler
import pydart2

def lines_that_led_there():
    rotation, no_axis = (ctypes.c_double * 9)(), (ctypes.c_double * 3)()
    ctypes.CDLL("{engine}")["{function}"](rotation, no_axis, 0)

assert not faulthandler.is_enabled()
lines_that_led_there()
"""


def test_what_slips_through_ends_with_a_sentence_and_the_lines() -> None:
    with open("/proc/self/maps") as maps:
        engine = next(line.split()[-1] for line in maps if "/libdart.so" in line)
    if not hasattr(ctypes.CDLL(engine), "__assert_fail"):
        pytest.skip("this engine was built without assertions")
    done = run(NOBODY_CATCHES.format(engine=engine, function=FUNCTION))
    assert done.returncode == -6
    assert "pydart2 has to end the process: the engine cannot go on: it expects axis != " in done.stderr
    assert "in lines_that_led_there" in done.stderr
