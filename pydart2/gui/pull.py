"""Pulling a body by a spring."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pydart2.bodynode import BodyNode

Array = NDArray[np.float64]

#: Stiffness per kg of the skeleton, N/(m kg): one that hangs from the spring stretches it by g / 40, about 25 cm.
STIFFNESS = 40.0


class Pull:
    """A spring with a damper from a point of a body to a point of the world.

    Its stiffness suits the whole skeleton's mass, but never more than what a step of `dt` can integrate at the point
    where it pulls; in the lightest direction there it moves the effective mass 1 / λmax(J M⁻¹ Jᵀ) (Khatib 1987).

    Attributes
    ----------
    body : BodyNode
    offset : (3,)
        Where it pulls, in the body's frame, m.
    target : (3,)
        Where it pulls to, in the world, m.
    stiffness, damping : float
        N/m, N s/m; 0 for a body that cannot move.
    """

    def __init__(self, body: BodyNode, point: ArrayLike) -> None:
        self.body = body
        self.offset: Array = body.to_local(point)
        self.target: Array = np.array(point, dtype=float)
        effective, dt = self._effective_mass(), body.world.dt
        total = body.skel.m
        self.stiffness = min(STIFFNESS * total, 0.05 * effective / dt**2)
        self.damping = min(2.0 * np.sqrt(self.stiffness * total), 0.2 * effective / dt)

    def _effective_mass(self) -> float:
        skel = self.body.skel
        if not skel.is_mobile() or not skel.ndofs:
            return 0.0
        jacobian = self.body.linear_jacobian(self.offset)
        mobility = float(np.linalg.eigvalsh(jacobian @ np.linalg.lstsq(skel.M, jacobian.T, rcond=None)[0])[-1])
        return 1.0 / mobility if mobility > 1e-12 else 0.0

    @property
    def point(self) -> Array:
        """Where it pulls, in the world, shape (3,), m."""
        return self.body.to_world(self.offset)

    @property
    def force(self) -> Array:
        """On the body, shape (3,), N."""
        velocity = self.body.world_linear_velocity(self.offset)
        return np.asarray(self.stiffness * (self.target - self.point) - self.damping * velocity)

    def apply(self) -> None:
        """Pull in the next step."""
        force = self.force
        if np.isfinite(force).all():
            self.body.add_ext_force(force, self.offset)
