"""The short forms of a fork of the original: a body and its joint in one call, on a skeleton under construction."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pydart2.building.branches import Branches

if TYPE_CHECKING:
    from pydart2.bodynode import BodyNode

_ORIGIN = (0.0, 0.0, 0.0)
_AXES = {"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "z": (0.0, 0.0, 1.0)}


def joint_of(joint_type: str) -> tuple[str, list[tuple[float, float, float]] | None]:
    """Kind and axes of a joint that is named as ``"BALL"``, ``"REVOLUTE_X"`` or ``"UNIVERSAL_XY"``."""
    kind, _, letters = joint_type.lower().partition("_")
    if not all(letter in _AXES for letter in letters):
        raise ValueError(f"no joint type {joint_type!r}; axes are named as in 'REVOLUTE_X'")
    return kind, [_AXES[letter] for letter in letters] or None


def _turned(angles: ArrayLike) -> NDArray[np.float64]:
    """The rotation, shape (3, 3), by angles about the fixed x, y, z, shape (3,), rad."""
    from pydart2.utils.transformations import euler_matrix  # which imports SciPy

    return euler_matrix(*np.asarray(angles, float))[:3, :3]


class ShortForms(Branches):
    """The part of Skeleton with the short forms."""

    def add_capsule(
        self,
        parent: int | str | BodyNode | None,
        radius: float,
        length: float,
        cap_rot: ArrayLike = _ORIGIN,
        cap_offset: ArrayLike = _ORIGIN,
        joint_loc: ArrayLike = _ORIGIN,
        joint_type: str = "BALL",
        joint_name: str = "",
    ) -> BodyNode:
        """Add a body with a capsule, lengths in m.

        Parameters
        ----------
        parent
            A body, its name or index; None or -1 for the world.
        cap_rot, cap_offset
            Of the capsule in the body: angles about the fixed x, y, z, shape (3,), rad, and position, shape (3,), m.
        joint_loc
            The joint in the parent, shape (3,), m; the body's origin is there.
        joint_type
            ``"BALL"``, ``"FREE"``, ``"WELD"``, ``"REVOLUTE_X"``, ``"UNIVERSAL_XY"`` and so on.
        joint_name
            By default that of the body, ``body3`` for the fourth.
        """
        body = self._add_short(parent, joint_loc, joint_type, joint_name)
        body.add_capsule(radius, length, position=cap_offset, orientation=_turned(cap_rot))
        return body

    def add_weld_box(
        self,
        width: float,
        length: float,
        height: float,
        joint_loc: ArrayLike = _ORIGIN,
        box_rot: ArrayLike = _ORIGIN,
        joint_name: str = "",
    ) -> BodyNode:
        """Add a body with a box, edges in m along x, y and z, welded to the world at `joint_loc`, shape (3,), m.

        `box_rot`, shape (3,), rad: angles of the box about the fixed x, y, z.
        """
        body = self._add_short(None, joint_loc, "WELD", joint_name)
        body.add_box((width, length, height), orientation=_turned(box_rot))
        return body

    def _add_short(
        self, parent: int | str | BodyNode | None, joint_loc: ArrayLike, joint_type: str, joint_name: str
    ) -> BodyNode:
        kind, axes = joint_of(joint_type)
        above = None if isinstance(parent, int) and parent < 0 else parent
        number = len(self.bodynodes)
        name = f"body{number}"
        return self.add_body(name, above, kind, joint_name=joint_name or name, position=joint_loc, axis=axes)
