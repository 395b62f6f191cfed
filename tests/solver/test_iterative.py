"""The iterative contact solver: beside the exact one, closed forms, what stands, and what it remembers."""

from __future__ import annotations

import pickle
from collections.abc import Callable

import numpy as np
import pytest

import pydart2
from physics.models import standing_atlas

EXACT: dict[str, float | str] = {
    "iterations": 20000,
    "tolerance": 1e-11,
    "friction": "engine",
    "stabilisation": "engine",
}


def floor(height: float = 0.0, friction: float = 1.0, restitution: float = 0.0, dt: float = 0.002) -> pydart2.World:
    world = pydart2.World(dt)
    world.add_ground(height, friction=friction, restitution=restitution)
    world.set_collision_detector("native")
    return world


def stack(count: int) -> pydart2.World:
    world = floor()
    for i in range(count):
        world.add_box((0.2, 0.2, 0.2), 1.0, (0.0, 0.1 + 0.2 * i, 0.0), name=f"box{i}")
    return world


def stack_that_touches() -> pydart2.World:
    """Boxes that are in each other by rounding at least, which is when the exact solver sees a contact."""
    world = stack(10)
    world.step(5)
    return world


def cubes() -> pydart2.World:
    world = pydart2.World(0.001, pydart2.data_path("skel/cubes.skel"))
    world.step(200)
    return world


def atlas() -> pydart2.World:
    world = standing_atlas()
    world.step(50)
    return world


def fallen() -> pydart2.World:
    """A man on hands and feet."""
    world = pydart2.World(0.001, pydart2.data_path("skel/fullbody1.skel"))
    world.step(600)
    return world


def lopsided() -> pydart2.World:
    """Two turned boxes with their masses off their middles, hung on each other by a ball joint, on the floor."""
    world = floor()
    low = world.add_box((0.2, 0.2, 0.2), 1.0, (0.0, 0.0999, 0.0))
    high = world.add_box((0.1, 0.1, 0.1), 2.0, (0.05, 0.26, 0.02))
    for skeleton, com in ((low, (0.01, -0.02, 0.03)), (high, (-0.02, 0.01, 0.01))):
        skeleton.bodynodes[0].set_local_com(com)
    high.q = np.r_[0.3, -0.2, 0.5, high.q[3:]]
    pydart2.constraints.BallJointConstraint(high.bodynodes[0], low.bodynodes[0], [0.03, 0.2, 0.01]).add_to_world(world)
    world.step(20)
    return world


def loop(touches: bool = False) -> pydart2.World:
    """Three boxes in a row, jointed; the ends are tied by a ball joint that hangs on both, or are in each other."""
    world = floor()
    row = world.add_empty_skeleton("row")
    row.add_body("a", None, "free", position=(0.0, 0.0499, 0.0)).add_box((0.1, 0.1, 0.1))
    row.add_body("b", "a", "universal", position=(0.1, 0.0, 0.0), joint_position=(-0.05, 0.0, 0.0)).add_box(
        (0.1, 0.1, 0.1)
    )
    row.add_body("c", "b", "ball", position=(0.0, 0.0, 0.11), joint_position=(0.0, 0.0, -0.05)).add_box((0.3, 0.1, 0.1))
    if touches:
        row.set_self_collision_check(True)
        row.bodynodes[2].shapenodes[0].set_offset((0.0, 0.0, -0.02))
    else:
        a, c = row.bodynodes[0], row.bodynodes[2]
        pydart2.constraints.BallJointConstraint(c, a, [0.0, 0.06, 0.1]).add_to_world(world)
    world.step(3)
    return world


def touching_itself() -> pydart2.World:
    world = loop(touches=True)
    assert any(c.bodynode1.skeleton is c.bodynode2.skeleton for c in world.collision_result.contacts)
    return world


@pytest.mark.parametrize(
    "make",
    [cubes, fallen, atlas, stack_that_touches, lopsided, loop, touching_itself],
    ids=["cubes", "fullbody1", "Atlas", "stack", "lopsided", "loop", "touching itself"],
)
def test_step_is_that_of_the_exact_solver(make: Callable[[], pydart2.World]) -> None:
    ours, exact = make(), make()
    ours.set_constraint_solver("iterative", **EXACT)
    ours.set_contact_reduction(False)
    ours.step()
    exact.step()
    assert ours.solver_residual() < 1e-7
    for a, b in zip(ours.skeletons, exact.skeletons, strict=True):
        assert np.abs(a.dq - b.dq).max(initial=0.0) < 1e-6


