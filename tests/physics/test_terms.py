"""The terms of the equation of motion, one by one, against closed forms."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray

import pydart2
from pydart2 import BodyNode, SimpleFrame, Skeleton, World

Array = NDArray[np.float64]

URDF = """<robot name="pendulum">
<link name="base"/>
<link name="bob"><inertial><origin xyz="0 -0.5 0"/><mass value="2"/>
  <inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial></link>
<joint name="hinge" type="revolute"><parent link="base"/><child link="bob"/><axis xyz="0 0 1"/>
  <limit lower="-3" upper="3" effort="100" velocity="100"/></joint>
</robot>"""
G = 9.81


@pytest.fixture
def pendulum() -> Skeleton:
    """2 kg, 0.5 m from a hinge about z at the origin, gravity along -y; q = 0 hangs."""
    skel = World(0.001).add_skeleton(URDF)
    skel.set_root_joint_to_weld()
    return skel


@pytest.fixture
def human() -> Skeleton:
    """A human in motion, with forces on it, springs and dampers."""
    skel = World(0.001, "./data/skel/fullbody1.skel").skeletons[1]
    rng = np.random.default_rng(1)
    skel.q, skel.dq = rng.uniform(-0.4, 0.4, (2, skel.ndofs))
    skel.dofs[7].set_spring_stiffness(30.0)
    skel.dofs[7].set_rest_position(0.7)
    skel.dofs[8].set_damping_coefficient(2.5)
    skel.body("h_hand_left").add_ext_force([3.0, -20.0, 8.0], [0.01, 0.02, 0.03])
    return skel


def test_terms_of_a_pendulum(pendulum: Skeleton) -> None:
    """I = 0.1 + m l^2, gravity m g l sin q."""
    pendulum.q, pendulum.dq = [0.3], [2.0]
    dof = pendulum.dofs[0]
    dof.set_spring_stiffness(4.0)
    dof.set_rest_position(0.1)
    dof.set_damping_coefficient(0.5)
    inertia, gravity = 0.1 + 2.0 * 0.25, 2.0 * G * 0.5 * np.sin(0.3)
    assert_allclose(pendulum.Minv, [[1.0 / inertia]], rtol=1e-12)
    assert_allclose(pendulum.aug_mass_matrix(), [[inertia + 0.001 * 0.5 + 1e-6 * 4.0]], rtol=1e-12)
    assert_allclose(pendulum.gravity_forces(), [gravity], rtol=1e-12)
    assert_allclose(pendulum.coriolis_forces(), [0.0], atol=1e-14)
    assert_allclose(pendulum.damping_forces(), [-1.0], rtol=1e-12)
    assert_allclose(pendulum.spring_forces(), [-4.0 * 0.2], rtol=1e-12)
    assert_allclose(pendulum.inverse_dynamics([1.5]), [inertia * 1.5 + gravity + 1.0 + 0.8], rtol=1e-12)
    assert_allclose(pendulum.inverse_dynamics([1.5], damping=False, springs=False), [inertia * 1.5 + gravity])
    assert_allclose(pendulum.forward_dynamics([3.0]), [(3.0 - gravity - 1.8) / inertia], rtol=1e-12)
    bob = pendulum.body("bob")
    for given in (bob, "bob", bob.id):
        response = pendulum.impulse_response(given, [1.0, 0.0, 0.0], [0, -0.5, 0])
        assert_allclose(response, [0.5 * np.cos(0.3) / inertia])


def test_the_work_of_gravity_and_springs(pendulum: Skeleton, human: Skeleton) -> None:
    """Potential energy is taken at centres of mass; its slope is what gravity and springs do to the dofs."""
    pendulum.q = [0.7]
    assert pendulum.potential_energy() == pytest.approx(-2.0 * G * 0.5 * np.cos(0.7), rel=1e-12)
    for skel in (pendulum, human):
        n, h = skel.ndofs, 1e-6
        still = skel.q
        slope = np.zeros(n)
        for i in range(n):
            for sign in (1.0, -1.0):
                skel.q = skel.integrate_positions(still, sign * h * np.eye(n)[i])
                slope[i] += sign * skel.potential_energy() / (2 * h)
        skel.q = still
        assert_allclose(slope, skel.gravity_forces() - skel.spring_forces(), atol=1e-5)


def test_forces_add_up(human: Skeleton) -> None:
    """c is Coriolis and gravity; a force on a body is J^T f; external ones can be left out."""
    assert_allclose(human.coriolis_forces() + human.gravity_forces(), human.c, atol=1e-9)
    J = human.body("h_hand_left").linear_jacobian([0.01, 0.02, 0.03])
    assert_allclose(human.external_forces(), J.T @ [3.0, -20.0, 8.0], atol=1e-10)
    ddq = np.linspace(-1.0, 1.0, human.ndofs)
    without = human.inverse_dynamics(ddq, external=False)
    assert_allclose(without - human.inverse_dynamics(ddq), human.external_forces(), atol=1e-9)


def test_inverse_and_forward_dynamics_are_opposites(human: Skeleton) -> None:
    """Each gives back what the other was given; the state stays."""
    ddq = np.linspace(-5.0, 5.0, human.ndofs)
    before = human.x
    assert_allclose(human.forward_dynamics(human.inverse_dynamics(ddq)), ddq, atol=1e-9)
    assert_allclose(human.x, before, rtol=0.0, atol=0.0)


def test_a_step_does_what_forward_dynamics_says(pendulum: Skeleton) -> None:
    """Without springs and dampers the step's accelerations are those of forward_dynamics()."""
    pendulum.q, pendulum.dq = [0.7], [1.0]
    expected = pendulum.forward_dynamics([2.0])
    pendulum.tau = [2.0]
    pendulum.world.step()
    assert_allclose(pendulum.ddq, expected, rtol=1e-12)


