"""Contacts between bodies."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from pydart2.bodynode import BodyNode
    from pydart2.world import World


class Contact:
    """One contact point of two bodies, in the world frame.

    Parameters
    ----------
    _world
        The world.
    _state
        Point (3), force (3), skeleton and body id of the first body, of the second; the engine's rows go on with the
        ids of both shapes, the normal (3) and the penetration depth. An id is -1 where there is none.
    """

    __slots__ = ("_row", "world")

    def __init__(self, _world: World, _state: NDArray[np.float64]) -> None:
        self.world = _world
        self._row = _state

    @property
    def state(self) -> NDArray[np.float64]:
        """Point, force and the four ids, shape (10,)."""
        return self._row[:10].copy()

    @property
    def point(self) -> NDArray[np.float64]:
        """Where the bodies touch, shape (3,), m."""
        return self._row[:3].copy()

    p = point

    @property
    def force(self) -> NDArray[np.float64]:
        """Force on the first body, shape (3,), N."""
        return self._row[3:6].copy()

    f = force

    @property
    def skel_id1(self) -> int:
        """Id of the first body's skeleton."""
        return int(self._row[6])

    @property
    def bodynode_id1(self) -> int:
        """Id of the first body."""
        return int(self._row[7])

    @property
    def skel_id2(self) -> int:
        """Id of the second body's skeleton."""
        return int(self._row[8])

    @property
    def bodynode_id2(self) -> int:
        """Id of the second body."""
        return int(self._row[9])

    @property
    def shape_id1(self) -> int:
        """Id of the first body's shape node."""
        return int(self._row[10])

    @property
    def shape_id2(self) -> int:
        """Id of the second body's shape node."""
        return int(self._row[11])

    @property
    def normal(self) -> NDArray[np.float64]:
        """Unit normal, from the second body to the first, shape (3,)."""
        return self._row[12:15].copy()

    @property
    def depth(self) -> float:
        """Penetration depth, m."""
        return float(self._row[15])

    @property
    def bodynode1(self) -> BodyNode | None:
        """The first body; None if it is not a body of a skeleton of the world."""
        return self._bodynode(self.skel_id1, self.bodynode_id1)

    @property
    def bodynode2(self) -> BodyNode | None:
        """The second body; None if it is not a body of a skeleton of the world."""
        return self._bodynode(self.skel_id2, self.bodynode_id2)

    def _bodynode(self, skel_id: int, bodynode_id: int) -> BodyNode | None:
        if not 0 <= skel_id < len(self.world.skeletons):
            return None
        return self.world.skeletons[skel_id].bodynodes[bodynode_id]

    def render(self, size: float = 0.01, scale: float = -0.005) -> None:
        """Draw a dot of radius `size`, m, and an arrow along the force, `scale` in m/N, with the current OpenGL context
        and matrices."""
        from pydart2.gui import drawing

        drawing.draw_contact(self, size, scale)

    def __repr__(self) -> str:
        return f"[Contact {self.point} {self.force}]"
