"""Many worlds at once: how far a cube slides, for many frictions.

A batch of copies of one world steps on all processors. The distances are v^2 / (2 mu g), and those of a world that is
alone, bit for bit.
"""

from collections.abc import Mapping

import numpy as np
from _headless import arguments, finish

import pydart2 as pydart
from pydart2.utils.progress import progress

SPEED = 1.0  # m/s
FRICTIONS = np.linspace(0.2, 1.0, 33)


def cube_on_the_ground() -> pydart.World:
    """One cube that has fallen and lies still."""
    world = pydart.World(0.001, "./data/skel/cubes.skel")
    for skel in world.skeletons[2:]:
        world.remove_skeleton(skel)
    world.disable_recording()
    world.step(1000)
    return world


def slide(frictions: np.ndarray) -> np.ndarray:
    """How far the cube slides that starts with SPEED, m, for each friction."""
    batch = pydart.Batch(cube_on_the_ground(), len(frictions), skeleton=1)
    batch.set_friction(0, frictions)
    start = batch.C[:, 0]
    batch.dq = {"joint 1_pos_x": SPEED}
    for _ in progress(range(100), "many_worlds"):
        batch.step(10)
    return np.asarray(batch.C[:, 0] - start)


def check(distances: np.ndarray) -> Mapping[str, bool]:
    """v² / (2 µ g), and what a world alone gives, bit for bit."""
    expected = SPEED**2 / (2.0 * FRICTIONS * 9.81)
    error = float(np.abs(distances / expected - 1.0).max())
    return {
        f"the distances differ by {100 * error:.2f} % from v² / (2 µ g)": error < 0.02,
        "each is that of a world alone": all(slide(FRICTIONS[i : i + 1])[0] == distances[i] for i in (0, 16, 32)),
    }


if __name__ == "__main__":
    args = arguments()
    distances = slide(FRICTIONS)
    for friction, distance in zip(FRICTIONS[::8], distances[::8], strict=True):
        print(f"with friction {friction:.1f} the cube slides {distance:.4f} m")
    finish(args, 0, lambda: check(distances))
