"""Wrong input raises, says what was asked, expected and got, and changes nothing."""

from __future__ import annotations

import copy
import os
import pickle
import re
import subprocess
import sys
import textwrap
import threading
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import pydart2
from physics.models import arm, creature, make_world, pendulum
from pydart2 import DestroyedError, LoadError, NameNotFound, PydartError, SimulationError
from pydart2.joint import Joint

NAN, INF = float("nan"), float("inf")
TESTS = Path(__file__).resolve().parent.parent


@pytest.fixture
def world(tmp_path: Path) -> pydart2.World:
    return make_world(tmp_path, creature(), pendulum())


@pytest.fixture
def skel(world: pydart2.World) -> pydart2.Skeleton:
    return world.skeletons[0]


def test_classes() -> None:
    for error in (LoadError, SimulationError, DestroyedError):
        assert issubclass(error, PydartError)
    assert issubclass(PydartError, RuntimeError)
    assert issubclass(LoadError, OSError)
    assert issubclass(NameNotFound, KeyError) and issubclass(NameNotFound, ValueError)


VECTORS = ["set_positions", "set_velocities", "set_accelerations", "set_forces"]


@pytest.mark.parametrize("setter", VECTORS)
@pytest.mark.parametrize("size", [0, 15, 17, 32])
def test_wrong_length(skel: pydart2.Skeleton, setter: str, size: int) -> None:
    state = skel.x
    with pytest.raises(ValueError, match=rf"{setter[4:]} needs 16 numbers, got {size}"):
        getattr(skel, setter)(np.zeros(size))
    np.testing.assert_array_equal(skel.x, state)


@pytest.mark.parametrize("attribute", ["q", "dq", "ddq", "tau"])
@pytest.mark.parametrize("bad", [NAN, INF, -INF])
def test_not_finite(skel: pydart2.Skeleton, attribute: str, bad: float) -> None:
    state = skel.x
    values = np.zeros(16)
    values[5] = bad
    with pytest.raises(ValueError, match=rf"must be finite, got -?{abs(bad)} at index 5"):
        setattr(skel, attribute, values)
    np.testing.assert_array_equal(skel.x, state)


@pytest.mark.parametrize("attribute", ["q", "dq", "ddq", "tau", "x"])
@pytest.mark.parametrize("bad", ["text", object(), ["0"] * 15 + ["x"], [[0.0], [0.0, 1.0]], {"a"}, 1j * np.ones(16)])
def test_wrong_type(skel: pydart2.Skeleton, attribute: str, bad: Any) -> None:
    with pytest.raises(TypeError, match="needs numbers, got"):
        setattr(skel, attribute, bad)


@pytest.mark.parametrize("bad", [None, [None] * 16])
def test_none_is_no_number(skel: pydart2.Skeleton, bad: Any) -> None:
    """NumPy takes None for nan."""
    with pytest.raises((TypeError, ValueError), match="positions"):
        skel.q = bad
    assert not skel.q.any()


@pytest.mark.parametrize("bad", [0.5, np.zeros((16, 1)), np.zeros((1, 16)), np.zeros((4, 4))])
def test_wrong_number_of_dimensions(skel: pydart2.Skeleton, bad: Any) -> None:
    with pytest.raises(ValueError, match=r"needs shape \(n,\), got \("):
        skel.q = bad


def test_anything_like_an_array_is_taken(skel: pydart2.Skeleton) -> None:
    big = np.zeros((16, 3), order="F")
    big[:, 1] = range(16)
    read_only = np.arange(16.0)
    read_only.flags.writeable = False
    swapped = np.arange(16.0).astype(">f8")
    for values in (range(16), tuple(range(16)), np.arange(16, dtype=np.int8), np.arange(16, dtype=np.float32)):
        skel.q = values
        assert skel.q.tolist() == list(range(16))
    for values in (big[:, 1], read_only, swapped, np.arange(32.0)[::2] / 2, skel.q):
        skel.q = np.zeros(16)
        skel.q = values
        assert skel.q.tolist() == list(range(16))


def test_states(world: pydart2.World, skel: pydart2.Skeleton) -> None:
    with pytest.raises(ValueError, match=r"states \[q, dq\] needs 32 numbers, got 16"):
        skel.x = np.zeros(16)
    with pytest.raises(ValueError, match="world states needs 34 numbers, got 33"):
        world.x = np.zeros(33)
    with pytest.raises(ValueError, match="must be finite, got nan at index 33"):
        world.x = [0.0] * 33 + [NAN]
    assert not world.x.any()


