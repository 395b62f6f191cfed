"""The shapes of the engine as meshes: one function per kind. NumPy only."""

from __future__ import annotations

import hashlib
import os
from collections import OrderedDict
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pydart2.gui import geometry
from pydart2.gui.geometry import Mesh
from pydart2.gui.placing import between, boxes, grid_of
from pydart2.softbody import SoftBodyNode

if TYPE_CHECKING:
    from pydart2._native import MeshHandle
    from pydart2.gui.draw_list import Scene
    from pydart2.shapenode import ShapeNode

Array = NDArray[np.float64]
_PLANE_SIZE = 100.0  # m, of what is drawn of an endless plane
_LINE_RADIUS = 0.0015  # m, of a line one pixel wide
_NO_COLOR = np.array([0.5, 0.5, 1.0])  # what the engine gives to shapes whose file gives no colour ...
_PLEASANT = np.array([0.42, 0.56, 0.76])  # ... and what they are drawn in


class _Drawing:
    """Adds what one shape node looks like to a scene."""

    def __init__(self, scene: Scene, node: ShapeNode, rgba: ArrayLike | None, pose: Array | None) -> None:
        self.scene = scene
        self.node = node
        self.shape = node._handle.shape()
        self.pose = node._handle.world_transform() if pose is None else pose
        self.one_color = rgba
        self.rgba = _color_of(node) if rgba is None else np.asarray(rgba, dtype=float)
        self.ids = (node.skeleton.id, node.bodynode.id)

    def add(self, mesh: Mesh, scale: ArrayLike = 1.0, **rest: Any) -> None:
        """Add a mesh at the shape's pose."""
        self.scene.add(mesh, rest.pop("pose", self.pose), scale, rest.pop("rgba", self.rgba), self.ids, **rest)

    def add_each(self, mesh: Mesh, points: Array, sizes: Array, colors: Array) -> None:
        """Add a mesh at points of the shape's frame (n, 3), with sizes (n,) and colours (n, 4) or (4,)."""
        pose = np.tile(self.pose, (len(points), 1, 1))
        pose[:, :3, 3] += points @ self.pose[:3, :3].T
        for one, size, color in zip(pose, sizes, np.broadcast_to(colors, (len(points), 4))):
            self.add(mesh, size, pose=one, rgba=color)


def _color_of(node: ShapeNode) -> Array:
    rgba = node._handle.rgba()
    if np.array_equal(rgba[:3], _NO_COLOR):
        rgba[:3] = _PLEASANT
    return rgba


def add_shapenode(scene: Scene, node: ShapeNode, rgba: ArrayLike | None = None, *, pose: Array | None = None) -> None:
    """Add the shape of a node that has one, in its own colour or in `rgba`, where it is or at a pose (4, 4), m."""
    drawing = _Drawing(scene, node, rgba, pose)
    count = len(scene.items)
    kind = drawing.shape.type().split(" ")[0]  # "HeightmapShape (f)" tells its number type
    _KINDS.get(kind, _bounding_box)(drawing)
    if not node.bodynode._handle.num_dependent_dofs() or not node.skeleton.is_mobile():
        _mark_floors(scene, count)


def _mark_floors(scene: Scene, first: int) -> None:
    """What cannot move, is wide and is flat is a floor; it gets a grid if it has no detail of its own."""
    for i, item in enumerate(scene.items[first:], first):
        low, high = boxes([item])[0]
        extent = high - low
        width = float(np.sort(extent)[1])
        if width > 1.5 and float(extent @ np.abs(scene.up)) < 0.1 * width:
            grid = grid_of(width) if item.mesh in (geometry.box(), geometry.quad()) else 0.0
            scene.items[i] = item._replace(casts=False, specular=0.0, grid=grid)


def _sphere(d: _Drawing) -> None:
    d.add(geometry.sphere(), d.shape.radius())


def _box(d: _Drawing) -> None:
    d.add(geometry.box(), d.shape.size())


def _ellipsoid(d: _Drawing) -> None:
    d.add(geometry.sphere(), d.shape.size() / 2.0)


def _cylinder(d: _Drawing) -> None:
    radius = d.shape.radius()
    d.add(geometry.cylinder(), (radius, radius, d.shape.height()))


def _cone(d: _Drawing) -> None:
    radius = d.shape.radius()
    d.add(geometry.cone(), (radius, radius, d.shape.height()))


def _capsule(d: _Drawing) -> None:
    radius = d.shape.radius()
    d.add(geometry.capsule(round(d.shape.height() / radius, 9)), radius)


def _pyramid(d: _Drawing) -> None:
    d.add(geometry.pyramid(), (d.shape.base_width(), d.shape.base_depth(), d.shape.height()))


def _plane(d: _Drawing) -> None:
    normal = d.shape.normal()
    start = d.shape.offset() * normal
    d.add(geometry.quad(), _PLANE_SIZE, pose=d.pose @ between(start, start + normal, 0.0))


def _hull_of_spheres(d: _Drawing) -> None:
    d.add(geometry.hull_of_spheres(tuple(tuple(map(float, row)) for row in d.shape.spheres())))


