"""What the mouse does to a trackball: turn about a pivot, zoom and move at the model's scale, follow a body."""

from __future__ import annotations

from itertools import product

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pydart2.gui.camera import nearest
from pydart2.gui.trackball import Trackball

Array = NDArray[np.float64]

_PIXEL = 0.01  # m, what Trackball.zoom_to and trans_to move per pixel
_NEAREST = 0.05  # m


class CameraControl:
    """Moves a trackball.

    Attributes
    ----------
    trackball : Trackball
    pivot : (3,)
        The point of the world that drags turn about and that stays at its distance, m.
    """

    def __init__(self, trackball: Trackball) -> None:
        self.trackball = trackball
        self.pivot: Array = np.zeros(3)

    @property
    def rotation(self) -> Array:
        """From the world's to the eye's axes, shape (3, 3)."""
        return np.array(self.trackball.view[:3, :3])

    @property
    def trans(self) -> Array:
        """The world's origin in the eye's axes, shape (3,), m."""
        return np.array(self.trackball.trans, dtype=float)

    @trans.setter
    def trans(self, trans: ArrayLike) -> None:
        self.trackball.trans[:] = [float(v) for v in np.asarray(trans)]

    def to_eye(self, point: ArrayLike) -> Array:
        """A point of the world (3,) in the eye's axes, m."""
        return np.asarray(self.rotation @ np.asarray(point, dtype=float) + self.trans)

    @property
    def distance(self) -> float:
        """Of the pivot along the optical axis, m; not below 5 cm."""
        return max(float(-self.to_eye(self.pivot)[2]), _NEAREST)

    def pixel_size(self, height: int) -> float:
        """What a pixel covers at the pivot's distance in a picture of this height, m."""
        return float(2.0 * self.distance * np.tan(self.trackball.fov / 2.0) / max(height, 1))

    # Drags, in pixels of a picture of (width, height), y downwards

    def rotate(self, position: ArrayLike, change: ArrayLike, size: tuple[int, int]) -> None:
        """Turn about the pivot: the mouse came to `position` (2,) by a way of `change` (2,), both in pixels."""
        (x, y), (dx, dy) = np.asarray(position, dtype=float), np.asarray(change, dtype=float)
        before = self.to_eye(self.pivot)
        self.trackball.viewport = (max(size[0], 1), max(size[1], 1))
        self.trackball.drag_to(x, size[1] - y, dx, -dy)
        self.trans = self.trans + before - self.to_eye(self.pivot)

    def translate(self, change: ArrayLike, size: tuple[int, int]) -> None:
        """Move the world with the mouse, by `change` (2,) pixels: what is at the pivot's distance stays under it."""
        dx, dy = np.asarray(change, dtype=float) * (self.pixel_size(size[1]) / _PIXEL)
        self.trackball.trans_to(dx, -dy)

    def zoom(self, change: ArrayLike, size: tuple[int, int]) -> None:
        """Bring the pivot nearer: right and up, by `change` (2,) pixels."""
        dx, dy = np.asarray(change, dtype=float)
        self.zoom_by(np.exp(-(dx - dy) * 2.0 / max(size[1], 1)))

    def zoom_by(self, factor: float) -> None:
        """Multiply the pivot's distance, which stays at least 5 cm."""
        distance = self.distance
        self.trackball.trans[2] += distance - max(distance * factor, _NEAREST)

    # Where to look

    def frame(self, low: ArrayLike, high: ArrayLike, aspect: float = 1.0) -> None:
        """Show a box, given by its corners (3,), m, and at least 5 cm around its middle."""
        lowest, highest = np.asarray(low, dtype=float), np.asarray(high, dtype=float)
        self.pivot = (lowest + highest) / 2.0
        half = np.maximum(highest - lowest, _NEAREST) / 2.0
        corners = self.pivot + half * np.array(list(product((-1.0, 1.0), repeat=3)))
        self.trans = nearest(self.rotation, corners, self.trackball.fov, aspect)

    def follow(self, point: ArrayLike) -> None:
        """Move the eye by as much as the pivot has moved to get to `point` (3,), m."""
        moved = np.asarray(point, dtype=float)
        if np.isfinite(moved).all():
            self.trans = self.trans - self.rotation @ (moved - self.pivot)
            self.pivot = moved.copy()

    def ray(self, position: ArrayLike, size: tuple[int, int]) -> tuple[Array, Array]:
        """The eye (3,), m, and where the pixel at `position` (2,) looks, with length 1 along the optical axis (3,)."""
        (x, y), (width, height) = np.asarray(position, dtype=float), size
        top = np.tan(self.trackball.fov / 2.0)
        right = (2.0 * x / width - 1.0) * top * width / height
        direction = np.array([right, (1.0 - 2.0 * y / height) * top, -1.0])
        return -self.rotation.T @ self.trans, self.rotation.T @ direction

    def point_at(self, position: ArrayLike, size: tuple[int, int], depth: float) -> Array:
        """The point (3,) under a pixel at a depth along the optical axis, m."""
        eye, direction = self.ray(position, size)
        return eye + depth * direction

    def depth_of(self, point: ArrayLike) -> float:
        """Of a point (3,) along the optical axis, m."""
        return float(-self.to_eye(point)[2])
