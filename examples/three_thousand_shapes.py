"""Three thousand shapes: boxes, cylinders and balls fall 2 cm, come to rest and sleep; a ball wakes what it hits.

Asleep they cost a step almost nothing.
"""

import time
from collections.abc import Mapping

import numpy as np
from _headless import arguments, rehearse

import pydart2 as pydart

ROW, SPACING = 1000, 1.5  # shapes of each kind, m between them
STEPS = 1000


def lay_out(world: pydart.World) -> None:
    """Rows of shapes of 1 m, 2 cm above the ground, each with a spin of its own."""
    draw = np.random.default_rng(0)
    for i in range(ROW):
        x, y = SPACING * (i % 50), 3.0 * SPACING * (i // 50)
        shapes = (
            world.add_box([1.0, 1.0, 1.0], 1.0, [x, y, 0.52], color=(0.80, 0.36, 0.28)),
            world.add_cylinder(0.5, 1.0, 1.0, [x, y + SPACING, 0.52], color=(0.36, 0.60, 0.46)),
            world.add_sphere(0.5, 1.0, [x, y + 2.0 * SPACING, 0.52], color=(0.95, 0.72, 0.30)),
        )
        for shape in shapes:
            shape.dq = [*draw.uniform(-0.1, 0.1, 3), 0.0, 0.0, 0.0]


def check(world: pydart.World, seconds: float) -> Mapping[str, bool]:
    """All lie on the ground and sleep, until a ball falls on one of them."""
    sleepers, lowest = len(world.sleepers()), min(float(skel.C[2]) for skel in world.skeletons[1:])
    begin = time.perf_counter()
    world.step(100)
    asleep = (time.perf_counter() - begin) / 100
    ratio = seconds / STEPS / asleep
    ball = world.add_sphere(0.3, 1.0, [0.0, 0.0, 2.0])
    world.step(300)
    awake = [skel for skel in world.skeletons[1:] if not skel.is_asleep()]
    return {
        f"{sleepers} of {3 * ROW} sleep after {STEPS * world.dt:.1f} s, computed in {seconds:.0f} s": sleepers
        == 3 * ROW,
        f"the lowest centre is {lowest:.4f} m high": lowest > 0.499,
        f"asleep, a step takes {1e3 * asleep:.1f} ms, one in {ratio:.0f} of what it took before": ratio > 5.0,
        f"a ball that falls on a box wakes {len(awake) - 1}": awake == [world.skeletons[1], ball],
    }


if __name__ == "__main__":
    args = arguments()
    world = pydart.World(0.002, up="z")
    world.set_collision_detector("native")
    world.set_constraint_solver("iterative")
    world.set_sleeping()
    world.disable_recording()
    world.add_ground(size=[200.0, 200.0])
    lay_out(world)

    if args.headless:
        begin = time.perf_counter()
        camera = pydart.gui.Camera.look_at([-8.0, -10.0, 7.0], [12.0, 14.0, 0.0], up=[0.0, 0.0, 1.0])
        rehearse(world, args, STEPS, lambda: check(world, time.perf_counter() - begin), camera, every=STEPS)
    else:
        pydart.gui.viewer.launch(world)
