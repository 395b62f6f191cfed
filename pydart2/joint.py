"""Joints."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pydart2.given import numbers
from pydart2.multibody.part import Part

if TYPE_CHECKING:
    from pydart2._native import JointHandle
    from pydart2.bodynode import BodyNode
    from pydart2.dof import Dof
    from pydart2.skeleton import Skeleton

# The engine numbers its actuator types otherwise, so they cross the boundary by name.
_ACTUATORS = ("FORCE", "PASSIVE", "SERVO", "ACCELERATION", "VELOCITY", "LOCKED", "MIMIC")


class Joint(Part):
    """A joint of any type, between a body and its parent.

    Attributes
    ----------
    skeleton : Skeleton
    id : int
        Index in the skeleton.
    name : str
    parent_bodynode : BodyNode or None
        None for a joint to the world.
    child_bodynode : BodyNode
    dofs : list of Dof
    """

    _LIST = "joints"

    FORCE: ClassVar[int] = 0
    PASSIVE: ClassVar[int] = 1
    SERVO: ClassVar[int] = 2
    ACCELERATION: ClassVar[int] = 3
    VELOCITY: ClassVar[int] = 4
    LOCKED: ClassVar[int] = 5
    MIMIC: ClassVar[int] = 6

    parent_bodynode: BodyNode | None
    child_bodynode: BodyNode
    dofs: list[Dof]
    _handle: JointHandle

    def __init__(self, _skeleton: Skeleton, _id: int) -> None:
        self.skeleton = _skeleton
        self._id = _id
        self._handle = _skeleton._handle.joint(_id)
        self.name = self._handle.name()

    def build(self) -> None:
        """Link to the bodies and dofs."""
        bodies = self.skeleton.bodynodes
        parent = self._handle.parent_bodynode()
        self.parent_bodynode = bodies[parent] if parent >= 0 else None
        self.child_bodynode = bodies[self._handle.child_bodynode()]
        self.dofs = [self.skeleton.dofs[self._handle.dof(i)] for i in range(self.num_dofs())]
        for dof in self.dofs:
            dof.joint = self

    def wrench(self) -> NDArray[np.float64]:
        """Moment (N m) and force (N) through the joint on its child body in the last step, shape (6,).

        About the joint's origin, in the axes that the joint has on the child's side; along its dofs these are the
        forces of the motors, springs and dampers. What contacts, limits and constraints did in the step is in it. Zeros
        before the first step.
        """
        return self.skeleton._handle.dynamics().joint_wrench(self.id)

    def set_name(self, _name: str, _renameDofs: bool = True) -> str:
        """Rename the joint and, if asked, its dofs; returns the name it got, which differs if it was taken."""
        self._handle.set_name(_name, _renameDofs)
        self.skeleton._refresh_names()
        return self.name

    def type(self) -> str:
        """The engine's name of the type, as ``"RevoluteJoint"``."""
        return self._handle.type()

    def is_kinematic(self) -> bool:
        """Whether its motion is prescribed (ACCELERATION, VELOCITY, LOCKED)."""
        return self._handle.is_kinematic()

    def is_dynamic(self) -> bool:
        """Whether forces move it."""
        return self._handle.is_dynamic()

    def actuator_type(self) -> int:
        """One of FORCE, PASSIVE, SERVO, ACCELERATION, VELOCITY, LOCKED, MIMIC."""
        return _ACTUATORS.index(self._handle.actuator_type())

    def set_actuator_type(self, actuator_type: int) -> None:
        """Set to FORCE, PASSIVE, SERVO, ACCELERATION, VELOCITY or LOCKED; MIMIC needs set_mimic() before."""
        if actuator_type not in range(len(_ACTUATORS)):
            raise ValueError(f"no actuator type {actuator_type!r}; they are Joint.FORCE = 0 to Joint.MIMIC = 6")
        self._handle.set_actuator_type(_ACTUATORS[actuator_type])

    def set_mimic(self, joint: Joint | str | int, multiplier: float = 1.0, offset: float = 0.0) -> None:
        """Follow another joint of the skeleton, ``q = multiplier * q_other + offset``, as actuator type MIMIC.

        It is given as itself, by name or by index.
        """
        leader = joint if isinstance(joint, Joint) else self.skeleton.joint(joint)
        self._handle.set_mimic(leader._handle, multiplier, offset)

    def mimic(self) -> tuple[Joint, float, float] | None:
        """The joint that it follows by set_mimic(), the multiplier, and the offset, rad or m; None if there is none."""
        leader = self._handle.mimic_joint()
        if leader < 0:
            return None
        return self.skeleton.joints[leader], self._handle.mimic_multiplier(), self._handle.mimic_offset()

    def position_in_world_frame(self) -> NDArray[np.float64]:
        """Centre of the joint, world frame, shape (3,), m."""
        centre: NDArray[np.float64] = self._handle.world_transform_of_child_side()[:3, 3].copy()
        return centre

    def parent_body_node_id(self) -> int:
        """Id of the parent body, -1 for the world."""
        return self._handle.parent_bodynode()

    def child_body_node_id(self) -> int:
        """Id of the child body."""
        return self._handle.child_bodynode()

    def transform_from_parent_body_node(self) -> NDArray[np.float64]:
        """Pose of the joint in the parent body, shape (4, 4), m."""
        return self._handle.transform_from_parent_body_node()

    def set_transform_from_parent_body_node(self, T: ArrayLike) -> None:
        """Set the pose of the joint in the parent body, shape (4, 4), m."""
        self._handle.set_transform_from_parent_body_node(T)

    def transform_from_child_body_node(self) -> NDArray[np.float64]:
        """Pose of the joint in the child body, shape (4, 4), m."""
        return self._handle.transform_from_child_body_node()

    def set_transform_from_child_body_node(self, T: ArrayLike) -> None:
        """Set the pose of the joint in the child body, shape (4, 4), m."""
        self._handle.set_transform_from_child_body_node(T)

    def is_position_limit_enforced(self) -> bool:
        """Whether the position limits act; by default they do not."""
        return self._handle.is_position_limit_enforced()

    def set_position_limit_enforced(self, _isPositionLimitEnforced: bool = True) -> None:
        """Let the position limits act or not."""
        self._handle.set_position_limit_enforced(_isPositionLimitEnforced)

    def num_dofs(self) -> int:
        """How many dofs it has."""
        return self._handle.num_dofs()

    def has_position_limit(self, index: int) -> bool:
        """Whether either position limit of its dof `index` is finite."""
        return self._dof(index).has_position_limit()

    def position_lower_limit(self, index: int) -> float:
        """Lower limit of its dof `index`, rad or m."""
        return self._dof(index).position_lower_limit()

    def set_position_lower_limit(self, index: int, position: float) -> None:
        """Set the lower limit of its dof `index`, rad or m."""
        self._dof(index).set_position_lower_limit(position)

    def position_upper_limit(self, index: int) -> float:
        """Upper limit of its dof `index`, rad or m."""
        return self._dof(index).position_upper_limit()

    def set_position_upper_limit(self, index: int, position: float) -> None:
        """Set the upper limit of its dof `index`, rad or m."""
        self._dof(index).set_position_upper_limit(position)

    def spring_stiffness(self, index: int) -> float:
        """Spring stiffness of its dof `index`, N m/rad or N/m."""
        return self._dof(index).spring_stiffness()

    def set_spring_stiffness(self, _index: int, _k: float) -> None:
        """Set the spring stiffness of its dof `_index`, N m/rad or N/m, >= 0."""
        self._dof(_index).set_spring_stiffness(_k)

    def rest_position(self, index: int) -> float:
        """Rest position of the spring of its dof `index`, rad or m."""
        return self._dof(index).rest_position()

    def set_rest_position(self, _index: int, _q0: float) -> None:
        """Set the rest position of the spring of its dof `_index`, rad or m."""
        self._dof(_index).set_rest_position(_q0)

    def damping_coefficient(self, index: int) -> float:
        """Viscous damping of its dof `index`, N m s/rad or N s/m."""
        return self._dof(index).damping_coefficient()

    def set_damping_coefficient(self, _index: int, _coeff: float) -> None:
        """Set the viscous damping of its dof `_index`, N m s/rad or N s/m, >= 0."""
        self._dof(_index).set_damping_coefficient(_coeff)

    def coulomb_friction(self, index: int) -> float:
        """Coulomb friction of its dof `index`, N m or N."""
        return self._dof(index).coulomb_friction()

    def set_coulomb_friction(self, index: int, friction: float) -> None:
        """Set the Coulomb friction of its dof `index`, N m or N, >= 0."""
        self._dof(index).set_coulomb_friction(friction)

    def command(self, index: int) -> float:
        """Command to its dof `index`, in the unit of the actuator type."""
        return self._dof(index).command()

    def set_command(self, index: int, command: float) -> None:
        """Set the command to its dof `index` for the next step."""
        self._dof(index).set_command(command)

    def get_local_transform(self) -> NDArray[np.float64]:
        """Pose of the child body in the parent body, shape (4, 4), m."""
        return self._handle.relative_transform()

    def get_world_frame_before_transform(self) -> NDArray[np.float64]:
        """The joint's frame on the parent's side, before its motion, in the world, shape (4, 4), m."""
        return self._handle.world_transform_of_parent_side()

    def get_world_frame_after_transform(self) -> NDArray[np.float64]:
        """The joint's frame on the child's side, after its motion, in the world, shape (4, 4), m."""
        return self._handle.world_transform_of_child_side()

    def orientation_in_world_frame(self) -> NDArray[np.float64]:
        """Axes of the joint's frame on the child's side, in the world, shape (3, 3)."""
        return self._handle.world_transform_of_child_side()[:3, :3].copy()

    def _dof(self, index: int) -> Dof:
        if not isinstance(index, (int, np.integer)):
            raise TypeError(f"a dof of a joint is given by its index in the joint, not by {index!r}")
        if not 0 <= index < len(self.dofs):
            raise IndexError(f"joint {self.name!r} has {len(self.dofs)} dofs, so no dof {index}")
        return self.dofs[index]

    def __repr__(self) -> str:
        return f"[{type(self).__name__}({self.id}): {self.name}]"


