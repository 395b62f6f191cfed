"""Euler angles about 24 sequences of axes."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import product

import numpy as np
from numpy.typing import ArrayLike
from scipy.spatial.transform import Rotation  # type: ignore[import-untyped, unused-ignore]

from pydart2.utils.transformations._quaternions import from_scipy, quaternion_matrix
from pydart2.utils.transformations._vectors import Array, matrix3, transform

Axes = str | Sequence[int]


def _static_axes(first: int, parity: int, repetition: int) -> tuple[int, int, int]:
    middle, last = (first + 1 + parity) % 3, (first + 2 - parity) % 3
    return first, middle, first if repetition else last


def _name(first: int, parity: int, repetition: int, frame: int) -> str:
    letters = "".join("xyz"[axis] for axis in _static_axes(first, parity, repetition))
    return f"r{letters[::-1]}" if frame else f"s{letters}"


_NUMBERS = {_name(*numbers): numbers for numbers in product((0, 1, 2), (0, 1), (0, 1), (0, 1))}


def euler_matrix(ai: float, aj: float, ak: float, axes: Axes = "sxyz") -> Array:
    """The rotation by Euler angles, shape (4, 4).

    Parameters
    ----------
    ai, aj, ak
        In the order of the axes, rad.
    axes
        Such as 'sxyz' or (0, 0, 0, 0), see the package.

    Raises
    ------
    ValueError
        If there are no such axes.
    """
    return transform(_rotation(ai, aj, ak, axes).as_matrix())


def euler_from_matrix(matrix: ArrayLike, axes: Axes = "sxyz") -> tuple[float, float, float]:
    """The Euler angles of a rotation.

    Where the middle angle brings the first and the last axis together, only their sum or difference is determined: the
    last of static axes, the first of rotating ones gets 0.

    Parameters
    ----------
    matrix
        Shape (4, 4) or (3, 3); its scale does not matter.
    axes
        Such as 'sxyz' or (0, 0, 0, 0), see the package.

    Returns
    -------
    ai, aj, ak : float
        In the order of the axes, rad. The middle one is in [-π/2, π/2] for three different axes; else in [0, π] for
        parity 0 and in [-π, 0] for parity 1. The others are in [-π, π].

    Raises
    ------
    ValueError
        If there are no such axes.
    """
    first, parity, repetition, frame = _numbers(axes)
    x, y, z = _static_axes(first, parity, 0)
    m = matrix3(matrix)[np.ix_([x, y, z], [x, y, z])]  # as if the axes were x y z, or x y x
    inner, side, end = (m[0, 1], m[0, 2], m[0, 0]) if repetition else (m[2, 1], m[2, 2], -m[2, 0])
    size = math.hypot(inner, side)
    b = math.atan2(size, end) if repetition else math.atan2(end, size)
    if size <= 1e-12 * abs(end):
        a, c = math.atan2(-m[1, 2], m[1, 1]), 0.0
    else:
        a = math.atan2(inner, side)
        rest = m[:, 1] * math.cos(a) - m[:, 2] * math.sin(a)  # the middle column once the first rotation is undone
        c = math.atan2(rest[2] if repetition else -rest[0], rest[1])
    if parity:  # the order x z y is left-handed
        a, b, c = -a, -b, -c
    return (c, b, a) if frame else (a, b, c)


def euler_from_quaternion(quaternion: ArrayLike, axes: Axes = "sxyz") -> tuple[float, float, float]:
    """The Euler angles of a quaternion [w, x, y, z], rad; see euler_from_matrix()."""
    return euler_from_matrix(quaternion_matrix(quaternion), axes)


def quaternion_from_euler(ai: float, aj: float, ak: float, axes: Axes = "sxyz") -> Array:
    """The quaternion [w, x, y, z] of Euler angles, shape (4,); see euler_matrix()."""
    return from_scipy(_rotation(ai, aj, ak, axes))


def _rotation(ai: float, aj: float, ak: float, axes: Axes) -> Rotation:
    name = _name(*_numbers(axes))
    letters = name[1:].upper() if name[0] == "r" else name[1:]  # SciPy's capitals are rotating axes
    return Rotation.from_euler(letters, [ai, aj, ak])


def _numbers(axes: Axes) -> tuple[int, int, int, int]:
    if isinstance(axes, str):
        numbers = _NUMBERS.get(axes.lower())
    else:
        numbers = next((known for known in _NUMBERS.values() if known == tuple(axes)), None)
    if numbers is None:
        raise ValueError(f"no Euler axes {axes!r}; there are {', '.join(sorted(_NUMBERS))} or four numbers")
    return numbers
