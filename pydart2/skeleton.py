"""Skeletons: trees of bodies and joints."""

from __future__ import annotations

import logging
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pydart2 import contact_forces, screen, spd, telling
from pydart2.assignment import Assignable
from pydart2.bodynode import BodyNode
from pydart2.building.short_forms import ShortForms
from pydart2.dynamics import Dynamics
from pydart2.errors import DestroyedError
from pydart2.exporting.methods import SavedSkeleton
from pydart2.inverse_kinematics import IKResult, Target, solve
from pydart2.multibody.structure import PARTS
from pydart2.simulation.up import is_z_up
from pydart2.state import part_of
from pydart2.targets import TargetControl

if TYPE_CHECKING:
    import os

    from pydart2.world import World

_log = logging.getLogger("pydart2")
_MADE_ANEW = ("world", "id", "_handle", "names", "_pattern", *PARTS)  # in a copy


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
        self._controller: Controller | None = None
        if _filename is not None:
            self._load(_filename)
        elif _id is not None:
            self.id = _id
            self.build()
        else:
            raise TypeError("Skeleton() needs a file name or an id")

    def _load(self, source: str | bytes | os.PathLike[str]) -> None:
        from pydart2.loading import read_model

        model = read_model(source)
        self.filename = model.document.path
        self._z_up = is_z_up(model)
        with self.world._all_or_nothing():
            self.id = model.add_to(self.world._handle)
            self.build()
            self.world._take_in(self)

    @classmethod
    def _of_world(cls, world: World, index: int) -> Skeleton:
        """The object for a skeleton of a world that is made again; its attributes follow (World.__reduce__)."""
        skel = cls.__new__(cls)
        skel.world = world
        skel.id = index
        skel._handle = world._handle.skeleton(index)
        skel._name_dofs(skel._handle.dof(i).name() for i in range(skel._handle.num_dofs()))
        return skel

    def _missing(self, name: str) -> Any:
        """One that was made again looks at its tree when it is asked for a part: of a batch only the first one is."""
        if name not in PARTS or "_handle" not in vars(self):
            return super()._missing(name)
        self._look()
        return vars(self)[name]

    def __reduce__(self) -> tuple[object, ...]:
        kept = {name: value for name, value in self.__dict__.items() if name not in _MADE_ANEW}
        return part_of, (self.world, "skeletons", self.id), {**kept, "_tau": np.array(self.forces())}

    def __setstate__(self, kept: dict[str, Any]) -> None:
        tau = kept.pop("_tau", None)  # None as release candidates saved it where none was set
        super().__setstate__(kept)
        if tau is not None:
            self._handle.set_last_forces(tau)
        self._handle.set_controlled(self._controller is not None)

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

    # Flags

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
