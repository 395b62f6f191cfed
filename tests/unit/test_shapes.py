"""Shapes and shape nodes: sizes, volumes, boxes, colours, poses."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import pydart2
from physics.models import floor, free_body, make_world
from pydart2 import shape as shapes

PI = np.pi
MULTI = "<sphere><radius>0.5</radius><position>{} 0 0</position></sphere>"

# SKEL text, class, id, volume, half extents of the bounding box
KINDS = [
    ("<sphere><radius>0.5</radius></sphere>", "SphereShape", 0, 4 / 3 * PI * 0.125, (0.5, 0.5, 0.5)),
    ("<box><size>1 2 3</size></box>", "BoxShape", 1, 6.0, (0.5, 1.0, 1.5)),
    ("<ellipsoid><size>1 2 3</size></ellipsoid>", "EllipsoidShape", 2, PI, (0.5, 1.0, 1.5)),
    (
        "<cylinder><radius>0.5</radius><height>2</height></cylinder>",
        "CylinderShape",
        3,
        PI * 0.25 * 2,
        (0.5, 0.5, 1.0),
    ),
    (
        "<capsule><radius>0.5</radius><height>2</height></capsule>",
        "CapsuleShape",
        4,
        PI * 0.25 * 2 + 4 / 3 * PI * 0.125,
        (0.5, 0.5, 1.5),
    ),
    ("<cone><radius>0.5</radius><height>3</height></cone>", "ConeShape", 5, PI * 0.25, (0.5, 0.5, 1.5)),
    (f"<multi_sphere>{MULTI.format(-1)}{MULTI.format(1)}</multi_sphere>", "MultiSphereShape", 7, None, (1.5, 0.5, 0.5)),
]


def shape_of(folder: Path, text: str) -> shapes.Shape:
    body = make_world(folder, free_body(shape=text)).skeletons[0].bodynodes[0]
    shape = body.shapenodes[0].shape
    assert shape is not None
    return shape


@pytest.mark.parametrize(
    ("text", "name", "number", "volume"), [kind[:4] for kind in KINDS], ids=[kind[1] for kind in KINDS]
)
def test_kinds(tmp_path: Path, text: str, name: str, number: int, volume: float | None) -> None:
    shape = shape_of(tmp_path, text)
    assert type(shape).__name__ == name and isinstance(shape, getattr(shapes, name))
    assert shape.type_id() == shape.shape_type() == number
    assert shape.type() == shape.shape_type_name()
    if volume is not None:
        assert shape.volume() == pytest.approx(volume)
    assert repr(shape) == f"[{name}(0:0)]"
    assert (shape.id, shape.bid, shape.skid, shape.bodynode, shape.shapenode.shape) == (0, 0, 0, shape.bodynode, shape)


@pytest.mark.parametrize(("text", "half"), [kind[:1] + kind[4:] for kind in KINDS], ids=[kind[1] for kind in KINDS])
def test_bounding_boxes(tmp_path: Path, text: str, half: tuple[float, ...]) -> None:
    low, high = shape_of(tmp_path, text).bounding_box()
    np.testing.assert_allclose(high, half)
    np.testing.assert_allclose(low, -np.array(half))


def test_box_and_ellipsoid_sizes(tmp_path: Path) -> None:
    for text in (KINDS[1][0], KINDS[2][0]):
        shape = shape_of(tmp_path, text)
        assert shape.size().tolist() == [1, 2, 3]
        shape.set_size([2, 2, 2])
        assert shape.size().tolist() == [2, 2, 2]
        np.testing.assert_allclose(shape.bounding_box()[1], [1, 1, 1])


@pytest.mark.parametrize("text", [kind[0] for kind in KINDS[3:6]])
def test_round_sizes(tmp_path: Path, text: str) -> None:
    shape = shape_of(tmp_path, text)
    before = shape.volume()
    shape.set_radius(1.0)
    assert shape.radius() == 1.0
    if shape.type() != "CapsuleShape":
        assert shape.volume() == pytest.approx(4 * before)
    shape.set_height(5)
    assert shape.height() == 5.0


def test_sphere_grows_in_the_simulation(tmp_path: Path) -> None:
    ball = free_body(shape=KINDS[0][0], at=(0, 1.0, 0, 0, 0, 0))
    world = make_world(tmp_path, floor(), ball)
    world.check_collision()
    assert world.collision_result.num_contacts() == 0
    node = next(n for n in world.skeletons[1].bodynodes[0].shapenodes if n.has_collision_aspect())
    node.shape.set_radius(1.1)
    world.check_collision()
    assert world.collision_result.contacts[0].depth == pytest.approx(0.1, abs=1e-6)


def test_plane(tmp_path: Path) -> None:
    shape = shape_of(tmp_path, "<plane><normal>0 3 4</normal><offset>0.5</offset></plane>")
    assert isinstance(shape, shapes.PlaneShape) and shape.type_id() == 6
    np.testing.assert_allclose(shape.normal(), [0, 0.6, 0.8])
    assert shape.offset() == 0.5
    shape.set_normal([0, 0, 2])
    shape.set_offset(-1)
    assert shape.normal().tolist() == [0, 0, 1] and shape.offset() == -1


def test_multi_sphere(tmp_path: Path) -> None:
    shape = shape_of(tmp_path, KINDS[6][0])
    assert isinstance(shape, shapes.MultiSphereShape)
    assert shape.num_spheres() == 2
    assert [(s["r"], s["pos"].tolist()) for s in shape.spheres()] == [(0.5, [-1, 0, 0]), (0.5, [1, 0, 0])]
    shape.add_sphere(0.25, [0, 1, 0])
    assert shape.num_spheres() == 3 and shape.spheres()[2]["r"] == 0.25


def test_mesh() -> None:
    world = pydart2.World(0.001)
    skel = world.add_skeleton("sdf/atlas/atlas_v3_no_head.sdf")
    meshes = [n.shape for b in skel.bodynodes for n in b.shapenodes if isinstance(n.shape, shapes.MeshShape)]
    assert meshes
    for mesh in meshes:
        assert Path(mesh.path()).suffix in (".obj", ".dae", ".stl") and mesh.type_id() == 8
        assert mesh.scale().shape == (3,) and np.all(mesh.scale() > 0)
        low, high = mesh.bounding_box()
        assert np.all(low < high)
        assert mesh.volume() > 0


def test_shape_nodes(tmp_path: Path) -> None:
    body = make_world(tmp_path, free_body(shape=KINDS[1][0])).skeletons[0].bodynodes[0]
    drawn, colliding = body.shapenodes
    assert (drawn.has_visual_aspect(), drawn.has_collision_aspect()) == (True, False)
    assert colliding.has_collision_aspect()
    assert repr(colliding) == "[ShapeNode(0:1)]" and body.num_shapenodes() == 2
    assert (drawn.bid, drawn.skid, drawn.wid) == (0, 0, body.wid)


def test_colour(tmp_path: Path) -> None:
    node = make_world(tmp_path, free_body(shape=KINDS[1][0])).skeletons[0].bodynodes[0].shapenodes[0]
    node.set_visual_aspect_rgba([0.1, 0.2, 0.3, 0.4])
    np.testing.assert_allclose(node.visual_aspect_rgba(), [0.1, 0.2, 0.3, 0.4])
    for bad in ([1, 1, 1], [1, 1, 1, np.nan]):
        with pytest.raises(ValueError):
            node.set_visual_aspect_rgba(bad)


def test_colour_of_what_is_not_drawn(caplog: pytest.LogCaptureFixture) -> None:
    """No colour is read; setting one is logged and changes nothing."""
    world = pydart2.World(0.001, "skel/cubes.skel")
    hidden = [n for s in world.skeletons for b in s.bodynodes for n in b.shapenodes if not n.has_visual_aspect()]
    for node in hidden:
        assert node.visual_aspect_rgba() is None
        node.set_visual_aspect_rgba([1, 0, 0, 1])
        assert node.visual_aspect_rgba() is None
    assert len(caplog.records) == len(hidden)


def test_pose_of_a_node(tmp_path: Path) -> None:
    body = make_world(tmp_path, free_body(shape=KINDS[1][0], at=(1, 2, 3, 0.3, 0.2, 0.1))).skeletons[0].bodynodes[0]
    node = body.shapenodes[0]
    assert node.offset().tolist() == [0, 0, 0]
    node.set_offset([0.1, 0.2, 0.3])
    np.testing.assert_allclose(node.relative_transform()[:3, 3], [0.1, 0.2, 0.3])
    T = np.eye(4)
    T[:3, :3], T[:3, 3] = Rotation.from_euler("xyz", [0.1, 0.2, 0.3]).as_matrix(), [1, 0, -1]
    node.set_relative_transform(T)
    np.testing.assert_allclose(node.relative_transform(), T)
    np.testing.assert_allclose(node.world_transform(), body.T @ T, atol=1e-12)
    node.set_offset([5, 5, 5])
    np.testing.assert_allclose(node.relative_transform()[:3, :3], T[:3, :3])


@pytest.mark.parametrize("bad", [0, -1, np.nan, np.inf])
def test_bad_sizes(tmp_path: Path, bad: float) -> None:
    sphere, box = shape_of(tmp_path, KINDS[0][0]), shape_of(tmp_path, KINDS[1][0])
    with pytest.raises(ValueError, match="must be positive and finite, got"):
        sphere.set_radius(bad)
    with pytest.raises(ValueError, match=r"positive|finite"):
        box.set_size([1, bad, 1])
    with pytest.raises(ValueError, match=r"shape \(3,\), got \(2,\)"):
        box.set_size([1, 1])
    assert sphere.radius() == 0.5 and box.size().tolist() == [1, 2, 3]
