"""Questions about a world as it stands, which change nothing of it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pydart2._native import QueriesHandle, WorldHandle

if TYPE_CHECKING:
    from pydart2.bodynode import BodyNode
    from pydart2.skeleton import Skeleton
    from pydart2.state import Snapshot
    from pydart2.world import World

Array = NDArray[np.float64]


@dataclass(frozen=True)
class RayHits:
    """What rays hit first.

    The arrays have the leading shape of the rays: () for one, (n,) for n.

    Attributes
    ----------
    world : World
        Whose shapes they hit.
    distances : array, shape (...)
        From the origin, m; infinite where there is nothing.
    points : array, shape (..., 3)
        In the world, m; NaN where there is nothing.
    normals : array, shape (..., 3)
        Of the surface, outwards, of length 1; of the triangles of a mesh, to the side that the ray comes from.
    skeletons, bodies, shapes : array of int, shape (...)
        Index of the skeleton in the world, of the body in the skeleton, of the shape node in the body; -1 for none.
    """

    world: World
    distances: Array
    points: Array
    normals: Array
    skeletons: NDArray[np.intp]
    bodies: NDArray[np.intp]
    shapes: NDArray[np.intp]

    @property
    def hit(self) -> NDArray[np.bool_]:
        """Which rays hit something, shape (...); without unit."""
        return self.skeletons >= 0

    def body(self, index: int | tuple[int, ...] = ()) -> BodyNode | None:
        """The body that a ray hit, or None; without an index that of the only ray."""
        skeleton = int(self.skeletons[index])
        return None if skeleton < 0 else self.world.skeletons[skeleton].bodynodes[int(self.bodies[index])]


class Linearization(NamedTuple):
    """A step of a world with n dofs, ``x[k + 1] = A x[k] + B tau[k]`` for small changes; x is ``[q, dq]``."""

    A: Array  #: shape (2 n, 2 n)
    B: Array  #: shape (2 n, n), per N m or N


class WorldQueries:
    """What a World can be asked; nothing of the simulation changes."""

    _handle: WorldHandle
    _queries: QueriesHandle | None = None  # keeps what it made of the shapes

    def raycast(self, origins: ArrayLike, directions: ArrayLike, max_distance: float = np.inf) -> RayHits:
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

        Raises ValueError for a direction of length 0, for what is not finite, and for other shapes.
        """
        start, along = np.broadcast_arrays(np.asarray(origins, dtype=float), np.asarray(directions, dtype=float))
        if start.ndim not in (1, 2) or start.shape[-1] != 3:
            raise ValueError(f"origins and directions have the shape (3,) or (n, 3), got {start.shape}")
        if self._queries is None:
            self._queries = QueriesHandle(self._handle)
        rows = self._queries.raycast(start.reshape(-1, 3), along.reshape(-1, 3), float(max_distance))
        rows = rows.reshape(*start.shape[:-1], 10)
        skeletons, bodies, shapes = np.moveaxis(rows[..., 7:].astype(np.intp), -1, 0)
        world = cast("World", self)
        return RayHits(world, rows[..., 0], rows[..., 1:4], rows[..., 4:7], skeletons, bodies, shapes)

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
        if not 0.0 < change < 1.0:
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
