"""What a skeleton weighs: its mass, mass matrix, centre of mass, and the forces that follow from them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pydart2.alias import Alias, forwards
from pydart2.multibody.coordinates import Coordinates


class Masses(Coordinates):
    """The part of Skeleton with its masses and forces in the present state."""

    @forwards(None)
    def mass_matrix(self, out: NDArray[np.float64] | None = None) -> NDArray[np.float64]:
        """Joint-space mass matrix, shape (ndofs, ndofs), kg m² or kg."""
        return self._handle.mass_matrix(out)

    M = Alias(mass_matrix)

    @forwards(None)
    def inv_mass_matrix(self, out: NDArray[np.float64] | None = None) -> NDArray[np.float64]:
        """Inverse of the mass matrix, shape (ndofs, ndofs), 1/(kg m²) or 1/kg."""
        return self._handle.inv_mass_matrix(out)

    invM = Alias(inv_mass_matrix)  # noqa: N815 (the original's)

    Minv = Alias(inv_mass_matrix)

    @forwards(None)
    def coriolis_and_gravity_forces(self, out: NDArray[np.float64] | None = None) -> NDArray[np.float64]:
        """Coriolis, centrifugal and gravity forces, shape (ndofs,), N m or N."""
        return self._handle.coriolis_and_gravity_forces(out)

    c = Alias(coriolis_and_gravity_forces)

    def constraint_forces(self, out: NDArray[np.float64] | None = None) -> NDArray[np.float64]:
        """Generalized forces of contacts, limits and constraints in the last step, shape (ndofs,), N m or N."""
        return self._handle.constraint_forces(out)

    # Centre of mass

    @forwards()
    def mass(self) -> float:
        """Total mass, kg."""
        return self._handle.mass()

    m = Alias(mass)

    @forwards(None)
    def com(self, out: NDArray[np.float64] | None = None) -> NDArray[np.float64]:
        """Centre of mass, world frame, shape (3,), m."""
        return self._handle.com(out)

    C = Alias(com)

    @forwards()
    def com_velocity(self) -> NDArray[np.float64]:
        """Velocity of the centre of mass, world frame, shape (3,), m/s."""
        return self._handle.com_velocity()

    dC = Alias(com_velocity)  # noqa: N815

    @forwards()
    def com_acceleration(self) -> NDArray[np.float64]:
        """Acceleration of the centre of mass, world frame, shape (3,), m/s²."""
        return self._handle.com_acceleration()

    ddC = Alias(com_acceleration)  # noqa: N815

    def com_spatial_velocity(self) -> NDArray[np.float64]:
        """Angular (rad/s) and linear (m/s) velocity of the centre of mass, world frame, shape (6,)."""
        return self._handle.com_spatial_velocity()

    def linear_momentum(self) -> NDArray[np.float64]:
        """Linear momentum, world frame, shape (3,), kg m/s."""
        return self.m * self.dC

    P = Alias(linear_momentum)