def turn_back(skel: Skeleton) -> None:
    """The root's rotation to zero, where dq is the rate of q."""
    skel.q = [0.0, 0.0, 0.0, *skel.q[3:]]


def rate_of(skel: Skeleton, read: Callable[[], Array]) -> Array:
    """The rate of something along the motion, by central differences."""
    q, dq, h, sides = skel.q, skel.dq, 1e-6, []
    for sign in (1.0, -1.0):
        skel.q = q + sign * h * dq
        sides.append(read())
    skel.q = q
    return np.asarray((sides[0] - sides[1]) / (2.0 * h))


def test_jacobians_of_the_centre_of_mass(human: Skeleton) -> None:
    """Times dq they are its velocity; the derivative is that of the Jacobian along the motion."""
    assert_allclose(human.com_linear_jacobian() @ human.dq, human.dC, atol=1e-12)
    assert_allclose(human.com_jacobian() @ human.dq, human.com_spatial_velocity(), atol=1e-12)
    turn_back(human)
    rate = human.com_linear_jacobian_deriv()
    assert_allclose(rate_of(human, human.com_linear_jacobian), rate, atol=1e-7)


def test_centroidal_momentum_is_the_sum_over_the_bodies(human: Skeleton) -> None:
    """Of m v, and of I w + (x - C) x m v."""
    angular, linear = np.zeros(3), np.zeros(3)
    for body in human.bodynodes:
        R, p = body.T[:3, :3], body.m * body.dC
        linear += p
        angular += R @ body.I @ R.T @ body.world_angular_velocity() + np.cross(body.C - human.C, p)
    assert_allclose(human.centroidal_momentum(), [*angular, *linear], atol=1e-10)
    assert_allclose(human.centroidal_momentum()[3:], human.P, atol=1e-10)


def test_free_flight_keeps_the_centroidal_angular_momentum() -> None:
    """Gravity alone does not change it, but for what the integration of 1 ms steps loses."""
    world = World(1e-4, "./data/skel/fullbody1.skel")
    human = world.skeletons[1]
    human.q = human.q + np.eye(1, human.ndofs, 4)[0] * 5.0  # far above the ground
    human.dq = np.random.default_rng(2).uniform(-1.0, 1.0, human.ndofs)
    before = human.centroidal_momentum()
    world.step(50)
    assert_allclose(human.centroidal_momentum()[:3], before[:3], atol=2e-3 * np.abs(before[:3]).max())


def test_the_wrench_of_a_hinge_at_rest(pendulum: Skeleton) -> None:
    """It holds the weight; a hinge that is stopped holds the moment as well."""
    pendulum.q = [np.pi / 2.0]  # the bob along +x
    pendulum.tau = [2.0 * G * 0.5]
    pendulum.world.step()
    hinge = pendulum.joint("hinge")
    assert_allclose(hinge.wrench(), [0.0, 0.0, G, 2.0 * G, 0.0, 0.0], atol=1e-9)  # y of the world is x of the bob
    hinge.dofs[0].set_position_lower_limit(np.pi / 2.0)
    hinge.set_position_limit_enforced(True)
    pendulum.world.step(3)
    assert_allclose(hinge.wrench(), [0.0, 0.0, G, 2.0 * G, 0.0, 0.0], atol=1e-3)


