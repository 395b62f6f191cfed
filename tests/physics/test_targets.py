"""Motors with targets: closed forms of stable PD, effort limits, contact, copies."""

from __future__ import annotations

import pickle

import airo_models
import numpy as np
import pytest
from numpy.testing import assert_allclose

import pydart2
from pydart2 import Batch, Skeleton, Snapshot, World

URDF = """<robot name="pendulum"><link name="base"/>
<link name="bob"><inertial><origin xyz="0 -0.5 0"/><mass value="2"/>
  <inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial></link>
<joint name="hinge" type="revolute"><parent link="base"/><child link="bob"/><axis xyz="0 0 1"/>
  <limit lower="-3" upper="3" effort="20" velocity="100"/></joint></robot>"""
INERTIA, WEIGHT = 0.1 + 2.0 * 0.25, 2.0 * 9.81 * 0.5


@pytest.fixture
def pendulum() -> Skeleton:
    """2 kg, 0.5 m from a hinge about z, gravity along -y, at most 20 N m; q = 0 hangs."""
    skel = World(0.005).add_skeleton(URDF)
    skel.set_root_joint_to_weld()
    return skel


def ur5e(dt: float) -> Skeleton:
    """An arm with a base that is welded, gravity along -z."""
    world = World(dt)
    world.set_gravity([0.0, 0.0, -9.81])
    arm = world.add_skeleton(airo_models.get_urdf_path("ur5e"))
    arm.set_root_joint_to_weld()
    return arm


def test_one_step_is_the_closed_form(pendulum: Skeleton) -> None:
    """(I + h (d + kd) + h^2 (k + kp)) ddq = what acts at ddq = 0, the model's own spring and damper included."""
    h, kp, kd, k, d = 0.005, 300.0, 20.0, 5.0, 0.7
    pendulum.dofs[0].set_spring_stiffness(k)
    pendulum.dofs[0].set_damping_coefficient(d)
    pendulum.q, pendulum.dq, pendulum.tau = [0.3], [1.0], [0.5]
    pendulum.set_targets({"hinge": 0.32}, {"hinge": 0.9}, kp=kp, kd=kd, compensate="gravity")
    gravity = WEIGHT * np.sin(0.3)
    motor = kp * (0.32 - 0.3 - h * 1.0) + kd * (0.9 - 1.0) + gravity
    rest = 0.5 - gravity - d * 1.0 - k * (0.3 + h * 1.0)
    ddq = (motor + rest) / (INERTIA + h * (d + kd) + h * h * (k + kp))
    pendulum.world.step()
    assert_allclose(pendulum.ddq, [ddq], rtol=1e-12)
    assert_allclose(pendulum.motor_forces(), [motor - (h * kd + h * h * kp) * ddq], rtol=1e-10)


def test_with_a_position_alone_it_comes_to_rest_there(pendulum: Skeleton) -> None:
    """Also where it had a velocity to follow."""
    pendulum.world.set_gravity([0.0, 0.0, 0.0])
    pendulum.set_targets(dq={"hinge": 1.0}, kd=8.0)
    pendulum.world.step(400)
    assert_allclose(pendulum.dq, [1.0], rtol=1e-3)
    pendulum.set_targets({"hinge": 0.5}, kp=60.0)
    pendulum.world.step(2000)
    assert_allclose([pendulum.q[0], pendulum.dq[0]], [0.5, 0.0], atol=1e-6)


def test_it_settles_where_the_spring_balances_gravity(pendulum: Skeleton) -> None:
    """kp (q* - q) = m g l sin q; with compensation at the target itself."""
    pendulum.set_targets({"hinge": 0.5}, kp=60.0, kd=8.0)
    pendulum.world.step(2000)
    q = pendulum.q[0]
    assert_allclose(60.0 * (0.5 - q), WEIGHT * np.sin(q), rtol=1e-6)
    pendulum.set_targets({"hinge": 0.5}, compensate="gravity")
    pendulum.world.step(2000)
    assert_allclose(pendulum.q, [0.5], atol=1e-9)


