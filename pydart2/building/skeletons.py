"""What can be added to a skeleton: bodies, each with the joint that it hangs from."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pydart2 import given
from pydart2.multibody.structure import Structure
from pydart2.poses import pose

if TYPE_CHECKING:
    from pydart2.bodynode import BodyNode
    from pydart2.building.skins import Skin
    from pydart2.joint import Joint

#: What add_body() calls a joint → the engine's name.
JOINTS = {
    "ball": "BallJoint",
    "euler": "EulerJoint",
    "free": "FreeJoint",
    "planar": "PlanarJoint",
    "prismatic": "PrismaticJoint",
    "revolute": "RevoluteJoint",
    "screw": "ScrewJoint",
    "translational": "TranslationalJoint",
    "translational2d": "TranslationalJoint2D",
    "universal": "UniversalJoint",
    "weld": "WeldJoint",
}
_AXES = {
    "planar": [[1, 0, 0], [0, 1, 0]],
    "translational2d": [[1, 0, 0], [0, 1, 0]],
    "universal": [[1, 0, 0], [0, 1, 0]],
}
_DOFS = {
    "ball": 3,
    "euler": 3,
    "free": 6,
    "planar": 3,
    "translational": 3,
    "translational2d": 2,
    "universal": 2,
    "weld": 0,
}
_ONE_AXIS = ("prismatic", "revolute", "screw")


class SkeletonBuilding(Structure):
    """The part of Skeleton that adds to it."""

    def add_body(
        self,
        name: str,
        parent: BodyNode | str | int | None = None,
        joint: str | None = None,
        *,
        joint_name: str | None = None,
        position: ArrayLike = (0.0, 0.0, 0.0),
        orientation: ArrayLike | None = None,
        joint_position: ArrayLike = (0.0, 0.0, 0.0),
        joint_orientation: ArrayLike | None = None,
        axis: ArrayLike | None = None,
        pitch: float = 0.0,
        order: str = "XYZ",
        limits: ArrayLike | None = None,
        damping: ArrayLike | None = None,
        stiffness: ArrayLike | None = None,
        rest: ArrayLike | None = None,
        friction: ArrayLike | None = None,
        armature: ArrayLike | None = None,
        mass: float = 0.0,
        com: ArrayLike = (0.0, 0.0, 0.0),
        inertia: ArrayLike | None = None,
        skin: Skin | None = None,
    ) -> BodyNode:
        """Add a body, and the joint to its parent.

        Other parts of the skeleton stay valid, and get new indices.

        Parameters
        ----------
        parent
            A body, its name or index; None for the world.
        joint
            ``"free"`` (default without a parent), ``"weld"`` (default with one), ``"revolute"``, ``"prismatic"``,
            ``"screw"``, ``"ball"``, ``"euler"``, ``"universal"``, ``"planar"``, ``"translational"`` or
            ``"translational2d"``.
        joint_name
            By default the body's name and ``_joint``.
        position, orientation
            Pose of the body in its parent at q = 0, or in the world; of a free body it is q itself. Shape (3,), m, and
            a quaternion [w, x, y, z] or a (3, 3) matrix.
        joint_position, joint_orientation
            Pose of the joint in the body.
        axis
            In the joint's frame: shape (3,), by default z; two of them, shape (2, 3), for universal (x and y) and
            planar joints (the directions of translation, x and y).
        pitch
            Of a screw, m per turn.
        order
            Of a euler joint, ``"XYZ"`` or ``"ZYX"``.
        limits
            Lower and upper of the positions, a pair or a pair for each dof, rad or m; they are enforced.
        damping, stiffness, rest, friction, armature
            One for all dofs or one for each: N m s/rad or N s/m; N m/rad or N/m; the position without spring force,
            rad or m; Coulomb friction, N m or N; inertia of the motor, kg m² or kg.
        mass, com, inertia
            Mass, kg, centre of mass in the body, shape (3,), m, and moment of inertia about it, shape (3, 3), kg m²;
            shapes that are added add theirs.
        skin
            Makes it a SoftBodyNode; its points have masses of their own.

        Raises
        ------
        ValueError
            If the name is taken or an argument does not fit the joint.
        """
        above = -1 if parent is None else self._parent_index(parent)
        kind = joint or ("free" if above < 0 else "weld")
        numbers = {"damping": damping, "stiffness": stiffness, "rest": rest, "friction": friction, "armature": armature}
        where, in_body = pose(position, orientation), pose(joint_position, joint_orientation)
        hangs = above, name, engine_name(kind), joint_name or f"{name}_joint", axes_of(kind, axis)
        check_joint(name, kind, pitch, order, limits, numbers)
        if skin is None:
            index = self._handle.add_body(*hangs)
        else:
            edges, triangles = skin.edges.astype(float), skin.triangles.astype(float)
            index = self._handle.add_soft_body(*hangs, skin.points, skin.masses, edges, triangles)
        self.build()
        body = self.bodynodes[index]
        set_joint(body.parent_joint, where, in_body, pitch, order, limits, numbers)
        try:
            if skin is not None:
                soft = body._handle.soft_body()
                soft.set_vertex_stiffness(skin.stiffness)
                soft.set_edge_stiffness(skin.edge_stiffness)
                soft.set_damping_coefficient(skin.damping)
            if mass or inertia is not None:
                body.add_mass(mass, com, inertia)
        except BaseException:
            self.remove_body(body)
            raise
        return body

    def remove_body(self, body: BodyNode | str | int) -> None:
        """Take a body away with its joint and all that hangs from it; they can no longer be used.

        Others stay valid, and get new indices. ValueError if a joint that stays follows one that goes, or a constraint
        holds the skeleton.
        """
        self._handle.remove_body(self._parent_index(body))
        self.build()

    def _parent_index(self, parent: BodyNode | str | int) -> int:
        return int(self._own_body(parent).id)


def engine_name(kind: str) -> str:
    """The engine's name of a kind of joint; ValueError for one that there is not."""
    if not isinstance(kind, str) or kind not in JOINTS:
        raise ValueError(f"no joint {kind!r}; there are {', '.join(JOINTS)}")
    return JOINTS[kind]


