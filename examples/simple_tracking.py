"""Simple tracking: a robot's configuration by name, and PD control.

Atlas floats in zero gravity. The target is written by the names of dofs; six of the 33 are the free root, which has no
motors.
"""

from collections.abc import Mapping

import numpy as np
from _headless import arguments, rehearse
from numpy.typing import NDArray

import pydart2 as pydart


class Controller:
    """PD control of all joints but the free root."""

    def __init__(self, skel: pydart.Skeleton) -> None:
        self.skel = skel
        self.target = skel.q
        self.Kp = np.array([0.0] * 6 + [400.0] * (self.skel.ndofs - 6))
        self.Kd = np.array([0.0] * 6 + [40.0] * (self.skel.ndofs - 6))

    def compute(self) -> NDArray[np.float64]:
        """Towards the target."""
        return -self.Kp * (self.skel.q - self.target) - self.Kd * self.skel.dq


def check(skel: pydart.Skeleton, target: pydart.SkelVector) -> Mapping[str, bool]:
    """After 2 s every joint is at its target."""
    error = float(np.abs(skel.q - target)[6:].max())
    return {f"no joint is further than {error:.4f} rad from its target after 2 s": error < 0.01}


if __name__ == "__main__":
    args = arguments()
    print("Example: simpleTracking")

    pydart.init()
    print("pydart initialization OK")

    world = pydart.World(1.0 / 2000.0)
    world.set_gravity([0.0, 0.0, 0.0])
    print("World OK")

    skel = world.add_skeleton("./data/sdf/atlas/atlas_v3_no_head.sdf")
    print(f"Skeleton = {skel}")

    # Set joint damping
    for dof in skel.dofs:
        dof.set_damping_coefficient(80.0)

    # Set target pose
    target = skel.positions()
    target["l_arm_shy", "r_arm_shy"] = -1.0, 1.0
    target["l_leg_hpy", "r_leg_hpy"] = -1.0, -1.0
    target["l_leg_kny", "r_leg_kny"] = 1.0, 1.0

    # Initialize the controller
    controller = Controller(skel)
    controller.target = target
    skel.set_controller(controller)
    print("create controller OK")

    if args.headless:
        rehearse(world, args, steps=4000, check=lambda: check(skel, target), camera=None)
    else:
        pydart.gui.viewer.launch(world, default_camera=1)  # Use Z-up camera
