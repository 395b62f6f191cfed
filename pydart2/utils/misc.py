"""Small numeric helpers."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray


def S(x: Any, precision: int = 6) -> str:  # noqa: N802 (the original's)
    """A number, None or a (nested) sequence of them as text, with `precision` digits after the point.

    >>> S([1, 0.5], 2)
    '[1.00, 0.50]'
    """
    if x is None or isinstance(x, str):
        return str(x)
    if isinstance(x, np.ndarray):
        x = x.tolist()  # a 0-d array calls itself iterable
    if isinstance(x, Iterable):
        return "[" + ", ".join(S(item, precision) for item in x) + "]"
    return f"{float(x):.{precision}f}"


def split_by_sizes(array: ArrayLike, sizes: Iterable[int]) -> list[NDArray[Any]]:
    """Cut an array along its first axis into consecutive pieces.

    Parameters
    ----------
    array
        Shape (n, ...), in any unit.
    sizes
        Length of each piece; their sum is n.

    Raises
    ------
    ValueError
        If a size is negative or the sum is not n.
    """
    whole, lengths = np.asarray(array), [int(size) for size in sizes]
    if any(length < 0 for length in lengths) or sum(lengths) != len(whole):
        raise ValueError(f"pieces of sizes {lengths} do not make up an array of length {len(whole)}")
    ends = np.cumsum(lengths, dtype=int)
    return [whole[end - length : end] for end, length in zip(ends, lengths)]


def norm2(x: ArrayLike) -> float:
    """Square of the Euclidean norm of all entries of an array of any shape, in the square of its unit."""
    flat = np.asarray(x, dtype=float).ravel()
    return float(flat @ flat)


def penalize(x: ArrayLike, lo: ArrayLike, hi: ArrayLike) -> Any:
    """Distance of x from the interval [lo, hi]: 0 inside; a float, or an array elementwise, in the unit of x."""
    return _plain(np.maximum(0.0, np.maximum(np.subtract(lo, x), np.subtract(x, hi))))


def confine(x: ArrayLike, lo: ArrayLike, hi: ArrayLike) -> Any:
    """The value of [lo, hi] nearest to x, in its unit: a float, or an array elementwise."""
    return _plain(np.minimum(np.maximum(x, lo), hi))


def _plain(x: Any) -> Any:
    return x if np.ndim(x) else float(x)


def vel(h: float, x0: ArrayLike | None, x1: ArrayLike, x2: ArrayLike | None) -> Any:
    """Velocity at the middle one of three samples: a float, or an array of their shape.

    Parameters
    ----------
    h
        Time between samples, s.
    x0, x1, x2
        Samples of one shape. Without an end (None) the difference is one-sided, without both the result is zero.
    """
    intervals = (x0 is not None) + (x2 is not None)
    first, last = x1 if x0 is None else x0, x1 if x2 is None else x2
    return _plain(np.subtract(last, first) / (max(intervals, 1) * h))


def acc(h: float, x0: ArrayLike | None, x1: ArrayLike, x2: ArrayLike | None) -> Any:
    """Acceleration at the middle one of three samples: a float, or an array of their shape.

    Parameters
    ----------
    h
        Time between samples, s.
    x0, x1, x2
        Samples of one shape. Without one of the ends (None) the result is zero: two samples make a line.
    """
    if x0 is None or x2 is None:
        return _plain(np.zeros(np.shape(x1)))
    return _plain((np.subtract(x2, x1) - np.subtract(x1, x0)) / h**2)


def grad(fun: Callable[[NDArray[np.float64]], float], x: ArrayLike, h: float) -> NDArray[np.float64]:
    """Gradient of a scalar function by central differences, error O(h²).

    Parameters
    ----------
    fun
        Function of an array of shape (n,).
    x
        Where, shape (n,), in any unit.
    h
        Distance from x of the points at which `fun` is called, 2 for each entry.

    Returns
    -------
    ndarray
        Shape (n,).
    """
    return _difference(fun, x, h, ((1.0, 0.5),))


def grad4(fun: Callable[[NDArray[np.float64]], float], x: ArrayLike, h: float) -> NDArray[np.float64]:
    """Like grad() with 4 points for each entry, at distances h and 2 h: error O(h⁴)."""
    return _difference(fun, x, h, ((1.0, 2.0 / 3.0), (2.0, -1.0 / 12.0)))


def _difference(
    fun: Callable[[NDArray[np.float64]], float],
    x: ArrayLike,
    h: float,
    stencil: tuple[tuple[float, float], ...],
) -> NDArray[np.float64]:
    """The sum of weight * (fun(x + step h e) - fun(x - step h e)) / h for each axis e."""
    at = np.array(x, dtype=float)
    gradient = np.zeros(at.shape)
    for i in range(at.size):
        for step, weight in stencil:
            forth, back = at.copy(), at.copy()
            forth[i] += step * h
            back[i] -= step * h
            gradient[i] += weight * (fun(forth) - fun(back)) / h
    return gradient


def deg2rad(x: ArrayLike) -> Any:
    """Degrees to rad: a float, or an array elementwise."""
    return _plain(np.deg2rad(x))


def rad2deg(x: ArrayLike) -> Any:
    """Angles in rad to degrees: a float, or an array elementwise."""
    return _plain(np.rad2deg(x))
