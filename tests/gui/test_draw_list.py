"""What a world becomes: one item for each visible shape, where and as large as the shape is."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import pydart2
from pydart2.gui import geometry
from pydart2.gui.draw_list import Item, Scene, Show, from_world
from pydart2.gui.placing import between, boxes
from pydart2.gui.shapes import add_shapenode
from pydart2.simulation.up import up_of

from .worlds import GEOMETRIES, body, box, primitives, sphere, textured_board, world_of


def only(scene: Scene) -> Item:
    (item,) = scene.items
    return item


def test_each_kind_of_shape_fills_its_bounding_box() -> None:
    world = primitives()
    for skel, kind in zip(world.skeletons[1:], GEOMETRIES):
        node = skel.bodynodes[0].shapenodes[0]
        assert node.shape is not None and node.shape.type() == kind
        scene = Scene()
        add_shapenode(scene, node, pose=np.eye(4))
        low, high = node.shape.bounding_box()
        if kind == "ConeShape":  # the engine's own box is twice as high
            low[2], high[2] = -0.1, 0.1
        assert boxes(scene)[0] == pytest.approx(np.array([low, high]), abs=1e-3)


def test_items_have_the_pose_colour_and_ids_of_their_shapes() -> None:
    world = world_of(body(sphere(0.1)), body(box(0.1, 0.2, 0.3), "1 2 3 0.1 0.2 0.3", "0.1 0.5 0.9"))
    item = from_world(world).items[1]
    node = world.skeletons[1].bodynodes[0].shapenodes[0]
    assert item.ids == (1, 0)
    assert item.rgba == pytest.approx([0.1, 0.5, 0.9, 1.0])
    assert item.transform == pytest.approx(node.world_transform() @ np.diag([0.1, 0.2, 0.3, 1.0]))


def test_equal_primitives_share_their_mesh() -> None:
    world = world_of(*(body(sphere(0.1 * i)) for i in (1, 2, 3)))
    assert len({id(item.mesh) for item in from_world(world)}) == 1


def test_the_same_file_twice_is_one_mesh() -> None:
    world = pydart2.World(0.001)
    for _ in range(2):
        world.add_skeleton(pydart2.data_path("sdf/atlas/atlas_v3_no_head.sdf"))
    items = from_world(world).items
    assert len(items) == 2 * len({id(item.mesh) for item in items if item.ids[0] == 0})
    assert {item.ids[0] for item in items} == {0, 1}
    assert [id(i.mesh) for i in items if i.ids[0] == 0] == [id(i.mesh) for i in items if i.ids[0] == 1]


def test_up_is_against_gravity() -> None:
    world = pydart2.World(0.001)
    assert up_of(world) == pytest.approx([0.0, 1.0, 0.0])
    world.set_gravity([0.0, 0.0, -9.81])
    assert from_world(world).up == pytest.approx([0.0, 0.0, 1.0])
    world.set_gravity([0.0, 0.0, 0.0])
    assert up_of(world) == pytest.approx([0.0, 1.0, 0.0])


def test_floors_are_what_is_fixed_wide_and_flat() -> None:
    floor, wall, plate = box(5.0, 0.1, 5.0), box(0.1, 5.0, 5.0), box(0.5, 0.01, 0.5)
    world = world_of(*(body(g, fixed=True) for g in (floor, wall, plate)), body(floor, "0 3 0 0 0 0"))
    items = from_world(world).items
    assert [item.casts for item in items] == [False, True, True, True]
    assert [item.grid > 0.0 for item in items] == [True, False, False, False]


def test_a_plane_is_drawn_where_it_is() -> None:
    plane = "<plane><normal>0 1 0</normal><offset>0.5</offset></plane>"
    item = only(from_world(world_of(body(plane, "0 1 0 0 0 0", fixed=True))))
    low, high = boxes([item])[0]
    assert low[1] == high[1] == pytest.approx(1.5)
    assert not item.casts


def test_hidden_clear_and_colliding_shapes() -> None:
    world = primitives()
    node = world.skeletons[1].bodynodes[0].shapenodes[0]
    count = len(from_world(world))
    node.set_visual_aspect_rgba([1.0, 0.0, 0.0, 0.0])
    assert len(from_world(world)) == count - 1
    assert len(from_world(world, Show(collision_shapes=True))) == 0  # these bodies have none that collide
    assert len(from_world(world, Show(bodies=False))) == 0


def test_materials_and_textures_come_from_the_file(tmp_path: Any) -> None:
    board, yellow = from_world(textured_board(tmp_path)).items
    if board.mesh.texture is None:
        board, yellow = yellow, board
    assert board.mesh.texture == str(tmp_path / "quarters.png")
    assert board.mesh.texture_coordinates is not None and len(board.mesh.texture_coordinates) == 4
    assert yellow.mesh.texture is None
    assert yellow.rgba == pytest.approx([1.0, 1.0, 0.0, 1.0])
    one_color = Scene()
    one_color.add_skeleton(textured_board(tmp_path).skeletons[0], (0.1, 0.2, 0.3))
    assert all(item.rgba == pytest.approx([0.1, 0.2, 0.3, 1.0]) for item in one_color)


def test_soft_bodies_follow_their_points() -> None:
    world = pydart2.World(0.001, pydart2.data_path("skel/softBodies.skel"))
    soft = next(b for skel in world.skeletons for b in skel.bodynodes if isinstance(b, pydart2.SoftBodyNode))
    world.step(300)
    item = next(i for i in from_world(world) if i.ids == (soft.skeleton.id, soft.id) and not i.mesh.is_lasting)
    points = item.mesh.vertices @ item.transform[:3, :3].T + item.transform[:3, 3]
    assert {tuple(p) for p in points.round(4)} == {tuple(p) for p in soft.point_world_positions().round(4)}


class Handle(SimpleNamespace):
    """A shape as the engine would tell of it; no model file can have these kinds."""

    def id(self) -> int:
        return -id(self)

    def version(self) -> int:
        return 0

    def __getattr__(self, name: str) -> Any:
        if f"{name}_" not in vars(self):
            raise AttributeError(name)
        return lambda: vars(self)[f"{name}_"]


POSE = between(np.array([1.0, 0.0, 0.0]), np.array([1.0, 2.0, 0.5]))


def drawn(**answers: Any) -> Scene:
    handle = Handle(**{f"{name}_": value for name, value in answers.items()})
    node_handle = SimpleNamespace(
        shape=lambda: handle, world_transform=lambda: POSE, rgba=lambda: np.array([0.2, 0.4, 0.6, 1.0])
    )
    bodynode = SimpleNamespace(id=0, _handle=SimpleNamespace(num_dependent_dofs=lambda: 1))
    skeleton = SimpleNamespace(id=0, is_mobile=lambda: True)
    scene = Scene()
    add_shapenode(scene, SimpleNamespace(_handle=node_handle, bodynode=bodynode, skeleton=skeleton))  # type: ignore[arg-type]
    return scene


def in_world(points: Any) -> Any:
    return np.asarray(points) @ POSE[:3, :3].T + POSE[:3, 3]


def test_heightmap() -> None:
    item = only(
        drawn(type="HeightmapShape (d)", heights=np.array([[0.0, 1.0], [2.0, 3.0]]), scale=np.array([2, 4, 0.5]))
    )
    vertices = np.c_[item.mesh.vertices, np.ones(4)] @ item.transform[:3].T
    assert vertices == pytest.approx(in_world([[-1, 2, 0], [1, 2, 0.5], [-1, -2, 1.0], [1, -2, 1.5]]), abs=1e-6)


def test_point_cloud_and_voxels() -> None:
    points = np.array([[0.0, 0.0, 0.0], [1.0, 2.0, 3.0]])
    colors = np.array([[1.0, 0.0, 0.0, 1.0], [0.0, 1.0, 0.0, 0.5]])
    cloud = drawn(type="PointCloudShape", points=points, point_colors=colors, point_size=0.02)
    assert np.array([item.transform[:3, 3] for item in cloud]) == pytest.approx(in_world(points))
    assert np.array([item.rgba for item in cloud]) == pytest.approx(colors)
    assert cloud.items[0].transform[:3, :3] == pytest.approx(0.02 * POSE[:3, :3])
    plain = drawn(type="PointCloudShape", points=points, point_colors=np.empty((0, 4)), point_size=0.02)
    assert plain.items[0].rgba == pytest.approx([0.2, 0.4, 0.6, 1.0])
    voxels = drawn(type="VoxelGridShape", voxels=np.c_[points, [0.1, 0.2]])
    assert [np.linalg.norm(item.transform[:3, 0]) for item in voxels] == pytest.approx([0.1, 0.2])


def test_line_segments_are_rods() -> None:
    scene = drawn(type="LineSegmentShape", segments=np.array([[0, 0, 0, 0, 0, 2.0], [1, 0, 0, 1, 0, 0]]), thickness=2.0)
    item = only(scene)  # no rod for a segment without length
    ends = item.transform @ np.array([[0, 0, -0.5, 1], [0, 0, 0.5, 1]], float).T
    assert pytest.approx(in_world([[0, 0, 0], [0, 0, 2.0]])) == ends[:3].T


def test_pyramid_and_kinds_that_are_not_known() -> None:
    item = only(drawn(type="PyramidShape", base_width=1.0, base_depth=2.0, height=3.0))
    assert np.linalg.norm(item.transform[:3, :3], axis=0) == pytest.approx([1.0, 2.0, 3.0])
    other = only(drawn(type="NewShape", bounding_box_min=np.zeros(3), bounding_box_max=np.array([1.0, 2.0, 3.0])))
    assert other.mesh is geometry.box()
    assert other.transform[:3, 3] == pytest.approx(in_world([0.5, 1.0, 1.5]))
    assert not drawn(
        type="EndlessShape", bounding_box_min=np.full(3, -np.inf), bounding_box_max=np.full(3, np.inf)
    ).items


def test_contacts_are_dots_and_arrows_along_the_force() -> None:
    scene = Scene()
    scene.add_contacts(np.array([[1.0, 2.0, 3.0, 0.0, 100.0, 0.0], [0.0, 0.0, 0.0, 0.0, 0.0, 0.0]]), 0.02, -0.005)
    dot, shaft, head, _ = scene.items  # the second force is none and has no arrow
    assert dot.transform[:3, 3] == pytest.approx([1.0, 2.0, 3.0])
    assert np.linalg.norm(dot.transform[:3, 0]) == pytest.approx(0.02)
    assert head.transform @ [0, 0, 0.5, 1] == pytest.approx([1.0, 1.5, 3.0, 1.0])
    assert shaft.transform @ [0, 0, -0.5, 1] == pytest.approx([1.0, 2.0, 3.0, 1.0])
    assert not any(item.casts for item in scene)


def test_signs() -> None:
    world = pydart2.World(0.001)
    skel = world.add_skeleton(pydart2.data_path("sdf/atlas/atlas_v3_no_head.sdf"))
    count = len(from_world(world))
    hinges = sum(joint.num_dofs() == 1 for joint in skel.joints)
    assert len(from_world(world, Show(frames=True))) == count + 6 * len(skel.bodynodes)
    assert len(from_world(world, Show(joint_axes=True))) == count + 2 * hinges
    added = from_world(world, Show(centers_of_mass=True)).items[-1]
    assert added.transform[:3, 3] == pytest.approx(skel.C)
    skel.bodynodes[0].add_ext_force_with_arrow([0.0, 0.0, 100.0])
    assert len(from_world(world)) == count + 2
    assert len(from_world(world, Show(forces=False))) == count


def test_markers_are_drawn_where_they_are() -> None:
    marked = body(sphere(0.1), "1 2 3 0 0 0").replace(
        "</body>", '<marker name="m"><offset>0 0 0.5</offset></marker></body>'
    )
    world = world_of(marked)
    (marker,) = world.skeletons[0].markers or [None]
    assert marker is not None
    item = from_world(world).items[-1]
    assert item.transform[:3, 3] == pytest.approx(marker.p)
    assert item.ids == (0, 0)


def test_sleepers_are_paler() -> None:
    world = pydart2.World(0.002, up="z")
    world.set_sleeping()
    world.add_ground()
    world.add_box((0.2, 0.2, 0.2), 1.0, (0.0, 0.0, 0.1), color=(0.8, 0.0, 0.0))
    world.step(500)
    assert len(world.sleepers()) == 1
    colours = [
        next(item.rgba for item in from_world(world, show) if item.ids[0] == world.skeletons[1].id)
        for show in (Show(), Show(sleepers=True))
    ]
    assert colours[0] == pytest.approx([0.8, 0.0, 0.0, 1.0])
    assert colours[1][2] > colours[0][2] + 0.3
    assert len(world.recording.sleepers(0)) == 0
    last = world.recording.num_frames() - 1
    assert world.recording.sleepers(last) == [world.skeletons[1]]


def test_recorded_frames_show_who_slept_then() -> None:
    """As in the window when its slider is moved, and not who sleeps at the end of the recording."""
    world = pydart2.World(0.002, up="z")
    world.set_sleeping()
    world.add_ground()
    boxes = [world.add_box((0.2, 0.2, 0.2), 1.0, (0.5 * i, 0.0, 0.1 + 0.3 * i)) for i in range(2)]

    def pale() -> list[int]:
        shown = (from_world(world), from_world(world, Show(sleepers=True)))
        return sorted({a.ids[0] for a, b in zip(*shown, strict=True) if not np.allclose(a.rgba, b.rgba)})

    world.step(500)
    assert world.recording is not None
    slept = [world.recording.sleepers(frame) for frame in range(501)]
    one, two = slept.index([boxes[0]]), slept.index(boxes)
    assert 0 < one < two
    for frame in (0, one, two, 500, one, 0):
        assert world.set_frame(frame)
        assert pale() == [box.id for box in slept[frame]]
    world.step()
    assert pale() == []