def axes_of(kind: str, axis: ArrayLike | None) -> ArrayLike:
    """The axes of a joint, shape (n, 3), no unit: those given, or its kind's; ValueError for another shape."""
    if axis is None:
        return np.array([[0.0, 0.0, 1.0]]) if kind in _ONE_AXIS else np.array(_AXES.get(kind, np.zeros((0, 3))), float)
    axes = np.array(given.numbers(axis, "an axis"), ndmin=2)
    if axes.shape[1:] != (3,):
        raise ValueError(f"an axis has the shape (3,), two have (2, 3), got {np.shape(axis)}")
    return axes


def check_joint(
    name: str, kind: str, pitch: float, order: str, limits: ArrayLike | None, numbers: dict[str, ArrayLike | None]
) -> None:
    """ValueError unless the joint of a body can have all of it, so that none is half made; see add_body().

    `limits` have the shape (2,) or (n, 2), `numbers` (n,) or none, in rad or m and as add_body() says.
    """
    n = _DOFS.get(kind, 1)
    if not math.isfinite(given.number(pitch, "pitch")):
        raise ValueError(f"the pitch of the joint of {name!r} must be finite, got {pitch}")
    if order not in ("XYZ", "ZYX"):
        raise ValueError(f"the axis order is 'XYZ' or 'ZYX', got {order!r}")
    pairs = given.numbers((0.0, 0.0) if limits is None else limits, "limits")
    if pairs.shape not in ((2,), (1, 2), (n, 2)):
        raise ValueError(f"limits are a pair, or a pair for each of {n} dofs, got the shape {pairs.shape}")
    if not (pairs[..., 0] <= pairs[..., 1]).all():
        raise ValueError(f"a lower limit of the joint of {name!r} is above the upper, or one is NaN: {pairs}")
    for what, value in numbers.items():
        array = given.numbers(0.0 if value is None else value, what)
        if array.shape not in ((), (1,), (n,)):
            raise ValueError(f"{what} is one number, or one for each of {n} dofs, got the shape {array.shape}")
        if not np.isfinite(array).all() or (what != "rest" and (array < 0.0).any()):
            least = "" if what == "rest" else " and not negative"
            raise ValueError(f"{what} of the joint of {name!r} must be finite{least}, got {array}")


def set_joint(
    joint: Joint,
    where: NDArray[np.float64],
    in_body: NDArray[np.float64],
    pitch: float,
    order: str,
    limits: ArrayLike | None,
    numbers: dict[str, ArrayLike | None],
) -> None:
    """Gives a new joint its places, shape (4, 4), m, and what its kind has of the numbers; see add_body()."""
    joint._handle.set_transform_from_child_body_node(in_body)
    joint._handle.place(where)
    if joint.type() == JOINTS["screw"]:
        joint._handle.set_pitch(pitch)
    if joint.type() == JOINTS["euler"]:
        joint._handle.set_axis_order(order)
    _set_dofs(joint, limits, numbers)


def _set_dofs(joint: Joint, limits: ArrayLike | None, values: dict[str, ArrayLike | None]) -> None:
    """Sets what is given, for each dof of a joint."""
    n = len(joint.dofs)
    if limits is not None:
        lower, upper = np.broadcast_to(np.asarray(limits, dtype=float), (n, 2)).T
        for dof, low, high in zip(joint.dofs, lower, upper):
            dof.set_position_lower_limit(low)
            dof.set_position_upper_limit(high)
        joint.set_position_limit_enforced(True)
    setters = {
        "damping": "set_damping_coefficient",
        "stiffness": "set_spring_stiffness",
        "rest": "set_rest_position",
        "friction": "set_coulomb_friction",
        "armature": "set_armature",
    }
    for name, value in values.items():
        if value is not None:
            for dof, number in zip(joint.dofs, np.broadcast_to(np.asarray(value, dtype=float), (n,))):
                getattr(dof._handle, setters[name])(float(number))
