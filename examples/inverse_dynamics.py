"""Inverse dynamics: the forces for a given motion.

The equations of motion M ddq + c = tau, read from left to right: mass matrix and bias forces give what the motors must
do for a wanted acceleration. A little feedback takes away what the time step leaves.
"""

from collections.abc import Mapping

import numpy as np
from _headless import arguments, rehearse
from numpy.typing import NDArray

import pydart2 as pydart

Array = NDArray[np.float64]
MOTION = {"l_arm_shx": -0.8, "r_arm_shx": 0.8, "l_arm_ely": 0.9, "r_arm_ely": 0.9, "back_bkz": 0.4}  # rad
PERIOD = 2.0  # s


class ComputedTorque:
    """tau = M (ddq + Kd (dq' - dq) + Kp (q' - q)) + c, where the marked ones are of the robot.

    The first term alone is inverse dynamics. The gains take away what the time step leaves; they act on accelerations,
    so that one pair suits heavy and light limbs alike.
    """

    Kp, Kd = 400.0, 40.0  # 1/s², 1/s

    def __init__(self, skel: pydart.Skeleton) -> None:
        self.skel = skel
        self.rest = np.array(skel.q)
        amplitude = pydart.SkelVector(skel=skel)  # zeros with names
        for name, value in MOTION.items():
            amplitude[name] = value
        self.amplitude = np.array(amplitude)

    def motion(self, t: float) -> tuple[Array, Array, Array]:
        """Position, velocity and acceleration at a time: out and back once in each period."""
        w = 2.0 * np.pi / PERIOD
        q = self.rest + 0.5 * (1.0 - np.cos(w * t)) * self.amplitude
        return q, 0.5 * w * np.sin(w * t) * self.amplitude, 0.5 * w**2 * np.cos(w * t) * self.amplitude

    def compute(self) -> Array:
        """For the next step."""
        skel = self.skel
        q, dq, ddq = self.motion(skel.world.t)
        wanted = ddq + self.Kd * (dq - skel.dq) + self.Kp * (q - skel.q)
        return np.asarray(skel.M @ wanted + skel.c)


def check(controller: ComputedTorque) -> Mapping[str, bool]:
    """The joints follow the motion, sampled a hundred times a second."""
    world, errors = controller.skel.world, []
    for frame in range(1, world.nframes, 10):
        world.set_frame(frame)
        errors.append(float(np.abs(controller.skel.q - controller.motion(frame * world.dt)[0]).max()))
    text = f"no joint is further than {max(errors):.5f} rad from its motion"
    return {text: max(errors) < 0.005}


if __name__ == "__main__":
    args = arguments()
    world = pydart.World(0.001)
    world.set_gravity([0.0, 0.0, -9.81])
    robot = world.add_skeleton("./data/sdf/atlas/atlas_v3_no_head.sdf")
    robot.set_root_joint_to_weld()  # the pelvis hangs in the air
    for dof in robot.dofs:
        dof.set_damping_coefficient(0.0)  # c does not hold the joints' own damping
    controller = ComputedTorque(robot)
    robot.set_controller(controller)

    if args.headless:
        rehearse(world, args, steps=2000, check=lambda: check(controller), camera=None)
    else:
        pydart.gui.viewer.launch(world, default_camera=1)
