"""The flat functions that draw, with the current OpenGL context and matrices."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from pydart2 import screen
from pydart2._native import WorldHandle
from pydart2.collision_result import CollisionResult
from pydart2.world import World


class _Drawn(World):
    """The objects of a world that was made by the flat functions."""

    def __init__(self, handle: WorldHandle) -> None:
        self._handle = handle
        self.id = handle.id()
        self.skeletons = []
        self.collision_result = CollisionResult(self)
        self.collision_result.update()
        for i in range(handle.num_skeletons()):
            self.add_skeleton_from_id(i)


def world__render(wid: int) -> None:
    """world__render(wid) -> None: Draw a world."""
    _Drawn(WorldHandle.find(wid)).render()


def skeleton__render(wid: int, skid: int) -> None:
    """skeleton__render(wid, skid) -> None: Draw a skeleton."""
    _Drawn(WorldHandle.find(wid)).skeletons[skid].render()


def skeleton__renderWithColor(wid: int, skid: int, color: ArrayLike) -> None:  # noqa: N802
    """skeleton__renderWithColor(wid, skid, color) -> None: Draw a skeleton in one colour, 4 numbers, 0 to 1."""
    _Drawn(WorldHandle.find(wid)).skeletons[skid].render_with_color(color)


def marker__render(wid: int, skid: int, mid: int) -> None:
    """marker__render(wid, skid, mid) -> None: Draw a marker."""
    _Drawn(WorldHandle.find(wid)).skeletons[skid].markers[mid].render()


def shape__render(wid: int, skid: int, bid: int, sid: int) -> None:
    """shape__render(wid, skid, bid, sid) -> None: Draw a shape in grey in the axes of OpenGL's matrices."""
    shape = _Drawn(WorldHandle.find(wid)).skeletons[skid].bodynodes[bid].shapenodes[sid].shape
    if shape is not None:
        shape.render()


def collisionresult__renderContact(state: ArrayLike, size: float, scale: float) -> None:  # noqa: N802
    """collisionresult__renderContact(state, size, scale) -> None: Draw a contact: point (3, m) and force (3, N)."""
    numbers = np.asarray(state, dtype=float)
    if numbers.shape != (6,):
        raise ValueError(f"state needs shape (6,), got {numbers.shape}")
    screen.draw("contact row", numbers, size, scale)


FUNCTIONS = (
    world__render,
    skeleton__render,
    skeleton__renderWithColor,
    marker__render,
    shape__render,
    collisionresult__renderContact,
)
