"""What is set while a robot lies still acts in the next step, not only when it has moved."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

import pydart2
from pydart2 import Skeleton, World

MASS, DT, FORCE = 2.0, 0.01, 3.0
CHOICES = [
    (dynamics, integrator, solver)
    for dynamics, integrator in (("engine", "engine"), ("fast", "engine"), ("fast", "implicit"))
    for solver in ("fast", "iterative")
]


def at_rest(joint: str, dynamics: str, integrator: str, solver: str) -> tuple[World, Skeleton]:
    """A body on a body, on joints along or about x without friction, which have been still for three steps."""
    world = World(DT)
    world.gravity = [0.0, 0.0, 0.0]
    world.set_dynamics(dynamics)
    if dynamics == "fast":
        world.set_integrator(integrator)
    world.set_constraint_solver(solver)
    skel = world.add_empty_skeleton("pair")
    for name, parent in (("a", None), ("b", "a")):
        skel.add_body(name, parent, joint, axis=[1, 0, 0], mass=MASS, inertia=MASS * np.eye(3))
    world.step(3)
    return world, skel


def damp(skel: Skeleton) -> float:
    skel.dofs[0].set_damping_coefficient(50.0)
    return FORCE / (MASS + DT * 50.0)


def spring(skel: Skeleton) -> float:
    skel.dofs[0].set_spring_stiffness(5000.0)
    return FORCE / (MASS + DT**2 * 5000.0)


def spring_elsewhere(skel: Skeleton) -> float:
    skel.dofs[0].set_spring_stiffness(100.0)
    skel.dofs[0].set_rest_position(0.1)
    return (FORCE + 10.0) / (MASS + DT**2 * 100.0)


def friction(skel: Skeleton) -> float:
    skel.dofs[0].set_coulomb_friction(1.0)
    return (FORCE - 1.0) / MASS


def armature(skel: Skeleton) -> float:
    skel.dofs[0].set_armature(1.0)
    return FORCE / (MASS + 1.0)


def weigh(skel: Skeleton) -> float:
    skel.bodynodes[0].set_mass(5.0)
    skel.bodynodes[0].set_inertia(5.0 * np.eye(3))
    return FORCE / 5.0


def lock(skel: Skeleton) -> float:
    skel.joints[0].set_actuator_type(skel.joints[0].LOCKED)
    return 0.0


def lock_what_it_carries(skel: Skeleton) -> float:
    skel.joints[1].set_actuator_type(skel.joints[1].LOCKED)
    return FORCE / (2.0 * MASS)


@pytest.mark.parametrize("joint", ["prismatic", "revolute"])
@pytest.mark.parametrize("choice", CHOICES, ids="-".join)
@pytest.mark.parametrize(
    "deed", [damp, spring, spring_elsewhere, friction, armature, weigh, lock, lock_what_it_carries]
)
def test_closed_forms(deed: Callable[[Skeleton], float], choice: tuple[str, str, str], joint: str) -> None:
    world, skel = at_rest(joint, *choice)
    expected = deed(skel) * DT
    skel.tau = [FORCE, 0.0]
    world.step()
    other = 0.0 if deed is lock_what_it_carries else -expected  # it stays where it is in the world
    np.testing.assert_allclose(skel.dq, [expected, other], rtol=1e-9, atol=1e-12)


@pytest.mark.parametrize("choice", CHOICES, ids="-".join)
def test_a_joint_that_follows(choice: tuple[str, str, str]) -> None:
    """The engine's rule: after a step it is where the other was before it, times 2, and the offset (1e-9 of give)."""
    world, skel = at_rest("prismatic", *choice)
    skel.joints[0].set_mimic(skel.joints[1], 2.0, 0.001)
    for _ in range(3):
        expected = 2.0 * skel.q[1] + 0.001
        skel.tau = [0.0, FORCE]
        world.step()
        assert skel.q[0] == pytest.approx(expected, rel=1e-8)
    assert abs(skel.q[1]) > 1e-4


