"""Inverse kinematics: closed forms of a planar arm; targets that are known to be reachable."""

from __future__ import annotations

from typing import Any

import airo_models
import numpy as np
import pytest
from numpy.testing import assert_allclose

from pydart2 import Batch, Skeleton, Target, World

ATLAS = "./data/sdf/atlas/atlas_v3_no_head.sdf"


def planar_arm(links: int) -> Skeleton:
    """Links of 1 m in the plane of x and y, each joint turning by at most 2.5 rad."""
    parts = ['<link name="base"/>']
    for i in range(links + 1):
        parent = f"link{i - 1}" if i else "base"
        place = f'<origin xyz="{1.0 if i else 0.0} 0 0"/>'
        inertia = '<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/>'
        parts.append(f'<link name="link{i}"><inertial><mass value="1"/>{inertia}</inertial></link>')
        kind = "revolute" if i < links else "fixed"
        parts.append(
            f'<joint name="j{i}" type="{kind}"><parent link="{parent}"/><child link="link{i}"/>{place}'
            '<axis xyz="0 0 1"/><limit lower="-2.5" upper="2.5" effort="1" velocity="1"/></joint>'
        )
    skel = World(0.001).add_skeleton(f'<robot name="arm">{"".join(parts)}</robot>')
    skel.set_root_joint_to_weld()
    return skel


def ur5e() -> Skeleton:
    """Six joints without an offset between them that would make them redundant."""
    skel = World(0.001).add_skeleton(airo_models.get_urdf_path("ur5e"))
    skel.set_root_joint_to_weld()
    return skel


def angle(a: Any, b: Any) -> float:
    """Between two rotations, rad."""
    return float(np.linalg.norm(np.asarray(a) - np.asarray(b)) / np.sqrt(2.0))


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_two_links_have_the_closed_form(side: float) -> None:
    """The law of cosines, on the side where the search starts."""
    arm = planar_arm(2)
    x, y = 0.8, 0.9
    elbow = side * np.arccos((x * x + y * y - 2.0) / 2.0)
    shoulder = np.arctan2(y, x) - np.arctan2(np.sin(elbow), 1.0 + np.cos(elbow))
    result = arm.inverse_kinematics({"link2": [x, y, 0.0]}, start=[0.3, 0.5 * side], tolerance=1e-10)
    assert result.converged and result.restarts == 0
    assert_allclose(result.q, [shoulder, elbow], atol=1e-9)
    assert_allclose(arm.q, [0.0, 0.0], atol=0.0)


def test_out_of_reach_gives_the_best() -> None:
    """Stretched towards the target; what is left is what it is too far."""
    arm = planar_arm(2)
    result = arm.inverse_kinematics({"link2": [1.8, 2.4, 0.0]}, start=[0.1, 0.4], restarts=3)
    assert not result.converged and result.restarts == 3
    assert_allclose(result.residual, 1.0, atol=1e-4)
    assert_allclose(result.q, [np.arctan2(2.4, 1.8), 0.0], atol=2e-2)


def test_limits_hold() -> None:
    """A target that only a folded elbow reaches, beyond the limit: the elbow stays at it."""
    arm = planar_arm(2)
    result = arm.inverse_kinematics({"link2": [0.3, 0.0, 0.0]}, restarts=5)
    assert not result.converged
    assert np.all(result.q >= arm.q_lower) and np.all(result.q <= arm.q_upper)
    assert_allclose(np.abs(result.q[1]), 2.5, atol=1e-9)
    assert_allclose(result.residual, np.sqrt(2.0 + 2.0 * np.cos(2.5)) - 0.3, atol=1e-3)


def test_a_posture_takes_what_is_free() -> None:
    """Of all positions of three links that reach, the nearest to it: no neighbour along the self-motion is nearer."""
    arm = planar_arm(3)
    posture = np.array([1.0, -0.5, -0.8])
    result = arm.inverse_kinematics({"link3": [1.6, 0.4, 0.0]}, posture=posture, start=[0.2, 0.3, 0.3])
    assert result.converged
    arm.q = result.q
    J = arm.body("link3").J[:2]
    along = np.linalg.svd(J)[2][2]
    assert abs(along @ (posture - result.q)) < 1e-5
    plain = arm.inverse_kinematics({"link3": [1.6, 0.4, 0.0]}, start=[0.2, 0.3, 0.3])
    assert np.linalg.norm(result.q - posture) < np.linalg.norm(plain.q - posture)


def test_an_arm_reaches_what_it_can_reach() -> None:
    """Poses of the hand at 200 random q, from another random q each."""
    arm, rng = ur5e(), np.random.default_rng(3)
    hand = arm.body("wrist_3_link")
    misses = 0
    for _ in range(200):
        arm.q = rng.uniform(np.maximum(arm.q_lower, -np.pi), np.minimum(arm.q_upper, np.pi))
        goal = hand.T
        arm.q = rng.uniform(-1.0, 1.0, 6)
        result = arm.inverse_kinematics({hand: goal})
        arm.q = result.q
        near = np.linalg.norm(hand.T[:3, 3] - goal[:3, 3]) < 1e-6 and angle(hand.T[:3, :3], goal[:3, :3]) < 1.1e-6
        assert bool(near) == result.converged
        misses += not near
    assert misses <= 2


def test_the_same_seed_gives_the_same() -> None:
    """And another one something else, where random starts decide."""
    arm = ur5e()
    arm.q = [0.5, -1.0, 2.0, 0.3, 1.0, 2.0]
    goal = {"wrist_3_link": arm.body("wrist_3_link").T}
    start = [2.5, 1.5, -2.5, 3.0, -2.0, 0.1]
    results = [arm.inverse_kinematics(goal, start=start, seed=seed, iterations=8) for seed in (1, 1, 2)]
    assert results[0].restarts > 0
    assert_allclose(results[0].q, results[1].q, atol=0.0)
    assert not np.allclose(results[0].q, results[2].q)


