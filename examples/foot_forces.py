"""Foot forces: what each box of a stack carries, and where it presses."""

import numpy as np
from _headless import arguments, rehearse

import pydart2 as pydart

G = 9.81


def check(world: pydart.World) -> dict[str, bool]:
    """A cube that lies on the ground alone is carried by the ground, below its centre."""
    ground = world.skeletons[0]
    carried, off = [], []
    for cube in world.skeletons[1:]:
        under = world.contacts_between(cube, ground)
        place = under.centre_of_pressure()
        if place is not None and len(cube.contacts) == len(under):
            carried.append(float(np.abs(under.force - [0.0, cube.m * G, 0.0]).max()))
            off.append(float(np.abs((place - cube.C)[[0, 2]]).max()))
    return {
        f"{len(carried)} of the cubes: carried with the weight to {max(carried):.1e} N": max(carried) < 1e-2,
        f"and pressing at most {1e3 * max(off):.2f} mm beside the centre": max(off) < 1e-3,
    }


if __name__ == "__main__":
    args = arguments()
    world = pydart.World(1.0 / 2000.0, "./data/skel/cubes.skel")
    if args.headless:
        rehearse(world, args, 6000, lambda: check(world), camera=None)
    else:
        pydart.gui.viewer.launch(world)
