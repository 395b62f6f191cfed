"""Ball joint constraints between bodies."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import pydart2
from pydart2.constraints import BallJointConstraint

from .models import G, arm, floor, free_body, make_world

SWING = free_body("bob", mass=2.0, inertia=(0.1, 0.1, 0.1), at=(1.0, 1.0, 0, 0, 0, 0))


def hung(folder: Path, dt: float = 5e-4) -> pydart2.World:
    """A body whose COM is 1 m beside the point by which it hangs on the floor's body."""
    world = make_world(folder, floor(), SWING, dt=dt)
    bob, ground = world.skeletons[1].bodynodes[0], world.skeletons[0].bodynodes[0]
    BallJointConstraint(bob, ground, [0.0, 1.0, 0.0]).add_to_world(world)
    return world


def test_points_stay_together(tmp_path: Path) -> None:
    world = hung(tmp_path)
    bob = world.skeletons[1].bodynodes[0]
    worst = 0.0
    for _ in range(2000):
        world.step()
        worst = max(worst, np.linalg.norm(bob.to_world([-1.0, 0, 0]) - [0, 1, 0]))
    assert worst < 2e-3


def test_it_swings_as_a_pendulum(tmp_path: Path) -> None:
    """Dropped from the horizontal it passes the bottom with m g l = I w² / 2."""
    world = hung(tmp_path, dt=1e-4)
    skel = world.skeletons[1]
    while skel.C[0] > 0 and world.t < 2:
        world.step()
    moment = 0.1 + 2.0 * 1.0**2
    assert -skel.dC[0] == pytest.approx(np.sqrt(2 * 2.0 * G / moment), rel=2e-3)


def test_both_bodies_feel_it(tmp_path: Path) -> None:
    """Without gravity the constraint changes no total momentum."""
    one, two = free_body("one", mass=1.0), free_body("two", mass=3.0, at=(1, 0, 0, 0, 0, 0))
    world = make_world(tmp_path, one, two, gravity=(0, 0, 0))
    a, b = world.skeletons
    BallJointConstraint(a.bodynodes[0], b.bodynodes[0], [0.5, 0, 0]).add_to_world(world)
    a.dq = [0, 0, 0, 0, 2.0, 0]
    world.step(500)
    np.testing.assert_allclose(a.P + b.P, [0, 2.0, 0], atol=2e-2)
    assert b.dC[1] > 0.05
    held = a.bodynodes[0].to_world([0.5, 0, 0]) - b.bodynodes[0].to_world([-0.5, 0, 0])
    np.testing.assert_allclose(held, 0, atol=1e-3)


def test_removed_constraints_hold_nothing(tmp_path: Path) -> None:
    world = hung(tmp_path)
    world.remove_all_constraints()
    world.skeletons[1].bodynodes[0].set_collidable(False)
    world.step(400)
    assert world.skeletons[1].dC[1] == pytest.approx(-G * world.t, rel=1e-9)


def test_removing_a_skeleton_removes_its_constraints(tmp_path: Path) -> None:
    world = hung(tmp_path)
    world.remove_skeleton(world.skeletons[0])
    world.step(400)
    assert world.skeletons[0].dC[1] == pytest.approx(-G * world.t, rel=1e-9)


def test_a_body_cannot_be_joined_to_itself_or_to_another_world(tmp_path: Path) -> None:
    world, other = hung(tmp_path), make_world(tmp_path, arm())
    bob, stranger = world.skeletons[1].bodynodes[0], other.skeletons[0].bodynodes[0]
    with pytest.raises(ValueError, match="two different bodies"):
        BallJointConstraint(bob, bob, [0, 0, 0]).add_to_world(world)
    with pytest.raises(ValueError, match="must be in the world"):
        BallJointConstraint(bob, stranger, [0, 0, 0]).add_to_world(world)
    with pytest.raises(ValueError, match="finite"):
        BallJointConstraint(bob, world.skeletons[0].bodynodes[0], [0, np.nan, 0]).add_to_world(world)