def test_a_base_that_floats_is_named(fullbody: pydart2.World) -> None:
    human = fullbody.skeletons[1]
    with pytest.raises(
        ValueError, match=r"positions \(the first 6 are of the base, which floats; .* needs 37 numbers, got 31"
    ):
        human.q = np.zeros(31)
    with pytest.raises(ValueError, match=r"^positions needs 37 numbers, got 30"):
        human.q = np.zeros(30)


def test_position_differences(skel: pydart2.Skeleton) -> None:
    with pytest.raises(ValueError, match="positions needs 16 numbers, got 3"):
        skel.position_differences(np.zeros(16), np.zeros(3))
    with pytest.raises(ValueError, match="must be finite"):
        skel.velocity_differences(np.full(16, NAN), np.zeros(16))


BodyCall = Callable[[pydart2.BodyNode, Any], Any]
BAD_VECTORS = [([1, 2], ValueError), (np.zeros((3, 1)), ValueError), ("up", TypeError), (np.zeros(4), ValueError)]
BODY_SETTERS: list[BodyCall] = [
    lambda b, v: b.add_ext_force(v),
    lambda b, v: b.add_ext_force([0, 0, 1], v),
    lambda b, v: b.set_ext_force(v),
    lambda b, v: b.set_ext_force([0, 0, 1], v),
    lambda b, v: b.add_ext_torque(v),
    lambda b, v: b.set_ext_torque(v),
    lambda b, v: b.set_local_com(v),
    lambda b, v: setattr(b.world, "g", v),
]
BODY_QUERIES: list[BodyCall] = [
    lambda b, v: b.to_local(v),
    lambda b, v: b.to_world(v),
    lambda b, v: b.linear_jacobian(v),
    lambda b, v: b.jacobian(v),
    lambda b, v: b.linear_jacobian_deriv(v),
]


@pytest.mark.parametrize("call", BODY_SETTERS + BODY_QUERIES)
@pytest.mark.parametrize(("bad", "error"), BAD_VECTORS, ids=str)
def test_three_numbers(skel: pydart2.Skeleton, call: BodyCall, bad: Any, error: type[Exception]) -> None:
    with pytest.raises(error, match=r"needs shape \(3,\), got|needs numbers, got 'up'"):
        call(skel.body("hand"), bad)


@pytest.mark.parametrize("call", BODY_SETTERS)
@pytest.mark.parametrize("bad", [NAN, INF])
def test_three_finite_numbers(skel: pydart2.Skeleton, call: BodyCall, bad: float) -> None:
    with pytest.raises(ValueError, match=f"must be finite, got {bad}"):
        call(skel.body("hand"), [0, bad, 0])
    skel.world.step()
    assert np.all(np.isfinite(skel.q))


def test_masses_and_inertias(skel: pydart2.Skeleton) -> None:
    body = skel.body("hand")
    for bad in (0, -1, NAN, INF):
        with pytest.raises(ValueError, match="must be positive and finite, got"):
            body.set_mass(bad)
    with pytest.raises(ValueError, match="symmetric"):
        body.set_inertia([[1, 0.5, 0], [0, 1, 0], [0, 0, 1]])
    with pytest.raises(ValueError, match="positive definite"):
        body.set_inertia_entries(1, 1, -1)
    with pytest.raises(ValueError, match=r"shape \(3, 3\), got \(3,\)"):
        body.set_inertia([1, 1, 1])
    with pytest.raises(ValueError, match="zero or positive"):
        body.set_friction_coeff(-0.1)


@pytest.mark.parametrize("bad", [0, -0.001, NAN, INF])
def test_time_step(world: pydart2.World, bad: float) -> None:
    with pytest.raises(ValueError, match="time step must be positive and finite, got"):
        pydart2.World(bad)
    with pytest.raises(ValueError, match="time step must be positive and finite, got"):
        world.dt = bad
    assert world.dt == 0.001


def test_steps(world: pydart2.World) -> None:
    with pytest.raises(ValueError, match="number of steps must be zero or positive, got -1"):
        world.step(-1)
    for bad in (1.5, "2", None):
        with pytest.raises(TypeError):
            world.step(bad)  # type: ignore[arg-type]
    world.step(np.int64(2))
    assert world.frame == 2


