"""Worlds in the middle of a motion, and their bits."""

from __future__ import annotations

from pathlib import Path

import numpy as np

import pydart2
from oracle.models import dart_model

DETECTORS = (0, 1, 2, 3, 10)
MODELS = ("fullbody1", "soft_cubes")


def path_of(model: str) -> Path:
    return Path(
        dart_model("skel/soft_cubes.skel") if model == "soft_cubes" else pydart2.data_path(f"skel/{model}.skel")
    )


def moving(model: str, detector: int) -> pydart2.World:
    """A world in the middle of a motion with contacts, and forces that wait for the next step."""
    world = pydart2.World(0.001, path_of(model))
    world.set_collision_detector(detector)
    world.set_recording(False)
    world.step(100)
    for skel in world.skeletons:
        skel.tau = np.linspace(-1, 1, skel.ndofs)
        skel.bodynodes[-1].add_ext_force([0.5, 0.25, 0.125])
    return world


def bits(world: pydart2.World) -> bytes:
    return world.snapshot().values.tobytes() + world.collision_result.rows.tobytes()
