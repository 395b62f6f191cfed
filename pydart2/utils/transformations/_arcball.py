"""Rotation by dragging a ball (K. Shoemake, Arcball rotation control, Graphics Gems IV, 1994)."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from pydart2.utils.transformations._quaternions import (
    quaternion_from_matrix,
    quaternion_matrix,
    quaternion_multiply,
    quaternion_slerp,
)
from pydart2.utils.transformations._vectors import Array, unit3, unit_vector, vector3


class Arcball:
    """A virtual ball in a window, rotated by dragging.

    >>> ball = Arcball()
    >>> ball.place([320, 320], 320)
    >>> ball.down([500, 250])
    >>> ball.drag([475, 275])
    >>> rotation = ball.matrix()

    Parameters
    ----------
    initial
        Rotation at the begin: a matrix of shape (4, 4), or a quaternion [w, x, y, z] of shape (4,); None for none.

    Raises
    ------
    ValueError
        If it has another shape.
    """

    def __init__(self, initial: ArrayLike | None = None) -> None:
        start = np.array([1.0, 0.0, 0.0, 0.0] if initial is None else initial, dtype=float)
        if start.shape not in ((4,), (4, 4)):
            raise ValueError(f"initial: a matrix (4, 4) or a quaternion (4,) expected, got {start.shape}")
        self._now: Array = unit_vector(start) if start.ndim == 1 else quaternion_from_matrix(start)
        self._before = self._at_down = self._now
        self._center: ArrayLike = (0.0, 0.0)
        self._radius = 1.0
        self._grip = np.array([0.0, 0.0, 1.0])
        self._axes: list[Array] | None = None
        self._axis: Array | None = None
        self._constrain = False

    def place(self, center: ArrayLike, radius: float) -> None:
        """Put the ball into the window: its centre, shape (2,), and radius in pixels, y down."""
        self._center = np.array(center, dtype=float)[:2]
        self._radius = float(radius)

    def setaxes(self, *axes: ArrayLike | None) -> None:
        """Set the axes among which a constrained ball chooses, each of shape (3,); one None for no axes."""
        given = [axis for axis in axes if axis is not None]
        self._axes = [unit3(axis, "axis") for axis in given] or None

    @property
    def constrain(self) -> bool:
        """Whether the ball turns about one of the axes only, the one nearest to where the drag begins."""
        return self._constrain

    @constrain.setter
    def constrain(self, value: bool) -> None:
        self._constrain = bool(value)

    def down(self, point: ArrayLike) -> None:
        """Begin a drag at a point of the window, shape (2,), pixels."""
        self._grip = arcball_map_to_sphere(point, self._center, self._radius)
        self._at_down = self._before = self._now
        self._axis = None
        if self._constrain and self._axes is not None:
            self._axis = arcball_nearest_axis(self._grip, self._axes)
            self._grip = arcball_constrain_to_axis(self._grip, self._axis)

    def drag(self, point: ArrayLike) -> None:
        """Move to a point of the window, shape (2,), pixels: the ball turns by twice the arc from where it began."""
        to = arcball_map_to_sphere(point, self._center, self._radius)
        if self._axis is not None:
            to = arcball_constrain_to_axis(to, self._axis)
        self._before = self._now
        turn = np.array([self._grip @ to, *np.cross(self._grip, to)])
        self._now = quaternion_multiply(unit_vector(turn), self._at_down)

    def next(self, acceleration: float = 0.0) -> None:
        """Go on as in the last drag; `acceleration` is the additional part of that step."""
        following = quaternion_slerp(self._before, self._now, 2.0 + acceleration, shortestpath=False)
        self._before, self._now = self._now, following

    def matrix(self) -> Array:
        """The rotation now, shape (4, 4)."""
        return quaternion_matrix(self._now)


def arcball_map_to_sphere(point: ArrayLike, center: ArrayLike, radius: float) -> Array:
    """The point of the unit sphere in front of a point of the window, shape (3,): x right, y up, z to the viewer.

    Parameters
    ----------
    point
        Shape (2,), pixels, y down. Outside the ball it counts as the nearest point of its rim.
    center
        Of the ball, shape (2,), pixels.
    radius
        Of the ball, pixels.
    """
    (x, y), (x0, y0) = np.asarray(point, dtype=float)[:2], np.asarray(center, dtype=float)[:2]
    across = np.array([x - x0, y0 - y]) / radius
    size = math.hypot(*across)
    if size > 1.0:
        return np.array([*(across / size), 0.0])
    return np.array([*across, math.sqrt(1.0 - size**2)])


def arcball_constrain_to_axis(point: ArrayLike, axis: ArrayLike) -> Array:
    """The point nearest to `point` on the great circle around an axis, on the viewer's side (z >= 0), shape (3,).

    Parameters
    ----------
    point
        Of the unit sphere, shape (3,).
    axis
        Shape (3,), of any length.
    """
    at, a = vector3(point, "point"), unit3(axis, "axis")
    across = at - (at @ a) * a
    size = float(np.linalg.norm(across))
    if size > 1e-15:
        return across / (size if across[2] >= 0.0 else -size)
    if abs(a[2]) == 1.0:
        return np.array([1.0, 0.0, 0.0])  # any point of the rim
    return np.array([-a[1], a[0], 0.0]) / math.hypot(a[0], a[1])


def arcball_nearest_axis(point: ArrayLike, axes: ArrayLike | list[Array]) -> Array:
    """The one of several axes whose great circle is nearest to a point of the unit sphere, shape (3,)."""
    at = vector3(point, "point")
    candidates = [vector3(axis, "axis") for axis in np.asarray(axes, dtype=float)]
    return max(candidates, key=lambda axis: float(arcball_constrain_to_axis(at, axis) @ at))
