"""DART's own models, all that the engine loads: the same numbers here and in dartpy, from random states."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import pydart2
from oracle.compare import assert_same_frame
from oracle.dartpy_oracle import DartpyOracle
from oracle.models import dart_data

# What the engine itself cannot load or step.
REFUSED = {
    "sdf/atlas/atlas_v3.urdf": "its meshes are in a package that is not there",
    "skel/kima/kima_human_left_leg.skel": "aborts the engine",
    "skel/test/test_double_pendulum.skel": "crashes the engine",
    "skel/test/test_single_body.skel": "crashes the engine",
    "skel/test/test_single_pendulum.skel": "crashes the engine",
    "urdf/drchubo/drchubo.urdf": "its meshes are in a package that has to be named",
    "urdf/test/invalid.urdf": "not a model",
    "urdf/test/invalid_mesh.urdf": "its mesh is not one",
    "urdf/test/missing_mesh.urdf": "its mesh is not there",
    "urdf/test/missing_package.urdf": "its package is not there",
    "urdf/test/testWorld.urdf": "a world",
    "urdf/wam/wam.urdf": "its meshes are in a package that is not there",
}
STEPS = (0, 1, 20)


def model_names() -> list[str]:
    """SKEL worlds, and URDF and SDF skeletons; skel_old/ is of a format that DART 6 no longer reads."""
    root = dart_data()
    files = (path for path in sorted(root.rglob("*")) if path.suffix in (".skel", ".urdf", ".sdf"))
    names = [str(path.relative_to(root)) for path in files if not (path.suffix == ".sdf" and holds_world(path))]
    return [name for name in names if name not in REFUSED and not name.startswith("skel_old/")]


def holds_world(path: Path) -> bool:
    """Whether an SDF file is a world."""
    return "<world" in path.read_text()


def load(path: Path) -> pydart2.World:
    """The world that the oracle makes of the file."""
    if path.suffix == ".skel":
        return pydart2.World(0.001, path, engine_defaults=True)
    world = pydart2.World(0.001, engine_defaults=True)
    world.add_skeleton(path, engine_defaults=True)
    return world


@pytest.mark.parametrize("name", model_names())
def test_same_numbers(oracle: DartpyOracle, name: str) -> None:
    path = dart_data() / name
    world = load(path)
    rng = np.random.default_rng(7)
    states = []
    for skel in world.skeletons:
        q, dq = (np.array(v) + 0.1 * rng.uniform(-1, 1, skel.ndofs) for v in (skel.q, skel.dq))
        skel.q, skel.dq = q, dq
        states.append((q, dq))
    theirs = oracle.simulate(path, dt=0.001, skeleton_states=states, steps=STEPS[-1], report_at=STEPS)
    for step in STEPS:
        world.step(step - world.frame)
        assert_same_frame(world, theirs[step])
