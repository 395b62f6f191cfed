"""Gravity compensation: a PR2 whose arms float.

The controller carries each body at its centre of mass: tau = sum of J^T (-m g). The key G switches it off, and the arms
fall.
"""

from collections.abc import Mapping
from typing import Any

import numpy as np
from _headless import arguments, rehearse
from numpy.typing import NDArray

import pydart2 as pydart

Array = NDArray[np.float64]


class GravityCompensationController:
    """Carries each body at its centre of mass, by the transpose of its Jacobian."""

    def __init__(self, robot: pydart.Skeleton) -> None:
        self.robot = robot
        self.g = self.robot.world.gravity()
        self.enabled = True

    def compute(self) -> Array:
        """Against the weights; zero while not enabled."""
        tau = np.zeros(self.robot.num_dofs())
        if not self.enabled:
            return tau

        for body in self.robot.bodynodes:
            m = body.mass()  # Or, simply body.m
            J = body.linear_jacobian(body.local_com())
            tau += J.T @ -(m * self.g)
        return tau


class MyWorld(pydart.World):
    """A PR2 whose compensation the key G switches on and off."""

    def __init__(self) -> None:
        super().__init__(0.001)
        self.set_gravity([0.0, 0.0, -9.81])
        print("pydart create_world OK")

        self.robot = self.add_skeleton("./data/urdf/PR2/pr2.urdf")
        print("pydart add_skeleton OK")

        # Lock the first joint
        self.robot.joints[0].set_actuator_type(pydart.joint.Joint.LOCKED)

        # Move bit lower (for camera)
        positions = self.robot.positions()
        positions["rootJoint_pos_z"] = -0.6
        self.robot.set_positions(positions)
        self.start = np.array([body.C for body in self.robot.bodynodes])

        # Initialize the controller
        self.controller = GravityCompensationController(self.robot)
        self.robot.set_controller(self.controller)
        print("create controller OK")

    def on_key_press(self, key: str) -> None:
        """G switches the compensation on or off."""
        if key == "G":
            self.controller.enabled = not self.controller.enabled

    def draw_with_ri(self, ri: Any) -> None:
        """Time and state in the corner of the picture."""
        ri.set_color(0, 0, 0)
        ri.draw_text([20, 40], f"time = {self.t:.4f}s")
        ri.draw_text([20, 70], f"Gravity Compensation = {'ON' if self.controller.enabled else 'OFF'}")


def check(world: MyWorld) -> Mapping[str, bool]:
    """No body moves by more than 1 mm in 2 s, sampled twenty times a second."""
    most = 0.0
    for frame in range(1, world.nframes, 50):
        world.set_frame(frame)
        moved = np.array([body.C for body in world.robot.bodynodes]) - world.start
        most = max(most, float(np.linalg.norm(moved, axis=1).max()))
    return {f"no body moves by more than {1e3 * most:.4f} mm": most < 1e-3}


if __name__ == "__main__":
    args = arguments()
    print("Example: gravity compensation")

    pydart.init()
    print("pydart initialization OK")

    world = MyWorld()

    if args.headless:
        rehearse(world, args, steps=2000, check=lambda: check(world), camera=None)
    else:
        win = pydart.gui.viewer.PydartWindow(world)
        win.camera_event(1)
        win.set_capture_rate(10)
        win.run_application()
