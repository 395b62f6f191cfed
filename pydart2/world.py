"""Worlds: skeletons, time, collisions and recording."""

from __future__ import annotations

import copy
import logging
import os
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any, ClassVar, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pydart2 import constraints, contact_forces, manager, screen
from pydart2._native import WorldHandle
from pydart2.assignment import Assignable
from pydart2.building.poses import pose
from pydart2.building.worlds import WorldBuilding
from pydart2.collision_filter import CollisionFilter, WorldFilter
from pydart2.collision_result import CollisionResult
from pydart2.errors import DestroyedError, NameNotFound
from pydart2.exporting.methods import SavedWorld
from pydart2.queries import WorldQueries
from pydart2.recording import Recording
from pydart2.scenes import Scenes
from pydart2.skeleton import Skeleton, _compute_of
from pydart2.sleeping import WorldSleeping
from pydart2.state import Snapshot, model_hash
from pydart2.telling import Named
from pydart2.up import Axis, Upright, check, is_z_up

if TYPE_CHECKING:
    from pydart2.bodynode import BodyNode
    from pydart2.constraints import Constraint
    from pydart2.loading import Missing, Reader, Source

_log = logging.getLogger("pydart2")
_ITERATIVE: dict[str, float | str] = {
    "iterations": 50,
    "tolerance": 1e-6,
    "friction": "pyramid",
    "stabilisation": "split",
    "error_reduction": 0.2,
    "allowance": 1e-4,
    "correction_speed": 1.0,
}
_ITERATIVE_NAMES = {"friction": ("pyramid", "cone", "engine"), "stabilisation": ("engine", "split")}
#: By number. 4 stays free: old code asks for it to find out that its engine has it not.
_DETECTORS = {0: "dart", 1: "fcl", 2: "bullet", 3: "ode", 10: "native"}


def _option_number(option: str, value: float | str) -> float:
    """What C++ gets for an option of the iterative solver; NameNotFound for a word that is none of its."""
    if option not in _ITERATIVE_NAMES:
        return float(value)
    names = _ITERATIVE_NAMES[option]
    if value not in names:
        raise NameNotFound(option, str(value), ", ".join(names), names)
    return names.index(str(value))


def detector_number(name: str) -> int:
    """The number of a collision detector's name, -1 for one without."""
    return next((number for number, known in _DETECTORS.items() if known == name), -1)


def create_world(step: float, skel_path: str | os.PathLike[str] | None = None) -> World:
    """A world with a time step in s, and the content of a SKEL file if one is given."""
    return World(step, skel_path)


def _rebuild(
    cls: type[World],
    blueprint: tuple[Any, ...],
    contacts: NDArray[np.float64],
    recording_limit: int | None,
    classes: list[type[Skeleton]],
) -> World:
    """The world of World.__reduce__, in its own or another process."""
    world = cls.__new__(cls)
    world._handle = WorldHandle.rebuild(blueprint)
    world._begin()
    world.skeletons = [skeleton_class._of_world(world, i) for i, skeleton_class in enumerate(classes)]
    world.collision_result = CollisionResult.from_rows(world, contacts)
    if recording_limit is not None:
        world.enable_recording()
        world._handle.set_recording_limit(recording_limit)
    return world