def test_options() -> None:
    world = floor()
    assert world.constraint_solver_options() == {}
    world.set_constraint_solver("iterative", iterations=7, friction="cone")
    assert (world.constraint_solver(), world.warm_start(), world.contact_reduction()) == ("iterative", True, True)
    expected = {"iterations": 7, "tolerance": 3e-6, "friction": "cone", "stabilisation": "split"}
    assert expected.items() <= world.constraint_solver_options().items()
    assert pickle.loads(pickle.dumps(world)).constraint_solver_options() == world.constraint_solver_options()
    assert world.clone().constraint_solver_options() == world.constraint_solver_options()
    with pytest.raises(TypeError, match="has no option 'sweeps'; its options: iterations, tolerance"):
        world.set_constraint_solver("iterative", sweeps=3)
    with pytest.raises(TypeError, match="solver 'fast' has no option 'iterations'; its options: none"):
        world.set_constraint_solver("fast", iterations=3)
    with pytest.raises(ValueError, match="no friction 'cones' in pyramid, cone, engine; did you mean 'cone'"):
        world.set_constraint_solver("iterative", friction="cones")
    with pytest.raises(ValueError, match="'iterations' must be from 1"):
        world.set_constraint_solver("iterative", iterations=0)
    world.set_constraint_solver("fast")
    assert (world.warm_start(), world.contact_reduction(), world.constraint_solver_options()) == (False, False, {})


@pytest.mark.parametrize("friction", ["pyramid", "cone", "engine"])
def test_stopping_distance(friction: str) -> None:
    """A flat box that slides: v^2 / (2 mu g), and half a step of it."""
    mu, v, dt = 0.4, 2.0, 0.001
    world = floor(friction=mu, dt=dt)
    box = world.add_box((0.4, 0.02, 0.4), 1.0, (0.0, 0.0099, 0.0), friction=mu)
    world.set_constraint_solver("iterative", iterations=500, tolerance=1e-9, friction=friction)
    box.dq = np.r_[np.zeros(3), v, 0.0, 0.0]
    start = box.C
    world.step(700)
    assert abs(box.C[0] - start[0] - v**2 / (2.0 * mu * 9.81)) < 0.01 * v**2 / (2.0 * mu * 9.81)
    assert np.abs(box.dq).max() < 1e-6


@pytest.mark.parametrize(("friction", "reach"), [("pyramid", np.sqrt(2.0)), ("cone", 1.0)])
def test_friction_along_the_diagonal(friction: str, reach: float) -> None:
    mu, dt = 0.3, 0.001
    world = floor(friction=mu, dt=dt)
    box = world.add_box((0.4, 0.02, 0.4), 1.0, (0.0, 0.0099, 0.0), friction=mu)
    world.set_constraint_solver("iterative", iterations=500, tolerance=1e-10, friction=friction)
    box.dq = np.r_[np.zeros(3), 1.0, 0.0, 1.0]
    world.step()
    speed = np.hypot(box.dC[0], box.dC[2])
    assert abs((np.sqrt(2.0) - speed) / (mu * 9.81 * dt) - reach) < 0.01


def test_stack_stands() -> None:
    world = stack(10)
    world.set_constraint_solver("iterative")
    world.step(1000)
    tops = np.array([skeleton.C for skeleton in world.skeletons[1:]])
    world.step(1000)
    later = np.array([skeleton.C for skeleton in world.skeletons[1:]])
    assert np.abs(later - tops).max() < 1e-4
    assert np.abs(later[:, 1] - (0.1 + 0.2 * np.arange(10))).max() < 5e-3
    assert max(np.abs(skeleton.dq).max() for skeleton in world.skeletons[1:]) < 1e-3


def test_small_box_comes_to_rest_at_the_surface() -> None:
    """The engine's stabilisation leaves 4 % of a 1 cm box in the floor for seconds."""
    world = floor(dt=0.005)
    box = world.add_box((0.01, 0.01, 0.01), 0.001, (0.0, 0.05, 0.0))
    world.set_constraint_solver("iterative")
    world.step(400)
    assert abs(box.C[1] - 0.005) < 2e-4
    assert np.abs(box.dq).max() < 1e-3


def test_corrections_stay_out_of_velocities() -> None:
    world = floor()
    box = world.add_box((0.2, 0.2, 0.2), 1.0, (0.0, 0.08, 0.0))
    world.set_constraint_solver("iterative")
    for _ in range(100):
        world.step()
        assert abs(box.dC[1]) < 1e-6
    assert abs(box.C[1] - 0.1) < 2e-4


