"""What joints do by themselves: springs, dampers, Coulomb friction, limits."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from .models import make_world, pendulum, slider

MASS, STIFFNESS = 2.0, 50.0
NONE = (0.0, 0.0, 0.0)


def damped(t: float, x0: float, damping: float) -> float:
    """x of m x'' + c x' + k x = 0 from x0 at rest, by the roots of m s² + c s + k."""
    roots = np.roots([MASS, damping, STIFFNESS]).astype(complex)
    weights = np.linalg.solve([[1, 1], roots], [x0, 0])
    return float((weights @ np.exp(roots * t)).real)


@pytest.mark.parametrize("damping", [0.0, 2.0, 15.0, 40.0])  # undamped, under- and overdamped (critical: 20)
@pytest.mark.parametrize("rest", [0.0, 0.3])
def test_spring_and_damper(tmp_path: Path, damping: float, rest: float) -> None:
    world = make_world(tmp_path, slider(MASS), gravity=NONE, dt=1e-4)
    skel, dof = world.skeletons[0], world.skeletons[0].dofs[0]
    dof.set_spring_stiffness(STIFFNESS)
    dof.set_rest_position(rest)
    dof.set_damping_coefficient(damping)
    skel.q = [rest + 0.5]
    for _ in range(4):
        world.step(2500)
        # The engine treats both implicitly: stable, with an error of first order in dt.
        assert skel.q[0] == pytest.approx(rest + damped(world.t, 0.5, damping), abs=3e-3)


def test_joint_setters_are_those_of_its_dofs(tmp_path: Path) -> None:
    """A torsion spring against gravity settles where k q = -m g l sin q."""
    world = make_world(tmp_path, pendulum(mass=1.0, length=0.5))
    joint = world.skeletons[0].joints[0]
    joint.set_spring_stiffness(0, 3.0)
    joint.set_rest_position(0, 1.0)
    joint.set_damping_coefficient(0, 2.0)
    world.step(10000)
    q = world.skeletons[0].q[0]
    assert 3.0 * (q - 1.0) == pytest.approx(-1.0 * 9.81 * 0.5 * np.sin(q), abs=1e-6)
    dof = joint.dofs[0]
    assert (dof.spring_stiffness(), dof.rest_position(), dof.damping_coefficient()) == (3.0, 1.0, 2.0)


def test_coulomb_friction_holds_and_brakes(tmp_path: Path) -> None:
    """Below F it holds; above, the rest accelerates; without a force it brakes by F / m."""
    world = make_world(tmp_path, slider(MASS), gravity=NONE)
    skel = world.skeletons[0]
    skel.dofs[0].set_coulomb_friction(4.0)
    for force, expected in ((3.0, 0.0), (10.0, (10.0 - 4.0) / MASS)):
        skel.q, skel.dq = [0], [0]
        for _ in range(500):
            skel.tau = [force]
            world.step()
        assert skel.dq[0] == pytest.approx(0.5 * expected, abs=1e-6)
    skel.dq = [1.0]
    world.step(250)
    assert skel.dq[0] == pytest.approx(1.0 - 0.25 * 4.0 / MASS, abs=1e-6)
    world.step(500)
    assert skel.dq[0] == pytest.approx(0, abs=1e-9)


def test_position_limits_act_once_enforced(tmp_path: Path) -> None:
    world = make_world(tmp_path, slider(MASS), gravity=(5.0, 0, 0))
    skel, joint = world.skeletons[0], world.skeletons[0].joints[0]
    joint.set_position_upper_limit(0, 0.2)
    assert joint.has_position_limit(0) and not joint.is_position_limit_enforced()
    world.step(500)
    assert skel.q[0] == pytest.approx(0.5 * 5.0 * 0.25, rel=0.01)

    world.reset()
    joint.set_position_limit_enforced(True)
    world.step(1000)
    assert skel.q[0] == pytest.approx(0.2, abs=2e-3)
    assert skel.dq[0] == pytest.approx(0, abs=1e-6)
    # The stop carries the weight.
    assert skel.constraint_forces()[0] == pytest.approx(-5.0 * MASS, rel=1e-3)


def test_velocity_limits(tmp_path: Path) -> None:
    world = make_world(tmp_path, slider(MASS), gravity=(5.0, 0, 0))
    skel = world.skeletons[0]
    skel.dofs[0].set_velocity_upper_limit(0.3)
    skel.joints[0].set_position_limit_enforced(True)
    world.step(500)
    assert skel.dq[0] == pytest.approx(0.3, abs=6e-3)


def test_reset_returns_to_the_initial_state(tmp_path: Path) -> None:
    world = make_world(tmp_path, pendulum())
    dof = world.skeletons[0].dofs[0]
    dof.set_initial_position(0.4)
    dof.set_initial_velocity(-0.2)
    world.step(10)
    world.reset()
    np.testing.assert_array_equal(world.x, [0.4, -0.2])
    assert world.t == 0