class World(WorldBuilding, Scenes, SavedWorld, WorldQueries, WorldFilter, WorldSleeping, Upright, Named, Assignable):
    """A simulated world.

    >>> world = World(1.0 / 2000.0, "./data/skel/cubes.skel")
    >>> while world.t < 2.0:
    ...     world.step()

    Parameters
    ----------
    step
        Time step, s.
    skel_path
        A file with a world (SKEL, SDF, MJCF, URDF world), from the current folder, else among the package's models; or
        a URI, or the XML itself (a str that begins with ``<``, or bytes). A file with a skeleton alone gives a world
        with that. Without it the world is empty. The gravity is the file's, or 9.81 m/s² along -y.
    xmlstr
        Whether `skel_path` is the XML itself, however it begins.
    packages, missing_meshes, safe, reader, massless, engine_defaults, strict
        As in `add_skeleton`. With engine_defaults collision detectors also have the engine's own shapes only: to FCL
        a capsule is a ball of 5 cm, and so on.
    up
        "x", "y" or "z": which way is up, and gravity along the other; without it as the original's worlds, y-up. A file
        with a world has its own.

    Attributes
    ----------
    id : int
    skeletons : list of Skeleton
    control_skel : Skeleton or None
        For the user.
    collision_result : CollisionResult
        Contacts of the last step.
    collision_filter : CollisionFilter
        Pairs of bodies that pass through each other.
    recording : Recording or None
    keyframes : dict
        Of an MJCF file: name → `x`.

    Raises
    ------
    LoadError
        If the file is missing or cannot be read: says file, line and reason.
    ValueError
        If the file's gravity is not against `up`.
    """

    DART_COLLISION_DETECTOR: ClassVar[int] = 0
    FCL_COLLISION_DETECTOR: ClassVar[int] = 1
    BULLET_COLLISION_DETECTOR: ClassVar[int] = 2
    ODE_COLLISION_DETECTOR: ClassVar[int] = 3
    NATIVE_COLLISION_DETECTOR: ClassVar[int] = 10

    _copies_exactly = True  # clone(exact=False) takes it back for as long as it copies

    #: The class of the skeletons that the world makes.
    CLASS_SKELETON: ClassVar[type[Skeleton]] = Skeleton

    def __init__(
        self,
        step: float,
        skel_path: Source | None = None,
        xmlstr: bool = False,
        *,
        packages: Mapping[str, str | os.PathLike[str]] | None = None,
        missing_meshes: Missing = "error",
        safe: bool | None = None,
        reader: Reader = "mujoco",
        up: Axis | None = None,
        massless: bool = False,
        engine_defaults: bool = False,
        strict: bool = False,
    ) -> None:
        check(up)
        model = skel_path
        if model is not None:
            from pydart2.loading import Options, read_model  # a third of the time to import pydart2

            options = Options(packages, missing_meshes, safe, xmlstr, reader, massless, engine_defaults, strict)
            model = read_model(model, options)
        if model is not None and model.has_world:
            self._handle = model.load_world()
            self._handle.set_time_step(step)
            if model.time_step not in (None, step):
                _log.warning("%s: its time step is %g s, the world's %g s", os.fspath(model), model.time_step, step)
        else:
            self._handle = WorldHandle(step)
        self._stand(up, own_gravity=model is not None and model.has_world)
        if model is not None and not model.has_world:
            model.add_to(self._handle)
        if engine_defaults:
            self._handle.use_engine_shapes()
        self._begin()
        for i in range(self._handle.num_skeletons()):
            self.add_skeleton_from_id(i)._z_up = model is not None and is_z_up(model)
        self.keyframes: dict[str, NDArray[np.float64]] = model.keyframes if model is not None else {}
        self.reset()
        self.enable_recording()

    def _begin(self) -> None:
        self.id: int = self._handle.id()
        self._step: Callable[[int], None] = self._handle.step  # bound once: finding it anew is 1 % of a short step
        self.control_skel: Skeleton | None = None
        self.recording: Recording | None = None
        self.skeletons: list[Skeleton] = []
        self._controlled: list[tuple[Skeleton, Callable[[], ArrayLike]]] = []
        self.collision_result = CollisionResult(self)
        self.collision_filter = CollisionFilter(self)
        manager.count(self)

    def destroy(self) -> None:
        """Free the world; any later use of it or of what is in it raises DestroyedError."""
        self._handle.destroy()

    # Skeletons

    def add_skeleton(
        self,
        filename: Source,
        CLASS: type[Skeleton] | None = None,
        *,
        packages: Mapping[str, str | os.PathLike[str]] | None = None,
        missing_meshes: Missing = "error",
        safe: bool | None = None,
        reader: Reader = "mujoco",
        massless: bool = False,
        engine_defaults: bool = False,
        strict: bool = False,
        enforce_limits: bool = False,
        position: ArrayLike | None = None,
        orientation: ArrayLike | None = None,
        base: Literal["auto", "fixed", "free"] = "auto",
        name: str | None = None,
    ) -> Skeleton:
        """Load a URDF, SDF, SKEL, MJCF or VSK file and add its skeleton.

        Parameters
        ----------
        filename
            From the current folder, else among the package's models; or a URI (``file://``, ``package://``,
            ``dart://sample/``), or the XML itself (a str that begins with ``<``, or bytes).
        CLASS
            Class of the skeleton; default `CLASS_SKELETON`.
        packages
            Package name → folder, for the ``package://`` URIs in the file. Others are looked for in ROS_PACKAGE_PATH,
            then in the folders above the file.
        missing_meshes
            ``"error"``: a missing mesh of a collision shape is a LoadError; ``"warn"``: the shape is left out, with a
            warning, as visual shapes always are.
        safe
            Whether to try the file in a helper process first, so that what crashes the engine's parsers is a
            LoadError and does not end Python. None: unless the file is one of the package's own.
        reader
            Who reads MJCF: ``"mujoco"``, its own compiler (``pip install pydart2[mjcf]``), whose numbers the skeletons
            then have, or ``"engine"``, whose numbers differ.
        massless
            A URDF link without ``<inertial>`` weighs nothing, but where a joint would then move too little mass, 1 kg
            as in the engine, with a warning. True: nothing there either, for kinematics and comparisons; a step says
            what it lacks.
        engine_defaults
            Whether each of them weighs 1 kg, and has 1 kg m² about each axis, as the engine alone loads it; URDF joints
            that state no bounds then have 0 and 0.
        strict
            Whether what is a warning about the file is a LoadError.
        enforce_limits
            Whether its joints stop at their limits (`Skeleton.set_position_limits_enforced`); in the engine, and by
            default, they do not.
        position, orientation
            Where the root link is in the world: shape (3,), m; a quaternion [w, x, y, z] or a (3, 3) matrix. What is
            not given is the file's. A base that floats is there after a reset, too.
        base
            ``"fixed"`` welds the root link to the world, ``"free"`` lets one that is fixed float; ``"auto"`` leaves it
            as the file has it.
        name
            In place of the file's (URDF, SDF, SKEL). The second skeleton of a name gets `` (1)`` behind it.

        Raises
        ------
        LoadError
            If the file is missing or cannot be read: says file, line and reason.
        """
        self._handle.time()  # a world that is gone says so before the file is read
        from pydart2.loading import Options, read_model

        if base not in ("auto", "fixed", "free"):
            raise ValueError(f"base must be 'auto', 'fixed' or 'free', got {base!r}")
        where = pose((0.0, 0.0, 0.0) if position is None else position, orientation)
        options = Options(packages, missing_meshes, safe, False, reader, massless, engine_defaults, strict, name)
        model = read_model(filename, options)
        before = self._handle.num_skeletons()
        try:
            skel = (CLASS or self.CLASS_SKELETON)(self, _filename=model)
            if base == "fixed":
                skel.set_root_joint_to_weld()
            elif base == "free":
                skel.set_root_joint_to_free()
            if position is not None or orientation is not None:
                stands = skel.root_bodynode().world_transform()
                where[:3, 3] = stands[:3, 3] if position is None else where[:3, 3]
                where[:3, :3] = stands[:3, :3] if orientation is None else where[:3, :3]
                skel._place(where)
            if enforce_limits:
                skel.set_position_limits_enforced()
            return skel
        except BaseException:
            self._go_back(before)
            raise

    def _go_back(self, num_skeletons: int) -> None:
        """Take out what came last, of which no Python object could be made."""
        del self.skeletons[num_skeletons:]
        while self._handle.num_skeletons() > num_skeletons:
            self._handle.remove_skeleton(self._handle.num_skeletons() - 1)
        self._find_controllers()

    def add_skeleton_from_id(self, _skel_id: int) -> Skeleton:
        """Make an object for a skeleton that the engine's world has already."""
        try:
            skel = self.CLASS_SKELETON(self, _id=_skel_id)
        except BaseException:
            if _skel_id == len(self.skeletons):
                self._go_back(_skel_id)
            raise
        self._append(skel)
        return skel

    def _append(self, skel: Skeleton) -> None:
        self.skeletons.append(skel)
        self._step = self._first_step
        if skel.controller is not None:
            self._find_controllers()

    def remove_skeleton(self, skel: Skeleton) -> None:
        """Take a skeleton out of the world, with the constraints that hold it; it can no longer be used.

        Contacts that it had stay in `collision_result` and in the recording, without a body on its side.
        """
        if skel not in self.skeletons:
            raise ValueError(f"{skel!r} is not in {self!r}")
        self.collision_result._look()  # the engine forgets them
        self._handle.remove_skeleton(skel.id)
        self.collision_result._forget_skeleton(skel.id)
        self.skeletons.remove(skel)
        for i, other in enumerate(self.skeletons):
            other.id = i
        self._find_controllers()

    def num_skeletons(self) -> int:
        """How many skeletons there are."""
        return self._handle.num_skeletons()

    @property
    def skel(self) -> Skeleton | None:
        """`control_skel`."""
        return self.control_skel

    # Time

    def time(self) -> float:
        """Simulated time, s."""
        return self._handle.time()

    def set_time(self, time: float) -> None:
        """Set the simulated time, s."""
        self._handle.set_time(time)

    @property
    def t(self) -> float:
        """Simulated time, s."""
        return self._handle.time()

    @t.setter
    def t(self, time: float) -> None:
        self._handle.set_time(time)

    def time_step(self) -> float:
        """Time step, s."""
        return self._handle.time_step()

    def set_time_step(self, _time_step: float) -> None:
        """Set the time step, s, > 0."""
        self._handle.set_time_step(_time_step)

    @property
    def dt(self) -> float:
        """Time step, s."""
        return self._handle.time_step()

    @dt.setter
    def dt(self, time_step: float) -> None:
        self._handle.set_time_step(time_step)

    @property
    def frame(self) -> int:
        """Steps since the last reset."""
        return self._handle.frame()

    # Simulation

    def reset(self) -> None:
        """Time 0, initial positions and velocities, no forces; the recording starts again."""
        self._handle.reset()
        self.collision_result = CollisionResult(self)

    def step(self, n: int = 1) -> None:
        """Simulate `n` time steps.

        Before each, skeletons with a controller get the forces that it computes. Forces and external forces act in one
        step and are cleared after it. If the simulation blows up, the world is as before the failed step, without
        contacts, and SimulationError is raised; see set_blow_up(). Ctrl-C ends it after the step that it is in; `frame`
        says which.
        """
        try:
            if self._controlled and n > 0:
                for _ in range(n):
                    for skel, compute in self._controlled:
                        skel.tau = compute()
                    self._step(1)
            else:
                self._step(n)
        except BaseException:
            self.collision_result.update()
            raise
        self.collision_result._looked = None  # as update(), without the call

    def _first_step(self, n: int) -> None:
        """The first step since a skeleton came; the others are the engine's alone."""
        self._say_which_way_is_up()
        self._step = self._handle.step
        self._step(n)

    def _find_controllers(self) -> None:
        """Note who acts before each step, so that step() does not have to look."""
        self._controlled = [(s, _compute_of(c)) for s in self.skeletons if (c := s.controller) is not None]

    def check_collision(self) -> None:
        """Find the contacts and their forces for the present state, without a step."""
        self._handle.check_collision()
        self.collision_result.update()

    @property
    def contacts(self) -> contact_forces.Contacts:
        """All contacts of the last step as arrays, from the side of the first body of each."""
        return contact_forces.of_world(self)

    def contacts_between(self, a: BodyNode | Skeleton, b: BodyNode | Skeleton) -> contact_forces.Contacts:
        """The contacts of two bodies or skeletons in the last step as arrays, from the side of `a`."""
        return contact_forces.between(a, b)

    def states(self, out: NDArray[np.float64] | None = None) -> NDArray[np.float64]:
        """[q, dq] of each skeleton, one after another, shape (2 * sum of ndofs,), rad, m, rad/s and m/s."""
        return self._handle.states(out)

    def set_states(self, _x: ArrayLike) -> None:
        """Set [q, dq] of each skeleton, one after another, shape (2 * sum of ndofs,), rad, m, rad/s and m/s."""
        self._handle.set_states(_x)

    @property
    def x(self) -> NDArray[np.float64]:
        """[q, dq] of each skeleton, one after another, shape (2 * sum of ndofs,), rad, m, rad/s and m/s."""
        return self._handle.states(None)

    @x.setter
    def x(self, x: ArrayLike) -> None:
        self._handle.set_states(x)

    # State and copies

    def snapshot(self, exact: bool = True) -> Snapshot:
        """All that a step changes and the next one depends on, for restore().

        The world's next steps are bit for bit those after restore(), with every detector. For that it forgets what
        detectors and constraints remember of earlier steps, which is in no snapshot: the order of its next contacts may
        differ from that of a world that was left alone, and with it their last bits. A fall of the humanoid in
        `skel/fullbody1.skel` is another one after a second or two. ``exact=False`` changes nothing here.

        Raises SimulationError if the world has blown up and reads NaN.
        """
        if exact:
            self._forget_history()
        values = self._handle.snapshot()
        return Snapshot(values, self.collision_result.rows, model_hash(self._handle))

    def _forget_history(self) -> None:
        """What the detector and the constraints remember of earlier steps, but not the contacts of the last one."""
        self.collision_result = self.collision_result.copy()
        self._handle.forget_history()

    def restore(self, snapshot: Snapshot, strict: bool = True) -> None:
        """Put the state of a snapshot back, of this world or of one with an equal model. The recording goes on.

        Raises ValueError if the model is another one or has changed since: skeletons, masses, limits, gravity, time
        step and so on. With ``strict=False`` only the number of states must fit.
        """
        if strict and snapshot.model != model_hash(self._handle):
            raise ValueError(
                f"{snapshot!r} is of another model than {self!r}, or the model has changed since; "
                "restore(snapshot, strict=False) takes it nevertheless"
            )
        self._handle.restore(snapshot.values)
        for skel in self.skeletons:
            skel._read_tau()
        self.collision_result = CollisionResult.from_rows(self, snapshot.contacts)

    def clone(self, exact: bool = True) -> World:
        """A world of its own that is equal in everything: model, all changes to it, state, and the user's attributes.

        It is made anew from the texts that were loaded, and then brought to where this one is; files of meshes must
        still be there.
        Controllers and attributes are deep copies that refer to the clone. The clone records if this world does, from
        now on. Both go on bit for bit alike; for `exact` see snapshot(). ``copy.deepcopy`` does the same, and
        ``pickle`` does it across processes.

        Raises LoadError if such a file is gone.
        """
        if exact:
            return copy.deepcopy(self)
        self._copies_exactly = False
        try:
            return copy.deepcopy(self)
        finally:
            del self._copies_exactly

    def __copy__(self) -> World:
        return self.clone()

    def __reduce__(self) -> tuple[object, ...]:
        if self._copies_exactly:
            self._forget_history()
        blueprint = self._handle.blueprint()
        recording_limit = self._handle.recording_limit() if self.is_recording() else None
        classes = [type(skel) for skel in self.skeletons]
        made_anew = (
            "_handle",
            "_step",
            "id",
            "recording",
            "collision_result",
            "collision_filter",
            "_under_construction",
            "_copies_exactly",
            "_queries",
        )
        state = {name: value for name, value in self.__dict__.items() if name not in made_anew}
        return _rebuild, (type(self), blueprint, self.collision_result.rows, recording_limit, classes), state

    def gravity(self) -> NDArray[np.float64]:
        """Gravity, shape (3,), m/s²."""
        return self._handle.gravity()

    def set_gravity(self, _g: ArrayLike) -> None:
        """Set gravity, shape (3,), m/s². `up` follows it, unless the world was made with one."""
        self._handle.set_gravity(_g)
        self._has_gravity = True

    @property
    def g(self) -> NDArray[np.float64]:
        """Gravity, shape (3,), m/s²."""
        return self._handle.gravity()

    @g.setter
    def g(self, g: ArrayLike) -> None:
        self.set_gravity(g)

    @property
    def constraints(self) -> list[Constraint]:
        """The constraints between bodies that act, in the order in which they were added."""
        return constraints.of_world(self)

    def remove_all_constraints(self) -> None:
        """Take away all constraints that were added, as BallJointConstraint."""
        self._handle.remove_all_constraints()

    def create_collision_filter(self) -> CollisionFilter:
        """The pairs of bodies that pass through each other, to be changed; also `collision_filter`."""
        return self.collision_filter

    def set_collision_detector(self, detector: int | str) -> None:
        """Choose how contacts are found: "dart", "fcl", "bullet", "ode", "native" or one of `*_COLLISION_DETECTOR`.

        "native" is the package's own, the others are the engine's. ValueError for any other, NameNotFound for a name.
        """
        if isinstance(detector, str) and detector not in _DETECTORS.values():
            raise NameNotFound("collision detector", detector, ", ".join(_DETECTORS.values()), _DETECTORS.values())
        if not isinstance(detector, str) and detector not in _DETECTORS:
            known = " ".join(f"{i} ({name})" for i, name in _DETECTORS.items())
            raise ValueError(f"no collision detector {detector!r}; they are {known}")
        self._handle.set_collision_detector(detector if isinstance(detector, str) else _DETECTORS[detector])

    def collision_detector(self) -> int:
        """One of the `*_COLLISION_DETECTOR`, -1 for another."""
        return detector_number(self._handle.collision_detector())

    def collision_detector_string(self) -> str:
        """Name of the detector's constant, as ``"FCL_COLLISION_DETECTOR"``."""
        return f"{self._handle.collision_detector().upper()}_COLLISION_DETECTOR"

    def set_dynamics(self, name: str) -> None:
        """Choose the code that moves the skeletons; ValueError for an unknown name.

        "fast" (default) is of ours: articulated-body forward dynamics, impulses and integration in the engine's order,
        with bitwise the same results. A moving chain without contact steps in less than half of the engine's time;
        contacts cost what they did. It covers rigid skeletons with all joints and actuators of the engine; soft ones,
        and one with a locked joint that moves, take the engine's code in that step. "engine" is the engine's own. The
        environment variable ``PYDART2_DYNAMICS`` names the one that new worlds start with.
        """
        self._handle.set_dynamics(name)

    def dynamics(self) -> str:
        """Name of the dynamics, "engine" or "fast"."""
        return self._handle.dynamics()

    def set_integrator(self, name: str) -> None:
        """Choose how velocities and positions go on in a step; ValueError for an unknown name.

        - "engine" (default): semi-implicit Euler, joint damping and springs implicit, Coriolis forces explicit.
        - "implicit": the same with Coriolis forces implicit too, by their derivatives. Fast turning bodies and limp
          chains stay stable; energy falls.
        - "rk4": the classical Runge-Kutta method, of fourth order in the step; damping and springs explicit.
        - "variational": discrete Lagrangian mechanics, of second order; energy stays near its value for ever.

        The last two are for skeletons that move freely: where in a step a contact, a limit or another constraint acts
        on a skeleton, a joint's motion is prescribed or the method finds no solution, the skeleton takes the engine's
        rule in that step; `Skeleton.integrator_fallbacks` counts these. Soft bodies always do. All but "engine" need
        the dynamics "fast", else ValueError.
        """
        self._handle.set_integrator(name)

    def integrator(self) -> str:
        """Name of the integrator, "engine", "implicit", "rk4" or "variational"."""
        return self._handle.integrator()

    def set_constraint_solver(self, name: str, **options: float | str) -> None:
        """Choose the code that solves contacts and constraints; ValueError for an unknown name.

        "fast" (default) and "dart", the engine's own, which gives bitwise the same states and contact forces. The
        environment variable ``PYDART2_SOLVER`` names the one that new worlds start with.

        "iterative" sweeps over the rows of all contacts and constraints until they agree: its time grows with their
        number, not with the cube of it, and its results are approximate. It switches set_warm_start() and
        set_contact_reduction() on, the others switch them off. Its options (a TypeError for others):

        ========================== ======================================================================
        `iterations` = 50          sweeps in a step, at most
        `tolerance` = 1e-6         m/s, rad/s: the sweeps end when none changes a velocity by more
        `friction` = "pyramid"     each of two tangents within mu times the normal force, so that along their
                                   diagonal it reaches sqrt(2) times that; "cone": both together; "engine": bounds
                                   from the normal forces without friction, which the engine takes
        `stabilisation` = "split"  depth is taken away by moving the bodies, which their velocities do not see;
                                   "engine": by velocities, at 1 mm/s at most
        `error_reduction` = 0.2    part of the depth that a step of "split" takes away
        `allowance` = 1e-4         m: depth that "split" leaves
        `correction_speed` = 1     m/s: "split" is not faster
        ========================== ======================================================================

        Groups with soft bodies, or constraints of other classes than the engine's, are solved as by "fast".
        """
        unknown = [option for option in options if option not in _ITERATIVE]
        if unknown or (options and name != "iterative"):
            known = ", ".join(_ITERATIVE) if name == "iterative" else "none"
            raise TypeError(f"solver {name!r} has no option {(unknown or list(options))[0]!r}; its options: {known}")
        numbers = [_option_number(option, value) for option, value in (_ITERATIVE | options).items()]
        before = self._handle.constraint_solver()
        if name == "iterative":
            self._handle.set_iterative_options(np.array(numbers))
        else:
            self._handle.set_constraint_solver(name)
        if "iterative" in (before, name) and before != name:
            self._handle.set_warm_start(name == "iterative")
            self._handle.set_contact_reduction(name == "iterative")

    def constraint_solver(self) -> str:
        """Name of the constraint solver, "fast", "dart" or "iterative"."""
        return self._handle.constraint_solver()

    def constraint_solver_options(self) -> dict[str, float | str]:
        """The options of the constraint solver; none of "fast" and "dart"."""
        if self.constraint_solver() != "iterative":
            return {}
        values: dict[str, float | str] = dict(zip(_ITERATIVE, self._handle.iterative_options().tolist(), strict=True))
        values["iterations"] = int(values["iterations"])
        for option, names in _ITERATIVE_NAMES.items():
            values[option] = names[int(values[option])]
        return values

    def solver_iterations(self) -> int:
        """How many sweeps the "iterative" solver made in the last step, in the group with the most; else 0."""
        return self._handle.solver_iterations()

    def solver_residual(self) -> float:
        """How far the last step's forces of the "iterative" solver are from a solution, in m/s (rad/s for joints).

        The largest over the rows of ``W |x - P(x - w / W)|``: impulse x, velocity w that is left, the velocity W that a
        unit impulse gives, and P what brings an impulse within its bounds or into the friction cone.
        """
        return self._handle.solver_residual()

    def set_deterministic(self, enable: bool = True) -> None:
        """Make each step a function of the state alone, by forgetting first what detectors and constraints remember.

        The order of contacts is then not the engine's, and a step of `skel/fullbody1.skel` takes 0.2 ms more. With a
        warm start the state is that of a snapshot, which `x` is not.
        """
        self._handle.set_deterministic(enable)

    def is_deterministic(self) -> bool:
        """Whether each step is a function of the state alone."""
        return self._handle.deterministic()

    def set_blow_up(self, manner: str) -> None:
        """Choose what a step does whose numbers become infinite: "raise" (default) a SimulationError, or "nan".

        With "nan" the skeletons concerned read NaN in `q`, `dq`, `ddq` and `x` from then on, as older code awaits that
        asks ``np.isfinite(skel.q).all()``. Forces and commands that are set on them are ignored, further steps change
        the time alone, the other skeletons stay. reset(), restore(), set_states(), or a new `q` of the skeleton bring
        them back. Clones, pickles and batches have the setting; a world that reads NaN cannot be copied.
        """
        if manner not in ("raise", "nan"):
            raise ValueError(f'a step that blows up can "raise" or give "nan", got {manner!r}')
        self._handle.set_nan_at_blow_up(manner == "nan")

    def blow_up(self) -> str:
        """What a step does whose numbers become infinite: "raise" or "nan"."""
        return "nan" if self._handle.nan_at_blow_up() else "raise"

    def set_contact_reduction(self, enable: bool = True) -> None:
        """Let at most four contacts of each pair of faces bear forces, those that span the largest area.

        Off by default, on with "iterative". Faster where bodies meet in many points, but the results are no longer the
        engine's: the forces of a face spread over other points. The other contacts stay in `collision_result`, with
        force 0. With "iterative" and the "native" detector it changes nothing: that has four a pair of shapes.
        """
        self._handle.set_contact_reduction(enable)

    def contact_reduction(self) -> bool:
        """Whether contacts of a pair of faces are reduced to four."""
        return self._handle.contact_reduction()

    def set_warm_start(self, enable: bool = True) -> None:
        """Let the "fast" or "iterative" solver begin the search for the contact forces from those of the step before.

        Off by default, on with "iterative". Faster where many contacts last, but the forces of "fast" are the engine's
        to rounding only (nearer to the solution where the engine's direct solver gives up): what rests stays where it
        is, what tumbles takes another path after a while. What is remembered of the step
        before is in a snapshot; reset() forgets it.
        """
        self._handle.set_warm_start(enable)

    def warm_start(self) -> bool:
        """Whether the search for the contact forces begins from those of the step before."""
        return self._handle.warm_start()

    @property
    def max_contacts(self) -> int | None:
        """How many contacts a step takes; None, the default, for as many as there are.

        Bodies whose contacts are left out pass through each other; the first time that happens is a warning.
        """
        return self._handle.max_contacts() or None

    @max_contacts.setter
    def max_contacts(self, most: int | None) -> None:
        self._handle.set_max_contacts(0 if most is None else most or -1)

    @property
    def constraint_error_reduction(self) -> float:
        """The share of what ball, weld and revolute constraints are off that a step takes away, 0 to 1.

        0.01, the engine's, holds a fast four-bar to a millimetre or two at 1 ms; 0.2 to a tenth of that.
        """
        return self._handle.constraint_error_reduction()

    @constraint_error_reduction.setter
    def constraint_error_reduction(self, share: float) -> None:
        self._handle.set_constraint_error_reduction(share)

    @property
    def contact_memory_limit(self) -> float:
        """Bytes that the equations of one group of touching bodies may take, 1e9 unless set.

        The exact solvers need 16 bytes for each pair of rows, three rows a contact. A step that needs more is a
        SimulationError, and takes nothing.
        """
        return self._handle.contact_memory_limit()

    @contact_memory_limit.setter
    def contact_memory_limit(self, limit: float) -> None:
        self._handle.set_contact_memory_limit(limit)

    # Recording

    def is_recording(self) -> bool:
        """Whether steps are recorded; by default they are."""
        return self._handle.is_recording()

    def set_recording(self, enable: bool) -> None:
        """Record steps or not. Switching on records the present state; switching off forgets the frames."""
        self._handle.set_recording(enable)
        if not enable:
            self.recording = None
        elif self.recording is None:
            self.recording = Recording(self)

    def enable_recording(self) -> None:
        """Record steps from now on."""
        self.set_recording(True)

    def disable_recording(self) -> None:
        """Record no steps, and forget the frames."""
        self.set_recording(False)

    def num_frames(self) -> int:
        """Frames since the last reset, that is, steps + 1; 0 if not recording."""
        return self._handle.num_frames()

    @property
    def nframes(self) -> int:
        """Frames since the last reset, that is, steps + 1; 0 if not recording."""
        return self._handle.num_frames()

    def set_frame(self, frame_index: int) -> bool:
        """Put the states and contacts of a recorded frame back; False if it is not kept. `t` and `frame` stay."""
        if not self._handle.set_frame(frame_index):
            return False
        self.collision_result = CollisionResult.from_rows(self, self._handle.frame_contacts(frame_index))
        return True

    # Drawing, where an OpenGL context is current; pydart2.gui.render() makes pictures without one

    def render(
        self,
        render_markers: bool = True,
        render_contacts: bool = True,
        render_contact_size: float = 0.01,
        render_contact_force_scale: float = -0.005,
    ) -> None:
        """Draw the world with the current OpenGL context and matrices.

        Parameters
        ----------
        render_contact_size
            Radius of the dots, m.
        render_contact_force_scale
            Length of the arrows, m/N; negative for the force on the second body.
        """
        screen.draw("world", self, render_markers, render_contacts, render_contact_size, render_contact_force_scale)

    def render_markers(self) -> None:
        """Draw the markers with the current OpenGL context and matrices."""
        screen.draw("markers", self)

    def render_contacts(self, render_contact_size: float = 0.01, render_contact_force_scale: float = -0.005) -> None:
        """Draw the contacts with the current OpenGL context and matrices; the arguments are those of `render`."""
        screen.draw("contacts", self, render_contact_size, render_contact_force_scale)

    def __repr__(self) -> str:
        try:
            return f"[World ID:{self.id} time:{self.t:.4f} # frames: {self.num_frames()}]"
        except DestroyedError:
            return f"[World ID:{self.id} destroyed]"
