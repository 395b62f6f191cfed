"""What URDF links without <inertial> weigh."""

from __future__ import annotations

import pickle
import re
from typing import Any

import numpy as np
import pytest

from pydart2 import LoadError, SimulationError, World

INERTIAL = "<inertial><mass value='2'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial>"
LIMIT = "<limit lower='-1' upper='1' effort='9' velocity='9'/>"


def joint(parent: str, child: str, kind: str = "fixed", axis: str = "0 1 0") -> str:
    return (
        f"<joint name='to_{child}' type='{kind}'><parent link='{parent}'/><child link='{child}'/>"
        f"<axis xyz='{axis}'/>{LIMIT if kind == 'revolute' else ''}</joint>"
    )


def robot(*parts: str) -> str:
    """Links: ``"name"`` without mass, ``"name+"`` with 2 kg; joints as they are."""
    links = [
        f"<link name='{p[:-1]}'>{INERTIAL}</link>" if p[-1] == "+" else f"<link name='{p}'/>"
        for p in parts
        if p[0] != "<"
    ]
    return "\n".join(["<robot name='r'>", *links, *(p for p in parts if p[0] == "<"), "</robot>"])


ARM = robot(
    "world",
    "arm+",
    "flange",
    "tool",
    joint("world", "arm", "revolute"),
    joint("arm", "flange"),
    joint("flange", "tool"),
)
FOOTPRINT = robot("footprint", "base+", joint("footprint", "base"))
TWO_AXES = robot("world", "pan", "tilt+", joint("world", "pan", "revolute", "0 0 1"), joint("pan", "tilt", "revolute"))
ONE_AXIS_TWICE = robot("world", "pan", "tilt+", joint("world", "pan", "revolute"), joint("pan", "tilt", "revolute"))
LEAF = robot("world", "arm+", "tip", joint("world", "arm", "revolute"), joint("arm", "tip", "revolute"))
PAN_AND_LEAF = robot(
    "world",
    "pan",
    "tilt",
    "eye",
    joint("world", "pan", "revolute"),
    joint("pan", "tilt", "revolute"),
    joint("tilt", "eye"),
)
FLOATING_HINGE = robot("hub", "arm+", joint("hub", "arm", "revolute"))


@pytest.mark.parametrize(
    ("text", "masses", "named"),
    [
        (ARM, {"arm": 2.0, "flange": 0.0, "tool": 0.0}, []),
        (FOOTPRINT, {"footprint": 0.0, "base": 2.0}, []),
        (TWO_AXES, {"pan": 0.0, "tilt": 2.0}, []),
        (LEAF, {"arm": 2.0, "tip": 1.0}, ["tip"]),
        (PAN_AND_LEAF, {"pan": 1.0, "tilt": 1.0, "eye": 0.0}, ["pan", "tilt"]),
        (robot("alone"), {"alone": 1.0}, ["alone"]),
        (FLOATING_HINGE, {"hub": 1.0, "arm": 2.0}, ["hub"]),  # seven coordinates would move one body
    ],
    ids=["frames", "free root", "between two axes", "leaf that moves", "no mass at all", "alone", "too few bodies"],
)
def test_masses(text: str, masses: dict[str, float], named: list[str], caplog: Any, capfd: Any) -> None:
    """One warning names those that keep the engine's 1 kg; all of them can be stepped."""
    world = World(0.001)
    skel = world.add_skeleton(text)
    assert {body.name: body.m for body in skel.bodynodes} == masses
    warnings = [record.getMessage() for record in caplog.records]
    assert len(warnings) == bool(named)
    assert all(f"'{name}'" in warnings[0] for name in named)
    skel.dq = np.full(skel.ndofs, 0.3)
    world.step(20)
    assert np.isfinite(skel.q).all()
    assert capfd.readouterr() == ("", "")


def test_the_engines_way() -> None:
    text = robot(
        "world",
        "arm+",
        "flange",
        "tool",
        joint("world", "arm", "revolute"),
        joint("arm", "flange"),
        joint("flange", "tool"),
    )
    assert World(0.001).add_skeleton(text, engine_defaults=True).m == 4.0
    assert World(0.001, text, engine_defaults=True).skeletons[0].m == 4.0
    with pytest.raises(ValueError, match="exclude each other"):
        World(0.001).add_skeleton(text, engine_defaults=True, massless=True)


def test_sdf_keeps_its_formats_kilogram() -> None:
    text = "<sdf version='1.5'><model name='m'><link name='l'/></model></sdf>"
    assert World(0.001).add_skeleton(text).m == 1.0


def test_massless_is_for_kinematics(caplog: Any) -> None:
    """M, Jacobians and poses are there; a step says which body has nothing to move."""
    world = World(0.001)
    skel = world.add_skeleton(LEAF, massless=True)
    assert caplog.records == []
    assert skel.m == 2.0 and skel.M[1, 1] == 0.0
    assert skel.body("tip").linear_jacobian().shape == (3, 2)
    with pytest.raises(SimulationError, match="body 'tip' of skeleton 'r' moves nothing that has inertia"):
        world.step()


def test_masses_that_are_points_are_for_kinematics() -> None:
    """A mass without moments of inertia on its own axis turns by nothing; away from it, it has mass times distance²."""
    point = re.sub("(ixx|iyy|izz)='[^']*'", r"\1='0'", ARM)
    world = World(0.001)
    skel = world.add_skeleton(point)
    assert skel.m == 2.0 and (skel.M == 0.0).all()
    with pytest.raises(SimulationError, match="body 'arm' of skeleton 'r' moves nothing that has inertia"):
        world.step()
    away = point.replace("<mass", "<origin xyz='1 1 1'/><mass")  # 1² + 1² from the y axis
    world = World(0.001)
    assert world.add_skeleton(away).M[0, 0] == pytest.approx(2.0 * 2.0, rel=1e-12)
    world.step()


def test_strict_refuses_at_the_line() -> None:
    with pytest.raises(LoadError, match=r"line 4: no <inertial> in 'tip'"):
        World(0.001).add_skeleton(LEAF, strict=True)
    assert World(0.001).add_skeleton(ARM, strict=True).m == 2.0


def test_an_axis_twice_has_no_answer() -> None:
    """Two hinges about one line turn one body: the error says what to do."""
    with pytest.raises(LoadError, match="engine_defaults=True"):
        World(0.001).add_skeleton(ONE_AXIS_TWICE)
    World(0.001).add_skeleton(ONE_AXIS_TWICE, engine_defaults=True).world.step()


def test_copies_and_pickles_weigh_the_same(capfd: Any) -> None:
    world = World(0.001)
    world.add_skeleton(ARM)
    for copy in (world.clone(), pickle.loads(pickle.dumps(world))):
        assert [body.m for body in copy.skeletons[0].bodynodes] == [2.0, 0.0, 0.0]
    assert capfd.readouterr() == ("", "")


def test_frames_do_not_move_the_robot_otherwise() -> None:
    """The dynamics are those of the robot without its frames, bit for bit where one can expect it."""
    frames, bare = World(0.001), World(0.001)
    with_frames = frames.add_skeleton(ARM)
    without = bare.add_skeleton(robot("world", "arm+", joint("world", "arm", "revolute")))
    for skel in (with_frames, without):
        skel.q = [0.4]
        skel.world.step(200)
    np.testing.assert_allclose(with_frames.q, without.q, rtol=1e-13)
