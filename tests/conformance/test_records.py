"""Contacts, collision results, constraints and recordings."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from pydart2 import World
from pydart2.collision_result import CollisionResult
from pydart2.constraints import BallJointConstraint
from pydart2.contact import Contact
from pydart2.recording import Recording

from .table import row, rows

STATE = np.array([1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 1.0, 0.0, 2.0, 0.0])


@row("contact.Contact")
def test_contact(cubes: World) -> None:
    contact = Contact(cubes, STATE)
    assert (contact.world, contact.skel_id1, contact.skel_id2) == (cubes, 1, 2)


@rows(
    "contact.Contact.",
    {
        "state": ("state", STATE),
        "point": ("point", STATE[:3]),
        "p": ("p", STATE[:3]),
        "force": ("force", STATE[3:6]),
        "f": ("f", STATE[3:6]),
        "skel_id1": ("skel_id1", 1),
        "bodynode_id1": ("bodynode_id1", 0),
        "skel_id2": ("skel_id2", 2),
        "bodynode_id2": ("bodynode_id2", 0),
    },
)
def test_number_of_contact(cubes: World, case: tuple[str, object]) -> None:
    name, expected = case
    assert_allclose(getattr(Contact(cubes, STATE), name), expected)


@row("contact.Contact.world")
def test_world_of_contact(touching: World) -> None:
    assert {contact.world for contact in touching.collision_result.contacts} == {touching}


@row("contact.Contact.bodynode1", "contact.Contact.bodynode2")
def test_bodies_of_contact(cubes: World) -> None:
    contact = Contact(cubes, STATE)
    assert contact.bodynode1 is cubes.skeletons[1].bodynodes[0]
    assert contact.bodynode2 is cubes.skeletons[2].bodynodes[0]
    assert Contact(cubes, np.array([*STATE[:6], -1, -1, 2, 0])).bodynode1 is None


@row("contact.Contact.__repr__")
def test_repr_of_contact(cubes: World) -> None:
    assert repr(Contact(cubes, STATE)) == "[Contact [1. 2. 3.] [4. 5. 6.]]"


@row(
    "collision_result.CollisionResult", "collision_result.CollisionResult.world", "collision_result.CollisionResult.id"
)
def test_collision_result(cubes: World) -> None:
    result = CollisionResult(cubes)
    assert (result.world, result.id, result.num_contacts()) == (cubes, cubes.id, 0)


@row("collision_result.CollisionResult.contacts")
def test_contacts_carry_the_weight(cubes: World) -> None:
    cubes.step(400)  # all at rest but for the second cube, which is light
    up = np.zeros(3)
    for contact in cubes.collision_result.contacts:
        if contact.skel_id1 == 0 or contact.skel_id2 == 0:
            up += contact.force if contact.skel_id2 == 0 else -contact.force
    resting = sum(skel.m for skel in cubes.skeletons[1:])
    assert up[1] == pytest.approx(9.81 * resting, rel=0.1)


@row(
    "collision_result.CollisionResult.contacted_bodies",
    "collision_result.CollisionResult.num_contacts",
    "collision_result.CollisionResult.num_contacted_bodies",
)
def test_contacted_bodies(touching: World) -> None:
    result = touching.collision_result
    bodies = {body for contact in result.contacts for body in (contact.bodynode1, contact.bodynode2)}
    assert result.num_contacts() == len(result.contacts) > 0
    assert result.num_contacted_bodies() == len(result.contacted_bodies) == len(bodies) == 3
    assert set(result.contacted_bodies) == bodies


@row("collision_result.CollisionResult.copy")
def test_copy(touching: World) -> None:
    copy = touching.collision_result.copy()
    points = [contact.point for contact in copy.contacts]
    touching.skeletons[1].q = np.full(6, 5.0)
    touching.step()
    assert_allclose([contact.point for contact in copy.contacts], points)
    assert touching.collision_result.num_contacts() < len(points)


@row("collision_result.CollisionResult.update")
def test_update(touching: World) -> None:
    result = CollisionResult(touching)
    result.update()
    assert result.num_contacts() == touching.collision_result.num_contacts() > 0


@row("collision_result.CollisionResult.__repr__")
def test_repr_of_result(touching: World) -> None:
    n = touching.collision_result.num_contacts()
    assert repr(touching.collision_result) == f"[CollisionResult: {n} contacts 3 contacted bodies]"


@row(
    "constraints.BallJointConstraint",
    "constraints.BallJointConstraint.body1",
    "constraints.BallJointConstraint.body2",
    "constraints.BallJointConstraint.jointPos",
)
def test_ball_joint_constraint(cubes: World) -> None:
    a, b = cubes.skeletons[2].bodynodes[0], cubes.skeletons[3].bodynodes[0]
    constraint = BallJointConstraint(a, b, [1, 2, 3])
    assert (constraint.body1, constraint.body2) == (a, b)
    assert_allclose(constraint.jointPos, [1, 2, 3])


@row("recording.Recording", "recording.Recording.world")
def test_recording(cubes: World) -> None:
    assert isinstance(cubes.recording, Recording)
    assert cubes.recording.world is cubes


@row("recording.Recording.history", "recording.Recording.num_frames")
def test_history(cubes: World) -> None:
    assert cubes.recording is not None
    states = [cubes.x]
    for _ in range(15):
        cubes.step()
        states.append(cubes.x)
    history = cubes.recording.history
    assert cubes.recording.num_frames() == len(history) == 16
    assert_allclose([state for state, _ in history], states)
    assert history[-1][1].num_contacts() == cubes.collision_result.num_contacts() > 0


@row("recording.Recording.clear")
def test_clear(cubes: World) -> None:
    assert cubes.recording is not None
    cubes.step(5)
    cubes.recording.clear()
    assert cubes.recording.num_frames() == cubes.num_frames() == 1
    assert_allclose(cubes.recording.history[0][0], cubes.x)


@row("recording.Recording.bake")
def test_bake(cubes: World) -> None:
    assert cubes.recording is not None
    cubes.skeletons[1].q = np.full(6, 0.5)
    cubes.recording.bake()
    assert cubes.recording.num_frames() == 2
    assert_allclose(cubes.recording.history[1][0], cubes.x)


@row("recording.Recording.set_frame")
def test_set_frame(cubes: World) -> None:
    assert cubes.recording is not None
    start = cubes.x
    cubes.step(5)
    assert cubes.recording.set_frame(0) is True
    assert_allclose(cubes.x, start)
    assert cubes.recording.set_frame(6) is False
