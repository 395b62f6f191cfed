"""The package's own collision detector: closed forms, and exact depths of random pairs."""

from __future__ import annotations

import itertools
import pickle
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

import pydart2
from physics.models import body, box, floor, free_body, joint, make_world, skeleton, sphere

Array = NDArray[np.float64]
QUARTER = np.pi / 2

CAPSULE = "<capsule><radius>0.3</radius><height>0.6</height></capsule>"
CYLINDER = "<cylinder><radius>0.4</radius><height>0.7</height></cylinder>"
CONE = "<cone><radius>0.5</radius><height>1</height></cone>"
ELLIPSOID = "<ellipsoid><size>0.6 1 0.8</size></ellipsoid>"
PYRAMID = "<pyramid><base_width>1</base_width><base_depth>0.8</base_depth><height>1</height></pyramid>"
PLANE = skeleton(
    body("floor", shape="<plane><normal>0 1 0</normal><point>0 0 0</point></plane>"),
    joint("weld", "floor", name="weld"),
    name="floor",
)
CORNERS = np.array([(-0.5, -0.4, -0.5), (0.5, -0.4, -0.5), (0.5, 0.4, -0.5), (-0.5, 0.4, -0.5), (0, 0, 0.5)])


def across(d: Array) -> Array:
    return np.hypot(d[..., 0], d[..., 1])


# A shape, and how far it reaches along directions, the rows of d.
SHAPES: dict[str, tuple[str, Callable[[Array], Array]]] = {
    "box": (box((1, 0.8, 0.6)), lambda d: np.abs(d) @ (0.5, 0.4, 0.3)),
    "sphere": (sphere(0.5), lambda d: 0.5 * np.linalg.norm(d, axis=-1)),
    "capsule": (CAPSULE, lambda d: 0.3 * np.abs(d[..., 2]) + 0.3 * np.linalg.norm(d, axis=-1)),
    "cylinder": (CYLINDER, lambda d: 0.4 * across(d) + 0.35 * np.abs(d[..., 2])),
    "cone": (CONE, lambda d: np.maximum(0.5 * d[..., 2], 0.5 * across(d) - 0.5 * d[..., 2])),
    "ellipsoid": (ELLIPSOID, lambda d: np.linalg.norm(d * (0.3, 0.5, 0.4), axis=-1)),
    "pyramid": (PYRAMID, lambda d: (d @ CORNERS.T).max(axis=-1)),
}


def directions(count: int) -> Array:
    """Spread evenly over the sphere."""
    i = np.arange(count) + 0.5
    z, angle = 1 - 2 * i / count, np.pi * (1 + 5**0.5) * i
    r = np.sqrt(1 - z * z)
    return np.stack([r * np.cos(angle), r * np.sin(angle), z], axis=-1)


def contacts_of(world: pydart2.World) -> list[pydart2.Contact]:
    world.check_collision()
    return world.collision_result.contacts


def two(folder: Path, first: str, second: str) -> pydart2.World:
    world = make_world(folder, free_body("a", shape=first), free_body("b", shape=second))
    world.set_collision_detector("native")
    return world


@pytest.mark.parametrize(("a", "b"), list(itertools.combinations_with_replacement(SHAPES, 2)))
def test_depths_of_random_pairs(tmp_path: Path, a: str, b: str) -> None:
    """A contact's depth is the way along its normal that parts the shapes, and no direction parts them in less."""
    world, rng, many = two(tmp_path, SHAPES[a][0], SHAPES[b][0]), np.random.default_rng(3), directions(20_000)
    touching = 0
    for _ in range(12):
        first, second = world.skeletons
        first.q, away = rng.normal(size=6), rng.normal(size=3)
        away *= rng.uniform(0.2, 1.0) / np.linalg.norm(away)
        second.q = [*rng.normal(size=3), *(first.q[3:] + away)]
        pose_a, pose_b = first.bodynodes[0].T, second.bodynodes[0].T

        def depth(n: Array, pose_a: Array = pose_a, pose_b: Array = pose_b) -> Array:
            reach = SHAPES[a][1](-n @ pose_a[:3, :3]) + SHAPES[b][1](n @ pose_b[:3, :3])
            return np.asarray(reach + n @ (pose_b[:3, 3] - pose_a[:3, 3]))

        least = depth(many).min()
        contacts = contacts_of(world)
        if not contacts:
            assert least < 0.02  # zero but for the directions' grid
            continue
        touching += 1
        deepest = max(contacts, key=lambda contact: contact.depth)
        assert deepest.depth <= least + 1e-6
        assert deepest.depth == pytest.approx(depth(deepest.normal), abs=1e-6)
        assert len(contacts) <= 4
        for contact in contacts:
            np.testing.assert_allclose(np.linalg.norm(contact.normal), 1, atol=1e-12)
    assert touching >= 3


