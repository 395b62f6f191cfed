"""Positions that put bodies where they should be."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pydart2.given import numbers
from pydart2.skel_vector import DofArray, SkelVector

if TYPE_CHECKING:
    from pydart2._native import InverseKinematicsHandle
    from pydart2.bodynode import BodyNode
    from pydart2.skeleton import Skeleton

_B = TypeVar("_B")


@dataclass(frozen=True, kw_only=True)
class Target:
    """Where a point of a body, its axes or both should be, in the world.

    Attributes
    ----------
    position
        Shape (3,), m; None for anywhere.
    rotation
        Axes of the body, shape (3, 3); None for any.
    offset
        The point in the body frame, shape (3,), m.
    weight
        How much it counts where not all targets can be reached, > 0.
    """

    position: ArrayLike | None = None
    rotation: ArrayLike | None = None
    offset: ArrayLike = (0.0, 0.0, 0.0)
    weight: float = 1.0


@dataclass(frozen=True)
class IKResult:
    """What inverse kinematics found.

    Attributes
    ----------
    q : SkelVector
        Positions within the limits, shape (ndofs,), rad or m; the best ones found if it did not converge.
    residual : float
        The largest distance (m) or angle (rad) that is left between a body and its target.
    converged : bool
        Whether that is within the tolerance.
    restarts : int
        How often it started again from random positions.
    iterations : int
        Steps in all.
    """

    q: SkelVector
    residual: float
    converged: bool
    restarts: int
    iterations: int

    def __repr__(self) -> str:
        how = "converged" if self.converged else "not converged"
        return f"[IKResult: {how}, {self.residual:.3g} m or rad left, {self.iterations} iterations]"


@dataclass(frozen=True)
class IKResults:
    """What inverse kinematics found in each of N worlds; see IKResult.

    Attributes
    ----------
    q : DofArray, shape (N, ndofs)
    residual : shape (N,)
    converged : shape (N,), of bool
    restarts, iterations : shape (N,), of int
    """

    q: DofArray
    residual: NDArray[np.float64]
    converged: NDArray[np.bool_]
    restarts: NDArray[np.intp]
    iterations: NDArray[np.intp]

    def __repr__(self) -> str:
        return f"[IKResults: {np.count_nonzero(self.converged)} of {len(self.converged)} converged]"


def solve(
    skel: Skeleton,
    targets: Mapping[str | BodyNode, Target | ArrayLike],
    com: ArrayLike | None = None,
    *,
    dofs: Iterable[str | int] | None = None,
    posture: ArrayLike | None = None,
    start: ArrayLike | None = None,
    tolerance: float = 1e-6,
    iterations: int = 100,
    restarts: int = 50,
    seed: int = 0,
) -> IKResult:
    """See Skeleton.inverse_kinematics(); arrays have the same shapes and units, q in rad or m."""
    problem = skel._handle.inverse_kinematics()
    if not targets and com is None:
        raise ValueError("inverse kinematics needs a target for a body or for the centre of mass")
    for body, target in _by_body(targets):
        _add(problem, skel._own_body(body).id, target)
    if com is not None:
        problem.add_target(-1, (0.0, 0.0, 0.0), com, None, 1.0)
    if dofs is not None:
        problem.set_dofs([skel.dof(dof).id for dof in dofs])
    if posture is not None:
        problem.set_posture(posture)
    q = skel.q
    found = np.empty((1, len(q) + 4))
    problem.solve(q if start is None else start, tolerance, iterations, restarts, seed, found)
    q[:] = found[0, :-4]
    residual, converged, used, steps = found[0, -4:]
    return IKResult(q, float(residual), bool(converged), int(used), int(steps))


def solve_each(
    skeletons: Sequence[Skeleton],
    threads: int,
    targets: Mapping[str, Target | ArrayLike],
    com: ArrayLike | None = None,
    *,
    start: ArrayLike | None = None,
    **options: Any,
) -> IKResults:
    """See Batch.inverse_kinematics(); arrays have the same shapes and units, q in rad or m."""
    from concurrent.futures import ThreadPoolExecutor  # a twentieth of the package's import

    count = len(skeletons)
    each = {body: _for_each(target, count) for body, target in _by_body(targets)}
    centres = None if com is None else _rows(com, count, 1)
    starts = None if start is None else _rows(start, count, 1)

    def one(i: int) -> IKResult:
        mine: dict[str | BodyNode, Target | ArrayLike] = {body: rows[i] for body, rows in each.items()}
        first = None if starts is None else starts[i]
        return solve(skeletons[i], mine, None if centres is None else centres[i], start=first, **options)

    with ThreadPoolExecutor(threads) as pool:
        found = list(pool.map(one, range(count)))
    return IKResults(
        DofArray.of(np.array([result.q for result in found]), skeletons[0].names),
        np.array([result.residual for result in found]),
        np.array([result.converged for result in found]),
        np.array([result.restarts for result in found], dtype=np.intp),
        np.array([result.iterations for result in found], dtype=np.intp),
    )


def _for_each(target: Target | ArrayLike, count: int) -> list[Target | ArrayLike]:
    """A target for each world, of what is one for all or has a row for each."""
    if not isinstance(target, Target):
        given = numbers(target, "a target")
        return list(_rows(given, count, 2 if given.shape[-2:] == (4, 4) else 1))
    places = [None] * count if target.position is None else _rows(target.position, count, 1)
    turns = [None] * count if target.rotation is None else _rows(target.rotation, count, 2)
    return [replace(target, position=place, rotation=turn) for place, turn in zip(places, turns)]


def _rows(values: ArrayLike, count: int, axes: int) -> NDArray[np.float64]:
    """One row of so many axes for each world."""
    given = numbers(values, "what is given for each world")
    if given.ndim not in (axes, axes + 1) or (given.ndim > axes and len(given) != count):
        raise ValueError(f"give what is the same in all {count} worlds, or a row for each; got the shape {given.shape}")
    return np.broadcast_to(given, (count, *given.shape[-axes:]))


def _by_body(targets: Mapping[_B, Target | ArrayLike]) -> Iterable[tuple[_B, Target | ArrayLike]]:
    if not isinstance(targets, Mapping):
        raise TypeError(f'targets are given by body, as {{"hand": [0.5, 0.0, 1.0]}}, not as {targets!r}')
    return targets.items()


def _add(problem: InverseKinematicsHandle, body: int, target: Target | ArrayLike) -> None:
    if not isinstance(target, Target):
        given = numbers(target, "a target")
        if given.shape == (4, 4):
            target = Target(position=given[:3, 3], rotation=given[:3, :3])
        elif given.shape == (3,):
            target = Target(position=given)
        else:
            raise ValueError(f"a target is a position (3,), a pose (4, 4) or a Target; got the shape {given.shape}")
    if target.position is None and target.rotation is None:
        raise ValueError("a Target needs a position, a rotation or both")
    problem.add_target(body, target.offset, target.position, target.rotation, target.weight)
