"""Poses, velocities and Jacobians of one frame in another."""

from __future__ import annotations

from typing import TYPE_CHECKING, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pydart2.given import numbers
from pydart2.poses import pose, rotation

if TYPE_CHECKING:
    from pydart2.bodynode import BodyNode

Array = NDArray[np.float64]


class Frame:
    """Something with a pose in the world: a BodyNode or a SimpleFrame. Where a frame may be None, it is the world."""

    @property
    def T(self) -> Array:  # noqa: N802 (the field's name)
        """Pose in the world, shape (4, 4), m."""
        raise NotImplementedError

    def relative_pose(self, to: Frame | None) -> Array:
        """Pose in another frame, shape (4, 4), m."""
        return self.T if to is None else np.linalg.inv(_frame(to).T) @ self.T

    def relative_velocity(self, to: Frame | None, axes: Frame | None = None) -> Array:
        """Angular (rad/s) and linear (m/s) velocity of the origin as seen from another frame, shape (6,).

        Parameters
        ----------
        to
            From where it is seen: a body that moves along sees none.
        axes
            The frame whose axes the numbers are in, in rad/s and m/s; default: the world's.
        """
        return _turned(_spatial(self, None) - _carried(self, to, None), axes)

    def relative_jacobian(self, to: Frame | None, axes: Frame | None = None) -> Array:
        """Angular and linear rows that make relative_velocity() of dq, shape (6, ndofs): rows of 1 and m/rad.

        ValueError if the frames are of two skeletons.
        """
        body, other = _body(self), _body(to)
        if body is not None and other is not None and body.skeleton is not other.skeleton:
            raise ValueError(f"{self!r} and {to!r} are of two skeletons, so no one dq moves both")
        known = body or other
        if known is None:
            raise ValueError(f"neither {self!r} nor {to!r} is of a skeleton, so there is no dq")
        n = known.skeleton.ndofs
        return _turned(_spatial(self, n) - _carried(self, to, n), axes)


class SimpleFrame(Frame):
    """A frame fixed in a body, or in the world.

    >>> tool = SimpleFrame(hand, translation=[0.0, 0.0, 0.1])

    Parameters
    ----------
    parent
        The body; None for the world.
    rotation, translation
        Pose in the parent: a (3, 3) matrix or a quaternion [w, x, y, z], and shape (3,), m.

    Attributes
    ----------
    parent : BodyNode or None
    """

    def __init__(
        self,
        parent: BodyNode | None = None,
        rotation: ArrayLike | None = None,
        translation: ArrayLike = (0.0, 0.0, 0.0),
    ) -> None:
        if parent is not None and _body(parent) is not parent:
            raise TypeError(f"a SimpleFrame is fixed in a body, or in the world, not in {parent!r}")
        self.parent = parent
        self.relative = pose(translation, rotation)

    @property
    def relative(self) -> Array:
        """Pose in the parent, shape (4, 4), m; may be changed, as a whole or in its elements."""
        return self._relative

    @relative.setter
    def relative(self, relative: ArrayLike) -> None:
        T = np.array(numbers(relative, "a pose"))
        if T.shape != (4, 4) or not np.isfinite(T).all() or (T[3] != (0.0, 0.0, 0.0, 1.0)).any():
            raise ValueError(
                f"a pose is a finite matrix of the shape (4, 4) whose last row is 0 0 0 1, got {relative!r}"
            )
        rotation(T[:3, :3])
        self._relative = T

    @property
    def T(self) -> Array:  # noqa: N802 (the field's name)
        """Pose in the world, shape (4, 4), m."""
        return self.relative.copy() if self.parent is None else self.parent.T @ self.relative

    def __repr__(self) -> str:
        return f"[SimpleFrame: in {'the world' if self.parent is None else self.parent!r}]"


def _frame(given: Frame) -> Frame:
    if not isinstance(given, Frame):
        raise TypeError(f"a frame is a body, a SimpleFrame, or None for the world, got {given!r}")
    return given


def _body(frame: Frame | None) -> BodyNode | None:
    """The body that carries a frame."""
    if isinstance(frame, SimpleFrame):
        return frame.parent
    # Told by what it has and not by its class, as bodies are made of frames.
    return cast("BodyNode", frame) if frame is not None and hasattr(_frame(frame), "skeleton") else None


def _spatial(frame: Frame, n: int | None) -> Array:
    """Velocity of a frame's origin, world axes: (6,), or (6, n) for its Jacobian."""
    body = _body(frame)
    if body is None:
        return np.zeros(6 if n is None else (6, n))
    offset = frame.relative[:3, 3] if isinstance(frame, SimpleFrame) else None
    return body.world_spatial_velocity(offset) if n is None else body.world_jacobian(offset)


def _carried(frame: Frame, by: Frame | None, n: int | None) -> Array:
    """How the origin would move if it were fixed in the frame `by`."""
    body = _body(by)
    if body is None:
        return np.zeros(6 if n is None else (6, n))
    point = body.to_local(frame.T[:3, 3])
    return body.world_spatial_velocity(point) if n is None else body.world_jacobian(point)


def _turned(rows: Array, axes: Frame | None) -> Array:
    """Angular and linear rows from the world's axes to those of a frame."""
    if axes is None:
        return rows
    back = _frame(axes).T[:3, :3].T
    return np.concatenate([back @ rows[:3], back @ rows[3:]])
