"""Translations, reflections, rotations, scalings and shears."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike
from scipy.spatial.transform import Rotation  # type: ignore[import-untyped, unused-ignore]

from pydart2.utils.transformations._vectors import Array, matrix4, transform, unit3, vector3


def identity_matrix() -> Array:
    """The identity, shape (4, 4)."""
    return np.eye(4)


def translation_matrix(direction: ArrayLike) -> Array:
    """The translation by a vector, shape (4, 4)."""
    return transform(np.eye(3), vector3(direction, "direction"))


def translation_from_matrix(matrix: ArrayLike) -> Array:
    """The vector by which a transform moves the origin, shape (3,)."""
    return matrix4(matrix)[:3, 3]


def reflection_matrix(point: ArrayLike, normal: ArrayLike) -> Array:
    """The mirror image in a plane, shape (4, 4).

    Parameters
    ----------
    point
        Of the plane, shape (3,).
    normal
        Of the plane, shape (3,), of any length.
    """
    at, n = vector3(point, "point"), unit3(normal, "normal")
    return transform(np.eye(3) - 2.0 * np.outer(n, n), 2.0 * (at @ n) * n)


def reflection_from_matrix(matrix: ArrayLike) -> tuple[Array, Array]:
    """The plane of a reflection.

    Returns
    -------
    point : ndarray
        The point of the plane nearest to the origin, homogeneous, shape (4,).
    normal : ndarray
        Of length 1, shape (3,).

    Raises
    ------
    ValueError
        If the matrix is no reflection.
    """
    m = normalized(matrix)
    outer = np.eye(3) - m[:3, :3]  # twice the outer product of the normal with itself
    normal = _unit_or_z(outer[:, np.argmax(np.diag(outer))])
    point = 0.5 * (m[:3, 3] @ normal) * normal
    check(m, reflection_matrix(point, normal), "reflection")
    return homogeneous(point), normal


def rotation_matrix(angle: float, direction: ArrayLike, point: ArrayLike | None = None) -> Array:
    """The rotation about an axis, shape (4, 4).

    Parameters
    ----------
    angle
        rad.
    direction
        Of the axis, shape (3,), of any length.
    point
        Of the axis, shape (3,); None for the origin.
    """
    linear = Rotation.from_rotvec(angle * unit3(direction, "direction")).as_matrix()
    return _about(linear, point)


def rotation_from_matrix(matrix: ArrayLike) -> tuple[float, Array, Array]:
    """The axis of a rotation.

    Returns
    -------
    angle : float
        In [0, π], rad.
    direction : ndarray
        Of the axis, of length 1, shape (3,); z if the angle is 0.
    point : ndarray
        The point of the axis nearest to the origin, homogeneous, shape (4,).

    Raises
    ------
    ValueError
        If the matrix is no rotation about an axis, but for example a screw motion.
    """
    m = normalized(matrix)
    if np.linalg.det(m[:3, :3]) < 0.5:
        raise ValueError(f"not a rotation matrix:\n{m}")
    vector = Rotation.from_matrix(m[:3, :3]).as_rotvec()
    angle = float(np.linalg.norm(vector))
    direction = _unit_or_z(vector)
    across = m[:3, 3] - (m[:3, 3] @ direction) * direction
    point = 0.5 * (across + np.cross(direction, across) / math.tan(0.5 * angle)) if angle else np.zeros(3)
    check(m, rotation_matrix(angle, direction, point), "rotation")
    return angle, direction, homogeneous(point)


def scale_matrix(factor: float, origin: ArrayLike | None = None, direction: ArrayLike | None = None) -> Array:
    """The scaling about a point, shape (4, 4).

    Parameters
    ----------
    factor
        Scale; -1 without a direction is the reflection in a point.
    origin
        The point that stays, shape (3,); None for the origin.
    direction
        The only direction that is scaled, shape (3,), of any length; None for all.
    """
    if direction is None:
        return _about(factor * np.eye(3), origin)
    d = unit3(direction, "direction")
    return _about(np.eye(3) + (factor - 1.0) * np.outer(d, d), origin)


def scale_from_matrix(matrix: ArrayLike) -> tuple[float, Array, Array | None]:
    """The factor, point and direction of a scaling.

    Returns
    -------
    factor : float
    origin : ndarray
        A point that stays, homogeneous, shape (4,).
    direction : ndarray or None
        Of length 1, shape (3,); None if all directions are scaled.

    Raises
    ------
    ValueError
        If the matrix is no scaling.
    """
    m = normalized(matrix)
    stretch = m[:3, :3] - np.eye(3)  # factor - 1 times the identity, or times the outer product of the direction
    direction = None
    change = float(np.trace(stretch)) / 3.0
    if not np.allclose(stretch, change * np.eye(3), rtol=0.0, atol=1e-8 * np.abs(m).max()):
        change *= 3.0
        direction = _unit_or_z(stretch[:, np.argmax(np.abs(np.diag(stretch)))])
    origin = -m[:3, 3] / change if change else np.zeros(3)
    check(m, scale_matrix(change + 1.0, origin, direction), "scaling")
    return change + 1.0, homogeneous(origin), direction


def shear_matrix(angle: float, direction: ArrayLike, point: ArrayLike, normal: ArrayLike) -> Array:
    """The shear along a plane, shape (4, 4).

    A point p of the space moves to q so that, with p' its foot on the plane, the angle p p' q is `angle`.

    Parameters
    ----------
    angle
        rad.
    direction
        In the plane, shape (3,), of any length.
    point
        Of the plane, shape (3,).
    normal
        Of the plane, shape (3,), of any length.

    Raises
    ------
    ValueError
        If direction and normal are not orthogonal.
    """
    d, n = unit3(direction, "direction"), unit3(normal, "normal")
    if abs(d @ n) > 1e-6:
        raise ValueError(f"a shear's direction {d} and normal {n} must be orthogonal")
    return _about(np.eye(3) + math.tan(angle) * np.outer(d, n), point)


def shear_from_matrix(matrix: ArrayLike) -> tuple[float, Array, Array, Array]:
    """The angle, direction, point and normal of a shear.

    Returns
    -------
    angle : float
        In (0, π/2), rad.
    direction : ndarray
        Of length 1, shape (3,).
    point : ndarray
        The point of the plane nearest to the origin, homogeneous, shape (4,).
    normal : ndarray
        Of length 1, shape (3,).

    Raises
    ------
    ValueError
        If the matrix is no shear, or the identity.
    """
    m = normalized(matrix)
    left, sizes, right = np.linalg.svd(m[:3, :3] - np.eye(3))
    direction, normal, slope = left[:, 0], right[0], float(sizes[0])
    if slope < 1e-12 or abs(direction @ normal) > 1e-6:
        raise ValueError(f"not a shear matrix:\n{m}")
    point = -(m[:3, 3] @ direction) / slope * normal
    angle = math.atan(slope)
    check(m, shear_matrix(angle, direction, point, normal), "shear")
    return angle, direction, homogeneous(point), normal


def inverse_matrix(matrix: ArrayLike) -> Array:
    """The inverse of a square matrix; numpy.linalg.LinAlgError if there is none."""
    return np.asarray(np.linalg.inv(np.asarray(matrix, dtype=float)))


def concatenate_matrices(*matrices: ArrayLike) -> Array:
    """The product of transforms, shape (4, 4); the last one acts first. The identity if there are none."""
    product = np.eye(4)
    for matrix in matrices:
        product = product @ matrix4(matrix)
    return product


def is_same_transform(matrix0: ArrayLike, matrix1: ArrayLike) -> bool:
    """Whether two transforms are equal up to rounding and a factor, which homogeneous vectors do not notice."""
    return bool(np.allclose(normalized(matrix0), normalized(matrix1)))


# For this package


def normalized(matrix: ArrayLike) -> Array:
    """A transform with 1 as its last entry."""
    m = matrix4(matrix)
    last = float(m[3, 3])
    if last == 0.0:
        raise ValueError(f"the last entry of a transform cannot be 0:\n{m}")
    return m / last


def homogeneous(point: Array) -> Array:
    """[x, y, z, 1]."""
    return np.append(point, 1.0)


def check(matrix: Array, rebuilt: Array, kind: str) -> None:
    """Refuse a matrix whose parameters give another one."""
    if not np.allclose(matrix, rebuilt, rtol=0.0, atol=1e-7 * np.abs(matrix).max()):
        raise ValueError(f"not a {kind} matrix:\n{matrix}")


def _about(linear: Array, point: ArrayLike | None) -> Array:
    """A linear map that leaves the point, not the origin, where it is."""
    if point is None:
        return transform(linear)
    at = vector3(point, "point")
    return transform(linear, at - linear @ at)


def _unit_or_z(vector: Array) -> Array:
    length = np.linalg.norm(vector)
    return vector / length if length else np.array([0.0, 0.0, 1.0])
