"""Pulling a body by a spring."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pydart2.bodynode import BodyNode

Array = NDArray[np.float64]

#: Stiffness per kg of the skeleton, N/(m kg): one that hangs from the spring stretches it by g / 40, about 25 cm.
STIFFNESS = 40.0
#: The most that a pull accelerates the point where it pulls, m/s²; a light hand would spin an arm until it blows up.
MAX_ACCELERATION = 50.0


class Pull:
    """A spring with a damper from a point of a body to a point of the world.

    It suits the whole skeleton's mass. What that would do to the lighter mass that the point has in some direction in
    the present pose, an eigenvalue of the inertia (J M⁻¹ Jᵀ)⁻¹ (Khatib 1987), is limited: to what a time step can
    integrate, and to `MAX_ACCELERATION`.

    Attributes
    ----------
    body : BodyNode
    offset : (3,)
        Where it pulls, in the body's frame, m.
    target : (3,)
        Where it pulls to, in the world, m.
    stiffness, damping : float
        N/m, N s/m, where nothing limits them.
    """

    def __init__(self, body: BodyNode, point: ArrayLike) -> None:
        self.body = body
        self.offset: Array = body.to_local(point)
        self.target: Array = np.array(point, dtype=float)
        self.stiffness = STIFFNESS * body.skel.m
        self.damping = 2.0 * np.sqrt(STIFFNESS) * body.skel.m

    @property
    def point(self) -> Array:
        """Where it pulls, in the world, shape (3,), m."""
        return self.body.to_world(self.offset)

    @property
    def force(self) -> Array:
        """On the body, shape (3,), N; none along an axis where it cannot move."""
        mobility, axes = self._mobility()
        moves = mobility > 1e-12
        mass = 1.0 / mobility[moves]
        dt = self.body.world.dt
        stiffness = np.minimum(self.stiffness, 0.05 * mass / dt**2)
        damping = np.minimum(self.damping, 0.2 * mass / dt)
        axes = axes[:, moves]
        stretch, velocity = (self.target - self.point) @ axes, self.body.world_linear_velocity(self.offset) @ axes
        limit = MAX_ACCELERATION * mass
        return np.asarray(axes @ np.clip(stiffness * stretch - damping * velocity, -limit, limit))

    def _mobility(self) -> tuple[Array, Array]:
        """Along which axes, the columns, a force on the point accelerates it how much, 1/kg."""
        skel = self.body.skel
        if not skel.is_mobile() or not skel.ndofs or not skel.m:
            return np.zeros(3), np.eye(3)
        jacobian = self.body.linear_jacobian(self.offset)
        mass_matrix = skel.M + 1e-12 * skel.m * np.eye(skel.ndofs)  # a root may have no mass
        mobility, axes = np.linalg.eigh(jacobian @ np.linalg.solve(mass_matrix, jacobian.T))
        return mobility, axes

    def apply(self) -> None:
        """Pull in the next step."""
        force = self.force
        if np.isfinite(force).all():
            self.body.add_ext_force(force, self.offset)
