"""Models that others made: none ends the process, and what the engine loads alone, we load with the same numbers.

DART's own (Debian's dart-doc) and PyPI's airo-models in each run; ``pybullet``'s by ``make test-third-party``.
"""

from __future__ import annotations

import importlib.util
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import pydart2
from models.third_party import differences, model_files, outcome, report
from oracle.models import dart_data

PYBULLET = Path(__file__).parents[2] / "build" / "third-party" / "pybullet_data"


def folder_of(name: str) -> Path:
    if name == "dart-doc":
        return dart_data()
    if name == "pybullet":
        assert PYBULLET.is_dir(), "run `make test-third-party`, which brings pybullet's models"
        return PYBULLET
    found = importlib.util.find_spec(name.replace("-", "_"))
    assert found and found.origin, f"{name} is not installed: pip install {name}"
    return Path(found.origin).parent


def chosen(files: list[Path]) -> list[Path]:
    """All, but of pybullet's thousand random bodies every fiftieth."""
    random = [path for path in files if "random_urdfs" in path.parts]
    return [path for path in files if path not in set(random)] + random[::50]


@pytest.mark.parametrize(
    ("name", "least"),
    [("dart-doc", 100), ("airo-models", 16), pytest.param("pybullet", 80, marks=pytest.mark.third_party)],
)
def test_models(name: str, least: int, capsys: Any) -> None:
    results = [outcome(path) for path in chosen(model_files(folder_of(name)))]
    with capsys.disabled():
        print("\n" + report(Path(name), results))
    assert [difference for result in results for difference in differences(result)] == []
    assert [str(result.path) for result in results if result.kind == "only the engine loads"] == []
    assert all(result.reason for result in results if result.ours is None)
    assert sum(result.kind == "both load" for result in results) >= least


def boxes_at_rest(world: pydart2.World, boxes: list[pydart2.Skeleton]) -> bool:
    """In the floor by less than 1 mm, and slower than 1 mm/s."""
    return all(abs(box.C[2] - 0.05) < 1e-3 and np.abs(box.dq).max() < 1e-3 for box in boxes)


def test_a_robot_on_a_floor_with_three_boxes() -> None:
    """The first script of every newcomer, in six lines."""
    world = pydart2.World(0.001, up="z")
    world.add_ground()
    world.add_skeleton(pydart2.models.find("ur5e"), base="fixed")
    boxes = [world.add_box((0.1, 0.1, 0.1), 1.0, (1.5, 0.2 * i, 0.06)) for i in range(3)]
    world.step(2000)
    assert boxes_at_rest(world, boxes)


@pytest.mark.third_party
def test_a_fixed_arm_and_a_free_quadruped_hold_their_pose() -> None:
    """Under PD, on a floor with three boxes, for 2 s."""
    world = pydart2.World(0.001, up="z")
    world.add_ground()
    boxes = [world.add_box((0.1, 0.1, 0.1), 1.0, (1.5, 0.2 * i, 0.06)) for i in range(3)]
    arm = world.add_skeleton(pydart2.models.find("ur5e"), base="fixed", position=[-1.0, 0.0, 0.0])
    arm.q = held = np.array([0.0, -1.2, 1.2, 0.0, 0.5, 0.0])
    arm.set_targets(held, kp=400.0, kd=40.0)
    dog = world.add_skeleton(pydart2.models.find("solo12"), position=[0.0, 1.0, 0.26])
    bent = {"FL": 0.8, "FR": 0.8, "HL": -0.8, "HR": -0.8}
    legs = {
        name: value for leg, hip in bent.items() for name, value in ((f"{leg}_HFE", hip), (f"{leg}_KFE", -2.0 * hip))
    }
    dog.set_positions(legs)
    dog.set_targets({dof.name: dof.position() for dof in dog.dofs[6:]}, kp=30.0, kd=1.0)
    world.step(2000)
    assert boxes_at_rest(world, boxes)
    assert np.abs(arm.q - held).max() < 0.1 and np.abs(arm.dq).max() < 1e-3
    assert dog.bodynodes[0].T[2, 2] > 0.99 and 0.2 < dog.C[2] < 0.26
    assert np.abs(dog.dq).max() < 1e-3 and max(abs(dog.q[name] - value) for name, value in legs.items()) < 0.05
