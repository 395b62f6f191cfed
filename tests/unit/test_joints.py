"""Joints and dofs: axes, frames, names, limits, indices."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import pydart2
from physics.models import arm, body, creature, joint, make_world, skeleton

TILT = (0.1, 0.2, 0.3, 0.4, -0.5, 0.6)


def one(folder: Path, kind: str, **options: object) -> pydart2.Joint:
    """A joint between two bodies, the first of which turns freely."""
    parts = (body("a"), joint("ball", "a", name="first"), body("b", at=TILT))
    link = joint(kind, "b", "a", name="second", at=(0.0, 0.1, 0.2, 0.3, -0.2, 0.1), **options)  # type: ignore[arg-type]
    return make_world(folder, skeleton(*parts, link)).skeletons[0].joints[1]


@pytest.fixture
def skel(tmp_path: Path) -> pydart2.Skeleton:
    return make_world(tmp_path, creature()).skeletons[0]


def test_structure(skel: pydart2.Skeleton) -> None:
    kinds = ["FreeJoint", "RevoluteJoint", "BallJoint", "PrismaticJoint", "UniversalJoint", "EulerJoint"]
    assert [j.type() for j in skel.joints] == [type(j).__name__ for j in skel.joints] == kinds
    assert [j.num_dofs() for j in skel.joints] == [6, 1, 3, 1, 2, 3]
    assert skel.joints[0].parent_bodynode is None and skel.joints[0].parent_body_node_id() == -1
    thigh = skel.joint("thigh_joint")
    assert thigh.parent_bodynode is skel.body("pelvis") and thigh.child_bodynode is skel.body("thigh")
    assert thigh.child_body_node_id() == 1 and thigh.dofs == [skel.dof("thigh_joint")]
    assert [d.joint for d in skel.dofs] == [j for j in skel.joints for _ in j.dofs]
    assert skel.body("thigh").parent_joint is thigh
    assert skel.body("pelvis").child_joints == [skel.joint(f"{n}_joint") for n in ("thigh", "head", "tail")]
    assert repr(thigh) == "[RevoluteJoint(1): thigh_joint]"


def test_lookups(skel: pydart2.Skeleton) -> None:
    assert skel.joint(1) is skel.joint(np.int64(1)) is skel.joint("thigh_joint") is skel.joints[1]
    assert skel.dof(-1) is skel.dofs[-1] is skel.dof("tail_joint_z")
    assert skel.body(2) is skel.bodynode("head")
    assert skel.dof_index("thigh_joint") == 6 and skel.bodynode_index("foot") == 3
    assert skel.dof_indices(["hand_joint_1", "thigh_joint"]).tolist() == [11, 6]
    assert skel.q[skel.dof_indices([])].shape == (0,)


def test_dofs(skel: pydart2.Skeleton) -> None:
    for i, dof in enumerate(skel.dofs):
        assert dof.id == dof.index == dof.index_in_skeleton() == dof.index_in_tree() == i
        assert dof.joint.dofs[dof.index_in_joint()] is dof and dof.tree_index() == 0
        dof.set_position(0.01 * i)
        dof.set_velocity(-0.01 * i)
    np.testing.assert_allclose(skel.q, 0.01 * np.arange(16))
    np.testing.assert_allclose(skel.dq, -0.01 * np.arange(16))
    assert repr(skel.dof(6)) == "[Dof(6): thigh_joint]"


@pytest.mark.parametrize(
    "name",
    [
        "position_lower_limit",
        "position_upper_limit",
        "velocity_lower_limit",
        "velocity_upper_limit",
        "force_lower_limit",
        "force_upper_limit",
        "spring_stiffness",
        "rest_position",
        "damping_coefficient",
        "coulomb_friction",
        "initial_position",
        "initial_velocity",
        "constraint_impulse",
    ],
)
def test_dof_properties_read_back(skel: pydart2.Skeleton, name: str) -> None:
    for i, dof in enumerate(skel.dofs):
        getattr(dof, f"set_{name}")(1.5 + i)
    assert [getattr(dof, name)() for dof in skel.dofs] == [1.5 + i for i in range(16)]


def test_limits(skel: pydart2.Skeleton) -> None:
    assert np.all(skel.q_lower[6:7] == -np.inf) and np.all(np.isinf(skel.tau_upper))
    joint = skel.joint("hand_joint")
    assert not joint.has_position_limit(1) and not joint.is_position_limit_enforced()
    joint.set_position_lower_limit(1, -0.5)
    joint.set_position_upper_limit(1, 0.25)
    assert joint.has_position_limit(1) and not joint.has_position_limit(0)
    assert (joint.position_lower_limit(1), joint.position_upper_limit(1)) == (-0.5, 0.25)
    assert (skel.q_lower[12], skel.q_upper[12]) == (-0.5, 0.25)
    joint.set_position_limit_enforced()
    assert joint.is_position_limit_enforced()
    joint.set_position_limit_enforced(np.False_)
    assert not joint.is_position_limit_enforced()
    joint.set_position_lower_limit(1, -np.inf)
    joint.set_position_upper_limit(1, np.inf)
    assert not joint.has_position_limit(1)


def test_axis(tmp_path: Path) -> None:
    for kind in ("revolute", "prismatic"):
        joint = one(tmp_path, kind, axis=(0, 3, 4))
        np.testing.assert_allclose(joint.axis(), [0, 0.6, 0.8])
        joint.set_axis([2, 0, 0])
        np.testing.assert_allclose(joint.axis(), [1, 0, 0])


def test_revolute_axis_in_the_world(tmp_path: Path) -> None:
    """The axis is what stays put when the joint turns, and the angular Jacobian's column."""
    joint = one(tmp_path, "revolute", axis=(0.6, 0.0, 0.8))
    skel = joint.skel
    skel.q = [0.4, -0.3, 0.9, 0.7]
    axis = joint.axis_in_world_frame()
    np.testing.assert_allclose(joint.child_bodynode.angular_jacobian()[:, 3], axis, atol=1e-12)
    np.testing.assert_allclose(np.linalg.norm(axis), 1)


