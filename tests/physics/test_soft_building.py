"""Soft bodies that are built in code: their skins, springs against closed forms, and what copies have of them."""

from __future__ import annotations

import pickle
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray

from pydart2 import Batch, ExportError, Skeleton, World
from pydart2.building import solids
from pydart2.building.skins import Skin
from pydart2.shapenode import Surface
from pydart2.softbody import SoftBodyNode

Array = NDArray[np.float64]
G = 9.81


def soft(skel: Skeleton, index: int = 0) -> SoftBodyNode:
    body = skel.bodynodes[index]
    assert isinstance(body, SoftBodyNode)
    return body


def centre(body: SoftBodyNode) -> Array:
    """Of core and skin."""
    skin = body.point_masses()
    return np.asarray((body.m * body.C + skin @ body.point_world_positions()) / (body.m + skin.sum()))


@pytest.mark.parametrize("cells", [1, (2, 3, 4)])
def test_the_skin_of_a_box(cells: int | tuple[int, ...]) -> None:
    """Closed, outside outwards, of the box's volume, with as many points as its grid has on the surface."""
    skin = Skin.box((0.1, 0.2, 0.3), 2.0, cells)
    n = np.broadcast_to(cells, 3)
    assert len(skin.points) == (n + 1).prod() - (n - 1).prod() and skin.masses.sum() == pytest.approx(2.0)
    assert len(skin.points) - len(skin.edges) + len(skin.triangles) == 2  # Euler
    assert len(skin.edges) == 3 * len(skin.triangles) / 2
    solid = solids.mesh(skin.points, skin.triangles)
    assert solid.volume == pytest.approx(0.006) and np.abs(solid.com).max() < 1e-15


def test_the_skin_of_an_ellipsoid() -> None:
    """On the surface, evenly spread, and towards its volume with more points."""
    volumes = []
    for cells in (2, 4, 8):
        skin = Skin.ellipsoid((0.2, 0.4, 0.6), 1.0, cells)
        assert_allclose(((skin.points / [0.1, 0.2, 0.3]) ** 2).sum(axis=1), 1.0, atol=1e-12)
        volumes.append(solids.mesh(skin.points, skin.triangles).volume / solids.ellipsoid((0.2, 0.4, 0.6)).volume)
    missing = 1.0 - np.array(volumes)
    assert_allclose(missing[:-1] / missing[1:], 4.0, rtol=0.15)  # second order


def test_a_body_that_is_held_sags_by_the_weight_of_its_points() -> None:
    """By m g / k each, without and with springs between neighbours, as all move alike."""
    for edge_stiffness in (0.0, 300.0):
        world = World(0.001)
        skel = world.add_soft_box((0.2, 0.2, 0.2), 2.6, fixed=True, stiffness=400.0, edge_stiffness=edge_stiffness)
        world.step(3000)
        body = soft(skel)
        assert body.num_points() == 26 and (body.m, body.point_masses().sum()) == pytest.approx((1.3, 1.3))
        assert_allclose(body.point_displacements(), np.tile([0.0, -0.05 * G / 400.0, 0.0], (26, 1)), atol=1e-12)


def test_forces_on_points_against_the_stiffness_matrix() -> None:
    """(k I + k_edge L) u = f with the Laplacian L of the mesh."""
    world = World(0.001)
    world.set_gravity([0.0, 0.0, 0.0])
    skin = Skin.ellipsoid((0.2, 0.3, 0.2), 0.5, 2)
    body = soft(
        world.add_soft_mesh(skin.points, skin.triangles, 1.0, fixed=True, stiffness=300.0, edge_stiffness=120.0)
    )
    laplacian = np.zeros((len(skin.points),) * 2)
    for i, j in skin.edges:
        laplacian[[i, j], [i, j]] += 1.0
        laplacian[[i, j], [j, i]] -= 1.0
    forces = np.random.default_rng(1).uniform(-3.0, 3.0, skin.points.shape)
    for _ in range(3000):
        body.add_point_forces(forces)
        world.step()
    expected = np.linalg.solve(300.0 * np.eye(len(skin.points)) + 120.0 * laplacian, forces)
    assert_allclose(body.point_displacements(), expected, atol=1e-9)


def test_the_whole_falls_freely() -> None:
    world = World(0.001)
    body = soft(world.add_soft_sphere(0.1, 1.0, (0.0, 5.0, 0.0), orientation=(1.0, 0.2, 0.3, 0.4)))
    start = centre(body)
    world.step(400)
    assert_allclose(centre(body) - start, [0.0, -G * 0.001**2 * 400 * 401 / 2.0, 0.0], atol=1e-9)


def test_the_ground_carries_core_and_skin() -> None:
    """On average, by the change of momentum; the detector is the default one."""
    world = World(0.001)
    ground = world.add_ground()
    body = soft(world.add_soft_box((0.2, 0.2, 0.2), 2.0, (0.0, 0.1, 0.0), stiffness=2000.0))
    world.step(500)
    carried, heights = [], []
    for _ in range(500):
        world.step()
        carried.append(world.contacts_between(body, ground).force[1])
        heights.append(centre(body)[1])
    gained = 2.0 * (heights[-1] - heights[-2] - heights[1] + heights[0]) / 0.001
    assert np.mean(carried[2:]) * 0.498 == pytest.approx(2.0 * G * 0.498 + gained, rel=1e-3)
    assert np.mean(carried) == pytest.approx(2.0 * G, rel=0.05)