@pytest.mark.parametrize("shape", ["cylinder", "cone"])
def test_a_disc_that_is_hardly_tilted_rests_on_more_than_a_point(shape: str) -> None:
    """Whichever way it leans, also where its lowest point is next to one of the corners that stand for its rim."""
    world = pydart2.World(0.001, up="z")
    world.set_collision_detector("native")
    world.add_ground()
    body = world.add_empty_skeleton("body")
    part = body.add_body("part", position=(0.0, 0.0, 0.48))
    part.add_cylinder(0.5, 1.0) if shape == "cylinder" else part.add_cone(0.5, 1.0)
    height = body.q[5]
    for way in np.linspace(0.0, 2.0 * np.pi, 181):
        for angle in (1e-5, 1e-3, 4e-3):
            body.q = [angle * np.cos(way), angle * np.sin(way), 0.0, 0.0, 0.0, height]
            places = np.array([contact.point[:2] for contact in contacts_of(world)])
            assert len(places) >= 3, (way, angle)
            assert np.ptp(places, axis=0).min() > 0.5


@pytest.mark.parametrize(("a", "b"), list(itertools.combinations(SHAPES, 2)))
def test_the_order_of_two_shapes_does_not_matter(tmp_path: Path, a: str, b: str) -> None:
    rng = np.random.default_rng(5)
    worlds = two(tmp_path, SHAPES[a][0], SHAPES[b][0]), two(tmp_path, SHAPES[b][0], SHAPES[a][0])
    for _ in range(5):
        poses = [rng.normal(size=6), rng.normal(size=6)]
        poses[1][3:] = poses[0][3:] + 0.4 * rng.uniform(-1, 1, size=3)
        rows = []
        for world, order in zip(worlds, (poses, poses[::-1]), strict=True):
            for skel, q in zip(world.skeletons, order, strict=True):
                skel.q = q
            sign = 1 if world is worlds[0] else -1
            rows.append(sorted([*np.round([*c.point, *(sign * c.normal), c.depth], 6)] for c in contacts_of(world)))
        np.testing.assert_allclose(rows[0], rows[1], atol=1e-4)  # depths to 1e-9, normals to its root


DEEP = 0.01
ON_FLOOR = [
    # shape, height of its lowest point below its centre, turn about x, places of the contacts (x, z)
    ("box", box((1, 0.8, 0.6)), 0.4, 0.0, [(x, z) for x in (-0.5, 0.5) for z in (-0.3, 0.3)]),
    ("sphere", sphere(0.5), 0.5, 0.3, [(0, 0)]),
    ("capsule lying", CAPSULE, 0.3, 0.0, [(0, -0.3), (0, 0.3)]),
    ("capsule standing", CAPSULE, 0.6, QUARTER, [(0, 0)]),
    ("cylinder lying", CYLINDER, 0.4, 0.0, [(0, -0.35), (0, 0.35)]),
    ("cylinder standing", CYLINDER, 0.35, QUARTER, [(-0.4, 0), (0, -0.4), (0, 0.4), (0.4, 0)]),
    ("cone standing", CONE, 0.5, -QUARTER, [(-0.5, 0), (0, -0.5), (0, 0.5), (0.5, 0)]),
    ("cone on its tip", CONE, 0.5, QUARTER, [(0, 0)]),
    ("ellipsoid", ELLIPSOID, 0.5, 0.0, [(0, 0)]),
    ("pyramid", PYRAMID, 0.5, -QUARTER, [(x, z) for x in (-0.5, 0.5) for z in (-0.4, 0.4)]),
]


