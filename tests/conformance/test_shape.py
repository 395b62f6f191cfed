"""Markers, shape nodes and shapes."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

import pydart2
from oracle.models import dart_model
from pydart2 import Marker, ShapeNode, Skeleton
from pydart2.shape import LineSegmentShape, Shape, create_shape

from .table import row, rows

TURN = np.array([[0.0, -1, 0, 0.1], [1, 0, 0, 0.2], [0, 0, 1, 0.3], [0, 0, 0, 1]])
KINDS = ("Sphere", "Box", "Ellipsoid", "Cylinder", "Capsule", "Cone", "Plane", "MultiSphere", "Mesh")


@pytest.fixture
def marker(zoo: Skeleton) -> Marker:
    return zoo.markers[6]


@pytest.fixture
def node(zoo: Skeleton) -> ShapeNode:
    """That of the box."""
    return zoo.bodynodes[1].shapenodes[0]


def shape_of(zoo: Skeleton, kind: str) -> Any:
    return zoo.bodynodes[KINDS.index(kind)].shapenodes[0].shape


# Markers


@row("marker.Marker", "marker.Marker.build")
def test_marker(zoo: Skeleton) -> None:
    marker = Marker(zoo, 6)
    marker.build()
    assert marker.bodynode.markers[-1] is marker
    assert_allclose(marker.p, zoo.markers[6].p)


@rows(
    "marker.Marker.",
    {
        "skeleton": lambda marker: marker.skeleton is marker.bodynode.skeleton,
        "skel": lambda marker: marker.skel.markers[6] is marker,
        "id": lambda marker: marker.id == 6,
        "name": lambda marker: marker.name == "M0006",
        "bodynode": lambda marker: marker.bodynode is marker.skel.bodynodes[6],
        "wid": lambda marker: marker.wid == marker.skel.world.id,
        "skid": lambda marker: marker.skid == marker.skel.id,
        "__repr__": lambda marker: repr(marker) == "[Marker(6)]",
    },
)
def test_attribute_of_marker(marker: Marker, case: Callable[[Marker], bool]) -> None:
    assert case(marker)


@row("marker.Marker.p", "marker.Marker.world_position")
def test_world_position(marker: Marker) -> None:
    expected = marker.bodynode.to_world([0, 0, 6])
    assert_allclose(marker.world_position(), expected)
    assert_allclose(marker.p, expected)


@row("marker.Marker.local_position", "marker.Marker.set_local_position")
def test_local_position(marker: Marker) -> None:
    assert_allclose(marker.local_position(), [0, 0, 6])
    marker.set_local_position([1, 2, 3])
    assert_allclose(marker.local_position(), [1, 2, 3])
    assert_allclose(marker.p, marker.bodynode.to_world([1, 2, 3]))


# Shape nodes


@row("shapenode.ShapeNode", "shapenode.ShapeNode.build")
def test_shapenode(node: ShapeNode) -> None:
    again = ShapeNode(node.bodynode, 0)
    again.build()
    again.set_offset([1, 2, 3])
    assert_allclose(node.offset(), [1, 2, 3])


@rows(
    "shapenode.ShapeNode.",
    {
        "bodynode": lambda node: node.bodynode is node.skel.bodynodes[1],
        "skeleton": lambda node: node.skeleton is node.bodynode.skeleton,
        "skel": lambda node: node.skel is node.bodynode.skeleton,
        "id": lambda node: node.id == 0,
        "shape": lambda node: node.shape.type() == "BoxShape",
        "wid": lambda node: node.wid == node.skel.world.id,
        "skid": lambda node: node.skid == node.skel.id,
        "bid": lambda node: node.bid == 1,
        "__repr__": lambda node: repr(node) == "[ShapeNode(1:0)]",
    },
)
def test_attribute_of_shapenode(node: ShapeNode, case: Callable[[ShapeNode], bool]) -> None:
    assert case(node)


@row("shapenode.ShapeNode.has_visual_aspect", "shapenode.ShapeNode.has_collision_aspect")
def test_aspects(cubes: pydart2.World) -> None:
    nodes = cubes.skeletons[1].bodynodes[0].shapenodes
    assert [node.has_visual_aspect() for node in nodes] == [True, False]
    assert [node.has_collision_aspect() for node in nodes] == [False, True]


@row("shapenode.ShapeNode.visual_aspect_rgba", "shapenode.ShapeNode.set_visual_aspect_rgba")
def test_rgba(cubes: pydart2.World) -> None:
    visual, collision = cubes.skeletons[1].bodynodes[0].shapenodes
    rgba = visual.visual_aspect_rgba()
    assert rgba is not None
    assert_allclose(rgba, [0.8, 0.3, 0.3, 1], atol=1e-6)
    visual.set_visual_aspect_rgba([0.1, 0.2, 0.3, 0.4])
    assert_allclose(visual.visual_aspect_rgba(), [0.1, 0.2, 0.3, 0.4])  # type: ignore[arg-type]
    collision.set_visual_aspect_rgba([0.1, 0.2, 0.3, 0.4])
    assert collision.visual_aspect_rgba() is None


@row("shapenode.ShapeNode.offset", "shapenode.ShapeNode.set_offset")
def test_offset(node: ShapeNode) -> None:
    assert_allclose(node.offset(), [0, 0.5, 0])
    node.set_offset([1, 2, 3])
    assert_allclose(node.offset(), [1, 2, 3])
    assert_allclose(node.relative_transform()[:3, 3], [1, 2, 3])


@row("shapenode.ShapeNode.relative_transform", "shapenode.ShapeNode.set_relative_transform")
def test_relative_transform(node: ShapeNode) -> None:
    node.set_relative_transform(TURN)
    assert_allclose(node.relative_transform(), TURN)
    assert_allclose(node.offset(), [0.1, 0.2, 0.3])


@row("shapenode.ShapeNode.world_transform")
def test_world_transform(node: ShapeNode) -> None:
    node.set_relative_transform(TURN)
    assert_allclose(node.world_transform(), node.bodynode.T @ TURN)


# Shapes


@row("shape.Shape", "shape.Shape.build")
def test_shape(node: ShapeNode) -> None:
    shape = Shape(node)
    shape.build()
    assert shape.volume() == pytest.approx(0.006)


@rows(
    "shape.Shape.",
    {
        "shapenode": lambda shape: shape.shapenode is shape.skel.bodynodes[1].shapenodes[0],
        "bodynode": lambda shape: shape.bodynode is shape.skel.bodynodes[1],
        "skeleton": lambda shape: shape.skeleton is shape.shapenode.skeleton,
        "skel": lambda shape: shape.skel is shape.skeleton,
        "id": lambda shape: shape.id == 0,
        "wid": lambda shape: shape.wid == shape.skel.world.id,
        "skid": lambda shape: shape.skid == shape.skel.id,
        "bid": lambda shape: shape.bid == 1,
        "volume": lambda shape: abs(shape.volume() - 0.006) < 1e-12,
        "type": lambda shape: shape.type() == "BoxShape",
        "shape_type_name": lambda shape: shape.shape_type_name() == "BoxShape",
        "type_id": lambda shape: shape.type_id() == 1,
        "shape_type": lambda shape: shape.shape_type() == 1,
        "bounding_box": lambda shape: np.allclose(shape.bounding_box(), [[-0.05, -0.1, -0.15], [0.05, 0.1, 0.15]]),
        "__repr__": lambda shape: repr(shape) == "[BoxShape(1:0)]",
    },
)
def test_attribute_of_shape(zoo: Skeleton, case: Callable[[Any], bool]) -> None:
    assert case(shape_of(zoo, "Box"))


VOLUMES = {
    "Sphere": 4 / 3 * np.pi * 0.1**3,
    "Box": 0.006,
    "Ellipsoid": 4 / 3 * np.pi * 0.05 * 0.1 * 0.15,
    "Cylinder": np.pi * 0.1**2 * 0.3,
    "Capsule": np.pi * 0.1**2 * 0.3 + 4 / 3 * np.pi * 0.1**3,
    "Cone": np.pi * 0.1**2 * 0.3 / 3,
}


@rows("shape.", {f"{kind}Shape": kind for kind in KINDS})
def test_kind(zoo: Skeleton, case: str) -> None:
    shape = shape_of(zoo, case)
    assert type(shape) is getattr(pydart2.shape, f"{case}Shape")
    assert shape.type_id() == KINDS.index(case)
    if case in VOLUMES:
        assert shape.volume() == pytest.approx(VOLUMES[case])


ROUND = ("Cylinder", "Capsule", "Cone")


@rows("shape.", {f"{kind}Shape.{prefix}radius": kind for kind in ("Sphere", *ROUND) for prefix in ("", "set_")})
def test_radius(zoo: Skeleton, case: str) -> None:
    shape = shape_of(zoo, case)
    assert shape.radius() == pytest.approx(0.1)
    shape.set_radius(0.2)
    assert shape.radius() == 0.2
    assert shape.bounding_box()[1][0] == pytest.approx(0.2)
    with pytest.raises(ValueError):
        shape.set_radius(-0.1)


@rows("shape.", {f"{kind}Shape.{prefix}height": kind for kind in ROUND for prefix in ("", "set_")})
def test_height(zoo: Skeleton, case: str) -> None:
    shape = shape_of(zoo, case)
    assert shape.height() == pytest.approx(0.3)
    shape.set_height(0.6)
    assert shape.height() == 0.6
    caps = 4 / 3 * np.pi * 0.1**3 if case == "Capsule" else 0.0  # the caps do not grow
    assert shape.volume() == pytest.approx(2 * VOLUMES[case] - caps)


@rows("shape.", {f"{kind}Shape.{prefix}size": kind for kind in ("Box", "Ellipsoid") for prefix in ("", "set_")})
def test_size(zoo: Skeleton, case: str) -> None:
    shape = shape_of(zoo, case)
    assert_allclose(shape.size(), [0.1, 0.2, 0.3])
    shape.set_size([0.2, 0.4, 0.6])
    assert_allclose(shape.size(), [0.2, 0.4, 0.6])
    assert shape.volume() == pytest.approx(8 * VOLUMES[case])


@row("shape.PlaneShape.normal", "shape.PlaneShape.set_normal")
def test_normal(zoo: Skeleton) -> None:
    shape = shape_of(zoo, "Plane")
    assert_allclose(shape.normal(), [0, 0, 1])
    shape.set_normal([0, 3, 4])
    assert_allclose(shape.normal(), [0, 0.6, 0.8])


@row("shape.PlaneShape.offset", "shape.PlaneShape.set_offset")
def test_plane_offset(zoo: Skeleton) -> None:
    shape = shape_of(zoo, "Plane")
    assert shape.offset() == pytest.approx(0.25)
    shape.set_offset(-1.5)
    assert shape.offset() == -1.5


@row("shape.MultiSphereShape.spheres", "shape.MultiSphereShape.num_spheres", "shape.MultiSphereShape.add_sphere")
def test_spheres(zoo: Skeleton) -> None:
    shape = shape_of(zoo, "MultiSphere")
    assert shape.num_spheres() == 2
    shape.add_sphere(0.3, [1, 2, 3])
    assert shape.num_spheres() == 3
    assert [sphere["r"] for sphere in shape.spheres()] == [0.1, 0.2, 0.3]
    assert_allclose([sphere["pos"] for sphere in shape.spheres()], [[0, 0, 0.5], [0, 0, -0.5], [1, 2, 3]])


@row("shape.MeshShape.scale", "shape.MeshShape.path")
def test_mesh(zoo: Skeleton) -> None:
    shape = shape_of(zoo, "Mesh")
    assert_allclose(shape.scale(), [1, 2, 3])
    with open(shape.path(), encoding="ascii") as file:
        assert file.read(7) == "v 0 0 0"
    assert_allclose(shape.bounding_box()[1], [1, 2, 3])


@row("shape.SoftMeshShape")
def test_soft_mesh() -> None:
    world = pydart2.World(0.001, dart_model("skel/soft_cubes.skel"))
    nodes = [node for skel in world.skeletons for body in skel.bodynodes for node in body.shapenodes]
    soft = [node.shape for node in nodes if node.shape is not None and node.shape.type() == "SoftMeshShape"]
    assert {(type(shape), shape.type_id()) for shape in soft} == {(pydart2.shape.SoftMeshShape, 9)}


@row("shape.LineSegmentShape")
def test_line_segments() -> None:
    assert LineSegmentShape.TYPE_ID == 10  # no file format has them


@row("shape.create_shape")
def test_create_shape(zoo: Skeleton) -> None:
    for body in zoo.bodynodes:
        node = body.shapenodes[0]
        assert type(create_shape(node)) is type(node.shape)
