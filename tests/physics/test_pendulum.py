"""Pendulums: the period by the elliptic integral, energy, and the double pendulum's equations."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.special import ellipk

import pydart2

from .models import G, arm, make_world, pendulum

MASS, LENGTH, MOMENT = 1.5, 0.8, 0.05
ABOUT_HINGE = MOMENT + MASS * LENGTH**2


def period(amplitude: float) -> float:
    """T = 4 sqrt(I / (m g l)) K(sin²(amplitude / 2))."""
    return 4 * np.sqrt(ABOUT_HINGE / (MASS * G * LENGTH)) * ellipk(np.sin(amplitude / 2) ** 2)


def upward_crossings(world: pydart2.World, count: int) -> list[float]:
    """Times at which q goes from below to above 0, between steps by the straight line."""
    skel, times = world.skeletons[0], []
    before = skel.q[0]
    while len(times) < count:
        world.step()
        now = skel.q[0]
        if before < 0 <= now:
            times.append(world.t - world.dt * now / (now - before))
        before = now
        assert world.t < 60
    return times


@pytest.mark.parametrize("amplitude", [0.05, 0.8, 2.0, 3.0])
def test_period(tmp_path: Path, amplitude: float) -> None:
    world = make_world(tmp_path, pendulum(MASS, LENGTH, MOMENT))
    world.skeletons[0].q = [amplitude]
    times = upward_crossings(world, 3)
    # The integrator's first order is in the phase: the period is right to the second.
    np.testing.assert_allclose(np.diff(times), period(amplitude), rtol=5e-5)


def energy(skel: pydart2.Skeleton) -> float:
    return sum(
        0.5 * b.m * b.dC @ b.dC + 0.5 * w @ rotated(b) @ w + b.m * G * b.C[1]
        for b in skel.bodynodes
        for w in [b.angular_jacobian() @ skel.dq]
    )


def rotated(body: pydart2.BodyNode) -> NDArray[np.float64]:
    """The moment of inertia in world axes."""
    R = body.T[:3, :3]
    return R @ body.I @ R.T


def test_energy_does_not_drift(tmp_path: Path) -> None:
    """Semi-implicit Euler keeps the energy of one dof near its value for ever; it only swings by O(dt)."""
    world = make_world(tmp_path, pendulum(MASS, LENGTH, MOMENT))
    skel = world.skeletons[0]
    skel.q = [1.0]
    scale = MASS * G * LENGTH
    energies = []
    for _ in range(15):
        energies.append([])
        while len(energies[-1]) < round(period(1.0) / world.dt):
            world.step()
            energies[-1].append(energy(skel) / scale)
    assert np.ptp(energies) < 5e-3
    means = np.mean(energies, axis=1)
    assert np.ptp(means) < 1e-5


def energy_error(folder: Path, dt: float) -> float:
    world = make_world(folder, arm(), dt=dt)
    skel = world.skeletons[0]
    skel.q = [1.5, 1.0]
    start = energy(skel)
    world.step(round(0.5 / dt))
    return abs(energy(skel) - start)


def test_double_pendulum_energy_error_is_of_first_order(tmp_path: Path) -> None:
    errors = [energy_error(tmp_path, dt) for dt in (4e-4, 2e-4, 1e-4)]
    assert errors[-1] < 0.01
    np.testing.assert_allclose(np.divide(errors[:-1], errors[1:]), 2, rtol=0.05)


@pytest.mark.parametrize("q", [(0.3, -0.7), (2.0, 1.1), (-1.0, 3.0)])
def test_double_pendulum_equations(tmp_path: Path, q: tuple[float, float]) -> None:
    """Two links of 1 m, masses 1 and 2, COMs in the middle, moments 0.1; angles from the vertical and from link 1."""
    skel = make_world(tmp_path, arm()).skeletons[0]
    skel.q, skel.dq = q, (0.7, -1.3)
    m1, m2, half, moment = 1.0, 2.0, 0.5, 0.1
    cross = m2 * half * np.cos(q[1])
    m22 = moment + m2 * half**2
    m11 = moment + m1 * half**2 + m2 * 1.0 + m22 + 2 * cross
    np.testing.assert_allclose(skel.M, [[m11, m22 + cross], [m22 + cross, m22]], rtol=1e-12)

    h = m2 * half * np.sin(q[1])
    w1, w2 = 0.7, -1.3
    lower = m2 * G * half * np.sin(q[0] + q[1])
    upper = (m1 * half + m2) * G * np.sin(q[0])
    np.testing.assert_allclose(
        skel.c, [-h * (2 * w1 * w2 + w2**2) + upper + lower, h * w1**2 + lower], rtol=1e-12, atol=1e-12
    )
