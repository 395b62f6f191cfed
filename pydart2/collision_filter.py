"""Pairs of bodies that do not collide."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pydart2.bodynode import BodyNode
    from pydart2.world import World


class CollisionFilter:
    """The pairs of bodies of a world that pass through each other; from World.create_collision_filter()."""

    def __init__(self, world: World) -> None:
        self.world = world

    def add_to_black_list(self, body1: BodyNode, body2: BodyNode) -> None:
        """Let two bodies pass through each other; ValueError if one is not in the world."""
        self.world._handle.ignore_pair(body1._handle, body2._handle, True)

    def remove_from_black_list(self, body1: BodyNode, body2: BodyNode) -> None:
        """Let two bodies collide again."""
        self.world._handle.ignore_pair(body1._handle, body2._handle, False)

    def remove_all_from_black_list(self) -> None:
        """Let all pairs collide again."""
        self.world._handle.ignore_no_pair()
