"""Every shape on every other, with every detector: none passes through, none is taken for something else."""

from __future__ import annotations

import pickle

import numpy as np
import pytest

import pydart2
from pydart2 import BodyNode, Skeleton, World

CORNERS = np.array([[x, y, z] for x in (-0.2, 0.2) for y in (-0.2, 0.2) for z in (-0.2, 0.2)])
SIDES = [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1], [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4]]
SIDES += [[1, 5, 7], [1, 7, 3]]
DETECTORS = ["fcl", "bullet", "ode", "dart", "native"]
#: Each reaches from 0.2 m below its middle to 0.2 m above it, and has a flat or round top there.
SHAPES = {
    "box": lambda body: body.add_box([0.4, 0.4, 0.4]),
    "sphere": lambda body: body.add_sphere(0.2),
    "ellipsoid": lambda body: body.add_ellipsoid([0.5, 0.6, 0.4]),
    "cylinder": lambda body: body.add_cylinder(0.2, 0.4),
    "capsule": lambda body: body.add_capsule(0.1, 0.2),
    "cone": lambda body: body.add_cone(0.2, 0.4),
    "mesh": lambda body: body.add_mesh(CORNERS, SIDES),
}


def shape(world: World, kind: str, height: float, joint: str = "free") -> Skeleton:
    skel = world.add_empty_skeleton(kind)
    body = skel.add_body(kind, joint=joint, mass=1.0, inertia=0.02 * np.eye(3), position=[0.0, 0.0, height])
    SHAPES[kind](body)
    return skel


@pytest.mark.parametrize("detector", DETECTORS)
@pytest.mark.parametrize("below", SHAPES)
def test_each_meets_each(detector: str, below: str) -> None:
    """Dropped from 5 cm above, the first contact is where the shapes meet; Bullet's margin is 6 mm, a step 1 mm."""
    for kind in SHAPES:
        world = World(0.001, up="z")
        shape(world, below, 0.0, "weld")
        falling = shape(world, kind, 0.45)
        world.set_collision_detector(detector)
        while len(world.contacts) == 0 and world.t < 0.12:
            world.step()
        assert len(world.contacts) > 0, kind
        assert falling.q[5] == pytest.approx(0.4, abs=0.007 if detector == "bullet" else 0.001), kind


@pytest.mark.parametrize("detector", DETECTORS)
def test_each_rests_on_a_plane(detector: str) -> None:
    for kind in SHAPES:
        world = World(0.001, up="z")
        world.add_empty_skeleton("plane").add_body("plane", joint="weld").add_plane([0.0, 0.0, 1.0])
        resting = shape(world, kind, 0.205)
        world.set_collision_detector(detector)
        world.step(200)
        assert resting.q[5] == pytest.approx(0.2, abs=2e-3), kind
        assert resting.bodynodes[0].contact_force()[2] == pytest.approx(9.81 * resting.m, rel=0.05), kind


def test_shapes_that_change_and_go() -> None:
    world = World(0.001, up="z")
    world.add_ground()
    skel = shape(world, "capsule", 0.2)
    world.step(100)
    assert skel.q[5] == pytest.approx(0.2, abs=1e-3)
    body: BodyNode = skel.bodynodes[0]
    body.remove_shape(body.shapenodes[0])
    body.add_capsule(0.1, 0.4)
    skel.q = [0.0, 0.0, 0.0, 0.0, 0.0, 0.3]
    world.step(100)
    assert skel.q[5] == pytest.approx(0.3, abs=1e-3)
    world.remove_skeleton(skel)
    again = shape(world, "sphere", 0.2)
    world.step(100)
    assert again.q[5] == pytest.approx(0.2, abs=1e-3)
    assert len(world.contacts) > 0


@pytest.mark.parametrize("detector", DETECTORS)
def test_copies_go_on_exactly(detector: str) -> None:
    world = World(0.001, up="z")
    world.add_ground()
    for i, kind in enumerate(("capsule", "box", "cone")):
        shape(world, kind, 0.25 + 0.41 * i).dq = [0.3, 0.1, 0.0, 0.2, 0.0, 0.0]
    world.set_collision_detector(detector)
    world.step(150)
    for twin in (world.clone(), pickle.loads(pickle.dumps(world))):
        twin.step(150)
        start = world.snapshot()
        world.step(150)
        assert world.x.tobytes() == twin.x.tobytes()
        world.restore(start)


def test_the_way_back_to_the_engine() -> None:
    """A capsule is a ball of 5 cm for FCL, in copies and after another detector too."""
    world = World(0.001, up="z", engine_defaults=True)
    world.add_ground()
    shape(world, "capsule", 0.2)
    for detector in ("bullet", "native", "fcl"):
        world.set_collision_detector(detector)
    for copy in (world, world.clone(), pickle.loads(pickle.dumps(world)), pydart2.Batch(world, 1).worlds[0]):
        copy.step(400)
        assert copy.skeletons[1].q[5] == pytest.approx(0.05, abs=2e-3)


def test_what_passes_through_by_name_does_so() -> None:
    world = World(0.001, up="z")
    world.add_ground()
    skel = shape(world, "capsule", 0.2)
    world.exclude_collisions("capsule", "ground")
    world.step(200)
    assert skel.q[5] < 0.1
