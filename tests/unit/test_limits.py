"""Limits the wrong way round: taken one bound at a time, refused by the step that would act on them, by name."""

from __future__ import annotations

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
