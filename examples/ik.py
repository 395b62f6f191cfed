"""Inverse kinematics: Atlas puts its left hand on a target.

Each step moves the target by 10 degrees on a half circle; SciPy's sequential quadratic programming finds the joint
angles, with the gradient by the hand's Jacobian.
"""

from collections.abc import Mapping
from typing import Any

import numpy as np
from _headless import arguments, rehearse
from numpy.typing import NDArray
from scipy.optimize import minimize

import pydart2 as pydart
from pydart2.utils.misc import deg2rad, grad

Array = NDArray[np.float64]


class MyWorld(pydart.World):
    """Each step moves the target by 10 degrees on a half circle."""

    DEBUG = True  # Compare the gradient with a numerical one

    def __init__(self) -> None:
        super().__init__(0.001)
        self.set_gravity([0.0, 0.0, -9.81])
        print("pydart create_world OK")

        filename = "./data/sdf/atlas/atlas_v3_no_head.sdf"
        self.robot = self.add_skeleton(filename)
        self.robot.set_root_joint_to_trans_and_euler()
        print("pydart add_skeleton OK")

        self.theta = 0.0 * np.pi
        self.distances: list[float] = []
        self.update_target()
        self.solve()

        print("click step to rotate the target")

    def update_target(self) -> None:
        """On a circle before the robot, m."""
        th, r = self.theta - 0.5 * np.pi, 0.6
        x, y = r * np.cos(th) + 0.4, r * np.sin(th)
        self.target = np.array([x, y, 0.3])

    def set_params(self, x: Array) -> None:
        """All positions but the root's."""
        q = self.robot.positions()
        q[6:] = x
        self.robot.set_positions(q)

    def f(self, x: Array) -> float:
        """Half the square of the distance from the hand to the target, m²."""
        self.set_params(x)

        lhs = self.robot.body("l_hand").to_world([0.0, 0.0, 0.0])
        rhs = self.target
        return float(0.5 * np.linalg.norm(lhs - rhs) ** 2)

    def gradient(self, x: Array) -> Array:
        """The gradient of f, by the hand's Jacobian."""
        self.set_params(x)

        lhs = self.robot.body("l_hand").to_world([0.0, 0.0, 0.0])
        rhs = self.target
        J = self.robot.body("l_hand").linear_jacobian()
        g = ((lhs - rhs) @ J)[6:]

        if self.DEBUG:
            lhs = g
            rhs = grad(self.f, x, 1e-5)
            print(lhs)
            print(rhs)
            print("OK" if np.allclose(lhs, rhs) else "NG!!!!")

        return np.asarray(g)

    def solve(self) -> None:
        """Move the hand to the target.

        The original called minimize() without `options`. SciPy's default then stops as soon as f changes by less than
        1e-6 m², which leaves the hand up to 18 mm away.
        """
        x0 = self.robot.positions()[6:]
        res = minimize(self.f, x0=x0, jac=self.gradient, method="SLSQP", options={"ftol": 1e-12})
        print(f">>> theta = {self.theta:.4f}")
        print(res)
        self.distances.append(float(np.sqrt(2.0 * self.f(res.x))))

    def step(self, n: int = 1) -> None:
        """Simulate a step, then solve for the next target."""
        super().step(n)
        self.theta = (self.theta + deg2rad(10)) % np.pi
        self.update_target()
        self.solve()

    def render_with_ri(self, ri: Any) -> None:
        """The target as a ball."""
        ri.set_color(1.0, 0.0, 0.0)
        ri.render_sphere(self.target, 0.05)


def check(world: MyWorld) -> Mapping[str, bool]:
    """The hand reaches each of the 19 targets to a millimetre."""
    most = 1e3 * max(world.distances)
    return {f"the hand is at most {most:.4f} mm from its target": most < 1.0}


if __name__ == "__main__":
    args = arguments()
    print("Example: inverse kinematics")

    pydart.init()
    print("pydart initialization OK")

    world = MyWorld()

    if args.headless:
        rehearse(world, args, steps=18, check=lambda: check(world), camera=None, every=1)
    else:
        win = pydart.gui.pyqt5.window.PyQt5Window(world)
        win.scene.set_camera(1)  # Z-up Camera
        win.run()
