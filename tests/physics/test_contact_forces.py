"""The contacts of a body and what they add up to: weights, levers and known faces."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

from pydart2 import World

from .models import G, box, floor, free_body, make_world

MASS = 2.0


@pytest.fixture
def world(tmp_path: Path) -> World:
    """Two boxes of 2 kg on each other on the floor, at rest, with their faces parallel to it."""
    low = free_body("low", mass=MASS, at=(0.3, 0.05, 0.0, 0, 0, 0), shape=box((0.2, 0.1, 0.4)))
    high = free_body("high", mass=MASS, at=(0.3, 0.15, 0.0, 0, 0, 0), shape=box((0.1, 0.1, 0.1)))
    world = make_world(tmp_path, floor(), low, high)
    world.set_collision_detector(0)
    world.step(1500)
    return world


def test_forces_carry_the_weight(world: World) -> None:
    """Each body feels what it carries, whichever comes first in a contact."""
    ground, low, high = (skel.bodynodes[0] for skel in world.skeletons)
    assert_allclose(high.contact_force(), [0.0, MASS * G, 0.0], atol=1e-3)
    assert_allclose(low.contact_force(), [0.0, MASS * G, 0.0], atol=1e-3)
    assert_allclose(ground.contact_force(), [0.0, -2.0 * MASS * G, 0.0], atol=1e-3)
    assert_allclose(world.contacts_between(low, ground).force, [0.0, 2.0 * MASS * G, 0.0], atol=1e-3)
    assert_allclose(world.contacts_between(high.skeleton, low).force, [0.0, MASS * G, 0.0], atol=1e-3)
    assert_allclose(world.contacts_between(low, high).force, [0.0, -MASS * G, 0.0], atol=1e-3)
    assert_allclose(world.contacts_between("low", "high").force, [0.0, -MASS * G, 0.0], atol=1e-3)
    assert len(world.contacts_between(high, ground)) == 0
    with pytest.raises(ValueError, match="is not in this world"):
        world.contacts_between(high, world.clone().skeletons[0])
    assert_allclose(low.skeleton.contacts.force, low.contact_force(), atol=0.0)


def test_the_arrays_are_those_of_the_contact_objects(world: World) -> None:
    """In the engine's order; normals and forces towards the side that was asked for."""
    everything = world.contacts
    objects = world.collision_result.contacts
    assert len(everything) == len(objects) > 0
    assert_allclose(everything.points, [c.point for c in objects], atol=0.0)
    assert_allclose(everything.forces, [c.force for c in objects], atol=0.0)
    assert_allclose(everything.depths, [c.depth for c in objects], atol=0.0)
    assert [list(row[[0, 2]]) for row in everything.ids] == [[c.skel_id1, c.skel_id2] for c in objects]
    assert [c.skel_id1 for c in everything] == [c.skel_id1 for c in objects]
    low = world.skeletons[1].contacts
    assert np.all(low.ids[:, 0] == 1)
    assert np.all(np.einsum("ij,ij->i", low.forces, low.normals) >= 0.0)
    assert_allclose(np.abs(low.normals[:, 1]), 1.0, atol=1e-6)


def test_the_centre_of_pressure_is_below_the_load(world: World) -> None:
    """A push at the side moves it by the lever: x = F h / (m g) for a box that does not slide."""
    low, high = world.skeletons[1], world.skeletons[2]
    place = low.contacts.centre_of_pressure()
    under = world.contacts_between(low, world.skeletons[0]).centre_of_pressure()
    assert place is not None and under is not None
    assert_allclose(under[[0, 2]], [0.3, 0.0], atol=1e-3)
    for _ in range(200):
        high.bodynodes[0].add_ext_force([1.0, 0.0, 0.0])  # at 0.1 m above the face that it stands on
        world.step()
    pushed = world.contacts_between(high, low).centre_of_pressure()
    assert pushed is not None
    assert_allclose(pushed[0] - high.C[0], 1.0 * 0.05 / (MASS * G), atol=2e-4)
    assert_allclose(low.contacts.moment(low.C), np.zeros(3), atol=1e-3)  # at rest between both


def test_the_support_polygon_is_the_face(world: World) -> None:
    """Four corners of the lower box, in order."""
    low = world.skeletons[1]
    corners = world.contacts_between(low, world.skeletons[0]).support_polygon()
    assert len(corners) == 4
    x, z = corners[:, 0], corners[:, 2]
    area = 0.5 * abs(np.sum(x * np.roll(z, -1) - z * np.roll(x, -1)))
    assert_allclose(area, 0.2 * 0.4, rtol=1e-3)


def test_nothing_touches_in_the_air(tmp_path: Path) -> None:
    """Empty arrays, no force, no centre of pressure."""
    world = make_world(tmp_path, floor(), free_body("high", at=(0, 5, 0, 0, 0, 0), shape=box((0.1, 0.1, 0.1))))
    world.step()
    body = world.skeletons[1].bodynodes[0]
    assert len(body.contacts) == 0 and body.contacts.points.shape == (0, 3)
    assert_allclose(body.contact_force(), np.zeros(3), atol=0.0)
    assert body.contacts.centre_of_pressure() is None
    assert body.contacts.support_polygon().shape == (0, 3)
    assert_allclose(body.contacts.moment([0.0, 0.0, 0.0]), np.zeros(3), atol=0.0)


def test_contacts_within_a_skeleton_cancel(tmp_path: Path) -> None:
    """Each of its bodies feels them; the whole does not."""
    world = World(0.001, "./data/skel/fullbody1.skel")
    human = world.skeletons[1]
    human.set_self_collision_check(True)
    human.set_positions({"j_pelvis_pos_y": 2.0, "j_thigh_left_x": 0.3, "j_thigh_right_x": -0.3})
    world.check_collision()
    assert len(human.contacts) > 0 and len(human.contacts) % 2 == 0
    assert_allclose(human.contacts.force, np.zeros(3), atol=1e-9)