def test_the_effort_limit_holds_for_the_sum(pendulum: Skeleton) -> None:
    """Gains that ask for a thousand times the limit get the limit, compensation included, and no more."""
    pendulum.set_targets({"hinge": 2.9}, kp=1e4, kd=100.0, compensate="gravity")
    pendulum.world.step()
    assert_allclose(pendulum.motor_forces(), [20.0], rtol=0.0)
    assert_allclose(pendulum.ddq, [20.0 / INERTIA], rtol=1e-12)
    pendulum.world.step(2000)
    assert_allclose(pendulum.q, [2.9], atol=1e-6)


def test_a_motor_at_its_limit_leaves_the_others_exact() -> None:
    """The accelerations of the step are those that forward dynamics gives for the forces of the motors."""
    arm = ur5e(0.005)
    arm.q = [0.1, -1.0, 1.2, 0.3, 0.4, 0.5]
    for dof in arm.dofs[:2]:
        dof.set_force_upper_limit(3.0)
        dof.set_force_lower_limit(-3.0)
    arm.set_targets(np.asarray(arm.q) + 0.2, kp=2000.0, kd=50.0)
    expected_by = arm.M, arm.c, arm.damping_forces(), arm.spring_forces(), arm.aug_mass_matrix()
    arm.world.step()
    _M, c, damping, springs, augmented = expected_by
    assert np.sum(np.abs(arm.motor_forces()) >= 3.0 - 1e-12) >= 2
    assert np.all(np.abs(arm.motor_forces()[:2]) <= 3.0)
    assert_allclose(augmented @ arm.ddq, arm.motor_forces() - c + damping + springs, atol=1e-8)


@pytest.mark.parametrize("dt", [0.001, 0.005])
def test_high_gains_hold_an_arm(dt: float) -> None:
    """10,000 N m/rad: a UR5e comes to its target and stays."""
    arm = ur5e(dt)
    for dof in arm.dofs:
        dof.set_force_upper_limit(np.inf)
        dof.set_force_lower_limit(-np.inf)
    goal = np.array([0.4, -1.2, 1.0, 0.2, 0.7, -0.3])
    arm.set_targets(goal, kp=1e4, kd=200.0, compensate="gravity")
    arm.world.step(round(2.0 / dt))
    assert_allclose(arm.q, goal, atol=1e-6)
    assert_allclose(arm.dq, np.zeros(6), atol=1e-5)


def test_in_contact_it_presses_with_its_gain(pendulum: Skeleton) -> None:
    """At a stop the motor's force is kp times what is missing, and the stop holds it."""
    dof = pendulum.dofs[0]
    dof.set_position_upper_limit(0.2)
    pendulum.joint("hinge").set_position_limit_enforced(True)
    pendulum.set_targets({"hinge": 0.3}, kp=150.0, kd=10.0, compensate="gravity")
    pendulum.world.step(1000)
    force = pendulum.motor_forces()[0] - WEIGHT * np.sin(pendulum.q[0])
    assert_allclose(force, 150.0 * (0.3 - pendulum.q[0]), rtol=2e-3)
    assert_allclose(pendulum.q, [0.2], atol=2e-3)
    assert_allclose(pendulum.dq, [0.0], atol=2e-3)


def test_a_ball_joint_turns_the_short_way() -> None:
    """Targets of a ball joint are rotation vectors; the difference is that of the log map."""
    world = World(0.002)
    skel = world.add_empty_skeleton("s")
    skel.add_body("b", joint="ball").add_box((0.3, 0.2, 0.1), mass=1.0)
    goal = np.array([2.0, -1.0, 0.5])
    skel.set_targets(goal, kp=50.0, kd=10.0)
    world.step(3000)
    assert_allclose(skel.q, goal, atol=1e-5)


def test_a_part_of_a_vector_is_by_name() -> None:
    robot = pydart2.World(0.001).add_skeleton("./data/sdf/atlas/atlas_v3_no_head.sdf")
    robot.set_targets(robot.q[6:] + 0.1, kp=100.0)
    assert robot.targets is not None
    np.testing.assert_array_equal(robot.targets.kp, [0.0] * 6 + [100.0] * 27)
    np.testing.assert_array_equal(robot.targets.q, [0.0] * 6 + [0.1] * 27)