@pytest.mark.parametrize(
    ("kind", "bad", "message"),
    [
        ("bodynode", "hnd", "no body 'hnd' in skeleton 'creature'; did you mean 'hand'?"),
        ("body", "zzzz", "no body 'zzzz' in skeleton 'creature'"),
        ("joint", "thigh", "no joint 'thigh' in skeleton 'creature'; did you mean 'thigh_joint'?"),
        ("dof", "hand_joint", "no dof 'hand_joint' in skeleton 'creature'; did you mean 'hand_joint_"),
        ("dof_index", "", "no dof '' in skeleton 'creature'"),
        ("bodynode_index", "Hand", "no body 'Hand' in skeleton 'creature'; did you mean 'hand'?"),
    ],
)
def test_unknown_names(skel: pydart2.Skeleton, kind: str, bad: str, message: str) -> None:
    with pytest.raises(NameNotFound) as info:
        getattr(skel, kind)(bad)
    assert str(info.value).startswith(message)
    assert isinstance(info.value, KeyError) and isinstance(info.value, ValueError)


@pytest.mark.parametrize("make", [pickle.dumps, copy.copy, copy.deepcopy])
def test_name_not_found_travels(make: Callable[[Any], Any]) -> None:
    error = NameNotFound("dof", "kne", "skeleton 'robot'", ["knee", "hip"])
    got = make(error)
    got = pickle.loads(got) if isinstance(got, bytes) else got
    assert type(got) is NameNotFound
    assert str(got) == str(error) == "no dof 'kne' in skeleton 'robot'; did you mean 'knee'?"


@pytest.mark.parametrize("error", [PydartError, LoadError, SimulationError, DestroyedError])
def test_errors_travel(error: type[Exception]) -> None:
    got = pickle.loads(pickle.dumps(error("what happened")))
    assert type(got) is error and str(got) == "what happened"
    assert type(error.__new__(error, "made as Dask's workers do")) is error


@pytest.mark.parametrize("index", [6, -7, 10**6, np.int64(6)])
def test_bad_index(skel: pydart2.Skeleton, index: int) -> None:
    with pytest.raises(IndexError, match=f"no body {index} in skeleton 'creature': there are 6"):
        skel.body(index)


def test_indices_count_from_either_end(skel: pydart2.Skeleton) -> None:
    assert [skel.body(index) for index in range(-6, 6)] == 2 * skel.bodynodes


@pytest.mark.parametrize("query", [1.5, None, ["hand"], b"hand"])
def test_bad_query(skel: pydart2.Skeleton, query: Any) -> None:
    for find in (skel.body, skel.joint, skel.dof):
        with pytest.raises(TypeError, match="is found by name or index, not by"):
            find(query)


@pytest.mark.parametrize("index", [3, -1, 2**40, 2**70])
def test_bad_index_of_a_handle(world: pydart2.World, skel: pydart2.Skeleton, index: int) -> None:
    with pytest.raises(IndexError, match=r"out of range|too large"):
        world._handle.skeleton(index)
    for get in (skel._handle.bodynode, skel._handle.joint, skel._handle.dof, skel._handle.marker):
        with pytest.raises(IndexError, match=r"out of range|too large"):
            get(index + 13 if 0 <= index < 100 else index)
    with pytest.raises(IndexError):
        pydart2.Skeleton(world, _id=index)


def test_bad_dof_of_a_joint(skel: pydart2.Skeleton) -> None:
    with pytest.raises(IndexError, match="joint 'hand_joint' has 2 dofs, so no dof 2"):
        skel.joint("hand_joint").position_lower_limit(2)
    with pytest.raises(IndexError):
        skel.joint("hand_joint").set_damping_coefficient(-1, 1.0)


@pytest.mark.parametrize("detector", [-1, 5, None, 1.5])
def test_bad_detector(world: pydart2.World, detector: Any) -> None:
    with pytest.raises(ValueError, match=r"no collision detector .*; they are 0 \(dart\) 1 \(fcl\)") as info:
        world.set_collision_detector(detector)
    assert repr(detector) in str(info.value)
    world.step()


@pytest.mark.parametrize(("asked", "nearest"), [("fclo", "fcl"), ("Bullet", "bullet"), ("natve", "native")])
def test_bad_detector_name(world: pydart2.World, asked: str, nearest: str) -> None:
    with pytest.raises(pydart2.NameNotFound, match=f"no collision detector '{asked}' .*; did you mean '{nearest}'?"):
        world.set_collision_detector(asked)


@pytest.mark.parametrize("actuator", [-1, 7, "SERVO", None])
def test_bad_actuator(skel: pydart2.Skeleton, actuator: Any) -> None:
    with pytest.raises(ValueError, match=r"no actuator type .* Joint.FORCE = 0 to Joint.MIMIC = 6"):
        skel.joints[1].set_actuator_type(actuator)
    with pytest.raises(ValueError, match="'thigh_joint' follows no joint yet; use set_mimic"):
        skel.joints[1].set_actuator_type(Joint.MIMIC)