@pytest.mark.parametrize("ground", [floor(), PLANE], ids=["box", "plane"])
@pytest.mark.parametrize(
    ("shape", "low", "turn", "places"), [row[1:] for row in ON_FLOOR], ids=[r[0] for r in ON_FLOOR]
)
def test_what_lies_on_a_floor(
    tmp_path: Path, ground: str, shape: str, low: float, turn: float, places: list[tuple[float, float]]
) -> None:
    """Where it touches, how deep and which way, to rounding."""
    world = make_world(tmp_path, ground, free_body(at=(0, low - DEEP, 0, turn, 0, 0), shape=shape))
    world.set_collision_detector("native")
    contacts = contacts_of(world)
    found = sorted((round(c.point[0], 6) + 0.0, round(c.point[2], 6) + 0.0) for c in contacts)
    np.testing.assert_allclose(found, sorted(places), atol=1e-6)
    for contact in contacts:
        assert contact.depth == pytest.approx(DEEP, abs=1e-9)
        assert contact.point[1] == pytest.approx(-DEEP / 2, abs=1e-9)
        np.testing.assert_allclose(contact.normal, (0, -1, 0), atol=1e-9)
        assert contact.skel_id1 == 0


def test_two_edges_of_boxes(tmp_path: Path) -> None:
    """Crossed at right angles, each box on an edge: one point, midway between the edges."""
    cube, half = box((1, 1, 1)), np.sqrt(0.5)
    world = two(tmp_path, cube, cube)
    a, b = world.skeletons
    a.q = [QUARTER / 2, 0, 0, 0, 0, 0]
    b.q = [0, 0, QUARTER / 2, 0.1, 2 * half - DEEP, 0.05]
    (contact,) = contacts_of(world)
    np.testing.assert_allclose(contact.point, (0.1, half - DEEP / 2, 0), atol=1e-12)
    np.testing.assert_allclose(contact.normal, (0, -1, 0), atol=1e-12)
    assert contact.depth == pytest.approx(DEEP, abs=1e-12)


@pytest.mark.parametrize(("dt", "size"), [(0.001, 0.01), (0.005, 0.2), (0.005, 10.0)])
def test_each_shape_comes_to_rest(tmp_path: Path, dt: float, size: float) -> None:
    """Dropped from 2 % of its size on a box: two seconds later it is still, and less than 1 % of its size deep."""
    r, h, moment = size / 2, size, size * size / 8
    shapes = {
        "box": (box((size, size, size)), r, 0.0),
        "sphere": (sphere(r), r, 0.0),
        "capsule": (f"<capsule><radius>{r / 2}</radius><height>{r}</height></capsule>", r / 2, 0.0),
        "lying": (f"<cylinder><radius>{r}</radius><height>{h}</height></cylinder>", r, 0.0),
        "standing": (f"<cylinder><radius>{r}</radius><height>{h}</height></cylinder>", r, QUARTER),
        "cone": (f"<cone><radius>{r}</radius><height>{h}</height></cone>", r, -QUARTER),
        "ellipsoid": (f"<ellipsoid><size>{size} {r} {size}</size></ellipsoid>", r / 2, 0.0),
    }
    bodies = [
        free_body(name, at=(3 * i * size, low + 0.02 * size, 0, turn, 0, 0), shape=shape, inertia=(moment,) * 3)
        for i, (name, (shape, low, turn)) in enumerate(shapes.items())
    ]
    world = make_world(tmp_path, floor((60 * size, size, 10 * size)), *bodies, dt=dt)
    world.set_collision_detector("native")
    world.step(round(2 / dt))
    deepest = dict.fromkeys(shapes, -1.0)
    for contact in contacts_of(world):
        name = world.skeletons[contact.skel_id2].name
        deepest[name] = max(deepest[name], contact.depth)
    for skel in world.skeletons[1:]:
        assert np.abs(skel.dq).max() < 1e-3, skel.name
        assert 0 <= deepest[skel.name] < 0.01 * size, skel.name


def test_a_stack_of_twenty_stands(tmp_path: Path) -> None:
    size = 0.2
    boxes = [
        free_body(f"{i}", at=(0, (i + 0.5) * size, 0, 0, 0, 0), shape=box((size,) * 3), inertia=(size * size / 6,) * 3)
        for i in range(20)
    ]
    world = make_world(tmp_path, floor(), *boxes)
    world.set_collision_detector("native")
    world.step(300)
    for i, skel in enumerate(world.skeletons[1:]):
        np.testing.assert_allclose(skel.bodynodes[0].C, (0, (i + 0.5) * size, 0), atol=1e-4)
    assert world.collision_result.num_contacts() == 80


