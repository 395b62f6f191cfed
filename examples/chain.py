"""Chain: a basic controller.

A controller is any object with compute(), which returns the generalized forces of the next step. This one damps a
swinging chain of ball joints, so that its energy falls all the time.
"""

from collections.abc import Mapping

import numpy as np
from _headless import arguments, rehearse
from numpy.typing import NDArray

import pydart2 as pydart


class DampingController:
    """Adds damping to the skeleton."""

    def __init__(self, skel: pydart.Skeleton) -> None:
        self.skel = skel

    def compute(self) -> NDArray[np.float64]:
        """Against the velocity, and a tenth of it about each second axis."""
        damping = -0.01 * self.skel.dq
        damping[1::3] *= 0.1
        return damping


def energy(skel: pydart.Skeleton) -> float:
    """Kinetic and potential energy, J; gravity is along -y."""
    height = sum(body.m * body.C[1] for body in skel.bodynodes)
    return float(0.5 * skel.dq @ skel.M @ skel.dq - skel.world.g[1] * height)


def check(skel: pydart.Skeleton) -> Mapping[str, bool]:
    """The damping takes energy all the time, sampled ten times a second."""
    world = skel.world
    energies = [energy(skel) for frame in range(1, world.nframes, 500) if world.set_frame(frame)]
    text = f"the energy falls from {energies[0]:.3f} J to {energies[-1]:.3f} J, and never rises"
    return {text: bool(np.all(np.diff(energies) < 0.0))}


if __name__ == "__main__":
    args = arguments()
    pydart.init(verbose=True)
    print("pydart initialization OK")

    world = pydart.World(1.0 / 5000.0, "./data/skel/chain.skel")
    print("pydart create_world OK")

    skel = world.skeletons[0]
    skel.q = np.random.rand(skel.ndofs) - 0.5
    print(f"init pose = {skel.q}")
    skel.controller = DampingController(skel)

    if args.headless:
        camera = pydart.gui.Camera.look_at([0.2, 0.0, 0.9], [0.0, -0.1, 0.0], up=[0.0, 1.0, 0.0])
        rehearse(world, args, steps=15000, check=lambda: check(skel), camera=camera)
    else:
        pydart.gui.viewer.launch(world)
