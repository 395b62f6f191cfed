"""Skeleton viewer: a window on a URDF or SDF file.

    python view_skeleton.py data/sdf/atlas/atlas_v3_no_head.sdf

Drag turns the camera, shift-drag zooms, control-drag moves it. F1 in the window lists everything else.
"""

import sys

from _headless import arguments, rehearse

import pydart2 as pydart
from pydart2.gui.first_look import open_world

if __name__ == "__main__":
    args = arguments(model=True)
    if args.model is None:
        print("Usage: view_skeleton.py [*urdf/*sdf]")
        sys.exit(0)

    print(f"skeleton path = {args.model}")

    pydart.init()
    print("Pydart init OK")

    world = open_world(args.model, ground=not args.headless)
    print("World init OK")
    print("Skeleton add OK")

    print("Camera:")
    print("    drag: rotate camera")
    print("    shift-drag: zoom camera")
    print("    control-drag: translate camera")

    if args.headless:
        rehearse(world, args, steps=0, camera=None)
    else:
        pydart.gui.viewer.launch(world)
