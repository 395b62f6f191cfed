"""Biped stand: balance control and callbacks of the window.

The humanoid holds a pose by stable PD control and shifts its weight by ankles and toes. The keys 1 and 2 push it with
50 N, forward and backward. Without a window they are pressed at 1.5 s and at 3.5 s.
"""

from collections.abc import Mapping
from typing import Any

import numpy as np
from _headless import arguments, rehearse
from numpy.typing import NDArray

import pydart2 as pydart

Array = NDArray[np.float64]


class Controller:
    """Holds a pose by stable PD control, and shifts the weight with ankles and toes."""

    def __init__(self, skel: pydart.Skeleton, h: float) -> None:
        self.h = h
        self.skel = skel
        ndofs = self.skel.ndofs
        self.qhat = self.skel.q
        self.Kp = np.diagflat([0.0] * 6 + [400.0] * (ndofs - 6))
        self.Kd = np.diagflat([0.0] * 6 + [40.0] * (ndofs - 6))
        self.preoffset = 0.0

    def compute(self) -> Array:
        """Stable PD forces (Tan, Liu, Turk, IEEE CG&A 31(4), 2011), and the balance."""
        skel = self.skel

        p = -self.Kp @ (skel.q + skel.dq * self.h - self.qhat)
        d = -self.Kd @ skel.dq
        qddot = np.linalg.solve(skel.M + self.Kd * self.h, -skel.c + p + d + skel.constraint_forces())
        tau = np.asarray(p + d - self.Kd @ qddot * self.h)

        # Check the balance: how far the centre of mass is before the middle of the foot
        COP = skel.body("h_heel_left").to_world([0.05, 0, 0])
        offset = skel.C[0] - COP[0]
        if 0.0 < offset < 0.1:
            self.balance(tau, offset, 200.0, 100.0, 10.0)
        elif -0.2 < offset < -0.05:
            self.balance(tau, offset, 2000.0, 100.0, 100.0)

        tau[:6] = 0.0  # the root has no motors
        return tau

    def balance(self, tau: Array, offset: float, k1: float, k2: float, kd: float) -> None:
        """Press the toes or the heels down, as DART's own bipedStand does."""
        foot = self.skel.dof_indices(["j_heel_left_1", "j_toe_left", "j_heel_right_1", "j_toe_right"])
        k = np.array([-k1, -k2, -k1, -k2])
        tau[foot] += k * offset + kd * (self.preoffset - offset)
        self.preoffset = offset


class MyWorld(pydart.World):
    """A world with a humanoid that keys push."""

    def __init__(self) -> None:
        self.force: Array | None = None
        self.duration = 0
        super().__init__(1.0 / 2000.0, "./data/skel/fullbody1.skel")

    def on_step_event(self) -> None:
        """Push as long as the push lasts."""
        if self.force is not None and self.duration >= 0:
            self.duration -= 1
            self.skeletons[1].body("h_spine").add_ext_force(self.force)

    def on_key_press(self, key: str) -> None:
        """Start a push of 0.05 s."""
        if key == "1":
            self.force = np.array([50.0, 0.0, 0.0])
            self.duration = 100
            print(f"push forward: f = {self.force}")
        elif key == "2":
            self.force = np.array([-50.0, 0.0, 0.0])
            self.duration = 100
            print(f"push backward: f = {self.force}")

    def render_with_ri(self, ri: Any) -> None:
        """The push as an arrow."""
        if self.force is not None and self.duration >= 0:
            p0 = self.skeletons[1].body("h_spine").C
            p1 = p0 + 0.01 * self.force
            ri.set_color(1.0, 0.0, 0.0)
            ri.render_arrow(p0, p1, r_base=0.05, head_width=0.1, head_len=0.1)


PUSHES = {3000: "1", 7000: "2"}  # step: key, for the run without a window


def check(world: pydart.World) -> Mapping[str, bool]:
    """It feels both pushes, never goes down, and stands still in the end."""
    human = world.skeletons[1]
    height, speed = [], []
    for frame in range(2900, world.nframes, 20):
        world.set_frame(frame)
        height.append(human.C[1])
        speed.append(human.dC[0])
    before = (3000 - 2900) // 20, (7000 - 2900) // 20  # index of each push
    forward, backward = max(speed[before[0] :]), min(speed[before[1] :])
    return {
        f"it sways with {forward:.3f} m/s, and with {backward:.3f} m/s": forward > 0.03 and backward < -0.03,
        f"its centre of mass sinks by {height[0] - min(height):.3f} m": height[0] - min(height) < 0.03,
        f"in the end it moves with {abs(speed[-1]):.4f} m/s": abs(speed[-1]) < 0.01,
    }


if __name__ == "__main__":
    args = arguments()
    print("Example: bipedStand")

    pydart.init()
    print("pydart initialization OK")

    world = MyWorld()
    print("MyWorld  OK")

    # Use SkelVector to configure the initial pose
    skel = world.skeletons[1]
    q = skel.q
    q["j_pelvis_pos_y"] = -0.05
    q["j_pelvis_rot_y"] = -0.2
    q["j_thigh_left_z", "j_shin_left", "j_heel_left_1"] = 0.15, -0.4, 0.25
    q["j_thigh_right_z", "j_shin_right", "j_heel_right_1"] = 0.15, -0.4, 0.25
    q["j_abdomen_2"] = 0.0
    skel.set_positions(q)
    print("skeleton position OK")

    # Initialize the controller
    skel.set_controller(Controller(skel, world.dt))
    print("create controller OK")

    print("'1'--'2': programmed interaction")
    print("    '1': push forward")
    print("    '2': push backward")
    if args.headless:
        rehearse(world, args, steps=12000, check=lambda: check(world), keys=PUSHES)
    else:
        pydart.gui.viewer.launch(world)
