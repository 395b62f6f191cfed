"""Constraints between bodies that a user adds to a world."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

if TYPE_CHECKING:
    from pydart2.bodynode import BodyNode
    from pydart2.world import World


class Constraint:
    """What holds two bodies together, or one in the world; it acts from add_to_world() to remove().

    Attributes
    ----------
    body1 : BodyNode
    body2 : BodyNode or None
        None for the world.
    """

    _KIND: ClassVar[int]

    def __init__(self, body1: BodyNode, body2: BodyNode | None = None) -> None:
        self.body1 = body1
        self.body2 = body2
        self._added: tuple[World, int] | None = None

    def add_to_world(self, world: World) -> None:
        """Let it act, on the bodies as they stand now. ValueError if a body is not in the world, or it acts already."""
        point = self._point()
        if self.is_active():
            raise ValueError(f"{self!r} is in a world already")
        if self.body2 is None:
            number = world._handle.add_constraint_to_world(self._KIND, self.body1._handle, point)
        else:
            number = world._handle.add_constraint_between(self._KIND, self.body1._handle, self.body2._handle, point)
        self._added = world, number

    def remove(self) -> None:
        """Let go; ValueError if it does not act."""
        if self._added is None or not self._added[0]._handle.remove_constraint(self._added[1]):
            raise ValueError(f"{self!r} is in no world")
        self._added = None

    def is_active(self) -> bool:
        """Whether it acts: it was added, and neither it nor one of its skeletons was removed."""
        return self._added is not None and any(self == other for other in self._added[0].constraints)

    def _point(self) -> ArrayLike:
        return np.zeros(3)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Constraint) or self._added is None or other._added is None:
            return self is other
        return self._added[0] is other._added[0] and self._added[1] == other._added[1]

    __hash__ = object.__hash__

    def __repr__(self) -> str:
        return f"[{type(self).__name__}: {self.body1!r} and {self.body2 if self.body2 is not None else 'the world'!r}]"


class BallJointConstraint(Constraint):
    """Keeps a point of two bodies together, or a point of a body where it is.

    >>> constraint = BallJointConstraint(hand, handle, hand.to_world([0, 0, 0.1]))
    >>> constraint.add_to_world(world)

    Parameters
    ----------
    body1, body2
        Two bodies of one world; None as the second for the world itself.
    jointPos
        The point, world frame, shape (3,), m, at the time of add_to_world().
    """

    _KIND = 0

    def __init__(self, body1: BodyNode, body2: BodyNode | None, jointPos: ArrayLike) -> None:
        super().__init__(body1, body2)
        self.jointPos: NDArray[np.float64] = np.array(jointPos, dtype=float)

    def _point(self) -> ArrayLike:
        return self.jointPos


class WeldJointConstraint(Constraint):
    """Holds a body where it is, seen from another or in the world: a grasp.

    >>> grasp = WeldJointConstraint(hand, cup)
    >>> grasp.add_to_world(world)
    >>> grasp.remove()

    Parameters
    ----------
    body1, body2
        Two bodies of one world, which stay as they are to each other; None as the second for the world itself.
    """

    _KIND = 1


_KINDS: tuple[type[Constraint], ...] = (BallJointConstraint, WeldJointConstraint)


def of_world(world: World) -> list[Constraint]:
    """Those that act in a world, in the order in which they were added."""
    return [_read(world, world._handle.constraint(i)) for i in range(world._handle.num_constraints())]


def _read(world: World, row: NDArray[np.float64]) -> Constraint:
    number, kind, skeleton1, body1, skeleton2, body2 = (int(x) for x in row[:6])
    made = _KINDS[kind].__new__(_KINDS[kind])
    first = world.skeletons[skeleton1].bodynodes[body1]
    Constraint.__init__(made, first, None if body2 < 0 else world.skeletons[skeleton2].bodynodes[body2])
    if isinstance(made, BallJointConstraint):
        made.jointPos = row[6:9].copy()
    made._added = world, number
    return made
