"""Contacts of rigid bodies that the fast solver takes without the engine's constraints: its bits, in each detector."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_array_equal

from pydart2 import World


def pile(solver: str, detector: str) -> World:
    """Boxes that fall on each other, with all that surfaces can have."""
    world = World(0.001)
    world.set_collision_detector(detector)
    world.set_constraint_solver(solver)
    world.add_ground()
    world.skeletons[0].bodynodes[0].shapenodes[0].set_surface(restitution=0.9)
    random = np.random.default_rng(3)
    for i in range(6):
        box = world.add_box((0.2, 0.1, 0.15), mass=1.0, position=(0.05 * i, 0.08 + 0.17 * i, 0.02 * i))
        box.bodynodes[0].shapenodes[0].set_surface(
            friction=0.3 + 0.1 * i,
            secondary_friction=0.9 - 0.1 * i,
            slip=0.001 * i,
            secondary_slip=0.002,
            restitution=0.8 * (i % 2),
            friction_direction=(1, 0.2 * i, 0.3) if i % 3 else (0, 0, 0),
        )
        box.dq = random.normal(size=6) * 0.5
    return world


def step_alike(ours: World, engine: World, steps: int) -> int:
    """How many contacts there were in all steps, with the same states and forces after each."""
    contacts = 0
    for _ in range(steps):
        for world in (ours, engine):
            world.step()
            world.collision_result.update()
        assert_array_equal(ours.states(), engine.states())
        assert_array_equal(ours.collision_result.rows, engine.collision_result.rows)
        contacts += len(ours.collision_result.rows)
    return contacts


@pytest.mark.parametrize("detector", ["fcl", "bullet", "ode", "dart", "native"])
def test_surfaces(detector: str) -> None:
    """States and forces are those of the engine's solver in each step."""
    assert step_alike(pile("fast", detector), pile("dart", detector), 600) > 3_000


def crowd(solver: str, detector: str, seed: int) -> World:
    """Jointed boxes with dry friction side by side: trees of them join, and the engine has some in two groups."""
    world = World(0.001)
    world.set_collision_detector(detector)
    world.set_constraint_solver(solver)
    world.add_ground()
    random = np.random.default_rng(seed)
    for i, place in enumerate(random.permutation(8)):
        skel = world.add_empty_skeleton(f"crowd {i}")
        skel.add_body("base", joint="free").add_box((0.2, 0.2, 0.2), density=100.0)
        skel.add_body("arm", "base", "revolute", position=(0, 0.2, 0)).add_box((0.1, 0.1, 0.1), density=100.0)
        skel.dofs[6].set_coulomb_friction(0.05)
        skel.dofs[6].set_position_lower_limit(-0.01)
        skel.dofs[6].set_position_upper_limit(0.01)
        skel.joints[1].set_position_limit_enforced(i % 2 == 0)
        q = skel.q
        q[3:6] = 0.199 * place, 0.0995, 0.01 * random.normal()
        skel.q = q
    return world


@pytest.mark.parametrize("detector", ["fcl", "bullet", "ode", "dart"])
def test_joints(detector: str) -> None:
    """Rows of joints beside those of contacts, also where the engine has a skeleton in two groups."""
    for seed in range(2):
        assert step_alike(crowd("fast", detector, seed), crowd("dart", detector, seed), 50) > 1_000
