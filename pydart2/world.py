"""Worlds: skeletons, time, collisions and recording."""

from __future__ import annotations

import logging
import os
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, ClassVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pydart2 import constraints, contact_forces, manager, screen, telling
from pydart2._native import WorldHandle
from pydart2.alias import Settable, forwards
from pydart2.assignment import Assignable
from pydart2.building.worlds import WorldBuilding
from pydart2.collision_filter import CollisionFilter, WorldFilter, part_of
from pydart2.collision_result import CollisionResult
from pydart2.errors import DestroyedError
from pydart2.exporting.methods import SavedWorld
from pydart2.queries import WorldQueries
from pydart2.simulation.copies import Copies, rebuild
from pydart2.simulation.members import Members
from pydart2.simulation.recorded import Recorded
from pydart2.simulation.sleeping import WorldSleeping
from pydart2.simulation.step_options import StepOptions
from pydart2.simulation.step_options import detector_number as detector_number
from pydart2.simulation.up import Axis, Upright, check, is_z_up
from pydart2.skeleton import Skeleton, _compute_of

if TYPE_CHECKING:
    from typing import Any

    from pydart2.bodynode import BodyNode
    from pydart2.cameras import MountedCamera
    from pydart2.constraints import Constraint
    from pydart2.loading import Missing, Reader, Source
    from pydart2.recording import Recording

_log = logging.getLogger("pydart2")


def create_world(step: float, skel_path: str | os.PathLike[str] | None = None) -> World:
    """A world with a time step in s, and the content of a SKEL file if one is given."""
    return World(step, skel_path)


_rebuild = rebuild  # as pickles of pydart2 1.0 have it


class World(
    WorldBuilding,
    Members,
    Upright,
    StepOptions,
    WorldSleeping,
    WorldFilter,
    WorldQueries,
    Copies,
    Recorded,
    SavedWorld,
    Assignable,
):
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
    packages, missing_meshes, safe, reader, massless, engine_defaults, strict, load_seconds
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
        load_seconds: float | None = None,
    ) -> None:
        check(up)
        if isinstance(step, (str, bytes, os.PathLike)):
            raise TypeError(f"the time step comes first, in s: World(0.001, {step!r})")
        model = skel_path
        if model is not None:
            from pydart2.loading import Options, read_model  # a third of the time to import pydart2

            options = Options(packages, missing_meshes, safe, xmlstr, reader, massless, engine_defaults, strict)
            options.load_seconds = load_seconds
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
        else:
            self.constraint_error_reduction = 0.2
        self._begin()
        for i in range(self._handle.num_skeletons()):
            self.add_skeleton_from_id(i)._z_up = model is not None and is_z_up(model)
        self.keyframes: dict[str, NDArray[np.float64]] = model.keyframes if model is not None else {}
        self._cameras.update(model.cameras(self, still=True) if model is not None else {})
        self.reset()
        self.enable_recording()

    def _begin(self) -> None:
        self.id: int = self._handle.id()
        self._step: Callable[[int], None] = self._handle.step  # bound once: finding it anew is 1 % of a short step
        self.control_skel: Skeleton | None = None
        self.recording: Recording | None = None
        self.skeletons: list[Skeleton] = []
        self._cameras: dict[str, MountedCamera] = {}
        self._controlled: list[tuple[Skeleton, Callable[[], ArrayLike]]] = []
        self.collision_result = CollisionResult(self)
        self.collision_filter = CollisionFilter(self)
        manager.count(self)

    def destroy(self) -> None:
        """Free the world; any later use of it or of what is in it raises DestroyedError."""
        self._handle.destroy()

    @property
    def skel(self) -> Skeleton | None:
        """`control_skel`."""
        return self.control_skel

    # Time

    @forwards()
    def time(self) -> float:
        """Simulated time, s."""
        return self._handle.time()

    def set_time(self, time: float) -> None:
        """Set the simulated time, s."""
        self._handle.set_time(time)

    t = Settable(time, set_time)

    @forwards()
    def time_step(self) -> float:
        """Time step, s."""
        return self._handle.time_step()

    def set_time_step(self, _time_step: float) -> None:
        """Set the time step, s, > 0."""
        self._handle.set_time_step(_time_step)

    dt = Settable(time_step, set_time_step)

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

    def contacts_between(self, a: BodyNode | Skeleton | str, b: BodyNode | Skeleton | str) -> contact_forces.Contacts:
        """The contacts of two bodies or skeletons, or those of a name, in the last step as arrays, from `a`'s side."""
        return contact_forces.between(part_of(self.skeletons, a), part_of(self.skeletons, b))

    @forwards(None)
    def states(self, out: NDArray[np.float64] | None = None) -> NDArray[np.float64]:
        """[q, dq] of each skeleton, one after another, shape (2 * sum of ndofs,), rad, m, rad/s and m/s."""
        return self._handle.states(out)

    def set_states(self, _x: ArrayLike) -> None:
        """Set [q, dq] of each skeleton, one after another, shape (2 * sum of ndofs,), rad, m, rad/s and m/s."""
        self._handle.set_states(_x)

    x = Settable(states, set_states)

    # Gravity, constraints, pairs that pass through each other

    @forwards()
    def gravity(self) -> NDArray[np.float64]:
        """Gravity, shape (3,), m/s²."""
        return self._handle.gravity()

    def set_gravity(self, _g: ArrayLike) -> None:
        """Set gravity, shape (3,), m/s². `up` follows it, unless the world was made with one."""
        self._handle.set_gravity(_g)
        self._has_gravity = True

    g = Settable(gravity, set_gravity)

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

    def __str__(self) -> str:
        return telling.about_world(self)

    def _repr_pretty_(self, printer: Any, cycle: bool) -> None:
        printer.text(str(self))

    def _repr_png_(self) -> bytes | None:
        return telling.picture_of_world(self)

    def __repr__(self) -> str:
        try:
            return f"[World ID:{self.id} time:{self.t:.4f} # frames: {self.num_frames()}]"
        except DestroyedError:
            return f"[World ID:{self.id} destroyed]"
