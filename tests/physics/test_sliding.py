"""What slides on feet: the iterative solver's cone beside the coupled problem, solved by trying all its cases."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from scipy.optimize import least_squares

import pydart2

G, DT, RADIUS = 9.81, 0.001, 0.05
MASS, INERTIA = 2.0, 0.03 * np.eye(3)
WEIGHT = MASS * G * DT  # of a step, N s
CASES = ("open", "stick", "slide")


def skew(v: np.ndarray) -> np.ndarray:
    return np.array([[0.0, -v[2], v[1]], [v[2], 0.0, -v[0]], [-v[1], v[0], 0.0]])


def residual(
    impulses: np.ndarray, cases: tuple[str, ...], matrix: np.ndarray, free: np.ndarray, friction: float
) -> np.ndarray:
    """What is zero where each foot does as its case says: Coulomb's law in three equations a foot."""
    velocities = (matrix @ impulses + free).reshape(-1, 3)
    rows = []
    for case, impulse, velocity in zip(cases, impulses.reshape(-1, 3), velocities, strict=True):
        if case == "open":
            rows.append(impulse)
        elif case == "stick":
            rows.append(velocity)
        else:
            speed = np.hypot(velocity[0], velocity[1]) + 1e-300
            rows.append([*(impulse[:2] + friction * impulse[2] * velocity[:2] / speed), velocity[2]])
    return np.concatenate(rows)


def is_allowed(impulses: np.ndarray, cases: tuple[str, ...], velocities: np.ndarray, friction: float) -> bool:
    for case, impulse, velocity in zip(cases, impulses.reshape(-1, 3), velocities.reshape(-1, 3), strict=True):
        if case == "open" and velocity[2] < -1e-12:
            return False
        if case != "open" and impulse[2] < -1e-12:
            return False
        if case == "stick" and np.hypot(impulse[0], impulse[1]) > friction * impulse[2] + 1e-12:
            return False
    return True


def solutions(matrix: np.ndarray, free: np.ndarray, friction: float) -> list[np.ndarray]:
    """The velocities at the feet of every case that is consistent, each to 1e-10."""
    found: list[np.ndarray] = []
    for cases in itertools.product(CASES, repeat=len(free) // 3):
        problem = (cases, matrix, free, friction)
        start = np.tile([0.0, 0.0, WEIGHT / len(cases)], len(cases))
        answer = least_squares(residual, start, args=problem, method="lm", xtol=1e-15, ftol=1e-15, gtol=1e-15)
        velocities = matrix @ answer.x + free
        if np.abs(residual(answer.x, *problem)).max() > 1e-10 or not is_allowed(answer.x, cases, velocities, friction):
            continue
        if all(np.abs(velocities - other).max() > 1e-8 for other in found):
            found.append(velocities)
    return found


def on_feet(feet: np.ndarray, height: float, friction: float, spin: np.ndarray, speed: np.ndarray) -> pydart2.World:
    """A body of 2 kg on balls, whose mass is at the origin of its frame, and whose inertia is that of a ball."""
    world = pydart2.World(DT, up="z")
    world.set_collision_detector("native")
    world.set_constraint_solver("iterative", friction="cone")
    world.add_ground(friction=friction)
    body = world.add_empty_skeleton("stool").add_body("stool", position=(0.0, 0.0, height), mass=MASS, inertia=INERTIA)
    for foot in feet:
        body.add_sphere(RADIUS, position=(*foot, RADIUS - height - 1e-9), mass=0.0, friction=friction)
    world.skeletons[1].dq = np.r_[spin, speed]
    return world


@pytest.mark.parametrize("seed", range(12))
def test_stool_that_slides(seed: int) -> None:
    """Three feet, of which some slide, some stick and some lift: one step, to 1e-3 of what the impulses change."""
    rng = np.random.default_rng(seed)
    angles = np.radians([90.0, 210.0, 330.0]) + rng.uniform(-0.4, 0.4, 3)
    feet = 0.2 * np.c_[np.cos(angles), np.sin(angles)]
    height, friction = rng.uniform(0.15, 0.4), rng.uniform(0.05, 0.6)
    spin = np.r_[rng.uniform(-0.02, 0.02, 2), rng.uniform(-2.0, 2.0)]
    speed = np.r_[rng.uniform(-0.3, 0.3, 2) * rng.choice([0.01, 1.0]), -rng.uniform(0.0, 0.02)]
    world = on_feet(feet, height, friction, spin, speed)

    arms = np.c_[feet, np.full(3, -height)]
    jacobian = np.vstack([np.hstack([-skew(arm), np.eye(3)]) for arm in arms])
    inverse = np.diag([1.0 / 0.03] * 3 + [0.5] * 3)
    before = np.r_[spin, speed - [0.0, 0.0, G * DT]]
    matrix, free = jacobian @ inverse @ jacobian.T, jacobian @ before
    expected = solutions(matrix, free, friction)
    assert expected

    world.step()
    stool = world.skeletons[1].bodynodes[0]
    after = jacobian @ stool.world_spatial_velocity()  # in the world, not in the frame that has turned
    nearest = min(expected, key=lambda velocities: float(np.abs(velocities - after).max()))
    assert np.abs(after - nearest).max() <= 1e-3 * np.abs(nearest - free).max()
