"""Rays against shapes that are known by a formula: where they enter, with which normal, and that nothing was sooner."""

from __future__ import annotations

import time
from collections.abc import Callable

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal
from numpy.typing import NDArray

from pydart2 import World

Array = NDArray[np.float64]


def distance_to_box(p: Array) -> Array:
    return np.abs(p / [0.25, 0.125, 0.5]).max(axis=-1) - 1.0


def distance_to_capsule(p: Array) -> Array:
    nearest = np.clip(p[..., 2], -0.4, 0.4)
    return np.hypot(np.hypot(p[..., 0], p[..., 1]), p[..., 2] - nearest) - 0.2


def distance_to_cylinder(p: Array) -> Array:
    return np.maximum(np.hypot(p[..., 0], p[..., 1]) - 0.3, np.abs(p[..., 2]) - 0.25)


def distance_to_cone(p: Array) -> Array:
    """Tip at z = 0.4, the base's radius 0.3 at z = -0.4."""
    return np.maximum(np.hypot(p[..., 0], p[..., 1]) - 0.3 * (0.4 - p[..., 2]) / 0.8, -0.4 - p[..., 2])


def distance_to_ellipsoid(p: Array) -> Array:
    return np.linalg.norm(p / [0.1, 0.3, 0.5], axis=-1) - 1.0


#: How a body gets the shape, and a function that is negative inside it, in its own frame.
SHAPES: dict[str, tuple[Callable[..., object], Callable[[Array], Array]]] = {
    "sphere": (lambda body: body.add_sphere(0.5), lambda p: np.linalg.norm(p, axis=-1) - 0.5),
    "box": (lambda body: body.add_box([0.5, 0.25, 1.0]), distance_to_box),
    "capsule": (lambda body: body.add_capsule(0.2, 0.8), distance_to_capsule),
    "cylinder": (lambda body: body.add_cylinder(0.3, 0.5), distance_to_cylinder),
    "cone": (lambda body: body.add_cone(0.3, 0.8), distance_to_cone),
    "ellipsoid": (lambda body: body.add_ellipsoid([0.2, 0.6, 1.0]), distance_to_ellipsoid),
}
#: Numbers that single precision, in which the engine keeps meshes, holds too.
BOX = np.array([[x, y, z] for x in (-0.25, 0.25) for y in (-0.125, 0.125) for z in (-0.5, 0.5)])
FACES = [
    [0, 1, 3],
    [0, 3, 2],
    [4, 6, 7],
    [4, 7, 5],
    [0, 4, 5],
    [0, 5, 1],
    [2, 3, 7],
    [2, 7, 6],
    [0, 2, 6],
    [0, 6, 4],
    [1, 5, 7],
    [1, 7, 3],
]
SHAPES["mesh"] = (lambda body: body.add_mesh(BOX, FACES), distance_to_box)


@pytest.mark.parametrize("shape", SHAPES)
def test_where_random_rays_enter(shape: str) -> None:
    draw = np.random.default_rng(0)
    make, inside = SHAPES[shape]
    world = World(0.001)
    skel = world.add_empty_skeleton("thing")
    body = skel.add_body("thing", joint="free")
    make(body)
    skel.q = draw.uniform(-1.0, 1.0, 6)
    T = body.T
    origins = T[:3, 3] + draw.uniform(-1.0, 1.0, (400, 3))
    targets = T[:3, 3] + draw.uniform(-0.4, 0.4, (400, 3))
    hits = world.raycast(origins, 3.0 * (targets - origins))
    directions = (targets - origins) / np.linalg.norm(targets - origins, axis=1)[:, None]
    assert 50 < hits.hit.sum() < 400

    def value(points: Array) -> Array:
        return inside((points - T[:3, 3]) @ T[:3, :3])

    starts_inside = value(origins) < 0.0
    assert not (hits.hit & starts_inside).any() or shape == "mesh"
    for i in range(400):
        if starts_inside[i]:
            continue
        end = hits.distances[i] if hits.hit[i] else 4.0
        way = origins[i] + np.linspace(0.0, end - 1e-6, 500)[:, None] * directions[i]
        assert value(way).min() > -1e-5, "nothing was sooner"
    points, normals = hits.points[hits.hit], hits.normals[hits.hit]
    assert_allclose(points, (origins + hits.distances[:, None] * directions)[hits.hit], atol=1e-12)
    assert_allclose(value(points), 0.0, atol=1e-9)
    assert_allclose(np.linalg.norm(normals, axis=1), 1.0, atol=1e-12)
    assert ((normals * directions[hits.hit]).sum(axis=1) < 0.0).all()
    assert (value(points + 1e-4 * normals) > 0.0).all() and (value(points - 1e-4 * normals) < 0.0).mean() > 0.98
    assert (hits.skeletons[hits.hit] == 0).all() and hits.body(int(np.flatnonzero(hits.hit)[0])) is body


