"""What turns with a joint only, as a motor's rotor: in M, in the motion, and in what contacts and constraints do."""

from __future__ import annotations

import numpy as np
import pytest

import pydart2 as pydart

SOLVERS = pytest.mark.parametrize("solver", ["fast", "dart", "iterative"])
DYNAMICS = pytest.mark.parametrize("dynamics", ["fast", "engine"])


def quiet_world(solver: str, dynamics: str, dt: float) -> pydart.World:
    world = pydart.World(dt, up="z")
    world.g = [0.0, 0.0, 0.0]
    world.set_constraint_solver(solver)
    world.set_dynamics(dynamics)
    return world


def arm(world: pydart.World, armature: list[float]) -> pydart.Skeleton:
    """Links of 0.4 m along x, on joints about axes of all directions, one of them with two dofs."""
    skel = world.add_empty_skeleton("arm")
    parent = None
    for i, (joint, axis) in enumerate([("revolute", (0, 0, 1)), ("universal", None), ("prismatic", (0, 0.6, 0.8))]):
        where = (0.4 if i else 0.0, 0.0, 0.0)
        parent = skel.add_body(f"link{i}", parent, joint, axis=axis, position=where)
        parent.add_box((0.4, 0.06, 0.1), position=(0.2, 0.0, 0.0), mass=1.0 + 0.5 * i, collides=False)
    for dof, inertia in zip(skel.dofs, armature, strict=True):
        dof.set_armature(inertia)
    return skel


@DYNAMICS
@SOLVERS
def test_a_ball_hits_a_turnstile(solver: str, dynamics: str) -> None:
    """They go on together: m v = (m + (I + A) / r²) v', as without restitution."""
    world = quiet_world(solver, dynamics, 1e-4)
    stile = world.add_empty_skeleton("stile")
    body = stile.add_body("bar", joint="revolute", axis=(0, 0, 1), armature=0.8)
    body.add_box((1.0, 0.1, 0.1), position=(0.5, 0.0, 0.0), mass=0.6, friction=0.0)
    inertia = stile.M[0, 0]
    assert inertia == pytest.approx(0.6 * (1.0 + 0.01) / 12 + 0.6 * 0.25 + 0.8)
    ball = world.add_sphere(0.1, mass=2.0, position=(0.75, -0.15 + 1e-9, 0.0))
    ball.dq = [0.0, 0.0, 0.0, 0.0, 1.0, 0.0]
    world.step()
    assert len(world.collision_result.contacts) == 1
    expected = 2.0 / (2.0 + inertia / 0.75**2)
    assert ball.dq[4] == pytest.approx(expected, rel=2e-5)  # the engine softens contacts by 1e-5
    assert stile.dq[0] == pytest.approx(expected / 0.75, rel=2e-5)


@DYNAMICS
@SOLVERS
@pytest.mark.parametrize("armature", [[0.0] * 4, [0.3, 0.1, 0.2, 1.5], [0.0, 0.0, 0.7, 0.0]])
def test_a_constraint_changes_velocities_by_the_inverse_of_all_inertia(
    solver: str, dynamics: str, armature: list[float]
) -> None:
    """dq' = dq - (M + A)^-1 J' (J (M + A)^-1 J')^-1 J dq, of a point that is held."""
    dt = 1e-7
    world = quiet_world(solver, dynamics, dt)
    skel = arm(world, armature)
    skel.q, skel.dq = [0.3, -0.4, 0.5, 0.1], [0.7, -0.2, 0.4, 0.3]
    tip, dq = skel.body("link2"), skel.dq.copy()
    offset = np.array([0.4, 0.02, 0.0])
    pydart.constraints.BallJointConstraint(tip, None, tip.to_world(offset)).add_to_world(world)
    J = np.array(tip.linear_jacobian(offset))
    inverse = np.linalg.inv(skel.M)
    world.step()
    expected = dq - inverse @ J.T @ np.linalg.solve(J @ inverse @ J.T, J @ dq)
    assert J @ dq != pytest.approx(np.zeros(3), abs=0.1)
    assert skel.dq == pytest.approx(expected, abs=2e-5)


@DYNAMICS
@SOLVERS
def test_a_joint_stops_the_arm_at_its_limit(solver: str, dynamics: str) -> None:
    """The others go on as the row of their inertia says: dq' = dq - (M + A)^-1 e dq_i / ((M + A)^-1)_ii."""
    world = quiet_world(solver, dynamics, 1e-7)
    skel = arm(world, [0.3, 0.1, 0.2, 1.5])
    skel.q, skel.dq = [0.3, -0.4, 0.5, 0.1], [0.7, -0.2, 0.4, 0.3]
    skel.dofs[0].set_position_upper_limit(0.3)
    skel.joints[0].set_position_limit_enforced()
    dq, inverse = skel.dq.copy(), np.linalg.inv(skel.M)
    world.step()
    assert skel.dq == pytest.approx(dq - inverse[:, 0] * dq[0] / inverse[0, 0], abs=2e-5)


@DYNAMICS
@pytest.mark.parametrize("damped", [False, True])
def test_forces_accelerate_by_all_inertia(dynamics: str, damped: bool) -> None:
    """(M + A + dt D) ddq = tau - c - D dq, whatever was read or assigned before."""
    world = quiet_world("fast", dynamics, 1e-3)
    skel = arm(world, [0.3, 0.1, 0.0, 1.5])
    D = 0.4 * np.eye(4) if damped else np.zeros((4, 4))
    for dof in skel.dofs:
        dof.set_damping_coefficient(D[0, 0])
    random = np.random.default_rng(3)
    for i in range(5):
        q, dq, tau = random.normal(size=(3, 4))
        skel.q, skel.dq, skel.tau = q, dq, tau
        skel.dofs[3].set_armature(1.5 + i)
        if i % 2:
            assert skel.invM @ skel.M == pytest.approx(np.eye(4), abs=1e-9)
        expected = np.linalg.solve(skel.M + world.dt * D, tau - skel.c - D @ dq)
        world.step()
        assert skel.ddq == pytest.approx(expected, rel=1e-9, abs=1e-9)


@SOLVERS
def test_a_contact_that_is_asked_for_without_a_step_has_it_too(solver: str) -> None:
    """The impulse at the lever's arm r takes all its momentum: F dt r = (I + A) w."""
    world = quiet_world(solver, "fast", 1e-3)
    lever = world.add_empty_skeleton("lever")
    body = lever.add_body("bar", joint="revolute", axis=(0, 1, 0), armature=0.5)
    body.add_box((1.0, 0.1, 0.1), position=(0.5, 0.0, 0.0), mass=1.0, friction=0.0)
    world.add_sphere(0.1, position=(0.9, 0.0, -0.15 + 1e-6), fixed=True)
    lever.dq = [0.5]
    world.check_collision()
    (contact,) = world.collision_result.contacts
    assert abs(contact.force[2]) * world.dt * 0.9 == pytest.approx(lever.M[0, 0] * 0.5, rel=1e-3)
