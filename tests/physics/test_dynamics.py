"""Jacobians, mass matrix, bias forces and equations of motion of a tree with every common joint type."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

import pydart2

from .models import DOWN, creature, free_body, make_world

Vector = NDArray[np.float64]
NDOFS = 16
FREE, BALL = slice(0, 6), slice(7, 10)  # places of the joints whose positions are not numbers that add up
STEP = 1e-5

# The engine's ball and free joints turn by less than 1e-3 rad by a truncated series: at 1e-3 poses jump by 1.6e-10 rad,
# and below it their rates are wrong by up to 5e-7, which differences of poses show.
coordinates = st.floats(-1.2, 1.2).map(lambda x: x if abs(x) > 2e-3 else 0.0)
vectors = st.lists(coordinates, min_size=NDOFS, max_size=NDOFS).map(np.array)
bodies = st.sampled_from(["pelvis", "thigh", "head", "foot", "hand", "tail"])
points = st.lists(st.floats(-1, 1), min_size=3, max_size=3).map(np.array)
few = settings(max_examples=15)


@pytest.fixture(scope="module")
def skel(tmp_path_factory: pytest.TempPathFactory) -> pydart2.Skeleton:
    world = make_world(tmp_path_factory.mktemp("creature"), creature())
    return world.skeletons[0]


def moved(q: Vector, dq: Vector, h: float) -> Vector:
    """Positions after h seconds, to first order and with an even error, so that central differences are of second
    order. Free and ball joints turn by their velocity in the child's frame."""
    after = q + h * dq
    for place in (FREE, BALL):
        turn = Rotation.from_rotvec(q[place][:3])
        after[place][:3] = (turn * Rotation.from_rotvec(h * dq[place][:3])).as_rotvec()
    after[3:6] = q[3:6] + h * Rotation.from_rotvec(q[:3]).apply(dq[3:6])
    return after


def rate(skel: pydart2.Skeleton, q: Vector, dq: Vector, read: Callable[[], Vector]) -> Vector:
    """Time derivative of what `read` gives, by central differences."""
    values = []
    for h in (STEP, -STEP):
        skel.q, skel.dq = moved(q, dq, h), dq
        values.append(read())
    skel.q, skel.dq = q, dq
    return (values[0] - values[1]) / (2 * STEP)


@few
@given(q=vectors, dof=st.integers(0, NDOFS - 1), position=st.floats(-1.2, 1.2))
def test_centre_of_mass_is_the_mean_of_the_bodies(skel: pydart2.Skeleton, q: Vector, dof: int, position: float) -> None:
    """Also where one joint has moved since all transforms were read."""
    skel.q = q
    assert all(np.isfinite(body.T).all() for body in skel.bodynodes)
    skel.dofs[dof].set_position(position)
    found = skel.C
    mean = sum(body.m * body.C for body in skel.bodynodes) / skel.m
    np.testing.assert_allclose(found, mean, atol=1e-13)
    np.testing.assert_allclose(skel.C, mean, atol=1e-13)  # with the transforms that the engine knows by now


@few
@given(q=vectors, dq=vectors, name=bodies, point=points)
def test_linear_jacobian_gives_the_velocity(
    skel: pydart2.Skeleton, q: Vector, dq: Vector, name: str, point: Vector
) -> None:
    body = skel.body(name)
    velocity = rate(skel, q, dq, lambda: body.to_world(point))
    np.testing.assert_allclose(body.linear_jacobian(point) @ dq, velocity, atol=1e-7)
    np.testing.assert_allclose(body.J @ dq, rate(skel, q, dq, body.to_world), atol=1e-7)
    np.testing.assert_allclose(body.dC, rate(skel, q, dq, body.com), atol=1e-7)


@few
@given(q=vectors, dq=vectors, name=bodies)
def test_angular_jacobian_gives_the_angular_velocity(skel: pydart2.Skeleton, q: Vector, dq: Vector, name: str) -> None:
    body = skel.body(name)
    skew = rate(skel, q, dq, lambda: body.T[:3, :3]) @ body.T[:3, :3].T
    angular = np.array([skew[2, 1], skew[0, 2], skew[1, 0]])
    np.testing.assert_allclose(body.angular_jacobian() @ dq, angular, atol=1e-7)


@few
@given(q=vectors, dq=vectors, name=bodies, point=points)
def test_jacobian_derivatives(skel: pydart2.Skeleton, q: Vector, dq: Vector, name: str, point: Vector) -> None:
    """A Jacobian's derivative is defined by the acceleration at ddq = 0: d(J dq)/dt = dJ dq."""
    body = skel.body(name)
    linear = rate(skel, q, dq, lambda: body.linear_jacobian(point) @ dq)
    angular = rate(skel, q, dq, lambda: body.angular_jacobian() @ dq)
    np.testing.assert_allclose(body.linear_jacobian_deriv(point) @ dq, linear, atol=1e-6)
    np.testing.assert_allclose(body.dJ @ dq, rate(skel, q, dq, lambda: body.J @ dq), atol=1e-6)
    np.testing.assert_allclose(body.angular_jacobian_deriv() @ dq, angular, atol=1e-6)


