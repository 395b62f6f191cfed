"""Grasp: a hand holds a cube of 5 kg, lifts it, and lets it go."""

import numpy as np
from _headless import arguments, rehearse

import pydart2 as pydart
from pydart2.constraints import WeldJointConstraint


class Grasp(pydart.World):
    """Lifts from step 100 on and lets go at step 900."""

    def __init__(self) -> None:
        super().__init__(0.001)
        arm = self.add_empty_skeleton("arm")
        self.hand = arm.add_body("hand", joint="prismatic", axis=(0, 1, 0), position=(0, 0.5, 0))
        self.hand.add_box((0.1, 0.05, 0.1), color=(0.3, 0.33, 0.38))
        orange = (0.95, 0.5, 0.1)
        self.cube = self.add_box((0.1, 0.1, 0.1), mass=5.0, position=(0, 0.4, 0), color=orange).bodynodes[0]
        self.add_ground()
        arm.set_targets([0.0], kp=1e4, kd=1e3, compensate="gravity")
        self.grasp = WeldJointConstraint(self.hand, self.cube)
        self.grasp.add_to_world(self)
        self.gap = 0.0  # how far the cube has ever been from its place in the hand, m

    def step(self, n: int = 1) -> None:
        """The cube's place in the hand is 0.1 m below."""
        if self.frame == 100:
            self.hand.skeleton.set_targets([0.3])
        if self.frame == 900:
            self.grasp.remove()
        super().step(n)
        if self.grasp.is_active():
            self.gap = max(self.gap, float(np.linalg.norm(self.cube.relative_pose(self.hand)[:3, 3] + [0.0, 0.1, 0.0])))


if __name__ == "__main__":
    args, world = arguments(), Grasp()
    if args.headless:
        camera = pydart.gui.Camera.look_at([0.95, 0.65, 1.0], [0.0, 0.42, 0.0], up=[0.0, 1.0, 0.0])
        slip = lambda: {f"the cube slips by {1e3 * world.gap:.3f} mm at most": world.gap < 5e-4}  # noqa: E731
        rehearse(world, args, 1400, slip, camera)
    else:
        pydart.gui.viewer.launch(world)
