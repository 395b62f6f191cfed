"""Contacts and forces: what carries a cube, and how hard one must push to move it.

The ground carries the weight in four contacts. By Coulomb's law friction takes a push of up to its coefficient times
the weight; what is more accelerates the cube.
"""

from collections.abc import Mapping
from functools import partial

import numpy as np
from _headless import arguments, rehearse
from numpy.typing import NDArray

import pydart2 as pydart

FRICTION = 0.5
PUSHES = {"gentle": 0.4, "hard": 0.8}  # over the cube's weight
REST, PUSH = 1000, 200  # steps before the push, and of the push


def contact_force(skel: pydart.Skeleton) -> NDArray[np.float64]:
    """The sum of all contact forces on a skeleton, world frame, N."""
    total = np.zeros(3)
    for contact in skel.world.collision_result.contacts:
        # `force` acts on the first body; the second one gets the opposite
        if contact.skel_id1 == skel.id:
            total += contact.force
        if contact.skel_id2 == skel.id:
            total -= contact.force
    return total


class PushedCube(pydart.World):
    """The lowest cube alone, which lies still and is then pushed along x."""

    def __init__(self, push: float) -> None:
        super().__init__(0.001, "./data/skel/cubes.skel")
        for skel in self.skeletons[2:]:
            self.remove_skeleton(skel)
        self.cube = self.skeletons[1]
        for skel in self.skeletons:
            skel.bodynodes[0].set_friction_coeff(FRICTION)
        self.weight = -self.cube.m * self.g[1]
        self.force = np.array([push * self.weight, 0.0, 0.0])

    def on_step_event(self) -> None:
        """Push at the height of the ground, so that the cube slides and does not tip."""
        if REST <= self.frame < REST + PUSH:
            self.cube.bodynodes[0].add_ext_force(self.force, _offset=[0.0, -0.025, 0.0])

    def carried(self) -> NDArray[np.float64]:
        """What the ground gives the cube while it lies still, N."""
        self.set_frame(REST)
        return contact_force(self.cube)

    def speed(self) -> float:
        """Along x at the end of the push, m/s."""
        self.set_frame(REST + PUSH)
        return float(self.cube.dC[0])


def check(world: PushedCube, push: float) -> Mapping[str, bool]:
    """The ground carries the weight; friction takes up to FRICTION times that, and the rest accelerates the cube."""
    carried = world.carried()
    expected = max(0.0, push - FRICTION) * 9.81 * PUSH * world.dt
    speed = world.speed()
    return {
        f"the ground carries {carried[1]:.4f} N of {world.weight:.4f} N": abs(carried[1] / world.weight - 1.0) < 1e-3,
        f"after the push the cube slides with {speed:.4f} m/s, by Coulomb's law {expected:.4f} m/s": (
            abs(speed - expected) < 0.02 * max(expected, 0.1)
        ),
    }


if __name__ == "__main__":
    args = arguments()
    for name, push in PUSHES.items():
        world = PushedCube(push)
        world.step(REST)
        print(f"{name} push of {world.force[0]:.2f} N on a cube of {world.weight:.2f} N with friction {FRICTION}")
        for contact in world.collision_result.contacts:
            print(f"    contact at {contact.point} with force {contact.force}, {1e3 * contact.depth:.3f} mm deep")
        world.reset()
        if args.headless:
            camera = pydart.gui.Camera.look_at([0.25, -0.1, 0.55], [0.0, -0.33, 0.0], up=[0.0, 1.0, 0.0])
            rehearse(world, args, REST + PUSH, partial(check, world, push), camera)
        else:
            pydart.gui.viewer.launch(world, title=f"A {name} push")