@few
@given(q=vectors, dq=vectors, name=bodies, point=points)
def test_jacobian_derivatives_entry_by_entry(
    skel: pydart2.Skeleton, q: Vector, dq: Vector, name: str, point: Vector
) -> None:
    body = skel.body(name)
    linear = rate(skel, q, dq, lambda: body.linear_jacobian(point))
    angular = rate(skel, q, dq, body.angular_jacobian)
    np.testing.assert_allclose(body.linear_jacobian_deriv(point), linear, atol=1e-6)
    np.testing.assert_allclose(body.angular_jacobian_deriv(), angular, atol=1e-6)


@few
@given(q=vectors, name=bodies, point=points)
def test_jacobians_agree(skel: pydart2.Skeleton, q: Vector, name: str, point: Vector) -> None:
    """Angular rows first; the body Jacobian is the world Jacobian in body axes; full has zero columns added."""
    skel.q = q
    body = skel.body(name)
    world = body.world_jacobian(point)
    np.testing.assert_allclose(world[:3], body.angular_jacobian(), atol=1e-12)
    np.testing.assert_allclose(world[3:], body.linear_jacobian(point), atol=1e-12)
    R = body.T[:3, :3]
    np.testing.assert_allclose(body.jacobian(point), np.vstack([R.T @ world[:3], R.T @ world[3:]]), atol=1e-12)
    dependent = [dof.id for dof in body.dependent_dofs]
    np.testing.assert_allclose(body.world_jacobian(point, full=False), world[:, dependent], atol=1e-12)
    np.testing.assert_array_equal(np.delete(world, dependent, axis=1), 0)
    np.testing.assert_allclose(body.expand_jacobian(body.linear_jacobian(point, False)), world[3:], atol=1e-12)


def summed_mass_matrix(skel: pydart2.Skeleton) -> Vector:
    """M by its definition: the sum over the bodies of m J^T J + W^T I W, I about the COM in world axes."""
    total = np.zeros((skel.ndofs, skel.ndofs))
    for body in skel.bodynodes:
        R = body.T[:3, :3]
        J, W = body.linear_jacobian(body.local_com()), body.angular_jacobian()
        total += body.m * J.T @ J + W.T @ R @ body.I @ R.T @ W
    return total


@few
@given(q=vectors, dq=vectors)
def test_mass_matrix_is_the_sum_over_bodies(skel: pydart2.Skeleton, q: Vector, dq: Vector) -> None:
    skel.q, skel.dq = q, dq
    M = skel.M
    kinetic = 0.0
    for body in skel.bodynodes:
        R = body.T[:3, :3]
        w = body.angular_jacobian() @ dq
        kinetic += body.m * body.dC @ body.dC / 2 + w @ R @ body.I @ R.T @ w / 2
    np.testing.assert_allclose(M, summed_mass_matrix(skel), atol=1e-11)
    np.testing.assert_array_equal(M, M.T)
    assert np.linalg.eigvalsh(M).min() > 0
    np.testing.assert_allclose(M @ skel.invM, np.eye(NDOFS), atol=1e-8)
    assert dq @ M @ dq / 2 == pytest.approx(kinetic, rel=1e-11, abs=1e-12)


TILTED = np.array([[0.0, -1, 0, 0.3], [1, 0, 0, -0.2], [0, 0, 1, 0.1], [0, 0, 0, 1]])


@pytest.mark.parametrize(
    "change",
    [
        lambda skel: skel.body("foot").set_mass(7.0),
        lambda skel: skel.body("head").set_inertia(np.diag([0.9, 0.8, 0.7])),
        lambda skel: skel.body("tail").set_local_com([0.4, 0.3, -0.2]),
        lambda skel: skel.joint("thigh_joint").set_axis([0.0, 0.0, 1.0]),
        lambda skel: skel.joint("foot_joint").set_axis([1.0, 0.0, 0.0]),
        lambda skel: skel.joint("hand_joint").set_axis1([0.0, 0.0, 1.0]),
        lambda skel: skel.joint("tail_joint").set_axis_order("ZYX"),
        lambda skel: skel.joint("head_joint").set_transform_from_parent_body_node(TILTED),
        lambda skel: skel.joint("head_joint").set_transform_from_child_body_node(TILTED),
        lambda skel: skel.set_root_joint_to_trans_and_euler(),
        lambda skel: skel.set_root_joint_to_weld(),
        lambda skel: skel.set_positions(np.linspace(-1, 1, NDOFS)),
        lambda skel: skel.dof(8).set_position(0.7),
        lambda skel: skel.world.set_states(np.linspace(1, -1, 2 * NDOFS)),
        lambda skel: (skel.set_velocities(np.ones(NDOFS)), skel.world.step(20)),
    ],
)
def test_mass_matrix_follows_every_change(tmp_path: Path, change: Callable[[pydart2.Skeleton], object]) -> None:
    skel = make_world(tmp_path, creature()).skeletons[0]
    skel.q = np.linspace(-0.5, 0.8, NDOFS)
    before = skel.M
    change(skel)
    M = skel.M
    assert M.shape != before.shape or not np.allclose(M, before)
    np.testing.assert_allclose(M, summed_mass_matrix(skel), atol=1e-11)


