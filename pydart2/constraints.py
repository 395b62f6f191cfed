"""Constraints between bodies that a user adds to a world."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pydart2.given import number, numbers

if TYPE_CHECKING:
    from pydart2.bodynode import BodyNode
    from pydart2.world import World


class Constraint:
    """What holds two bodies together, or one in the world, from add_to_world() to remove().

    Bodies are held as they stand when it is added: none jumps.
    """

    _KIND: ClassVar[int]

    def __init__(self, body1: BodyNode, body2: BodyNode | None = None) -> None:
        self._bodies = body1, body2
        self._numbers = np.zeros(11)  # point, axis, second point, length, whether it is a rope
        self._added: tuple[World, int] | None = None

    @property
    def body1(self) -> BodyNode:
        """The first body."""
        return self._bodies[0]

    @property
    def body2(self) -> BodyNode | None:
        """The second body, None for the world."""
        return self._bodies[1]

    def add_to_world(self, world: World) -> None:
        """Let it act, on the bodies as they stand now. ValueError if a body is not in the world, or it was added."""
        if self.is_active():
            raise ValueError(f"{self!r} is in a world already")
        first, second = self._bodies
        if second is None:
            number = world._handle.add_constraint_to_world(self._KIND, first._handle, self._numbers)
        else:
            number = world._handle.add_constraint_between(self._KIND, first._handle, second._handle, self._numbers)
        self._added = world, number

    def remove(self) -> None:
        """Take it away; ValueError if it is in no world."""
        if self._added is None or not self._added[0]._handle.remove_constraint(self._added[1]):
            raise ValueError(f"{self!r} is in no world")
        self._added = None

    def is_active(self) -> bool:
        """Whether it is in a world: it was added, and neither it nor one of its skeletons was removed."""
        return self._added is not None and any(self == other for other in self._added[0].constraints)

    @property
    def enabled(self) -> bool:
        """Whether it holds; a constraint that is switched off stays in its world. ValueError if it is in none."""
        world, number = self._place()
        return world._handle.constraint_is_enabled(number)

    @enabled.setter
    def enabled(self, on: bool) -> None:
        world, number = self._place()
        world._handle.set_constraint_enabled(number, on)

    def force(self) -> NDArray[np.float64]:
        """What it did to body1 in the last step, world axes, shape (3,), N; on body2 it is the opposite."""
        return self._wrench()[3:]

    def moment(self) -> NDArray[np.float64]:
        """Of what it did to body1 in the last step, about body1's origin, world axes, shape (3,), N m."""
        return self._wrench()[:3]

    def _wrench(self) -> NDArray[np.float64]:
        world, number = self._place()
        return world._handle.constraint_wrench(number)

    def _place(self) -> tuple[World, int]:
        if self._added is None:
            raise ValueError(f"{self!r} is in no world: add_to_world() adds it")
        return self._added

    def _move(self, target: NDArray[np.float64]) -> None:
        """Move where it holds body1 in the world."""
        world, number = self._place()
        world._handle.set_constraint_target(number, target)

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
        self._numbers[:3] = _vector(jointPos, "jointPos")

    @property
    def jointPos(self) -> NDArray[np.float64]:  # noqa: N802 (the original's name)
        """Where the point was at the time of add_to_world(), world frame, shape (3,), m. Set before that."""
        return self._numbers[:3].copy()

    @jointPos.setter
    def jointPos(self, point: ArrayLike) -> None:  # noqa: N802
        if self.is_active():
            raise ValueError("the bodies are held already: set_target() moves a point that is held in the world")
        self._numbers[:3] = _vector(point, "jointPos")

    def set_target(self, point: ArrayLike) -> None:
        """Hold body1's point at another one of the world, shape (3,), m: the body is pulled there.

        ValueError if there is a second body.
        """
        self._move(_at(_vector(point, "a target")))


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

    def set_target(self, pose: ArrayLike) -> None:
        """Hold body1 in another pose in the world, shape (4, 4), m.

        It is pulled there. ValueError if there is a second body.
        """
        self._move(numbers(pose, "a pose"))


