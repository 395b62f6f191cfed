"""Quaternions [w, x, y, z]."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike
from scipy.spatial.transform import Rotation  # type: ignore[import-untyped, unused-ignore]

from pydart2.utils.transformations._vectors import Array, matrix3, transform, vector3


def quaternion_about_axis(angle: float, axis: ArrayLike) -> Array:
    """The quaternion [w, x, y, z] of a rotation about an axis, shape (4,).

    Parameters
    ----------
    angle
        rad.
    axis
        Shape (3,), of any length; zero is allowed if the angle is.

    Raises
    ------
    ValueError
        If the axis is zero and the angle is not.
    """
    vector = vector3(axis, "axis")
    length = float(np.linalg.norm(vector))
    if length == 0.0 and angle != 0.0:
        raise ValueError("axis: a zero vector has no direction")
    return np.array([math.cos(0.5 * angle), *(math.sin(0.5 * angle) / (length or 1.0) * vector)])


def quaternion_matrix(quaternion: ArrayLike) -> Array:
    """The rotation of a quaternion [w, x, y, z], shape (4, 4).

    Parameters
    ----------
    quaternion
        Shape (4,), of any length but zero.

    Raises
    ------
    ValueError
        If it is zero.
    """
    return transform(Rotation.from_quat(np.roll(_unit(quaternion), -1)).as_matrix())


def quaternion_from_matrix(matrix: ArrayLike, isprecise: bool = False) -> Array:
    """The quaternion [w, x, y, z] of a rotation, w >= 0, shape (4,).

    Parameters
    ----------
    matrix
        Shape (4, 4) or (3, 3).
    isprecise
        True if the matrix is known to be a rotation, which is quicker. Else the quaternion is that of the nearest
        rotation (I. Y. Bar-Itzhack, New method for extracting the quaternion from a rotation matrix, Journal of
        Guidance, Control, and Dynamics 23(6), 2000).
    """
    part = matrix3(matrix)
    if not isprecise:
        return nearest_quaternion(part)
    return _upper(from_scipy(Rotation.from_matrix(part)))


def quaternion_multiply(quaternion1: ArrayLike, quaternion0: ArrayLike) -> Array:
    """The product of two quaternions [w, x, y, z], shape (4,): the rotation quaternion0 and then quaternion1."""
    second, first = _four(quaternion1), _four(quaternion0)
    w1, v1, w0, v0 = second[0], second[1:], first[0], first[1:]
    return np.array([w1 * w0 - v1 @ v0, *(w1 * v0 + w0 * v1 + np.cross(v1, v0))])


def quaternion_conjugate(quaternion: ArrayLike) -> Array:
    """[w, -x, -y, -z], shape (4,); of a unit quaternion it is the inverse."""
    return _four(quaternion) * (1.0, -1.0, -1.0, -1.0)


def quaternion_inverse(quaternion: ArrayLike) -> Array:
    """The quaternion [w, x, y, z] whose product with another is 1, shape (4,); ValueError if that is zero."""
    return quaternion_conjugate(_unit(quaternion)) / float(np.linalg.norm(_four(quaternion)))


def quaternion_real(quaternion: ArrayLike) -> float:
    """w of [w, x, y, z]."""
    return float(_four(quaternion)[0])


def quaternion_imag(quaternion: ArrayLike) -> Array:
    """[x, y, z] of [w, x, y, z], shape (3,)."""
    return _four(quaternion)[1:]


def quaternion_slerp(
    quat0: ArrayLike, quat1: ArrayLike, fraction: float, spin: int = 0, shortestpath: bool = True
) -> Array:
    """Spherical linear interpolation (K. Shoemake, Animating rotation with quaternion curves, SIGGRAPH 1985).

    Parameters
    ----------
    quat0, quat1
        [w, x, y, z], shape (4,), of any length but zero.
    fraction
        0 gives `quat0` and 1 gives `quat1`, both at length 1; beyond, the rotation goes on.
    spin
        Additional half turns of the quaternion, full ones of what it rotates.
    shortestpath
        Whether to go to -quat1, the same rotation, if that is nearer.

    Returns
    -------
    ndarray
        Shape (4,), of length 1. `quat0` if both are the same rotation: then there is no axis to turn about.
    """
    start, end = _unit(quat0), _unit(quat1)
    if fraction == 1.0:
        return end
    if shortestpath and start @ end < 0.0:
        end = -end
    cosine = float(start @ end)
    across = end - cosine * start
    sine = float(np.linalg.norm(across))
    if sine < 1e-15:
        return start
    turn = fraction * (math.atan2(sine, cosine) + spin * math.pi)
    return math.cos(turn) * start + math.sin(turn) / sine * across


def random_quaternion(rand: ArrayLike | None = None) -> Array:
    """A unit quaternion [w, x, y, z], uniformly distributed over the rotations, shape (4,).

    K. Shoemake, Uniform random rotations, Graphics Gems III, 1992.

    Parameters
    ----------
    rand
        Three independent numbers, uniformly distributed in [0, 1], shape (3,); None for NumPy's global generator.
    """
    u = vector3(np.random.random_sample(3) if rand is None else rand, "rand")
    near, far = math.sqrt(1.0 - u[0]), math.sqrt(u[0])
    t1, t2 = 2.0 * math.pi * u[1:]
    return np.array([far * math.cos(t2), near * math.sin(t1), near * math.cos(t1), far * math.sin(t2)])


def random_rotation_matrix(rand: ArrayLike | None = None) -> Array:
    """A rotation, uniformly distributed, shape (4, 4); see random_quaternion()."""
    return quaternion_matrix(random_quaternion(rand))


# For this package


def from_scipy(rotation: Rotation) -> Array:
    """The quaternion [w, x, y, z] of a rotation."""
    return np.roll(rotation.as_quat(), 1)


def nearest_quaternion(matrix: Array) -> Array:
    """The quaternion [w, x, y, z] of the rotation R with the largest trace(Rᵀ matrix), w >= 0.

    trace(Rᵀ matrix) is a quadratic form of the quaternion (B. K. P. Horn, Closed-form solution of absolute orientation
    using unit quaternions, Journal of the Optical Society of America A 4(4), 1987).
    """
    m = matrix
    form = np.zeros((4, 4))
    form[1:, 1:] = m + m.T - np.trace(m) * np.eye(3)
    form[0, 0] = np.trace(m)
    form[1:, 0] = m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1]
    return _upper(np.linalg.eigh(form).eigenvectors[:, -1])  # eigh() reads the lower triangle


def _upper(q: Array) -> Array:
    return -q if q[0] < 0.0 else q


def _four(q: ArrayLike) -> Array:
    quaternion = np.array(q, dtype=float)
    if quaternion.shape != (4,):
        raise ValueError(f"quaternion: shape (4,) expected, got {quaternion.shape}")
    return quaternion


def _unit(q: ArrayLike) -> Array:
    quaternion = _four(q)
    length = np.linalg.norm(quaternion)
    if length == 0.0:
        raise ValueError("a zero quaternion is no rotation")
    return quaternion / length
