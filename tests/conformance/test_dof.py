"""Degrees of freedom."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from pydart2 import Dof, Skeleton

from .table import row, rows


@pytest.fixture
def dof(zoo: Skeleton) -> Dof:
    """The second dof of the ball joint."""
    return zoo.dofs[8]


@row("dof.Dof")
def test_constructor(zoo: Skeleton) -> None:
    dof = Dof(zoo, 8)
    dof.set_position(0.125)
    assert (dof.name, zoo.dofs[8].position()) == (zoo.dofs[8].name, 0.125)


@rows(
    "dof.Dof.",
    {
        "skeleton": lambda dof: dof.skeleton is dof.joint.skeleton,
        "skel": lambda dof: dof.skel.dofs[8] is dof,
        "id": lambda dof: dof.id == 8,
        "index": lambda dof: dof.index == 8,
        "name": lambda dof: dof.name == "ball joint_y",
        "joint": lambda dof: dof.joint is dof.skel.joint("ball joint"),
        "wid": lambda dof: dof.wid == dof.skel.world.id,
        "skid": lambda dof: dof.skid == dof.skel.id,
        "index_in_skeleton": lambda dof: dof.index_in_skeleton() == 8,
        "index_in_tree": lambda dof: dof.index_in_tree() == 8,
        "index_in_joint": lambda dof: dof.index_in_joint() == 1,
        "tree_index": lambda dof: dof.tree_index() == 0,
        "__repr__": lambda dof: repr(dof) == "[Dof(8): ball joint_y]",
    },
)
def test_attribute(dof: Dof, case: Callable[[Dof], bool]) -> None:
    assert case(dof)


@rows(
    "dof.Dof.", {"position": "position", "set_position": "position", "velocity": "velocity", "set_velocity": "velocity"}
)
def test_state(dof: Dof, case: str) -> None:
    getattr(dof, f"set_{case}")(0.125)
    assert getattr(dof, case)() == 0.125
    assert {"position": dof.skel.q, "velocity": dof.skel.dq}[case][8] == 0.125


@rows("dof.Dof.", {f"{prefix}initial_{name}": name for name in ("position", "velocity") for prefix in ("", "set_")})
def test_initial(dof: Dof, case: str) -> None:
    assert getattr(dof, f"initial_{case}")() == 0.0
    getattr(dof, f"set_initial_{case}")(0.125)
    assert getattr(dof, f"initial_{case}")() == 0.125
    dof.skel.world.reset()
    assert getattr(dof, case)() == 0.125


LIMITS = {
    "position_lower_limit": -np.inf,
    "position_upper_limit": np.inf,
    "velocity_lower_limit": -np.inf,
    "velocity_upper_limit": np.inf,
}


@rows("dof.Dof.", {prefix + name: (name, default) for name, default in LIMITS.items() for prefix in ("", "set_")})
def test_limit(dof: Dof, case: tuple[str, float]) -> None:
    name, default = case
    assert getattr(dof, name)() == default
    limit = np.sign(default) * 2.0
    getattr(dof, f"set_{name}")(limit)
    assert getattr(dof, name)() == limit
    if name.startswith("position"):
        assert {-2.0: dof.skel.q_lower, 2.0: dof.skel.q_upper}[limit][8] == limit


@row("dof.Dof.has_position_limit")
def test_has_position_limit(zoo: Skeleton) -> None:
    dof = zoo.dofs[0]
    assert dof.has_position_limit() is False
    dof.set_position_upper_limit(1.0)
    assert dof.has_position_limit() is True


def acceleration(dof: Dof) -> float:
    """What the dof, at rest at 0.5, gets in a step."""
    dof.skel.q, dof.skel.dq = np.zeros(dof.skel.ndofs), np.zeros(dof.skel.ndofs)
    dof.set_position(0.5)
    dof.set_velocity(0.1)
    dof.skel.world.step()
    return (dof.velocity() - 0.1) / dof.skel.world.dt


PASSIVE = {
    "spring_stiffness": lambda dof: dof.set_spring_stiffness(2.0),
    "rest_position": lambda dof: (dof.set_spring_stiffness(1.0), dof.set_rest_position(2.0)),
    "damping_coefficient": lambda dof: dof.set_damping_coefficient(2.0),
    "coulomb_friction": lambda dof: dof.set_coulomb_friction(2.0),
}


@rows("dof.Dof.", {prefix + name: (name, force) for name, force in PASSIVE.items() for prefix in ("", "set_")})
def test_passive_force(zoo: Skeleton, case: tuple[str, Callable[[Dof], object]]) -> None:
    name, set_force = case
    dof = zoo.dofs[0]
    without = acceleration(dof)
    assert getattr(dof, name)() == 0.0
    set_force(dof)
    assert getattr(dof, name)() == 2.0
    assert (acceleration(dof) > without + 1e-4) == (name == "rest_position")
    assert abs(acceleration(dof) - without) > 1e-4


@row("dof.Dof.constraint_impulse", "dof.Dof.set_constraint_impulse")
def test_constraint_impulse(dof: Dof) -> None:
    assert dof.constraint_impulse() == 0.0
    dof.set_constraint_impulse(0.125)
    assert dof.constraint_impulse() == 0.125
