"""The terms of a skeleton's equation of motion, by name."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pydart2.given import numbers
from pydart2.multibody.masses import Masses

if TYPE_CHECKING:
    from pydart2.bodynode import BodyNode

Array = NDArray[np.float64]


class InverseDynamicsDerivatives(NamedTuple):
    """How the forces of inverse dynamics change; each of shape (ndofs, ndofs), row: force, column: what changes it."""

    q: Array  #: N m or N per rad or m
    dq: Array  #: N m or N per rad/s or m/s
    ddq: Array  #: M, kg m² or kg


class ForwardDynamicsDerivatives(NamedTuple):
    """How the accelerations of forward dynamics change; each of shape (ndofs, ndofs), row: acceleration."""

    q: Array  #: rad/s² or m/s² per rad or m
    dq: Array  #: 1/s
    tau: Array  #: Minv, 1/(kg m²) or 1/kg


class Dynamics(Masses):
    """What a Skeleton knows of ``M ddq + c = tau + external + damping + springs + constraints``.

    The forces are those of the present q and dq, with the sign that they have in this equation.
    """

    def aug_mass_matrix(self) -> Array:
        """``M + dt D + dt² K`` of the step's implicit damping and springs, shape (ndofs, ndofs), kg m² or kg."""
        return self._handle.dynamics().aug_mass_matrix()

    def coriolis_forces(self) -> Array:
        """Coriolis and centrifugal part of c, shape (ndofs,), N m or N."""
        return self._handle.coriolis_forces()

    def gravity_forces(self) -> Array:
        """Gravity's part of c: what the motors must hold at rest, shape (ndofs,), N m or N."""
        return self._handle.gravity_forces()

    def external_forces(self) -> Array:
        """What the external forces on the bodies are at the dofs, shape (ndofs,), N m or N."""
        return self._handle.external_forces()

    def damping_forces(self) -> Array:
        """``-D dq``, shape (ndofs,), N m or N."""
        return self._handle.dynamics().damping_forces()

    def spring_forces(self) -> Array:
        """``-K (q - rest)``, shape (ndofs,), N m or N."""
        return self._handle.dynamics().spring_forces()

    def inverse_dynamics(
        self, ddq: ArrayLike, external: bool = True, damping: bool = True, springs: bool = True
    ) -> Array:
        """The forces that give the accelerations `ddq` without contacts, shape (ndofs,), N m or N.

        ``tau = M ddq + c - external - damping - springs`` in the present state, which does not change.

        Parameters
        ----------
        ddq
            Generalized accelerations, shape (ndofs,), rad/s² or m/s².
        external, damping, springs
            Whether these forces help.
        """
        return self.M @ self._per_dof(ddq, "accelerations") + self.c - self._passive(external, damping, springs)

    def forward_dynamics(
        self, tau: ArrayLike, external: bool = True, damping: bool = True, springs: bool = True
    ) -> Array:
        """The accelerations that the forces `tau` give without contacts, shape (ndofs,), rad/s² or m/s².

        The opposite of inverse_dynamics(), for joints that are moved by forces. A step differs from it by what it does
        implicitly: see aug_mass_matrix().

        Parameters
        ----------
        tau
            Generalized forces, shape (ndofs,), N m or N.
        external, damping, springs
            Whether these forces act besides.
        """
        force = self._per_dof(tau, "forces") - self.c + self._passive(external, damping, springs)
        return np.asarray(np.linalg.solve(self.M, force))

    def inverse_dynamics_derivatives(self, ddq: ArrayLike) -> InverseDynamicsDerivatives:
        """Derivatives of ``M ddq + c`` in the present state, by `q`, `dq` and `ddq`, each of shape (ndofs, ndofs).

        A change of q is one along dq: where a ball or free joint moves, ``integrate_positions(q, change)``, not
        ``q + change``. Carpentier, Mansard, "Analytical derivatives of rigid body dynamics algorithms", RSS 2018.
        External forces, dampers and springs are left out: theirs are 0, D and K. ValueError if there are soft bodies.

        Parameters
        ----------
        ddq
            Generalized accelerations, shape (ndofs,), rad/s² or m/s².
        """
        both = self._handle.dynamics().inverse_dynamics_derivatives(self._per_dof(ddq, "accelerations"))
        return InverseDynamicsDerivatives(both[: self.ndofs], both[self.ndofs :], np.array(self.M))

    def forward_dynamics_derivatives(self, tau: ArrayLike) -> ForwardDynamicsDerivatives:
        """Derivatives of ``Minv (tau - c)`` in the present state, by `q`, `dq` and `tau`, each of shape (ndofs, ndofs).

        As for inverse_dynamics_derivatives(), from which they follow.

        Parameters
        ----------
        tau
            Generalized forces, shape (ndofs,), N m or N.
        """
        ddq = self.forward_dynamics(tau, external=False, damping=False, springs=False)
        by = self.inverse_dynamics_derivatives(ddq)
        inverse = np.asarray(np.linalg.inv(by.ddq))
        return ForwardDynamicsDerivatives(-inverse @ by.q, -inverse @ by.dq, inverse)

    def impulse_response(
        self, body: BodyNode | str | int, impulse: ArrayLike, offset: ArrayLike | None = None
    ) -> Array:
        """How a blow changes dq: ``Minv J.T impulse``, shape (ndofs,), rad/s or m/s. The state does not change.

        Parameters
        ----------
        body
            A body of this skeleton, its name or index.
        impulse
            Shape (3,), N s, world frame.
        offset
            Where it acts in the body frame, shape (3,), m; default: the body's origin.
        """
        blow = numbers(impulse, "an impulse")
        if blow.shape != (3,):
            raise ValueError(f"an impulse has the shape (3,), got {blow.shape}")
        return np.asarray(np.linalg.solve(self.M, self._own_body(body).linear_jacobian(offset).T @ blow))

    def com_jacobian(self) -> Array:
        """Angular and linear Jacobian of the centre of mass, world frame, shape (6, ndofs): rows of 1 and m/rad.

        Times dq it is com_spatial_velocity(), the mean of the bodies' velocities by mass.
        """
        return self._handle.dynamics().com_jacobian()

    def com_linear_jacobian(self) -> Array:
        """Jacobian of the centre of mass, world frame, shape (3, ndofs), m/rad or 1: times dq it is dC."""
        return self._handle.dynamics().com_linear_jacobian()

    def com_linear_jacobian_deriv(self) -> Array:
        """Time derivative of com_linear_jacobian(), shape (3, ndofs), m/(rad s) or 1/s."""
        return self._handle.dynamics().com_linear_jacobian_deriv()

    def centroidal_momentum_matrix(self) -> Array:
        """What makes momentum of dq, shape (6, ndofs): three rows in kg m², then three in kg m.

        Orin, Goswami, Lee, "Centroidal dynamics of a humanoid robot", Autonomous Robots 35, 2013. World axes.
        ValueError if the skeleton has soft bodies.
        """
        return self._handle.dynamics().centroidal_momentum_matrix()

    def centroidal_momentum(self) -> Array:
        """Angular momentum about the centre of mass (kg m²/s) and linear momentum (kg m/s), world axes, shape (6,)."""
        return self.centroidal_momentum_matrix() @ np.asarray(self.dq)

    def kinetic_energy(self) -> float:
        """Kinetic energy, J."""
        return self._handle.kinetic_energy()

    def potential_energy(self) -> float:
        """Energy of gravity, zero at the world's origin, and of the springs, J."""
        return self._handle.potential_energy()

    def _passive(self, external: bool, damping: bool, springs: bool) -> Array:
        """The sum of the forces that act without a motor."""
        force = np.zeros(self.ndofs)
        if external:
            force += self.external_forces()
        if damping:
            force += self.damping_forces()
        if springs:
            force += self.spring_forces()
        return force

    def _per_dof(self, values: ArrayLike, what: str) -> Array:
        vector = numbers(values, what)
        if vector.shape != (self.ndofs,):
            raise ValueError(f"{what} have the shape ({self.ndofs},), one number per dof; got {vector.shape}")
        return vector
