"""Each actuator type does what it says. Commands last one step, as forces do."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import pydart2
from pydart2.joint import Joint

from .models import arm, make_world, slider

MASS = 2.0
PUSH = (3.0, 0.0, 0.0)  # acceleration along the rail, m/s²


def run(world: pydart2.World, command: list[float], steps: int) -> None:
    for _ in range(steps):
        world.skeletons[0]._handle.set_commands(command)
        world.step()


@pytest.fixture
def world(tmp_path: Path) -> pydart2.World:
    """A cart that something pushes along its rail."""
    return make_world(tmp_path, slider(MASS), gravity=PUSH)


@pytest.fixture
def cart(world: pydart2.World) -> pydart2.Skeleton:
    return world.skeletons[0]


def test_python_values_stay_the_original_ones() -> None:
    names = ("FORCE", "PASSIVE", "SERVO", "ACCELERATION", "VELOCITY", "LOCKED")
    assert [getattr(Joint, name) for name in names] == [0, 1, 2, 3, 4, 5]


@pytest.mark.parametrize("actuator", [0, 1, 2, 3, 4, 5])
def test_actuator_type_reads_back(cart: pydart2.Skeleton, actuator: int) -> None:
    joint = cart.joints[0]
    joint.set_actuator_type(actuator)
    assert joint.actuator_type() == actuator
    kinematic = actuator in (Joint.ACCELERATION, Joint.VELOCITY, Joint.LOCKED)
    assert joint.is_kinematic() == kinematic
    assert joint.is_dynamic() != kinematic


def test_force(world: pydart2.World, cart: pydart2.Skeleton) -> None:
    assert cart.joints[0].actuator_type() == Joint.FORCE
    run(world, [4.0], 500)
    assert cart.dq[0] == pytest.approx(0.5 * (4.0 / MASS + PUSH[0]))


def test_force_lasts_one_step(world: pydart2.World, cart: pydart2.Skeleton) -> None:
    cart.tau = [1000.0]
    world.step()
    speed = cart.dq[0]
    world.step()
    assert cart.dq[0] - speed == pytest.approx(world.dt * PUSH[0])


def test_passive_ignores_forces(world: pydart2.World, cart: pydart2.Skeleton) -> None:
    cart.joints[0].set_actuator_type(Joint.PASSIVE)
    cart.dofs[0].set_damping_coefficient(6.0)
    for _ in range(5000):
        cart.tau = [1000.0]
        world.step()
    assert cart.dq[0] == pytest.approx(MASS * PUSH[0] / 6.0, rel=1e-4)  # the damper's terminal velocity


def test_servo_holds_its_velocity_at_once_without_force_limits(world: pydart2.World, cart: pydart2.Skeleton) -> None:
    cart.joints[0].set_actuator_type(Joint.SERVO)
    run(world, [0.7], 1)
    assert cart.dq[0] == pytest.approx(0.7, abs=1e-9)
    run(world, [-0.2], 100)
    assert cart.dq[0] == pytest.approx(-0.2, abs=1e-9)


def test_servo_pushes_with_its_force_limit_at_most(world: pydart2.World, cart: pydart2.Skeleton) -> None:
    cart.joints[0].set_actuator_type(Joint.SERVO)
    cart.dofs[0].set_force_lower_limit(-10.0)
    cart.dofs[0].set_force_upper_limit(10.0)
    run(world, [50.0], 500)
    assert cart.dq[0] == pytest.approx(0.5 * (10.0 / MASS + PUSH[0]), rel=1e-6)
    start = cart.dq[0]
    run(world, [-50.0], 500)
    assert cart.dq[0] - start == pytest.approx(0.5 * (-10.0 / MASS + PUSH[0]), rel=1e-6)


def test_velocity(world: pydart2.World, cart: pydart2.Skeleton) -> None:
    cart.joints[0].set_actuator_type(Joint.VELOCITY)
    run(world, [0.4], 250)
    assert cart.dq[0] == pytest.approx(0.4, abs=1e-12)
    assert cart.q[0] == pytest.approx(0.1, abs=1e-12)


def test_acceleration(world: pydart2.World, cart: pydart2.Skeleton) -> None:
    cart.joints[0].set_actuator_type(Joint.ACCELERATION)
    run(world, [-1.5], 1000)
    assert cart.ddq[0] == pytest.approx(-1.5)
    assert cart.dq[0] == pytest.approx(-1.5)


def test_locked(world: pydart2.World, cart: pydart2.Skeleton) -> None:
    cart.q = [0.3]
    cart.joints[0].set_actuator_type(Joint.LOCKED)
    world.step(100)
    assert (cart.q[0], cart.dq[0]) == (0.3, 0.0)


def test_locked_joint_makes_one_body_of_two(tmp_path: Path) -> None:
    """With the elbow locked straight the arm swings as a rigid pendulum: masses 1 and 2 kg, COMs at 0.5 and 1.5 m,
    own moments 0.1."""
    world = make_world(tmp_path, arm())
    skel = world.skeletons[0]
    skel.joints[1].set_actuator_type(Joint.LOCKED)
    skel.q = [0.8, 0.0]
    world.step()
    moment = 0.1 + 1.0 * 0.25 + 0.1 + 2.0 * 1.5**2
    expected = -9.81 * (1.0 * 0.5 + 2.0 * 1.5) * np.sin(0.8) / moment
    np.testing.assert_allclose(skel.ddq, [expected, 0], atol=1e-9)


def test_velocity_joint_reacts_on_the_others(tmp_path: Path) -> None:
    """Row 0 of M ddq + c = tau holds for the free hinge while the motor prescribes the other's motion."""
    world = make_world(tmp_path, arm())
    skel = world.skeletons[0]
    skel.joints[1].set_actuator_type(Joint.VELOCITY)
    skel.q, skel.dq = [0.5, -0.3], [0.2, 0.0]
    M, c = skel.M, skel.c
    run(world, [0.0, 1.0], 1)
    ddq = skel.dq / world.dt - np.array([0.2, 0.0]) / world.dt
    assert ddq[1] == pytest.approx(1.0 / world.dt)
    assert M[0] @ ddq + c[0] == pytest.approx(0, abs=1e-6)


def test_mimic_follows(tmp_path: Path) -> None:
    world = make_world(tmp_path, arm(), gravity=(0, 0, 0))
    skel = world.skeletons[0]
    leader, follower = skel.joints
    follower.set_mimic(leader, multiplier=-2.0, offset=0.3)
    assert follower.actuator_type() == Joint.MIMIC
    leader.set_actuator_type(Joint.VELOCITY)
    run(world, [0.5, 0.0], 1000)
    assert skel.q[0] == pytest.approx(0.5)
    assert skel.q[1] == pytest.approx(-2.0 * 0.5 + 0.3, abs=2e-3)
    assert skel.dq[1] == pytest.approx(-1.0, abs=2e-3)


def test_mimic_is_a_motor_not_a_gear(tmp_path: Path) -> None:
    """The follower's motor moves it as it has to; the leader feels that through the links only, by its own row of
    M ddq = tau. A gear would load it with the motor's torque as well."""
    world = make_world(tmp_path, arm(), gravity=(0, 0, 0))
    skel = world.skeletons[0]
    skel.joints[1].set_mimic(skel.joints[0].name, multiplier=-1.0)
    assert skel.joints[1].mimic() == (skel.joints[0], -1.0, 0.0)
    row = skel.M[0]
    for _ in range(500):
        skel.tau = [1.0, 0.0]
        world.step()
    assert skel.dq[0] / world.t == pytest.approx(1.0 / (row @ [1.0, -1.0]), rel=0.01)
