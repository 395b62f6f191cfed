"""Our models move as they should; what the examples do with them is in tests/examples."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import pydart2
from physics.models import standing_atlas


def load(name: str, step: float) -> Any:
    world = pydart2.World(step, pydart2.data_path(f"skel/{name}.skel"))
    world.disable_recording()
    return world


def test_cubes_come_to_rest() -> None:
    """The second cube falls beside the first, off the plate, and lies on the floor."""
    world = load("cubes", 0.001)
    plate, first, second = (world.skeletons[i] for i in (1, 2, 3))
    start = second.C[1]
    most = 0
    for _ in range(2000):
        world.step()
        most = max(most, len(world.collision_result.contacts))
    assert most >= 12
    for skeleton in (plate, first, second):
        assert np.abs(skeleton.dq).max() < 1e-6
    np.testing.assert_allclose((plate.C[1], first.C[1], second.C[1]), (-0.325, -0.275, -0.325), atol=1e-3)
    assert start - second.C[1] == pytest.approx(0.13, abs=1e-3)


def energy(skeleton: Any) -> float:
    potential = sum(9.81 * body.m * body.C[1] for body in skeleton.bodynodes)
    return float(0.5 * skeleton.dq @ skeleton.M @ skeleton.dq + potential)


def test_chain_swings() -> None:
    """From the side it swings through to the other side and keeps its energy."""
    world = load("chain", 1.0 / 5000.0)
    chain = world.skeletons[0]
    q = np.zeros(chain.ndofs)
    q[2] = 0.9
    chain.q = q
    before, tip = energy(chain), []
    for _ in range(100):
        world.step(50)
        tip.append(chain.bodynodes[-1].C)
    x, y, z = np.array(tip).T
    assert x.max() > 0.2
    assert x.min() < -0.2
    assert y.min() < -0.4
    assert np.abs(z).max() < 1e-9
    assert energy(chain) == pytest.approx(before, abs=0.02 * 9.81 * chain.m * 0.25)


def test_soft_bodies_deform_and_rest() -> None:
    world = load("softBodies", 0.001)
    bodies = [skeleton.bodynodes[0] for skeleton in world.skeletons[1:]]
    start = [body.C[1] for body in bodies]
    most = np.zeros(len(bodies))
    for _ in range(300):
        world.step(10)
        most = np.maximum(most, [np.abs(b.point_displacements()).max() for b in bodies])
    assert (most > 0.01).all()
    for body, height in zip(bodies, start, strict=True):
        assert body.point_world_positions()[:, 1].min() > -0.352, body.skeleton.name  # the floor is at -0.35
        assert body.C[1] < 0.0
        assert body.skeleton.kinetic_energy() < 0.05 * body.m * 9.81 * (height - body.C[1])  # of what it fell by


def test_shapes_fall_onto_the_floor() -> None:
    """Nothing sinks in and nothing stays in the air.  Round shapes may roll."""
    world = load("shapes", 0.001)
    world.step(2000)
    height = {s.bodynodes[0].name: s.C[1] + 0.375 for s in world.skeletons[1:]}  # above the floor
    for name, half in {"sphere": 0.05, "box": 0.025, "cylinder": 0.05, "capsule": 0.05}.items():
        assert height[name] == pytest.approx(half, abs=0.004), name
    assert all(0.02 < h < 0.12 for h in height.values()), height
    assert np.isfinite(world.states()).all()


def test_atlas_stands() -> None:
    """Springs hold the pose; the feet rest on the floor for half a second and longer."""
    world = standing_atlas()
    robot = world.skeletons[-1]
    start, fewest = robot.C, 100
    for _ in range(1000):
        world.step()
        fewest = min(fewest, len(world.collision_result.contacts))
    assert fewest >= 8
    np.testing.assert_allclose(robot.C, start, atol=0.03)
