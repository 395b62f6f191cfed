"""Reach: Atlas draws a circle with its hand while its feet stay on the ground."""

from typing import Any

import numpy as np
from _headless import arguments, rehearse

import pydart2 as pydart


class Reach(pydart.World):
    """Each step is 2 degrees of the circle."""

    def __init__(self) -> None:
        super().__init__(0.01)
        self.set_gravity([0.0, 0.0, -9.81])
        self.robot = self.add_skeleton("./data/sdf/atlas/atlas_v3_no_head.sdf")
        self.robot.set_positions({"l_leg_kny": 0.6, "r_leg_kny": 0.6, "l_leg_hpy": -0.3, "r_leg_hpy": -0.3})
        self.robot.set_mobile(False)  # it is posed, not simulated
        self.feet: dict[Any, Any] = {name: self.robot.body(name).T for name in ("l_foot", "r_foot")}
        self.residuals: list[float] = []

    def step(self, n: int = 1) -> None:
        """The next target of the hand."""
        angle = np.radians(2.0 * self.frame)
        goal = [0.5, 0.3 + 0.15 * np.cos(angle), 0.4 + 0.15 * np.sin(angle)]
        result = self.robot.inverse_kinematics({"l_hand": goal, **self.feet})
        self.robot.q = result.q
        self.residuals.append(result.residual)
        super().step(n)


if __name__ == "__main__":
    args, world = arguments(), Reach()
    if args.headless:
        text = "the hand is at most a micrometre from its target"
        rehearse(world, args, 180, lambda: {text: max(world.residuals) <= 1e-6}, camera=None)
    else:
        pydart.gui.viewer.launch(world)
