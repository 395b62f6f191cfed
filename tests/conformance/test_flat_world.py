"""The flat functions of worlds, skeletons, markers and contacts."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

import pydart2
import pydart2.pydart2_api as papi
from pydart2 import Skeleton, World

from .table import row, rows

CUBES = "./data/skel/cubes.skel"
PREFIX = "pydart2_api."


def function(name: str) -> Callable[..., Any]:
    return getattr(papi, name)


@pytest.fixture
def wid() -> int:
    """The cubes."""
    return papi.createWorldFromSkel(CUBES)


@row(PREFIX + "IntVector")
def test_int_vector() -> None:
    vector = papi.IntVector([1, 2])
    vector.append(3)
    assert list(vector) == [1, 2, 3]


@row(PREFIX + "init", PREFIX + "createWorld")
def test_init(capfd: pytest.CaptureFixture[str]) -> None:
    papi.createWorld(0.001)
    papi.init()
    assert "Initialize pydart manager OK" in capfd.readouterr().out
    with pytest.raises(IndexError):
        papi.world__getTime(0)
    assert [papi.createWorld(0.25), papi.createWorld(0.5)] == [0, 1]
    assert papi.world__getTimeStep(1) == 0.5
    assert_allclose(papi.world__getGravity(1), [0, -9.81, 0])


@row(PREFIX + "destroy", PREFIX + "destroyWorld")
def test_destroy() -> None:
    first, second, third = (papi.createWorld(0.001) for _ in range(3))
    papi.destroyWorld(first)
    with pytest.raises(IndexError):
        papi.world__getTime(first)
    assert papi.world__getTime(second) == 0
    papi.destroy()
    for wid in (second, third):
        with pytest.raises(IndexError):
            papi.world__getTime(wid)


@row(PREFIX + "setVerbose", PREFIX + "getVerbose")
def test_verbose() -> None:
    papi.setVerbose(False)
    assert papi.getVerbose() is pydart2.verbose() is False
    papi.setVerbose()
    assert papi.getVerbose() is True


@row(PREFIX + "createWorldFromSkel", PREFIX + "world__getNumSkeletons")
def test_create_from_skel(wid: int) -> None:
    assert papi.world__getNumSkeletons(wid) == 4
    assert papi.world__getTimeStep(wid) == 0.001
    assert papi.skeleton__getName(wid, 3) == "skeleton_3"


@row(PREFIX + "world__addSkeleton")
def test_add_skeleton() -> None:
    wid = papi.createWorld(0.001)
    assert papi.world__addSkeleton(wid, "./data/sdf/atlas/atlas_v3_no_head.sdf") == 0
    assert papi.skeleton__getNumDofs(wid, 0) == 33


@row(PREFIX + "world__step", PREFIX + "world__getTime", PREFIX + "world__getSimFrames", PREFIX + "world__reset")
def test_step(wid: int, cubes: World) -> None:
    for _ in range(10):
        papi.world__step(wid)
    cubes.step(10)
    assert_allclose(papi.skeleton__getPositions(wid, 3, 6), cubes.skeletons[3].q, atol=1e-9)
    assert (papi.world__getTime(wid), papi.world__getSimFrames(wid)) == (pytest.approx(0.01), 10)
    papi.world__reset(wid)
    assert (papi.world__getTime(wid), papi.world__getSimFrames(wid)) == (0, 0)
    cubes.reset()
    assert_allclose(papi.skeleton__getPositions(wid, 3, 6), cubes.skeletons[3].q)


@row(PREFIX + "world__checkCollision", PREFIX + "collisionresult__getNumContacts")
def test_check_collision(wid: int) -> None:
    assert papi.collisionresult__getNumContacts(wid) == 0
    papi.world__checkCollision(wid)
    assert papi.collisionresult__getNumContacts(wid) > 0
    assert papi.world__getTime(wid) == 0


@row(PREFIX + "collisionresult__getContacts", PREFIX + "collisionresult__getCollidingBodyNodes")
def test_contacts(touching: World) -> None:
    n = papi.collisionresult__getNumContacts(touching.id)
    flat = papi.collisionresult__getContacts(touching.id, 10 * n)
    assert flat.shape == (10 * n,)
    assert_allclose(flat.reshape(n, 10), [contact.state for contact in touching.collision_result.contacts])
    expected = [i for body in touching.collision_result.contacted_bodies for i in (body.skid, body.id)]
    assert papi.collisionresult__getCollidingBodyNodes(touching.id) == tuple(expected)


NUMBERS = {"TimeStep": 0.25, "Time": 1.5, "Gravity": [1.0, 2.0, 3.0], "CollisionDetector": 2}


@rows(PREFIX + "world__", {f"set{name}": (name, value) for name, value in NUMBERS.items()})
def test_world_setter(wid: int, case: tuple[str, Any]) -> None:
    name, value = case
    function(f"world__set{name}")(wid, value)
    assert_allclose(function(f"world__get{name}")(wid), value)


@rows(PREFIX + "world__get", {"TimeStep": "time_step", "Gravity": "gravity", "CollisionDetector": "collision_detector"})
def test_world_getter(cubes: World, case: str) -> None:
    name = case.title().replace("_", "")
    assert_allclose(function(f"world__get{name}")(cubes.id), getattr(cubes, case)())


@row(PREFIX + "world__getIndex")
def test_index(wid: int) -> None:
    assert [papi.world__getIndex(wid, i) for i in range(5)] == [0, 0, 6, 12, 18]


@row(PREFIX + "addBallJointConstraint", PREFIX + "world__removeAllConstraints")
def test_constraints(cubes: World) -> None:

    def apart(hold: bool) -> float:
        cubes.reset()
        if hold:
            assert papi.addBallJointConstraint(cubes.id, 2, 0, 3, 0, cubes.skeletons[3].C) == 0
        cubes.skeletons[3].dq = [0, 0, 0, 0.5, 0, 0]
        cubes.step(20)
        return float(cubes.skeletons[3].C[0] - cubes.skeletons[2].C[0])

    free = apart(hold=False)
    assert apart(hold=True) < free - 0.002
    papi.world__removeAllConstraints(cubes.id)
    assert apart(hold=False) == pytest.approx(free)


# Skeletons

SAME = {
    "getName": "name",
    "getMass": "mass",
    "isMobile": "is_mobile",
    "getSelfCollisionCheck": "self_collision_check",
    "getAdjacentBodyCheck": "adjacent_body_check",
    "getNumBodyNodes": "num_bodynodes",
    "getNumJoints": "num_joints",
    "getNumDofs": "num_dofs",
    "getCOM": "com",
    "getCOMLinearVelocity": "com_velocity",
    "getCOMLinearAcceleration": "com_acceleration",
}
SIZED = {
    "getPositions": "positions",
    "getVelocities": "velocities",
    "getAccelerations": "accelerations",
    "getPositionLowerLimits": "position_lower_limits",
    "getPositionUpperLimits": "position_upper_limits",
    "getForceLowerLimits": "force_lower_limits",
    "getForceUpperLimits": "force_upper_limits",
    "getCoriolisAndGravityForces": "coriolis_and_gravity_forces",
    "getConstraintForces": "constraint_forces",
}


@rows(PREFIX + "skeleton__", {name: pair for pair in (SAME | SIZED).items() for name in pair[:1]})
def test_skeleton_getter(robot: Skeleton, case: tuple[str, str]) -> None:
    name, method = case
    robot.world.step(3)
    length = [robot.ndofs] if name in SIZED else []
    value, expected = function(f"skeleton__{name}")(robot.world.id, 1, *length), getattr(robot, method)
    expected = expected() if callable(expected) else expected
    assert type(value) is (np.ndarray if isinstance(expected, np.ndarray) else type(expected))
    if isinstance(expected, str):
        assert value == expected
    else:
        assert_allclose(value, expected)
        assert np.shape(value) == np.shape(expected)


@row(PREFIX + "skeleton__getNumMarkers")
def test_num_markers(zoo: Skeleton) -> None:
    assert papi.skeleton__getNumMarkers(zoo.world.id, 0) == 9


@row(PREFIX + "skeleton__getMassMatrix")
def test_mass_matrix(robot: Skeleton) -> None:
    out = np.zeros((37, 37))
    assert papi.skeleton__getMassMatrix(robot.world.id, 1, out) is None
    assert_allclose(out, robot.M)


@rows(PREFIX + "skeleton__get", {"PositionDifferences": "position", "VelocityDifferences": "velocity"})
def test_differences(zoo: Skeleton, case: str) -> None:
    other = np.linspace(0, 1, zoo.ndofs)
    differences = function(f"skeleton__get{case.title()}Differences")
    expected = getattr(zoo, f"{case}_differences")(zoo.q, other)
    assert_allclose(differences(zoo.world.id, 0, zoo.q, other, zoo.ndofs), expected)


@rows(PREFIX + "skeleton__set", {"Positions": "q", "Velocities": "dq"})
def test_skeleton_setter(zoo: Skeleton, case: str) -> None:
    name = {"q": "Positions", "dq": "Velocities"}[case]
    function(f"skeleton__set{name}")(zoo.world.id, 0, np.full(zoo.ndofs, 0.25).tolist())
    assert_allclose(getattr(zoo, case), 0.25)
    with pytest.raises(ValueError):
        function(f"skeleton__set{name}")(zoo.world.id, 0, [0.0])


@row(PREFIX + "skeleton__setForces")
def test_set_forces(cubes: World) -> None:
    papi.skeleton__setForces(cubes.id, 3, [0, 0, 0, 2.0, 0, 0])
    cubes.step()
    assert cubes.skeletons[3].dq[3] == pytest.approx(0.002 / cubes.skeletons[3].m)


@rows(
    PREFIX + "skeleton__set",
    {"Mobile": "is_mobile", "SelfCollisionCheck": "self_collision_check", "AdjacentBodyCheck": "adjacent_body_check"},
)
def test_skeleton_flag(cubes: World, case: str) -> None:
    name = case.removeprefix("is_").title().replace("_", "")
    for flag in (0, 1, False, True):
        function(f"skeleton__set{name}")(cubes.id, 2, flag)
        assert getattr(cubes.skeletons[2], case)() is bool(flag)


@row(PREFIX + "skeleton__setRootJointToTransAndEuler", PREFIX + "skeleton__setRootJointToWeld")
def test_root_joint(wid: int) -> None:
    papi.skeleton__setRootJointToTransAndEuler(wid, 2)
    assert [papi.joint__getName(wid, 2, i) for i in range(2)] == ["root_t", "root_r"]
    assert (papi.skeleton__getNumDofs(wid, 2), papi.skeleton__getNumBodyNodes(wid, 2)) == (6, 2)
    papi.skeleton__setRootJointToWeld(wid, 3)
    assert (papi.skeleton__getNumDofs(wid, 3), papi.joint__getType(wid, 3, 0)) == (0, "WeldJoint")


# Markers


@row(PREFIX + "marker__getBodyNode", PREFIX + "marker__getWorldPosition")
def test_marker(zoo: Skeleton) -> None:
    for i, body in enumerate(zoo.bodynodes):
        assert papi.marker__getBodyNode(zoo.world.id, 0, i) == i
        assert_allclose(papi.marker__getWorldPosition(zoo.world.id, 0, i), body.to_world([0, 0, i]))


@row(PREFIX + "marker__getLocalPosition", PREFIX + "marker__setLocalPosition")
def test_marker_position(zoo: Skeleton) -> None:
    assert_allclose(papi.marker__getLocalPosition(zoo.world.id, 0, 6), [0, 0, 6])
    papi.marker__setLocalPosition(zoo.world.id, 0, 6, [1, 2, 3])
    assert_allclose(papi.marker__getLocalPosition(zoo.world.id, 0, 6), [1, 2, 3])
