"""Shapes: one body of each kind falls onto the ground.

Box, sphere, ellipsoid, cylinder, capsule, cone, multi-sphere and mesh.
"""

from collections.abc import Mapping

from _headless import arguments, rehearse

import pydart2 as pydart

GROUND = -0.375  # m, the top of the ground


def check(world: pydart.World) -> Mapping[str, bool]:
    """Nothing sinks into the ground and nothing stays in the air."""
    claims = {}
    for skel in world.skeletons[1:]:
        height = skel.C[1] - GROUND
        claims[f"{skel.name} lies with its centre {height:.3f} m above the ground"] = 0.02 < height < 0.12
    return claims


if __name__ == "__main__":
    args = arguments()
    pydart.init()
    print("pydart initialization OK")

    world = pydart.World(1.0 / 1000.0, "./data/skel/shapes.skel")
    print("pydart create_world OK")

    for skel in world.skeletons:
        for node in skel.bodynodes[0].shapenodes:
            if node.has_collision_aspect():
                print(f"{skel.name}: {node.shape}")

    if args.headless:
        camera = pydart.gui.Camera.look_at([0.0, 0.6, 1.4], [0.35, -0.35, 0.0], up=[0.0, 1.0, 0.0])
        rehearse(world, args, steps=2000, check=lambda: check(world), camera=camera)
    else:
        pydart.gui.viewer.launch(world)
