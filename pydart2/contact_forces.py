"""The contacts of one body, one skeleton or one pair, and the forces that they add up to."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pydart2.contact import Contact
from pydart2.given import numbers

if TYPE_CHECKING:
    from pydart2.bodynode import BodyNode
    from pydart2.skeleton import Skeleton
    from pydart2.world import World

Array = NDArray[np.float64]

_FIRST, _SECOND = slice(6, 8), slice(8, 10)  # skeleton and body id in a row of CollisionResult.rows


class Contacts:
    """Some contacts of the last step, seen from one side: as arrays, or one after another as Contact objects.

    >>> foot.contacts.force, foot.contacts.points

    Attributes
    ----------
    world : World
    points : array, shape (n, 3)
        World frame, m.
    forces : array, shape (n, 3)
        On the side that was asked for, world frame, N.
    normals : array, shape (n, 3)
        Unit normals towards that side, world frame.
    depths : array, shape (n,)
        Penetration depths, m.
    ids : array of int, shape (n, 4)
        Ids of skeleton and body on that side, then on the other; -1 where there is none.
    """

    _skeletons: tuple[Skeleton, ...] | None = None  # that the ids are about; None, as in old pickles: the world's now

    def __init__(self, world: World, rows: Array, turned: NDArray[np.bool_]) -> None:
        """`rows` as of CollisionResult.rows; `turned` where the second body is the side that was asked for, (n,)."""
        self.world = world
        self._rows = rows
        self._skeletons = tuple(world.skeletons)
        sign = np.where(turned, -1.0, 1.0)[:, None]
        self.points: Array = rows[:, 0:3].copy()
        self.forces: Array = sign * rows[:, 3:6]
        self.normals: Array = sign * rows[:, 12:15]
        self.depths: Array = rows[:, 15].copy()
        ids = rows[:, 6:10].astype(int)
        self.ids = np.where(turned[:, None], ids[:, [2, 3, 0, 1]], ids)

    @property
    def bodies(self) -> NDArray[np.int_]:
        """The same as `ids`, shape (n, 4)."""
        return self.ids

    def __len__(self) -> int:
        return len(self._rows)

    def __getitem__(self, index: int) -> Contact:
        rows = self._rows[index][None]
        return Contact.from_rows(self.world, rows, self._skeletons or tuple(self.world.skeletons))[0]

    @property
    def force(self) -> Array:
        """The sum of the forces, world frame, shape (3,), N."""
        return np.asarray(self.forces.sum(axis=0))

    def moment(self, about: ArrayLike) -> Array:
        """The sum of the moments about a point of the world, shape (3,), N m."""
        return np.asarray(np.cross(self.points - numbers(about, "a point"), self.forces).sum(axis=0))

    def centre_of_pressure(self) -> Array | None:
        """Where the forces along the normals have no moment, world frame, shape (3,), m; None without any force.

        The mean of the points, weighted by what presses at each: exact for contacts in one plane.
        """
        pressing = np.maximum(np.einsum("ij,ij->i", self.forces, self.normals), 0.0)
        total = pressing.sum()
        return None if total == 0.0 else np.asarray(pressing @ self.points / total)

    def support_polygon(self) -> Array:
        """The convex hull of the points seen along gravity, in order around it, world frame, shape (k, 3), m.

        All points that are left if it has no area, fewer than 3.
        """
        down = self.world.gravity()
        if len(self) == 0 or not np.any(down):
            return np.empty((0, 3))
        _, _, axes = np.linalg.svd(down[None, :])
        flat = self.points @ axes[1:].T
        return self.points[_hull(flat)]

    def __repr__(self) -> str:
        return f"[Contacts: {len(self)}, force {self.force} N]"


def of_body(body: BodyNode) -> Contacts:
    """Those of one body."""
    return _select(body.skeleton.world, (body.skeleton.id, body.id), None)


def of_skeleton(skel: Skeleton) -> Contacts:
    """Those of a skeleton."""
    return _select(skel.world, (skel.id, None), None)


def between(a: BodyNode | Skeleton, b: BodyNode | Skeleton) -> Contacts:
    """Those of a with b."""
    return _select(a.world, _ids(a), _ids(b))


def _ids(part: BodyNode | Skeleton) -> tuple[int, int | None]:
    skeleton = getattr(part, "skeleton", None)
    return (part.id, None) if skeleton is None else (skeleton.id, part.id)


def _select(world: World, side: tuple[int, int | None], other: tuple[int, int | None] | None) -> Contacts:
    rows = world.collision_result.rows
    first, second = _is(rows[:, _FIRST], side), _is(rows[:, _SECOND], side)
    if other is not None:
        first, second = first & _is(rows[:, _SECOND], other), second & _is(rows[:, _FIRST], other)
    # A contact of two bodies of one skeleton is there from both sides: what it does to the whole is nothing.
    chosen = np.concatenate([np.flatnonzero(first), np.flatnonzero(second)])
    turned = np.arange(len(chosen)) >= first.sum()
    order = np.argsort(chosen, kind="stable")
    return Contacts(world, rows[chosen[order]], turned[order])


def of_world(world: World) -> Contacts:
    """All, each from the side of its first body."""
    rows = world.collision_result.rows
    return Contacts(world, rows, np.zeros(len(rows), dtype=bool))


def _is(ids: Array, part: tuple[int, int | None]) -> NDArray[np.bool_]:
    skeleton, body = part
    same = ids[:, 0] == skeleton
    return np.asarray(same if body is None else same & (ids[:, 1] == body))


def _hull(points: Array) -> list[int]:
    """Indices of the convex hull of points in the plane, counterclockwise (Andrew's monotone chain)."""
    order = np.lexsort((points[:, 1], points[:, 0])).tolist()

    def half(indices: list[int]) -> list[int]:
        chain: list[int] = []
        for i in indices:
            while len(chain) > 1:
                a, b = points[chain[-1]] - points[chain[-2]], points[i] - points[chain[-1]]
                if a[0] * b[1] - a[1] * b[0] > 1e-12:
                    break
                chain.pop()
            chain.append(i)
        return chain

    lower, upper = half(order), half(order[::-1])
    return list(dict.fromkeys(lower[:-1] + upper[:-1])) or order[:1]
