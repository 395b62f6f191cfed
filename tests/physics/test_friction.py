"""Sliding and rolling on a floor that is tilted by tilting gravity.

The friction coefficient of a contact is the smaller of the two bodies'.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import pydart2

from .models import G, box, floor, free_body, make_world, sphere

RADIUS = 0.1
BRICK = free_body("brick", mass=2.0, inertia=(0.03, 0.05, 0.03), at=(0, 0.05, 0, 0, 0, 0), shape=box((0.4, 0.1, 0.4)))
MOMENT = 0.4 * 2.0 * RADIUS**2
BALL = free_body("ball", mass=2.0, inertia=(MOMENT,) * 3, at=(0, RADIUS, 0, 0, 0, 0), shape=sphere(RADIUS))


def tilted(folder: Path, thing: str, slope: float, mu: float, floor_mu: float) -> pydart2.World:
    """Slope is the tangent of the angle; the way down is along x."""
    angle = np.arctan(slope)
    world = make_world(folder, floor(), thing, gravity=(G * np.sin(angle), -G * np.cos(angle), 0))
    world.skeletons[0].bodynodes[0].set_friction_coeff(floor_mu)
    world.skeletons[1].bodynodes[0].set_friction_coeff(mu)
    return world


@pytest.mark.parametrize("detector", [0, 1, 2, 3])
@pytest.mark.parametrize(("mu", "floor_mu"), [(0.5, 0.8), (0.8, 0.5), (0.5, 5.0)])
def test_brick_slides_above_the_friction_angle(tmp_path: Path, detector: int, mu: float, floor_mu: float) -> None:
    """a = g (sin - mu cos), with mu = 0.5."""
    slope = 0.7
    world = tilted(tmp_path, BRICK, slope, mu, floor_mu)
    world.set_collision_detector(detector)
    brick = world.skeletons[1]
    world.step(100)  # it settles
    start, seconds = brick.dC[0], 0.3
    world.step(round(seconds / world.dt))
    expected = G * (slope - 0.5) / np.hypot(1, slope)
    assert (brick.dC[0] - start) / seconds == pytest.approx(expected, rel=0.02)
    assert abs(brick.dC[1]) < 1e-2 and abs(brick.dC[2]) < 1e-2


@pytest.mark.parametrize("detector", [0, 1, 2, 3])
@pytest.mark.parametrize(("mu", "floor_mu"), [(0.5, 0.8), (0.8, 0.5)])
def test_brick_sticks_below_the_friction_angle(tmp_path: Path, detector: int, mu: float, floor_mu: float) -> None:
    world = tilted(tmp_path, BRICK, 0.45, mu, floor_mu)
    world.set_collision_detector(detector)
    brick = world.skeletons[1]
    world.step(100)
    start = brick.C
    world.step(400)
    np.testing.assert_allclose(brick.C, start, atol=1e-4)
    np.testing.assert_allclose(brick.dC, 0, atol=1e-3)


def test_without_friction_nothing_holds_the_brick(tmp_path: Path) -> None:
    world = tilted(tmp_path, BRICK, 0.1, 0.0, 1.0)
    world.step(500)
    assert world.skeletons[1].dC[0] == pytest.approx(0.5 * G * 0.1 / np.hypot(1, 0.1), rel=1e-3)


def roll(folder: Path, slope: float, mu: float) -> tuple[float, float]:
    """Acceleration and angular acceleration of the ball."""
    world = tilted(folder, BALL, slope, mu, 1.0)
    ball = world.skeletons[1]
    world.step(500)
    spin = ball.bodynodes[0].angular_jacobian() @ ball.dq
    np.testing.assert_allclose(spin[:2], 0, atol=1e-6)
    return ball.dC[0] / world.t, -spin[2] / world.t


@pytest.mark.parametrize("slope", [0.2, 0.5])
def test_ball_rolls_without_slipping(tmp_path: Path, slope: float) -> None:
    """While slope < 7/2 mu: a = 5/7 g sin, turning by a / r."""
    a, turn = roll(tmp_path, slope, mu=0.6)
    assert a == pytest.approx(5 / 7 * G * slope / np.hypot(1, slope), rel=0.01)
    assert turn == pytest.approx(a / RADIUS, rel=0.01)


@pytest.mark.parametrize(("slope", "mu"), [(1.0, 0.2), (0.5, 0.1)])
def test_ball_slips_beyond_the_threshold(tmp_path: Path, slope: float, mu: float) -> None:
    """When slope > 7/2 mu: a = g (sin - mu cos), turning by 5/2 mu g cos / r."""
    a, turn = roll(tmp_path, slope, mu)
    cosine = 1 / np.hypot(1, slope)
    assert a == pytest.approx(G * (slope - mu) * cosine, rel=0.01)
    assert turn == pytest.approx(2.5 * mu * G * cosine / RADIUS, rel=0.01)