def test_the_wrench_of_a_swinging_hinge(pendulum: Skeleton) -> None:
    """m (a - g) of the centre of mass, in the bob's axes."""
    pendulum.q, pendulum.dq = [0.4], [3.0]
    bob = pendulum.body("bob")
    angle, rate = 0.4, 3.0
    ddq = pendulum.forward_dynamics([0.0])[0]
    axes = bob.T[:3, :3]
    along, down = axes @ [1.0, 0.0, 0.0], axes @ [0.0, -1.0, 0.0]
    acceleration = 0.5 * (ddq * along - rate**2 * down)
    force = axes.T @ (2.0 * (acceleration + np.array([0.0, G, 0.0])))
    pendulum.world.step()
    assert_allclose(pendulum.joint("hinge").wrench(), [0.0, 0.0, 0.0, *force], atol=1e-9)
    assert pendulum.q[0] != angle


@pytest.mark.parametrize("of, to", [("h_hand_left", "h_head"), ("h_head", "h_toe_right"), ("h_hand_left", None)])
def test_relative_velocity_is_the_rate_of_the_relative_pose(human: Skeleton, of: str, to: str | None) -> None:
    """By central differences, in the axes of what it is relative to."""
    turn_back(human)
    frame = SimpleFrame(human.body(of), [[0, -1, 0], [1, 0, 0], [0, 0, 1]], [0.1, 0.0, 0.2])
    seen_from = None if to is None else SimpleFrame(human.body(to), translation=[0.0, 0.3, 0.0])
    velocity = frame.relative_velocity(seen_from, axes=seen_from)
    J = frame.relative_jacobian(seen_from, axes=seen_from)
    pose = frame.relative_pose(seen_from)
    rate = rate_of(human, lambda: frame.relative_pose(seen_from))
    spin = rate[:3, :3] @ pose[:3, :3].T
    assert_allclose(velocity[3:], rate[:3, 3], atol=1e-7)
    assert_allclose(velocity[:3], [spin[2, 1], spin[0, 2], spin[1, 0]], atol=1e-7)
    assert_allclose(J @ human.dq, velocity, atol=1e-11)


def test_a_frame_in_the_world_and_two_skeletons(human: Skeleton, pendulum: Skeleton) -> None:
    """A fixed frame has a pose and no motion; frames of two skeletons have no common Jacobian."""
    fixed = SimpleFrame(None, translation=[1.0, 2.0, 3.0])
    hand = human.body("h_hand_left")
    assert_allclose(hand.relative_pose(fixed)[:3, 3], hand.T[:3, 3] - [1.0, 2.0, 3.0], atol=1e-12)
    assert_allclose(fixed.relative_velocity(hand)[:3], -hand.world_angular_velocity(), atol=1e-12)
    with pytest.raises(ValueError, match="two skeletons"):
        hand.relative_jacobian(pendulum.body("bob"))
    with pytest.raises(ValueError, match="no dq"):
        fixed.relative_jacobian(None)
    with pytest.raises(ValueError, match="must be a rotation"):
        SimpleFrame(hand, rotation=2.0 * np.eye(3))


@pytest.mark.parametrize(
    "call, text",
    [
        (lambda s, b: s.inverse_dynamics([0.0, 0.0]), r"accelerations have the shape \(1,\)"),
        (lambda s, b: s.forward_dynamics(0.0), r"forces have the shape \(1,\)"),
        (lambda s, b: s.impulse_response(b, [1.0, 0.0, 0.0]), "is not a body of"),
        (lambda s, b: s.impulse_response(s.bodynodes[1], [1.0]), r"shape \(3,\)"),
    ],
)
def test_what_does_not_fit_is_refused(
    pendulum: Skeleton, human: Skeleton, call: Callable[[Skeleton, BodyNode], object], text: str
) -> None:
    """With a sentence."""
    with pytest.raises(ValueError, match=text):
        call(pendulum, human.bodynodes[0])


def test_soft_bodies_have_no_centroidal_matrix() -> None:
    """Their points carry momentum of their own."""
    world = World(0.001, "./data/skel/softBodies.skel")
    soft = next(s for s in world.skeletons if any(isinstance(b, pydart2.SoftBodyNode) for b in s.bodynodes))
    with pytest.raises(ValueError, match="soft bodies"):
        soft.centroidal_momentum_matrix()