def test_corrections_of_a_tree_are_those_of_its_touching_part() -> None:
    """A ball at the end of a bent arm, 1 cm in the floor: a fifth of that goes in a step, at 0.1 m/s at most."""
    for speed, step in ((1.0, 0.2 * (0.01 - 1e-6)), (0.1, 0.1 * 0.002)):
        world = floor()
        world.set_gravity((0.0, 0.0, 0.0))
        arm = world.add_empty_skeleton("arm")
        arm.add_body("box", None, "free", position=(0.3, 0.3, 0.0)).add_box((0.1, 0.2, 0.1))
        arm.add_body("upper", "box", "ball", position=(-0.1, 0.0, 0.0), joint_position=(0.1, 0.0, 0.0)).add_box(
            (0.1, 0.1, 0.1)
        )
        arm.add_body(
            "ball", "upper", "universal", position=(0.0, -0.21, 0.0), joint_position=(0.0, 0.21, 0.0)
        ).add_sphere(0.1)
        ball = arm.bodynodes[2]
        assert ball.C[1] == pytest.approx(0.09)
        world.set_constraint_solver("iterative", correction_speed=speed)
        before = ball.C[1]
        world.step()
        assert ball.C[1] - before == pytest.approx(step, rel=0.02)
        assert np.abs(arm.dq).max() < 1e-6


def heap() -> pydart2.World:
    world = floor()
    rng = np.random.default_rng(3)
    for i in range(30):
        size = rng.uniform(0.05, 0.2, 3)
        place = (*(rng.uniform(-0.2, 0.2, 2)), 0.0)
        world.add_box(size, None, (place[0], 0.2 + 0.2 * i, place[1]))
    world.set_constraint_solver("iterative")
    world.step(300)
    return world


def test_heap_goes_on_bit_for_bit() -> None:
    """What is remembered is in snapshots, clones and pickles; reset() forgets it."""
    world = heap()
    snapshot = world.snapshot()
    others = [world.clone(), pickle.loads(pickle.dumps(world))]
    world.step(100)
    expected = world.x.tobytes()
    for other in others:
        other.step(100)
        assert other.x.tobytes() == expected
    world.restore(snapshot)
    world.step(100)
    assert world.x.tobytes() == expected
    assert min(skeleton.C[1] for skeleton in world.skeletons[1:]) > 0.0


def test_soft_bodies_go_the_engines_way() -> None:
    worlds = [pydart2.World(0.001, pydart2.data_path("skel/softBodies.skel")) for _ in range(2)]
    worlds[0].set_constraint_solver("iterative")
    worlds[0].set_contact_reduction(False)
    worlds[0].set_warm_start(False)
    for world in worlds:
        world.step(100)
        assert np.isfinite(world.x).all()


@pytest.mark.parametrize("detector", ["fcl", "bullet", "ode", "dart", "native"])
def test_a_stack_stands_with_every_detector(detector: str) -> None:
    """FCL's triangles report boxes that stand on each other 20 cm inside each other's sides, too."""
    world = stack(5)
    world.set_collision_detector(detector)
    world.set_constraint_solver("iterative")
    world.step(500)
    tops = np.array([skel.C for skel in world.skeletons[1:]])
    np.testing.assert_allclose(tops[:, 1], 0.1 + 0.2 * np.arange(5), atol=2e-3)
    np.testing.assert_allclose(tops[:, [0, 2]], 0.0, atol=5e-3)


@pytest.mark.parametrize("solver", ["fast", "dart"])
def test_residual_of_the_exact_solvers(solver: str) -> None:
    """Nothing is left where all sticks; friction bounds frozen from the normals alone show where something slides."""
    world = stack(5)
    world.set_constraint_solver(solver)
    world.step(50)
    assert len(world.contacts) > 0.0
    assert world.solver_residual() < 1e-9
    tall = floor(friction=0.3)
    box = tall.add_box((0.1, 0.3, 0.1), 1.0, (0.0, 0.1499, 0.0), friction=0.3)
    tall.set_constraint_solver(solver)
    box.dq = np.r_[np.zeros(3), 1.0, 0.0, 0.0]
    tall.step()
    assert tall.solver_residual() > 1e-3


@pytest.mark.parametrize("friction", ["pyramid", "cone", "engine"])
def test_a_light_ball_below_a_ton(friction: str) -> None:
    """Masses that are ten thousand apart: the heavy one falls on the other, which then rolls below it."""
    world = floor()
    world.set_collision_detector("native")
    world.set_constraint_solver("iterative", friction=friction)
    ball = world.add_sphere(0.05, 0.1, (0.0, 0.05, 0.0))
    heavy = world.add_box((0.4, 0.4, 0.4), 1000.0, (0.0, 0.3001, 0.0))
    heavy.dq = [0.0, 0.0, 0.0, 2.0, -1.0, 0.5]
    for _ in range(20):
        world.step()
        assert world.solver_residual() <= 1e-2
        assert ball.C[1] > 0.05 - 1e-3


