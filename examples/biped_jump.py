"""Biped jump: forces by the Jacobian transpose.

A force f at a body costs the joints the forces J^T f. The controller tracks a crouch and a swing of the arms by stable
PD control, and from 0.3 s to 0.5 s presses the heels down with 700 N each.
"""

from collections.abc import Mapping, Sequence

import numpy as np
from _headless import arguments, rehearse
from numpy.typing import ArrayLike, NDArray

import pydart2 as pydart

Array = NDArray[np.float64]


class JTController:
    """Generalized forces that act like a force on bodies.

    >>> jt = JTController(skel)
    >>> tau += jt.apply(["l_hand", "r_hand"], f)
    """

    def __init__(self, skel: pydart.Skeleton) -> None:
        self.skel = skel

    def apply(self, bodynames: Sequence[str], f: ArrayLike) -> Array:
        """Of a force at the origin of each body, world frame, N."""
        tau = np.zeros(self.skel.ndofs)
        for bodyname in bodynames:
            J = self.skel.body(bodyname).linear_jacobian()
            tau += J.T @ np.asarray(f)
        return tau


class Controller:
    """Tracks three poses by stable PD control, and pushes off from 0.3 s to 0.5 s."""

    def __init__(self, skel: pydart.Skeleton, h: float) -> None:
        self.h = h
        self.skel = skel
        ndofs = self.skel.ndofs
        self.qhat = self.skel.q
        self.Kp = np.diagflat([0.0] * 6 + [600.0] * (ndofs - 6))
        self.Kd = np.diagflat([0.0] * 6 + [40.0] * (ndofs - 6))
        self.init_target_poses()
        self.jt = JTController(self.skel)

    def init_target_poses(self) -> None:
        """Crouch, swing the arms, land."""
        skel = self.skel
        thigh = skel.dof_indices(["j_thigh_left_z", "j_thigh_right_z"])
        shin = skel.dof_indices(["j_shin_left", "j_shin_right"])
        heel = skel.dof_indices(["j_heel_left_1", "j_heel_right_1"])

        pose0 = skel.q
        pose0[thigh] = 1.2
        pose0[shin] = -2.0
        pose0[heel] = 0.8
        pose0["j_bicep_left_y", "j_bicep_right_y"] = 0.5, -0.5

        pose1 = skel.q
        pose1["j_bicep_left_y", "j_bicep_right_y"] = -2.0, 2.0
        pose1["j_bicep_left_x", "j_bicep_right_x"] = 0.5, -0.5

        pose2 = skel.q
        pose2[thigh] = 0.3

        self.target_poses = [pose0, pose1, pose2]
        self.target_times = [0.0, 0.4, 0.8]

    def update_target_pose(self) -> None:
        """Go on to the next pose when its time has come."""
        if self.target_times and self.target_times[0] <= self.skel.world.t:
            self.qhat = self.target_poses.pop(0)
            self.target_times.pop(0)
            print(f"update pose! at {self.skel.world.t:.4f}")

    def compute(self) -> Array:
        """Stable PD forces (Tan, Liu, Turk, IEEE CG&A 31(4), 2011), and the push."""
        self.update_target_pose()
        skel = self.skel

        p = -self.Kp @ (skel.q + skel.dq * self.h - self.qhat)
        d = -self.Kd @ skel.dq
        qddot = np.linalg.solve(skel.M + self.Kd * self.h, -skel.c + p + d + skel.constraint_forces())
        tau = np.asarray(p + d - self.Kd @ qddot * self.h)

        if 0.3 < skel.world.t < 0.5:  # Jump!
            tau += self.jt.apply(["h_heel_left", "h_heel_right"], [0, -700, 0])

        tau[:6] = 0.0  # the root has no motors
        return tau


def check(world: pydart.World) -> Mapping[str, bool]:
    """The feet leave the ground: for a while nothing touches it, and the body rises by what that time gives."""
    assert world.recording is not None
    human = world.skeletons[1]
    free = [frame for frame in range(600, world.nframes) if not world.recording.contacts(frame).num_contacts()]
    height = [human.C[1] for frame in (1, *free) if world.set_frame(frame)]
    return {
        f"nothing touches the ground for {len(free) * world.dt:.2f} s": len(free) * world.dt > 0.3,
        f"the centre of mass rises by {max(height) - height[0]:.2f} m": max(height) - height[0] > 0.2,
    }


if __name__ == "__main__":
    args = arguments()
    print("Example: bipedJump")

    pydart.init()
    print("pydart initialization OK")

    world = pydart.World(1.0 / 2000.0, "./data/skel/fullbody1.skel")
    print("pydart create_world OK")

    # Initialize the pose
    skel = world.skeletons[1]
    q = skel.q
    q[2, 4, 5] = [0.02 * np.pi, -0.02, 0]
    skel.set_positions(q)
    print("skeleton position OK")

    # Initialize the controller
    skel.set_controller(Controller(skel, world.dt))
    print("create controller OK")

    if args.headless:
        rehearse(world, args, steps=2600, check=lambda: check(world))
    else:
        pydart.gui.viewer.launch(world)