def _mesh(d: _Drawing) -> None:
    with_materials = d.one_color is None and d.shape.uses_materials()
    for mesh, material, specular in _meshes(d.shape):
        if with_materials and material is not None:
            d.add(mesh, d.shape.scale(), rgba=material * [1.0, 1.0, 1.0, d.rgba[3]], specular=specular)
        else:
            d.add(mesh, d.shape.scale())


def _soft_mesh(d: _Drawing) -> None:
    body = d.node.bodynode
    if isinstance(body, SoftBodyNode):
        rest = _kept(("skin", d.shape.id()), lambda: geometry.split_at_edges(body.point_rest_positions(), body.faces()))
        sources, triangles = rest
        d.add(geometry.mesh(body.point_local_positions()[sources], triangles, is_lasting=False), pose=body.T)


def _line_segments(d: _Drawing) -> None:
    ends = d.shape.segments().reshape(-1, 2, 3) @ d.pose[:3, :3].T + d.pose[:3, 3]
    for start, end in ends:
        d.scene.add_line(start, end, _LINE_RADIUS * d.shape.thickness(), d.rgba)


def _heightmap(d: _Drawing) -> None:
    mesh = _kept(("heights", d.shape.id()), lambda: geometry.heightmap(d.shape.heights()), d.shape.version())
    d.add(mesh, d.shape.scale())


def _point_cloud(d: _Drawing) -> None:
    points, colors = d.shape.points(), d.shape.point_colors()
    sizes = np.full(len(points), d.shape.point_size())
    d.add_each(geometry.box(), points, sizes, colors if len(colors) else d.rgba)


def _voxel_grid(d: _Drawing) -> None:
    cells = d.shape.voxels()
    d.add_each(geometry.box(), cells[:, :3], cells[:, 3], d.rgba)


def _bounding_box(d: _Drawing) -> None:
    """A kind that is not known."""
    low, high = d.shape.bounding_box_min(), d.shape.bounding_box_max()
    if np.isfinite(low).all() and np.isfinite(high).all():
        pose = d.pose.copy()
        pose[:3, 3] += d.pose[:3, :3] @ (low + high) / 2.0
        d.add(geometry.box(), high - low, pose=pose)


_KINDS: dict[str, Callable[[_Drawing], None]] = {
    "SphereShape": _sphere,
    "BoxShape": _box,
    "EllipsoidShape": _ellipsoid,
    "CylinderShape": _cylinder,
    "CapsuleShape": _capsule,
    "ConeShape": _cone,
    "PyramidShape": _pyramid,
    "PlaneShape": _plane,
    "MultiSphereShape": _hull_of_spheres,
    "MultiSphereConvexHullShape": _hull_of_spheres,
    "MeshShape": _mesh,
    "ArrowShape": _mesh,
    "SoftMeshShape": _soft_mesh,
    "LineSegmentShape": _line_segments,
    "HeightmapShape": _heightmap,
    "PointCloudShape": _point_cloud,
    "VoxelGridShape": _voxel_grid,
}

_made: OrderedDict[tuple[Any, ...], tuple[int, Any]] = OrderedDict()
_KEPT = 4096


def _kept(key: tuple[Any, ...], make: Callable[[], Any], version: int = 0) -> Any:
    """What `make` made for this key and version before; the engine gives no two shapes the same number."""
    if key not in _made or _made[key][0] != version:
        _made[key] = version, make()
        while len(_made) > _KEPT:
            _made.popitem(last=False)
    _made.move_to_end(key)
    return _made[key][1]


def _meshes(shape: Any) -> list[tuple[Mesh, Array | None, float]]:
    """Each mesh of a mesh shape with the colour of its material, if it has one, and the strength of its highlights."""

    def read() -> list[tuple[Mesh, Array | None, float]]:
        folder = os.path.dirname(shape.path())
        found = []
        for i in range(shape.num_meshes()):
            handle = shape.mesh(i)
            material = handle.diffuse() if handle.has_material() else None
            found.append((_mesh_of(handle, folder), material, min(handle.specular(), 1.0)))
        return found

    made: list[tuple[Mesh, Array | None, float]] = _kept(("meshes", shape.id()), read, shape.version())
    return made


def _mesh_of(handle: MeshHandle, folder: str) -> Mesh:
    vertices, triangles = handle.vertices().astype(np.float32), handle.triangles().astype(np.uint32)
    normals = handle.normals().astype(np.float32)
    if not len(normals):
        normals = geometry.smooth_normals(vertices, triangles)
    coordinates, colors = handle.texture_coordinates().astype(np.float32), handle.colors().astype(np.float32)
    texture = handle.texture() if len(coordinates) else ""
    path = os.path.join(folder, texture.replace("\\", "/")) if texture else None
    # The same file loaded twice is the same mesh, which is then kept and drawn once.
    content = hashlib.blake2b(digest_size=16)
    for array in (vertices, triangles, normals, coordinates, colors):
        content.update(array.tobytes())
    mesh: Mesh = _kept(
        ("mesh", content.digest(), path),
        lambda: Mesh(
            vertices,
            normals,
            triangles,
            coordinates if path else None,
            colors if len(colors) else None,
            path,
        ),
    )
    return mesh