class WeldJoint(Joint):
    """No motion."""


class _WithAxis(Joint):
    def axis(self) -> NDArray[np.float64]:
        """Unit axis in the joint's frame, shape (3,)."""
        return self._handle.axis()

    def set_axis(self, axis: ArrayLike) -> None:
        """Set the axis in the joint's frame, shape (3,); it is made a unit vector."""
        self._handle.set_axis(axis)


class RevoluteJoint(_WithAxis):
    """Rotation about an axis."""

    def axis_in_world_frame(self) -> NDArray[np.float64]:
        """Unit axis in the world, shape (3,)."""
        axis: NDArray[np.float64] = self._handle.world_transform_of_child_side()[:3, :3] @ self.axis()
        return axis


class PrismaticJoint(_WithAxis):
    """Translation along an axis."""


class ScrewJoint(_WithAxis):
    """Rotation about an axis, with translation along it."""

    def pitch(self) -> float:
        """Translation per turn, m."""
        return self._handle.pitch()

    def set_pitch(self, pitch: float) -> None:
        """Set the translation per turn, m."""
        self._handle.set_pitch(pitch)


class UniversalJoint(Joint):
    """Rotation about a first axis, fixed to the parent, then about a second, fixed to the child."""

    def axis1(self) -> NDArray[np.float64]:
        """First unit axis in the joint's frame, shape (3,)."""
        return self._handle.axis1()

    def set_axis1(self, axis: ArrayLike) -> None:
        """Set the first axis in the joint's frame, shape (3,); it is made a unit vector."""
        self._handle.set_axis1(axis)

    def axis1_in_world_frame(self) -> NDArray[np.float64]:
        """First unit axis in the world, shape (3,)."""
        axis: NDArray[np.float64] = self._handle.world_transform_of_parent_side()[:3, :3] @ self.axis1()
        return axis

    def axis2(self) -> NDArray[np.float64]:
        """Second unit axis in the joint's frame, shape (3,)."""
        return self._handle.axis2()

    def set_axis2(self, axis: ArrayLike) -> None:
        """Set the second axis in the joint's frame, shape (3,); it is made a unit vector."""
        self._handle.set_axis2(axis)

    def axis2_in_world_frame(self) -> NDArray[np.float64]:
        """Second unit axis in the world, shape (3,)."""
        axis: NDArray[np.float64] = self._handle.world_transform_of_child_side()[:3, :3] @ self.axis2()
        return axis


