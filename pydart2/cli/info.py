"""``pydart2 info``: what is installed and what it runs on."""

from __future__ import annotations

import argparse
import os
import platform
import sys
from importlib.metadata import PackageNotFoundError, version
from typing import Any

import pydart2
from pydart2.cli.report import Report
from pydart2.errors import PydartError

_PACKAGES = ("numpy", "scipy", "PyQt5", "PyOpenGL", "pillow", "av", "tqdm", "matplotlib", "mujoco", "gymnasium")


def add(commands: Any) -> None:
    """Add the command."""
    parser = commands.add_parser("info", help="versions, the engine and OpenGL, as for a bug report")
    parser.add_argument("--json", action="store_true", help="as JSON")
    parser.set_defaults(run=run)


def run(args: argparse.Namespace) -> Report:
    """Describe all that matters."""
    engine = pydart2.engine_info()
    data = {
        "pydart2": pydart2.__version__,
        "python": platform.python_version(),
        "system": f"{platform.system()} {platform.machine()}, {os.cpu_count()} processors",
        "dart": f"{engine.dart} in {engine.prefix}, {'with' if engine.assertions else 'without'} assertions",
        "solver": engine.solver,
        "dynamics": engine.dynamics,
        "opengl": _opengl(),
        **{package: _version(package) for package in _PACKAGES},
    }
    width = max(map(len, data))
    return Report("\n".join(f"{name:<{width}}  {value or 'not installed'}" for name, value in data.items()), data)


def _version(package: str) -> str | None:
    try:
        return version(package)
    except PackageNotFoundError:
        return None


def _opengl() -> str:
    """The context that pictures are drawn with, or why there is none."""
    from pydart2.gui import OffscreenRenderer

    try:
        renderer = OffscreenRenderer(8, 8)
    except (PydartError, ImportError) as error:
        return f"none: {error}".splitlines()[0]
    try:
        with renderer._current():
            gl: Any = sys.modules["OpenGL.GL"]
            return " ".join(gl.glGetString(name).decode() for name in (gl.GL_RENDERER, gl.GL_VERSION))
    finally:
        renderer.close()
