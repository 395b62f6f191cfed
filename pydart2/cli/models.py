"""The file that a command is about."""

from __future__ import annotations

import argparse
import os
from typing import Any

import pydart2
from pydart2.loading import read_model

_TIME_STEP = 0.001  # s, of a file that has none

#: Root elements of formats whose z axis is up.
_Z_UP = ("robot", "sdf", "mujoco")


def add_file(parser: argparse.ArgumentParser) -> None:
    """Let a command take a file."""
    parser.add_argument("file", metavar="FILE", help="URDF, SDF, SKEL, MJCF or VSK; from here, else of the package")


def open_world(path: str | os.PathLike[str]) -> pydart2.World:
    """A world with what a file holds, with the file's gravity if it has one, else along the format's down."""
    model: Any = read_model(path)
    if model.has_world:
        return pydart2.World(_TIME_STEP, model)
    world = pydart2.World(_TIME_STEP)
    if model.document.root.tag in _Z_UP:
        world.set_gravity([0.0, 0.0, -9.81])
    world.add_skeleton(model)
    return world
