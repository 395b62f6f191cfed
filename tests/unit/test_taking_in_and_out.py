"""Skeletons are taken in whole or not at all, and contacts name no other bodies when one goes."""

from __future__ import annotations

import numpy as np
import pytest

import pydart2


class Failing(pydart2.Skeleton):
    """Raises after the engine has it."""

    def __init__(self, *args: object, **options: object) -> None:
        super().__init__(*args, **options)  # type: ignore[arg-type]
        raise RuntimeError("no")


def test_a_skeleton_whose_class_raises_is_not_there() -> None:
    world = pydart2.World(0.001)
    with pytest.raises(RuntimeError, match="no"):
        world.add_skeleton("./data/skel/cubes.skel", CLASS=Failing)
    assert world.num_skeletons() == len(world.skeletons) == 0
    world.add_ground()
    world.clone().step()


def test_an_empty_skeleton_whose_class_raises_is_not_there() -> None:
    class Refusing(pydart2.World):
        CLASS_SKELETON = Failing

    world = Refusing(0.001)
    with pytest.raises(RuntimeError, match="no"):
        world.add_empty_skeleton()
    assert world.num_skeletons() == len(world.skeletons) == 0


def test_a_skeleton_made_with_a_world_is_one_of_its_skeletons() -> None:
    world = pydart2.World(0.001)
    skel = pydart2.Skeleton(world, "./data/sdf/atlas/atlas_v3_no_head.sdf")
    assert world.skeletons == [skel]
    assert world.clone().skeletons[0].ndofs == skel.ndofs


def boxes() -> pydart2.World:
    world = pydart2.World(0.001)
    world.add_ground()
    for i in range(3):
        world.add_box((0.2, 0.2, 0.2), 1.0, (float(i), 0.1, 0.0), name=f"box{i}")
    world.step(3)
    return world


def positions(result: pydart2.CollisionResult) -> dict[str, float]:
    """Where along x the contacts of each skeleton are."""
    found = {}
    for contact in result.contacts:
        for body in (contact.bodynode1, contact.bodynode2):
            if body is not None and body.name.startswith("box"):
                found[body.name] = round(float(np.round(contact.point[0])), 1)
    return found


@pytest.mark.parametrize("looked", [True, False])
def test_contacts_name_the_right_bodies_after_a_removal(looked: bool) -> None:
    world = boxes()
    if looked:
        assert positions(world.collision_result) == {"box0": 0.0, "box1": 1.0, "box2": 2.0}
    world.remove_skeleton(2)
    recording = world.recording
    assert recording is not None
    for result in (world.collision_result, recording.contacts(2)):
        assert positions(result) == {"box0": 0.0, "box2": 2.0}
        alone = [c for c in result.contacts if c.bodynode1 is None or c.bodynode2 is None]
        assert {float(np.round(c.point[0])) for c in alone} == {1.0}
    world.step()
    assert positions(world.collision_result) == {"box0": 0.0, "box2": 2.0}


def test_there_are_no_contacts_of_an_earlier_call_after_a_blow_up() -> None:
    world = boxes()
    assert world.collision_result.contacts
    world.skeletons[1].q = world.skeletons[1].q + np.array([0, 0, 0, 0, 50.0, 0])
    world.skeletons[1].dq = np.array([0, 0, 0, 0, 1e29, 0])
    with pytest.raises(pydart2.SimulationError):
        world.step(5)
    assert world.collision_result.num_contacts() == 0
