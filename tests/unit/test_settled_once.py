"""What a step has settled for as long as the model stays, and that it counts at once when the model changes."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

import pydart2
from pydart2 import Skeleton, World

DETECTORS = ("fcl", "dart", "native")  # which look for nothing where nothing can collide


def arm(world: World) -> Skeleton:
    """Three links that hang sideways, whose first and last overlap."""
    skel = world.add_empty_skeleton("arm")
    parent = None
    for name in ("first", "second", "third"):
        parent = skel.add_body(name, parent=parent, joint="revolute", axis=(0, 0, 1), joint_name=f"j_{name}")
        parent.add_box((0.3, 0.1, 0.1), mass=1.0)
    return skel


@pytest.mark.parametrize("detector", DETECTORS)
def test_bodies_that_begin_to_collide(detector: str) -> None:
    """All pairs of a world with one skeleton are ignored until its bodies collide with each other."""
    world = World(0.001)
    world.set_collision_detector(detector)
    skel = arm(world)
    world.step(3)
    assert not world.collision_result.contacts
    skel.set_self_collision_check(True)
    world.step()
    assert world.collision_result.contacts
    skel.set_self_collision_check(False)
    world.step()
    assert not world.collision_result.contacts


@pytest.mark.parametrize("detector", DETECTORS)
def test_ground_that_comes_later(detector: str) -> None:
    """Steps in which nothing was looked for do not show in the order of later contacts.

    A second skeleton without shapes, because of which all is looked for, makes no difference of a bit.
    """
    states = []
    for alone in (True, False):
        world = World(0.001, up="z")
        world.set_collision_detector(detector)
        robot = world.add_skeleton(pydart2.data_path("sdf/atlas/atlas_v3_no_head.sdf"), position=(0, 0, 1.0))
        if not alone:
            world.add_empty_skeleton("other").add_body("nothing", mass=1.0, inertia=np.eye(3))
        world.step(30)
        world.add_ground()
        world.step(200)
        assert len(world.collision_result.contacts) > 3
        states.append(np.concatenate([robot.q, robot.dq]))
    assert_array_equal(states[0], states[1])


@pytest.mark.parametrize("solver", ["fast", "iterative"])
def test_joints_that_begin_to_hold(solver: str) -> None:
    """Limits, servos and dry friction count from the step on in which they are set."""
    world = World(0.001)
    world.set_constraint_solver(solver)
    skel = arm(world)
    skel.dq = 1.0, -2.0, 1.0
    world.step(10)
    assert (np.abs(skel.dq) > 0.5).all()
    servo = skel.joint("j_first")
    servo.set_actuator_type(servo.SERVO)
    for name in ("j_second", "j_third"):
        skel.dof(name).set_coulomb_friction(1e4)
    world.step()
    assert_allclose(skel.dq, 0.0, atol=1e-4)


def test_shape_that_moves_on_its_body() -> None:
    """The native detector asks the engine's bodies where they are, and knows where its shapes are on them."""
    world = World(0.001)
    world.set_collision_detector("native")
    world.add_ground()
    box = world.add_box((0.2, 0.2, 0.2), mass=1.0, position=(0, 0.5, 0))
    world.step(2)
    assert not world.collision_result.contacts
    box.bodynodes[0].shapenodes[0].set_offset((0, -0.401, 0))
    world.step()
    assert world.collision_result.contacts