def test_revolute_axis_at_the_root(tmp_path: Path) -> None:
    joint = make_world(tmp_path, arm()).skeletons[0].joints[0]
    np.testing.assert_allclose(joint.axis_in_world_frame(), [0, 0, 1])


@pytest.mark.parametrize("root", [False, True])
def test_universal_axes_in_the_world(tmp_path: Path, root: bool) -> None:
    """The original took the parent's frame only, and crashed at the root."""
    if root:
        text = skeleton(body("b"), joint("universal", "b", name="second", axis=(1, 0, 0), axis2=(0, 0.6, 0.8)))
        universal = make_world(tmp_path, text).skeletons[0].joints[0]
    else:
        universal = one(tmp_path, "universal", axis=(1, 0, 0), axis2=(0, 0.6, 0.8))
    skel = universal.skel
    skel.q = np.linspace(0.5, 1.2, skel.ndofs)
    columns = universal.child_bodynode.angular_jacobian()[:, -2:]
    np.testing.assert_allclose(universal.axis1_in_world_frame(), columns[:, 0], atol=1e-12)
    np.testing.assert_allclose(universal.axis2_in_world_frame(), columns[:, 1], atol=1e-12)
    np.testing.assert_allclose(universal.axis2(), [0, 0.6, 0.8])


def test_universal_axes_are_made_unit_vectors(tmp_path: Path) -> None:
    """Otherwise the engine's pose is no rigid transform, on which it aborts; so the axes are looked at first."""
    universal = one(tmp_path, "universal", axis=(1, 0, 0), axis2=(0, 1, 0))
    universal.set_axis1([0, 0, 5])
    universal.set_axis2([0, 3, 4])
    np.testing.assert_allclose(universal.axis1(), [0, 0, 1])
    np.testing.assert_allclose(universal.axis2(), [0, 0.6, 0.8])
    universal.skel.q = [0, 0, 0, 0.5, 0.3]
    R = universal.child_bodynode.T[:3, :3]
    np.testing.assert_allclose(R @ R.T, np.eye(3), atol=1e-12)


def test_screw(tmp_path: Path) -> None:
    """The SKEL format has none; the SDF format has."""
    path = tmp_path / "screw.sdf"
    path.write_text(
        '<sdf version="1.4"><model name="m"><link name="nut"/><joint name="thread" type="screw"><parent>world</parent>'
        "<child>nut</child><axis><xyz>0 0 1</xyz></axis><thread_pitch>0.1</thread_pitch></joint></model></sdf>"
    )
    skel = pydart2.World(0.001).add_skeleton(path)
    thread = skel.joint("thread")
    assert isinstance(thread, pydart2.ScrewJoint) and thread.type() == "ScrewJoint"
    skel.q = [2 * np.pi]
    turns = skel.bodynodes[0].T
    np.testing.assert_allclose(turns[:3, :3], np.eye(3), atol=1e-12)
    assert abs(turns[2, 3]) > 0.01