class EulerJoint(Joint):
    """Rotation by three Euler angles."""

    def axis_order(self) -> str:
        """``"XYZ"`` or ``"ZYX"``."""
        return self._handle.axis_order()

    def set_axis_order(self, _axis_order: str) -> None:
        """Set the order, ``"XYZ"`` or ``"ZYX"``; the engine renames the dofs."""
        self._handle.set_axis_order(_axis_order)
        self.skeleton._refresh_names()


class _WithState(Joint):
    def position(self) -> NDArray[np.float64]:
        """Positions of its dofs, shape (n,), rad and m."""
        return np.array([dof.position() for dof in self.dofs])

    def set_position(self, position: ArrayLike) -> None:
        """Set the positions of its dofs, shape (n,), rad and m."""
        for dof, value in zip(self.dofs, self._per_dof(position), strict=True):
            dof.set_position(value)

    def velocity(self) -> NDArray[np.float64]:
        """Velocities of its dofs, shape (n,), rad/s and m/s."""
        return np.array([dof.velocity() for dof in self.dofs])

    def set_velocity(self, velocity: ArrayLike) -> None:
        """Set the velocities of its dofs, shape (n,), rad/s and m/s."""
        for dof, value in zip(self.dofs, self._per_dof(velocity), strict=True):
            dof.set_velocity(value)

    def acceleration(self) -> NDArray[np.float64]:
        """Accelerations of its dofs, shape (n,), rad/s² and m/s²."""
        return np.array([dof.acceleration() for dof in self.dofs])

    def set_acceleration(self, acceleration: ArrayLike) -> None:
        """Set the accelerations of its dofs, shape (n,), rad/s² and m/s²."""
        for dof, value in zip(self.dofs, self._per_dof(acceleration), strict=True):
            dof.set_acceleration(value)

    def _per_dof(self, values: ArrayLike) -> NDArray[np.float64]:
        array = numbers(values, "what is set")
        if array.shape != (len(self.dofs),):
            raise ValueError(f"joint {self.name!r} has {len(self.dofs)} dofs, got shape {array.shape}")
        return array


