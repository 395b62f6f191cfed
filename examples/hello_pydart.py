"""Cubes: hello, pydart2.

A world is loaded from a SKEL file and stepped for 2 seconds. The last cube falls beside the others and comes to rest.
"""

from collections.abc import Mapping

from _headless import Clip, arguments, finish

import pydart2 as pydart


def check(world: pydart.World) -> Mapping[str, bool]:
    """After 2 s the last cube lies on the ground, whose top is at -0.35 m; it is 0.05 m high."""
    cube = world.skeletons[-1]
    return {f"the last cube lies on the ground, at {cube.C[1]:.4f} m": abs(cube.C[1] + 0.325) < 1e-3}


if __name__ == "__main__":
    args = arguments()
    print("Hello, PyDART!")

    pydart.init()
    print("pydart initialization OK")

    world = pydart.World(1.0 / 2000.0, "./data/skel/cubes.skel")
    print("pydart create_world OK")

    while world.t < 2.0 and world.frame != args.steps:
        if world.nframes % 100 == 0:
            skel = world.skeletons[-1]
            print(f"{world.t:.4f}s: The last cube COM = {skel.C}")
        world.step()

    if args.headless:
        Clip(world, args, None).save()
        finish(args, 4000, lambda: check(world))
