"""The file that a command is about."""

from __future__ import annotations

import argparse


def add_file(parser: argparse.ArgumentParser) -> None:
    """Let a command take a file."""
    parser.add_argument("file", metavar="FILE", help="URDF, SDF, SKEL, MJCF or VSK; from here, else of the package")
