"""Projections onto a plane and clipping volumes."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from pydart2.utils.transformations._matrices import check, homogeneous, normalized
from pydart2.utils.transformations._vectors import Array, matrix4, transform, unit3, vector3


def projection_matrix(
    point: ArrayLike,
    normal: ArrayLike,
    direction: ArrayLike | None = None,
    perspective: ArrayLike | None = None,
    pseudo: bool = False,
) -> Array:
    """The projection onto a plane, shape (4, 4): orthogonal unless a direction or a perspective point is given.

    Parameters
    ----------
    point
        Of the plane, shape (3,).
    normal
        Of the plane, shape (3,), of any length.
    direction
        Of a parallel projection, shape (3,), of any length.
    perspective
        Where the rays of a perspective projection meet, shape (3,). Divide the results by their last number.
    pseudo
        Let a perspective projection keep the depth: the result lies off the plane along the normal, in the order of
        distance, and projected orthogonally it is where it is otherwise.

    Raises
    ------
    ValueError
        If the direction lies in the plane, or the perspective point does.
    """
    at, n = vector3(point, "point"), unit3(normal, "normal")
    if perspective is None:
        d = n if direction is None else vector3(direction, "direction")
        if d @ n == 0.0:
            raise ValueError(f"direction {d} is parallel to the plane with normal {n}")
        d = d / (d @ n)
        return transform(np.eye(3) - np.outer(d, n), (at @ n) * d)
    eye = vector3(perspective, "perspective")
    if (eye - at) @ n == 0.0:
        raise ValueError(f"perspective point {eye} lies in the plane")
    end = eye + n if pseudo else eye
    matrix = np.empty((4, 4))
    matrix[:3, :3] = ((eye - at) @ n) * np.eye(3) - np.outer(end, n)
    matrix[:3, 3] = (at @ n) * end
    matrix[3, :3] = -n
    matrix[3, 3] = eye @ n
    return matrix


def projection_from_matrix(
    matrix: ArrayLike, pseudo: bool = False
) -> tuple[Array, Array, Array | None, Array | None, bool]:
    """The arguments for projection_matrix().

    Parameters
    ----------
    matrix
        Shape (4, 4).
    pseudo
        Whether a perspective projection keeps the depth.

    Returns
    -------
    point : ndarray
        Of the plane, homogeneous, shape (4,).
    normal : ndarray
        Of length 1, shape (3,).
    direction : ndarray or None
        Of a parallel projection, of length 1, shape (3,).
    perspective : ndarray or None
        Of a perspective projection, shape (3,).
    pseudo : bool
        As given; False for a parallel projection.

    Raises
    ------
    ValueError
        If the matrix is no such projection.
    """
    m = matrix4(matrix)
    weight = np.linalg.norm(m[3, :3])
    if weight <= 1e-12 * np.abs(m).max():
        m = normalized(m)
        left, sizes, right = np.linalg.svd(np.eye(3) - m[:3, :3])
        direction, normal, point = left[:, 0], right[0], m[:3, 3]
        if abs(direction @ normal) * sizes[0] < 0.5:  # it is 1 for a projection
            raise ValueError(f"not a projection matrix:\n{m}")
        check(m, projection_matrix(point, normal, direction), "projection")
        return homogeneous(point), normal, direction, None, False
    m = m / weight
    depth = 0.5 * (np.trace(m[:3, :3]) - m[3, :3] @ m[:3, :3] @ m[3, :3])  # of the perspective point above the plane
    if pseudo and 3.0 * depth < np.trace(m[:3, :3]) + m[3, 3]:  # a negative common factor
        m, depth = -m, -depth
    normal = -m[3, :3]
    perspective = depth * normal - m[:3, :3] @ normal - (normal if pseudo else 0.0)
    point = (m[3, 3] - depth) * normal
    if (perspective - point) @ normal == 0.0:
        raise ValueError(f"not a projection matrix:\n{m}")
    check(m, projection_matrix(point, normal, None, perspective, pseudo), "projection")
    return homogeneous(point), normal, None, perspective, pseudo


def clip_matrix(
    left: float, right: float, bottom: float, top: float, near: float, far: float, perspective: bool = False
) -> Array:
    """The map of a viewing volume to the cube [-1, 1]³, shape (4, 4).

    Parameters
    ----------
    left, right
        Bounds of x.
    bottom, top
        Bounds of y.
    near, far
        Bounds of z.
    perspective
        False for a box; True for a pyramid from the origin along +z, whose bounds of x and y are at z = near. Divide
        its results by their last number, which is -z.

    Raises
    ------
    ValueError
        If bounds are not in ascending order, or near is not positive for a perspective.
    """
    low, high = np.array([left, bottom, near], dtype=float), np.array([right, top, far], dtype=float)
    if not np.all(low < high):
        raise ValueError("left < right, bottom < top and near < far expected")
    size, middle = high - low, 0.5 * (low + high)
    if not perspective:
        return transform(np.diag(2.0 / size), -2.0 * middle / size)
    if near <= 0.0:
        raise ValueError(f"near must be positive for a perspective, got {near}")
    matrix = np.zeros((4, 4))
    matrix[:2, :2] = np.diag(-2.0 * near / size[:2])
    matrix[:2, 2] = 2.0 * middle[:2] / size[:2]
    matrix[2, 2] = -2.0 * middle[2] / size[2]
    matrix[2, 3] = 2.0 * near * far / size[2]
    matrix[3, 2] = -1.0
    return matrix
