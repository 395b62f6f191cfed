"""``pydart2 convert``: a model file as one of another format."""

from __future__ import annotations

import argparse
from typing import Any

from pydart2.cli.models import add_file


def add(commands: Any) -> None:
    """Add the command."""
    parser = commands.add_parser(
        "convert",
        help="write a file in another format",
        description="What the format of OUT cannot hold is a warning, or an error if things would move otherwise.",
    )
    add_file(parser)
    parser.add_argument("output", metavar="OUT", help="its suffix names the format: .urdf, .skel, .sdf, .xml (MJCF)")
    parser.add_argument("--only", metavar="NAME", help="one skeleton of a file that holds several")
    parser.add_argument("--strict", action="store_true", help="let what would be a warning be an error")
    parser.set_defaults(run=run)


def run(args: argparse.Namespace) -> None:
    """Load and save: a world as a world where the format has them, or if it holds one skeleton that."""
    from pydart2.gui.first_look import open_world
    from pydart2.loading import read_model

    model = read_model(args.file)
    world = open_world(model)
    if args.only is not None:
        world.skeleton(args.only).save(args.output, strict=args.strict)
    elif len(world.skeletons) == 1 and (not model.has_world or args.output.lower().endswith(".urdf")):
        world.skeletons[0].save(args.output, strict=args.strict)
    else:
        world.save(args.output, strict=args.strict)
    print(args.output)
