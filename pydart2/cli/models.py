"""The file that a command is about."""

from __future__ import annotations

import argparse
import os
from pathlib import PurePath

from pydart2 import models

_KINDS = "URDF, SDF, SKEL, MJCF or VSK file, from here or of the package; or a robot of an installed package, as ur5e"


def add_file(parser: argparse.ArgumentParser) -> None:
    """Let a command take a file."""
    parser.add_argument("file", metavar="FILE", help=_KINDS)


def add_standing(parser: argparse.ArgumentParser) -> None:
    """Let a command take what holds the model: a ground, by default, or the world."""
    parser.add_argument("--fixed", action="store_true", help="weld its root to the world, as an arm's on a table")
    parser.add_argument("--no-ground", action="store_true", help="let it fall: add no ground where the file has none")


def path_of(name: str) -> str:
    """The path that is meant: a name that is no file and has no suffix is a robot's. NameNotFound if there is none."""
    is_name = not (os.path.exists(name) or PurePath(name).suffix or "<" in name or "://" in name)
    return models.find(name) if is_name else name
