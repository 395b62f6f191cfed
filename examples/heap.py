"""Heap: 500 boxes, balls, cylinders and capsules are poured into a box.

The native detector and the iterative solver: a step costs what its contacts cost.
"""

from collections.abc import Mapping

import numpy as np
from _headless import arguments, rehearse

import pydart2 as pydart

COUNT, HALF, WALL = 500, 0.8, 0.8  # bodies; half the width of the box, m; height of its walls, m


def pour(world: pydart.World) -> None:
    """Bodies in layers above the box, each turned at random."""
    draw = np.random.default_rng(0)
    places = np.linspace(-0.55, 0.55, 6)
    for i in range(COUNT):
        layer, cell = divmod(i, 36)
        position = [places[cell % 6], places[cell // 6], 0.2 + 0.22 * layer]
        kind = (i + layer) % 4  # boxes on boxes would stand as towers, and fall over the walls
        if kind == 0:
            body = world.add_box([0.16, 0.12, 0.1], 1.0, position, color=(0.80, 0.36, 0.28))
        elif kind == 1:
            body = world.add_sphere(0.07, 1.0, position, color=(0.95, 0.72, 0.30))
        elif kind == 2:
            body = world.add_cylinder(0.06, 0.12, 1.0, position, color=(0.36, 0.60, 0.46))
        else:
            body = world.add_capsule(0.05, 0.1, 1.0, position, color=(0.33, 0.47, 0.70))
        body.q = [*draw.uniform(-1.0, 1.0, 3), *body.q[3:]]


def check(world: pydart.World) -> Mapping[str, bool]:
    """All are in the box, and lie still."""
    centres = np.array([skel.C for skel in world.skeletons[5:]])
    inside = (np.abs(centres[:, :2]) < HALF).all(axis=1) & (centres[:, 2] > 0.0)
    speed = max(float(np.linalg.norm(skel.dC)) for skel in world.skeletons[5:])
    return {
        f"{inside.sum()} of {COUNT} bodies are in the box": bool(inside.all()),
        f"none moves faster than {speed:.2f} m/s": speed < 0.5,
    }


if __name__ == "__main__":
    args = arguments()
    world = pydart.World(1.0 / 250.0, up="z")
    world.set_collision_detector("native")
    world.set_constraint_solver("iterative")
    world.add_ground()
    for x, y in ((1, 0), (-1, 0), (0, 1), (0, -1)):
        size = [0.1 + 2.0 * HALF * abs(y), 0.1 + 2.0 * HALF * abs(x), WALL]
        world.add_box(
            size,
            1.0,
            [x * (HALF + 0.05), y * (HALF + 0.05), WALL / 2.0],
            name="wall",
            color=(0.6, 0.6, 0.6),
            fixed=True,
        )
    pour(world)

    if args.headless:
        camera = pydart.gui.Camera.look_at([1.1, -1.1, 3.0], [0.0, 0.0, 0.3], up=[0.0, 0.0, 1.0])
        rehearse(world, args, steps=600, check=lambda: check(world), camera=camera)
    else:
        pydart.gui.viewer.launch(world)