class BallJoint(_WithState):
    """Any rotation; its positions are a rotation vector."""


class TranslationalJoint(Joint):
    """Any translation."""


class _InPlane(Joint):
    def axis1(self) -> NDArray[np.float64]:
        """First direction of translation, a unit vector in the joint's frame, shape (3,)."""
        return self._handle.axis1()

    def axis2(self) -> NDArray[np.float64]:
        """Second direction of translation, a unit vector in the joint's frame, shape (3,)."""
        return self._handle.axis2()


class TranslationalJoint2D(_InPlane):
    """Translation in a plane."""


class PlanarJoint(_InPlane):
    """Translation in a plane and rotation about its normal."""


class FreeJoint(_WithState):
    """Any motion; its positions are a rotation vector, then a translation."""


_classes: dict[str, type[Joint]] = {
    cls.__name__: cls
    for cls in (
        WeldJoint,
        RevoluteJoint,
        PrismaticJoint,
        ScrewJoint,
        UniversalJoint,
        EulerJoint,
        BallJoint,
        TranslationalJoint,
        TranslationalJoint2D,
        PlanarJoint,
        FreeJoint,
    )
}


def create_joint(_skeleton: Skeleton, _id: int) -> Joint:
    """The joint as an object of its type's class; a plain Joint for types that have none."""
    return _classes.get(_skeleton._handle.joint(_id).type(), Joint)(_skeleton, _id)
