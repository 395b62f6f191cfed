"""Many worlds of one model, stepped side by side on all processors."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pydart2._native import BatchHandle
from pydart2.given import numbers
from pydart2.inverse_kinematics import IKResults, Target, solve_each
from pydart2.memory import available_bytes, resident_bytes
from pydart2.skel_vector import DofArray

if TYPE_CHECKING:
    from pydart2.skeleton import Skeleton
    from pydart2.world import World

Array = NDArray[np.float64]
_CONTACT_COLUMNS = 16  # contact.hpp


@dataclass(frozen=True)
class Trajectories:
    """What rollout() found, for N worlds and T actions.

    Attributes
    ----------
    states : array, shape (N, T + 1, 2 * sum of ndofs)
        At the start and after each action, as World.states(); NaN from where a world failed.
    q, dq : arrays, shape (N, T + 1, ndofs)
        Those of the batch's skeleton, with names: ``q["j_knee"]`` has shape (N, T + 1).
    failed : dict of int to str
        Why a world stopped, by its index.
    """

    states: Array
    q: DofArray
    dq: DofArray
    failed: dict[int, str]

    def __repr__(self) -> str:
        worlds, frames = self.states.shape[:2]
        dofs = self.q.shape[-1]
        return f"[Trajectories: {worlds} worlds, {frames - 1} actions, {dofs} dofs, {len(self.failed)} failed]"


def _clones(world: World, n: int) -> list[World]:
    """Clones; ValueError as soon as it shows that there is no memory for so many."""
    worlds: list[World] = []
    before = resident_bytes()
    for made in range(n):
        if made >= 16 and made & (made - 1) == 0:  # each power of two
            each = (resident_bytes() - before) / made
            needed, free = each * (n - made), available_bytes()
            if needed > free:
                take = f"{n} worlds of {each / 1e6:.2g} MB each are {each * n / 1e9:.3g} GB"
                raise ValueError(f"{take}, and {free / 1e9:.3g} GB are free; make a smaller batch")
        worlds.append(world.clone())
    return worlds


class Batch:
    """N copies of a world, stepped side by side; arrays have one row per world.

    >>> batch = pydart2.Batch(world, 64)
    >>> batch.set_friction("h_heel_left", np.linspace(0.2, 1.0, 64))
    >>> batch.tau = actions                  # (64, ndofs)
    >>> batch.step()
    >>> batch.q["j_shin_left"]               # (64,)

    The worlds are clones that record nothing. Numbers are bit for bit those of one world alone, whatever the number of
    threads. A world whose simulation blows up stays as it was, is named in `failed`, and stands still until reset();
    the others go on.

    Parameters
    ----------
    world
        What the worlds are copies of. No controller may be set: the steps run in C++ without Python.
    n
        How many worlds; ValueError if there is no memory for them.
    threads
        How many threads; default: as many as there are processors. The ODE detector allows only one.
    skeleton
        Index or name of the skeleton that `q`, `dq`, `tau`, names of bodies and dofs, and actions are of; default: the
        last. IndexError or NameNotFound if there is none.

    Attributes
    ----------
    worlds : list of World
        For everything that is not an array here: ``batch.worlds[3].skeletons[0].body("floor")``.
    """

    def __init__(self, world: World, n: int, threads: int | None = None, skeleton: int | str = -1) -> None:
        if not isinstance(n, (int, np.integer)):
            raise TypeError(f"a batch is of a world and how many: Batch(world, 64), not {n!r}")
        if n < 1:
            raise ValueError(f"a batch needs one world or more, got {n}")
        self._begin(_clones(world, n), threads or len(os.sched_getaffinity(0)), skeleton)
        self._start = self.worlds[0].snapshot()

    def _begin(self, worlds: list[World], threads: int, skeleton: int | str) -> None:
        self.worlds = worlds
        self._handle = BatchHandle(threads)
        for world in worlds:
            if any(skel.controller is not None for skel in world.skeletons):
                raise ValueError("a batch runs no controllers: set them to None and give forces with batch.tau")
            world.disable_recording()
            self._handle.add(world._handle)
        self._index = worlds[0].skeleton(skeleton).id
        self._tau = np.zeros((len(worlds), self.skeleton.ndofs))

    @property
    def skeleton(self) -> Skeleton:
        """The skeleton of the first world that `q`, `dq` and so on are of.

        A property, unlike `World.skeleton`: others are ``batch.worlds[0].skeleton("box")``.
        """
        return self.worlds[0].skeletons[self._index]

    @property
    def threads(self) -> int:
        """How many threads there are."""
        return self._handle.num_threads()

    def __len__(self) -> int:
        return len(self.worlds)

    # Steps

    def step(self, n: int = 1, out: Array | None = None) -> None:
        """Simulate `n` time steps of every world that has not failed; `out`, of the shape of `x`, gets the states.

        Ctrl-C ends it after the steps that the worlds are in; ``batch.worlds[i].frame`` says how far each is.
        """
        try:
            self._handle.step(n)
        finally:
            for world in self.worlds:
                world.collision_result.update()
        if out is not None:
            self._handle.states(out)

    @property
    def failed(self) -> dict[int, str]:
        """Why worlds have stopped, by their index; empty if all go on."""
        return {i: error for i, error in enumerate(self._handle.errors()) if error}

    def reset(self, worlds: Sequence[int] | None = None) -> None:
        """Put the start state back, in all worlds or in some; those that failed go on again.

        The start state is that of the world that the batch was made from. Parameters stay as they are.
        """
        for i in range(len(self)) if worlds is None else worlds:
            self.worlds[i].restore(self._start, strict=False)
            self._handle.set_error(i, "")

    def rollout(
        self,
        initial_states: ArrayLike | None,
        actions: ArrayLike,
        hold: int = 1,
        progress: Callable[[int, int], object] | None = None,
        out: Array | None = None,
    ) -> Trajectories:
        """Simulate all worlds from given states under given forces, in one call.

        The worlds are reset first, so that the same call gives the same numbers again, bit for bit.

        Parameters
        ----------
        initial_states
            As `x`, shape (N, 2 * sum of ndofs), or of one world for all of them; None for the start state.
        actions
            Generalized forces of the batch's skeleton, shape (N, T, ndofs), or (T, ndofs) for all worlds.
        hold
            How many steps each action is held for.
        progress
            Called as ``progress(done, T)`` about a hundred times; an exception in it ends the rollout.
        out
            Where the states go, float64 of shape (N, T + 1, 2 * sum of ndofs); default: a new array.
        """
        self.reset()
        if initial_states is not None:
            self.x = _rows(initial_states, self.x.shape, "states")
        n, ndofs = len(self), self.skeleton.ndofs
        forces = numbers(actions, "actions")
        if forces.ndim not in (2, 3) or forces.shape[-1] != ndofs or (forces.ndim == 3 and len(forces) != n):
            raise ValueError(f"actions need shape ({n}, T, {ndofs}) or (T, {ndofs}), got {forces.shape}")
        times = forces.shape[-2]
        forces = np.broadcast_to(forces, (n, times, ndofs))
        states = np.empty((n, times + 1, self.x.shape[1])) if out is None else out
        if states.shape != (n, times + 1, self.x.shape[1]) or states.dtype != np.float64:
            raise ValueError(f"out needs shape {(n, times + 1, self.x.shape[1])} and float64, got {states.shape}")
        states[:] = np.nan
        states[:, 0] = self.x
        chunk = times if progress is None else max(1, times // 100)
        for begin in range(0, times, chunk or 1):
            end = min(begin + chunk, times)
            part = np.full((n, (end - begin) * states.shape[2]), np.nan)
            self._handle.rollout(self._index, forces[:, begin:end].reshape(n, -1), hold, part)
            states[:, begin + 1 : end + 1] = part.reshape(n, end - begin, -1)
            if progress is not None:
                progress(end, times)
        for world in self.worlds:
            world.collision_result.update()
        return self._trajectories(states)

    def _trajectories(self, states: Array) -> Trajectories:
        first = 2 * sum(skel.ndofs for skel in self.worlds[0].skeletons[: self._index])
        middle, last = first + self.skeleton.ndofs, first + 2 * self.skeleton.ndofs
        names = self.skeleton.names
        q, dq = DofArray.of(states[..., first:middle], names), DofArray.of(states[..., middle:last], names)
        return Trajectories(states, q, dq, self.failed)

    # States

    @property
    def x(self) -> Array:
        """States of all skeletons as World.states(), shape (N, 2 * sum of ndofs). A copy."""
        return self._handle.states(None)

    @x.setter
    def x(self, x: ArrayLike) -> None:
        self._handle.set_states(x)

    @property
    def q(self) -> DofArray:
        """Generalized positions, shape (N, ndofs), rad or m. A copy; a (ndofs,) that is set is for all worlds."""
        return DofArray.of(self._handle.positions(self._index, None), self.skeleton.names)

    @q.setter
    def q(self, q: ArrayLike | Mapping[str, ArrayLike]) -> None:
        self._handle.set_positions(self._index, self._rows(q, "positions", self.q))

    @property
    def dq(self) -> DofArray:
        """Generalized velocities, shape (N, ndofs), rad/s or m/s. A copy; a (ndofs,) that is set is for all worlds."""
        return DofArray.of(self._handle.velocities(self._index, None), self.skeleton.names)

    @dq.setter
    def dq(self, dq: ArrayLike | Mapping[str, ArrayLike]) -> None:
        self._handle.set_velocities(self._index, self._rows(dq, "velocities", self.dq))

    @property
    def tau(self) -> DofArray:
        """What was last set, zeros before; setting gives the forces of the next step, shape (N, ndofs), N m or N."""
        return DofArray.of(self._tau.copy(), self.skeleton.names)

    @tau.setter
    def tau(self, tau: ArrayLike | Mapping[str, ArrayLike]) -> None:
        rows = self._rows(tau, "forces", DofArray.of(np.zeros_like(self._tau), self.skeleton.names))
        self._handle.set_forces(self._index, rows)
        self._tau = np.array(rows)

    def _rows(self, values: ArrayLike | Mapping[str, ArrayLike], what: str, named: DofArray) -> Array:
        """One row per world, from rows, from one row for all, or from entries by name in the array `named`."""
        if isinstance(values, Mapping):
            for name, column in values.items():
                named[name] = column
            return np.asarray(named)
        return _rows(values, named.shape, what)

    # Observations

    @property
    def t(self) -> Array:
        """Simulated time, shape (N,), s."""
        return np.array([world.t for world in self.worlds])

    @property
    def C(self) -> Array:  # noqa: N802 (the field's name)
        """Centres of mass, world frame, shape (N, 3), m."""
        return np.array([skel.C for skel in self._skeletons()])

    @property
    def dC(self) -> Array:  # noqa: N802 (the field's name)
        """Velocities of the centres of mass, world frame, shape (N, 3), m/s."""
        return np.array([skel.dC for skel in self._skeletons()])

    def T(self, body: str | int) -> Array:  # noqa: N802 (the field's name)
        """Poses of a body in the world, shape (N, 4, 4), m."""
        return np.array([skel.body(body).T for skel in self._skeletons()])

    @property
    def num_contacts(self) -> NDArray[np.intp]:
        """How many contacts there were in the last step, shape (N,)."""
        return np.array([world.collision_result.num_contacts() for world in self.worlds], dtype=np.intp)

    @property
    def contacts(self) -> Array:
        """Contacts as CollisionResult.rows, shape (N, most contacts of a world, 16); NaN where a world has fewer."""
        found = [world.collision_result.rows for world in self.worlds]
        rows = np.full((len(self), max(map(len, found)), _CONTACT_COLUMNS), np.nan)
        for row, contacts in zip(rows, found):
            row[: len(contacts)] = contacts
        return rows

    # Inverse kinematics

    def inverse_kinematics(
        self, targets: Mapping[str, Target | ArrayLike], com: ArrayLike | None = None, **options: Any
    ) -> IKResults:
        """Skeleton.inverse_kinematics() in every world, on all threads, with its targets and options.

        >>> found = batch.inverse_kinematics({"l_hand": hands})  # (N, 3)
        >>> batch.q = found.q

        Positions have shape (3,) for all worlds or (N, 3), poses (4, 4) or (N, 4, 4), `com` and the entries of a Target
        likewise; `start` (ndofs,) or (N, ndofs), by default the present positions.
        """
        return solve_each(self._skeletons(), self.threads, targets, com, **options)

    # Parameters, one for each world or one for all

    def set_mass(self, body: str | int, masses: ArrayLike) -> None:
        """Set the mass of a body, kg: a number, or shape (N,)."""
        for skel, mass in self._each(masses):
            skel.body(body).set_mass(mass)

    def set_friction(self, body: str | int, coefficients: ArrayLike) -> None:
        """Set the dimensionless friction coefficient of a body: a number, or shape (N,)."""
        for skel, coefficient in self._each(coefficients):
            skel.body(body).set_friction_coeff(coefficient)

    def set_restitution(self, body: str | int, coefficients: ArrayLike) -> None:
        """Set the restitution coefficient of a body, 0 to 1: a number, or shape (N,)."""
        for skel, coefficient in self._each(coefficients):
            skel.body(body).set_restitution_coeff(coefficient)

    def set_damping(self, dof: str | int, coefficients: ArrayLike) -> None:
        """Set the damping of a dof, N m s/rad or N s/m: a number, or shape (N,)."""
        for skel, coefficient in self._each(coefficients):
            skel.dof(dof).set_damping_coefficient(coefficient)

    def set_stiffness(self, dof: str | int, coefficients: ArrayLike) -> None:
        """Set the spring stiffness of a dof, N m/rad or N/m: a number, or shape (N,)."""
        for skel, coefficient in self._each(coefficients):
            skel.dof(dof).set_spring_stiffness(coefficient)

    def _skeletons(self) -> list[Skeleton]:
        return [world.skeletons[self._index] for world in self.worlds]

    def _each(self, values: ArrayLike) -> list[tuple[Skeleton, float]]:
        given = numbers(values, "values")
        if given.shape not in ((), (len(self),)):
            raise ValueError(f"give one number, or one for each of the {len(self)} worlds; got shape {given.shape}")
        return list(zip(self._skeletons(), np.broadcast_to(given, len(self)).tolist()))

    def __reduce__(self) -> tuple[Any, ...]:
        errors = self._handle.errors()
        return _rebuild, (type(self), self.worlds, self.threads, self._index, self._start, self._tau, errors)

    def __repr__(self) -> str:
        return f"[Batch of {len(self)} worlds: {len(self.failed)} failed, {self.threads} threads]"


def _rows(values: ArrayLike, shape: tuple[int, ...], what: str) -> Array:
    """One row per world, of rows or of one row for all."""
    rows = numbers(values, what)
    if rows.shape not in (shape, shape[1:]):
        raise ValueError(f"{what} needs shape {shape}, or {shape[1:]} for all worlds, got {rows.shape}")
    return np.broadcast_to(rows, shape)


def _rebuild(
    cls: type[Batch], worlds: list[World], threads: int, index: int, start: Any, tau: Array, errors: list[str]
) -> Batch:
    batch = cls.__new__(cls)
    batch._begin(worlds, threads, index)
    batch._start, batch._tau = start, tau
    for i, error in enumerate(errors):
        batch._handle.set_error(i, error)
    return batch
