"""Skeletons: trees of bodies and joints."""

from __future__ import annotations

import logging
from collections.abc import Callable, Iterable, Mapping
from typing import TYPE_CHECKING, Any, Protocol, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pydart2 import contact_forces, screen, spd, telling
from pydart2.assignment import Assignable
from pydart2.bodynode import BodyNode
from pydart2.building.short_forms import ShortForms
from pydart2.dof import Dof
from pydart2.dynamics import Dynamics
from pydart2.errors import DestroyedError, NameNotFound
from pydart2.exporting.methods import SavedSkeleton
from pydart2.indexing import Names
from pydart2.inverse_kinematics import IKResult, Target, solve
from pydart2.joint import Joint, create_joint
from pydart2.marker import Marker
from pydart2.skel_vector import SkelVector
from pydart2.softbody import SoftBodyNode
from pydart2.state import part_of
from pydart2.targets import TargetControl
from pydart2.up import is_z_up

if TYPE_CHECKING:
    import os

    from pydart2.world import World

_log = logging.getLogger("pydart2")
Part = TypeVar("Part", BodyNode, Joint, Dof)


# What build() makes.
_PARTS = ("dofs", "joints", "bodynodes", "markers", "name_to_dof", "name_to_joint", "name_to_body", "names")
_BUILT = frozenset(("world", "id", "_handle", "_pattern", *_PARTS))


def _kept(before: dict[str, Part], now: Part) -> Part:
    """The object that there was for this part of the engine's, taken again; `now` itself if there was none."""
    old = before.get(now.name)
    if old is None or type(old) is not type(now):
        return now
    old._take(now)
    return old


class HasCompute(Protocol):
    """What a skeleton's controller must have, if it is not a function."""

    def compute(self) -> ArrayLike:
        """The generalized forces for the next step, shape (ndofs,), N m or N."""


#: Computes the generalized forces for the next step, shape (ndofs,), N m or N.
Controller = HasCompute | Callable[[], ArrayLike]


def _compute_of(controller: Controller) -> Callable[[], ArrayLike]:
    """What a controller computes with; TypeError for what is none."""
    compute = getattr(controller, "compute", controller)
    if not callable(compute):
        raise TypeError(f"a controller is a function of no arguments, or has compute(); {controller!r} is neither")
    return compute


