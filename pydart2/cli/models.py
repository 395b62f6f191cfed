"""The file that a command is about."""

from __future__ import annotations

import argparse
import os
from typing import Any

import pydart2
from pydart2.gui.first_look import height_of_floor
from pydart2.loading import read_model
from pydart2.up import Axis, is_z_up

_TIME_STEP = 0.001  # s, of a file that has none


def add_file(parser: argparse.ArgumentParser) -> None:
    """Let a command take a file."""
    parser.add_argument("file", metavar="FILE", help="URDF, SDF, SKEL, MJCF or VSK; from here, else of the package")


def open_world(path: str | os.PathLike[str], ground: bool = False) -> pydart2.World:
    """A world with what a file holds, with the file's gravity if it has one, else along the format's down.

    With `ground`, what has no floor gets one, right under it, where there is gravity along it.
    """
    model: Any = read_model(path)
    up: Axis | None = None if model.has_world else "z" if is_z_up(model) else "y"
    world = pydart2.World(_TIME_STEP, model, up=up)
    if ground and -world.gravity() @ world.up > 0.0:
        height = height_of_floor(world)
        if height is not None:
            world.add_ground(height)
            world.reset()  # the recording, too, begins with the ground
    return world
