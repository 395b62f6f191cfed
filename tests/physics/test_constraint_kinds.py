"""Welds, revolute closures, forces, targets and switches of constraints."""

from __future__ import annotations

import copy
import pickle

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.spatial.transform import Rotation

from pydart2 import DestroyedError, Skeleton, World
from pydart2.constraints import BallJointConstraint, DistanceConstraint, RevoluteJointConstraint, WeldJointConstraint

G = 9.81


def hung(solver: str = "fast") -> tuple[World, BallJointConstraint]:
    """A ball of 2 kg that hangs from a point above its centre."""
    world = World(0.001, up="z")
    world.set_constraint_solver(solver)
    ball = world.add_sphere(0.1, 2.0, position=[0.0, 0.0, 1.0]).bodynodes[0]
    hook = BallJointConstraint(ball, None, [0.0, 0.0, 1.3])
    hook.add_to_world(world)
    return world, hook


@pytest.mark.parametrize("solver", ["dart", "fast", "iterative"])
def test_the_force_of_a_hook_is_the_weight(solver: str) -> None:
    world, hook = hung(solver)
    world.step(200)
    assert_allclose(hook.force(), [0.0, 0.0, 2.0 * G], atol=1e-3)
    assert_allclose(hook.moment(), 0.0, atol=1e-3)


@pytest.mark.parametrize("solver", ["dart", "fast", "iterative"])
def test_the_moment_of_a_weld_holds_a_bracket(solver: str) -> None:
    """A box that is held at its centre and pushed at its end; a force between two bodies is the other's opposite."""
    world = World(0.001, up="z")
    world.set_constraint_solver(solver)
    wall = world.add_box([0.1, 0.1, 0.1], 1.0, position=[0.0, 0.0, 1.0], fixed=True).bodynodes[0]
    bracket = world.add_box([0.4, 0.1, 0.1], 3.0, position=[0.3, 0.0, 1.0]).bodynodes[0]
    weld, same = WeldJointConstraint(bracket, wall), WeldJointConstraint(wall, bracket)
    weld.add_to_world(world)
    for _ in range(300):
        bracket.add_ext_force([0.0, 0.0, -5.0], [0.2, 0.0, 0.0])
        world.step()
    assert_allclose(weld.force(), [0.0, 0.0, 3.0 * G + 5.0], atol=0.02)
    assert_allclose(weld.moment(), [0.0, -1.0, 0.0], atol=0.01)
    weld.remove()
    same.add_to_world(world)
    for _ in range(300):
        bracket.add_ext_force([0.0, 0.0, -5.0], [0.2, 0.0, 0.0])
        world.step()
    assert_allclose(same.force(), [0.0, 0.0, -3.0 * G - 5.0], atol=0.02)


def test_what_is_held_apart_does_not_jump() -> None:
    world = World(0.001, up="z")
    world.set_gravity([0.0, 0.0, 0.0])
    one = world.add_box([0.1, 0.1, 0.1], 1.0, position=[0.0, 0.0, 1.0]).bodynodes[0]
    two = world.add_box([0.1, 0.1, 0.1], 1.0, position=[3.0, 0.0, 1.0]).bodynodes[0]
    two.skel.q = [0.4, 0.3, 0.2, *two.skel.q[3:]]
    before = one.T, two.T
    WeldJointConstraint(one, two).add_to_world(world)
    RevoluteJointConstraint(one, two, [1.0, 1.0, 1.0], [1.0, 2.0, 3.0]).add_to_world(world)
    world.step(50)
    assert_allclose([one.T, two.T], before, atol=1e-9)