def with_soft_finger(world: World) -> Skeleton:
    """A soft link on a hinge, below a rigid one; with a rigid shape in it and another link behind."""
    hand = world.add_empty_skeleton("hand")
    palm = hand.add_body("palm", joint="weld")
    palm.add_box((0.1, 0.1, 0.1), mass=1.0)
    skin = Skin.box((0.04, 0.04, 0.2), 0.1, (1, 1, 4), stiffness=200.0, edge_stiffness=50.0, damping=2.0)
    finger = hand.add_body("finger", palm, "revolute", axis=(1, 0, 0), position=(0, 0, 0.15), skin=skin)
    finger.add_box((0.02, 0.02, 0.15), density=500.0)
    hand.add_body("tip", finger, "weld", position=(0, 0, 0.1)).add_sphere(0.02)
    return hand


def numbers(world: World) -> bytes:
    bodies = [body for skel in world.skeletons for body in skel.bodynodes if isinstance(body, SoftBodyNode)]
    arrays = [(b.point_world_positions(), b.point_velocities(), b.point_masses(), b.faces(), b.T) for b in bodies]
    springs = [(b.vertex_stiffness(), b.edge_stiffness(), b.damping_coefficient()) for b in bodies]
    return b"".join(a.tobytes() for row in arrays for a in row) + repr(springs).encode()


COPIES: dict[str, Callable[[World], World]] = {
    "clone": World.clone,
    "pickle": lambda world: pickle.loads(pickle.dumps(world)),
    "batch": lambda world: Batch(world, 2).worlds[1],
}


@pytest.mark.parametrize("copied", COPIES.values(), ids=COPIES)
def test_copies_go_on_alike(copied: Callable[[World], World]) -> None:
    world = World(0.001)
    world.add_ground(-0.4)
    with_soft_finger(world)
    world.add_soft_box((0.1, 0.1, 0.1), position=(1.0, -0.3, 0.0), color=(1, 0, 0), friction=0.3)
    world.step(200)
    other = copied(world)
    assert numbers(other) == numbers(world)
    world.step(200)
    other.step(200)
    assert numbers(other) == numbers(world)
    node, same = (w.skeletons[2].bodynodes[0].shapenodes[0] for w in (world, other))
    assert node._handle.rgba().tolist() == same._handle.rgba().tolist() == [1.0, 0.0, 0.0, 1.0]
    assert node.surface() == same.surface() == Surface(0.3, 0.3)


def test_snapshots_have_the_points() -> None:
    world = World(0.001)
    body = soft(with_soft_finger(world), 1)
    world.step(50)
    before, start = world.snapshot(), numbers(world)
    world.step(50)
    end = numbers(world)
    assert end != start
    world.restore(before)
    assert numbers(world) == start
    world.step(50)
    assert numbers(world) == end
    world.reset()
    assert not body.point_displacements().any()


def test_a_file_with_soft_bodies_can_be_added_to() -> None:
    """And its skins are in copies bit for bit."""
    world = World(0.001, "skel/softBodies.skel")
    ball = soft(world.skeletons[2])
    ball.add_sphere(0.02, mass=0.1)
    ball.skeleton.add_body("tail", ball, "ball", position=(0.2, 0.0, 0.0)).add_sphere(0.03)
    copy = world.clone()
    for one in (world, copy):
        one.step(100)
    assert numbers(copy) == numbers(world)
    assert [b.name for b in copy.skeletons[2].bodynodes] == ["link 1", "tail"]


def test_what_is_refused(tmp_path: Path) -> None:
    world = World(0.001)
    body = soft(world.add_soft_sphere(0.1))
    with pytest.raises(ValueError, match="goes with the body"):
        body.remove_shape(body.shapenodes[0])
    for path in ("a.skel", "a.urdf", "a.sdf"):
        with pytest.raises(ExportError, match="is soft"):
            body.skeleton.save(tmp_path / path)
    refused: list[tuple[str, Callable[[], object]]] = [
        ("a soft body needs a mass", lambda: world.add_soft_box((1, 1, 1), 0.0)),
        ("a soft body needs a mass", lambda: world.add_soft_mesh(np.diag([1.0, 1.0, 0.0]), [[0, 1, 2]], 1.0)),
        ("the stiffness of a skin", lambda: world.add_soft_box((1, 1, 1), stiffness=-1.0)),
        ("one cell or more", lambda: world.add_soft_box((1, 1, 1), cells=0)),
        ("100 cells at most", lambda: world.add_soft_box((1, 1, 1), cells=2**31)),
        ("three numbers", lambda: world.add_soft_ellipsoid((1, 1))),
        ("vertices are", lambda: Skin.mesh([[0, 0]], [[0, 0, 0]], 1.0)),
        ("need a mass", lambda: Skin.box((1, 1, 1), 0.0)),
    ]
    for message, call in refused:
        with pytest.raises(ValueError, match=message):
            call()
    with pytest.raises(IndexError):
        skin = Skin.mesh(np.eye(3), [[0, 1, 3]], 1.0)
        world.add_empty_skeleton("one").add_body("body", skin=skin)
    with pytest.raises(ValueError, match="masses"):
        skin = Skin(np.eye(3), np.array([[0, 1, 2]]), np.ones(2))
        world.add_empty_skeleton("two").add_body("body", skin=skin)
    assert [skel.name for skel in world.skeletons] == ["soft_sphere", "one", "two"]
