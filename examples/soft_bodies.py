"""Soft bodies: rigid cores in skins of point masses.

Five of them fall onto the ground and onto each other. In the end the ground carries the weight of cores and skins.
"""

from collections.abc import Mapping

import numpy as np
from _headless import arguments, rehearse

import pydart2 as pydart

GROUND = -0.35  # m, the top of the ground


def ground_force(world: pydart.World, frame: int) -> float:
    """What the ground, skeleton 0, carries in a recorded frame, N."""
    assert world.recording is not None
    forces = [(-c.force if c.skel_id1 == 0 else c.force)[1] for c in world.recording.contacts(frame).contacts
              if 0 in (c.skel_id1, c.skel_id2)]  # fmt: skip
    return float(sum(forces))


def check(world: pydart.World) -> Mapping[str, bool]:
    """The ground carries the weight of all, cores and skins, in the last half second, and nothing sinks into it."""
    bodies = [body for skel in world.skeletons for body in skel.bodynodes if isinstance(body, pydart.SoftBodyNode)]
    weight = -world.g[1] * sum(body.m + body.point_masses().sum() for body in bodies)
    carried = np.mean([ground_force(world, frame) for frame in range(world.nframes - 1000, world.nframes)])
    lowest = min(body.point_world_positions()[:, 1].min() for body in bodies) - GROUND
    return {
        f"the ground carries {carried:.1f} N of {weight:.1f} N": bool(abs(carried - weight) < 0.1 * weight),
        f"the lowest point of a skin is at {1e3 * lowest:.1f} mm": bool(abs(lowest) < 2e-3),
    }


if __name__ == "__main__":
    args = arguments()
    pydart.init()
    print("pydart initialization OK")

    world = pydart.World(1.0 / 2000.0, "./data/skel/softBodies.skel")
    print("pydart create_world OK")

    if args.headless:
        rehearse(world, args, steps=4000, check=lambda: check(world))
    else:
        pydart.gui.viewer.launch(world)
