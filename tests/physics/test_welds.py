"""Welds between bodies, and constraints one by one."""

from __future__ import annotations

import pickle
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

from pydart2 import World
from pydart2.constraints import BallJointConstraint, WeldJointConstraint

from .models import G, free_body, make_world


@pytest.fixture
def world(tmp_path: Path) -> World:
    """Two free bodies of 1 and 5 kg, apart and turned to each other."""
    a = free_body("a", mass=1.0, at=(0.0, 0.0, 0.0, 0, 0, 0))
    b = free_body("b", mass=5.0, at=(0.5, 0.1, 0.2, 0.3, 0.2, 0.1))
    return make_world(tmp_path, a, b)


@pytest.mark.parametrize("solver", ["fast", "dart"])
def test_a_weld_keeps_what_is_apart_apart(world: World, solver: str) -> None:
    """5 kg held by a hand that moves: at most 0.5 mm and 0.1 degrees, and no jump at the start."""
    world.set_constraint_solver(solver)
    a, b = (skel.bodynodes[0] for skel in world.skeletons)
    WeldJointConstraint(a, b).add_to_world(world)
    before = b.relative_pose(a)
    start = b.T
    world.step()
    assert_allclose(b.T, start, atol=2e-5)
    for i in range(1000):
        a.add_ext_force([20.0 * np.sin(0.01 * i), G, 10.0 * np.cos(0.02 * i)])
        b.add_ext_force([0.0, 5.0 * G, 0.0])
        world.step()
    after = b.relative_pose(a)
    assert np.linalg.norm(after[:3, 3] - before[:3, 3]) < 5e-4
    assert np.linalg.norm(after[:3, :3] - before[:3, :3]) / np.sqrt(2.0) < np.radians(0.1)
    assert np.linalg.norm(b.com_linear_velocity()) > 0.05


def test_a_weld_to_the_world_carries_the_weight(world: World) -> None:
    """The body hangs where it is; the other one falls."""
    _a, b = (skel.bodynodes[0] for skel in world.skeletons)
    WeldJointConstraint(b).add_to_world(world)
    start = b.T
    world.step(1000)
    assert_allclose(b.T, start, atol=1e-4)
    assert_allclose(world.skeletons[1].constraint_forces()[3:] @ start[:3, :3].T, [0.0, 5.0 * G, 0.0], atol=1e-2)
    assert world.skeletons[0].C[1] < -4.0


def test_letting_go(world: World) -> None:
    """From then on both fall freely, and only what was removed is gone."""
    a, b = (skel.bodynodes[0] for skel in world.skeletons)
    grasp, hook = WeldJointConstraint(a, b), BallJointConstraint(a, None, a.T[:3, 3])
    grasp.add_to_world(world)
    hook.add_to_world(world)
    assert world.constraints == [grasp, hook]
    assert repr(grasp) == "[WeldJointConstraint: [BodyNode(0): body] and [BodyNode(0): body]]"
    grasp.remove()
    assert world.constraints == [hook] and hook.is_active() and not grasp.is_active()
    world.step(500)
    assert_allclose(b.com_linear_velocity(), [0.0, -G * 0.5, 0.0], rtol=1e-3, atol=1e-9)
    assert_allclose(a.T[:3, 3], np.zeros(3), atol=1e-4)
    with pytest.raises(ValueError, match="is in no world"):
        grasp.remove()
    with pytest.raises(ValueError, match="in a world already"):
        hook.add_to_world(world)
    grasp.add_to_world(world)
    assert len(world.constraints) == 2


def test_copies_have_the_welds(world: World) -> None:
    """Clones and pickles hold as the original does, to the bit."""
    a, b = (skel.bodynodes[0] for skel in world.skeletons)
    BallJointConstraint(b, None, b.T[:3, 3]).add_to_world(world)
    world.step(50)
    WeldJointConstraint(a, b).add_to_world(world)
    world.snapshot()
    copies = [world.clone(), pickle.loads(pickle.dumps(world))]
    world.step(200)
    for copy in copies:
        assert [type(c) for c in copy.constraints] == [BallJointConstraint, WeldJointConstraint]
        assert copy.constraints[0].body2 is None
        copy.step(200)
        assert_allclose(copy.x, world.x, rtol=0.0, atol=1e-12)


def test_a_removed_skeleton_takes_its_constraints(world: World) -> None:
    """The others stay."""
    a, b = (skel.bodynodes[0] for skel in world.skeletons)
    grasp, hook = WeldJointConstraint(a, b), WeldJointConstraint(a)
    grasp.add_to_world(world)
    hook.add_to_world(world)
    world.remove_skeleton(b.skeleton)
    assert world.constraints == [hook] and not grasp.is_active()
    world.step(10)
