"""Many worlds at once: how far a cube slides, for many frictions.

Each world has a thread of its own, and all processors have work. The distances are v^2 / (2 mu g), and the same as one
after another, bit for bit.
"""

import os
from collections.abc import Mapping
from concurrent.futures import ThreadPoolExecutor

import numpy as np
from _headless import arguments, finish

import pydart2 as pydart
from pydart2.utils.progress import progress

SPEED = 1.0  # m/s
FRICTIONS = np.linspace(0.2, 1.0, 33)


def slide(friction: float) -> float:
    """How far a cube slides that starts with SPEED, m.

    A world belongs to one thread at a time, and different worlds may step in different threads: step() lets go of the
    interpreter, so that they do run at the same time.
    """
    world = pydart.World(0.001, "./data/skel/cubes.skel")
    for skel in world.skeletons[2:]:
        world.remove_skeleton(skel)
    for skel in world.skeletons:
        skel.bodynodes[0].set_friction_coeff(friction)
    world.disable_recording()
    world.step(1000)  # it falls and lies still
    cube = world.skeletons[1]
    start = cube.C[0]
    cube.set_velocities({name: SPEED for name in cube.dq.keys if name.endswith("pos_x")})
    world.step(1000)
    return float(cube.C[0] - start)


def check(distances: list[float]) -> Mapping[str, bool]:
    """v² / (2 µ g), and the same without threads, bit for bit."""
    expected = SPEED**2 / (2.0 * FRICTIONS * 9.81)
    error = float(np.abs(distances / expected - 1.0).max())
    return {
        f"the distances differ by {100 * error:.2f} % from v² / (2 µ g)": error < 0.02,
        "one after another they are the same": [slide(mu) for mu in FRICTIONS[::8]] == distances[::8],
    }


if __name__ == "__main__":
    args = arguments()
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        results = progress(pool.map(slide, FRICTIONS), "many_worlds", unit="world", total=len(FRICTIONS))
        distances = list(results)
    for friction, distance in zip(FRICTIONS[::8], distances[::8], strict=True):
        print(f"with friction {friction:.1f} the cube slides {distance:.4f} m")
    finish(args, 0, lambda: check(distances))
