"""What the engine prints goes to Python's logging; what others print does not."""

from __future__ import annotations

import collections
import logging
import subprocess
import sys
import textwrap
from pathlib import Path
from typing import Any

import pytest

import pydart2
from pydart2 import World

INERTIAL = "<inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial>"
FREE = f"<robot name='r'><link name='l'>{INERTIAL}</link></robot>"  # a massless body is put above its root

OTHER = """
#include <chrono>
#include <iostream>
#include <thread>
extern "C" void say(int times)
{
  for (int i = 0; i < times; ++i) {
    std::cout << "other out " << i << std::endl;
    std::cerr << "other err " << i << std::endl;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
}
"""

# Two soft bodies above each other: the "dart" detector says that it does not know of them, in each step.
SOFT = """
world = pydart2.World(0.001, "skel/softBodies.skel")
world.set_collision_detector(0)
"""


def run(code: str, *arguments: str) -> tuple[str, str]:
    """The standard output and standard error of a program."""
    setup = "import logging, sys\nimport pydart2\n"
    command = [sys.executable, "-c", setup + textwrap.dedent(code), *arguments]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout, done.stderr


def engine_records(caplog: Any) -> list[logging.LogRecord]:
    return [record for record in caplog.records if record.name == "pydart2.engine"]


@pytest.fixture(autouse=True)
def all_is_said() -> None:
    pydart2.init(verbose=False)  # counts repeats from the start
    pydart2.set_verbose(True)


def test_a_warning_of_the_engine(caplog: Any, capfd: Any) -> None:
    World(0.001, FREE).skeletons[0].set_root_joint_to_trans_and_euler()
    (record,) = engine_records(caplog)
    assert record.levelno == logging.WARNING and "zero mass" in record.getMessage()
    assert "\033" not in record.getMessage() and record.getMessage().startswith("[BodyNode.cpp:")
    assert capfd.readouterr() == ("", "")


def test_nothing_is_said_without_a_reader() -> None:
    """Without logging set up, Python shows warnings on standard error; a level hides them."""
    code = f'pydart2.World(0.001, "{FREE}").skeletons[0].set_root_joint_to_trans_and_euler()'
    out, err = run(code)
    assert out == "" and "zero mass" in err
    assert run('logging.getLogger("pydart2.engine").setLevel(logging.ERROR)\n' + code) == ("", "")
    assert run("pydart2.set_verbose(False)\n" + code) == ("", "")


def test_a_message_while_the_glue_is_imported_waits() -> None:
    """As when Python's collector frees a world in the middle of that import."""
    code = f"""
    class Middle:
        def find_spec(self, name, path=None, target=None):
            if name == "logging":
                warn()
    free = [pydart2.World(0.001, "{FREE}").skeletons[0] for _ in range(2)]
    def warn():
        free.pop().set_root_joint_to_trans_and_euler()
    del sys.modules["logging"]
    sys.meta_path.insert(0, Middle())
    warn()
    """
    out, err = run(code)
    assert out == "" and err.count("zero mass") == 2 and "ignored" not in err


def test_repeats_are_limited(caplog: Any, capfd: Any) -> None:
    """Of 120 of the same: the first ten and the hundredth, with its number; after init() from the start."""
    for _ in range(2):
        pydart2.init(verbose=False)
        pydart2.set_verbose(True)
        caplog.clear()
        for _ in range(120):
            World(0.001, FREE, safe=False).skeletons[0].set_root_joint_to_trans_and_euler()
        texts = [record.getMessage() for record in engine_records(caplog)]
        assert len(texts) == 11 and len(set(texts[:10])) == 1 and texts[10] == texts[0] + " (100 times so far)"
    assert capfd.readouterr() == ("", "")


def test_a_step_that_prints(caplog: Any, capfd: Any) -> None:
    """Also in one call of many steps, and from standard output."""
    space: dict[str, Any] = {"pydart2": pydart2}
    exec(SOFT, space)
    space["world"].step(300)
    assert capfd.readouterr() == ("", "")
    kinds = collections.Counter(record.getMessage().split(" (")[0] for record in engine_records(caplog))
    assert all("[DARTCollisionDetector" in kind for kind in kinds)
    assert max(kinds.values()) == 12  # the first ten, the 100th, the 1000th


def test_the_threads_of_a_batch_that_print(caplog: Any, capfd: Any) -> None:
    space: dict[str, Any] = {"pydart2": pydart2}
    exec(SOFT, space)
    batch = pydart2.Batch(space["world"], 4, threads=4)
    caplog.clear()
    batch.step(20)
    assert capfd.readouterr() == ("", "")
    assert any("[DARTCollisionDetector" in record.getMessage() for record in engine_records(caplog))


def test_an_error_keeps_its_messages(caplog: Any) -> None:
    with pytest.raises(pydart2.LoadError):
        World(0.001, "<robot name='r'><link name='a'/><link name='b'/></robot>", safe=False)
    assert any(record.levelno == logging.ERROR for record in engine_records(caplog))


def test_a_failing_handler_does_not_fail_the_call(monkeypatch: pytest.MonkeyPatch) -> None:
    heard: list[Any] = []
    monkeypatch.setattr(sys, "unraisablehook", heard.append)

    def fail(_record: logging.LogRecord) -> bool:
        raise OSError("no")

    logger = logging.getLogger("pydart2.engine")
    logger.addFilter(fail)
    try:
        World(0.001, FREE).skeletons[0].set_root_joint_to_trans_and_euler()
    finally:
        logger.removeFilter(fail)
    assert [str(event.exc_value) for event in heard] == ["no"]


@pytest.fixture(scope="module")
def other(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A library of somebody else that prints with C++'s streams."""
    folder = tmp_path_factory.mktemp("other")
    (folder / "other.cpp").write_text(OTHER)
    library = folder / "libother.so"
    subprocess.run(["g++", "-shared", "-fPIC", "-o", library, folder / "other.cpp"], check=True)
    return library


def test_others_print_as_before(other: Path) -> None:
    """Between our calls, and in another thread during one."""
    code = (
        """
        import ctypes, threading
        logging.getLogger("pydart2.engine").addHandler(logging.NullHandler())  # would write into the others' lines
        other = ctypes.CDLL(sys.argv[1])
        other.say(3)
        """
        + textwrap.indent(SOFT, " " * 8)
        + """
        thread = threading.Thread(target=other.say, args=(50,))
        thread.start()
        while thread.is_alive():
            world.step(10)
        """
    )
    out, err = run(code, str(other))
    numbers = [*range(3), *range(50)]
    assert out.splitlines() == [f"other out {i}" for i in numbers]
    assert err.splitlines() == [f"other err {i}" for i in numbers]


def test_reading_costs_nothing_when_nothing_is_printed() -> None:
    """The extension asks one flag: no message, no import of the logging glue."""
    out, _ = run('pydart2.World(0.001, "skel/cubes.skel").step(100)\nprint("pydart2.messages" in sys.modules)')
    assert out == "False\n"
