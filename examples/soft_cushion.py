"""A soft cushion, built in code: a rigid ball lands on it, sinks in, and comes to rest on its skin."""

import numpy as np
from _headless import arguments, rehearse

import pydart2 as pydart

world = pydart.World(0.001, up="z")
world.add_ground()
world.add_soft_box([0.4, 0.4, 0.2], 3.0, [0.0, 0.0, 0.1], cells=(6, 6, 3), stiffness=800.0, edge_stiffness=100.0)
ball = world.add_sphere(0.06, 1.0, [0.0, 0.0, 0.4], color=[0.9, 0.4, 0.1])
carried: list[float] = []


class Watch:
    """Nothing pushes the ball; it is only looked at."""

    def compute(self) -> np.ndarray:
        """No force; what the cushion did in the last step is noted."""
        carried.append(float(ball.bodynodes[0].contact_force()[2]))
        return np.zeros(6)


def check() -> dict[str, bool]:
    """In the last second the cushion carries the ball, which has made a dent."""
    force, weight, dent = float(np.mean(carried[-1000:])), 9.81, 0.26 - float(ball.C[2])
    return {
        f"the cushion carries {force:.2f} N of {weight:.2f} N": abs(force - weight) < 0.01 * weight,
        f"the ball sinks in by {1e3 * dent:.0f} mm": 0.005 < dent < 0.1,
    }


if __name__ == "__main__":
    args = arguments()
    ball.set_controller(Watch())
    if args.headless:
        rehearse(world, args, 3000, check, camera=None)
    else:
        pydart.gui.viewer.launch(world)
