"""Pairs of bodies that do not collide."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, TypeAlias

import numpy as np
from numpy.typing import NDArray

from pydart2.bodynode import BodyNode
from pydart2.errors import NameNotFound
from pydart2.simulation.part import WorldPart
from pydart2.skeleton import Skeleton

if TYPE_CHECKING:
    from pydart2.world import World

ALL = 0xFFFFFFFF  # every bit of a mask

#: Bodies of a world: one, those of a skeleton, those that a name tells (a skeleton's, else a body's), or some of these.
Bodies: TypeAlias = str | BodyNode | Skeleton | Iterable[str | BodyNode | Skeleton]


class CollisionFilter:
    """The pairs of bodies of a world that pass through each other; from World.create_collision_filter()."""

    def __init__(self, world: World) -> None:
        self.world = world

    def add_to_black_list(self, body1: BodyNode, body2: BodyNode) -> None:
        """Let two bodies pass through each other; ValueError if one is not in the world."""
        self.world.exclude_collisions(body1, body2)

    def remove_from_black_list(self, body1: BodyNode, body2: BodyNode) -> None:
        """Let two bodies collide again."""
        self.world.include_collisions(body1, body2)

    def remove_all_from_black_list(self) -> None:
        """Let all pairs collide again."""
        self.world._handle.ignore_no_pair()


class WorldFilter(WorldPart):
    """Which bodies of a World pass through each other; part of World."""

    def exclude_collisions(self, a: Bodies, b: Bodies) -> None:
        """Let each body of `a` pass through each of `b`.

        >>> world.exclude_collisions("arm", ["table", "lamp"])
        >>> world.exclude_collisions(arm.body("hand"), "cup")

        Each is a body, a skeleton, a name of one (a skeleton's comes first), or several of these.

        KeyError for a name that nothing has, ValueError for a body name of several skeletons and for what is not in the
        world.
        """
        self._handle.ignore_pairs(body_rows(self.skeletons, a), body_rows(self.skeletons, b), True)

    def include_collisions(self, a: Bodies, b: Bodies) -> None:
        """Let each body of `a` collide with each of `b` again; both as of exclude_collisions()."""
        self._handle.ignore_pairs(body_rows(self.skeletons, a), body_rows(self.skeletons, b), False)

    @property
    def excluded_collisions(self) -> list[tuple[BodyNode, BodyNode]]:
        """The pairs of bodies that exclude_collisions() named."""
        rows = self._handle.ignored_pairs().astype(int).tolist()
        bodies = [[self.skeletons[s].bodynodes[i] for s, i in (row[:2], row[2:])] for row in rows]
        return [(one, other) for one, other in bodies]

    def set_collision_group(self, bodies: Bodies, group: int, mask: int = ALL) -> None:
        """Put bodies in groups: two collide only where the mask of each has a bit of the other's group.

        >>> world.set_collision_group(["left", "right"], group=0b10, mask=0b01)  # not with each other

        Parameters
        ----------
        bodies
            As of exclude_collisions().
        group, mask
            32 bits; of other bodies the group is 1 and the mask all bits.
        """
        self._handle.set_collision_bits(body_rows(self.skeletons, bodies), group, mask)

    def collision_group(self, body: str | BodyNode | Skeleton) -> tuple[int, int]:
        """Group and mask of a body, or of a skeleton with one; as of exclude_collisions()."""
        bodies = _bodies(self.skeletons, body)
        if len(bodies) != 1:
            raise ValueError(f"{body!r} has {len(bodies)} bodies, each with a group: give one")
        group, mask = self._handle.collision_bits(bodies[0]._handle)
        return int(group), int(mask)


def body_rows(skeletons: list[Skeleton], bodies: Bodies) -> NDArray[np.float64]:
    """Indices of skeleton and body, shape (n, 2), no unit, of what names bodies."""
    if isinstance(bodies, str | BodyNode | Skeleton) or not isinstance(bodies, Iterable):
        bodies = [bodies]
    rows = [[body.skeleton.id, body.id] for part in bodies for body in _bodies(skeletons, part)]
    return np.array(rows, dtype=float).reshape(-1, 2)


def part_of(skeletons: list[Skeleton], part: str | BodyNode | Skeleton) -> BodyNode | Skeleton:
    """A body or skeleton of a world, given as itself or by name."""
    if isinstance(part, str):
        return _named(skeletons, part)
    if not isinstance(part, BodyNode | Skeleton):
        raise TypeError(f"bodies are given as bodies, skeletons or their names, got {part!r}")
    if not any(one is (part if isinstance(part, Skeleton) else part.skeleton) for one in skeletons):
        raise ValueError(f"{part!r} is not in this world")
    return part


def _bodies(skeletons: list[Skeleton], part: str | BodyNode | Skeleton) -> list[BodyNode]:
    found = part_of(skeletons, part)
    return found.bodynodes if isinstance(found, Skeleton) else [found]


def _named(skeletons: list[Skeleton], name: str) -> BodyNode | Skeleton:
    for skel in skeletons:
        if skel.name == name:
            return skel
    bodies = [body for skel in skeletons for body in skel.bodynodes]
    found = [body for body in bodies if body.name == name]
    if len(found) > 1:
        where = ", ".join(repr(body.skeleton.name) for body in found)
        raise ValueError(f"{len(found)} bodies have the name {name!r}, in the skeletons {where}: give the body itself")
    if not found:
        names = [skel.name for skel in skeletons] + [body.name for body in bodies]
        raise NameNotFound("skeleton or body", name, "this world", names)
    return found[0]
