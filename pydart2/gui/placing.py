"""Where things lie in a scene: poses between points, boxes around things."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from pydart2.gui.scene import Item

Array = NDArray[np.float64]


def grid_of(width: float) -> float:
    """Edge of the cells on a floor so wide, m."""
    return 1.0 if width >= 8.0 else 0.5 if width >= 4.0 else 0.25


def between(start: Array, end: Array, part: float = 0.5) -> Array:
    """A pose (4, 4) whose z axis points from `start` to `end`, and its x axis nearly along the world's x (or y, where z
    is along x); its origin is at this part of the way."""
    z = (end - start) / np.linalg.norm(end - start)
    x = np.eye(3)[0 if abs(z[0]) < 0.9 else 1]
    x = x - (x @ z) * z
    x /= np.linalg.norm(x)
    pose = np.eye(4)
    pose[:3, :3] = np.stack([x, np.cross(z, x), z], axis=1)
    pose[:3, 3] = start + part * (end - start)
    return pose


def boxes(items: Iterable[Item]) -> Array:
    """Lowest and highest corner in the world of the box around each item, shape (n, 2, 3), m."""
    chosen = list(items)
    if not chosen:
        return np.empty((0, 2, 3))
    bounds = np.array([item.mesh.bounds for item in chosen])
    matrices = np.array([item.transform for item in chosen])
    middle, half = bounds.mean(axis=1), np.diff(bounds, axis=1)[:, 0] / 2.0
    centre = np.einsum("nij,nj->ni", matrices[:, :3, :3], middle) + matrices[:, :3, 3]
    reach = np.einsum("nij,nj->ni", np.abs(matrices[:, :3, :3]), half)
    return np.stack([centre - reach, centre + reach], axis=1)
