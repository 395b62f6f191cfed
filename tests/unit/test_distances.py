"""Distances and contacts of bodies as they stand, against formulas; and which pairs are asked about."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray
from scipy.optimize import minimize
from scipy.spatial.transform import Rotation

from pydart2 import NameNotFound, Skeleton, World

Array = NDArray[np.float64]
CUBE = np.array([[x, y, z] for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)])
#: Two triangles a side, counterclockwise from outside; the corners are numbered as in CUBE.
SIDES = [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1], [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4]]
SIDES += [[1, 5, 7], [1, 7, 3]]


def space() -> World:
    world = World(0.001, up="z")
    world.set_gravity([0.0, 0.0, 0.0])
    return world


def along_x(world: World, gap: float) -> dict[str, tuple[Callable[[], Skeleton], Callable[[], Skeleton]]]:
    """Makers of two shapes whose surfaces are a gap apart on the x axis, at x = 0 and x = gap."""
    upright = [0.0, 0.0, 0.3]
    return {
        "balls": (
            lambda: world.add_sphere(0.5, 1.0, [-0.5, 0.0, 0.3]),
            lambda: world.add_sphere(0.2, 1.0, [gap + 0.2, *upright[1:]]),
        ),
        "box and ball": (
            lambda: world.add_box([1.0, 1.0, 1.0], 1.0, [-0.5, 0.0, 0.0]),
            lambda: world.add_sphere(0.2, 1.0, [gap + 0.2, *upright[1:]]),
        ),
        "boxes": (
            lambda: world.add_box([1.0, 1.0, 1.0], 1.0, [-0.5, 0.0, 0.0]),
            lambda: world.add_box([0.4, 0.6, 0.8], 1.0, [gap + 0.2, 0.1, 0.2]),
        ),
        "capsule and cylinder": (
            lambda: world.add_capsule(0.3, 1.0, 1.0, [-0.3, 0.0, 0.0]),
            lambda: world.add_cylinder(0.2, 1.0, 1.0, [gap + 0.2, 0.0, 0.1]),
        ),
        "ball and cylinder": (
            lambda: world.add_sphere(0.5, 1.0, [-0.5, 0.0, 0.3]),
            lambda: world.add_cylinder(0.2, 1.0, 1.0, [gap + 0.2, 0.0, 0.1]),
        ),
    }


NAMES = list(along_x(World(0.001), 0.0))


@pytest.mark.parametrize("gap", [1.5, 0.01, 1e-6, -1e-3, -0.05])
@pytest.mark.parametrize("name", NAMES)
def test_gaps_and_depths(name: str, gap: float) -> None:
    world = space()
    a, b = (make() for make in along_x(world, gap)[name])
    for one, other, sign in ((a, b, -1.0), (b, a, 1.0)):
        near = world.distance(one, other)
        assert near.distances == pytest.approx(gap, abs=1e-9)
        assert_allclose(near.normals, [sign, 0.0, 0.0], atol=1e-6)
        assert_allclose(near.points[..., 0], [0.0, gap] if one is a else [gap, 0.0], atol=1e-9)
        assert near.pair() == (one.bodynodes[0], other.bodynodes[0])


def test_ellipsoids_at_random() -> None:
    """Against SciPy, from the points of both surfaces that it finds."""
    rng = np.random.default_rng(0)
    world = space()
    for i in range(5):
        sizes = rng.uniform(0.2, 1.0, (2, 3))
        turns = Rotation.random(2, random_state=rng)
        places = np.array([[0.0, 0.0, 0.0], [1.5, 0.4 * i, 0.3]])
        pair = []
        for size, turn, place in zip(sizes, turns, places, strict=True):
            skel = world.add_empty_skeleton(f"one {i} {len(pair)}")
            body = skel.add_body("egg", joint="free", mass=1.0, inertia=np.eye(3))
            body.add_ellipsoid(size)
            skel.q = np.concatenate([turn.as_rotvec(), place])
            pair.append(skel)

        def on_both(
            angles: Array, sizes: Array = sizes, turns: Rotation = turns, places: Array = places
        ) -> list[Array]:
            polar, around = angles.reshape(2, 2).T
            unit = np.stack([np.sin(polar) * np.cos(around), np.sin(polar) * np.sin(around), np.cos(polar)], axis=1)
            return [turn.apply(u * s / 2) + p for turn, u, s, p in zip(turns, unit, sizes, places, strict=True)]

        def gap(angles: Array) -> float:
            one, other = on_both(angles)
            return float(np.linalg.norm(one - other))

        best = min(minimize(gap, rng.uniform(-3.0, 3.0, 4), tol=1e-12).fun for _ in range(12))
        assert world.distance(*pair).distances == pytest.approx(best, abs=1e-6)


def test_meshes_and_planes() -> None:
    world = space()
    world.add_ground()
    cube = world.add_mesh(CUBE, SIDES, 1.0, position=[0.0, 0.0, 1.0])
    cage = world.add_mesh(
        np.vstack([CUBE, 0.5 * CUBE]), SIDES + [[i + 8 for i in t] for t in SIDES], 1.0, position=[3, 0, 1]
    )
    assert world.distance(cube, world.skeletons[0]).distances == pytest.approx(0.5)
    assert world.distance(cube, cage).distances == pytest.approx(2.0)
    assert world.distance(cage, world.skeletons[0]).distances == pytest.approx(0.5)
    ball = world.add_sphere(0.1, 1.0, [3.0, 0.0, 1.0])  # in the hollow of the inner cube
    assert world.distance(ball, cage).distances == pytest.approx(0.15)
    assert world.distance(cage, ball).distances == pytest.approx(0.15)
    ball.q = [0.0, 0.0, 0.0, 3.0, 0.0, 1.45]
    assert world.distance(ball, cage).distances == 0.0


def test_nearest_surfaces() -> None:
    world = space()
    world.add_ground()
    world.add_box([1.0, 1.0, 1.0], 1.0, [0.0, 0.0, 2.0], name="crate")
    points = np.array([[0.0, 0.0, 3.0], [0.0, 0.0, 1.0], [0.0, 0.0, 1.9], [4.0, 0.0, -0.3], [0.9, 0.0, 2.8]])
    near = world.nearest(points)
    assert_allclose(near.distances, [0.5, 0.5, -0.4, -0.3, 0.5], atol=1e-9)
    assert_allclose(near.points[[0, 2, 3, 4]], [[0, 0, 2.5], [0, 0, 1.5], [4, 0, 0], [0.5, 0, 2.5]], atol=1e-9)
    assert_allclose(near.normals[[0, 2, 3, 4]], [[0, 0, 1], [0, 0, -1], [0, 0, 1], [0.8, 0, 0.6]], atol=1e-9)
    assert [skel.name for i in (0, 3) if (skel := near.body(i).skel)] == ["crate", "ground"]  # type: ignore[union-attr]
    assert not world.nearest([0.0, 0.0, 9.0], max_distance=1.0).hit
    assert world.nearest([0.0, 0.0, 3.0], ignore="crate").distances == pytest.approx(3.0)
    with pytest.raises(ValueError, match=r"shape \(3,\) or \(n, 3\)"):
        world.nearest([0.0, 1.0])


def test_the_nearest_of_many_and_all_within_reach() -> None:
    world = space()
    boxes = [world.add_box([0.1, 0.1, 0.1], 1.0, [0.3 * i, 0.0, 0.0], name=f"b{i}") for i in range(6)]
    near = world.distance("b0", boxes)
    assert near.distances == pytest.approx(0.2)
    assert near.pair() == (boxes[0].bodynodes[0], boxes[1].bodynodes[0])
    within = world.distances_within("b0", boxes, 0.6)
    assert_allclose(within.distances, [0.2, 0.5])
    assert [within.pair(i)[1].skel.name for i in range(len(within))] == ["b1", "b2"]  # type: ignore[union-attr]
    far = world.distance("b0", "b5", max_distance=1.0)
    assert far.distances == np.inf
    assert far.pair() == (None, None)


def test_own_bodies_but_for_those_that_a_joint_connects() -> None:
    world = space()
    skel = world.add_empty_skeleton("snake")
    last = None
    for i in range(3):
        last = skel.add_body(
            f"link{i}", parent=last, joint="revolute", mass=1.0, inertia=np.eye(3), position=[0.0, 0.0, 1.0]
        )
        last.add_sphere(0.3)
    near = world.distance("snake", "snake")
    assert near.distances == pytest.approx(2.0 - 0.6)
    world.exclude_collisions("link0", "link2")
    assert world.distance("snake", "snake").distances == np.inf


def test_contacts_without_a_step() -> None:
    world = space()
    world.add_ground()
    box = world.add_box([0.4, 0.4, 0.2], 1.0, [0.0, 0.0, 0.099])
    found = world.find_contacts(box, "ground")
    assert len(found) == 4
    assert_allclose(found.depths, 1e-3, atol=1e-12)
    assert_allclose(found.normals, np.tile([0.0, 0.0, 1.0], (4, 1)), atol=1e-12)
    assert_allclose(np.abs(found.points[:, :2]), 0.2)
    assert_allclose(found.forces, 0.0)
    assert len(world.contacts) == 0
    assert world.t == 0.0


def test_rays_that_ignore_a_body() -> None:
    world = space()
    world.add_ground()
    world.add_box([1.0, 1.0, 1.0], 1.0, [0.0, 0.0, 2.0], name="crate")
    down = ([0.0, 0.0, 5.0], [0.0, 0.0, -1.0])
    assert world.raycast(*down).distances == pytest.approx(2.5)
    assert world.raycast(*down, ignore="crate").distances == pytest.approx(5.0)


def test_names() -> None:
    world = space()
    world.add_box([1.0, 1.0, 1.0], 1.0, name="crate")
    for ask in (world.raycast, world.nearest):
        with pytest.raises(NameNotFound, match="no skeleton or body 'crat' in this world; did you mean 'crate'"):
            ask([0.0, 0.0, 0.0], *([[0.0, 0.0, 1.0]] if ask == world.raycast else []), ignore="crat")  # type: ignore[operator]
    with pytest.raises(TypeError, match="given as bodies"):
        world.distance("crate", [3])  # type: ignore[list-item]
    with pytest.raises(ValueError, match="not in this world"):
        world.distance("crate", space().add_box([1.0, 1.0, 1.0], 1.0))