def test_wrong_joint_kind(skel: pydart2.Skeleton) -> None:
    """A class for a kind that the joint is not: the original returned uninitialised memory."""
    ball = skel.joint("head_joint").id
    for call, asked in (
        (pydart2.RevoluteJoint(skel, ball).axis, "axis"),
        (pydart2.UniversalJoint(skel, ball).axis2, "axis2"),
        (pydart2.EulerJoint(skel, ball).axis_order, "axis order"),
        (lambda: pydart2.RevoluteJoint(skel, ball).set_axis([1, 0, 0]), "axis"),
    ):
        with pytest.raises(TypeError, match=f"joint 'head_joint' is a BallJoint and has no {asked}"):
            call()


def test_axes(skel: pydart2.Skeleton) -> None:
    with pytest.raises(ValueError, match="must not be the zero vector"):
        skel.joint("thigh_joint").set_axis([0, 0, 0])
    with pytest.raises(ValueError, match="the axis order is 'XYZ' or 'ZYX', got 'YXZ'"):
        skel.joint("tail_joint").set_axis_order("YXZ")


def test_transforms(skel: pydart2.Skeleton) -> None:
    joint = skel.joints[1]
    for bad in (np.zeros((4, 4)), 2 * np.eye(4), np.diag([1, 1, -1, 1]), np.ones((4, 4))):
        with pytest.raises(ValueError, match="must be a rigid 4x4 transform"):
            joint.set_transform_from_parent_body_node(bad)
    with pytest.raises(ValueError, match=r"shape \(4, 4\), got \(3, 3\)"):
        joint.set_transform_from_child_body_node(np.eye(3))


def test_limits_may_be_infinite_but_not_nan(skel: pydart2.Skeleton) -> None:
    dof = skel.dofs[6]
    dof.set_position_upper_limit(INF)
    for setter in (dof.set_position_lower_limit, dof.set_velocity_upper_limit, dof.set_force_lower_limit):
        with pytest.raises(ValueError, match="nan"):
            setter(NAN)
    for setter in (dof.set_position, dof.set_velocity, dof.set_rest_position, dof.set_initial_position):
        with pytest.raises(ValueError, match="finite"):
            setter(NAN)
    for setter in (dof.set_spring_stiffness, dof.set_damping_coefficient, dof.set_coulomb_friction):
        with pytest.raises(ValueError, match="zero or positive"):
            setter(-1)
    with pytest.raises(TypeError, match="must be a number"):
        dof.set_position("1")  # type: ignore[arg-type]


@pytest.mark.parametrize("bad", [None, 3, b"box", ["box"]])
def test_a_name_is_a_string(world: pydart2.World, skel: pydart2.Skeleton, bad: Any) -> None:
    setters = [world.set_dynamics, world.set_integrator, world.set_constraint_solver, skel.joints[1].set_name]
    for call in (*setters, world.add_empty_skeleton, skel.add_body):
        with pytest.raises(TypeError, match=f"must be a string, got {re.escape(repr(bad))}"):
            call(bad)
    assert (world.num_skeletons(), skel.num_bodynodes(), skel.joints[1].name) == (2, 6, "thigh_joint")


def test_names_that_are_no_utf8_come_back(skel: pydart2.Skeleton) -> None:
    """As os.fsdecode() makes them of the bytes in a file of the past."""
    name = os.fsdecode(b"caf\xe9")
    skel.joints[1].set_name(name)
    assert skel.joints[1].name == name
    assert skel.joint(name) == skel.joints[1]


@pytest.mark.parametrize("flag", [True, False, 1, 0, np.True_, np.False_, np.int64(1)])
def test_lenient_flags(skel: pydart2.Skeleton, flag: Any) -> None:
    skel.set_mobile(flag)
    assert skel.is_mobile() is bool(flag)
    skel.set_self_collision_check(flag)
    assert skel.self_collision_check() is bool(flag)


@pytest.mark.parametrize("flag", ["yes", None, 1.0, [True]])
def test_bad_flags(skel: pydart2.Skeleton, flag: Any) -> None:
    with pytest.raises(TypeError, match="must be True or False, got"):
        skel.set_mobile(flag)


CONTENTS = ["", "garbage", "<", "<skel/>", "<robot name='r'/>", "\0\0", "<sdf version='1.4'/>"]


