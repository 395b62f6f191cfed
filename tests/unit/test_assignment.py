"""What is assigned to the objects of a world is looked at."""

from __future__ import annotations

import json
import pickle
import re
import sys
import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import pydart2
from pydart2.original_names import ORIGINAL

ATLAS = "sdf/atlas/atlas_v3_no_head.sdf"


@pytest.fixture
def world() -> Any:
    return pydart2.World(0.001, ATLAS, up="z")


@pytest.fixture
def robot(world: pydart2.World) -> Any:
    return world.skeletons[0]


def test_assigning_over_a_method_calls_what_sets(world: Any, robot: Any) -> None:
    world.gravity = [0.0, 0.0, -1.5]
    assert world.gravity().tolist() == [0.0, 0.0, -1.5]
    world.time_step = 0.002
    assert world.dt == world.time_step() == 0.002
    world.collision_detector = "bullet"
    assert world.collision_detector_string() == "BULLET_COLLISION_DETECTOR"
    robot.positions = np.arange(33.0) / 100.0
    robot.velocities = {"back_bkz": 2.0}
    assert robot.q[3] == 0.03 and robot.dq["back_bkz"] == 2.0
    body, dof = robot.body("l_hand"), robot.dof("l_arm_elx")
    body.friction_coeff, body.mass, body.collidable = 0.25, 3.0, False
    assert (body.friction_coeff(), body.mass(), body.is_collidable()) == (0.25, 3.0, False)
    body.m = 4.0
    assert body.m == 4.0
    dof.damping_coefficient = 7.0
    assert dof.damping_coefficient() == 7.0
    dof.joint.position_limit_enforced = True
    assert dof.joint.is_position_limit_enforced()
    with pytest.raises(ValueError, match="time step"):
        world.time_step = -1.0


def test_what_cannot_be_assigned_says_so(world: Any, robot: Any) -> None:
    for owner, name, sentence in (
        (
            world,
            "check_collision",
            r"World.check_collision is a method: call world.check_collision\(\); only a function",
        ),
        (world, "step", "World.step is a method"),
        (world, "frame", r"World.frame is read-only; world.set_frame\(\) is something else"),
        (robot, "M", "Skeleton.M is read-only"),
        (robot, "ndofs", "Skeleton.ndofs is read-only"),
        (robot.body(0), "T", "BodyNode.T is read-only"),
    ):
        with pytest.raises(AttributeError, match=sentence):
            setattr(owner, name, 5)


def test_functions_take_the_place_of_methods(world: Any) -> None:
    calls = []
    world.step = lambda: calls.append("step")
    world.render = world.on_key_press = world.anything = print
    world.step()
    assert calls == ["step"] and world.render is print


def test_younger_names_yield_and_say_so_once(caplog: pytest.LogCaptureFixture) -> None:
    class Puddle(pydart2.World):
        def __init__(self, contacts: list[int]) -> None:
            super().__init__(0.001)
            self.contacts = contacts  # type: ignore[misc, assignment]

    worlds: list[Any] = [Puddle([1]), Puddle([2])]
    assert [world.contacts for world in worlds] == [[1], [2]]
    assert [r.getMessage() for r in caplog.records] == ["Puddle.contacts hides World.contacts"]
    worlds[0].contacts = [3]
    assert worlds[0].contacts == [3]
    assert worlds[0].clone().contacts == [3]
    assert len(pydart2.World(0.001).contacts) == 0  # others have theirs


def test_a_class_that_declares_a_younger_name_is_told(caplog: pytest.LogCaptureFixture) -> None:
    class Pond(pydart2.World):
        def contacts(self) -> int:  # type: ignore[override]
            return 7

        def reset(self) -> None:  # the original's, to be overridden
            super().reset()

    assert Pond(0.001).contacts() == 7
    assert [r.getMessage() for r in caplog.records] == ["Pond.contacts hides World.contacts"]