def test_residual_of_a_cone_where_it_slides() -> None:
    """Slip is against friction along any direction, also where a tangent moves more easily than the other."""
    world = floor(friction=0.3)
    world.set_collision_detector("native")
    world.set_constraint_solver("iterative", friction="cone", tolerance=1e-10, iterations=1000)
    rod = world.add_box((1.0, 0.1, 0.1), 1.0, (0.0, 0.05, 0.0), friction=0.3)
    rod.dq = [0.0, 2.0, 0.0, 1.0, 0.0, 0.7]
    for _ in range(20):
        world.step()
        assert np.linalg.norm(rod.dC) > 0.5
        assert world.solver_residual() < 1e-7


def test_threads_do_not_change_results() -> None:
    """Groups are solved by several threads, in a batch by one."""
    worlds = []
    for threads in (1, 3):
        world = floor()
        for i in range(12):
            for j in range(3):
                world.add_box((0.2, 0.2, 0.2), 1.0, (0.5 * i, 0.12 + 0.21 * j, 0.02 * j))
        world.set_constraint_solver("iterative", threads=threads)
        worlds.append(world)
    assert worlds[1].clone().constraint_solver_options()["threads"] == 3
    assert pickle.loads(pickle.dumps(worlds[1])).constraint_solver_options()["threads"] == 3
    batch = pydart2.Batch(worlds[1], 2)
    for world in worlds:
        world.step(100)
    batch.step(100)
    for world in (*worlds[1:], *batch.worlds):
        assert world.x.tobytes() == worlds[0].x.tobytes()
    with pytest.raises(ValueError, match="'threads' must be from 1"):
        worlds[0].set_constraint_solver("iterative", threads=0)


def test_gaps() -> None:
    """A body that comes near touches the surface at the end of the step; while it is apart there is no contact."""
    world = floor(dt=0.001)
    box = world.add_box((0.2, 0.2, 0.2), 1.0, (0.0, 0.1003, 0.0))
    world.set_constraint_solver("iterative")
    world.step()
    assert len(world.contacts) == 0
    box.dq = np.r_[np.zeros(4), -0.4, 0.0]
    world.step()
    assert len(world.contacts) == 4
    assert abs(box.C[1] - 0.1) < 1e-7
    bouncing = floor(dt=0.001, restitution=1.0)
    ball = bouncing.add_sphere(0.1, 1.0, (0.0, 0.1003, 0.0), restitution=1.0)
    bouncing.set_constraint_solver("iterative")
    ball.dq = np.r_[np.zeros(4), -0.4, 0.0]
    bouncing.step(2)
    assert ball.dq[4] > 0.39


def free_body(dynamics: str) -> pydart2.World:
    """A lopsided body that turns, pushed on the way, and one with a joint that a table has no closed form for."""
    world = pydart2.World(0.002, up="y")
    world.set_constraint_solver("iterative")
    world.set_dynamics(dynamics)
    for i in range(2):
        body = world.add_box((0.1, 0.2, 0.3), 2.0, (1.0 * i, 3.0, 0.0))
        body.bodynodes[0].set_local_com((0.01, 0.02, -0.03))
        body.dq = [3.0, -2.0, 5.0, 1.0, 2.0, -1.0]
    for dof in world.skeletons[1].dofs:
        dof.set_damping_coefficient(0.1)
    return world


def test_free_bodies_move_as_by_the_engines_rule() -> None:
    """To rounding: forces, commands, gravity switched off, changes of mass in between, accelerations too."""
    ours, engine = free_body("fast"), free_body("engine")
    for world in (ours, engine):
        for body in world.skeletons:
            part = body.bodynodes[0]
            for step in range(100):
                if step % 7 == 0:
                    part.add_ext_force([1.0, 2.0, -3.0], [0.1, 0.0, 0.2])
                if step % 5 == 0:
                    body.set_forces([0.1, -0.2, 0.3, 1.0, 2.0, 3.0])
                if step == 40:
                    part.set_gravity_mode(False)
                if step == 60:
                    part.set_mass(5.0)
                world.step()
    np.testing.assert_allclose(ours.x, engine.x, atol=1e-10)
    for a, b in zip(ours.skeletons, engine.skeletons, strict=True):
        np.testing.assert_allclose(a.ddq, b.ddq, atol=1e-7)
        np.testing.assert_allclose(a.bodynodes[0].T, b.bodynodes[0].T, atol=1e-10)
        np.testing.assert_allclose(
            a.bodynodes[0].com_linear_acceleration(), b.bodynodes[0].com_linear_acceleration(), atol=1e-7
        )