class RevoluteJointConstraint(Constraint):
    """Lets two bodies, or one in the world, turn about an axis alone: the closure of a four-bar.

    Two ball joint constraints on the axis, 0.2 m apart.

    Parameters
    ----------
    body1, body2
        Two bodies of one world; None as the second for the world itself.
    point, axis
        A point of the axis and its direction, world frame, shape (3,), m and no unit, at the time of add_to_world().
    """

    _KIND = 2

    def __init__(self, body1: BodyNode, body2: BodyNode | None, point: ArrayLike, axis: ArrayLike) -> None:
        super().__init__(body1, body2)
        self._numbers[:6] = *_vector(point, "point"), *_vector(axis, "axis")

    @property
    def point(self) -> NDArray[np.float64]:
        """A point of the axis at the time of add_to_world(), world frame, shape (3,), m."""
        return self._numbers[:3].copy()

    @property
    def axis(self) -> NDArray[np.float64]:
        """The axis at the time of add_to_world(), world frame, shape (3,), no unit."""
        return self._numbers[3:6].copy()


class DistanceConstraint(Constraint):
    """Keeps two points a length apart: a rod without mass; or, as a rope, no farther than that.

    >>> rope = DistanceConstraint(load, crane, load.C, crane.to_world([0, 0, 2]), rope=True)
    >>> rope.add_to_world(world)

    Parameters
    ----------
    body1, body2
        Two bodies of one world; None as the second for the world itself.
    point1, point2
        A point of each, world frame, shape (3,), m, at the time of add_to_world().
    length
        m, > 0; None for what the points are apart.
    rope
        Whether they may be nearer.
    """

    _KIND = 3

    def __init__(
        self,
        body1: BodyNode,
        body2: BodyNode | None,
        point1: ArrayLike,
        point2: ArrayLike,
        length: float | None = None,
        *,
        rope: bool = False,
    ) -> None:
        super().__init__(body1, body2)
        one, other = _vector(point1, "point1"), _vector(point2, "point2")
        apart = float(np.linalg.norm(one - other)) if length is None else number(length, "length")
        if not 0.0 < apart < np.inf:
            raise ValueError(f"the length of a distance constraint is > 0 m, got {apart}")
        self._numbers[:3], self._numbers[6:9], self._numbers[9:] = one, other, (apart, float(rope))

    @property
    def points(self) -> NDArray[np.float64]:
        """Where the two points were at the time of add_to_world(), world frame, shape (2, 3), m."""
        return self._numbers[[0, 1, 2, 6, 7, 8]].reshape(2, 3)

    @property
    def length(self) -> float:
        """m."""
        return float(self._numbers[9])

    @property
    def rope(self) -> bool:
        """Whether the points may be nearer."""
        return bool(self._numbers[10])

    def set_target(self, point: ArrayLike) -> None:
        """Move the second point, which is one of the world, shape (3,), m. ValueError if there is a second body."""
        self._move(_at(_vector(point, "a target")))


_KINDS: tuple[type[Constraint], ...] = (
    BallJointConstraint,
    WeldJointConstraint,
    RevoluteJointConstraint,
    DistanceConstraint,
)


def of_world(world: World) -> list[Constraint]:
    """Those of a world, in the order in which they were added."""
    return [_read(world, world._handle.constraint(i)) for i in range(world._handle.num_constraints())]


def _read(world: World, row: NDArray[np.float64]) -> Constraint:
    number, kind, skeleton1, body1, skeleton2, body2 = (int(x) for x in row[:6])
    made = _KINDS[kind].__new__(_KINDS[kind])
    first = world.skeletons[skeleton1].bodynodes[body1]
    Constraint.__init__(made, first, None if body2 < 0 else world.skeletons[skeleton2].bodynodes[body2])
    made._numbers = row[6:].copy()
    made._added = world, number
    return made


def _at(point: NDArray[np.float64]) -> NDArray[np.float64]:
    pose = np.eye(4)
    pose[:3, 3] = point
    return pose


def _vector(values: ArrayLike, what: str) -> NDArray[np.float64]:
    vector = np.array(numbers(values, what))
    if vector.shape != (3,):
        raise ValueError(f"{what} has the shape (3,), got {vector.shape}")
    return vector
