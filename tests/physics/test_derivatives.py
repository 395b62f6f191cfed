"""Derivatives of inverse and forward dynamics, and of a step, beside differences and closed forms."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray

from pydart2 import Skeleton, World

Array = NDArray[np.float64]
JOINTS = ["revolute", "prismatic", "screw", "universal", "planar", "translational", "translational2d", "euler", "ball"]


def differences(of: Callable[[Array], Array], n: int, change: float = 1e-6) -> Array:
    """Central differences, by each of n numbers."""
    return np.array([(of(change * e) - of(-change * e)) / (2.0 * change) for e in np.eye(n)]).T


def close(ours: Array, theirs: Array) -> None:
    assert_allclose(ours, theirs, rtol=0.0, atol=2e-8 * max(1.0, np.abs(theirs).max()))


def compare(skel: Skeleton) -> None:
    """In one random state."""
    n = skel.ndofs
    q, dq, ddq = np.random.default_rng(n).uniform(-1.0, 1.0, (3, n))
    skel.q, skel.dq = q, dq

    def forces(by_q: Array, by_dq: Array) -> Array:
        skel.q, skel.dq = skel.integrate_positions(q, by_q), dq + by_dq
        force = skel.inverse_dynamics(ddq, external=False, damping=False, springs=False)
        skel.q, skel.dq = q, dq
        return force

    none = np.zeros(n)
    derivatives = skel.inverse_dynamics_derivatives(ddq)
    close(derivatives.q, differences(lambda change: forces(change, none), n))
    close(derivatives.dq, differences(lambda change: forces(none, change), n))
    assert_allclose(derivatives.ddq, skel.M)


@pytest.mark.parametrize("model", ["skel/chain.skel", "skel/fullbody1.skel", "sdf/atlas/atlas_v3_no_head.sdf"])
def test_inverse_dynamics_of_models(model: str) -> None:
    world = World(0.001)
    compare(
        max(World(0.001, model).skeletons, key=lambda skel: skel.ndofs)
        if ".skel" in model
        else world.add_skeleton(model)
    )


@pytest.mark.parametrize("first", [*JOINTS, "free"])
@pytest.mark.parametrize("second", JOINTS)
def test_inverse_dynamics_of_joints(first: str, second: str) -> None:
    """Each joint on each other, far from the origin, in two trees, one body without gravity."""
    world = World(0.001, up="z")
    skel = world.add_empty_skeleton("pair")
    for tree in "ab":
        parent = None
        for i, joint in enumerate((first, second, first if first != "free" else second)):
            body = skel.add_body(f"{tree}{i}", parent, joint, position=[20.0 if parent is None else 0.3, 0.1, 0.2])
            body.add_box([0.1, 0.2, 0.3], mass=1.0 + i)
            body.set_gravity_mode(i != 1)
            parent = body
    compare(skel)


def test_what_has_no_derivatives() -> None:
    soft = World(0.001, "skel/softBodies.skel").skeletons[1]
    with pytest.raises(ValueError, match="soft bodies"):
        soft.inverse_dynamics_derivatives(np.zeros(soft.ndofs))
    with pytest.raises(ValueError, match="one number per dof"):
        World(0.001, "skel/chain.skel").skeletons[0].inverse_dynamics_derivatives([1.0])
    with pytest.raises(ValueError, match="small number"):
        World(0.001).linearize(0.0)


def test_positions_are_the_opposite_of_their_differences() -> None:
    skel = World(0.001, "skel/fullbody1.skel").skeletons[1]
    q, change = np.random.default_rng(0).uniform(-1.0, 1.0, (2, skel.ndofs))
    x = np.array(skel.x)
    moved = skel.integrate_positions(q, change)
    assert_allclose(skel.position_differences(moved, q), change, atol=1e-12)
    assert (np.array(skel.x) == x).all()


def test_a_step_of_a_sledge() -> None:
    """Semi-implicit Euler in closed form; the world stays as it is."""
    dt, m = 0.01, 2.0
    world = World(dt, up="z")
    sledge = world.add_empty_skeleton("sledge").add_body("sledge", joint="prismatic", axis=[1.0, 0.0, 0.0])
    sledge.add_box([0.1, 0.1, 0.1], mass=m)
    world.step(3)
    before = world.snapshot()
    A, B = world.linearize()
    assert_allclose(A, [[1.0, dt], [0.0, 1.0]], atol=1e-9)
    assert_allclose(B, [[dt**2 / m], [dt / m]], atol=1e-9)
    assert world.snapshot() == before


def test_a_step_without_contacts() -> None:
    """A = d(q + dt dq', dq') of dq' = dq + dt ddq(q, dq, tau)."""
    world = World(0.001, up="z")
    arm = world.add_empty_skeleton("arm")
    parent = None
    for i in range(4):
        parent = arm.add_body(f"link{i}", parent, "revolute", axis=np.eye(3)[i % 3], position=[0.3, 0.0, 0.1])
        parent.add_box([0.3, 0.1, 0.1], mass=1.0)
    arm.q, arm.dq, arm.tau = np.random.default_rng(0).uniform(-1.0, 1.0, (3, 4))
    A, B = world.linearize()
    by, one, dt = arm.forward_dynamics_derivatives(arm.tau), np.eye(4), 0.001
    dq = np.hstack([dt * by.q, one + dt * by.dq])
    assert_allclose(A, np.vstack([np.hstack([one, 0.0 * one]) + dt * dq, dq]), atol=1e-7)
    assert_allclose(B, np.vstack([dt**2 * by.tau, dt * by.tau]), atol=1e-7)


def test_a_step_with_contacts() -> None:
    """A box that stands on the ground: pushed, it does not move; the rows are soft by a ten thousandth."""
    world = World(0.001, up="z")
    world.add_ground()
    world.add_box([0.2, 0.2, 0.2], 1.0, position=[0.0, 0.0, 0.1])
    world.step(100)
    A, B = world.linearize(1e-7)
    assert np.abs(A[6:, 6:]).max() < 1e-4 and np.abs(B[6:]).max() < 1e-5