def test_targets_add_to_a_controller(pendulum: Skeleton) -> None:
    """The forces of both act."""

    class Push:
        def compute(self) -> list[float]:
            return [3.0]

    pendulum.set_controller(Push())
    pendulum.set_targets({"hinge": 0.0}, kp=60.0, kd=8.0, compensate="gravity")
    pendulum.world.step(2000)
    assert_allclose(pendulum.q, [3.0 / 60.0], atol=1e-6)


def test_targets_stay_until_they_are_cleared(pendulum: Skeleton) -> None:
    """Gains stay when a target moves; after clear_targets() nothing holds."""
    assert pendulum.targets is None
    pendulum.set_targets({"hinge": 0.5}, kp=60.0, kd=8.0, compensate="gravity")
    pendulum.set_targets({"hinge": 0.2})
    targets = pendulum.targets
    assert targets is not None
    assert (targets.q[0], targets.dq[0], targets.kp[0], targets.kd[0]) == (0.2, 0.0, 60.0, 8.0)
    assert targets.compensate == "gravity"
    pendulum.world.step(2000)
    assert_allclose(pendulum.q, [0.2], atol=1e-6)
    pendulum.clear_targets()
    pendulum.world.step(1)
    assert_allclose(pendulum.ddq, [-WEIGHT * np.sin(0.2) / INERTIA], rtol=1e-5)
    assert_allclose(pendulum.motor_forces(), [0.0], atol=0.0)


def test_copies_have_the_targets(pendulum: Skeleton) -> None:
    """Clones, pickles and batches move as the original does; a snapshot brings back the targets of its time."""
    world = pendulum.world
    pendulum.set_targets({"hinge": 0.5}, kp=60.0, kd=8.0, compensate="bias")
    world.step(10)
    saved, clone, pickled, batch = world.snapshot(), world.clone(), pickle.loads(pickle.dumps(world)), Batch(world, 2)
    pendulum.set_targets({"hinge": -0.5}, kp=10.0)
    for copy in (clone, pickled):
        copy.step(100)
    batch.step(100)
    world.restore(saved)
    assert pendulum.targets is not None and pendulum.targets.q[0] == 0.5
    world.step(100)
    assert_allclose(clone.skeletons[0].q, pendulum.q, atol=0.0)
    assert_allclose(pickled.skeletons[0].q, pendulum.q, atol=0.0)
    assert_allclose(batch.q, [pendulum.q] * 2, atol=0.0)
    pendulum.clear_targets()
    world.restore(saved)
    assert pendulum.targets is not None


def test_a_snapshot_from_before_there_were_motors(pendulum: Skeleton) -> None:
    """It is shorter, and has none."""
    world = pendulum.world
    saved = world.snapshot()
    old = Snapshot(saved.values[: -(4 * pendulum.ndofs + 1)], saved.contacts, saved.model)
    pendulum.set_targets({"hinge": 0.5}, kp=60.0)
    world.restore(old)
    assert pendulum.targets is None


def test_what_does_not_fit_is_refused(pendulum: Skeleton) -> None:
    """With a sentence, and without a change."""
    for call, error, text in [
        (lambda: pendulum.set_targets(), TypeError, "needs positions"),
        (lambda: pendulum.set_targets({"hinge": 1.0}), ValueError, "no gains"),
        (lambda: pendulum.set_targets({"hing": 1.0}, kp=1.0), pydart2.NameNotFound, "did you mean 'hinge'"),
        (lambda: pendulum.set_targets([1.0, 2.0], kp=1.0), ValueError, r"got \(2,\)"),
        (lambda: pendulum.set_targets({"hinge": 1.0}, kp=-1.0), ValueError, "kp"),
        (lambda: pendulum.set_targets({"hinge": np.nan}, kp=1.0), ValueError, "target"),
        (lambda: pendulum.set_targets({"hinge": 1.0}, kp=1.0, compensate="all"), ValueError, "one of"),  # type: ignore[arg-type]
    ]:
        with pytest.raises(error, match=text):
            call()
    assert pendulum.targets is None
    pendulum.joint("hinge").set_actuator_type(pydart2.Joint.VELOCITY)
    with pytest.raises(ValueError, match="takes no forces"):
        pendulum.set_targets({"hinge": 1.0}, kp=1.0)
