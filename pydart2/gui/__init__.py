"""Pictures and windows. Nothing of OpenGL or Qt is imported before it is used.

>>> picture = pydart2.gui.render(world, 640, 480)
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

from pydart2.cameras import MountedCamera
from pydart2.gui.camera import Camera
from pydart2.gui.trackball import Trackball

if TYPE_CHECKING:
    from pydart2.gui import glut as glut
    from pydart2.gui import opengl as opengl
    from pydart2.gui import pyqt5 as pyqt5
    from pydart2.gui import viewer as viewer
    from pydart2.gui.camera_sensor import CameraSensor
    from pydart2.gui.moving_cameras import between, follow, orbit
    from pydart2.gui.offscreen import OffscreenRenderer, render
    from pydart2.gui.recorder import Movie, record

__all__ = [
    "Camera",
    "CameraSensor",
    "MountedCamera",
    "Movie",
    "OffscreenRenderer",
    "Trackball",
    "between",
    "follow",
    "orbit",
    "record",
    "render",
]

_MODULES = ("glut", "opengl", "pyqt5", "viewer")


def __getattr__(name: str) -> object:
    if name in ("OffscreenRenderer", "render"):
        return getattr(import_module("pydart2.gui.offscreen"), name)
    if name == "CameraSensor":
        return import_module("pydart2.gui.camera_sensor").CameraSensor
    if name in ("Movie", "record"):
        return getattr(import_module("pydart2.gui.recorder"), name)
    if name in ("between", "follow", "orbit"):
        return getattr(import_module("pydart2.gui.moving_cameras"), name)
    if name == "side_panel":
        return import_module("pydart2.gui.pyqt5.side_panel")
    if name in _MODULES:
        return import_module(f"pydart2.gui.{name}")
    raise AttributeError(f"module 'pydart2.gui' has no attribute {name!r}")