def heap(folder: Path) -> pydart2.World:
    rng = np.random.default_rng(1)
    bodies = [
        free_body(
            f"{kind}{i}", at=(*rng.uniform(-0.3, 0.3, 2), 0.8 * i + 0.7, *rng.normal(size=3)), shape=SHAPES[kind][0]
        )
        for i, kind in enumerate(list(SHAPES) * 2)
    ]
    world = make_world(folder, floor((20, 20, 1)), *bodies, dt=0.002, gravity=(0, 0, -9.81))
    world.set_collision_detector("native")
    return world


def unpickled(world: pydart2.World) -> pydart2.World:
    copy: pydart2.World = pickle.loads(pickle.dumps(world))
    return copy


def test_a_heap_goes_on_as_before(tmp_path: Path) -> None:
    """From a snapshot, in a clone and out of a pickle, bit for bit, also after a body has gone."""
    world = heap(tmp_path)
    world.step(300)
    world.remove_skeleton(world.skeletons[3])
    world.step(100)
    assert world.collision_result.num_contacts() >= 8
    start = world.snapshot()
    others = [copy(world) for copy in (pydart2.World.clone, unpickled)]
    world.step(100)
    end = world.snapshot().values.tobytes()
    world.restore(start)
    for other in (world, *others):
        assert other.collision_detector_string() == "NATIVE_COLLISION_DETECTOR"
        other.step(100)
        assert other.snapshot().values.tobytes() == end


def test_filters(tmp_path: Path) -> None:
    world = two(tmp_path, sphere(0.5), box((1, 1, 1)))
    a, b = (skel.bodynodes[0] for skel in world.skeletons)
    assert contacts_of(world)
    world.collision_filter.add_to_black_list(a, b)
    assert not contacts_of(world)
    world.collision_filter.remove_from_black_list(a, b)
    assert contacts_of(world)


def lets_collide(a: pydart2.BodyNode, b: pydart2.BodyNode) -> bool:
    """The engine's rule for two bodies."""
    if not (a.is_collidable() and b.is_collidable() and (a.skel.is_mobile() or b.skel.is_mobile())):
        return False
    if a.skel is not b.skel:
        return True
    are_neighbors = a in (b.parent_bodynode, *b.child_bodynodes)
    return a.skel.self_collision_check() and (a.skel.adjacent_body_check() or not are_neighbors)


def test_what_the_engine_lets_collide(tmp_path: Path) -> None:
    """Fixed, not collidable, excluded, of one skeleton or neighbors in it: the pairs of the engine's rule."""
    ball, rng = sphere(0.5), np.random.default_rng(7)
    chain = [body(f"link{i}", at=(0, 0.1 * i, 0, 0, 0, 0), shape=ball) for i in range(3)]
    joints = [
        joint("revolute", f"link{i}", f"link{i - 1}" if i else "world", axis=(0, 0, 1), name=f"j{i}") for i in range(3)
    ]
    others = [free_body(name, at=(0.1, y, 0.2, 0, 0, 0), shape=ball) for name, y in (("a", -0.1), ("b", 0.25))]
    world = make_world(tmp_path, skeleton(*chain, *joints, name="chain"), *others)
    pairs = list(itertools.combinations([each for skel in world.skeletons for each in skel.bodynodes], 2))
    seen = set()
    for i in range(100):
        for skel in world.skeletons:
            skel.set_mobile(bool(rng.integers(2)))
            for each in skel.bodynodes:
                each.set_collidable(bool(rng.integers(4)))
        chained = world.skeletons[0]
        chained.set_self_collision_check(bool(rng.integers(2)))
        chained.set_adjacent_body_check(bool(rng.integers(2)))
        world.collision_filter.remove_all_from_black_list()
        ignored = pairs[rng.integers(len(pairs))]
        world.collision_filter.add_to_black_list(*ignored)
        expected = {frozenset(pair) for pair in pairs if pair != ignored and lets_collide(*pair)}
        world.set_collision_detector(("dart", "native", "fcl", "bullet", "ode")[i % 5])
        assert {frozenset((c.bodynode1, c.bodynode2)) for c in contacts_of(world)} == expected
        seen |= expected
    assert len(seen) == 10


def test_batches_keep_the_detector(tmp_path: Path) -> None:
    world = heap(tmp_path)
    batch = pydart2.Batch(world, 2, threads=2)
    batch.step(300)
    world.step(300)
    for each in batch.worlds:
        assert each.collision_detector_string() == "NATIVE_COLLISION_DETECTOR"
        assert each.x.tobytes() == world.x.tobytes()
