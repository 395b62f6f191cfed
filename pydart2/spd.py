"""Stable PD control: Tan, Liu, Turk, "Stable Proportional-Derivative Controllers", IEEE CG&A 31(4), 2011."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pydart2.given import numbers

if TYPE_CHECKING:
    from pydart2.skeleton import Skeleton


def forces(
    skel: Skeleton,
    h: float,
    Kp: ArrayLike,
    Kd: ArrayLike,
    q_des: ArrayLike,
    dq_des: ArrayLike = 0.0,
    ddq_des: ArrayLike = 0.0,
    external: ArrayLike | None = None,
) -> NDArray[np.float64]:
    """Generalized forces that follow a trajectory, stable for high gains, shape (ndofs,), N m or N.

    ``tau = -Kp (q + h dq - q_des) - Kd (dq + h ddq - dq_des - h ddq_des)`` with the acceleration that follows from it,
    ``(M + h Kd) ddq = -c - Kp (q + h dq - q_des) - Kd (dq - dq_des - h ddq_des) + external``.

    Parameters
    ----------
    skel
        The skeleton that the forces are for.
    h
        Time step, s.
    Kp, Kd
        Gains, numbers or of shape (ndofs,): N m/rad and N m s/rad, or N/m and N s/m.
    q_des, dq_des, ddq_des
        The trajectory at the end of the step, numbers or of shape (ndofs,).
    external
        Generalized forces that act besides, shape (ndofs,); default: the constraint forces of the last step.
    """
    given = (Kp, Kd, dq_des, ddq_des)
    stiffness, damping, velocity, acceleration = (numbers(x, "gains and desired rates") for x in given)
    damping = np.broadcast_to(damping, (skel.ndofs,))
    dq = np.asarray(skel.dq)
    p = -stiffness * skel.position_differences(skel.q + h * dq, q_des)
    d = -damping * (dq - velocity - h * acceleration)
    acting = skel.constraint_forces() if external is None else numbers(external, "external")
    ddq = np.linalg.solve(skel.M + h * np.diag(damping), -skel.c + p + d + acting)
    return np.asarray(p + d - damping * h * ddq)
