"""Saving and restoring: try several pushes from one state, and keep the best.

A snapshot is all that the next step depends on. From the same snapshot the same happens, bit for bit, in this world and
in another one of the same model.
"""

from collections.abc import Mapping
from pathlib import Path

import numpy as np
from _headless import arguments, rehearse

import pydart2 as pydart

FORCES = np.linspace(10.0, 30.0, 9)  # N, along x, for 0.1 s
TARGET = 0.25  # m, where the cube is to come to rest


def pushed(world: pydart.World, force: float) -> float:
    """Where the last cube lies along x a second after a push."""
    cube = world.skeletons[-1]
    for i in range(1000):
        if i < 100:
            cube.bodynodes[0].add_ext_force([force, 0.0, 0.0])
        world.step()
    return float(cube.C[0])


def check(world: pydart.World, start: pydart.Snapshot, reached: Mapping[float, float]) -> Mapping[str, bool]:
    """From the same state the same happens, bit for bit, here and in a world that is loaded anew."""
    force = float(FORCES[-1])
    world.restore(start)
    again = pushed(world, force)
    other = pydart.World(0.001, "./data/skel/cubes.skel")
    other.restore(start)
    elsewhere = pushed(other, force)
    text = f"from the same state the cube ends at {reached[force]:.15f}, {again:.15f} and {elsewhere:.15f} m"
    return {text: reached[force] == again == elsewhere}


if __name__ == "__main__":
    args = arguments()
    world = pydart.World(0.001, "./data/skel/cubes.skel")
    world.step(1000)  # the cubes fall and come to rest

    start = world.snapshot()
    reached = {}
    for force in FORCES.tolist():
        world.restore(start)
        reached[force] = pushed(world, force)
        print(f"pushed with {force:.1f} N the cube ends at {reached[force]:.4f} m")
    best = min(reached, key=lambda force: abs(reached[force] - TARGET))
    print(f"{best:.1f} N comes nearest to {TARGET} m")

    if args.output is not None:
        args.output.mkdir(parents=True, exist_ok=True)
        path: Path = args.output / "save_restore.npz"
        start.save(path)  # for another process or day
        assert pydart.Snapshot.load(path) == start

    world.restore(start)
    pushed(world, best)
    if args.headless:
        camera = pydart.gui.Camera.look_at([0.25, -0.05, 0.6], [0.1, -0.3, 0.0], up=[0.0, 1.0, 0.0])
        rehearse(world, args, steps=0, check=lambda: check(world, start, reached), camera=camera)
    else:
        pydart.gui.viewer.launch(world)
