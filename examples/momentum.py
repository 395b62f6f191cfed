"""Momentum: a human in free fall waves its arms; its angular momentum stays what it is."""

import numpy as np
from _headless import arguments, rehearse

import pydart2 as pydart

if __name__ == "__main__":
    args = arguments()
    world = pydart.World(1e-4, "./data/skel/fullbody1.skel")
    human = world.skeletons[1]
    human.set_positions({"j_pelvis_pos_y": 3.0})
    human.set_velocities({"j_pelvis_rot_z": 1.0})
    arms = human.dof_indices(["j_bicep_left_z", "j_bicep_right_z"])
    before = human.centroidal_momentum()

    def wave() -> np.ndarray:
        """Forces that swing the shoulders to and fro, N m."""
        tau = np.zeros(human.ndofs)
        tau[arms] = 2.0 * np.sin(10.0 * world.t)
        return tau

    human.set_controller(wave)

    def check() -> dict[str, bool]:
        """Gravity does not turn a body."""
        change = np.abs(human.centroidal_momentum() - before)[:3].max() / np.abs(before[:3]).max()
        return {f"angular momentum changes by {100.0 * change:.3f} %": change < 1e-2}

    if args.headless:
        rehearse(world, args, steps=1000, check=check, camera=None)
    else:
        pydart.gui.viewer.launch(world)