def test_mass_matrix_of_two_trees(tmp_path: Path) -> None:
    """Two roots in one skeleton: no coupling between their dofs."""
    parts = [creature(), free_body(mass=3.0)]
    inner = "".join(part.split(">", 1)[1].rsplit("<", 1)[0] for part in parts)
    skel = make_world(tmp_path, f'<skeleton name="two">{inner}</skeleton>').skeletons[0]
    assert len(skel.root_bodynodes()) == 2
    skel.q = np.linspace(-0.5, 0.8, skel.ndofs)
    np.testing.assert_allclose(skel.M, summed_mass_matrix(skel), atol=1e-11)
    np.testing.assert_array_equal(skel.M[:NDOFS, NDOFS:], 0.0)


@few
@given(q=vectors)
def test_bias_forces_at_rest_are_the_gradient_of_the_potential(skel: pydart2.Skeleton, q: Vector) -> None:
    """c · v is the power against gravity, for every velocity v."""
    gravity = np.array(DOWN)

    def potential() -> Vector:
        return -np.array(sum(body.m * gravity @ body.C for body in skel.bodynodes))

    gradient = [rate(skel, q, direction, potential) for direction in np.eye(NDOFS)]
    skel.q, skel.dq = q, np.zeros(NDOFS)
    np.testing.assert_allclose(skel.c, gradient, atol=1e-6)


@few
@given(q=vectors, dq=vectors)
def test_coriolis_forces_do_no_work_of_their_own(skel: pydart2.Skeleton, q: Vector, dq: Vector) -> None:
    """Power: at ddq = 0 the kinetic energy dqᵀ M dq / 2 changes by dq · (C(q, dq) dq)."""
    skel.world.g = [0, 0, 0]
    change = rate(skel, q, dq, lambda: dq @ skel.M @ dq / 2)
    power = dq @ skel.c
    skel.world.g = DOWN
    assert power == pytest.approx(float(change), abs=2e-6)


@few
@given(q=vectors, dq=vectors, tau=vectors)
def test_equations_of_motion_after_a_step(skel: pydart2.Skeleton, q: Vector, dq: Vector, tau: Vector) -> None:
    """M ddq + c = tau with M and c from before the step; then dq += ddq dt.

    The velocity of a free joint is in body axes: Debian's engine turns its translation, and the joint's acceleration,
    with the body at the end of a step. That is of order dt.
    """
    world, errors = skel.world, []
    for world.dt in (1e-3, 1e-4):
        skel.q, skel.dq, skel.tau = q, dq, 10 * tau
        expected = np.linalg.solve(skel.M, 10 * tau - skel.c)
        world.step()
        error = np.abs(skel.ddq - expected)
        errors.append(error[FREE].max())
        np.testing.assert_allclose(error[6:], 0, atol=1e-8)
        np.testing.assert_allclose(np.delete(skel.dq - dq - world.dt * expected, slice(3, 6)), 0, atol=1e-11)
    world.dt = 1e-3
    assert errors[1] < 0.2 * errors[0] + 1e-8


@pytest.mark.parametrize("root", ["ball", "euler", "translational", "planar", "weld"])
def test_equations_of_motion_of_other_roots(tmp_path: Path, root: str) -> None:
    world = make_world(tmp_path, creature(root))
    skel, random = world.skeletons[0], np.random.default_rng(2)
    q, dq, tau = random.normal(0, 0.4, (3, skel.ndofs))
    skel.q, skel.dq, skel.tau = q, dq, 10 * tau
    M, c = skel.M, skel.c
    world.step()
    np.testing.assert_allclose(M @ skel.ddq + c, 10 * tau, atol=1e-9)
    np.testing.assert_allclose(skel.dq, dq + world.dt * skel.ddq, atol=1e-12)


@few
@given(q=vectors, dq=vectors)
def test_com_is_the_weighted_mean(skel: pydart2.Skeleton, q: Vector, dq: Vector) -> None:
    skel.q, skel.dq = q, dq
    masses = [body.m for body in skel.bodynodes]
    assert skel.m == pytest.approx(sum(masses))
    np.testing.assert_allclose(skel.C, np.average([b.C for b in skel.bodynodes], axis=0, weights=masses), atol=1e-12)
    np.testing.assert_allclose(skel.dC, np.average([b.dC for b in skel.bodynodes], axis=0, weights=masses), atol=1e-12)
    for body in skel.bodynodes:
        np.testing.assert_allclose(body.C, body.to_world(body.local_com()), atol=1e-12)


def test_spatial_velocity_of_the_com_is_in_body_axes(skel: pydart2.Skeleton) -> None:
    random = np.random.default_rng(1)
    skel.q, skel.dq = random.normal(0, 0.5, NDOFS), random.normal(0, 1, NDOFS)
    for body in skel.bodynodes:
        R = body.T[:3, :3]
        expected = np.concatenate([R.T @ body.angular_jacobian() @ skel.dq, R.T @ body.dC])
        np.testing.assert_allclose(body.com_spatial_velocity(), expected, atol=1e-12)