def test_a_hinge_turns_about_its_axis_alone() -> None:
    """A door on a hinge beside it: the pendulum's period for small swings, and nothing across."""
    world = World(0.0005, up="z")
    plate = world.add_box([0.4, 0.02, 0.2], 2.0, position=[0.0, 0.0, 1.0]).bodynodes[0]
    RevoluteJointConstraint(plate, None, [0.0, 0.0, 1.2], [0.0, 5.0, 0.0]).add_to_world(world)
    plate.skel.dq = [0.0, 0.0, 0.0, 0.0, 0.0, 0.0]
    plate.skel.dq = [0.0, 0.1, 0.0, -0.02, 0.0, 0.0]
    inertia = 2.0 * (0.4**2 + 0.2**2) / 12.0 + 2.0 * 0.2**2
    period = 2.0 * np.pi * np.sqrt(inertia / (2.0 * G * 0.2))
    angles = []
    for _ in range(int(3.0 * period / world.dt)):
        world.step()
        angles.append(Rotation.from_matrix(plate.T[:3, :3]).as_rotvec())
    turns = np.array(angles)
    assert np.abs(turns[:, [0, 2]]).max() < 1e-4
    crossings = np.flatnonzero((turns[1:, 1] > 0.0) & (turns[:-1, 1] <= 0.0))
    assert_allclose(np.diff(crossings).mean() * world.dt, period, rtol=5e-3)


def test_a_target_is_followed() -> None:
    world, hook = hung()
    world.constraint_error_reduction = 0.2
    world.step(100)
    for i in range(1000):
        hook.set_target([0.0005 * i, 0.0, 1.3])
        world.step()
    held = hook.body1.to_world([0.0, 0.0, 0.3])
    assert_allclose(held, [0.5, 0.0, 1.3], atol=0.01)
    weld = WeldJointConstraint(hook.body1)
    hook.remove()
    weld.add_to_world(world)
    pose = np.array(hook.body1.T)
    pose[2, 3] += 0.005
    weld.set_target(pose)
    world.step(100)
    assert_allclose(hook.body1.T, pose, atol=1e-4)
    with pytest.raises(ValueError, match="target of a constraint"):
        weld.set_target(2.0 * pose)
    with pytest.raises(ValueError, match="no world"):
        hook.set_target([0.0, 0.0, 0.0])


def test_switched_off_it_holds_nothing() -> None:
    world, hook = hung()
    world.step(100)
    hook.enabled = False
    height = hook.body1.C[2]
    world.step(100)
    assert_allclose(hook.body1.C[2] - height, -G * 0.1**2 / 2.0, rtol=0.02)
    assert world.constraints == [hook] and not hook.enabled and (hook.force() == 0.0).all()
    clone = world.clone()
    hook.enabled = True
    for item in (world, clone):
        item.step(50)
    assert world.skeletons[0].dq[5] > clone.skeletons[0].dq[5] + 0.1
    assert hook.force()[2] > 0.0


def test_copies_have_them_all() -> None:
    world, hook = hung()
    other = world.add_box([0.1, 0.1, 0.1], 1.0, position=[1.0, 0.0, 1.0]).bodynodes[0]
    RevoluteJointConstraint(other, hook.body1, [0.9, 0.0, 1.0], [0.0, 1.0, 1.0]).add_to_world(world)
    hook.set_target([0.0, 0.01, 1.3])
    world.step(20)
    for copied in (world.clone(), pickle.loads(pickle.dumps(world)), copy.deepcopy(world)):
        assert [repr(c) for c in copied.constraints] == [repr(c) for c in world.constraints]
        mirror = world.clone()
        for item in (copied, mirror):
            item.step(100)
        assert copied.x.tobytes() == mirror.x.tobytes()
        closure = copied.constraints[1]
        assert isinstance(closure, RevoluteJointConstraint)
        assert_allclose(closure.axis, np.array([0.0, 1.0, 1.0]) / np.sqrt(2.0), atol=1e-15)


def test_one_that_is_gone_does_not_speak_for_another() -> None:
    world, hook = hung()
    world.remove_all_constraints()
    other = WeldJointConstraint(hook.body1)
    other.add_to_world(world)
    assert not hook.is_active() and other.is_active()
    with pytest.raises(DestroyedError, match="removed"):
        hook.force()
    with pytest.raises(ValueError, match="in no world"):
        hook.remove()
    assert world.constraints == [other]


