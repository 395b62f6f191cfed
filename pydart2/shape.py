"""The geometry of shape nodes. Lengths in metres, axes of the shape's own frame."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pydart2 import screen
from pydart2.multibody.part import BodyPart

if TYPE_CHECKING:
    from pydart2._native import ShapeHandle
    from pydart2.bodynode import BodyNode
    from pydart2.shapenode import ShapeNode
    from pydart2.skeleton import Skeleton


class Shape(BodyPart):
    """A shape of any kind.

    Attributes
    ----------
    shapenode : ShapeNode
    bodynode : BodyNode
    skeleton : Skeleton
    id : int
        Index of its node in the body.
    """

    TYPE_ID: ClassVar[int] = -1

    def __init__(self, _shapenode: ShapeNode) -> None:
        self.shapenode = _shapenode
        self.bodynode: BodyNode = _shapenode.bodynode
        self.skeleton: Skeleton = _shapenode.skeleton
        self._handle: ShapeHandle = _shapenode._handle.shape()

    @property
    def id(self) -> int:
        """Index of its node in the body."""
        return self.shapenode.id

    def volume(self) -> float:
        """Volume, m³."""
        return self._handle.volume()

    def type(self) -> str:
        """The engine's name of the kind, as ``"BoxShape"``."""
        return self._handle.type()

    def shape_type_name(self) -> str:
        """The engine's name of the kind, as ``"BoxShape"``."""
        return self._handle.type()

    def type_id(self) -> int:
        """The number of the kind, -1 if it is not known."""
        return self.TYPE_ID

    def shape_type(self) -> int:
        """The number of the kind, -1 if it is not known."""
        return self.TYPE_ID

    def bounding_box(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Lowest and highest corner, two of shape (3,), m, in the shape's frame."""
        return self._handle.bounding_box_min(), self._handle.bounding_box_max()

    def render(self) -> None:
        """Draw it in grey in the axes of the current OpenGL matrices."""
        screen.draw("shape", self)

    def __reduce__(self) -> tuple[object, ...]:
        return getattr, (self.shapenode, "shape")

    def __repr__(self) -> str:
        return f"[{type(self).__name__}({self.bodynode.id}:{self.id})]"


class _Round(Shape):
    def radius(self) -> float:
        """Radius, m."""
        return self._handle.radius()

    def set_radius(self, radius: float) -> None:
        """Set the radius, m, > 0."""
        self._handle.set_radius(radius)


class _RoundAlongZ(_Round):
    def height(self) -> float:
        """Length along z, m."""
        return self._handle.height()

    def set_height(self, height: float) -> None:
        """Set the length along z, m, > 0."""
        self._handle.set_height(height)


class SphereShape(_Round):
    """A sphere."""

    TYPE_ID = 0


class BoxShape(Shape):
    """A box."""

    TYPE_ID = 1

    def size(self) -> NDArray[np.float64]:
        """Lengths of the edges, shape (3,), m."""
        return self._handle.size()

    def set_size(self, size: ArrayLike) -> None:
        """Set the lengths of the edges, shape (3,), m, > 0."""
        self._handle.set_size(size)


class EllipsoidShape(Shape):
    """An ellipsoid."""

    TYPE_ID = 2

    def size(self) -> NDArray[np.float64]:
        """Diameters, shape (3,), m."""
        return self._handle.size()

    def set_size(self, size: ArrayLike) -> None:
        """Set the diameters, shape (3,), m, > 0."""
        self._handle.set_size(size)


class CylinderShape(_RoundAlongZ):
    """A cylinder along z."""

    TYPE_ID = 3


class CapsuleShape(_RoundAlongZ):
    """A cylinder along z with half spheres at its ends; the height excludes them."""

    TYPE_ID = 4


class ConeShape(_RoundAlongZ):
    """A cone along z."""

    TYPE_ID = 5


class PlaneShape(Shape):
    """The plane ``normal . x = offset``."""

    TYPE_ID = 6

    def normal(self) -> NDArray[np.float64]:
        """Unit normal, shape (3,)."""
        return self._handle.normal()

    def set_normal(self, inv3: ArrayLike) -> None:
        """Set the normal, shape (3,); it is made a unit vector."""
        self._handle.set_normal(inv3)

    def offset(self) -> float:
        """Distance from the origin along the normal, m."""
        return self._handle.offset()

    def set_offset(self, offset: float) -> None:
        """Set the distance from the origin along the normal, m."""
        self._handle.set_offset(offset)


class MultiSphereShape(Shape):
    """The convex hull of spheres."""

    TYPE_ID = 7

    def add_sphere(self, r: float, pos: ArrayLike) -> None:
        """Add a sphere: radius, m, > 0; centre, shape (3,), m."""
        self._handle.add_sphere(r, pos)

    def spheres(self) -> list[dict[str, Any]]:
        """One ``{"r": radius in m, "pos": centre of shape (3,) in m}`` per sphere."""
        return [{"r": float(row[0]), "pos": row[1:].copy()} for row in self._handle.spheres()]

    def num_spheres(self) -> int:
        """How many spheres there are."""
        return self._handle.num_spheres()


class MeshShape(Shape):
    """A triangle mesh from a file."""

    TYPE_ID = 8

    def scale(self) -> NDArray[np.float64]:
        """Scale along each axis, shape (3,), dimensionless, > 0; a model's negative ones have mirrored the corners."""
        return self._handle.scale()

    def path(self) -> str:
        """The file that it came from."""
        return self._handle.path()


class SoftMeshShape(Shape):
    """The skin of a soft body."""

    TYPE_ID = 9


class LineSegmentShape(Shape):
    """Line segments; drawn only."""

    TYPE_ID = 10


class HeightmapShape(Shape):
    """A grid of heights."""

    TYPE_ID = 11

    def scale(self) -> NDArray[np.float64]:
        """Size of a grid cell along x and y in m, and factor of the heights, shape (3,)."""
        return self._handle.scale()


class PyramidShape(Shape):
    """A pyramid along z with a rectangular base."""

    TYPE_ID = 12

    def base_width(self) -> float:
        """Edge of the base along x, m."""
        return self._handle.base_width()

    def set_base_width(self, width: float) -> None:
        """Set the edge of the base along x, m, > 0."""
        self._handle.set_base_width(width)

    def base_depth(self) -> float:
        """Edge of the base along y, m."""
        return self._handle.base_depth()

    def set_base_depth(self, depth: float) -> None:
        """Set the edge of the base along y, m, > 0."""
        self._handle.set_base_depth(depth)

    def height(self) -> float:
        """Length along z, m."""
        return self._handle.height()

    def set_height(self, height: float) -> None:
        """Set the length along z, m, > 0."""
        self._handle.set_height(height)


class PointCloudShape(Shape):
    """A set of points."""

    TYPE_ID = 13


class VoxelGridShape(Shape):
    """An occupancy grid."""

    TYPE_ID = 14


class ArrowShape(MeshShape):
    """An arrow; drawn only."""

    TYPE_ID = 15


_classes: dict[str, type[Shape]] = {
    "SphereShape": SphereShape,
    "BoxShape": BoxShape,
    "EllipsoidShape": EllipsoidShape,
    "CylinderShape": CylinderShape,
    "CapsuleShape": CapsuleShape,
    "ConeShape": ConeShape,
    "PlaneShape": PlaneShape,
    "MultiSphereShape": MultiSphereShape,
    "MultiSphereConvexHullShape": MultiSphereShape,
    "MeshShape": MeshShape,
    "SoftMeshShape": SoftMeshShape,
    "LineSegmentShape": LineSegmentShape,
    "HeightmapShape": HeightmapShape,
    "PyramidShape": PyramidShape,
    "PointCloudShape": PointCloudShape,
    "VoxelGridShape": VoxelGridShape,
    "ArrowShape": ArrowShape,
}


def create_shape(shapenode: ShapeNode) -> Shape | None:
    """The shape of a node as an object of its kind's class; a plain Shape for unknown kinds, None for no shape."""
    if not shapenode._handle.has_shape():
        return None
    kind = shapenode._handle.shape().type().split(" ")[0]  # "HeightmapShape (f)" tells its number type
    return _classes.get(kind, Shape)(shapenode)