def test_atlas_reaches_with_its_feet_held() -> None:
    """A hand, both feet and the centre of mass at once, with a free root."""
    robot = World(0.001).add_skeleton(ATLAS)
    robot.set_positions({"l_leg_kny": 0.6, "r_leg_kny": 0.6, "l_leg_hpy": -0.3, "r_leg_hpy": -0.3})
    feet = {name: robot.body(name).T for name in ("l_foot", "r_foot")}
    com = robot.C - [0.0, 0.0, 0.02]
    hand = robot.body("l_hand")
    goal = hand.to_world([0.0, 0.1, 0.0]) + np.array([0.1, -0.05, 0.1])
    target = Target(position=goal, offset=[0.0, 0.1, 0.0])
    result = robot.inverse_kinematics({**feet, "l_hand": target}, com=com)
    assert result.converged
    robot.q = result.q
    assert_allclose(hand.to_world([0.0, 0.1, 0.0]), goal, atol=1e-6)
    assert_allclose(robot.C, com, atol=1e-6)
    for name, pose in feet.items():
        assert_allclose(robot.body(name).T, pose, atol=2e-6)


def test_only_the_chosen_dofs_move() -> None:
    """Also where another one is beyond its limits."""
    human = World(0.001, "./data/skel/fullbody1.skel").skeletons[1]
    arm = ["j_bicep_left_x", "j_bicep_left_y", "j_bicep_left_z", "j_forearm_left"]
    human.set_positions({"j_shin_left": 3.0})
    goal = human.body("h_hand_left").T[:3, 3] + [0.02, 0.05, 0.05]
    result = human.inverse_kinematics({"h_hand_left": goal}, dofs=arm)
    assert result.converged
    others = np.setdiff1d(np.arange(human.ndofs), human.dof_indices(arm))
    assert_allclose(result.q[others], human.q[others], atol=0.0)


def test_a_free_body_goes_to_its_pose() -> None:
    """The root's own joint, by the exponential map: any pose within few steps."""
    cube = World(0.001, "./data/skel/cubes.skel").skeletons[2]
    pose = np.eye(4)
    pose[:3, :3] = [[0.0, -1.0, 0.0], [0.0, 0.0, -1.0], [1.0, 0.0, 0.0]]
    pose[:3, 3] = [1.0, 2.0, 3.0]
    result = cube.inverse_kinematics({cube.bodynodes[0]: pose}, restarts=0)
    assert result.converged
    cube.q = result.q
    assert_allclose(cube.bodynodes[0].T, pose, atol=2e-6)


def test_what_does_not_fit_is_refused() -> None:
    """With a sentence."""
    arm, other = planar_arm(2), planar_arm(2)
    bad: list[tuple[dict[Any, Any], dict[str, Any], str]] = [
        ({}, {}, "needs a target"),
        ({"link2": [1.0, 2.0]}, {}, r"got the shape \(2,\)"),
        ({"link2": Target()}, {}, "a position, a rotation or both"),
        ({other.body("link2"): [1.0, 0.0, 0.0]}, {}, "is not a body of"),
        ({"link2": Target(rotation=2.0 * np.eye(3))}, {}, "target rotation"),
        ({"link2": Target(position=[1.0, 0.0, 0.0], weight=-1.0)}, {}, "weight"),
        ({"link2": [np.nan, 0.0, 0.0]}, {}, "target position"),
        ({"link2": [1.0, 0.0, 0.0]}, {"posture": [0.0]}, "posture"),
        ({"link2": [1.0, 0.0, 0.0]}, {"tolerance": 0.0}, "tolerance"),
        ({"link2": [1.0, 0.0, 0.0]}, {"restarts": -1}, "restarts"),
    ]
    for targets, options, text in bad:
        with pytest.raises(ValueError, match=text):
            arm.inverse_kinematics(targets, **options)


@pytest.mark.parametrize("threads", [1, 3])
def test_in_batches(threads: int) -> None:
    """As in each world alone, bit for bit; what is one for all serves all."""
    arm, rng = ur5e(), np.random.default_rng(4)
    arm.q = rng.uniform(-1.0, 1.0, 6)
    batch = Batch(arm.world, 5, threads=threads)
    starts = rng.uniform(-1.0, 1.0, (5, 6))
    arm.q = starts[0]
    goals = np.array([arm.body("wrist_3_link").T] * 5)
    goals[:, :3, 3] += rng.uniform(-0.02, 0.02, (5, 3))
    before = batch.q
    found = batch.inverse_kinematics({"wrist_3_link": goals}, start=starts, seed=1)
    assert repr(found) == "[IKResults: 5 of 5 converged]" and found.residual.max() < 1e-6
    for goal, start, q in zip(goals, starts, found.q):
        assert_allclose(q, arm.inverse_kinematics({"wrist_3_link": goal}, start=start, seed=1).q, atol=0.0)
    assert_allclose(batch.q, before, atol=0.0)
    point = Target(position=goals[:, :3, 3], offset=(0.0, 0.1, 0.0))
    batch.q = batch.inverse_kinematics({"wrist_3_link": point}).q
    places = batch.T("wrist_3_link") @ [0.0, 0.1, 0.0, 1.0]
    assert_allclose(places[:, :3], goals[:, :3, 3], atol=1e-6)
    with pytest.raises(ValueError, match="all 5 worlds, or a row for each; got the shape"):
        batch.inverse_kinematics({"wrist_3_link": goals[:4]})