def test_what_is_set_too_late_is_refused() -> None:
    world, hook = hung()
    with pytest.raises(ValueError, match="set_target"):
        hook.jointPos = [0.0, 0.0, 0.0]
    with pytest.raises(AttributeError):
        hook.body1 = hook.body1  # type: ignore[misc]
    with pytest.raises(ValueError, match="shape"):
        BallJointConstraint(hook.body1, None, [0.0, 0.0])
    box = world.add_box([0.1, 0.1, 0.1], 1.0, position=[1.0, 0.0, 1.0]).bodynodes[0]
    weld = WeldJointConstraint(box, hook.body1)
    weld.add_to_world(world)
    with pytest.raises(ValueError, match="between a body and the world"):
        weld.set_target(np.eye(4))


def four_bar(solver: str) -> tuple[World, Skeleton, RevoluteJointConstraint]:
    """A crank, a coupler and a rocker, in a plane, which a hinge closes: five of its rows, of six, say the same."""
    world = World(0.001, up="z")
    world.set_constraint_solver(solver)
    bars = world.add_empty_skeleton("four-bar")
    parent = None
    for name, at, length in (
        ("crank", [0.0, 0.0, 1.0], 0.3),
        ("coupler", [0.3, 0.0, 0.0], 0.8),
        ("rocker", [0.8, 0.0, 0.0], 0.5),
    ):
        parent = bars.add_body(
            name, parent, "revolute", axis=[0.0, 1.0, 0.0], position=at, mass=length, com=[length / 2.0, 0.0, 0.0],
            inertia=np.diag([1e-4, length**3 / 12.0, length**3 / 12.0]),
        )  # fmt: skip
    base = np.array([0.7, 0.0, 1.0])
    # The crank points up; the circles about its tip and the base meet where the coupler and the rocker do.
    tip = np.array([0.0, 0.0, 1.3])
    way = base - tip
    distance = np.linalg.norm(way)
    along = (0.8**2 - 0.5**2 + distance**2) / (2.0 * distance)
    across = np.array([-way[2], 0.0, way[0]]) / distance * np.sqrt(0.8**2 - along**2)
    joint = tip + way / distance * along + across
    angles = [-np.arctan2(v[2], v[0]) for v in (tip - [0.0, 0.0, 1.0], joint - tip, base - joint)]
    bars.q = np.diff([0.0, *angles])
    rocker = bars.body("rocker")
    assert_allclose(rocker.to_world([0.5, 0.0, 0.0]), base, atol=1e-12)
    hinge = RevoluteJointConstraint(rocker, None, base, [0.0, 1.0, 0.0])
    hinge.add_to_world(world)
    return world, bars, hinge


@pytest.mark.parametrize("solver", ["dart", "fast", "iterative"])
def test_a_four_bar_stays_closed(solver: str) -> None:
    """To a tenth of a millimetre while it falls and swings, and never with more energy than it began with."""
    world, bars, hinge = four_bar(solver)
    world.constraint_error_reduction = 0.5
    begin = bars.kinetic_energy() + bars.potential_energy()
    fastest = 0.0
    for _ in range(2000):
        world.step()
        fastest = max(fastest, np.abs(bars.dq).max())
        assert np.linalg.norm(bars.body("rocker").to_world([0.5, 0.0, 0.0]) - hinge.point) < 1e-4
        assert bars.kinetic_energy() + bars.potential_energy() < 1.001 * begin
    assert fastest > 5.0


def test_a_four_bar_keeps_its_energy() -> None:
    """By rk4 it stays closed to rounding and keeps its energy, of which up to 4 J are of motion."""
    world, bars, hinge = four_bar("fast")
    world.set_integrator("rk4")
    begin = bars.kinetic_energy() + bars.potential_energy()
    for _ in range(30):
        world.step(100)
        assert np.linalg.norm(bars.body("rocker").to_world([0.5, 0.0, 0.0]) - hinge.point) < 1e-12
        assert abs(bars.kinetic_energy() + bars.potential_energy() - begin) < 1e-6
    assert bars.integrator_fallbacks == 0


