"""What would end the process in spite of assertions that throw: all is known, and what input reaches is refused."""

from __future__ import annotations

import importlib.util
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import pydart2
from pydart2 import constraints

TOOL = Path(__file__).parents[2] / "tools" / "engine_assertions.py"
OF_THE_TABLE = "6.12.1"  # of DART, as Debian 12 has it


def tool() -> Any:
    spec = importlib.util.spec_from_file_location("engine_assertions", TOOL)
    assert spec and spec.loader
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="module")
def listed() -> Any:
    return tool()


def test_the_table_is_that_of_the_library(listed: Any) -> None:
    file = listed.installed("libdart").name
    if OF_THE_TABLE not in file:
        pytest.skip(f"tests/engine_assertions.txt is of DART {OF_THE_TABLE}; here is {file}, compiled to other code")
    assert listed.table() == listed.TABLE.read_text(), "python tools/engine_assertions.py writes it anew"


def two_links(world: pydart2.World, second: str) -> pydart2.Skeleton:
    skel = world.add_empty_skeleton("links")
    skel.add_body("a", joint="revolute").add_box([0.1, 0.1, 0.1])
    skel.add_body("b", "a", joint=second).add_box([0.1, 0.1, 0.1])
    return skel


def weld_twice(world: pydart2.World, body: pydart2.BodyNode) -> None:
    weld = constraints.WeldJointConstraint(body)
    weld.add_to_world(world)
    weld.add_to_world(world)


def wrong_limits(world: pydart2.World, body: pydart2.BodyNode) -> None:
    dof = two_links(world, "revolute").dofs[0]
    dof.set_position_lower_limit(1.0)
    dof.set_position_upper_limit(-1.0)
    dof.skel.joints[0].set_position_limit_enforced(True)
    world.step()


def sizes(world: pydart2.World, body: pydart2.BodyNode) -> None:
    """All but the last are tried here."""
    adders: list[Callable[[], Any]] = [
        lambda: body.add_capsule(0.0, 1.0),
        lambda: body.add_capsule(1.0, 0.0),
        lambda: body.add_cone(0.0, 1.0),
        lambda: body.add_cone(1.0, 0.0),
        lambda: body.add_cylinder(0.0, 1.0),
        lambda: body.add_cylinder(1.0, 0.0),
    ]
    for adder in adders:
        with pytest.raises(ValueError):
            adder()
    body.shapenodes[0].shape.set_size([0.1, 0.0, 0.1])


#: With cubes.skel and the body of its second skeleton.
CASES: dict[str, Callable[[pydart2.World, pydart2.BodyNode], Any]] = {
    "sizes": sizes,
    "friction": lambda world, body: body.set_friction_coeff(-1.0),
    "damping": lambda world, body: body.skel.dofs[0].set_damping_coefficient(-1.0),
    "stiffness": lambda world, body: body.skel.dofs[0].set_spring_stiffness(-1.0),
    "Coulomb friction": lambda world, body: body.skel.dofs[0].set_coulomb_friction(-1.0),
    "time step": lambda world, body: world.set_time_step(0.0),
    "index of a dof": lambda world, body: body.skel.joints[0].set_command(6, 1.0),
    "actuator type": lambda world, body: body.skel.joints[0].set_actuator_type(99),
    "number of values": lambda world, body: body.skel.set_positions(np.zeros(5)),
    "centre of no mass": lambda world, body: world.add_empty_skeleton("none").C,
    "index of a body": lambda world, body: body.skel.body(1),
    "index of a shape": lambda world, body: pydart2.ShapeNode(body, 99).offset(),
    "limits the wrong way round": wrong_limits,
    "a body welded to itself": lambda world, body: constraints.WeldJointConstraint(body, body).add_to_world(world),
    "mimic of another number of dofs": lambda world, body: (lambda skel: skel.joints[1].set_mimic(skel.joints[0]))(
        two_links(world, "ball")
    ),
    "of no joint": lambda world, body: body.skel.joints[0].set_actuator_type(pydart2.Joint.MIMIC),
    "a constraint twice": weld_twice,
    "heights in one row": lambda world, body: body.add_heightfield([[1.0, 2.0]], [1.0, 1.0, 1.0]),
}


def test_each_case_is_one_of_the_table(listed: Any) -> None:
    answers = [answer.removeprefix("refused: ") for *_, answer in listed.RULES if answer.startswith("refused: ")]
    assert {case for answer in answers for case in answer.split(", ")} == set(CASES)


@pytest.mark.parametrize("case", CASES)
def test_what_input_reaches_is_refused(case: str) -> None:
    """By a documented error; then the world steps on."""
    world = pydart2.World(0.001, "skel/cubes.skel")
    with pytest.raises((pydart2.PydartError, ValueError, IndexError)):
        CASES[case](world, world.skeletons[1].bodynodes[0])
    if case == "limits the wrong way round":
        world.remove_skeleton(world.skeletons[-1])
    world.step(3)
    assert world.frame >= 3 and np.isfinite(world.x).all()
