"""Bodies that nothing holds: free fall, momentum, external forces."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

import pydart2

from .models import DOWN, G, creature, free_body, make_world

NONE = (0.0, 0.0, 0.0)


def test_free_fall_is_exact(tmp_path: Path) -> None:
    """v_n = -g n dt and y_n = y_0 - g dt² n (n + 1) / 2: velocity first, then position."""
    dt, steps = 0.002, 500
    world = make_world(tmp_path, free_body(at=(0, 10, 0, 0, 0, 0)), dt=dt)
    body = world.skeletons[0].bodynodes[0]
    for n in range(1, steps + 1):
        world.step()
        np.testing.assert_allclose(body.dC, [0, -G * n * dt, 0], atol=1e-11)
        np.testing.assert_allclose(body.C, [0, 10 - G * dt**2 * n * (n + 1) / 2, 0], atol=1e-11)


def test_projectile_is_exact(tmp_path: Path) -> None:
    dt, n = 0.001, 1000
    world = make_world(tmp_path, free_body(mass=3.0), dt=dt)
    skel = world.skeletons[0]
    skel.dq = [0, 0, 0, 4.0, 5.0, -6.0]
    world.step(n)
    np.testing.assert_allclose(skel.C, [4.0, 5.0 - G * dt**2 * n * (n + 1) / 2, -6.0], atol=1e-10)
    np.testing.assert_allclose(skel.dC, [4.0, 5.0 - G, -6.0], atol=1e-10)
    np.testing.assert_allclose(skel.ddC, DOWN, atol=1e-10)
    np.testing.assert_allclose(skel.P, 3.0 * np.array([4.0, 5.0 - G, -6.0]), atol=1e-9)


def test_gravity_mode_off(tmp_path: Path) -> None:
    world = make_world(tmp_path, free_body("falls"), free_body("floats"))
    falls, floats = (skel.bodynodes[0] for skel in world.skeletons)
    floats.set_gravity_mode(False)
    world.step(100)
    assert falls.dC[1] == pytest.approx(-0.1 * G)
    np.testing.assert_array_equal(floats.C, NONE)
    assert np.allclose(floats.skel.c, 0)


def test_immobile_skeletons_stay(tmp_path: Path) -> None:
    world = make_world(tmp_path, free_body())
    skel = world.skeletons[0]
    skel.set_mobile(False)
    world.step(100)
    np.testing.assert_array_equal(skel.q, np.zeros(6))


def momenta(skel: pydart2.Skeleton) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Linear momentum, and angular momentum about the COM, summed over the bodies."""
    linear, angular, centre = np.zeros(3), np.zeros(3), skel.C
    for body in skel.bodynodes:
        R = body.T[:3, :3]
        linear += body.m * body.dC
        angular += R @ body.I @ R.T @ body.angular_jacobian() @ skel.dq
        angular += body.m * np.cross(body.C - centre, body.dC)
    return linear, angular


def momentum_errors(folder: Path, dt: float) -> tuple[float, float]:
    world = make_world(folder, creature(), gravity=NONE, dt=dt)
    skel = world.skeletons[0]
    random = np.random.default_rng(3)
    skel.q, skel.dq = random.normal(0, 0.3, skel.ndofs), random.normal(0, 1, skel.ndofs)
    before = momenta(skel)
    np.testing.assert_allclose(skel.P, before[0], atol=1e-12)
    world.step(round(0.2 / dt))
    after = momenta(skel)
    assert np.linalg.norm(before[0]) > 1 and np.linalg.norm(before[1]) > 0.5
    return tuple(np.linalg.norm(b - a) for b, a in zip(before, after, strict=True))  # type: ignore[return-value]


def test_momenta_are_conserved(tmp_path: Path) -> None:
    """Up to the integrator's error, which goes with dt."""
    coarse, fine = momentum_errors(tmp_path, 4e-4), momentum_errors(tmp_path, 1e-4)
    assert max(fine) < 2e-3
    np.testing.assert_allclose(np.divide(coarse, fine), 4, rtol=0.1)


