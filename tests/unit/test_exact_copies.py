"""Original and copy go on bit for bit alike, with every detector; deterministic worlds too, without a copy."""

from __future__ import annotations

import copy
import pickle
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import pydart2


def fallen(detector: str, steps: int = 400) -> pydart2.World:
    """The humanoid on the ground, with contacts that detectors remember."""
    world = pydart2.World(0.001, "skel/fullbody1.skel")
    world.set_collision_detector(detector)
    world.disable_recording()
    world.step(steps)
    assert len(world.collision_result.contacts) > 0
    return world


COPIES: dict[str, Callable[[pydart2.World], pydart2.World]] = {
    "clone": lambda world: world.clone(),
    "copy": copy.copy,
    "deepcopy": copy.deepcopy,
    "pickle": lambda world: pickle.loads(pickle.dumps(world)),
}


@pytest.mark.parametrize("detector", ["fcl", "bullet", "ode", "dart"])
def test_copies_go_on_as_the_original(detector: str) -> None:
    world = fallen(detector)
    snapshot = world.snapshot()
    copies = {name: make(world) for name, make in COPIES.items()}
    world.step(150)
    for name, copied in copies.items():
        copied.step(150)
        np.testing.assert_array_equal(copied.x, world.x, err_msg=name)
    end = world.x
    world.restore(snapshot)
    world.step(150)
    np.testing.assert_array_equal(world.x, end)


@pytest.mark.parametrize("detector", ["fcl", "bullet"])
@pytest.mark.parametrize("make", ["clone", "pickle"])
def test_one_copy_goes_on_as_the_original(detector: str, make: str) -> None:
    """By itself, without a snapshot before it, which makes the world forget what the copy has not."""
    world = fallen(detector)
    copied = COPIES[make](world)
    for one in (world, copied):
        one.step(150)
    np.testing.assert_array_equal(copied.x, world.x)


def test_an_inexact_copy_leaves_the_original_alone() -> None:
    world, alone = fallen("fcl"), fallen("fcl")
    world.clone(exact=False)
    world.snapshot(exact=False)
    for one in (world, alone):
        one.step(150)
    np.testing.assert_array_equal(world.x, alone.x)


@pytest.mark.parametrize("detector", ["fcl", "bullet"])
def test_steps_of_a_deterministic_world_depend_on_the_state_alone(detector: str) -> None:
    world = fallen(detector)
    other = world.clone(exact=False)
    assert not world.is_deterministic()
    world.set_deterministic()
    other.set_deterministic()
    assert world.clone().is_deterministic()
    other.step(3)  # has another history than the world, and then its state
    other.restore(world.snapshot(exact=False), strict=False)
    for one in (world, other):
        one.step(150)
    np.testing.assert_array_equal(other.x, world.x)


@pytest.mark.parametrize("detector", ["fcl", "bullet", "ode", "dart", "native"])
def test_copies_of_what_was_built_go_on_as_the_original(detector: str) -> None:
    """Shapes that came one by one, and some that went."""
    world = pydart2.World(0.002, up="z")
    world.set_collision_detector(detector)
    world.add_ground()
    for i in range(5):
        world.add_box([0.2, 0.2, 0.2], 1.0, [0.02 * i, 0.0, 0.1 + 0.2 * i])
    world.step(100)
    world.remove_skeleton(world.skeletons[2])
    world.add_sphere(0.1, 1.0, [0.1, 0.05, 1.2])
    snapshot, copied = world.snapshot(), world.clone()
    for one in (world, copied):
        one.step(300)
    np.testing.assert_array_equal(copied.x, world.x)
    world.restore(snapshot)
    world.step(300)
    np.testing.assert_array_equal(copied.x, world.x)


@pytest.mark.parametrize("is_loaded", [False, True])
@pytest.mark.parametrize("detector", ["fcl", "bullet", "ode", "dart", "native"])
def test_copies_made_after_one_of_several_roots_got_another_joint(
    detector: str, is_loaded: bool, tmp_path: Path
) -> None:
    """Its tree is the last then, in the engine, too."""
    world = pydart2.World(0.001, up="z")
    world.set_collision_detector(detector)
    floor = world.add_empty_skeleton("floor")
    for i in range(3):
        floor.add_body(f"root{i}", joint="weld", position=(0.5 * i, 0.0, 0.0)).add_box((0.5, 1.0, 0.1), mass=1.0)
    if is_loaded:
        floor.save(tmp_path / "floor.skel")
        world.remove_skeleton(floor)
        floor = world.add_skeleton(tmp_path / "floor.skel")
    for i in range(4):
        world.add_box((0.3, 0.3, 0.3), 1.0, (0.25 + 0.25 * i, 0.0, 0.199))
    world.step(5)
    floor.set_root_joint_to_free()
    copied = world.clone()
    for one in (world, copied):
        one.step(20)
    np.testing.assert_array_equal(copied.x, world.x)


@pytest.mark.parametrize("detector", ["fcl", "bullet", "native"])
def test_copies_made_right_after_something_came_beside_soft_bodies(detector: str) -> None:
    """The skin has been pressed in, and the detector meets the newcomer at the copy."""
    world = pydart2.World(0.001, "skel/softBodies.skel")
    world.set_collision_detector(detector)
    world.step(200)
    for i, name in enumerate(["box", "sphere"]):
        add = world.add_box if name == "box" else world.add_sphere
        at = np.add(world.skeletons[i + 1].C, [0.02, 0.05, 0.01])
        add([0.2, 0.2, 0.2] if name == "box" else 0.1, 1.0, at)
    snapshot, copied = world.snapshot(), pickle.loads(pickle.dumps(world))
    for one in (world, copied):
        one.step(60)
    np.testing.assert_array_equal(copied.x, world.x)
    world.restore(snapshot)
    world.step(60)
    np.testing.assert_array_equal(copied.x, world.x)


def test_forces_outside_of_limits_that_came_later_are_kept() -> None:
    """A force limit above 0 leaves the force of 0 that is there, until the next is set."""
    world = pydart2.World(0.001, "skel/chain.skel")
    for dof in world.skeletons[0].dofs:
        dof.set_force_lower_limit(5.0)
    snapshot = world.snapshot()
    world.step()
    end = world.x
    for _ in range(2):
        world.restore(snapshot)
        world.step()
        np.testing.assert_array_equal(world.x, end)


def test_the_iterative_solver_remembers_groups_with_soft_bodies_too() -> None:
    world = pydart2.World(0.001, "skel/softBodies.skel")
    world.set_constraint_solver("iterative")
    world.step(300)
    assert len(world.collision_result.contacts) > 0
    snapshot, copied = world.snapshot(), world.clone()
    for one in (world, copied):
        one.step(100)
    np.testing.assert_array_equal(copied.x, world.x)
    world.restore(snapshot)
    world.step(100)
    np.testing.assert_array_equal(copied.x, world.x)


def test_copies_have_the_skins_that_bullet_has() -> None:
    """Skins that another detector has pressed in before."""
    world = pydart2.World(0.001, "skel/softBodies.skel")
    world.step(300)
    world.set_collision_detector("bullet")
    world.step(40)
    copied = world.clone()
    for _ in range(20):
        world.step(2)
        copied.step(2)
        np.testing.assert_array_equal(copied.x, world.x)
