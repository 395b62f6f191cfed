"""Markers: named points of a body."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pydart2 import screen
from pydart2.alias import Alias, forwards
from pydart2.multibody.part import Part

if TYPE_CHECKING:
    from pydart2._native import MarkerHandle
    from pydart2.bodynode import BodyNode
    from pydart2.skeleton import Skeleton


class Marker(Part):
    """A point that is fixed to a body, as of a motion capture suit.

    Attributes
    ----------
    skeleton : Skeleton
    id : int
        Index in the skeleton.
    name : str
        ``M0003`` and so on; the name in the file is `label`.
    label : str
    bodynode : BodyNode
    """

    _LIST = "markers"

    bodynode: BodyNode
    _handle: MarkerHandle

    def __init__(self, _skeleton: Skeleton, _id: int) -> None:
        self.skeleton = _skeleton
        self._id = _id
        self.name = f"M{_id:04d}"
        self._handle = _skeleton._handle.marker(_id)
        self.label = self._handle.name()

    def build(self) -> None:
        """Link to the body."""
        self.bodynode = self.skeleton.bodynodes[self._handle.bodynode()]
        self.bodynode.markers.append(self)

    def local_position(self) -> NDArray[np.float64]:
        """Position in the body frame, shape (3,), m."""
        return self._handle.local_position()

    def set_local_position(self, inv3: ArrayLike) -> None:
        """Set the position in the body frame, shape (3,), m."""
        self._handle.set_local_position(inv3)

    @forwards()
    def world_position(self) -> NDArray[np.float64]:
        """Position in the world, shape (3,), m."""
        return self._handle.world_position()

    p = Alias(world_position)

    def render(self) -> None:
        """Draw it with the current OpenGL context and matrices."""
        screen.draw("marker", self)

    def __repr__(self) -> str:
        return f"[Marker({self.id})]"
