"""Joints."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.spatial.transform import Rotation

import pydart2
from pydart2 import Joint, Skeleton
from pydart2.joint import create_joint

from .table import row, rows

TURN = np.array([[0.0, -1, 0, 0.1], [1, 0, 0, 0.2], [0, 0, 1, 0.3], [0, 0, 0, 1]])
TYPES = ("Weld", "Revolute", "Prismatic", "Universal", "Planar", "Ball", "Euler", "Translational", "Free")

ACTUATORS = ("FORCE", "PASSIVE", "SERVO", "ACCELERATION", "VELOCITY", "LOCKED")


@pytest.fixture
def joint(zoo: Skeleton) -> Joint:
    """The ball joint."""
    return zoo.joint("ball joint")


@row("joint.Joint", "joint.Joint.build")
def test_constructor(zoo: Skeleton) -> None:
    joint = Joint(zoo, 5)
    joint.build()
    assert (joint.type(), joint.dofs, joint.child_bodynode) == ("BallJoint", zoo.dofs[7:10], zoo.bodynodes[5])
    assert zoo.dofs[7].joint is joint


@rows("joint.Joint.", {name: i for i, name in enumerate(ACTUATORS)})
def test_actuator(cubes: pydart2.World, case: int) -> None:
    name = ACTUATORS[case]
    assert getattr(Joint, name) == case
    cube = cubes.skeletons[3]
    cube.joints[0].set_actuator_type(case)
    cube.dofs[3].set_command(0.5)
    cubes.step()
    by_force = 0.0005 / cube.m
    expected = {"FORCE": by_force, "ACCELERATION": 0.0005, "SERVO": 0.5, "VELOCITY": 0.5}.get(name, 0.0)
    assert cube.dq[3] == pytest.approx(expected, abs=1e-6)


@rows(
    "joint.Joint.",
    {
        "skeleton": lambda joint: joint.skeleton is joint.child_bodynode.skeleton,
        "skel": lambda joint: joint.skel.joints[5] is joint,
        "id": lambda joint: joint.id == 5,
        "name": lambda joint: joint.name == "ball joint",
        "parent_bodynode": lambda joint: (
            joint.parent_bodynode is joint.skel.bodynodes[4] and joint.skel.joints[0].parent_bodynode is None
        ),
        "child_bodynode": lambda joint: joint.child_bodynode is joint.skel.bodynodes[5],
        "dofs": lambda joint: joint.dofs == joint.skel.dofs[7:10] and joint.skel.joints[0].dofs == [],
        "wid": lambda joint: joint.wid == joint.skel.world.id,
        "skid": lambda joint: joint.skid == joint.skel.id,
        "parent_body_node_id": lambda joint: (
            (joint.parent_body_node_id(), joint.skel.joints[0].parent_body_node_id()) == (4, -1)
        ),
        "child_body_node_id": lambda joint: joint.child_body_node_id() == 5,
        "type": lambda joint: [j.type() for j in joint.skel.joints] == [f"{name}Joint" for name in TYPES],
        "num_dofs": lambda joint: [j.num_dofs() for j in joint.skel.joints] == [0, 1, 1, 2, 3, 3, 3, 3, 6],
        "__repr__": lambda joint: repr(joint) == "[BallJoint(5): ball joint]",
    },
)
def test_attribute(joint: Joint, case: Callable[[Joint], bool]) -> None:
    assert case(joint)


@row("joint.Joint.set_name")
def test_set_name(joint: Joint) -> None:
    assert joint.set_name("hip", True) == joint.name == "hip"
    assert joint.skel.name_to_joint["hip"] is joint
    assert [dof.name for dof in joint.dofs] == ["hip_x", "hip_y", "hip_z"]
    joint.set_name("knee", False)
    assert [dof.name for dof in joint.dofs] == ["hip_x", "hip_y", "hip_z"]


@row("joint.Joint.is_kinematic", "joint.Joint.is_dynamic")
def test_kinematic(joint: Joint) -> None:
    for kind in range(6):
        joint.set_actuator_type(kind)
        assert joint.is_kinematic() is (kind in (Joint.ACCELERATION, Joint.VELOCITY, Joint.LOCKED))
        assert joint.is_dynamic() is not joint.is_kinematic()


@row("joint.Joint.actuator_type", "joint.Joint.set_actuator_type")
def test_actuator_type(joint: Joint) -> None:
    assert joint.actuator_type() == Joint.FORCE
    for kind in range(6):
        joint.set_actuator_type(kind)
        assert joint.actuator_type() == kind
    with pytest.raises(ValueError):
        joint.set_actuator_type(17)


@row("joint.Joint.position_in_world_frame")
def test_position_in_world(joint: Joint) -> None:
    centre = joint.child_bodynode.to_world(joint.transform_from_child_body_node()[:3, 3])
    assert_allclose(joint.position_in_world_frame(), centre)
    assert_allclose(joint.child_bodynode.to_local(centre), [0, 0, 0.25], atol=1e-12)


@rows(
    "joint.Joint.",
    {f"{prefix}transform_from_{end}_body_node": end for end in ("parent", "child") for prefix in ("", "set_")},
)
def test_transform(joint: Joint, case: str) -> None:
    name = f"transform_from_{case}_body_node"
    getattr(joint, f"set_{name}")(TURN.tolist())
    assert_allclose(getattr(joint, name)(), TURN)
    for dof in joint.dofs:
        dof.set_position(0.0)
    assert joint.parent_bodynode is not None
    parent, child = joint.transform_from_parent_body_node(), joint.transform_from_child_body_node()
    expected = joint.parent_bodynode.T @ parent @ np.linalg.inv(child)
    assert_allclose(joint.child_bodynode.T, expected, atol=1e-12)


@row("joint.Joint.set_position_limit_enforced", "joint.Joint.is_position_limit_enforced")
def test_limit_enforced(zoo: Skeleton) -> None:
    joint = zoo.joint("revolute joint")

    def reached() -> float:
        zoo.q, zoo.dq = np.zeros(zoo.ndofs), np.zeros(zoo.ndofs)
        joint.dofs[0].set_velocity(1.0)
        zoo.world.step(50)
        return joint.dofs[0].position()

    joint.set_position_upper_limit(0, 0.01)
    joint.set_position_limit_enforced(False)
    assert joint.is_position_limit_enforced() is False and reached() > 0.02
    joint.set_position_limit_enforced()
    assert joint.is_position_limit_enforced() is True and reached() < 0.012


@row("joint.Joint.has_position_limit")
def test_has_position_limit(joint: Joint) -> None:
    joint.set_position_lower_limit(1, -1.0)
    assert [joint.has_position_limit(i) for i in range(3)] == [False, True, False]
    with pytest.raises(IndexError):
        joint.skel.joints[0].has_position_limit(0)


NUMBERS = {
    "position_lower_limit": -2.0,
    "position_upper_limit": 2.0,
    "spring_stiffness": 2.0,
    "rest_position": 0.5,
    "damping_coefficient": 2.0,
    "coulomb_friction": 2.0,
}


@rows("joint.Joint.", {prefix + name: (name, value) for name, value in NUMBERS.items() for prefix in ("", "set_")})
def test_number_of_dof(joint: Joint, case: tuple[str, float]) -> None:
    name, value = case
    getattr(joint, f"set_{name}")(1, value)
    assert getattr(joint, name)(1) == getattr(joint.dofs[1], name)() == value
    assert getattr(joint, name)(0) != value
    with pytest.raises(IndexError):
        getattr(joint, name)(3)


@rows("joint.", {f"{name}Joint": name for name in TYPES})
def test_class(zoo: Skeleton, case: str) -> None:
    joint = zoo.joints[TYPES.index(case)]
    assert type(joint) is getattr(pydart2.joint, f"{case}Joint")
    assert type(type(joint)(zoo, joint.id).skel) is Skeleton


@row("joint.ScrewJoint")
def test_screw(screw: Skeleton) -> None:
    joint = screw.joints[0]
    assert type(joint) is pydart2.ScrewJoint
    screw.q = [np.pi]
    assert abs(screw.bodynodes[0].T[2, 3]) == pytest.approx(abs(joint.pitch()) / 2)


@rows("joint.", {f"{kind}Joint.{prefix}axis": kind for kind in ("Revolute", "Prismatic") for prefix in ("", "set_")})
def test_axis(zoo: Skeleton, case: str) -> None:
    joint: Any = zoo.joint(f"{case.lower()} joint")
    assert_allclose(joint.axis(), [0, 0, 1] if case == "Revolute" else [0, 1, 0])
    joint.set_axis([0, 3, 4])
    assert_allclose(joint.axis(), [0, 0.6, 0.8])
    joint.dofs[0].set_position(0.5)
    moved = joint.child_bodynode.relative_transform()[:3, :3]
    assert np.allclose(moved @ [0, 0.6, 0.8], [0, 0.6, 0.8])
    assert np.allclose(moved, np.eye(3)) is (case == "Prismatic")


@row("joint.RevoluteJoint.axis_in_world_frame")
def test_axis_in_world(zoo: Skeleton) -> None:
    joint: Any = zoo.joint("revolute joint")
    assert_allclose(joint.axis_in_world_frame(), joint.child_bodynode.angular_jacobian()[:, 0], atol=1e-12)


@rows("joint.UniversalJoint.", {f"{prefix}axis{i}": i for i in (1, 2) for prefix in ("", "set_")})
def test_universal_axis(zoo: Skeleton, case: int) -> None:
    joint: Any = zoo.joint("universal joint")
    assert_allclose(getattr(joint, f"axis{case}")(), [1, 0, 0] if case == 1 else [0, 1, 0])
    getattr(joint, f"set_axis{case}")([0, 0.6, 0.8])
    assert_allclose(getattr(joint, f"axis{case}")(), [0, 0.6, 0.8])
    for i, dof in enumerate(joint.dofs, 1):
        dof.set_position(0.5 if i == case else 0.0)
    turned = Rotation.from_matrix(joint.child_bodynode.relative_transform()[:3, :3])
    assert_allclose(turned.as_rotvec(), [0, 0.3, 0.4], atol=1e-12)


@rows("joint.UniversalJoint.", {f"axis{i}_in_world_frame": i for i in (1, 2)})
def test_universal_axis_in_world(zoo: Skeleton, case: int) -> None:
    joint: Any = zoo.joint("universal joint")
    expected = joint.child_bodynode.angular_jacobian()[:, joint.dofs[case - 1].id]
    assert_allclose(getattr(joint, f"axis{case}_in_world_frame")(), expected, atol=1e-12)


@row("joint.EulerJoint.axis_order", "joint.EulerJoint.set_axis_order")
def test_axis_order(zoo: Skeleton) -> None:
    joint: Any = zoo.joint("euler joint")

    def turned() -> np.ndarray:
        for dof, angle in zip(joint.dofs, (0.1, 0.2, 0.3), strict=True):
            dof.set_position(angle)
        return np.asarray(joint.child_bodynode.relative_transform()[:3, :3])

    assert joint.axis_order() == "XYZ"
    assert_allclose(turned(), Rotation.from_euler("XYZ", (0.1, 0.2, 0.3)).as_matrix(), atol=1e-12)
    joint.set_axis_order("ZYX")
    assert joint.axis_order() == "ZYX"
    assert_allclose(turned(), Rotation.from_euler("ZYX", (0.1, 0.2, 0.3)).as_matrix(), atol=1e-12)
    assert [dof.name for dof in joint.dofs] == [f"euler joint_{axis}" for axis in "zyx"]
    with pytest.raises(ValueError):
        joint.set_axis_order("XYX")


@row("joint.create_joint")
def test_create_joint(zoo: Skeleton) -> None:
    assert [type(create_joint(zoo, i)) for i in range(9)] == [type(joint) for joint in zoo.joints]
