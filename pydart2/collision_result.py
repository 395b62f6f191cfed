"""The contacts of a collision pass."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from pydart2.contact import Contact

if TYPE_CHECKING:
    from pydart2.bodynode import BodyNode
    from pydart2.skeleton import Skeleton
    from pydart2.world import World

_COLUMNS = 16  # contact.hpp


class _Contacts:
    """What one collision pass found, with the skeletons that it is about; objects are made when someone wants them."""

    skeletons: tuple[Skeleton, ...] | None = None  # None, as in old pickles: those that the world has now

    def __init__(self, world: World, rows: NDArray[np.float64]) -> None:
        self.world = world
        self.rows = rows
        self.skeletons = tuple(world.skeletons)
        self._contacts: list[Contact] | None = None

    @property
    def contacts(self) -> list[Contact]:
        if self._contacts is None:
            self._contacts = Contact.from_rows(self.world, self.rows, self.skeletons or tuple(self.world.skeletons))
        return self._contacts

    @property
    def bodies(self) -> list[BodyNode]:
        bodies = (body for c in self.contacts for body in (c.bodynode1, c.bodynode2) if body is not None)
        return list(dict.fromkeys(bodies))


class CollisionResult:
    """The contacts of the last step; read from the engine when someone looks.

    Attributes
    ----------
    world : World
    id : int
        Id of the world.
    """

    def __init__(self, _world: World) -> None:
        self.world = _world
        self.id = _world.id
        self._looked: _Contacts | None = _Contacts(_world, np.empty((0, _COLUMNS)))  # None until someone looks

    @classmethod
    def from_rows(cls, _world: World, rows: NDArray[np.float64]) -> CollisionResult:
        """A result with packed contacts, shape (n, 16) in the units of `rows`, as of a recorded frame."""
        result = cls(_world)
        result._looked = _Contacts(_world, rows)
        return result

    def update(self) -> None:
        """Read the engine's last collision pass from now on."""
        self._looked = None

    def num_contacts(self) -> int:
        """How many contacts there are."""
        return self.world._handle.num_contacts() if self._looked is None else len(self._looked.rows)

    def num_contacted_bodies(self) -> int:
        """How many bodies touch another."""
        return len(self.contacted_bodies)

    @property
    def rows(self) -> NDArray[np.float64]:
        """The contacts as numbers, shape (n, 16), in the engine's order: point (3, m), force on the first body (3, N),
        skeleton and body id of both (4), shape id of both (2), normal (3), penetration depth (m). A copy."""
        return self._look().rows.copy()

    @property
    def points(self) -> NDArray[np.float64]:
        """Where the contacts are, world frame, shape (n, 3), m."""
        return self._look().rows[:, 0:3].copy()

    @property
    def forces(self) -> NDArray[np.float64]:
        """The forces on the first bodies, world frame, shape (n, 3), N."""
        return self._look().rows[:, 3:6].copy()

    @property
    def normals(self) -> NDArray[np.float64]:
        """Unit normals towards the first bodies, world frame, shape (n, 3)."""
        return self._look().rows[:, 12:15].copy()

    @property
    def depths(self) -> NDArray[np.float64]:
        """Penetration depths, shape (n,), m."""
        return self._look().rows[:, 15].copy()

    @property
    def bodies(self) -> NDArray[np.int_]:
        """Ids of skeleton and body of the first, then of the second, shape (n, 4), no unit; -1 where there is none."""
        return self._look().rows[:, 6:10].astype(int)

    @property
    def contacts(self) -> list[Contact]:
        """The contacts in the engine's order."""
        return self._look().contacts

    @property
    def contacted_bodies(self) -> list[BodyNode]:
        """The bodies that touch another, each once, in the order of the contacts."""
        return self._look().bodies

    @property
    def contact_sets(self) -> list[tuple[BodyNode | None, BodyNode | None]]:
        """The pairs of bodies that touch, each once, in the order of the contacts."""
        return list(dict.fromkeys((c.bodynode1, c.bodynode2) for c in self.contacts))

    def copy(self) -> CollisionResult:
        """The contacts as they are now; later steps do not change them."""
        return CollisionResult.from_rows(self.world, self._look().rows)

    def clear(self) -> None:
        """Forget the contacts."""
        self._looked = _Contacts(self.world, np.empty((0, _COLUMNS)))

    def _forget_skeleton(self, index: int) -> None:
        """Keep naming the right bodies when a skeleton goes: -1 where it was, and new ids for those behind it."""
        rows = self.rows
        for skeleton, body, shape in ((6, 7, 10), (8, 9, 11)):
            gone = rows[:, skeleton] == index
            rows[rows[:, skeleton] > index, skeleton] -= 1
            rows[np.ix_(gone, [skeleton, body, shape])] = -1
        self._looked = _Contacts(self.world, rows)

    def _look(self) -> _Contacts:
        if self._looked is None:
            self._looked = _Contacts(self.world, self.world._handle.contacts())
        return self._looked

    def __repr__(self) -> str:
        return f"[CollisionResult: {self.num_contacts()} contacts {self.num_contacted_bodies()} contacted bodies]"