def test_frames(tmp_path: Path) -> None:
    """Child pose = parent pose · T_parent · motion · T_child⁻¹; the joint's centre is where both sides meet."""
    joint = one(tmp_path, "revolute", axis=(0, 0, 1))
    joint.skel.q = [0.4, -0.3, 0.9, 0.7]
    parent, child = joint.parent_bodynode, joint.child_bodynode
    turn = np.eye(4)
    turn[:3, :3] = Rotation.from_rotvec([0, 0, 0.7]).as_matrix()
    T_parent, T_child = joint.transform_from_parent_body_node(), joint.transform_from_child_body_node()
    assert parent is not None
    np.testing.assert_allclose(child.T, parent.T @ T_parent @ turn @ np.linalg.inv(T_child), atol=1e-12)
    centre = (parent.T @ T_parent)[:3, 3]
    np.testing.assert_allclose(joint.position_in_world_frame(), centre, atol=1e-12)
    np.testing.assert_allclose((child.T @ T_child)[:3, 3], centre, atol=1e-12)


def test_set_frames(tmp_path: Path) -> None:
    joint = one(tmp_path, "revolute", axis=(0, 0, 1))
    T = np.eye(4)
    T[:3, :3], T[:3, 3] = Rotation.from_euler("xyz", TILT[3:]).as_matrix(), TILT[:3]
    joint.set_transform_from_parent_body_node(T)
    joint.set_transform_from_child_body_node(np.linalg.inv(T))
    np.testing.assert_allclose(joint.transform_from_parent_body_node(), T)
    joint.skel.q = [0, 0, 0, 0]
    np.testing.assert_allclose(joint.child_bodynode.T, T @ T, atol=1e-12)


def test_rename(skel: pydart2.Skeleton) -> None:
    """The original left its own names as they were."""
    joint = skel.joint("thigh_joint")
    assert joint.set_name("hip", True) == "hip"
    assert skel.joint("hip") is joint and joint.name == "hip" and "thigh_joint" not in skel.name_to_joint
    assert skel.dof("hip").id == 6 and skel.q.keys[6] == "hip"
    assert joint.set_name("knee", False) == "knee"
    assert skel.dof("hip").id == 6
    assert skel.joint("head_joint").set_name("knee", True) != "knee"
    assert len(skel.name_to_joint) == 6 and len(skel.name_to_dof) == 16


def test_axis_order_renames_dofs(skel: pydart2.Skeleton) -> None:
    tail = skel.joint("tail_joint")
    assert tail.axis_order() == "XYZ"
    tail.set_axis_order("ZYX")
    assert tail.axis_order() == "ZYX"
    assert [d.name for d in tail.dofs] == ["tail_joint_z", "tail_joint_y", "tail_joint_x"]
    assert skel.q.keys[-3:] == ["tail_joint_z", "tail_joint_y", "tail_joint_x"]
    assert skel.dof("tail_joint_z").id == 13


def test_every_kind_in_skel_has_its_class(tmp_path: Path) -> None:
    kinds = {
        "weld": pydart2.WeldJoint,
        "planar": pydart2.PlanarJoint,
        "translational": pydart2.TranslationalJoint,
        "ball": pydart2.BallJoint,
    }
    for kind, expected in kinds.items():
        extra = '<plane type="xy"/>' if kind == "planar" else ""
        assert type(one(tmp_path, kind, extra=extra)) is expected


def test_position_by_name(skel: pydart2.Skeleton) -> None:
    skel.set_positions({"thigh_joint": 0.5}, foot_joint=0.25)
    expected = np.zeros(16)
    expected[[6, 10]] = 0.5, 0.25
    assert skel.q.tolist() == expected.tolist()
    skel.set_velocities(thigh_joint=1.0)
    assert skel.dq.tolist() == np.eye(16)[6].tolist()
    skel.set_forces({"thigh_joint": 2.0})
    assert skel.tau.tolist() == (2 * np.eye(16)[6]).tolist()
    with pytest.raises(TypeError, match="not both"):
        skel.set_positions(skel.q, thigh_joint=1.0)
