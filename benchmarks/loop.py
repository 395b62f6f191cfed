"""The plain C++ loop over Debian's engine: in this process, or as a program of its own."""

from __future__ import annotations

import ctypes
import sys
from collections.abc import Callable
from pathlib import Path

from harness import BUILD, PLAYERS, Figures, Player, output
from scenes import Scene


def loop_folder(prefix: Path | None = None) -> Path:
    """Where the loop is, over Debian's engine or the one in a folder; built on first use."""
    folder = BUILD / ("loop-optimised" if prefix else "loop")
    python = f"-DPython3_EXECUTABLE={sys.executable}"
    output("cmake", "-S", PLAYERS, "-B", folder, python, *([f"-DCMAKE_PREFIX_PATH={prefix}"] if prefix else []))
    output("cmake", "--build", folder)
    return folder


def loop_arguments(scene: Scene) -> list[str]:
    """What loop_make() takes."""
    numbers = (scene.dt, scene.gravity, scene.stiffness, scene.damping, scene.warm, *scene.q)
    return [scene.world or "-", scene.robot or "-", *map(str, numbers)]


def loop_player() -> Player:
    """The program; it answers the question "step"."""
    program = loop_folder() / "loop"

    def play(question: str, scene: Scene) -> Figures:
        seconds, _wall = output(program, str(scene.steps), "3", "1", *loop_arguments(scene)).split()
        return {"step": float(seconds)}

    return play


def parts_player(prefix: Path | None = None) -> Player:
    """Of a step of an engine, Debian's if no folder is given: what is left if its constraint solver, or all of that but
    the LCP, cost nothing; and if all but the search for contacts and the LCP does."""
    program = loop_folder(prefix) / "parts"

    def play(question: str, scene: Scene) -> Figures:
        step, solver, lcp, contacts = map(float, output(program, str(scene.steps), *loop_arguments(scene)).split())
        return {"no solver": step - solver, "only LCP": step - solver + lcp, "contacts and LCP": contacts + lcp}

    return play


class Loop:
    """A scene, stepped by C++ in this process."""

    def __init__(self, scene: Scene) -> None:
        folder = loop_folder()
        self._library = library = ctypes.CDLL(str(folder / "libloop_world.so"))
        self._calls = ctypes.PyDLL(str(folder / "libbare_call.so"))
        self._calls.bare_step.argtypes = [ctypes.c_void_p]
        self._calls.bare_step.restype = ctypes.py_object
        library.loop_make.restype = ctypes.c_void_p
        library.loop_position.argtypes = [ctypes.c_void_p]
        library.loop_steps.argtypes = [ctypes.c_void_p, ctypes.c_int]
        library.loop_steps.restype = library.loop_position.restype = ctypes.c_double
        arguments = [argument.encode() for argument in loop_arguments(scene)]
        self._loop = library.loop_make(len(arguments), (ctypes.c_char_p * len(arguments))(*arguments))

    def steps(self, count: int) -> float:
        """Take steps; seconds of CPU time."""
        return float(self._library.loop_steps(self._loop, count))

    def position(self) -> float:
        """The first position of the last skeleton."""
        return float(self._library.loop_position(self._loop))

    def bare_step(self) -> Callable[[], None]:
        """A function in C that takes one step, with the interpreter's lock released: the least that a binding costs."""
        step: Callable[[], None] = self._calls.bare_step(self._loop)
        return step
