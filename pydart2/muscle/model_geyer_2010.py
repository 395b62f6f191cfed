"""Curves of the muscle model of H. Geyer and H. Herr (2010).

A muscle-reflex model that encodes principles of legged mechanics produces human walking dynamics and muscle activities,
IEEE Transactions on Neural Systems and Rehabilitation Engineering 18(3), 263–273. All quantities have no dimension:
forces are in units of the maximum isometric force, lengths in units of the optimal or slack length.
"""

from __future__ import annotations

import math


def fn_inv_f_vce0(f_vce0: float, K: float, N: float) -> float:
    """Velocity of the contractile element at which the force–velocity curve has a value.

    With velocity v in units of the maximum shortening speed, v < 0 for shortening, the curve is ::

        (1 + v) / (1 - K v)                          v < 0
        N + (N - 1) (v - 1) / (7.56 K v + 1)         v >= 0

    Parameters
    ----------
    f_vce0
        Value of the curve, >= 0.
    K
        Curvature.
    N
        Value at v = 1. The curve has a pole little above; for all values from N on the result is 1.

    Returns
    -------
    float
        v in [-1, 1].
    """
    if f_vce0 < 1.0:
        return (f_vce0 - 1.0) / (K * f_vce0 + 1.0)
    if f_vce0 < N:
        return (f_vce0 - 1.0) / (N - 1.0 + 7.56 * K * (N - f_vce0))
    return 1.0


def fn_f_lce0(l_ce0: float, w: float, c: float) -> float:
    """Force–length curve, ``exp(c |(l - 1) / w|³)``.

    Parameters
    ----------
    l_ce0
        Length in units of the optimal length.
    w
        Half width of the bell.
    c
        Logarithm of the value at l = 1 - w and 1 + w.
    """
    return math.exp(c * abs((l_ce0 - 1.0) / w) ** 3)


def fn_f_p0(l0: float, e_ref: float) -> float:
    """Force of an elasticity that resists stretch, ``((l - 1) / e_ref)²`` for l > 1, else 0.

    Parameters
    ----------
    l0
        Length in units of the length at rest.
    e_ref
        Strain at which the force is 1.
    """
    return ((l0 - 1.0) / e_ref) ** 2 if l0 > 1.0 else 0.0


def fn_f_p0_ext(l0: float, e_ref: float, e_ref2: float) -> float:
    """Force of an elasticity that resists compression, ``((e_ref2 - l) / e_ref)²`` for l < e_ref2, else 0.

    Parameters
    ----------
    l0
        Length in units of the optimal length.
    e_ref
        Compression below `e_ref2` at which the force is 1.
    e_ref2
        Length at rest.
    """
    return ((e_ref2 - l0) / e_ref) ** 2 if l0 < e_ref2 else 0.0