@pytest.mark.parametrize("extension", ["skel", "urdf", "sdf", "vsk"])
@pytest.mark.parametrize("content", CONTENTS, ids=repr)
def test_files_without_a_model(tmp_path: Path, extension: str, content: str) -> None:
    path = tmp_path / f"model.{extension}"
    path.write_text(content)
    world = pydart2.World(0.001)
    with pytest.raises(LoadError) as info:
        world.add_skeleton(path)
    assert str(path) in str(info.value)
    assert world.num_skeletons() == 0 and world.skeletons == []


@pytest.mark.parametrize("content", CONTENTS, ids=repr)
def test_world_files_without_a_world(tmp_path: Path, content: str) -> None:
    path = tmp_path / "world.skel"
    path.write_text(content)
    with pytest.raises(LoadError) as info:
        pydart2.World(0.001, path)
    assert str(path) in str(info.value)


def test_missing_and_wrong_files(tmp_path: Path) -> None:
    world = pydart2.World(0.001)
    for load in (lambda p: pydart2.World(0.001, p), world.add_skeleton):
        with pytest.raises(LoadError, match=r"no file .*nothing\.skel"):
            load(tmp_path / "nothing.skel")
        with pytest.raises(LoadError, match=str(tmp_path)):
            load(tmp_path)


def survives(folder: Path, code: str) -> None:
    """Runs code, with a world in it, in a process of its own: what goes wrong may be an abort."""
    setup = (
        f"import sys; sys.path.insert(0, {str(TESTS)!r})\nfrom pathlib import Path; folder = Path({str(folder)!r})\n"
    )
    setup += "import numpy as np, pydart2; from physics.models import *\n"
    script = setup + textwrap.dedent(code)
    done = subprocess.run([sys.executable, "-X", "faulthandler", "-c", script], capture_output=True, text=True)
    assert done.returncode == 0, f"exit code {done.returncode}\n{done.stderr[:2000]}"


def test_a_skeleton_without_bodies(tmp_path: Path) -> None:
    """SDF allows it; there is nothing to simulate."""
    (tmp_path / "empty.sdf").write_text("<sdf version='1.4'><model name='nothing'/></sdf>")
    with pytest.raises(LoadError, match="skeleton 'nothing' has no bodies"):
        pydart2.World(0.001).add_skeleton(tmp_path / "empty.sdf")


@pytest.mark.parametrize("attribute", ["q", "dq", "tau"])
@pytest.mark.parametrize("size", [1e8, 1e160, 1e300])
def test_huge_numbers(tmp_path: Path, attribute: str, size: float) -> None:
    """The simulation may become useless, and then says so; Python goes on."""
    survives(
        tmp_path,
        f"""
        world = make_world(folder, creature(), floor())
        skel = world.skeletons[0]
        try:
            for _ in range(20):
                skel.{attribute} = np.full(16, {size})
                world.step()
                world.x, skel.M, skel.C
            assert np.all(np.isfinite(world.x)), "not finite and not said"
        except (pydart2.SimulationError, ValueError):
            pass
        world.reset()
        world.step()
        assert np.all(np.isfinite(world.x))
        """,
    )


def test_two_threads_on_one_world(tmp_path: Path) -> None:
    """The second is told so; the first goes on."""
    world = make_world(tmp_path, arm(6))
    skel, body = world.skeletons[0], world.skeletons[0].bodynodes[3]
    thread = threading.Thread(target=world.step, args=(300_000,))
    thread.start()
    with pytest.raises(PydartError):
        while thread.is_alive():
            world.time()
    message = f"world {world.id} is in use by another thread; give each thread a world of its own"
    for call in (world.step, world.states, world.destroy, world.reset, lambda: skel.q, lambda: body.T, skel.build):
        with pytest.raises(PydartError, match=message):
            call()
    with pytest.raises(PydartError, match=message):
        skel.q = np.zeros(6)
    pydart2.World(0.001).step()  # others are free
    assert thread.is_alive()
    thread.join()
    assert world.frame == 300_000
    world.step()


def test_two_worlds_in_two_threads(tmp_path: Path) -> None:
    """As in one thread, bit for bit."""
    worlds = [make_world(tmp_path, arm(4)) for _ in range(3)]
    for world in worlds:
        world.skeletons[0].q = [0.1, 0.2, 0.3, 0.4]
    threads = [threading.Thread(target=world.step, args=(2000,)) for world in worlds[:2]]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    worlds[2].step(2000)
    for world in worlds[:2]:
        np.testing.assert_array_equal(world.x, worlds[2].x)
