"""Positions and orientations as 4x4 transforms."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pydart2.given import numbers


def pose(position: ArrayLike, orientation: ArrayLike | None = None) -> NDArray[np.float64]:
    """The transform of a position, shape (3,), m, and an orientation: a quaternion [w, x, y, z], or a (3, 3) matrix.

    Raises ValueError for other shapes, what is not finite, a quaternion of length 0 and a matrix that is no rotation.
    """
    transform = np.eye(4)
    place = numbers(position, "a position")
    if place.shape != (3,):
        raise ValueError(f"a position has the shape (3,), got {place.shape}")
    if not np.isfinite(place).all():
        raise ValueError(f"a position must be finite, got {place}")
    transform[:3, 3] = place
    if orientation is not None:
        transform[:3, :3] = rotation(orientation)
    return transform


def rotation(orientation: ArrayLike) -> NDArray[np.float64]:
    """The matrix of a quaternion [w, x, y, z] of any length, or of a (3, 3) matrix."""
    turn = numbers(orientation, "an orientation")
    if turn.shape == (3, 3):
        if not (np.abs(turn @ turn.T - np.eye(3)) < 1e-6).all() or np.linalg.det(turn) < 0.0:
            raise ValueError(f"a (3, 3) matrix must be a rotation, got {turn.tolist()}")
        return turn
    if turn.shape != (4,):
        raise ValueError(f"an orientation is a quaternion [w, x, y, z] or a (3, 3) matrix, got the shape {turn.shape}")
    length = float(np.linalg.norm(turn))
    if not 0.0 < length < np.inf:
        raise ValueError(f"a quaternion must be finite and not of length 0, got {turn}")
    w, x, y, z = turn / length
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def between(z_axis: ArrayLike) -> NDArray[np.float64]:
    """A rotation, shape (3, 3), that takes z to a direction of any length, shape (3,), 1."""
    z = np.asarray(z_axis, dtype=float) / np.linalg.norm(z_axis)
    x = np.cross([0.0, 1.0, 0.0] if abs(z[1]) < 0.9 else [0.0, 0.0, 1.0], z)
    x /= np.linalg.norm(x)
    return np.column_stack([x, np.cross(z, x), z])


def looking(eye: ArrayLike, target: ArrayLike, up: ArrayLike) -> NDArray[np.float64]:
    """How an eye is turned, shape (3, 3), 1, that looks along its -z at a target, with `up` upwards in what it sees.

    `eye`, `target` and `up` are of shape (3,), m. Raises ValueError if the target is at the eye, or straight above or
    below it.
    """
    back = np.asarray(eye, dtype=float) - np.asarray(target, dtype=float)
    distance = float(np.linalg.norm(back))
    if not distance > 0.0:
        raise ValueError("the camera is at what it looks at")
    back /= distance
    right = np.cross(np.asarray(up, dtype=float), back)
    if not np.linalg.norm(right) > 1e-9 * np.linalg.norm(up):
        raise ValueError("the camera looks along `up`; choose another up")
    right /= np.linalg.norm(right)
    return np.column_stack([right, np.cross(back, right), back])