@pytest.mark.parametrize("solver", ["dart", "fast", "iterative"])
def test_a_weld_to_a_moving_hand(solver: str) -> None:
    """5 kg in the hand of an arm that swings under its own weight."""
    world = World(0.001, up="z")
    world.set_constraint_solver(solver)
    arm = world.add_empty_skeleton("arm")
    parent = None
    for i in range(3):
        parent = arm.add_body(
            f"link{i}", parent, "revolute", axis=[0.0, 1.0, 0.0], position=[0.4 if i else 0.0, 0.0, 0.0 if i else 2.0]
        )
        parent.add_box([0.4, 0.05, 0.05], mass=4.0, position=[0.2, 0.0, 0.0])
    load = world.add_box([0.1, 0.1, 0.1], 5.0, position=[1.25, 0.0, 2.0]).bodynodes[0]
    assert parent is not None
    WeldJointConstraint(load, parent).add_to_world(world)
    before = load.relative_pose(parent)
    for _ in range(100):
        arm.set_targets(np.sin(world.t * 3.0) * np.ones(3), kp=2000.0, kd=200.0)
        world.step(20)
        now = load.relative_pose(parent)
        assert np.linalg.norm(now[:3, 3] - before[:3, 3]) < 5e-4
        assert Rotation.from_matrix(now[:3, :3] @ before[:3, :3].T).magnitude() < np.radians(0.1)


def test_a_planar_body_rests_under_the_iterative_solver() -> None:
    """Forces across its plane move nothing: the others carry it all the same."""
    world = World(0.001, up="z")
    world.set_constraint_solver("iterative")
    world.add_ground()
    box = world.add_empty_skeleton("box")
    body = box.add_body(
        "box",
        joint="planar",
        position=[0.0, 0.0, 0.12],
        joint_orientation=Rotation.from_euler("x", 90, degrees=True).as_matrix(),
    )
    body.add_box([0.2, 0.2, 0.2], mass=1.0)
    world.step(1000)
    assert_allclose(body.C, [0.0, 0.0, 0.1], atol=2e-3)
    assert_allclose(body.contact_force(), [0.0, 0.0, G], atol=0.01)


def test_a_share_is_a_share() -> None:
    world = World(0.001)
    assert world.constraint_error_reduction == 0.2
    assert World(0.001, engine_defaults=True).constraint_error_reduction == 0.01
    world.constraint_error_reduction = 0.3
    assert world.clone().constraint_error_reduction == 0.3
    with pytest.raises(ValueError, match="from 0 to 1"):
        world.constraint_error_reduction = 1.5


SOLVERS = ["dart", "fast", "iterative"]


def pendulum(
    solver: str, *, rope: bool = False, length: float | None = None
) -> tuple[World, Skeleton, DistanceConstraint]:
    """A ball of 2 kg, 1 m beside the point by which it hangs."""
    world = World(0.001, up="z")
    world.set_constraint_solver(solver)
    world.constraint_error_reduction = 0.2
    ball = world.add_sphere(0.1, 2.0, position=[1.0, 0.0, 2.0])
    rod = DistanceConstraint(ball.bodynodes[0], None, [1.0, 0.0, 2.0], [0.0, 0.0, 2.0], length, rope=rope)
    rod.add_to_world(world)
    return world, ball, rod


@pytest.mark.parametrize("solver", SOLVERS)
def test_a_rod_is_a_pendulum(solver: str) -> None:
    """From the horizontal it is at the bottom with v² = 2 g l, and the rod then carries 3 m g."""
    world, ball, rod = pendulum(solver)
    while ball.C[0] > 0.0 and world.t < 2.0:
        world.step()
    assert np.linalg.norm(ball.dC) == pytest.approx(np.sqrt(2.0 * G), rel=2e-3)
    assert_allclose(rod.force(), [0.0, 0.0, 3.0 * 2.0 * G], rtol=0.01, atol=0.3)  # it turns by 4.4 mrad a step
    assert np.linalg.norm(ball.C - [0.0, 0.0, 2.0]) == pytest.approx(1.0, abs=2e-3)