class Skeleton(Dynamics, TargetControl, ShortForms, SavedSkeleton, Assignable):
    """A robot or another articulated body, in a world.

    ``q``, ``dq``, ``ddq`` are copies: change one and assign it back, or write by name with ``set_positions``::

        q = skel.q
        q["j_knee"] = 0.4
        skel.q = q

    The methods with an `out` argument allocate nothing when they get one: they fill this array (float64, C order, the
    shape of the result) and return it.

    Attributes
    ----------
    world : World
    id : int
        Index in the world.
    filename : str or None
    controller : function of no arguments, object with compute(), or None
        World.step() applies what it returns as forces.
    dofs, joints, bodynodes, markers : lists
        In the engine's order.
    name_to_dof, name_to_joint, name_to_body : dicts
    names : Names
        Dof name → index.
    """

    _z_up: bool | None = None  # of the file's format; None if it came from none

    def __init__(
        self,
        _world: World,
        _filename: str | bytes | os.PathLike[str] | None = None,
        _id: int | None = None,
        _friction: float | None = None,
    ) -> None:
        self.world = _world
        self.friction = _friction
        self.filename: str | None = None
        loaded = False
        if _filename is not None:
            from pydart2.loading import read_model

            model = read_model(_filename)
            self.filename = model.document.path
            self._z_up = is_z_up(model)
            _id = model.add_to(_world._handle)
            loaded = True
        if _id is None:
            raise TypeError("Skeleton() needs a file name or an id")
        self.id = _id
        self._controller: Controller | None = None
        self._tau: SkelVector | None = None
        try:
            self.build()
        except BaseException:
            if loaded:
                _world._go_back(_id)
            raise
        if loaded:
            _world._append(self)

    @classmethod
    def _of_world(cls, world: World, index: int) -> Skeleton:
        """The object for a skeleton of a world that is made again; its attributes follow (World.__reduce__)."""
        skel = cls.__new__(cls)
        skel.world = world
        skel.id = index
        skel.build()
        return skel

    def __reduce__(self) -> tuple[object, ...]:
        kept = {name: value for name, value in self.__dict__.items() if name not in _BUILT}
        return part_of, (self.world, "skeletons", self.id), kept

    def build(self) -> None:
        """Look at the tree again: what is still there stays the same object, with its new index; the rest is made."""
        handle = self._handle = self.world._handle.skeleton(self.id)
        joints: dict[str, Joint] = getattr(self, "name_to_joint", {})
        bodies: dict[str, BodyNode] = getattr(self, "name_to_body", {})
        dofs = {dof.name: dof for joint in joints.values() for dof in joint.dofs if dof.joint is joint}
        self.joints = [_kept(joints, create_joint(self, i)) for i in range(handle.num_joints())]
        kept = set(map(id, self.joints))
        dofs = {name: dof for name, dof in dofs.items() if id(dof.joint) in kept}
        self.dofs = [_kept(dofs, Dof(self, i)) for i in range(handle.num_dofs())]
        self.bodynodes = [_kept(bodies, self._make_body(i)) for i in range(handle.num_bodynodes())]
        self.markers = [Marker(self, i) for i in range(handle.num_markers())]
        self._refresh_names()
        for parts in (self.joints, self.bodynodes, self.markers):
            for part in parts:
                part.build()

    def _new_marker(self, index: int) -> Marker:
        marker = Marker(self, index)
        self.markers.append(marker)
        marker.build()
        return marker

    def _make_body(self, index: int) -> BodyNode:
        return (SoftBodyNode if self._handle.bodynode(index).is_soft() else BodyNode)(self, index)

    def _refresh_names(self) -> None:
        """Read the names of all joints and dofs again: renaming one may change others."""
        for dof in self.dofs:
            dof.name = dof._handle.name()
        for joint in self.joints:
            joint.name = joint._handle.name()
        self.name_to_dof = {dof.name: dof for dof in self.dofs}
        self.name_to_joint = {joint.name: joint for joint in self.joints}
        self.name_to_body = {body.name: body for body in self.bodynodes}
        self.names = Names([dof.name for dof in self.dofs], self)
        self._pattern = SkelVector(np.zeros(len(self.dofs)), self)
        self._pattern.flags.writeable = False  # what says to the C++ layer: a new vector like this one

    def set_position_limits_enforced(self, enforced: bool = True) -> None:
        """Let all its joints stop at their position limits, or not, as the engine has it.

        Joints without a limit stay as free as they are; a warning names those of one dof.
        """
        free = []
        for joint in self.joints:
            bounded = any(joint.has_position_limit(i) for i in range(joint.num_dofs()))
            if bounded or not enforced:
                joint.set_position_limit_enforced(enforced)
            elif joint.num_dofs() == 1:
                free.append(repr(joint.name))
        if free:
            _log.warning("skeleton %r: no position limits to enforce for joints %s", self.name, ", ".join(free))

    def set_root_joint_to_trans_and_euler(self) -> None:
        """Put the root under a TranslationalJoint ``root_t`` and an EulerJoint ``root_r`` (XYZ), by a massless body.

        Positions are not converted. Dofs 0 to 2 are the translation, 3 to 5 the Euler angles of a root that was free.
        """
        self._handle.set_root_joint_to_trans_and_euler()
        self.build()

    def set_root_joint_to_weld(self) -> None:
        """Weld the root to the world, where it is."""
        roots = self.root_bodynodes()  # none, or several, the engine's layer refuses
        moved = any(dof.position() != 0.0 for root in roots for dof in root.parent_joint.dofs)
        where = [root.world_transform() for root in roots]
        self._handle.set_root_joint_to_weld()
        self.build()
        if moved:  # at q = 0 the engine's own numbers stay, bit for bit
            self._place(where[0])

    def set_root_joint_to_free(self) -> None:
        """Let a root that is fixed float, from where it is; after a reset it is there again.

        ValueError if it is on a joint of another kind.
        """
        self._handle.set_root_joint_to_free()
        self.build()

    def _place(self, where: NDArray[np.float64]) -> None:
        """Put the root link there, shape (4, 4), m; a root that floats is there after a reset, too."""
        self.root_bodynode().parent_joint._handle.place(where)

    @property
    def controller(self) -> Controller | None:
        """What acts before each step, or None."""
        return self._controller

    @controller.setter
    def controller(self, controller: Controller | None) -> None:
        if controller is not None:
            _compute_of(controller)
        self._controller = controller
        self._handle.set_controlled(controller is not None)
        self.world._find_controllers()

    def set_controller(self, _controller: Controller | None) -> None:
        """Let a controller act before each step; None for none. TypeError if it is no function and has no compute()."""
        self.controller = _controller

    @property
    def name(self) -> str:
        """Name of the skeleton; can be set to one that no other skeleton of the world has."""
        return self._handle.name()

    @name.setter
    def name(self, name: str) -> None:
        self._handle.set_name(name)

    # Structure

    def num_dofs(self) -> int:
        """How many dofs there are."""
        return len(self.dofs)

    @property
    def ndofs(self) -> int:
        """How many dofs there are."""
        return len(self.dofs)

    def num_joints(self) -> int:
        """How many joints there are."""
        return len(self.joints)

    @property
    def njoints(self) -> int:
        """How many joints there are."""
        return len(self.joints)

    def num_bodynodes(self) -> int:
        """How many bodies there are."""
        return len(self.bodynodes)

    @property
    def nbodies(self) -> int:
        """How many bodies there are."""
        return len(self.bodynodes)

    def bodynode(self, query: str | int) -> BodyNode:
        """A body by name or index; NameNotFound or IndexError if there is none."""
        return self._find("body", query, self.bodynodes, self.name_to_body)

    def body(self, query: str | int) -> BodyNode:
        """A body by name or index; NameNotFound or IndexError if there is none."""
        return self._find("body", query, self.bodynodes, self.name_to_body)

    def joint(self, query: str | int) -> Joint:
        """A joint by name or index; NameNotFound or IndexError if there is none."""
        return self._find("joint", query, self.joints, self.name_to_joint)

    def dof(self, query: str | int) -> Dof:
        """A dof by name or index; NameNotFound or IndexError if there is none."""
        return self._find("dof", query, self.dofs, self.name_to_dof)

    def _find(self, kind: str, query: str | int, parts: list[Part], by_name: dict[str, Part]) -> Part:
        if isinstance(query, str):
            if query not in by_name:
                raise NameNotFound(kind, query, f"skeleton {self.name!r}", by_name)
            return by_name[query]
        if not isinstance(query, (int, np.integer)):
            raise TypeError(f"a {kind} is found by name or index, not by {query!r}")
        if not -len(parts) <= query < len(parts):
            raise IndexError(f"no {kind} {query} in skeleton {self.name!r}: there are {len(parts)}")
        return parts[query]

    def root_bodynodes(self) -> list[BodyNode]:
        """The bodies without a parent."""
        return [body for body in self.bodynodes if body.parent_bodynode is None]

    def root_bodynode(self, index: int = 0) -> BodyNode:
        """A body without a parent."""
        return self.root_bodynodes()[index]

    def bodynode_index(self, name: str) -> int:
        """Index of a body; NameNotFound if there is none of this name."""
        return self.bodynode(name).id

    def dof_index(self, name: str) -> int:
        """Index of a dof; NameNotFound if there is none of this name."""
        return self.names.index(name)

    def dof_indices(self, names: Iterable[str]) -> NDArray[np.intp]:
        """Indices of dofs, shape (n,), for indexing arrays; NameNotFound if there is none of a name."""
        return np.array([self.names.index(name) for name in names], dtype=np.intp)

    # Flags and totals

    def is_mobile(self) -> bool:
        """Whether it moves in a step."""
        return self._handle.is_mobile()

    def is_asleep(self) -> bool:
        """Whether it lies still and takes no part in steps until something wakes it (`World.set_sleeping`)."""
        return self._handle.is_asleep()

    def set_mobile(self, mobile: bool) -> None:
        """Let it move in a step or not."""
        self._handle.set_mobile(mobile)

    @property
    def integrator_fallbacks(self) -> int:
        """Steps in which it took the engine's rule, since `World.set_integrator` chose another."""
        return self._handle.integrator_fallbacks()

    def self_collision_check(self) -> bool:
        """Whether its bodies collide with each other; by default they do not."""
        return self._handle.self_collision_check()

    def set_self_collision_check(self, enable: bool) -> None:
        """Let its bodies collide with each other or not."""
        self._handle.set_self_collision_check(enable)

    def adjacent_body_check(self) -> bool:
        """Whether neighbours collide too, if its bodies collide with each other."""
        return self._handle.adjacent_body_check()

    def set_adjacent_body_check(self, enable: bool) -> None:
        """Let neighbours collide too or not, if its bodies collide with each other."""
        self._handle.set_adjacent_body_check(enable)

    def mass(self) -> float:
        """Total mass, kg."""
        return self._handle.mass()

    @property
    def m(self) -> float:
        """Total mass, kg."""
        return self._handle.mass()

    # State

    def positions(self, out: SkelVector | None = None) -> SkelVector:
        """Generalized positions, shape (ndofs,), rad or m. A copy."""
        return self._handle.positions(self._pattern if out is None else out)

    def set_positions(self, _q: ArrayLike | Mapping[str, float] | None = None, **by_name: float) -> None:
        """Set the generalized positions, shape (ndofs,), rad or m.

        Or some of them by name: ``set_positions({"j_knee": 0.4}, j_hip=0.1)``.
        """
        self._handle.set_positions(self._vector(_q, by_name, "q"))

    set_q = set_positions

    @property
    def q(self) -> SkelVector:
        """Generalized positions, shape (ndofs,), rad or m. A copy."""
        return self._handle.positions(self._pattern)

    @q.setter
    def q(self, q: ArrayLike) -> None:
        self._handle.set_positions(q)

    def velocities(self, out: SkelVector | None = None) -> SkelVector:
        """Generalized velocities, shape (ndofs,), rad/s or m/s. A copy."""
        return self._handle.velocities(self._pattern if out is None else out)

    def set_velocities(self, _qdot: ArrayLike | Mapping[str, float] | None = None, **by_name: float) -> None:
        """Set the generalized velocities, shape (ndofs,), rad/s or m/s, or some of them by name."""
        self._handle.set_velocities(self._vector(_qdot, by_name, "dq"))

    set_dq = set_velocities

    @property
    def dq(self) -> SkelVector:
        """Generalized velocities, shape (ndofs,), rad/s or m/s. A copy."""
        return self._handle.velocities(self._pattern)

    @dq.setter
    def dq(self, dq: ArrayLike) -> None:
        self._handle.set_velocities(dq)

    def accelerations(self, out: SkelVector | None = None) -> SkelVector:
        """Generalized accelerations of the last step, shape (ndofs,), rad/s² or m/s². A copy."""
        return self._handle.accelerations(self._pattern if out is None else out)

    def set_accelerations(self, _ddq: ArrayLike) -> None:
        """Set the generalized accelerations, shape (ndofs,), rad/s² or m/s²."""
        self._handle.set_accelerations(_ddq)

    @property
    def ddq(self) -> SkelVector:
        """Generalized accelerations of the last step, shape (ndofs,), rad/s² or m/s². A copy."""
        return self._handle.accelerations(self._pattern)

    @ddq.setter
    def ddq(self, ddq: ArrayLike) -> None:
        self._handle.set_accelerations(ddq)

    def states(self, out: NDArray[np.float64] | None = None) -> NDArray[np.float64]:
        """[q, dq], shape (2 * ndofs,), rad, m, rad/s and m/s."""
        return self._handle.states(out)

    def set_states(self, _x: ArrayLike) -> None:
        """Set [q, dq], shape (2 * ndofs,), rad, m, rad/s and m/s."""
        self._handle.set_states(_x)

    @property
    def x(self) -> NDArray[np.float64]:
        """[q, dq], shape (2 * ndofs,), rad, m, rad/s and m/s."""
        return self._handle.states(None)

    @x.setter
    def x(self, x: ArrayLike) -> None:
        self._handle.set_states(x)

    def position_differences(self, _q1: ArrayLike, _q2: ArrayLike) -> NDArray[np.float64]:
        """``q1 - q2`` on the configuration manifold (log map for ball and free joints), shape (ndofs,), rad or m."""
        return self._handle.position_differences(_q1, _q2)

    def integrate_positions(self, q: ArrayLike, change: ArrayLike) -> NDArray[np.float64]:
        """`q` moved along `change`, shape (ndofs,), rad or m: the opposite of position_differences().

        ``q + change`` for most joints; free and ball joints turn on from where they are (exponential map).
        """
        return self._handle.integrate_positions(q, change)

    def velocity_differences(self, _dq1: ArrayLike, _dq2: ArrayLike) -> NDArray[np.float64]:
        """``dq1 - dq2``, shape (ndofs,), rad/s or m/s."""
        return self._handle.velocity_differences(_dq1, _dq2)

    # Limits

    def position_lower_limits(self) -> NDArray[np.float64]:
        """Lower limits of q, shape (ndofs,), rad or m; -inf for none."""
        return self._handle.position_lower_limits()

    @property
    def q_lower(self) -> NDArray[np.float64]:
        """Lower limits of q, shape (ndofs,), rad or m; -inf for none."""
        return self._handle.position_lower_limits()

    def position_upper_limits(self) -> NDArray[np.float64]:
        """Upper limits of q, shape (ndofs,), rad or m; inf for none."""
        return self._handle.position_upper_limits()

    @property
    def q_upper(self) -> NDArray[np.float64]:
        """Upper limits of q, shape (ndofs,), rad or m; inf for none."""
        return self._handle.position_upper_limits()

    def force_lower_limits(self) -> NDArray[np.float64]:
        """Lower limits of tau, shape (ndofs,), N m or N; -inf for none."""
        return self._handle.force_lower_limits()

    @property
    def tau_lower(self) -> NDArray[np.float64]:
        """Lower limits of tau, shape (ndofs,), N m or N; -inf for none."""
        return self._handle.force_lower_limits()

    def force_upper_limits(self) -> NDArray[np.float64]:
        """Upper limits of tau, shape (ndofs,), N m or N; inf for none."""
        return self._handle.force_upper_limits()

    @property
    def tau_upper(self) -> NDArray[np.float64]:
        """Upper limits of tau, shape (ndofs,), N m or N; inf for none."""
        return self._handle.force_upper_limits()

    # Dynamics: M ddq + c = tau

    def mass_matrix(self, out: NDArray[np.float64] | None = None) -> NDArray[np.float64]:
        """Joint-space mass matrix, shape (ndofs, ndofs), kg m² or kg."""
        return self._handle.mass_matrix(out)

    @property
    def M(self) -> NDArray[np.float64]:  # noqa: N802 (the field's name)
        """Joint-space mass matrix, shape (ndofs, ndofs), kg m² or kg."""
        return self._handle.mass_matrix(None)

    def inv_mass_matrix(self, out: NDArray[np.float64] | None = None) -> NDArray[np.float64]:
        """Inverse of the mass matrix, shape (ndofs, ndofs), 1/(kg m²) or 1/kg."""
        return self._handle.inv_mass_matrix(out)

    @property
    def invM(self) -> NDArray[np.float64]:  # noqa: N802 (the original's)
        """Inverse of the mass matrix, shape (ndofs, ndofs), 1/(kg m²) or 1/kg."""
        return self._handle.inv_mass_matrix(None)

    def coriolis_and_gravity_forces(self, out: NDArray[np.float64] | None = None) -> NDArray[np.float64]:
        """Coriolis, centrifugal and gravity forces, shape (ndofs,), N m or N."""
        return self._handle.coriolis_and_gravity_forces(out)

    @property
    def c(self) -> NDArray[np.float64]:
        """Coriolis, centrifugal and gravity forces, shape (ndofs,), N m or N."""
        return self._handle.coriolis_and_gravity_forces(None)

    def constraint_forces(self, out: NDArray[np.float64] | None = None) -> NDArray[np.float64]:
        """Generalized forces of contacts, limits and constraints in the last step, shape (ndofs,), N m or N."""
        return self._handle.constraint_forces(out)

    def forces(self) -> SkelVector:
        """The generalized forces last set, shape (ndofs,), N m or N; zeros before. A copy.

        They stay after the step that used them, in which the engine clears its own.
        """
        return (self._pattern if self._tau is None else self._tau).copy()

    def set_forces(self, _tau: ArrayLike | Mapping[str, float] | None = None, **by_name: float) -> None:
        """Set the generalized forces of the next step, shape (ndofs,), N m or N; or some by name, the others zero."""
        self.tau = self._vector(_tau, by_name, "")

    set_tau = set_forces

    @property
    def tau(self) -> SkelVector:
        """The generalized forces last set, shape (ndofs,), N m or N; zeros before. A copy. Set for one step."""
        return self.forces()

    @tau.setter
    def tau(self, tau: ArrayLike) -> None:
        self._handle.set_forces(tau)
        self._tau = self._pattern.copy()
        self._tau[:] = tau

    def _read_tau(self) -> None:
        """What the engine has is what was last set."""
        self._tau = self._handle.forces(self._pattern)

    def commands(self, out: SkelVector | None = None) -> SkelVector:
        """Commands to the actuators, shape (ndofs,), in the unit of each joint's actuator type. A copy."""
        return self._handle.commands(self._pattern if out is None else out)

    def set_commands(self, _commands: ArrayLike | Mapping[str, float] | None = None, **by_name: float) -> None:
        """Set the commands of the next step, shape (ndofs,), or some by name.

        A command is a force for FORCE joints (N m or N), a velocity for SERVO and VELOCITY (rad/s or m/s), an
        acceleration for ACCELERATION (rad/s² or m/s²).
        """
        self._handle.set_commands(self._vector(_commands, by_name, "comms"))

    @property
    def comms(self) -> SkelVector:
        """Commands to the actuators, shape (ndofs,), in the units of set_commands(). A copy."""
        return self._handle.commands(self._pattern)

    @comms.setter
    def comms(self, commands: ArrayLike) -> None:
        self._handle.set_commands(commands)

    def clear_impulse(self) -> None:
        """Forget the impulses of contacts, limits and constraints."""
        self._handle.clear_impulse()

    def update_fk(self) -> None:
        """Compute all poses, velocities and accelerations now; without it each is computed when it is read."""
        self._handle.update_fk()

    @property
    def contacts(self) -> contact_forces.Contacts:
        """Its contacts of the last step as arrays; those between its own bodies are there from both sides."""
        return contact_forces.of_skeleton(self)

    # Inverse kinematics (inverse_kinematics.py)

    def inverse_kinematics(
        self, targets: Mapping[str | BodyNode, Target | ArrayLike], com: ArrayLike | None = None, **options: Any
    ) -> IKResult:
        """Positions that put bodies where they should be; the skeleton does not move.

        >>> result = robot.inverse_kinematics({"l_hand": [0.5, 0.2, 0.9], "l_foot": robot.body("l_foot").T})
        >>> robot.q = result.q

        Parameters
        ----------
        targets
            Body → where it should be in the world: a position of its origin, shape (3,), m, or its pose, shape (4, 4);
            or a Target, which has an offset and a weight.
        com
            Where the centre of mass should be, shape (3,), m.
        dofs
            The dofs that may move, by name or index; default: all.
        posture
            Positions that the dofs go towards as far as the targets leave them free, shape (ndofs,), rad or m.
        start
            Positions to start from, shape (ndofs,), rad or m; default: q.
        tolerance
            Distance (m) and angle (rad) to each target that is near enough, 1e-6.
        iterations, restarts
            At most this many steps from one start, 100, and this many other starts, 50. They are random, within the
            limits of the joints, and the same for the same `seed`. A root that is free starts where it is.

        Returns the best q that was found, also where a target is out of reach: see IKResult.
        """
        return solve(self, targets, com, **options)

    # Stable PD control (spd.py)

    def get_spd(self, q_des: ArrayLike, h: float, Kp: ArrayLike, Kd: ArrayLike) -> NDArray[np.float64]:
        """Forces of a stable PD controller towards a pose, without regard to contacts, shape (ndofs,), N m or N."""
        return spd.forces(self, h, Kp, Kd, q_des, external=np.zeros(self.ndofs))

    def get_spd_forces(self, q_des: ArrayLike, h: float, Kp: ArrayLike, Kd: ArrayLike) -> NDArray[np.float64]:
        """Forces of a stable PD controller towards a pose, with the last step's contacts, shape (ndofs,), N m or N."""
        return spd.forces(self, h, Kp, Kd, q_des)

    def get_spd_extended(
        self,
        q_des: ArrayLike,
        dq_des: ArrayLike,
        ddq_des: ArrayLike,
        h: float,
        Kp: ArrayLike,
        Kd: ArrayLike,
    ) -> NDArray[np.float64]:
        """Forces of a stable PD controller along a trajectory, with the last step's contacts, shape (ndofs,)."""
        return spd.forces(self, h, Kp, Kd, q_des, dq_des, ddq_des)

    # Centre of mass

    def com(self, out: NDArray[np.float64] | None = None) -> NDArray[np.float64]:
        """Centre of mass, world frame, shape (3,), m."""
        return self._handle.com(out)

    @property
    def C(self) -> NDArray[np.float64]:  # noqa: N802 (the original's)
        """Centre of mass, world frame, shape (3,), m."""
        return self._handle.com(None)

    def com_velocity(self) -> NDArray[np.float64]:
        """Velocity of the centre of mass, world frame, shape (3,), m/s."""
        return self._handle.com_velocity()

    @property
    def dC(self) -> NDArray[np.float64]:  # noqa: N802 (the original's)
        """Velocity of the centre of mass, world frame, shape (3,), m/s."""
        return self._handle.com_velocity()

    def com_acceleration(self) -> NDArray[np.float64]:
        """Acceleration of the centre of mass, world frame, shape (3,), m/s²."""
        return self._handle.com_acceleration()

    @property
    def ddC(self) -> NDArray[np.float64]:  # noqa: N802 (the original's)
        """Acceleration of the centre of mass, world frame, shape (3,), m/s²."""
        return self._handle.com_acceleration()

    def com_spatial_velocity(self) -> NDArray[np.float64]:
        """Angular (rad/s) and linear (m/s) velocity of the centre of mass, world frame, shape (6,)."""
        return self._handle.com_spatial_velocity()

    def linear_momentum(self) -> NDArray[np.float64]:
        """Linear momentum, world frame, shape (3,), kg m/s."""
        return self.m * self.dC

    @property
    def P(self) -> NDArray[np.float64]:  # noqa: N802 (the original's)
        """Linear momentum, world frame, shape (3,), kg m/s."""
        return self.linear_momentum()

    def _vector(self, values: ArrayLike | Mapping[str, float] | None, by_name: dict[str, float], rest: str) -> Any:
        """A whole vector as it is; entries by name in the vector of the name `rest`, or in zeros if that is empty."""
        if values is not None and not isinstance(values, Mapping):
            if by_name:
                raise TypeError("give a whole vector or entries by name, not both")
            return values
        vector = getattr(self, rest) if rest else self._pattern.copy()
        for name, value in {**(values or {}), **by_name}.items():
            vector[name] = value
        return vector

    def render(self) -> None:
        """Draw it with the current OpenGL context and matrices."""
        screen.draw("skeleton", self)

    def render_with_color(self, color: ArrayLike) -> None:
        """Draw it in one colour, 3 or 4 numbers, 0 to 1, with the current OpenGL context and matrices."""
        screen.draw("skeleton", self, color)

    def _repr_html_(self) -> str:
        return telling.table_of_skeleton(self)

    def __repr__(self) -> str:
        try:
            return f"[Skeleton({self.id}): {self.name}]"
        except DestroyedError:
            return f"[Skeleton({self.id}): destroyed]"
