"""Transforms fitted to pairs of points."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from pydart2.utils.transformations._quaternions import nearest_quaternion, quaternion_matrix
from pydart2.utils.transformations._vectors import Array, transform


def affine_matrix_from_points(
    v0: ArrayLike, v1: ArrayLike, shear: bool = True, scale: bool = True, usesvd: bool = True
) -> Array:
    """The transform that best maps points to other points.

    Parameters
    ----------
    v0, v1
        Points in columns, shape (d, n) with d >= 2 and n >= d.
    shear
        True for any affine map: total least squares, in both sets of points (R. Hartley and A. Zisserman, Multiple
        view geometry in computer vision, 2nd edition, algorithm 4.7). False for a rotation with least squares.
    scale
        Without shear: whether to scale as well, by the ratio of the distances from the centroids (root mean square).
    usesvd
        Without shear: find the rotation by a singular value decomposition (W. Kabsch, Acta Crystallographica A 34,
        1978). False, for d = 3: by quaternions (B. K. P. Horn, Journal of the Optical Society of America A 4(4), 1987).

    Returns
    -------
    ndarray
        Homogeneous, shape (d + 1, d + 1).

    Raises
    ------
    ValueError
        If the shapes are others.
    """
    from_points, to_points = np.array(v0, dtype=float), np.array(v1, dtype=float)
    shape = from_points.shape
    if from_points.ndim != 2 or shape != to_points.shape or not 2 <= shape[0] <= shape[1]:
        raise ValueError(f"two arrays of shape (d, n) with n >= d >= 2 expected, got {shape} and {to_points.shape}")
    center0, center1 = from_points.mean(axis=1), to_points.mean(axis=1)
    x, y = from_points - center0[:, None], to_points - center1[:, None]
    if shear:
        linear = _affine(x, y)
    else:
        linear = _rotation_by_svd(x, y) if usesvd or len(x) != 3 else _rotation_by_quaternion(x, y)
        if scale:
            linear = linear * _ratio(x, y)
    return transform(linear, center1 - linear @ center0)


def superimposition_matrix(v0: ArrayLike, v1: ArrayLike, scale: bool = False, usesvd: bool = True) -> Array:
    """The rotation, translation and with `scale` also scaling that best maps points to other points, shape (4, 4).

    Parameters
    ----------
    v0, v1
        Points in columns, shape (3, n) or homogeneous (4, n), n >= 3.
    scale, usesvd
        See affine_matrix_from_points().

    Raises
    ------
    ValueError
        If the shapes are others.
    """
    x, y = np.asarray(v0, dtype=float), np.asarray(v1, dtype=float)
    if not len(x) == len(y) or len(x) not in (3, 4):
        raise ValueError(f"two arrays of shape (3, n) or (4, n) expected, got {x.shape} and {y.shape}")
    return affine_matrix_from_points(x[:3], y[:3], shear=False, scale=scale, usesvd=usesvd)


def _affine(x: Array, y: Array) -> Array:
    d = len(x)
    basis = np.linalg.svd(np.vstack([x, y]), full_matrices=False)[0][:, :d]
    return np.asarray(basis[d:] @ np.linalg.pinv(basis[:d]))


def _rotation_by_svd(x: Array, y: Array) -> Array:
    left, _, right = np.linalg.svd(y @ x.T)
    if np.linalg.det(left @ right) < 0.0:
        left[:, -1] *= -1.0  # no reflection: give up the smallest component
    return np.asarray(left @ right)


def _rotation_by_quaternion(x: Array, y: Array) -> Array:
    return quaternion_matrix(nearest_quaternion(y @ x.T))[:3, :3]


def _ratio(x: Array, y: Array) -> float:
    size = np.linalg.norm(x)
    if size == 0.0:
        raise ValueError("points that all coincide cannot be scaled")
    return float(np.linalg.norm(y) / size)
