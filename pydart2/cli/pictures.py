"""``pydart2 view``, ``render`` and ``record``: a file in a window, in a picture, in a movie."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

from pydart2.cli.models import add_file, add_standing
from pydart2.gui.first_look import VIEWS, open_world


def add(commands: Any) -> None:
    """Add the commands."""
    view = commands.add_parser("view", help="show a file in a window")
    add_file(view)
    add_standing(view)
    _add_camera(view)
    view.set_defaults(run=run_view)

    render = commands.add_parser("render", help="make a picture of a file")
    add_file(render)
    _add_picture(render, "out.png", "file to write: .png, .jpg, .webp")
    render.set_defaults(run=run_render)

    record = commands.add_parser("record", help="simulate a file and make a movie of it")
    add_file(record)
    add_standing(record)
    _add_picture(record, "out.mp4", "file to write: .mp4, .webp, .gif")
    record.add_argument("--seconds", type=float, default=5.0, metavar="S", help="how long to simulate (5)")
    record.add_argument("--fps", type=float, default=30.0, help="pictures a second (30)")
    record.set_defaults(run=run_record)


def _add_picture(parser: argparse.ArgumentParser, name: str, kinds: str) -> None:
    parser.add_argument("-o", "--output", type=Path, default=Path(name), metavar="PATH", help=f"{kinds} ({name})")
    parser.add_argument("--size", type=_size, default=(640, 480), metavar="WxH", help="in pixels (640x480)")
    _add_camera(parser)


def _add_camera(parser: argparse.ArgumentParser) -> None:
    known = ", ".join(sorted(VIEWS))
    parser.add_argument("--camera", default="auto", metavar="NAME", help=f"{known}, or a camera of the file (auto)")


def _size(text: str) -> tuple[int, int]:
    width, x, height = text.partition("x")
    if not (x and width.isdigit() and height.isdigit()):
        raise argparse.ArgumentTypeError(f"a size is as 640x480, not {text!r}")
    return int(width), int(height)


def run_view(args: argparse.Namespace) -> None:
    """Open a window until it is closed."""
    from pydart2.gui import viewer

    world = open_world(args.file, not args.no_ground, fixed=args.fixed)
    viewer.launch(world, Path(args.file).name, args.camera)


def run_render(args: argparse.Namespace) -> None:
    """Write a picture."""
    from PIL import Image

    from pydart2 import gui

    width, height = args.size
    Image.fromarray(gui.render(open_world(args.file), width, height, args.camera)).save(args.output)
    print(args.output)


def run_record(args: argparse.Namespace) -> None:
    """Write a movie."""
    from pydart2 import gui

    world = open_world(args.file, not args.no_ground, fixed=args.fixed)
    gui.record(world, args.output, args.seconds, args.fps, args.camera, args.size)
    print(args.output)
