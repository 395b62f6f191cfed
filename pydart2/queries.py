"""Questions about a world as it stands, which change nothing of it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pydart2._native import QueriesHandle
from pydart2.collision_filter import Bodies, body_rows
from pydart2.contact_forces import Contacts
from pydart2.given import number, numbers
from pydart2.simulation.part import WorldPart

if TYPE_CHECKING:
    from pydart2.bodynode import BodyNode
    from pydart2.skeleton import Skeleton
    from pydart2.state import Snapshot
    from pydart2.world import World

Array = NDArray[np.float64]
Ids = NDArray[np.intp]


@dataclass(frozen=True)
class _Found:
    """What a question finds, as arrays."""

    world: World
    distances: Array
    points: Array
    normals: Array
    skeletons: NDArray[np.intp]
    bodies: NDArray[np.intp]
    shapes: NDArray[np.intp]


class SurfacePoints(_Found):
    """Points of shapes, found by rays or from points.

    The arrays have the leading shape of what was asked for: () for one, (n,) for n.

    Attributes
    ----------
    world : World
        Whose shapes they are.
    distances : array, shape (...)
        From the origin or point, m; infinite where there is nothing.
    points : array, shape (..., 3)
        In the world, m; NaN where there is nothing.
    normals : array, shape (..., 3)
        Of the surface, outwards, of length 1; of the triangles of a mesh, to the side from which they were found.
    skeletons, bodies, shapes : array of int, shape (...)
        Index of the skeleton in the world, of the body in the skeleton, of the shape node in the body; -1 for none.
    """

    @property
    def hit(self) -> NDArray[np.bool_]:
        """Where something was found, shape (...); without unit."""
        return self.skeletons >= 0

    def body(self, index: int | tuple[int, ...] = ()) -> BodyNode | None:
        """The body that was found, or None; without an index the only one."""
        return _body(self.world, int(self.skeletons[index]), int(self.bodies[index]))


class RayHits(SurfacePoints):
    """What rays hit first."""


class Distances(_Found):
    """Pairs of shapes and how far they are apart.

    The arrays have the leading shape () for one pair, (n,) for n.

    Attributes
    ----------
    world : World
        Whose shapes they are.
    distances : array, shape (...)
        Between the surfaces, m; below 0 the least way that parts two shapes that overlap; infinite for no pair.
    points : array, shape (..., 2, 3)
        Of the surfaces, this far apart, in the world, m; NaN for no pair.
    normals : array, shape (..., 3)
        From the second to the first, of length 1, in the world.
    skeletons, bodies, shapes : array of int, shape (..., 2)
        Index of the skeleton in the world, of the body in the skeleton, of the shape node in the body; -1 for no pair.
    """

    def pair(self, index: int | tuple[int, ...] = ()) -> tuple[BodyNode | None, BodyNode | None]:
        """The two bodies; without an index those of the only pair."""
        first, second = (
            _body(self.world, int(skel), int(body))
            for skel, body in zip(self.skeletons[index], self.bodies[index], strict=True)
        )
        return first, second

    def __len__(self) -> int:
        return len(self.distances)


def _body(world: World, skeleton: int, body: int) -> BodyNode | None:
    return None if skeleton < 0 else world.skeletons[skeleton].bodynodes[body]


class Linearization(NamedTuple):
    """A step of a world with n dofs, ``x[k + 1] = A x[k] + B tau[k]`` for small changes; x is ``[q, dq]``."""

    A: Array  #: shape (2 n, 2 n)
    B: Array  #: shape (2 n, n), per N m or N


class WorldQueries(WorldPart):
    """What a World can be asked; nothing of the simulation changes."""

    _queries: QueriesHandle | None = None  # keeps what it made of the shapes

    def raycast(
        self, origins: ArrayLike, directions: ArrayLike, max_distance: float = np.inf, *, ignore: Bodies = ()
    ) -> RayHits:
        """The first collision shape along each ray, as the bodies stand now, whatever the detector.

        >>> hit = world.raycast([0.0, 1.0, 0.0], [0.0, -1.0, 0.0])
        >>> hit.distances, hit.body()

        Solids are hit where a ray enters them: one that begins inside passes out of them. Meshes that bound a convex
        body of up to 512 corners are solids, the triangles of others are hit from both sides. Soft bodies are not hit.

        Parameters
        ----------
        origins, directions
            Shape (3,) or (n, 3), m, in the world; one of either serves all of the other. Directions of any length.
        max_distance
            What is farther away is not seen, m.
        ignore
            Bodies, skeletons or their names that rays pass through, as of exclude_collisions().

        Raises ValueError for a direction of length 0, for what is not finite, and for other shapes.
        """
        start, along = np.broadcast_arrays(numbers(origins, "origins"), numbers(directions, "directions"))
        if start.ndim not in (1, 2) or start.shape[-1] != 3:
            raise ValueError(f"origins and directions have the shape (3,) or (n, 3), got {start.shape}")
        rows = self._asked().raycast(
            start.reshape(-1, 3), along.reshape(-1, 3), max_distance, body_rows(self.skeletons, ignore)
        )
        return RayHits(*self._found(rows, start.shape[:-1]))

    def nearest(self, points: ArrayLike, max_distance: float = np.inf, *, ignore: Bodies = ()) -> SurfacePoints:
        """The nearest collision shape of each point and the point of its surface, as the bodies stand now.

        >>> world.nearest([0.3, 0.0, 1.0]).distances

        The distance is below 0 inside of planes, primitives and convex meshes. Soft bodies are not seen.

        Parameters
        ----------
        points
            Shape (3,) or (n, 3), m, in the world.
        max_distance
            What is farther away is not seen, m.
        ignore
            Bodies, skeletons or their names that are not seen, as of exclude_collisions().
        """
        places = numbers(points, "points")
        if places.ndim not in (1, 2) or places.shape[-1] != 3:
            raise ValueError(f"points have the shape (3,) or (n, 3), got {places.shape}")
        rows = self._asked().nearest(places.reshape(-1, 3), max_distance, body_rows(self.skeletons, ignore))
        return SurfacePoints(*self._found(rows, places.shape[:-1]))

    def distance(self, a: Bodies, b: Bodies, max_distance: float = np.inf) -> Distances:
        """The two nearest shapes of two sets of bodies, as the bodies stand now, whatever the detector.

        >>> near = world.distance("arm", ["table", "lamp"])
        >>> near.distances, near.points, near.pair()

        Bodies that a joint connects, and those that pass through each other by exclude_collisions() or
        set_collision_group(), are no pair. Shapes are the detector "native"'s: exact primitives, and meshes; of meshes
        that are not convex and touch, the distance is 0. Soft bodies are not seen.

        Parameters
        ----------
        a, b
            Bodies, skeletons or their names, as of exclude_collisions(); both may be the same robot.
        max_distance
            Pairs that are farther apart are not seen, m.
        """
        rows = self._asked().distances(*self._sides(a, b), max_distance, True)
        if len(rows) == 0:
            rows = np.array([[np.inf, *[np.nan] * 9, *[-1.0] * 6]])
        return self._distances(rows[0])

    def distances_within(self, a: Bodies, b: Bodies, max_distance: float) -> Distances:
        """All pairs of shapes of two sets of bodies that are no farther apart than `max_distance`, m.

        The nearest first; else as distance().
        """
        return self._distances(self._asked().distances(*self._sides(a, b), max_distance, False))

    def find_contacts(self, a: Bodies, b: Bodies) -> Contacts:
        """Where two sets of bodies touch, as they stand now: contacts without force, on the bodies of `a`.

        >>> world.find_contacts(hand, "cup").depths

        No step is made, and ``world.contacts`` stays. Which bodies are pairs, and their shapes, are as of distance().
        """
        rows = self._asked().contacts(*self._sides(a, b))
        return Contacts(cast("World", self), rows, np.zeros(len(rows), dtype=bool))

    def _asked(self) -> QueriesHandle:
        if self._queries is None:
            self._queries = QueriesHandle(self._handle)
        return self._queries

    def _sides(self, a: Bodies, b: Bodies) -> tuple[Array, Array]:
        return body_rows(self.skeletons, a), body_rows(self.skeletons, b)

    def _found(self, rows: Array, shape: tuple[int, ...]) -> tuple[World, Array, Array, Array, Ids, Ids, Ids]:
        rows = rows.reshape(*shape, 10)
        skeletons, bodies, shapes = np.moveaxis(rows[..., 7:].astype(np.intp), -1, 0)
        return cast("World", self), rows[..., 0], rows[..., 1:4], rows[..., 4:7], skeletons, bodies, shapes

    def _distances(self, rows: Array) -> Distances:
        points = rows[..., 1:7].reshape(*rows.shape[:-1], 2, 3)
        ids = rows[..., 10:].astype(np.intp).reshape(*rows.shape[:-1], 2, 3)
        skeletons, bodies, shapes = np.moveaxis(ids, -1, 0)
        return Distances(cast("World", self), rows[..., 0], points, rows[..., 7:10], skeletons, bodies, shapes)

    def linearize(self, change: float = 1e-6) -> Linearization:
        """How the next step depends on the state and on tau: A and B, for the dofs of all skeletons in their order.

        >>> A, B = world.linearize()

        Central differences of steps of a copy, all with the same contact memory. A change of q is one along dq, as of
        Skeleton.integrate_positions(). Where a contact begins or ends, or begins to slide, within `change`, there is no
        derivative, and the result is a mean of both sides. Controllers act in each step.

        Parameters
        ----------
        change
            Of each state and force, rad, m, rad/s, m/s, N m, N.
        """
        if not 0.0 < number(change, "change") < 1.0:
            raise ValueError(f"a change for differences is a small number > 0, got {change}")
        copy = cast("World", self).clone(exact=False)
        start, skeletons = copy.snapshot(), copy.skeletons
        columns: list[list[Array]] = [[], [], []]
        for kind, of_kind in enumerate(columns):
            for skel in skeletons:
                for dof in range(skel.ndofs):
                    of_kind.append(_difference(copy, start, skel, kind, dof, change))
        n = len(columns[0])
        by_q, by_dq, by_tau = (np.reshape(rows, (n, 2 * n)).T for rows in columns)
        return Linearization(np.hstack([by_q, by_dq]), by_tau)


def _difference(world: World, start: Snapshot, skel: Skeleton, kind: int, dof: int, change: float) -> Array:
    """Of the states after a step, per change of q, dq or tau (kind 0, 1, 2) of one dof."""
    ends = []
    for sign in (1.0, -1.0):
        world.restore(start)
        small = np.zeros(skel.ndofs)
        small[dof] = sign * change
        if kind == 0:
            skel.q = skel.integrate_positions(skel.q, small)
        elif kind == 1:
            skel.dq = skel.dq + small
        else:
            skel.tau = skel._handle.forces(np.empty(skel.ndofs)) + small  # of this step, not those that tau remembers
        world.step()
        ends.append([(item, np.array(item.q), np.array(item.dq)) for item in world.skeletons])
    pairs = list(zip(*ends, strict=True))
    q = [item.position_differences(after, before) for (item, after, _), (_, before, _) in pairs]
    dq = [after - before for (_, _, after), (_, _, before) in pairs]
    return np.concatenate(q + dq) / (2.0 * change)
