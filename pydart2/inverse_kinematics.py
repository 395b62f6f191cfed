"""Positions that put bodies where they should be."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from pydart2.skel_vector import SkelVector

if TYPE_CHECKING:
    from pydart2._native import InverseKinematicsHandle
    from pydart2.bodynode import BodyNode
    from pydart2.skeleton import Skeleton


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
    for body, target in targets.items():
        _add(problem, (skel.body(body) if isinstance(body, str) else _own(skel, body)).id, target)
    if com is not None:
        problem.add_target(-1, (0.0, 0.0, 0.0), com, None, 1.0)
    if dofs is not None:
        problem.set_dofs([skel.dof(dof).id for dof in dofs])
    if posture is not None:
        problem.set_posture(posture)
    found = problem.solve(skel.q if start is None else start, tolerance, iterations, restarts, seed)
    q = skel.q
    q[:] = found[:-4]
    residual, converged, used, steps = found[-4:]
    return IKResult(q, float(residual), bool(converged), int(used), int(steps))


def _own(skel: Skeleton, body: BodyNode) -> BodyNode:
    if body.skeleton is not skel:
        raise ValueError(f"{body!r} is not a body of {skel!r}")
    return body


def _add(problem: InverseKinematicsHandle, body: int, target: Target | ArrayLike) -> None:
    if not isinstance(target, Target):
        numbers = np.asarray(target, dtype=float)
        if numbers.shape == (4, 4):
            target = Target(position=numbers[:3, 3], rotation=numbers[:3, :3])
        elif numbers.shape == (3,):
            target = Target(position=numbers)
        else:
            raise ValueError(f"a target is a position (3,), a pose (4, 4) or a Target; got the shape {numbers.shape}")
    if target.position is None and target.rotation is None:
        raise ValueError("a Target needs a position, a rotation or both")
    problem.add_target(body, target.offset, target.position, target.rotation, target.weight)
