"""Friction that depends on the direction, slip and restitution of single shapes, against closed forms."""

from __future__ import annotations

import copy
import pickle
from collections.abc import Callable

import numpy as np
import pytest

from pydart2 import Skeleton, World
from pydart2.shapenode import ShapeNode, Surface

from .models import G

MASS = 2.0


def on_a_floor(solver: str) -> tuple[World, Skeleton, ShapeNode]:
    world = World(0.001, up="z")
    world.set_constraint_solver(solver, **({"tolerance": 1e-12, "iterations": 1000} if solver == "iterative" else {}))
    world.add_ground()
    box = world.add_box([0.4, 0.4, 0.1], MASS, position=[0.0, 0.0, 0.05])
    (node,) = (node for node in box.bodynodes[0].shapenodes if node.has_collision_aspect())
    return world, box, node


def pushed(world: World, box: Skeleton, force: list[float], steps: int) -> np.ndarray:
    """Velocity of the centre after a push below the ground's friction, m/s."""
    for _ in range(steps):
        box.bodynodes[0].add_ext_force(force, _offset=[0.0, 0.0, -0.05])
        world.step()
    return np.asarray(box.dC)


@pytest.mark.parametrize("solver", ["fast", "dart", "iterative"])
def test_friction_along_and_across(solver: str) -> None:
    """Free along x, held across it."""
    world, box, node = on_a_floor(solver)
    node.set_surface(friction=0.0, secondary_friction=0.8, friction_direction=[1.0, 0.0, 0.0])
    world.step(10)
    seconds = 0.2
    np.testing.assert_allclose(
        pushed(world, box, [4.0, 4.0, 0.0], round(seconds / world.dt)), [4.0 / MASS * seconds, 0.0, 0.0], atol=2e-3
    )


@pytest.mark.parametrize("solver", ["fast", "dart", "iterative"])
def test_the_direction_turns_with_the_shape(solver: str) -> None:
    world, box, node = on_a_floor(solver)
    node.set_surface(friction=0.0, secondary_friction=0.8, friction_direction=[1.0, 0.0, 0.0])
    box.q = [0.0, 0.0, np.pi / 2.0, 0.0, 0.0, 0.05]
    world.step(10)
    vx, vy, _ = pushed(world, box, [4.0, 4.0, 0.0], 200)
    assert vx == pytest.approx(0.0, abs=2e-3) and vy == pytest.approx(0.4, abs=2e-3)


@pytest.mark.parametrize("reduces", [False, True])
@pytest.mark.parametrize("solver", ["fast", "dart", "iterative"])
def test_slip_is_a_velocity_for_a_force(solver: str, reduces: bool) -> None:
    """The creep is slip * F; it is reached within m * slip = 0.1 s."""
    world, box, node = on_a_floor(solver)
    world.set_contact_reduction(reduces and solver != "dart")
    node.set_surface(slip=0.05)
    np.testing.assert_allclose(pushed(world, box, [2.0, 0.0, 0.0], 1500), [0.1, 0.0, 0.0], atol=1e-3)


def test_restitution_of_one_shape() -> None:
    """A drop of h bounces to e^2 h."""
    world, box, node = on_a_floor("fast")
    world.skeletons[0].bodynodes[0].set_restitution_coeff(1.0)
    node.set_surface(restitution=0.6)
    box.q = [0.0, 0.0, 0.0, 0.0, 0.0, 0.55]
    world.step(round(np.sqrt(2.0 * 0.5 / G) / world.dt) + 2)
    top = max(world.step() or box.C[2] for _ in range(400))
    assert top - 0.05 == pytest.approx(0.36 * 0.5, rel=0.03)


@pytest.mark.parametrize("copied", [copy.deepcopy, World.clone, lambda world: pickle.loads(pickle.dumps(world))])
def test_copies_have_them(copied: Callable[[World], World]) -> None:
    world, _, node = on_a_floor("fast")
    surface = Surface(0.2, 0.7, 0.01, 0.03, 0.4, (0.0, 1.0, 0.0))
    node.set_surface(
        friction=0.2,
        secondary_friction=0.7,
        slip=0.01,
        secondary_slip=0.03,
        restitution=0.4,
        friction_direction=[0.0, 1.0, 0.0],
    )
    other = copied(world)
    found = [node.surface() for node in other.skeletons[1].bodynodes[0].shapenodes if node.has_collision_aspect()]
    assert found == [surface] == [node.surface()]


def test_what_is_not_given_stays() -> None:
    _, _, node = on_a_floor("fast")
    assert node.surface() == Surface()
    node.set_surface(friction=0.3)
    node.set_surface(secondary_slip=0.1)
    assert node.surface() == Surface(0.3, 0.3, 0.0, 0.1)
    node.set_surface(friction_direction=[0.0, 0.0, 2.0])
    assert node.surface().friction_direction == (0.0, 0.0, 2.0)
    node.set_surface(friction_direction=[0.0, 0.0, 0.0])
    assert node.surface().friction_direction is None


def test_what_does_not_fit_is_refused() -> None:
    world, _, node = on_a_floor("fast")
    for wrong in ({"friction": -1.0}, {"secondary_slip": -0.1}, {"restitution": -0.1}, {"friction": float("nan")}):
        with pytest.raises(ValueError, match=next(iter(wrong))):
            node.set_surface(**wrong)
    with pytest.raises(ValueError, match="friction_direction"):
        node.set_surface(friction_direction=[np.nan, 0.0, 0.0])
    assert node.surface() == Surface()
    drawn = next(n for n in world.skeletons[1].bodynodes[0].shapenodes)
    if not drawn.has_collision_aspect():
        with pytest.raises(ValueError, match="takes no part in contacts"):
            drawn.surface()
