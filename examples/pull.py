"""Pulling: lift a robot by a spring.

In the window the right mouse button pulls any body while the simulation plays. The key P pulls the chest half a metre
upwards, until the robot hangs in the air and the spring is as long as the weight makes it.
"""

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from _headless import arguments, rehearse

import pydart2 as pydart
from pydart2.gui.pull import STIFFNESS, Pull


class Standing(pydart.World):
    """Atlas stands on the ground with a spring in each joint; the key P starts and ends a pull at its chest."""

    def __init__(self) -> None:
        scene = json.loads(Path(pydart.data_path("sdf/atlas/standing.json")).read_text(encoding="ascii"))
        super().__init__(scene["time_step"], pydart.data_path(scene["world"]))
        self.pull: Pull | None = None
        self.robot = self.add_skeleton(pydart.data_path(scene["robot"]))
        self.robot.set_positions(scene["q"])
        for dof in self.robot.dofs[6:]:
            dof.set_spring_stiffness(scene["stiffness"])
            dof.set_rest_position(dof.position())
            dof.set_damping_coefficient(scene["damping"])

    def on_key_press(self, key: str) -> None:
        """P pulls the chest half a metre upwards, or lets go."""
        if key == "P" and self.pull is None:
            chest = self.robot.body("utorso")
            self.pull = Pull(chest, chest.C)
            self.pull.target[1] += 0.5
        elif key == "P":
            self.pull = None

    def on_step_event(self) -> None:
        """The spring acts in one step, as every force."""
        if self.pull is not None:
            self.pull.apply()

    def render_with_ri(self, ri: Any) -> None:
        """The spring as an arrow."""
        if self.pull is not None:
            ri.set_color(0.2, 0.45, 0.95)
            ri.render_arrow(self.pull.point, self.pull.target, r_base=0.015, head_width=0.04, head_len=0.08)


def check(world: Standing) -> Mapping[str, bool]:
    """It hangs in the air, and the spring is as long as the weight makes it: m g / k."""
    assert world.pull is not None
    stretch = float(np.linalg.norm(world.pull.target - world.pull.point))
    contacts = world.collision_result.num_contacts()
    return {
        f"the robot hangs from the spring, {contacts} contacts with the ground": contacts == 0,
        f"the spring is {stretch:.4f} m long, by the weight {9.81 / STIFFNESS:.4f} m": (
            abs(stretch - 9.81 / STIFFNESS) < 0.005
        ),
    }


if __name__ == "__main__":
    args = arguments()
    world = Standing()

    print("right drag: pull a body, while it plays")
    print("    'P': pull the chest upwards, or let go")
    if args.headless:
        camera = pydart.gui.Camera.look_at([2.5, 1.0, 3.5], [0.0, 0.3, 0.0], up=[0.0, 1.0, 0.0])
        rehearse(world, args, steps=3000, check=lambda: check(world), camera=camera, keys={200: "P"})
    else:
        pydart.gui.viewer.launch(world)
