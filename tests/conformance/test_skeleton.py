"""Skeletons."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.spatial.transform import Rotation

import pydart2
from oracle.dartpy_oracle import Simulation
from oracle.models import dart_model
from pydart2 import Skeleton, SkelVector, World

from .table import row, rows


@row("skeleton.Skeleton", "skeleton.Skeleton.filename")
def test_constructor(cubes: World) -> None:
    path = pydart2.data_path("sdf/atlas/atlas_v3_no_head.sdf")
    loaded = Skeleton(cubes, _filename=path)
    assert (loaded.ndofs, loaded.id, loaded.filename) == (33, 4, path)
    wrapped = Skeleton(cubes, _id=1, _friction=0.5)
    assert (wrapped.name, wrapped.filename) == ("box skeleton", None)


@row("skeleton.Skeleton.world", "skeleton.Skeleton.id")
def test_world_and_id(cubes: World) -> None:
    assert [(skel.world, skel.id) for skel in cubes.skeletons] == [(cubes, i) for i in range(4)]


@row("skeleton.Skeleton.friction")
def test_friction_is_for_the_user(cubes: World) -> None:
    skel = Skeleton(cubes, _id=1, _friction=0.5)
    assert skel.friction == 0.5
    skel.friction = 0.9
    assert skel.friction == 0.9


class Push:
    def compute(self) -> list[float]:
        return [0, 0, 0, 2.0, 0, 0]


@row("skeleton.Skeleton.controller", "skeleton.Skeleton.set_controller")
def test_controller(cubes: World) -> None:
    first, second = cubes.skeletons[2:]
    assert first.controller is None
    push = Push()
    second.set_controller(push)
    assert second.controller is push
    cubes.step()
    assert second.dq[3] == pytest.approx(0.001 * 2.0 / second.m)
    second.controller = None
    cubes.step()
    assert second.dq[3] == pytest.approx(0.001 * 2.0 / second.m)


@row("skeleton.Skeleton.build")
def test_build(zoo: Skeleton) -> None:
    before = zoo.dofs[0]
    zoo.build()
    assert zoo.dofs[0] is before  # what is still there stays valid
    assert zoo.dofs[0].joint is zoo.joints[1]
    assert zoo.name_to_dof["revolute joint"] is zoo.dofs[0]


@rows(
    "skeleton.Skeleton.",
    {
        "dofs": ("dofs", "root_rot_x", 33),
        "joints": ("joints", "root", 28),
        "bodynodes": ("bodynodes", "pelvis", 28),
    },
)
def test_list(atlas: Skeleton, case: tuple[str, str, int]) -> None:
    name, first, count = case
    parts = getattr(atlas, name)
    assert (parts[0].name, len(parts)) == (first, count)
    assert [part.id for part in parts] == list(range(count))


@row("skeleton.Skeleton.markers")
def test_markers(zoo: Skeleton) -> None:
    assert [marker.bodynode.id for marker in zoo.markers] == list(range(9))


@rows(
    "skeleton.Skeleton.",
    {
        "name_to_dof": ("name_to_dof", "dofs"),
        "name_to_joint": ("name_to_joint", "joints"),
        "name_to_body": ("name_to_body", "bodynodes"),
    },
)
def test_dictionary(atlas: Skeleton, case: tuple[str, str]) -> None:
    dictionary, parts = case
    assert getattr(atlas, dictionary) == {part.name: part for part in getattr(atlas, parts)}


@row("skeleton.Skeleton.set_root_joint_to_trans_and_euler")
def test_trans_and_euler(atlas: Skeleton) -> None:
    atlas.set_root_joint_to_trans_and_euler()
    names = [f"root_{joint}_{axis}" for joint in "tr" for axis in "xyz"]
    assert [dof.name for dof in atlas.dofs[:6]] == names
    assert (atlas.ndofs, atlas.nbodies, atlas.njoints) == (33, 29, 29)
    assert [type(joint).__name__ for joint in atlas.joints[:2]] == ["TranslationalJoint", "EulerJoint"]
    assert [joint.name for joint in atlas.joints[:2]] == ["root_t", "root_r"]
    q = atlas.q
    q[names] = 1, 2, 3, 0.1, 0, 0
    atlas.q = q
    pelvis = atlas.body("pelvis")
    assert_allclose(pelvis.T[:3, 3], [1, 2, 3])
    assert_allclose(pelvis.T[:3, :3] @ [0, 1, 0], [0, np.cos(0.1), np.sin(0.1)], atol=1e-12)
    assert_allclose(atlas.bodynodes[0].mass(), 0, atol=1e-9)
    joint: Any = atlas.joints[1]
    joint.set_axis_order("ZYX")
    assert joint.axis_order() == "ZYX"


@row("skeleton.Skeleton.set_root_joint_to_weld")
def test_weld(atlas: Skeleton) -> None:
    atlas.set_root_joint_to_weld()
    assert (atlas.ndofs, type(atlas.joints[0]).__name__) == (27, "WeldJoint")
    before = atlas.root_bodynode().T
    atlas.world.step(10)
    assert_allclose(atlas.root_bodynode().T, before)


@row("skeleton.Skeleton.name")
def test_name(atlas: Skeleton) -> None:
    assert atlas.name == "drc_skeleton"
    atlas.name = "other"  # more than the original takes
    assert atlas.name == "other"


COUNTS = {
    "num_dofs": 33,
    "ndofs": 33,
    "num_joints": 28,
    "njoints": 28,
    "num_bodynodes": 28,
    "nbodies": 28,
}


@rows("skeleton.Skeleton.", {name: (name, count) for name, count in COUNTS.items()})
def test_count(atlas: Skeleton, case: tuple[str, int]) -> None:
    name, count = case
    value = getattr(atlas, name)
    assert (value() if name.startswith("num_") else value) == count


@row("skeleton.Skeleton.is_mobile", "skeleton.Skeleton.set_mobile")
def test_mobile(cubes: World) -> None:
    cube = cubes.skeletons[3]
    assert cube.is_mobile() is True
    cube.set_mobile(False)
    before = cube.q
    cubes.step(5)
    assert cube.is_mobile() is False
    assert_allclose(cube.q, before)


@row("skeleton.Skeleton.mass", "skeleton.Skeleton.m")
def test_mass(zoo: Skeleton) -> None:
    assert zoo.mass() == zoo.m == pytest.approx(sum(range(1, 10)))


VECTORS = {"positions": "q", "velocities": "dq", "accelerations": "ddq"}


@rows(
    "skeleton.Skeleton.",
    {name: pair for pair in VECTORS.items() for name in pair},
)
def test_vector(robot: Skeleton, told: Simulation, case: tuple[str, str]) -> None:
    method, short = case
    if short == "ddq":
        robot.world.step()
    expected = told[int(short == "ddq")].skeletons[1][short]
    for vector in (getattr(robot, method)(), getattr(robot, short)):
        assert isinstance(vector, SkelVector)
        assert_allclose(vector, expected, rtol=1e-6, atol=1e-6)
        vector[:] = 7.0  # a copy
        assert not np.allclose(getattr(robot, short), 7.0)


@rows("skeleton.Skeleton.", {"set_positions": ("positions", "q"), "set_velocities": ("velocities", "dq")})
def test_vector_setter(zoo: Skeleton, case: tuple[str, str]) -> None:
    method, short = case
    before = zoo.bodynodes[-1].T, zoo.bodynodes[-1].com_linear_velocity()
    getattr(zoo, f"set_{method}")(list(np.full(zoo.ndofs, 0.25)))
    assert_allclose(getattr(zoo, short), 0.25)
    assert not np.allclose(before[short == "dq"], [zoo.bodynodes[-1].T, zoo.bodynodes[-1].dC][short == "dq"])
    with pytest.raises(ValueError):
        getattr(zoo, f"set_{method}")(np.zeros(zoo.ndofs + 1))


@rows("skeleton.Skeleton.", {f"{name}=": name for name in ("q", "dq", "x", "tau")})
def test_property_setter(zoo: Skeleton, case: str) -> None:
    values = np.full(2 * zoo.ndofs if case == "x" else zoo.ndofs, 0.25)
    setattr(zoo, case, tuple(values))
    assert_allclose(getattr(zoo, case), values)
    with pytest.raises(ValueError):
        setattr(zoo, case, values[1:])


@row("skeleton.Skeleton.states", "skeleton.Skeleton.x", "skeleton.Skeleton.set_states")
def test_states(zoo: Skeleton) -> None:
    n = zoo.ndofs
    assert_allclose(zoo.states(), np.concatenate([zoo.q, zoo.dq]))
    assert type(zoo.x) is np.ndarray and zoo.x.shape == (2 * n,)
    zoo.set_states(np.arange(2.0 * n) / n)
    assert_allclose(zoo.q, np.arange(n) / n)
    assert_allclose(zoo.dq, 1 + np.arange(n) / n)


@row("skeleton.Skeleton.position_differences")
def test_position_differences(zoo: Skeleton) -> None:
    q1, q2 = zoo.q, 0.1 * np.ones(zoo.ndofs)
    difference = zoo.position_differences(q1, q2)
    revolute, ball = zoo.joint("revolute joint"), zoo.joint("ball joint")
    assert difference[revolute.dofs[0].id] == pytest.approx(q1[revolute.dofs[0].id] - 0.1)
    ids = [dof.id for dof in ball.dofs]
    relative = Rotation.from_rotvec(q2[ids]).inv() * Rotation.from_rotvec(np.array(q1)[ids])
    assert_allclose(difference[ids], relative.as_rotvec(), atol=1e-9)


@row("skeleton.Skeleton.velocity_differences")
def test_velocity_differences(zoo: Skeleton) -> None:
    dq2 = np.arange(zoo.ndofs)
    assert_allclose(zoo.velocity_differences(zoo.dq, dq2), zoo.dq - dq2)


TOLD = {
    "mass_matrix": "M",
    "M": "M",
    "coriolis_and_gravity_forces": "c",
    "c": "c",
    "constraint_forces": "constraint_forces",
    "com": "C",
    "C": "C",
    "com_velocity": "dC",
    "dC": "dC",
}


@rows("skeleton.Skeleton.", {name: pair for name, *pair in ((a, a, b) for a, b in TOLD.items())})
def test_dynamics(robot: Skeleton, told: Simulation, case: tuple[str, str]) -> None:
    name, field = case
    robot.world.step()
    value = getattr(robot, name)
    value = value() if callable(value) else value
    assert_allclose(value, told[1].skeletons[1][field], rtol=1e-6, atol=1e-6)


@row("skeleton.Skeleton.com_acceleration", "skeleton.Skeleton.ddC")
def test_com_acceleration(robot: Skeleton) -> None:
    robot.world.skeletons[0].q = np.array([0, 0, 0, 0, -50.0, 0])  # the floor far below: free fall
    robot.world.step()
    expected = robot.world.g
    assert_allclose(robot.com_acceleration(), expected, rtol=1e-3, atol=0.05)
    assert_allclose(robot.ddC, robot.com_acceleration())


@row("skeleton.Skeleton.self_collision_check", "skeleton.Skeleton.set_self_collision_check")
def test_self_collision(robot: Skeleton) -> None:
    robot.q = _folded(robot)
    assert robot.self_collision_check() is False
    robot.world.check_collision()
    assert _own_contacts(robot) == 0
    robot.set_self_collision_check(1)
    assert robot.self_collision_check() is True
    robot.world.check_collision()
    assert _own_contacts(robot) > 0


@row("skeleton.Skeleton.adjacent_body_check", "skeleton.Skeleton.set_adjacent_body_check")
def test_adjacent_body_check(robot: Skeleton) -> None:
    robot.q = _folded(robot)
    robot.set_self_collision_check(True)
    robot.world.check_collision()
    without = _own_contacts(robot)
    assert robot.adjacent_body_check() is False
    robot.set_adjacent_body_check(True)
    assert robot.adjacent_body_check() is True
    robot.world.check_collision()
    assert _own_contacts(robot) > without


def _folded(robot: Skeleton) -> np.ndarray:
    return np.array([0, 0, 0, 0, 2.0, 0, *np.full(robot.ndofs - 6, 1.5)])


def _own_contacts(robot: Skeleton) -> int:
    contacts = robot.world.collision_result.contacts
    return sum(contact.skel_id1 == contact.skel_id2 == robot.id for contact in contacts)


@rows(
    "skeleton.Skeleton.",
    {"bodynode": ("bodynode", "bodynodes", "pelvis"), "body": ("body", "bodynodes", "pelvis")}
    | {"joint": ("joint", "joints", "back_bkz"), "dof": ("dof", "dofs", "back_bkz")},
)
def test_lookup(atlas: Skeleton, case: tuple[str, str, str]) -> None:
    method, parts, name = case
    find: Any = getattr(atlas, method)
    assert find(name) is next(part for part in getattr(atlas, parts) if part.name == name)
    assert find(2) is find(np.int64(2)) is getattr(atlas, parts)[2]
    assert find(-1) is getattr(atlas, parts)[-1]
    with pytest.raises(KeyError, match=name):
        find(name + "x")
    with pytest.raises(IndexError):
        find(99)
    with pytest.raises(TypeError):
        find(None)


@row("skeleton.Skeleton.root_bodynodes", "skeleton.Skeleton.root_bodynode")
def test_roots(atlas: Skeleton) -> None:
    assert atlas.root_bodynodes() == [atlas.body("pelvis")]
    assert atlas.root_bodynode() is atlas.root_bodynode(index=0) is atlas.body("pelvis")


@row("skeleton.Skeleton.bodynode_index", "skeleton.Skeleton.dof_index")
def test_index(atlas: Skeleton) -> None:
    assert (atlas.bodynode_index("ltorso"), atlas.dof_index("back_bkz")) == (1, 6)
    for find in (atlas.bodynode_index, atlas.dof_index):
        with pytest.raises(KeyError):
            find("nothing")


@row("skeleton.Skeleton.dof_indices")
def test_dof_indices(atlas: Skeleton) -> None:
    indices = atlas.dof_indices(["back_bkz", "root_rot_x"])
    assert indices.dtype.kind == "i"
    assert_allclose(np.arange(33)[indices], [6, 0])


@row("skeleton.Skeleton.linear_momentum", "skeleton.Skeleton.P")
def test_linear_momentum(zoo: Skeleton) -> None:
    expected = sum(body.m * body.dC for body in zoo.bodynodes)
    assert_allclose(zoo.linear_momentum(), expected, atol=1e-12)
    assert_allclose(zoo.P, expected, atol=1e-12)


@row("skeleton.Skeleton.forces", "skeleton.Skeleton.tau", "skeleton.Skeleton.set_forces")
def test_forces(cubes: World) -> None:
    cube = cubes.skeletons[3]
    assert_allclose(cube.forces(), np.zeros(6))
    force = np.array([0, 0, 0, 2.0, 0, 0])
    cube.set_forces(force)
    assert (cube.forces() == force).all() and (cube.tau == force).all()
    tau = cube.tau
    tau[3] = 9.0  # a copy
    assert (cube.tau == force).all()
    cubes.step(3)  # acts in the first step only
    assert cube.dq[3] == pytest.approx(0.001 * 2.0 / cube.m)
    assert (cube.forces() == force).all()
    with pytest.raises(ValueError):
        cube.set_forces(np.zeros(5))


LIMITS = {
    "position_lower_limits": "q_lower",
    "position_upper_limits": "q_upper",
    "force_lower_limits": "tau_lower",
    "force_upper_limits": "tau_upper",
}


@rows("skeleton.Skeleton.", {name: (name, short) for pair in LIMITS.items() for short in pair[1:] for name in pair})
def test_limits(robot: Skeleton, told: Simulation, case: tuple[str, str]) -> None:
    name, short = case
    value = getattr(robot, name)
    value = value() if name != short else value
    assert value.shape == (37,)
    assert_allclose(value, told.skeletons[1][short])


@row("skeleton.Skeleton.__repr__")
def test_repr() -> None:
    world = World(0.001, dart_model("skel/fullbody1.skel"))
    assert repr(world.skeletons[1]) == "[Skeleton(1): fullbody1]"
