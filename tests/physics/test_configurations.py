"""Where positions are no plain numbers: ball, free and Euler joints, and what replaces a free root."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

import pydart2

from .models import arm, body, creature, free_body, joint, make_world, skeleton

Vector = NDArray[np.float64]
few = settings(max_examples=25)


def vectors(size: int) -> st.SearchStrategy[Vector]:
    return st.lists(st.floats(-1.5, 1.5), min_size=size, max_size=size).map(np.array)


@pytest.fixture(scope="module")
def world(tmp_path_factory: pytest.TempPathFactory) -> pydart2.World:
    """A ball joint, a free joint and a double pendulum."""
    ball = skeleton(body(), joint("ball"), name="ball")
    return make_world(tmp_path_factory.mktemp("configurations"), ball, free_body(), arm())


def pose(rotation: Rotation, translation: Vector) -> Vector:
    T = np.eye(4)
    T[:3, :3], T[:3, 3] = rotation.as_matrix(), translation
    return T


@few
@given(q=vectors(6))
def test_positions_are_a_rotation_vector_then_a_translation(world: pydart2.World, q: Vector) -> None:
    ball, free, _ = world.skeletons
    turn = Rotation.from_rotvec(q[:3])
    ball.q, free.q = q[:3], q
    np.testing.assert_allclose(ball.bodynodes[0].T, pose(turn, np.zeros(3)), atol=1e-12)
    np.testing.assert_allclose(free.bodynodes[0].T, pose(turn, q[3:]), atol=1e-12)


@few
@given(q1=vectors(3), q2=vectors(3))
def test_position_differences_of_a_ball_joint(world: pydart2.World, q1: Vector, q2: Vector) -> None:
    """q1 - q2 is the rotation from 2 to 1 in the frame of 2: log(R2ᵀ R1)."""
    expected = (Rotation.from_rotvec(q2).inv() * Rotation.from_rotvec(q1)).as_rotvec()
    got = world.skeletons[0].position_differences(q1, q2)
    # Half a turn has two logarithms; compare the rotations.
    np.testing.assert_allclose(
        Rotation.from_rotvec(got).as_matrix(), Rotation.from_rotvec(expected).as_matrix(), atol=1e-9
    )
    if np.linalg.norm(expected) < 3.1:
        np.testing.assert_allclose(got, expected, atol=1e-7)


@few
@given(q1=vectors(6), q2=vectors(6))
def test_position_differences_of_a_free_joint(world: pydart2.World, q1: Vector, q2: Vector) -> None:
    """log(R2ᵀ R1), then the translation between them in the frame of 2."""
    R1, R2 = Rotation.from_rotvec(q1[:3]), Rotation.from_rotvec(q2[:3])
    got = world.skeletons[1].position_differences(q1, q2)
    np.testing.assert_allclose(Rotation.from_rotvec(got[:3]).as_matrix(), (R2.inv() * R1).as_matrix(), atol=1e-9)
    np.testing.assert_allclose(got[3:], R2.inv().apply(q1[3:] - q2[3:]), atol=1e-9)


@few
@given(q1=vectors(2), q2=vectors(2))
def test_differences_of_hinges_are_plain(world: pydart2.World, q1: Vector, q2: Vector) -> None:
    skel = world.skeletons[2]
    np.testing.assert_allclose(skel.position_differences(q1, q2), q1 - q2, atol=1e-12)
    np.testing.assert_allclose(skel.velocity_differences(q1, q2), q1 - q2, atol=1e-12)


def test_velocity_differences_are_plain(world: pydart2.World) -> None:
    _, free, _ = world.skeletons
    np.testing.assert_allclose(free.velocity_differences(np.arange(6), np.ones(6)), np.arange(6) - 1.0)


def test_difference_over_a_step_is_the_velocity(tmp_path: Path) -> None:
    """(q after - q before) / dt of a spinning body without forces."""
    world = make_world(tmp_path, free_body(inertia=(0.1, 0.1, 0.1)), gravity=(0, 0, 0))
    skel = world.skeletons[0]
    skel.q, skel.dq = [0.5, -0.2, 1.0, 1, 2, 3], [0.3, 0.9, -0.6, 0, 0, 0]
    before = skel.q
    world.step()
    np.testing.assert_allclose(skel.position_differences(skel.q, before) / world.dt, skel.dq, atol=1e-9)


def set_converted(skel: pydart2.Skeleton, q: pydart2.SkelVector, order: str) -> None:
    """A free root's positions as a translation and Euler angles about the turned axes; the others by name, as the
    engine puts moved bodies into depth-first order."""
    skel.q = np.concatenate([q[3:6], Rotation.from_rotvec(q[:3]).as_euler(order), np.zeros(skel.ndofs - 6)])
    skel.set_positions({name: q[name] for name in q.keys[6:]})


@pytest.mark.parametrize("order", ["XYZ", "ZYX"])
def test_trans_and_euler_root_has_the_same_poses(tmp_path: Path, order: str) -> None:
    skel = make_world(tmp_path, creature()).skeletons[0]
    random = np.random.default_rng(11)
    configurations = random.normal(0, 0.5, (5, skel.ndofs))
    before = []
    for skel.q in configurations:
        before.append((skel.q, {b.name: b.T for b in skel.bodynodes}))
    bodies, mass, ndofs = skel.nbodies, skel.m, skel.ndofs
    skel.set_root_joint_to_trans_and_euler()
    skel.joints[1].set_axis_order(order)
    assert (skel.nbodies, skel.ndofs) == (bodies + 1, ndofs)
    assert skel.m == pytest.approx(mass)
    assert [j.name for j in skel.joints[:2]] == ["root_t", "root_r"]
    letters = order.lower()
    assert [d.name for d in skel.dofs[:6]] == [f"root_t_{x}" for x in "xyz"] + [f"root_r_{x}" for x in letters]
    for q, expected in before:
        set_converted(skel, q, order)
        for name, T in expected.items():
            np.testing.assert_allclose(skel.body(name).T, T, atol=1e-9)


def test_trans_and_euler_root_has_the_same_dynamics(tmp_path: Path) -> None:
    """A massless body leaves M positive definite, and a force accelerates the other bodies as before."""
    skel = make_world(tmp_path, creature()).skeletons[0]
    skel.q = np.random.default_rng(12).normal(0, 0.4, skel.ndofs)
    q = skel.q

    def velocities_after_a_push() -> dict[str, Vector]:
        skel.body("hand").add_ext_force([30.0, -20.0, 10.0], [0.1, 0.2, 0.3])
        skel.body("foot").add_ext_torque([1.0, 2.0, 3.0])
        skel.world.step()
        return {body.name: body.dC for body in skel.bodynodes if body.m}

    expected = velocities_after_a_push()
    skel.set_root_joint_to_trans_and_euler()
    set_converted(skel, q, "XYZ")
    skel.dq = np.zeros(skel.ndofs)
    assert np.linalg.eigvalsh(skel.M).min() > 0
    got = velocities_after_a_push()
    assert got.keys() == expected.keys()
    for name, velocity in expected.items():
        # The pose moves in the step by dt times the velocity, not quite along the same path.
        np.testing.assert_allclose(got[name], velocity, atol=2e-3 * np.linalg.norm(velocity), err_msg=name)


def test_welded_root_stands_where_it_was(tmp_path: Path) -> None:
    skel = make_world(tmp_path, creature()).skeletons[0]
    ndofs = skel.ndofs
    skel.q = np.random.default_rng(13).normal(0, 0.4, ndofs)
    T = skel.root_bodynode().T
    skel.set_root_joint_to_weld()
    assert skel.ndofs == ndofs - 6
    assert skel.joints[0].type() == "WeldJoint"
    for _ in range(10):
        skel.world.step()
    np.testing.assert_allclose(skel.root_bodynode().T, T, atol=1e-12)


@pytest.mark.parametrize("order", ["XYZ", "ZYX"])
def test_euler_joint_turns_about_its_own_axes(tmp_path: Path, order: str) -> None:
    euler = skeleton(body(), joint("euler", extra=f"<axis_order>{order.lower()}</axis_order>"))
    skel = make_world(tmp_path, euler).skeletons[0]
    skel.q = [0.3, -0.8, 1.1]
    expected = Rotation.from_euler(order, [0.3, -0.8, 1.1]).as_matrix()
    np.testing.assert_allclose(skel.bodynodes[0].T[:3, :3], expected, atol=1e-12)