def soft_points(world: World) -> np.ndarray:
    body = world.skeleton("jelly").bodynodes[0]
    return np.concatenate([body.point_displacements().ravel(), body.point_velocities().ravel()])


DEEDS: dict[str, Callable[[World], object]] = {
    "damping": lambda w: w["pair"].dofs[1].set_damping_coefficient(3.0),
    "spring": lambda w: w["pair"].dofs[1].set_spring_stiffness(3000.0),
    "rest": lambda w: w["pair"].dofs[1].set_rest_position(0.1),
    "friction": lambda w: w["pair"].dofs[1].set_coulomb_friction(0.5),
    "armature": lambda w: w["pair"].dofs[1].set_armature(0.5),
    "locked": lambda w: w["pair"].joints[1].set_actuator_type(pydart2.Joint.LOCKED),
    "servo": lambda w: w["pair"].joints[1].set_actuator_type(pydart2.Joint.SERVO),
    "mimic": lambda w: w["pair"].joints[1].set_mimic(w["pair"].joints[0], -1.0, 0.1),
    "mass": lambda w: w["pair"].bodynodes[1].set_mass(9.0),
    "inertia": lambda w: w["pair"].bodynodes[1].set_inertia(np.diag([3.0, 4.0, 5.0])),
    "com": lambda w: w["pair"].bodynodes[1].set_local_com([0.1, 0.2, 0.3]),
    "axis": lambda w: w["pair"].joints[1].set_axis([0, 1, 0]),
    "joint's place": lambda w: w["pair"].joints[0].set_transform_from_child_body_node(moved()),
    "gravity": lambda w: setattr(w, "gravity", [0.3, -1.0, 0.2]),
    "time step": lambda w: w.set_time_step(0.003),
    "limits": lambda w: (w["pair"].dofs[1].set_position_lower_limit(0.0), w["pair"].set_position_limits_enforced()),
    "soft damping": lambda w: w["jelly"].bodynodes[0].set_damping_coefficient(9.0),
    "soft springs": lambda w: w["jelly"].bodynodes[0].set_vertex_stiffness(700.0),
    "soft edges": lambda w: w["jelly"].bodynodes[0].set_edge_stiffness(70.0),
    "soft mass": lambda w: w["jelly"].bodynodes[0].set_mass(3.0),
    "pressed": lambda w: w["jelly"].bodynodes[0].set_point_displacements(np.full((8, 3), 0.01)),
    "soft velocities": lambda w: w["jelly"].bodynodes[0].set_point_velocities(np.full((8, 3), 0.1)),
}


def moved() -> np.ndarray:
    T = np.eye(4)
    T[:3, 3] = [0.1, 0.2, 0.3]
    return T


@pytest.mark.parametrize("dynamics", ["engine", "fast"])
@pytest.mark.parametrize("deed", DEEDS)
def test_as_in_a_copy(deed: str, dynamics: str) -> None:
    """Whose numbers have never been computed."""
    world, pair = at_rest("revolute", dynamics, "engine", "fast")
    pair.bodynodes[1].set_local_com([0.0, 0.1, 0.0])
    pair.dofs[1].set_spring_stiffness(100.0)
    world.add_soft_box([0.2, 0.2, 0.2], 0.5, [3, 0, 0], cells=1, name="jelly")
    world.step(2)
    still = world.clone()
    copy = world.clone()
    DEEDS[deed](world)
    DEEDS[deed](copy)
    for each in (world, copy, still):
        each["pair"].tau = [FORCE, 1.0]
        each["jelly"].bodynodes[0].add_point_forces(np.full((8, 3), [1.0, 0.5, 0.0]))
        each.step(2)
    assert pair.q.tobytes() == copy["pair"].q.tobytes() and pair.dq.tobytes() == copy["pair"].dq.tobytes()
    assert soft_points(world).tobytes() == soft_points(copy).tobytes()
    assert not np.array_equal(world.x, still.x) or not np.array_equal(soft_points(world), soft_points(still))
