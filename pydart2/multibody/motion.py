"""Where a body is and how it moves: poses, velocities, accelerations, momentum, Jacobians."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pydart2.alias import Alias, also, forwards
from pydart2.frames import Frame
from pydart2.given import numbers
from pydart2.multibody.part import Part

if TYPE_CHECKING:
    from pydart2._native import BodyNodeHandle
    from pydart2.dof import Dof


class Motion(Frame, Part):
    """The part of BodyNode that knows where it is and how it moves."""

    dependent_dofs: list[Dof]
    _handle: BodyNodeHandle

    @forwards(None)
    def transform(self, out: NDArray[np.float64] | None = None) -> NDArray[np.float64]:
        """Pose of the body frame in the world, shape (4, 4), m."""
        return self._handle.transform(out)

    world_transform = also(transform)

    T = Alias(transform)

    def relative_transform(self) -> NDArray[np.float64]:
        """Pose of the body frame in the parent body, shape (4, 4), m."""
        return self._handle.relative_transform()

    def to_world(self, x: ArrayLike | None = None) -> NDArray[np.float64]:
        """Where the point `x` of the body frame is in the world, shape (3,), m."""
        return self._handle.to_world(x)

    def to_local(self, x: ArrayLike) -> NDArray[np.float64]:
        """Where the point `x` of the world is in the body frame, shape (3,), m."""
        return self._handle.to_local(x)

    # Centre of mass

    @forwards()
    def com(self) -> NDArray[np.float64]:
        """Centre of mass in the world, shape (3,), m."""
        return self._handle.com()

    C = Alias(com)

    @forwards()
    def com_linear_velocity(self) -> NDArray[np.float64]:
        """Velocity of the centre of mass, world frame, shape (3,), m/s."""
        return self._handle.com_linear_velocity()

    dC = Alias(com_linear_velocity)  # noqa: N815 (the original's)

    def com_linear_acceleration(self) -> NDArray[np.float64]:
        """Acceleration of the centre of mass, world frame, shape (3,), m/s²."""
        return self._handle.com_linear_acceleration()

    def com_spatial_velocity(self) -> NDArray[np.float64]:
        """Angular (rad/s) and linear (m/s) velocity of the centre of mass, body coordinates, shape (6,)."""
        return self._handle.com_spatial_velocity()

    def com_spatial_acceleration(self) -> NDArray[np.float64]:
        """Angular (rad/s²) and linear (m/s²) acceleration of the centre of mass, body coordinates, shape (6,)."""
        return self._handle.com_spatial_acceleration()

    # Velocities and accelerations

    def world_linear_velocity(self, offset: ArrayLike | None = None) -> NDArray[np.float64]:
        """Velocity of a point, world frame, shape (3,), m/s."""
        return self._handle.linear_velocity(offset)

    def world_angular_velocity(self) -> NDArray[np.float64]:
        """Angular velocity, world frame, shape (3,), rad/s."""
        return self._handle.angular_velocity()

    def world_spatial_velocity(self, offset: ArrayLike | None = None) -> NDArray[np.float64]:
        """Angular (rad/s) and linear (m/s) velocity of a point, world frame, shape (6,)."""
        return self._handle.spatial_velocity(offset)

    def world_linear_acceleration(self, offset: ArrayLike | None = None) -> NDArray[np.float64]:
        """Acceleration of a point, world frame, shape (3,), m/s²."""
        return self._handle.linear_acceleration(offset)

    def world_angular_acceleration(self) -> NDArray[np.float64]:
        """Angular acceleration, world frame, shape (3,), rad/s²."""
        return self._handle.angular_acceleration()

    def world_spatial_acceleration(self, offset: ArrayLike | None = None) -> NDArray[np.float64]:
        """Spatial acceleration (Featherstone's) of a point, world frame, angular then linear, shape (6,).

        Its linear part lacks the term ``angular velocity × velocity`` of world_linear_acceleration().
        """
        return self._handle.spatial_acceleration(offset)

    def linear_momentum(self) -> NDArray[np.float64]:
        """Linear momentum as the engine gives it, body coordinates, shape (3,), kg m/s."""
        return self._handle.linear_momentum()

    def angular_momentum(self) -> NDArray[np.float64]:
        """Angular momentum about the body's origin as the engine gives it, body coordinates, shape (3,), kg m²/s."""
        return self._handle.angular_momentum()

    # Jacobians

    def jacobian(
        self, offset: ArrayLike | None = None, full: bool = True, out: NDArray[np.float64] | None = None
    ) -> NDArray[np.float64]:
        """Jacobian of a point in body coordinates, shape (6, n), dimensionless rows and then m/rad."""
        return self._handle.jacobian(offset, full, out)

    def world_jacobian(
        self, offset: ArrayLike | None = None, full: bool = True, out: NDArray[np.float64] | None = None
    ) -> NDArray[np.float64]:
        """Jacobian of a point in world coordinates, shape (6, n), dimensionless rows and then m/rad."""
        return self._handle.world_jacobian(offset, full, out)

    @forwards(None, True, None)
    def linear_jacobian(
        self, offset: ArrayLike | None = None, full: bool = True, out: NDArray[np.float64] | None = None
    ) -> NDArray[np.float64]:
        """Linear Jacobian of a point in world coordinates, shape (3, n): ``J @ dq`` is its velocity in m/s."""
        return self._handle.linear_jacobian(offset, full, out)

    J = Alias(linear_jacobian)

    def angular_jacobian(self, full: bool = True, out: NDArray[np.float64] | None = None) -> NDArray[np.float64]:
        """Angular Jacobian in world coordinates, shape (3, n): times dq it is the angular velocity in rad/s."""
        return self._handle.angular_jacobian(full, out)

    @forwards(None, True, None)
    def linear_jacobian_deriv(
        self, offset: ArrayLike | None = None, full: bool = True, out: NDArray[np.float64] | None = None
    ) -> NDArray[np.float64]:
        """Time derivative of linear_jacobian(), shape (3, n)."""
        return self._handle.linear_jacobian_deriv(offset, full, out)

    dJ = Alias(linear_jacobian_deriv)  # noqa: N815 (the original's)

    def world_jacobian_classic_deriv(
        self, offset: ArrayLike | None = None, full: bool = True, out: NDArray[np.float64] | None = None
    ) -> NDArray[np.float64]:
        """Time derivative of world_jacobian(), shape (6, n): times dq, what ``J ddq`` lacks of the acceleration."""
        return self._handle.world_jacobian_classic_deriv(offset, full, out)

    def angular_jacobian_deriv(self, full: bool = True, out: NDArray[np.float64] | None = None) -> NDArray[np.float64]:
        """Time derivative of angular_jacobian(), shape (3, n)."""
        return self._handle.angular_jacobian_deriv(full, out)

    def expand_jacobian(self, jacobian: ArrayLike) -> NDArray[np.float64]:
        """A Jacobian over the dependent dofs, shape (r, n), with zeros for the others, shape (r, ndofs); units stay."""
        dependent = numbers(jacobian, "a Jacobian")
        if dependent.ndim != 2 or dependent.shape[1] != len(self.dependent_dofs):
            raise ValueError(f"a Jacobian needs shape (r, {len(self.dependent_dofs)}), got {dependent.shape}")
        full = np.zeros((dependent.shape[0], self.skeleton.ndofs))
        full[:, [dof.id for dof in self.dependent_dofs]] = dependent
        return full
