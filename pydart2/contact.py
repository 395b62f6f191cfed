"""Contacts between bodies."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from pydart2 import screen
from pydart2._native import ContactRow

if TYPE_CHECKING:
    from pydart2.bodynode import BodyNode


class Contact(ContactRow):
    """One contact point of two bodies, in the world frame.

    Parameters
    ----------
    _world : World
    _state
        Point (3), force (3), skeleton and body id of the first body, of the second; the engine's rows go on with the
        ids of both shapes, the normal (3) and the penetration depth. An id is -1 where there is none.

    Attributes
    ----------
    world : World
    point : (3,)
        Where the bodies touch, m; also called `p`.
    force : (3,)
        On the first body, N; also called `f`.
    normal : (3,)
        Unit normal, from the second body to the first; NaN if not given.
    depth : float
        Penetration depth, m; NaN if not given.
    skel_id1 : int
        Id of the first body's skeleton; `skel_id2` of the second one's.
    bodynode_id1 : int
        Id of the first body; `bodynode_id2` of the second.
    shape_id1 : int
        Id of the first body's shape node; `shape_id2` of the second one's.
    state : (10,)
        Point, force and the ids of skeletons and bodies.
    """

    __slots__ = ()

    @property
    def bodynode1(self) -> BodyNode | None:
        """The first body; None if it is not a body of a skeleton of the world."""
        return self._bodynode(self.skel_id1, self.bodynode_id1)

    @property
    def bodynode2(self) -> BodyNode | None:
        """The second body; None if it is not a body of a skeleton of the world."""
        return self._bodynode(self.skel_id2, self.bodynode_id2)

    def _bodynode(self, skel_id: int, bodynode_id: int) -> BodyNode | None:
        now = self.world.skeletons
        skeletons = now if self._skeletons is None else self._skeletons
        if not 0 <= skel_id < len(skeletons):
            return None
        skel = skeletons[skel_id]
        is_there = 0 <= skel.id < len(now) and now[skel.id] is skel
        return skel.bodynodes[bodynode_id] if is_there else None

    def __reduce__(self) -> tuple[Any, ...]:
        """With the ids that the skeletons have now, -1 for those that have gone."""
        reduced: tuple[Any, Any] = super().__reduce__()  # type: ignore[assignment]
        cls, (world, row) = reduced
        sides = ((self.bodynode1, [6, 7, 10]), (self.bodynode2, [8, 9, 11]))
        for body, columns in sides if self._skeletons is not None else ():
            if body is not None:
                row[columns[0]] = body.skeleton.id
            elif row[columns[0]] >= 0:
                row[columns] = -1
        return cls, (world, row)

    def render(self, size: float = 0.01, scale: float = -0.005) -> None:
        """Draw a dot of radius `size`, m, and an arrow along the force, `scale` in m/N, with the current OpenGL context
        and matrices."""
        screen.draw("contact", self, size, scale)

    def __repr__(self) -> str:
        return f"[Contact {self.point} {self.force}]"
