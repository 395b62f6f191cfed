"""Rubble: a robot of six legs, built in code, walks over loose blocks.

Three feet stand and push back while the other three swing forward; position targets hold each joint.
"""

from collections.abc import Mapping

import numpy as np
from _headless import arguments, rehearse

import pydart2 as pydart

BLOCKS, PERIOD = 150, 1.0  # loose ones; of a stride, s
STRIDE, LIFT = 0.32, 0.55  # rad, of the joints
#: Each leg's place along the body, m, its side, and when it swings.
LEGS = [(x, side, (i + j) % 2 * np.pi) for i, x in enumerate((0.2, 0.0, -0.2)) for j, side in enumerate((1, -1))]


def scatter(world: pydart.World) -> None:
    """Blocks of 2 to 12 cm lie about, as they fell."""
    draw = np.random.default_rng(1)
    for _ in range(BLOCKS):
        size = draw.uniform(0.04, 0.12, 3) * [1.0, 1.0, 0.5]
        place = [*draw.uniform((0.6, -0.6), (3.0, 0.6)), draw.uniform(0.05, 0.3)]
        block = world.add_box(
            size, None, place, density=1500.0, color=draw.uniform(0.35, 0.6) * np.array([1.0, 0.9, 0.8])
        )
        block.q = [*draw.uniform(-1.0, 1.0, 3), *block.q[3:]]


def build(world: pydart.World) -> pydart.Skeleton:
    """A body of 4 kg on six legs, each with a joint that swings and one that lifts."""
    robot = world.add_empty_skeleton("hexapod")
    trunk = robot.add_body("trunk", position=(0.0, 0.0, 0.26))
    trunk.add_box((0.5, 0.16, 0.06), mass=4.0, color=(0.33, 0.47, 0.70))
    for i, (x, side, _) in enumerate(LEGS):
        hip = robot.add_body(f"hip {i}", trunk, "revolute", axis=(0, 0, 1), position=(x, 0.1 * side, 0.0))
        hip.add_sphere(0.03, mass=0.1, collides=False)
        leg = robot.add_body(f"leg {i}", hip, "revolute", axis=(side, 0, 0))
        across, down = (0.7071, -0.7071 * side, 0.0, 0.0), (0.0, 0.16 * side, -0.1)
        leg.add_capsule(
            0.015, 0.16, mass=0.1, position=(0.0, 0.08 * side, 0.0), orientation=across, color=(0.8, 0.36, 0.28)
        )
        leg.add_capsule(0.015, 0.2, mass=0.1, position=down, color=(0.8, 0.36, 0.28))
        leg.add_sphere(0.025, mass=0.05, position=(0.0, 0.16 * side, -0.22), color=(0.2, 0.2, 0.2))
    robot.set_targets(robot.q[6:], kp=40.0, kd=2.0)
    return robot


class Gait:
    """A tripod: what swings is lifted on its way forward."""

    def __init__(self, robot: pydart.Skeleton) -> None:
        self.robot = robot

    def compute(self) -> np.ndarray:
        """Set the targets of this moment; no force of its own."""
        for i, (_, side, start) in enumerate(LEGS):
            phase = 2.0 * np.pi * self.robot.world.t / PERIOD + start
            swing, lift = STRIDE * np.cos(phase), LIFT * max(0.0, np.sin(phase))
            self.robot.set_targets({f"hip {i}_joint": side * swing, f"leg {i}_joint": lift})
        return np.zeros(self.robot.ndofs)


def check(robot: pydart.Skeleton) -> Mapping[str, bool]:
    """It came along, and stands."""
    x, _, height = robot.C
    return {
        f"it walked {x:.1f} m": x > 0.8,
        "it is upright": bool(robot.body("trunk").T[2, 2] > 0.7) and height > 0.1,
    }


if __name__ == "__main__":
    args = arguments()
    world = pydart.World(0.002, up="z")
    world.set_collision_detector("native")
    world.set_constraint_solver("iterative")
    world.add_ground()
    scatter(world)
    world.step(500)  # the blocks come to rest
    robot = build(world)
    robot.set_controller(Gait(robot))

    if args.headless:
        camera = pydart.gui.Camera.look_at([1.6, -1.7, 1.1], [1.1, 0.0, 0.1], up=[0.0, 0.0, 1.0])
        rehearse(world, args, steps=3000, check=lambda: check(robot), camera=camera)
    else:
        pydart.gui.viewer.launch(world)
