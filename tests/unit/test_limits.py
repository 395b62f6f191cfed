"""Limits the wrong way round: taken one bound at a time, refused by the step that would act on them, by name."""

from __future__ import annotations

import logging
import pickle
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import pydart2

INVERTED = r"dof 'joint 10_z' of skeleton 'skeleton 1' has a lower {} limit of 1 above the upper one of -1"


@pytest.fixture
def world() -> pydart2.World:
    return pydart2.World(0.001, "skel/chain.skel")


def invert(world: pydart2.World, what: str) -> None:
    dof = world.skeletons[0].dofs[-1]
    getattr(dof, f"set_{what}_lower_limit")(1.0)
    getattr(dof, f"set_{what}_upper_limit")(-1.0)


def enforce(world: pydart2.World) -> None:
    world.skeletons[0].dofs[-1].joint.set_position_limit_enforced()


def serve(world: pydart2.World) -> None:
    world.skeletons[0].dofs[-1].joint.set_actuator_type(pydart2.Joint.SERVO)


@pytest.mark.parametrize("first", [True, False], ids=["enforced before", "enforced after"])
@pytest.mark.parametrize(
    ("act", "what"),
    [(enforce, "position"), (enforce, "velocity"), (serve, "position"), (serve, "velocity"), (serve, "force")],
)
def test_a_step_that_would_act_on_them_is_refused(
    world: pydart2.World, act: Callable[[pydart2.World], None], what: str, first: bool
) -> None:
    if first:
        act(world)
    world.step()  # looked at before, and again after the change
    invert(world, what)
    if not first:
        world.step()
        act(world)
    x = world.x
    for _ in range(2):
        with pytest.raises(pydart2.SimulationError, match=INVERTED.format(what)):
            world.step()
    with pytest.raises(pydart2.SimulationError, match=INVERTED.format(what)):
        world.check_collision()
    np.testing.assert_array_equal(world.x, x)
    getattr(world.skeletons[0].dofs[-1], f"set_{what}_upper_limit")(1.0)
    world.step()


@pytest.mark.parametrize(
    "copy",
    [
        pytest.param(lambda world: world.clone(), id="clone"),
        pytest.param(lambda world: pickle.loads(pickle.dumps(world)), id="pickle"),
        pytest.param(lambda world: pydart2.Batch(world, 2), id="batch"),
    ],
)
def test_copies_refuse_too(world: pydart2.World, copy: Callable[[pydart2.World], Any]) -> None:
    world.step()
    enforce(world)
    invert(world, "position")
    copied = copy(world)
    if isinstance(copied, pydart2.Batch):
        copied.step()
        assert "joint 10_z" in str(copied.failed[1])
    else:
        with pytest.raises(pydart2.SimulationError, match="joint 10_z"):
            copied.step()


@pytest.mark.parametrize("what", ["position", "velocity", "force"])
@pytest.mark.parametrize(("side", "bad", "good"), [("lower", np.inf, -np.inf), ("upper", -np.inf, np.inf)])
def test_infinite_means_none_on_that_side(world: pydart2.World, what: str, side: str, bad: float, good: float) -> None:
    set_limit = getattr(world.skeletons[0].dofs[0], f"set_{what}_{side}_limit")
    set_limit(good)
    for wrong in (bad, np.nan):
        with pytest.raises(ValueError, match=f"{side} {what} limit must be a number or {good}"):
            set_limit(wrong)
    enforce(world)
    serve(world)
    world.step()


def far_out(world: pydart2.World, caplog: pytest.LogCaptureFixture) -> list[str]:
    with caplog.at_level(logging.WARNING, "pydart2"):
        world.step(3)
    told = [record.getMessage() for record in caplog.records if "beyond its limits" in record.getMessage()]
    caplog.clear()
    return told


@pytest.mark.parametrize(
    ("kind", "far", "told"),
    [("revolute", 2.0 * np.pi, "is a turn beyond its limits of -0.5 and 1 rad"),
     ("prismatic", 1.5, "is the length of its range beyond its limits of -0.5 and 1 m")],
)  # fmt: skip
def test_a_position_far_beyond_limits_that_do_not_act_is_told_once(
    kind: str, far: float, told: str, caplog: pytest.LogCaptureFixture
) -> None:
    text = f"""<robot name="lift"><link name="base"/><link name="table"><inertial><mass value="1"/>
    <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
    <joint name="rail" type="{kind}"><parent link="base"/><child link="table"/><axis xyz="1 0 0"/>
    <limit lower="-0.5" upper="1" effort="1" velocity="1"/></joint></robot>"""
    for enforced in (True, False):
        world = pydart2.World(0.001)
        dof = world.add_skeleton(text, enforce_limits=enforced).dofs[-1]
        dof.set_position(1.0 + far - 0.01)
        assert far_out(world, caplog) == []
        dof.set_position(1.0 + far + 0.01)
        lines = far_out(world, caplog)
        assert [f"dof 'rail' of skeleton 'lift' {told}" in line for line in lines] == ([] if enforced else [True])
        assert far_out(world, caplog) == []