@pytest.mark.parametrize(
    ("name", "right"),
    [("Tau", "tau"), ("Q", "q"), ("position", "positions"), ("velocites", "velocities"), ("contoller", "controller")],
)
def test_near_misses_are_named_once(robot: Any, caplog: pytest.LogCaptureFixture, name: str, right: str) -> None:
    class Robot(pydart2.Skeleton):
        pass

    robots = [robot.world.add_skeleton(ATLAS, Robot) for _ in range(2)]
    caplog.clear()
    for skel in robots:
        setattr(skel, name, 3)
    [record] = caplog.records
    assert f"Robot has no {name!r}" in record.getMessage() and f"did you mean {right!r}?" in record.getMessage()
    assert getattr(robots[1], name) == 3


def test_ones_own_names_are_free(world: Any, robot: Any, caplog: pytest.LogCaptureFixture) -> None:
    class Own(pydart2.World):
        Gravity: float
        tau0 = 1.0

        def __init__(self) -> None:
            super().__init__(0.001)
            self.Gravity, self.tau0 = 3.0, 2.0

    Own()
    for name in ("target", "state", "h", "k", "n", "Kp", "desired", "limit", "robot", "_Q", "frames"):
        setattr(robot, name, 3)
        setattr(world, name, 3)
        assert getattr(robot, name) == getattr(world, name) == 3
    assert not [r for r in caplog.records if "did you mean" in r.getMessage()]


def test_a_property_that_fails_says_why(world: Any) -> None:
    class Mine(pydart2.World):
        @property
        def reward(self) -> float:
            return self._goal.distance  # there is no _goal

    with pytest.raises(AttributeError, match="'Mine' object has no attribute '_goal'"):
        _ = Mine(0.001).reward


def test_what_is_assigned_goes_along(world: Any, robot: Any) -> None:
    robot.colour, world.count = "red", 3
    for copy in (world.clone(), pickle.loads(pickle.dumps(world))):
        assert copy.skeletons[0].colour == "red" and copy.count == 3


def test_the_originals_names_are_all_there() -> None:
    rows = json.loads((Path(__file__).parents[1] / "conformance" / "rows.json").read_text(encoding="utf-8"))
    promised: dict[str, set[str]] = {}
    for row in (row for group in rows.values() for row in group):
        match = re.fullmatch(r"(?:\w+\.)*(World|Skeleton|BodyNode|Joint|\w+Joint|Dof|Marker)\.([a-zA-Z]\w*)=?", row)
        if match is not None:
            promised.setdefault("Joint" if "Joint" in match[1] else match[1], set()).add(match[2])
    for name, names in promised.items():
        cls = getattr(pydart2, name)
        classes = [cls, *(c for c in vars(pydart2).values() if isinstance(c, type) and issubclass(c, cls))]
        here = [getattr(c, n, None) for c in classes for n in names]
        assert here
        in_the_way = {
            n for n in names if any(callable(v := getattr(c, n, None)) or isinstance(v, property) for c in classes)
        }
        assert in_the_way == ORIGINAL[name]


@pytest.mark.skipif(sys.version_info >= (3, 14), reason="Python 3.14 borrows what local variables hold")
def test_what_is_set_in_a_lost_copy_is_said(robot: Any) -> None:
    for lost in (
        lambda: exec("robot.q[0] = 1.0", {"robot": robot}),
        lambda: exec("robot.q['back_bkz'] += 1.0", {"robot": robot}),
    ):
        with pytest.warns(UserWarning, match=r"a copy that is lost: q = robot\.q"):
            lost()
    assert not robot.q.any()
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        q = robot.q
        q[0] = q["back_bkz"] = 0.1
        q[3:][0] = 0.2  # a view: q has it
        robot.q = q
        robot.q += 0.1
        kept = {"q": robot.q}
        kept["q"][1] = 0.3
    np.testing.assert_allclose(robot.q[[0, 3, 1]], [0.2, 0.3, 0.1])


class Slotted:
    """Has a layout of its own."""

    __slots__ = ("place",)


@pytest.mark.parametrize("other", [dict, Exception, Slotted])
def test_worlds_and_skeletons_can_be_of_another_kind_too(other: type) -> None:
    """As with Qt's objects, for their signals: Python combines one layout only, so ours has none."""
    for ours in (pydart2.World, pydart2.Skeleton):
        assert issubclass(type("Both", (ours, other), {}), other)
