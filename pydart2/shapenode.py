"""Shape nodes: where a shape sits on its body, and what it is for."""

from __future__ import annotations

import logging
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pydart2.multibody.part import BodyPart
from pydart2.shape import Shape, create_shape

if TYPE_CHECKING:
    from pydart2._native import ShapeNodeHandle
    from pydart2.bodynode import BodyNode

_log = logging.getLogger("pydart2")


@dataclass(frozen=True)
class Surface:
    """How a shape meets others. A pair of shapes has the smaller friction, the sum of the slips, and the product of the
    restitutions.

    Attributes
    ----------
    friction, secondary_friction : float
        Coulomb's coefficient along `friction_direction`, and across it.
    slip, secondary_slip : float
        Slip compliance in the same directions, m/(N s): a force F of friction lets the surfaces creep at slip * F.
    restitution : float
        Coefficient of restitution, 0 to 1.
    friction_direction : (3,) or None
        In the shape's frame; None for any direction in the plane of the contact.
    """

    friction: float = 1.0
    secondary_friction: float = 1.0
    slip: float = 0.0
    secondary_slip: float = 0.0
    restitution: float = 0.0
    friction_direction: tuple[float, float, float] | None = None


class ShapeNode(BodyPart):
    """A shape on a body; it is drawn, collides, or both. SKEL files make one node for each purpose.

    Attributes
    ----------
    bodynode : BodyNode
    skeleton : Skeleton
    id : int
        Index in the body.
    name : str
    """

    _LIST = "shapenodes"

    def __init__(self, _bodynode: BodyNode, _id: int) -> None:
        self.bodynode = _bodynode
        self.skeleton = _bodynode.skeleton
        self._id = _id
        self._handle: ShapeNodeHandle = _bodynode._handle.shapenode(_id)
        self.name = self._handle.name()

    @cached_property
    def shape(self) -> Shape | None:
        """Its shape, or None; made when it is first asked for."""
        return create_shape(self)

    def _take(self, other: Self) -> None:
        """Be the node that a new object is for; the shape that was asked for stays, of the new one's."""
        super()._take(other)
        shape = vars(self).pop("shape", None)
        if shape is not None and self._handle.has_shape():
            shape._handle = self._handle.shape()
            vars(self)["shape"] = shape

    def has_visual_aspect(self) -> bool:
        """Whether it is drawn."""
        return self._handle.has_visual_aspect()

    def has_collision_aspect(self) -> bool:
        """Whether it collides."""
        return self._handle.has_collision_aspect()

    def visual_aspect_rgba(self) -> NDArray[np.float64] | None:
        """Colour, shape (4,), 0 to 1; None if it is not drawn."""
        return self._handle.rgba() if self._handle.has_visual_aspect() else None

    def set_visual_aspect_rgba(self, rgba: ArrayLike) -> None:
        """Set the colour, shape (4,), 0 to 1. A node that is not drawn has none: a warning is logged."""
        if self._handle.has_visual_aspect():
            self._handle.set_rgba(rgba)
        else:
            _log.warning("%s is not drawn, so it has no colour to set", self)

    def surface(self) -> Surface:
        """Friction, slip and restitution; ValueError if it does not collide."""
        friction, secondary, slip, secondary_slip = self._handle.tangential_coeffs().tolist()
        x, y, z = self._handle.friction_direction().tolist()
        direction = (x, y, z) if x or y or z else None
        return Surface(friction, secondary, slip, secondary_slip, self._handle.restitution_coeff(), direction)

    def set_surface(
        self,
        *,
        friction: float | None = None,
        secondary_friction: float | None = None,
        slip: float | None = None,
        secondary_slip: float | None = None,
        restitution: float | None = None,
        friction_direction: ArrayLike | None = None,
    ) -> None:
        """Change what is given of `surface()`; ValueError if it does not collide, or for a negative number.

        `friction` and `slip` alone are the same in every direction. `friction_direction`, shape (3,), is in the shape's
        frame; zeros take it away.
        """
        now = self._handle.tangential_coeffs()
        for i, (along, across) in enumerate(((friction, secondary_friction), (slip, secondary_slip))):
            if along is not None:
                now[2 * i : 2 * i + 2] = along
            if across is not None:
                now[2 * i + 1] = across
        self._handle.set_tangential_coeffs(now)
        if restitution is not None:
            self._handle.set_restitution_coeff(restitution)
        if friction_direction is not None:
            self._handle.set_friction_direction(friction_direction)

    def offset(self) -> NDArray[np.float64]:
        """Position of the shape in the body frame, shape (3,), m."""
        return self._handle.offset()

    def set_offset(self, offset: ArrayLike) -> None:
        """Set the position of the shape in the body frame, shape (3,), m."""
        self._handle.set_offset(offset)

    def relative_transform(self) -> NDArray[np.float64]:
        """Pose of the shape in the body frame, shape (4, 4), m."""
        return self._handle.relative_transform()

    def set_relative_transform(self, transform: ArrayLike) -> None:
        """Set the pose of the shape in the body frame, shape (4, 4), m."""
        self._handle.set_relative_transform(transform)

    def world_transform(self) -> NDArray[np.float64]:
        """Pose of the shape in the world, shape (4, 4), m."""
        return self._handle.world_transform()

    def __repr__(self) -> str:
        return f"[ShapeNode({self.bodynode.id}:{self.id})]"
