"""Momentum: a human in free fall waves its arms; its angular momentum stays what it is."""

import numpy as np
from _headless import arguments, rehearse

import pydart2 as pydart


class Wave:
    """Swings the shoulders to and fro."""

    def __init__(self, skel: pydart.Skeleton) -> None:
        self.skel = skel

    def compute(self) -> object:
        """Forces, N m."""
        tau = np.zeros(self.skel.ndofs)
        tau[self.skel.dof_indices(["j_bicep_left_z", "j_bicep_right_z"])] = 2.0 * np.sin(10.0 * self.skel.world.t)
        return tau


if __name__ == "__main__":
    args = arguments()
    world = pydart.World(1e-4, "./data/skel/fullbody1.skel")
    human = world.skeletons[1]
    human.set_positions({"j_pelvis_pos_y": 3.0})
    human.set_velocities({"j_pelvis_rot_z": 1.0})
    human.set_controller(Wave(human))
    before = human.centroidal_momentum()

    def check() -> dict[str, bool]:
        """Gravity does not turn a body."""
        change = np.abs(human.centroidal_momentum() - before)[:3].max() / np.abs(before[:3]).max()
        return {f"angular momentum changes by {100.0 * change:.3f} %": change < 1e-2}

    if args.headless:
        rehearse(world, args, steps=1000, check=check)
    else:
        pydart.gui.viewer.launch(world)