def test_one_ray_and_what_is_hit_first() -> None:
    world = World(0.001)
    near, far = world.add_sphere(0.5, position=(2.0, 0.0, 0.0)), world.add_sphere(0.5, position=(4.0, 0.0, 0.0))
    hit = world.raycast([0.0, 0.0, 0.0], [5.0, 0.0, 0.0])
    assert hit.distances == pytest.approx(1.5)
    assert_allclose(hit.normals, [-1.0, 0.0, 0.0])
    assert hit.body() is near.bodynodes[0]
    assert world.raycast([6.0, 0.0, 0.0], [-1.0, 0.0, 0.0]).body() is far.bodynodes[0]
    assert world.raycast([0.0, 0.0, 0.0], [1.0, 0.0, 0.0], max_distance=1.4).body() is None
    miss = world.raycast([0.0, 0.0, 0.0], [0.0, 1.0, 0.0])
    assert miss.distances == np.inf and np.isnan(miss.points).all() and not miss.hit
    near.q = [0.0, 0.0, 0.0, 2.0, 3.0, 0.0]
    assert world.raycast([0.0, 0.0, 0.0], [1.0, 0.0, 0.0]).body() is far.bodynodes[0]
    world.remove_skeleton(far)
    assert not world.raycast([0.0, 0.0, 0.0], [1.0, 0.0, 0.0]).hit
    assert world.clone().raycast([0.0, 3.0, 0.0], [1.0, 0.0, 0.0]).distances == pytest.approx(1.5)


def test_a_plane_and_a_shape_that_changes() -> None:
    world = World(0.001)
    world.add_empty_skeleton("floor").add_body("floor", joint="weld").add_plane([0.0, 1.0, 0.0], 0.1)
    ball = world.add_sphere(0.5, position=(0.0, 3.0, 0.0))
    down = world.raycast([[0.0, 5.0, 0.0], [2.0, 5.0, 0.0]], [0.0, -1.0, 0.0])
    assert_allclose(down.distances, [1.5, 4.9])
    ball.bodynodes[0].shapenodes[0].shape.set_radius(1.0)  # type: ignore[attr-defined]
    assert world.raycast([0.0, 5.0, 0.0], [0.0, -1.0, 0.0]).distances == pytest.approx(1.0)


def test_nothing_of_the_simulation_changes() -> None:
    asked, left = World(0.001, "skel/fullbody1.skel"), World(0.001, "skel/fullbody1.skel")
    for _ in range(20):
        asked.raycast(np.zeros((10, 3)), np.eye(3)[np.arange(10) % 3])
        for world in (asked, left):
            world.step(10)
    assert_array_equal(asked.x, left.x)


def test_what_is_refused() -> None:
    world = World(0.001)
    for origins, directions in (
        ([0, 0], [0, 1]),
        ([0, 0, 0], [0, 0, 0]),
        ([0, 0, np.nan], [0, 0, 1]),
        (np.zeros((2, 3)), np.ones((3, 3))),
    ):
        with pytest.raises(ValueError):
            world.raycast(origins, directions)
    with pytest.raises(ValueError, match="longest distance"):
        world.raycast([0, 0, 0], [0, 0, 1], max_distance=-1.0)


def test_ten_thousand_rays_at_atlas() -> None:
    """A bound that is wide enough for any machine; the figure is in the docs."""
    world = World(0.001)
    world.add_skeleton("sdf/atlas/atlas_v3_no_head.sdf")
    world.add_ground()
    angles = np.random.default_rng(0).uniform(0.0, 2.0 * np.pi, (10_000, 2))
    directions = np.stack([np.cos(angles[:, 0]), np.sin(angles[:, 1]), np.sin(angles[:, 0])], axis=1)
    world.raycast(np.array([2.0, 0.5, 0.0]), directions)
    begin = time.perf_counter()
    hits = world.raycast(np.array([2.0, 0.5, 0.0]), directions)
    assert time.perf_counter() - begin < 0.5
    assert len(set(hits.skeletons[hits.hit])) == 2
