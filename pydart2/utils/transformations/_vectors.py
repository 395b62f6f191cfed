"""Vectors, and how arguments become arrays."""

from __future__ import annotations

from typing import Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array: TypeAlias = NDArray[np.float64]


def vector3(x: ArrayLike, name: str) -> Array:
    """The first three numbers of a vector of shape (3,) or (4,), which may stand in a column."""
    vector = np.array(x, dtype=float)
    if vector.ndim == 2 and vector.shape[1] == 1:
        vector = vector[:, 0]
    if vector.shape not in ((3,), (4,)):
        raise ValueError(f"{name}: shape (3,) or (4,) expected, got {vector.shape}")
    return vector[:3]


def unit3(x: ArrayLike, name: str) -> Array:
    """vector3() of length 1."""
    vector = vector3(x, name)
    length = np.linalg.norm(vector)
    if length == 0.0:
        raise ValueError(f"{name}: a zero vector has no direction")
    return vector / length


def matrix4(x: ArrayLike) -> Array:
    """A copy of a transform."""
    matrix = np.array(x, dtype=float)
    if matrix.shape != (4, 4):
        raise ValueError(f"matrix: shape (4, 4) expected, got {matrix.shape}")
    return matrix


def matrix3(x: ArrayLike) -> Array:
    """The upper left part of a matrix of shape (3, 3) or (4, 4)."""
    matrix = np.array(x, dtype=float)
    if matrix.shape not in ((3, 3), (4, 4)):
        raise ValueError(f"matrix: shape (3, 3) or (4, 4) expected, got {matrix.shape}")
    return matrix[:3, :3]


def transform(linear: Array, translation: ArrayLike = (0.0, 0.0, 0.0)) -> Array:
    """The transform ``x → linear @ x + translation``."""
    matrix = np.eye(len(linear) + 1)
    matrix[:-1, :-1] = linear
    matrix[:-1, -1] = translation
    return matrix


def vector_norm(data: ArrayLike, axis: int | None = None, out: Array | None = None) -> Any:
    """Euclidean length of vectors.

    Parameters
    ----------
    data
        Any shape.
    axis
        Along which the vectors lie; None for one vector of all entries.
    out
        Array for the result; None is returned then.

    Returns
    -------
    float or ndarray
        The shape of `data` without `axis`.
    """
    squares = np.square(np.asarray(data, dtype=float))
    if out is None:
        return np.sqrt(squares.sum(axis=axis))
    np.sqrt(squares.sum(axis=axis), out=out)
    return None


def unit_vector(data: ArrayLike, axis: int | None = None, out: Array | None = None) -> Any:
    """Vectors divided by their lengths.

    Parameters
    ----------
    data
        Any shape.
    axis
        Along which the vectors lie; None for one vector of all entries.
    out
        Array for the result, may be `data` itself; None is returned then.

    Raises
    ------
    ValueError
        If a vector is zero.
    """
    vectors = np.asarray(data, dtype=float)
    lengths = np.sqrt(np.square(vectors).sum(axis=axis, keepdims=True))
    if vectors.size and not np.all(lengths):
        raise ValueError("a zero vector has no direction")
    if out is None:
        return vectors / lengths
    np.divide(vectors, lengths, out=out)
    return None


def random_vector(size: int | tuple[int, ...]) -> Array:
    """Numbers of [0, 1), uniformly distributed, of shape `size`; from NumPy's global generator."""
    return np.random.random_sample(size)


def vector_product(v0: ArrayLike, v1: ArrayLike, axis: int = 0) -> Array:
    """Cross products of vectors of three numbers along `axis`; the other axes broadcast."""
    return np.cross(np.asarray(v0, dtype=float), np.asarray(v1, dtype=float), axis=axis)


def angle_between_vectors(v0: ArrayLike, v1: ArrayLike, directed: bool = True, axis: int = 0) -> Any:
    """Angles between vectors, rad.

    Parameters
    ----------
    v0, v1
        Vectors along `axis`, of any dimension; the other axes broadcast.
    directed
        False for the angle between the lines along the vectors, at most π/2.

    Returns
    -------
    float or ndarray
        In [0, π]; exact also where the arc cosine is not, next to 0 and π (W. Kahan, How futile are mindless
        assessments of roundoff, 2006, section 12).

    Raises
    ------
    ValueError
        If a vector is zero.
    """
    u0, u1 = unit_vector(v0, axis=axis), unit_vector(v1, axis=axis)
    angle = 2.0 * np.arctan2(vector_norm(u0 - u1, axis=axis), vector_norm(u0 + u1, axis=axis))
    return angle if directed else np.minimum(angle, np.pi - angle)