def test_internal_forces_do_not_move_the_com(tmp_path: Path) -> None:
    world = make_world(tmp_path, creature(), gravity=NONE, dt=1e-4)
    skel = world.skeletons[0]
    start = skel.C
    for _ in range(500):
        skel.tau = [0] * 6 + [1.0] * 10
        world.step()
    assert np.abs(skel.dq[6:]).max() > 0.1
    np.testing.assert_allclose(skel.C, start, atol=1e-4)


def test_torque_free_spin_about_a_principal_axis(tmp_path: Path) -> None:
    world = make_world(tmp_path, free_body(inertia=(0.1, 0.2, 0.4)), gravity=NONE)
    skel = world.skeletons[0]
    skel.dq = [0, 0, 3.0, 0, 0, 0]
    world.step(2000)
    expected = Rotation.from_rotvec([0, 0, 6.0]).as_matrix()
    np.testing.assert_allclose(skel.bodynodes[0].T[:3, :3], expected, atol=1e-9)


def test_torque_gives_angular_acceleration(tmp_path: Path) -> None:
    world = make_world(tmp_path, free_body(inertia=(0.1, 0.2, 0.4)), gravity=NONE)
    body = world.skeletons[0].bodynodes[0]
    for _ in range(100):
        body.add_ext_torque([0, 0.6, 0])
        world.step()
    np.testing.assert_allclose(world.skeletons[0].dq[:3], [0, 3.0 * 0.1, 0], atol=1e-12)


def after_one_step(world: pydart2.World) -> NDArray[np.float64]:
    world.step()
    return world.x


@pytest.mark.parametrize("force_local", [False, True])
@pytest.mark.parametrize("offset_local", [False, True])
def test_external_force_is_its_generalized_force(tmp_path: Path, force_local: bool, offset_local: bool) -> None:
    """A force f at a point of a body acts as tau = Jᵀ f, with the Jacobian of that point."""
    world = make_world(tmp_path, creature())
    skel = world.skeletons[0]
    random = np.random.default_rng(5)
    state = random.normal(0, 0.5, 2 * skel.ndofs)
    world.x = state
    hand, force, point = skel.body("hand"), np.array([3.0, -2.0, 5.0]), np.array([0.1, 0.2, -0.3])
    R = hand.T[:3, :3]
    hand.add_ext_force(
        R.T @ force if force_local else force,
        point if offset_local else hand.to_world(point),
        force_local,
        offset_local,
    )
    by_force = after_one_step(world)

    world.x = state
    skel.tau = hand.linear_jacobian(point).T @ force
    np.testing.assert_allclose(after_one_step(world), by_force, atol=1e-10)


def test_external_torque_is_its_generalized_force(tmp_path: Path) -> None:
    world = make_world(tmp_path, creature())
    skel = world.skeletons[0]
    state = np.random.default_rng(6).normal(0, 0.5, 2 * skel.ndofs)
    world.x = state
    torque = np.array([0.5, -1.0, 2.0])
    skel.body("tail").add_ext_torque(torque)
    by_torque = after_one_step(world)

    world.x = state
    skel.tau = skel.body("tail").angular_jacobian().T @ torque
    np.testing.assert_allclose(after_one_step(world), by_torque, atol=1e-10)


def test_external_forces_add_up_or_replace_and_last_one_step(tmp_path: Path) -> None:
    world = make_world(tmp_path, free_body(mass=2.0), gravity=NONE, dt=0.1)
    skel = world.skeletons[0]
    body = skel.bodynodes[0]
    body.add_ext_force([1, 0, 0])
    body.add_ext_force([0, 1, 0])
    world.step()
    np.testing.assert_allclose(skel.dC, [0.05, 0.05, 0])
    world.step()
    np.testing.assert_allclose(skel.dC, [0.05, 0.05, 0])
    body.add_ext_force([100, 0, 0])
    body.set_ext_force([0, 0, 1])
    world.step()
    np.testing.assert_allclose(skel.dC, [0.05, 0.05, 0.05])
