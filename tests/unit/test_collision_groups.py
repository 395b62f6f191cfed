"""Which bodies pass through each other: by name, and by groups and masks."""

from __future__ import annotations

import pickle
from collections.abc import Callable

import pytest

import pydart2
from pydart2 import World

DETECTORS = ["fcl", "bullet", "ode", "dart", "native"]
COPIES: dict[str, Callable[[World], World]] = {
    "itself": lambda world: world,
    "clone": lambda world: world.clone(),
    "pickle": lambda world: pickle.loads(pickle.dumps(world)),
    "batch": lambda world: pydart2.Batch(world, 2, threads=1).worlds[1],
}


def pile(detector: str = "fcl") -> World:
    """A ground, and two boxes on it that overlap."""
    world = World(0.001, up="z")
    world.add_ground()
    for i, name in enumerate(("left", "right")):
        world.add_box([0.2, 0.2, 0.2], 1.0, [0.1 * i, 0.0, 0.0999], name=name)
    world.set_collision_detector(detector)
    return world


def touching(world: World) -> set[tuple[str, str]]:
    world.check_collision()
    pairs = world.collision_result.contact_sets
    return {tuple(sorted((a.skel.name, b.skel.name))) for a, b in pairs}  # type: ignore[union-attr, misc]


ALL = {("ground", "left"), ("ground", "right"), ("left", "right")}


@pytest.mark.parametrize("detector", DETECTORS)
@pytest.mark.parametrize("copy", COPIES)
def test_groups_and_masks(detector: str, copy: str) -> None:
    world = pile(detector)
    assert touching(world) == ALL
    world.set_collision_group(["left", "right"], group=0b10, mask=0b01)
    world = COPIES[copy](world)
    assert touching(world) == ALL - {("left", "right")}
    world.set_collision_group("left", group=0b10, mask=0b11)
    assert touching(world) == ALL - {("left", "right")}  # the other's mask has no bit of its group
    world.set_collision_group("right", group=0b10, mask=0b10)
    assert touching(world) == {("ground", "left"), ("left", "right")}
    world.set_collision_group("right", 1)
    assert world.collision_group(world.skeletons[2].bodynodes[0]) == (1, 0xFFFFFFFF)
    assert touching(world) == {("ground", "left"), ("ground", "right"), ("left", "right")}


@pytest.mark.parametrize("detector", DETECTORS)
def test_exclude_by_name(detector: str) -> None:
    world = pile(detector)
    world.exclude_collisions("left", ["right", world.skeletons[0]])
    assert touching(world) == {("ground", "right")}
    left, right, ground = (world.skeleton(name).bodynodes[0] for name in ("left", "right", "ground"))
    assert {frozenset(pair) for pair in world.excluded_collisions} == {
        frozenset((left, right)),
        frozenset((left, ground)),
    }
    world.include_collisions("right", "left")
    assert touching(world) == {("ground", "right"), ("left", "right")}
    world.collision_filter.remove_all_from_black_list()
    assert touching(world) == ALL


def test_the_order_in_which_a_pair_is_named_says_nothing() -> None:
    """Nor where bodies are in memory: worlds with the same pairs have equal models, and take each other's states."""
    worlds = [pile() for _ in range(6)]
    for i, world in enumerate(worlds):
        world.exclude_collisions(*(("left", "right") if i % 2 else ("right", "left")))
    start = worlds[0].snapshot()
    for world in worlds:
        world.restore(start)
        assert [one.name for pair in world.excluded_collisions for one in pair] == ["left", "right"]


def test_what_goes_takes_its_bits_along() -> None:
    world = pile()
    world.set_collision_group("left", 2, 2)
    world.exclude_collisions("left", "right")
    world.remove_skeleton(world.skeleton("left"))
    again = world.add_box([0.2, 0.2, 0.2], 1.0, [0.0, 0.0, 0.0999], name="left")
    assert world.collision_group("left") == world.collision_group(again.bodynodes[0]) == (1, 0xFFFFFFFF)
    assert touching(world) == ALL


def test_through_the_ground() -> None:
    """With the iterative solver and the native detector, which ask for bits without the engine."""
    world = pile("native")
    world.set_constraint_solver("iterative")
    world.set_collision_group("left", 2, 2)
    world.step(200)
    assert world.skeleton("left").C[2] == pytest.approx(0.0999 - 0.5 * 9.81 * 0.2 * 0.201, abs=1e-9)
    assert world.skeleton("right").C[2] == pytest.approx(0.1, abs=2e-3)


@pytest.mark.parametrize("bits", [-1, 2**32, 0.5, float("nan")])
def test_what_is_no_32_bits(bits: float) -> None:
    with pytest.raises(ValueError, match=r"a collision (group|mask) is 32 bits"):
        pile().set_collision_group("left", bits)  # type: ignore[arg-type]
