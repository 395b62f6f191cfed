"""Degrees of freedom."""

from __future__ import annotations

from typing import TYPE_CHECKING

from pydart2.multibody.part import Part

if TYPE_CHECKING:
    from pydart2._native import DofHandle
    from pydart2.joint import Joint
    from pydart2.skeleton import Skeleton


class Dof(Part):
    """One degree of freedom of a skeleton: rad, rad/s, N m for a rotation; m, m/s, N for a translation.

    Attributes
    ----------
    skeleton : Skeleton
    id : int
        Index in the skeleton.
    name : str
    joint : Joint
    """

    _LIST = "dofs"

    joint: Joint
    _handle: DofHandle

    def __init__(self, _skeleton: Skeleton, _id: int) -> None:
        self.skeleton = _skeleton
        self._id = _id
        self._handle = _skeleton._handle.dof(_id)
        self.name = self._handle.name()

    @property
    def index(self) -> int:
        """Index in the skeleton."""
        return self._id

    def index_in_skeleton(self) -> int:
        """Index in the skeleton, that is, in q."""
        return self._handle.index_in_skeleton()

    def index_in_tree(self) -> int:
        """Index in its tree; a skeleton may have several."""
        return self._handle.index_in_tree()

    def index_in_joint(self) -> int:
        """Index in its joint."""
        return self._handle.index_in_joint()

    def tree_index(self) -> int:
        """Index of its tree."""
        return self._handle.tree_index()

    def position(self) -> float:
        """Position, rad or m."""
        return self._handle.position()

    def set_position(self, position: float) -> None:
        """Set the position, rad or m."""
        self._handle.set_position(position)

    def initial_position(self) -> float:
        """Position that World.reset() returns to, rad or m."""
        return self._handle.initial_position()

    def set_initial_position(self, _initial: float) -> None:
        """Set the position that World.reset() returns to, rad or m."""
        self._handle.set_initial_position(_initial)

    def has_position_limit(self) -> bool:
        """Whether either limit is finite."""
        return self._handle.has_position_limit()

    def position_lower_limit(self) -> float:
        """Lower limit of the position, rad or m; -inf for none."""
        return self._handle.position_lower_limit()

    def set_position_lower_limit(self, limit: float) -> None:
        """Set the lower limit of the position, rad or m. It acts once the joint enforces its limits."""
        self._handle.set_position_lower_limit(limit)

    def position_upper_limit(self) -> float:
        """Upper limit of the position, rad or m; inf for none."""
        return self._handle.position_upper_limit()

    def set_position_upper_limit(self, limit: float) -> None:
        """Set the upper limit of the position, rad or m. It acts once the joint enforces its limits."""
        self._handle.set_position_upper_limit(limit)

    def velocity(self) -> float:
        """Velocity, rad/s or m/s."""
        return self._handle.velocity()

    def set_velocity(self, velocity: float) -> None:
        """Set the velocity, rad/s or m/s."""
        self._handle.set_velocity(velocity)

    def initial_velocity(self) -> float:
        """Velocity that World.reset() returns to, rad/s or m/s."""
        return self._handle.initial_velocity()

    def set_initial_velocity(self, _initial: float) -> None:
        """Set the velocity that World.reset() returns to, rad/s or m/s."""
        self._handle.set_initial_velocity(_initial)

    def velocity_lower_limit(self) -> float:
        """Lower limit of the velocity, rad/s or m/s; -inf for none."""
        return self._handle.velocity_lower_limit()

    def set_velocity_lower_limit(self, limit: float) -> None:
        """Set the lower limit of the velocity, rad/s or m/s."""
        self._handle.set_velocity_lower_limit(limit)

    def velocity_upper_limit(self) -> float:
        """Upper limit of the velocity, rad/s or m/s; inf for none."""
        return self._handle.velocity_upper_limit()

    def set_velocity_upper_limit(self, limit: float) -> None:
        """Set the upper limit of the velocity, rad/s or m/s."""
        self._handle.set_velocity_upper_limit(limit)

    def acceleration(self) -> float:
        """Acceleration of the last forward dynamics, rad/s² or m/s²."""
        return self._handle.acceleration()

    def set_acceleration(self, acceleration: float) -> None:
        """Set the acceleration, rad/s² or m/s²."""
        self._handle.set_acceleration(acceleration)

    def force(self) -> float:
        """Generalized force, N m or N."""
        return self._handle.force()

    def set_force(self, force: float) -> None:
        """Set the generalized force for the next step, N m or N."""
        self._handle.set_force(force)

    def force_lower_limit(self) -> float:
        """Lower limit of the generalized force, N m or N; -inf for none."""
        return self._handle.force_lower_limit()

    def set_force_lower_limit(self, limit: float) -> None:
        """Set the lower limit of the generalized force, N m or N."""
        self._handle.set_force_lower_limit(limit)

    def force_upper_limit(self) -> float:
        """Upper limit of the generalized force, N m or N; inf for none."""
        return self._handle.force_upper_limit()

    def set_force_upper_limit(self, limit: float) -> None:
        """Set the upper limit of the generalized force, N m or N."""
        self._handle.set_force_upper_limit(limit)

    def command(self) -> float:
        """Command to the actuator, in the unit of the joint's actuator type."""
        return self._handle.command()

    def set_command(self, command: float) -> None:
        """Set the command to the actuator for the next step: a force, velocity or acceleration by actuator type."""
        self._handle.set_command(command)

    def spring_stiffness(self) -> float:
        """Stiffness of the joint's spring, N m/rad or N/m."""
        return self._handle.spring_stiffness()

    def set_spring_stiffness(self, _k: float) -> None:
        """Set the stiffness of the joint's spring, N m/rad or N/m, >= 0."""
        self._handle.set_spring_stiffness(_k)

    def rest_position(self) -> float:
        """Position at which the spring exerts no force, rad or m."""
        return self._handle.rest_position()

    def set_rest_position(self, _q0: float) -> None:
        """Set the position at which the spring exerts no force, rad or m."""
        self._handle.set_rest_position(_q0)

    def damping_coefficient(self) -> float:
        """Viscous damping, N m s/rad or N s/m."""
        return self._handle.damping_coefficient()

    def set_damping_coefficient(self, _coeff: float) -> None:
        """Set the viscous damping, N m s/rad or N s/m, >= 0."""
        self._handle.set_damping_coefficient(_coeff)

    def armature(self) -> float:
        """Inertia of what turns with the joint only, as a motor's rotor, kg m² or kg."""
        return self._handle.armature()

    def set_armature(self, inertia: float) -> None:
        """Set the inertia of what turns with the joint only, kg m² or kg, >= 0.

        It is added to the diagonal of M, and acts in the motion and in the response to contacts and constraints.
        """
        self._handle.set_armature(inertia)

    def coulomb_friction(self) -> float:
        """Coulomb friction, N m or N."""
        return self._handle.coulomb_friction()

    def set_coulomb_friction(self, friction: float) -> None:
        """Set the Coulomb friction, N m or N, >= 0."""
        self._handle.set_coulomb_friction(friction)

    def constraint_impulse(self) -> float:
        """Impulse of the constraints in the last step, N m s or N s."""
        return self._handle.constraint_impulse()

    def set_constraint_impulse(self, _friction: float) -> None:
        """Set the constraint impulse, N m s or N s."""
        self._handle.set_constraint_impulse(_friction)

    def __repr__(self) -> str:
        return f"[Dof({self.id}): {self.name}]"
