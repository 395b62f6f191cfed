"""Where things lie in a scene: poses between points, boxes around things."""

from __future__ import annotations

import math
from collections.abc import Iterable
from itertools import product
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from pydart2.gui.draw_list import Item

Array = NDArray[np.float64]


def grid_of(width: float) -> float:
    """Edge of the cells on a floor so wide, m."""
    return 1.0 if width >= 8.0 else 0.5 if width >= 4.0 else 0.25


def between(start: Array, end: Array, part: float = 0.5) -> Array:
    """A pose (4, 4) whose z axis points from `start` to `end`, and its x axis nearly along the world's x (or y, where z
    is along x); its origin is at this part of the way."""
    # In numbers of Python, which are ten times quicker than arrays of three.
    (o, p, q), (u, v, w) = start.tolist(), end.tolist()
    u, v, w = u - o, v - p, w - q
    length = math.hypot(u, v, w)
    a, b, c = u / length, v / length, w / length
    d, e, f = (1.0 - a * a, -a * b, -a * c) if abs(a) < 0.9 else (-b * a, 1.0 - b * b, -b * c)
    width = math.hypot(d, e, f)
    d, e, f = d / width, e / width, f / width
    return np.array(
        [
            [d, b * f - c * e, a, o + part * u],
            [e, c * d - a * f, b, p + part * v],
            [f, a * e - b * d, c, q + part * w],
            [0.0, 0.0, 0.0, 1.0],
        ]
    )


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


def corners(item: Item) -> Array:
    """Of the box around an item's mesh, in the world, shape (8, 3), m."""
    ends = np.array(list(product(*np.transpose(item.mesh.bounds))))
    return np.asarray(ends @ item.transform[:3, :3].T + item.transform[:3, 3])
