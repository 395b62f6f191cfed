"""Wall: a hundred bricks that stand on each other, and a ball that flies into them.

The native detector and the iterative solver; half bricks close every second row.
"""

from collections.abc import Mapping

import numpy as np
from _headless import arguments, rehearse

import pydart2 as pydart

ROWS, SIDE = 10, 0.2  # and m
STEPS, STANDS = 600, 250  # of 4 ms; after so many the ball flies

COLORS = ((0.80, 0.36, 0.28), (0.90, 0.58, 0.40))


def build(world: pydart.World) -> None:
    """Every second row is shifted by half a brick."""
    for row in range(ROWS):
        height, odd = SIDE * (row + 0.5), row % 2
        for i in range(ROWS - odd):
            world.add_box(
                [SIDE, SIDE, SIDE], 1.0, [SIDE * (i + 0.5 * odd), 0.0, height], color=COLORS[odd], name="brick"
            )
        for x in (-SIDE / 4.0, SIDE * (ROWS - 0.75)) if odd else ():
            world.add_box([SIDE / 2.0, SIDE, SIDE], 0.5, [x, 0.0, height], color=COLORS[odd], name="brick")


class Throw:
    """A controller of the ball: it flies when the wall has stood for a while."""

    def __init__(self, ball: pydart.Skeleton, bricks: list[pydart.Skeleton]) -> None:
        self.ball, self.bricks = ball, bricks
        self.built = self.places()
        self.moved = 0.0

    def places(self) -> np.ndarray:
        """Of all bricks."""
        return np.array([brick.C for brick in self.bricks])

    def compute(self) -> np.ndarray:
        """Weight is borne until then."""
        steps = round(self.ball.world.t / self.ball.world.dt)
        if steps < STANDS:
            self.moved = float(np.abs(self.places() - self.built).max())
            return np.asarray(np.r_[np.zeros(5), 9.81 * self.ball.m])
        if steps == STANDS:
            self.ball.dq = [0.0, 0.0, 0.0, 0.0, 8.0, 2.0]
        return np.zeros(6)


def check(throw: Throw) -> Mapping[str, bool]:
    """It stood, and then it did not."""
    fallen = int((np.linalg.norm(throw.places() - throw.built, axis=1) > SIDE).sum())
    lowest = float(throw.places()[:, 2].min())
    return {
        f"no brick moved by more than {1e3 * throw.moved:.2f} mm while the wall stood": throw.moved < 1e-3,
        f"the ball threw {fallen} bricks down": fallen > 10,
        f"the lowest is {lowest:.3f} m high": lowest > SIDE / 4.0 - 2e-3,
    }


if __name__ == "__main__":
    args = arguments()
    world = pydart.World(1.0 / 250.0, up="z")
    world.set_collision_detector("native")
    world.set_constraint_solver("iterative")
    world.add_ground()
    build(world)
    bricks = list(world.skeletons[1:])
    ball = world.add_sphere(0.2, 20.0, [0.9, -2.0, 0.8], color=(0.25, 0.35, 0.55))
    throw = Throw(ball, bricks)
    ball.set_controller(throw)

    if args.headless:
        camera = pydart.gui.Camera.look_at([3.6, -3.4, 1.9], [0.9, 0.2, 0.8], up=[0.0, 0.0, 1.0])
        rehearse(world, args, steps=STEPS, check=lambda: check(throw), camera=camera)
    else:
        pydart.gui.viewer.launch(world)
