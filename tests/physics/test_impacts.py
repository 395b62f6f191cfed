"""Contacts: resting forces and bounces. The restitution of a contact is the product of the two bodies'."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from .models import G, box, floor, free_body, joint, make_world, skeleton, sphere
from .models import body as body_text

RADIUS, DROP = 0.1, 0.5
MOMENT = 0.4 * RADIUS**2


@pytest.mark.parametrize("detector", [0, 1, 2, 3])
def test_contact_forces_carry_the_weight(tmp_path: Path, detector: int) -> None:
    cube = free_body(mass=3.0, inertia=(0.02, 0.02, 0.02), at=(0, 0.1, 0, 0, 0, 0), shape=box((0.2,) * 3))
    world = make_world(tmp_path, floor(), cube)
    world.set_collision_detector(detector)
    world.step(500)
    cube_body = world.skeletons[1].bodynodes[0]
    on_cube = sum(c.f if c.bodynode1 is cube_body else -c.f for c in world.collision_result.contacts)
    np.testing.assert_allclose(on_cube, [0, 3.0 * G, 0], atol=1e-3)
    for contact in world.collision_result.contacts:
        assert contact.f @ contact.normal >= 0
        assert contact.point[1] == pytest.approx(0, abs=2e-3)
    np.testing.assert_allclose(world.skeletons[1].constraint_forces()[3:], [0, 3.0 * G, 0], atol=1e-3)


@pytest.mark.parametrize(("ball_e", "floor_e"), [(0.0, 1.0), (0.5, 1.0), (0.8, 1.0), (1.0, 1.0), (0.8, 0.5)])
def test_bounce_height(tmp_path: Path, ball_e: float, floor_e: float) -> None:
    """Dropped from DROP above the floor it comes back to e² DROP."""
    ball = free_body(inertia=(MOMENT,) * 3, at=(0, RADIUS + DROP, 0, 0, 0, 0), shape=sphere(RADIUS))
    world = make_world(tmp_path, floor(), ball, dt=2e-4)
    for skel, e in zip(world.skeletons, (floor_e, ball_e), strict=True):
        skel.bodynodes[0].set_restitution_coeff(e)
    body = world.skeletons[1].bodynodes[0]
    world.step(round(1.1 * np.sqrt(2 * DROP / G) / world.dt))  # the impact is behind it
    highest = 0.0
    while body.dC[1] > 0 and world.t < 1:
        world.step()
        highest = body.C[1] - RADIUS
    assert highest == pytest.approx((ball_e * floor_e) ** 2 * DROP, rel=0.02, abs=2e-3)


def test_equal_balls_exchange_their_velocities(tmp_path: Path) -> None:
    """A head-on elastic impact."""
    balls = [
        free_body(f"ball{i}", inertia=(MOMENT,) * 3, at=(0.5 * i, 0, 0, 0, 0, 0), shape=sphere(RADIUS)) for i in (0, 1)
    ]
    world = make_world(tmp_path, *balls, gravity=(0, 0, 0))
    left, right = world.skeletons
    for skel in (left, right):
        skel.bodynodes[0].set_restitution_coeff(1.0)
    left.dq = [0, 0, 0, 2.0, 0, 0]
    world.step(500)
    np.testing.assert_allclose(left.dC, 0, atol=1e-4)
    np.testing.assert_allclose(right.dC, [2.0, 0, 0], atol=1e-4)


def test_bodies_that_do_not_collide_pass(tmp_path: Path) -> None:
    ball = free_body(inertia=(MOMENT,) * 3, at=(0, 0.2, 0, 0, 0, 0), shape=sphere(RADIUS))
    world = make_world(tmp_path, floor(), ball)
    world.skeletons[1].bodynodes[0].set_collidable(False)
    world.step(500)
    assert world.skeletons[1].C[1] < -0.9
    assert world.collision_result.num_contacts() == 0


def two_links() -> str:
    """Two cubes that overlap, joined to the world by rails so that they are neighbours of nobody but a hub."""
    parts = [body_text("hub"), joint("weld", "hub", name="weld")]
    for i, x in enumerate((-0.08, 0.08)):
        parts.append(body_text(f"cube{i}", at=(x, 0, 0, 0, 0, 0), shape=box((0.2,) * 3)))
        parts.append(joint("prismatic", f"cube{i}", "hub", axis=(1, 0, 0), name=f"rail{i}"))
    return skeleton(*parts, name="links")


def test_self_collision_is_off_until_asked_for(tmp_path: Path) -> None:
    world = make_world(tmp_path, two_links(), gravity=(0, 0, 0))
    world.check_collision()
    assert world.collision_result.num_contacts() == 0
    world.skeletons[0].set_self_collision_check(True)
    world.check_collision()
    assert {b.name for b in world.collision_result.contacted_bodies} == {"cube0", "cube1"}