@pytest.mark.parametrize("solver", SOLVERS)
def test_a_rope_falls_until_it_is_taut(solver: str) -> None:
    world, ball, rope = pendulum(solver, rope=True, length=1.5)
    world.step(300)
    assert ball.C[2] == pytest.approx(2.0 - 0.5 * G * 0.3 * 0.301, abs=1e-9)
    assert_allclose(rope.force(), 0.0, atol=1e-12)
    worst = 0.0
    for _ in range(1500):
        world.step()
        worst = max(worst, float(np.linalg.norm(ball.C - [0.0, 0.0, 2.0])))
    assert worst < 1.5 + 3e-3
    assert worst > 1.5 - 1e-3


@pytest.mark.parametrize("solver", SOLVERS)
def test_a_rod_between_two_free_bodies(solver: str) -> None:
    """It pushes and pulls along itself alone: momentum stays, and points off the centres turn the bodies."""
    world = World(0.001, up="z")
    world.set_gravity([0.0, 0.0, 0.0])
    world.set_constraint_solver(solver)
    one, other = (world.add_sphere(0.1, m, position=[x, 0.0, 1.0]) for m, x in ((1.0, 0.0), (3.0, 1.0)))
    rod = DistanceConstraint(one.bodynodes[0], other.bodynodes[0], [0.1, 0.0, 1.0], [0.9, 0.0, 1.05])
    rod.add_to_world(world)
    one.dq = [0.0, 0.0, 0.0, 1.0, 2.0, 0.0]
    world.step(500)
    assert_allclose(one.dC + 3.0 * other.dC, [1.0, 2.0, 0.0], atol=1e-4)
    points = one.bodynodes[0].to_world([0.1, 0.0, 0.0]) - other.bodynodes[0].to_world([-0.1, 0.0, 0.05])
    assert np.linalg.norm(points) == pytest.approx(rod.length, abs=2e-3)
    assert np.linalg.norm(other.dq[:3]) > 0.1


@pytest.mark.parametrize("solver", SOLVERS)
def test_distances_in_copies(solver: str) -> None:
    world, _, rod = pendulum(solver, rope=True, length=1.2)
    rod.set_target([0.0, 0.1, 2.0])
    world.step(400)
    copies = [world.clone(), pickle.loads(pickle.dumps(world)), copy.deepcopy(world)]
    for twin in [world, *copies]:
        twin.step(300)
    for twin in copies:
        assert twin.skeletons[0].q.tobytes() == world.skeletons[0].q.tobytes()
        (kept,) = twin.constraints
        assert isinstance(kept, DistanceConstraint)
        assert (kept.length, kept.rope) == (1.2, True)
        assert_allclose(kept.points, [[1.0, 0.0, 2.0], [0.0, 0.0, 2.0]])


def test_a_crane() -> None:
    """The end that is fixed in the world is moved, and the load follows; without the rope it falls."""
    world, ball, rope = pendulum("fast", rope=True)
    ball.bodynodes[0].parent_joint.set_damping_coefficient(3, 5.0)
    rope.set_target([1.0, 0.0, 3.5])
    world.step(3000)
    assert ball.C[2] == pytest.approx(2.5, abs=0.02)
    rope.enabled = False
    world.step(100)
    assert ball.dC[2] < -0.5


@pytest.mark.parametrize("length", [0.0, -1.0, np.inf, np.nan])
def test_a_distance_that_is_none(length: float) -> None:
    world = World(0.001)
    body = world.add_sphere(0.1, 1.0).bodynodes[0]
    with pytest.raises(ValueError, match="> 0 m"):
        DistanceConstraint(body, None, [0.0, 0.0, 0.0], [1.0, 0.0, 0.0], length)
