"""Clones of worlds with several skeletons of one source: it is read once, and each has its own of everything."""

from __future__ import annotations

import pickle
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import pydart2
from physics.models import box, creature, free_body, make_world

COUNT = 3
SIZES = ("size", "radius", "height", "scale")


def read(skel: pydart2.Skeleton) -> list[object]:
    """What a model is, but for its name and its state."""
    found: list[object] = [
        (dof.name, dof.position_lower_limit(), dof.position_upper_limit(), dof.damping_coefficient())
        for dof in skel.dofs
    ]
    for body in skel.bodynodes:
        markers = [(marker.name, marker.local_position().tolist()) for marker in body.markers]
        found.append((body.name, body.m, body.I.tolist(), body.friction_coeff(), markers))
        for node in body.shapenodes:
            sizes = [np.asarray(getattr(node.shape, name)()).tolist() for name in SIZES if hasattr(node.shape, name)]
            color = np.asarray(node.visual_aspect_rgba()).tolist()  # None where it is not drawn
            found.append((node.name, type(node.shape), sizes, color))
            found.append((node.relative_transform().tolist(), node.has_collision_aspect()))
    return found


def change(skel: pydart2.Skeleton, by: float) -> None:
    """Something of each kind."""
    skel.dofs[-1].set_damping_coefficient(by)
    for body in skel.bodynodes:
        body.set_mass(body.m * (1.0 + by))
        body.set_friction_coeff(by)
        for node in body.shapenodes:
            if node.has_visual_aspect():
                node.set_visual_aspect_rgba([by, 0.0, 0.0, 1.0])
            for name in SIZES:
                if hasattr(node.shape, f"set_{name}"):
                    getattr(node.shape, f"set_{name}")((1.0 + by) * getattr(node.shape, name)())


@pytest.mark.parametrize("make", [lambda world: world.clone(), lambda world: pickle.loads(pickle.dumps(world))])
@pytest.mark.parametrize("model", ["atlas", "creature", "box", "softBodies"])
def test_each_has_its_own(tmp_path: Path, model: str, make: Callable[[pydart2.World], pydart2.World]) -> None:
    source = {"atlas": "sdf/atlas/atlas_v3_no_head.sdf", "softBodies": "skel/softBodies.skel"}.get(model)
    if source is None:
        parts = creature() if model == "creature" else free_body(shape=box((1, 1, 1)))
        make_world(tmp_path, parts)
        source = str(tmp_path / "model.skel")
    world = pydart2.World(0.001)
    for i in range(COUNT):
        change(world.add_skeletons(source)[-1], 0.1 * i)
    before = [read(skel) for skel in world.skeletons]
    copied = make(world)
    assert [read(skel) for skel in copied.skeletons] == before
    assert [skel.name for skel in copied.skeletons] == [skel.name for skel in world.skeletons]
    change(copied.skeletons[1], 0.7)
    after = [read(skel) for skel in copied.skeletons]
    assert after[1] != before[1]
    assert [*after[:1], *after[2:]] == [*before[:1], *before[2:]]
    assert [read(skel) for skel in world.skeletons] == before
    world.destroy()
    assert [read(skel) for skel in copied.skeletons] == after
