"""Balance: a pole on a cart is held upright by a regulator from `world.linearize()`, and pushed."""

import numpy as np
from _headless import arguments, rehearse
from scipy.linalg import solve_discrete_are

import pydart2 as pydart

world = pydart.World(0.002, up="z")
cart_pole = world.add_empty_skeleton("cart_pole")
cart_pole.add_body("cart", joint="prismatic", axis=(1, 0, 0)).add_box((0.3, 0.2, 0.1), mass=1.0)
pole = cart_pole.add_body("pole", "cart", "revolute", axis=(0, 1, 0))
pole.add_box((0.03, 0.03, 0.8), mass=0.2, position=(0, 0, 0.4), collides=False)

A, B = world.linearize()
B, R = B * [1.0, 0.0], 0.1 * np.eye(2)  # no motor turns the pole
P = solve_discrete_are(A, B, np.diag([10.0, 100.0, 1.0, 1.0]), R)
K = np.linalg.solve(R + B.T @ P @ B, B.T @ P @ A)
angles: list[float] = []


def regulate() -> np.ndarray:
    """The force on the cart; at 1 s somebody pushes the pole for 50 ms."""
    pole.add_ext_force([2.0 if 1.0 <= world.t < 1.05 else 0.0, 0.0, 0.0], [0.0, 0.0, 0.8])
    angles.append(float(np.rad2deg(abs(cart_pole.q[1]))))
    return np.asarray(-K @ np.concatenate([cart_pole.q, cart_pole.dq]))


def check() -> dict[str, bool]:
    """It leans, and stands again."""
    return {f"it leans by {max(angles):.1f} degrees, then {angles[-1]:.3f}": angles[-1] < 0.05 < max(angles)}


if __name__ == "__main__":
    args = arguments()
    cart_pole.set_controller(regulate)
    if args.headless:
        rehearse(world, args, 4000, check, camera=None)
    else:
        pydart.gui.viewer.launch(world)
