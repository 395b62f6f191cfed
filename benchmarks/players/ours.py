"""This project as a competitor."""

from __future__ import annotations

import os
from typing import Any

import numpy as np
from questions import play

import pydart2


class Model:
    """A scene in pydart2."""

    def __init__(self, scene: dict[str, Any]) -> None:
        self.world = world = pydart2.World(scene["dt"], scene["world"])
        world.set_gravity([0.0, scene["gravity"], 0.0])
        world.set_constraint_solver(os.environ.get("PYDART2_SOLVER", "dart"))
        world.set_recording(False)
        if detector := os.environ.get("BENCH_DETECTOR"):
            world.set_collision_detector(detector)
        if scene["robot"]:
            world.add_skeleton(scene["robot"])
        self.skel = skel = max(world.skeletons, key=lambda s: s.ndofs)
        self.body = skel.bodynodes[-1]
        if scene["q"]:
            skel.q = scene["q"]
        if scene["stiffness"]:
            for dof in skel.dofs[6:]:
                dof.set_spring_stiffness(scene["stiffness"])
                dof.set_rest_position(dof.position())
                dof.set_damping_coefficient(scene["damping"])
        self.step, self.states, self.set_states = world.step, world.states, world.set_states
        self.num_dofs = skel.num_dofs
        self.variants = {
            "recording off": lambda: world.set_recording(False),
            "recording on": lambda: world.set_recording(True),
        }

    def q(self) -> Any:
        return self.skel.q

    def dq(self) -> Any:
        return self.skel.dq

    def M(self) -> Any:
        return self.skel.M

    def c(self) -> Any:
        return self.skel.c

    def J(self) -> Any:
        return self.body.J

    def T(self) -> Any:
        return self.body.T

    def C(self) -> Any:
        return self.skel.C

    def contacts(self) -> Any:
        result = self.world.collision_result
        result.update()  # as after a step
        return result.rows

    def contact_objects(self) -> Any:
        result = self.world.collision_result
        result.update()
        return [(contact.point, contact.force) for contact in result.contacts]

    def set_q(self, q: Any) -> None:
        self.skel.q = q

    def set_tau(self, tau: Any) -> None:
        self.skel.tau = tau


if __name__ == "__main__":
    np.seterr(all="raise")
    play(Model)
