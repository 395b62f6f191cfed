"""The line along which a muscle pulls."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pydart2.errors import PydartError

if TYPE_CHECKING:
    from pydart2.bodynode import BodyNode
    from pydart2.skeleton import Skeleton


class AttachmentPoint:
    """A point of a body, given by the body's name.

    Parameters
    ----------
    bodyname
        Name of the body.
    offset
        The point in the body frame, shape (3,), m.

    Attributes
    ----------
    skeleton : Skeleton or None
    body : BodyNode or None
        None until initialize().
    """

    def __init__(self, bodyname: str, offset: ArrayLike) -> None:
        self.bodyname = bodyname
        self.offset: NDArray[np.float64] = np.array(offset, dtype=float)
        if self.offset.shape != (3,):
            raise ValueError(f"offset: shape (3,) expected, got {self.offset.shape}")
        self.skeleton: Skeleton | None = None
        self.body: BodyNode | None = None

    def is_initialized(self) -> bool:
        """Whether it has its body."""
        return self.body is not None

    def initialize(self, skeleton: Skeleton) -> None:
        """Find the body in a skeleton; NameNotFound if there is none of the name."""
        self.body = skeleton.body(self.bodyname)
        self.skeleton = skeleton

    def to_world(self) -> NDArray[np.float64]:
        """Where it is in the world, shape (3,), m."""
        return self._initialized_body().to_world(self.offset)

    def _initialized_body(self) -> BodyNode:
        if self.body is None:
            raise PydartError(f"{self} has no skeleton yet: add its muscle to one")
        return self.body

    def __str__(self) -> str:
        x, y, z = self.offset
        return f"({self.bodyname}, [{x:g}, {y:g}, {z:g}])"


class Route:
    """Straight segments between attachment points.

    Parameters
    ----------
    points
        (bodyname, offset) of each point, see AttachmentPoint.

    Attributes
    ----------
    points : list of AttachmentPoint
    world_points : ndarray
        Where the points are in the world, shape (n, 3), m.
    world_directions : ndarray
        Unit vector of each segment in the world, shape (n - 1, 3); zero for a segment of length zero.
    length : float or None
        Sum of the segments' lengths, m.

    The last three are as of the last update_geometry_variables(); empty and None before.
    """

    def __init__(self, points: Iterable[tuple[str, ArrayLike]] | None = None) -> None:
        self.points: list[AttachmentPoint] = []
        self.world_points: NDArray[np.float64] = np.empty((0, 3))
        self.world_directions: NDArray[np.float64] = np.empty((0, 3))
        self.length: float | None = None
        for bodyname, offset in points or ():
            self.add_point(bodyname, offset)

    def num_points(self) -> int:
        """How many points there are."""
        return len(self.points)

    def __len__(self) -> int:
        return len(self.points)

    def add_point(self, bodyname: str, offset: ArrayLike) -> None:
        """Append a point, in the frame of a body, shape (3,), m, before the route is initialized."""
        self.points.append(AttachmentPoint(bodyname, offset))

    def initialize_points(self, skeleton: Skeleton) -> None:
        """Find the bodies in a skeleton and update the geometry.

        Raises
        ------
        NameNotFound
            If the skeleton has no body of a name.
        ValueError
            If there are less than two points.
        """
        if len(self.points) < 2:
            raise ValueError(f"a route needs two points at least, {self} has {len(self.points)}")
        for point in self.points:
            point.initialize(skeleton)
        self.update_geometry_variables()

    def update_geometry_variables(self) -> None:
        """Compute points, directions and length anew from the pose of the skeleton."""
        self.world_points = np.array([point.to_world() for point in self.points])
        segments = np.diff(self.world_points, axis=0)
        lengths = np.linalg.norm(segments, axis=1)
        self.world_directions = segments / np.where(lengths > 0.0, lengths, 1.0)[:, None]
        self.length = float(lengths.sum())

    @property
    def local_points(self) -> list[NDArray[np.float64]]:
        """The points in the frames of their bodies, each of shape (3,), m."""
        return [point.offset for point in self.points]

    @property
    def bodynodes(self) -> list[BodyNode]:
        """The body of each point; PydartError before the route is initialized."""
        return [point._initialized_body() for point in self.points]

    def local_points_as_pair(self) -> Iterator[tuple[NDArray[np.float64], NDArray[np.float64]]]:
        """The local points at both ends of each segment, in the frames of their bodies, each of shape (3,), m."""
        return pairwise(self.local_points)

    def bodynodes_as_pair(self) -> Iterator[tuple[BodyNode, BodyNode]]:
        """The bodies at both ends of each segment."""
        return pairwise(self.bodynodes)

    def render_with_ri(self, ri: Any) -> None:
        """Draw it with a renderer, 3 pixels wide, in the current colour."""
        ri.set_line_width(3)
        ri.render_lines(self.world_points)

    def __repr__(self) -> str:
        length = "None" if self.length is None else f"{self.length:.6g} m"
        return f"[Route: {' - '.join(str(point) for point in self.points)}, length = {length}]"
