"""Transforms from and to scale, shear, angles, translation and perspective."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from pydart2.utils.transformations._euler import euler_from_matrix, euler_matrix
from pydart2.utils.transformations._matrices import normalized
from pydart2.utils.transformations._vectors import Array, transform


def compose_matrix(
    scale: ArrayLike | None = None,
    shear: ArrayLike | None = None,
    angles: ArrayLike | None = None,
    translate: ArrayLike | None = None,
    perspective: ArrayLike | None = None,
) -> Array:
    """The transform that scales, shears, rotates, translates and then takes a perspective, shape (4, 4).

    Parameters
    ----------
    scale
        Factors along x, y, z, shape (3,).
    shear
        Shear factors of x by y, x by z, y by z, shape (3,).
    angles
        Euler angles about the static axes x, y, z, shape (3,), rad.
    translate
        Shape (3,).
    perspective
        Last row of the perspective matrix, shape (4,).

    Raises
    ------
    ValueError
        If the origin is mapped to infinity.
    """
    linear = np.eye(3) if angles is None else euler_matrix(*_numbers(angles, 3, "angles"))[:3, :3]
    if shear is not None:
        upper = np.eye(3)
        upper[0, 1], upper[0, 2], upper[1, 2] = _numbers(shear, 3, "shear")
        linear = linear @ upper
    if scale is not None:
        linear = linear * _numbers(scale, 3, "scale")
    matrix = transform(linear, np.zeros(3) if translate is None else _numbers(translate, 3, "translate"))
    if perspective is not None:
        matrix[3] = _numbers(perspective, 4, "perspective") @ matrix
    return normalized(matrix)


def decompose_matrix(matrix: ArrayLike) -> tuple[Array, Array, Array, Array, Array]:
    """The arguments for compose_matrix().

    The linear part is a rotation times a triangular matrix (QR decomposition). Of a mirroring matrix all three scales
    are negative.

    Returns
    -------
    scale : ndarray
        Shape (3,).
    shear : ndarray
        Shape (3,).
    angles : ndarray
        Shape (3,), rad.
    translate : ndarray
        Shape (3,).
    perspective : ndarray
        Shape (4,).

    Raises
    ------
    ValueError
        If the matrix is singular, or maps the origin to infinity.
    """
    m = normalized(matrix)
    affine = m.copy()
    affine[3] = 0.0, 0.0, 0.0, 1.0
    rotation, upper = np.linalg.qr(m[:3, :3])
    signs = np.where(np.diag(upper) < 0.0, -1.0, 1.0)
    rotation, upper = rotation * signs, signs[:, None] * upper
    if np.linalg.det(rotation) < 0.0:
        rotation, upper = -rotation, -upper
    scale = np.diag(upper).copy()
    if np.abs(scale).min() <= 1e-14 * np.abs(scale).max():
        raise ValueError(f"a singular matrix cannot be decomposed:\n{m}")
    shear = (upper / scale)[[0, 0, 1], [1, 2, 2]]
    perspective = np.linalg.solve(affine.T, m[3])
    return scale, shear, np.array(euler_from_matrix(rotation)), m[:3, 3].copy(), perspective


def orthogonalization_matrix(lengths: ArrayLike, angles: ArrayLike) -> Array:
    """The map of fractional coordinates in a crystal's cell to Cartesian ones, shape (4, 4).

    The third edge of the cell lies along z and the second in the y-z plane.

    Parameters
    ----------
    lengths
        Of the edges a, b, c, shape (3,).
    angles
        Between b and c, a and c, a and b, shape (3,), degrees.

    Raises
    ------
    ValueError
        If there is no cell with these angles.
    """
    a, b, c = _numbers(lengths, 3, "lengths")
    degrees = _numbers(angles, 3, "angles")
    (cos_bc, cos_ac, cos_ab), sin_bc = np.cos(np.deg2rad(degrees)), np.sin(np.deg2rad(degrees[0]))
    if sin_bc > 0.0:
        first = np.array([0.0, (cos_ab - cos_bc * cos_ac) / sin_bc, cos_ac])
        rest = 1.0 - first @ first
    if sin_bc <= 0.0 or rest <= 0.0:
        raise ValueError(f"no cell has the angles {degrees}")
    first[0] = np.sqrt(rest)
    return transform(np.column_stack([a * first, [0.0, b * sin_bc, b * cos_bc], [0.0, 0.0, c]]))


def _numbers(x: ArrayLike, count: int, name: str) -> Array:
    numbers = np.array(x, dtype=float)
    if numbers.shape != (count,):
        raise ValueError(f"{name}: shape ({count},) expected, got {numbers.shape}")
    return numbers
