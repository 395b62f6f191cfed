"""Groups that lie still take no part in steps, and wake when something concerns them."""

from __future__ import annotations

import pickle
from collections.abc import Callable

import numpy as np
import pytest

import pydart2
from pydart2 import Joint, World
from pydart2.constraints import WeldJointConstraint

DETECTORS = ("native", "fcl", "bullet", "ode", "dart")


def pile(detector: str = "native", solver: str = "iterative", fixed_ground: bool = True) -> World:
    """Three boxes on each other, one beside them, on a ground; boxes are skeletons 1 to 4."""
    world = World(0.002, up="z")
    world.set_collision_detector(detector)
    world.set_constraint_solver(solver)
    ground = world.add_box([10.0, 10.0, 1.0], None, [0.0, 0.0, -0.5], fixed=fixed_ground, name="ground")
    if not fixed_ground:
        ground.set_mobile(False)
    for i in range(3):
        world.add_box([0.2, 0.2, 0.2], 1.0, [0.0, 0.0, 0.1 + 0.2 * i])
    world.add_box([0.2, 0.2, 0.2], 1.0, [1.0, 0.0, 0.1])
    world.set_sleeping()
    return world


def asleep(world: World) -> list[int]:
    return [i for i, skel in enumerate(world.skeletons) if skel.is_asleep()]


def sleeping_pile(detector: str = "native", solver: str = "iterative", fixed_ground: bool = True) -> World:
    world = pile(detector, solver, fixed_ground)
    world.step(600)
    assert asleep(world) == [1, 2, 3, 4]
    return world


def test_off_by_default() -> None:
    world = pile()
    world.set_sleeping(False)
    world.step(600)
    assert asleep(world) == [] and world.sleeping_options() == {}
    assert World(0.001).sleeping_options() == {}


@pytest.mark.parametrize("fixed_ground", [True, False], ids=["weld", "immobile"])
@pytest.mark.parametrize("detector", DETECTORS)
@pytest.mark.parametrize("solver", ["iterative", "fast", "dart"])
def test_pile_sleeps_and_stays(detector: str, solver: str, fixed_ground: bool) -> None:
    world = pile(detector, solver, fixed_ground)
    world.step(240)
    assert asleep(world) == []  # they have lain still for less than 0.5 s
    world.step(360)
    assert asleep(world) == [1, 2, 3, 4]
    assert world.sleepers() == world.skeletons[1:]
    before, contacts = world.x, world.collision_result.contacts
    world.step(500)
    assert world.x.tobytes() == before.tobytes()
    assert not np.any([skel.dq for skel in world.skeletons[1:]]) and not np.any(
        [skel.ddq for skel in world.skeletons[1:]]
    )
    assert [skel.is_mobile() for skel in world.skeletons[1:]] == [True] * 4
    after = world.collision_result.contacts
    assert len(after) == len(contacts) > 0
    ground = world.skeletons[0].bodynodes[0]
    carried = sum(
        (c.force if c.bodynode1 == ground else -c.force)[2] for c in after if ground in (c.bodynode1, c.bodynode2)
    )
    assert carried == pytest.approx(-4 * 9.81, rel=2e-3)


@pytest.mark.parametrize("detector", DETECTORS)
@pytest.mark.parametrize("solver", ["iterative", "fast", "dart"])
def test_contact_wakes_what_it_reaches(detector: str, solver: str) -> None:
    """A box that falls on the pile takes part with it in the very step in which they touch."""
    world = sleeping_pile(detector, solver)
    twin = world.clone()
    twin.set_sleeping(False)
    for w in (world, twin):
        w.add_box([0.2, 0.2, 0.2], 1.0, [0.0, 0.0, 0.75])
    world.step(30)
    assert asleep(world) == [1, 2, 3, 4]
    while asleep(world) != [4]:
        world.step()
        assert world.t < 2.0
    twin.step(world.frame - twin.frame)
    falling, same = world.skeletons[5], twin.skeletons[5]
    assert abs(falling.dq[5]) < 0.2  # it was stopped
    assert falling.dq[5] == pytest.approx(same.dq[5], abs=0.1)
    world.step(800)
    assert asleep(world) == [1, 2, 3, 4, 5]
    assert [skel.C[2] for skel in world.skeletons[1:4]] == pytest.approx([0.1, 0.3, 0.5], abs=2e-3)


CHANGES: dict[str, tuple[Callable[[World], object], list[int]]] = {
    "position": (lambda w: w.skeletons[2].set_positions(w.skeletons[2].q), [4]),
    "velocity": (lambda w: w.skeletons[2].set_velocities(np.full(6, 0.1)), [4]),
    "dof": (lambda w: w.skeletons[4].dofs[5].set_position(0.3), [1, 2, 3]),
    "force": (lambda w: w.skeletons[1].set_forces([0, 0, 0, 0, 0, 1.0]), [4]),
    "command of a dof": (lambda w: w.skeletons[1].dofs[5].set_command(1.0), [4]),
    "external force": (lambda w: w.skeletons[3].bodynodes[0].add_ext_force([0, 0, 1.0]), [4]),
    "mass": (lambda w: w.skeletons[3].bodynodes[0].set_mass(2.0), [4]),
    "friction": (lambda w: w.skeletons[1].bodynodes[0].set_friction_coeff(0.0), [4]),
    "shape": (lambda w: w.skeletons[1].bodynodes[0].shapenodes[0].shape.set_size([0.1, 0.1, 0.1]), [4]),
    "shape's place": (lambda w: w.skeletons[1].bodynodes[0].shapenodes[0].set_offset([0.1, 0, 0]), [4]),
    "actuator": (lambda w: w.skeletons[4].joints[0].set_actuator_type(Joint.PASSIVE), [1, 2, 3]),
    "target": (lambda w: w.skeletons[4].set_targets(q=w.skeletons[4].q, kp=1.0, kd=1.0), [1, 2, 3]),
    "immobile": (lambda w: w.skeletons[4].set_mobile(False), [1, 2, 3]),
    "removed": (lambda w: w.remove_skeleton(w.skeletons[1]), [3]),
    "ground moved": (lambda w: w.skeletons[0].joints[0].set_transform_from_parent_body_node(np.eye(4)), []),
    "ground resized": (lambda w: w.skeletons[0].bodynodes[0].shapenodes[0].shape.set_size([9.0, 9.0, 1.0]), []),
    "ground removed": (lambda w: w.remove_skeleton(w.skeletons[0]), []),
    "gravity": (lambda w: w.set_gravity([0, 0, -1.0]), []),
    "time step": (lambda w: w.set_time_step(0.001), []),
    "detector": (lambda w: w.set_collision_detector("bullet"), []),
    "solver": (lambda w: w.set_constraint_solver("fast"), []),
    "filter": (
        lambda w: w.collision_filter.add_to_black_list(w.skeletons[1].bodynodes[0], w.skeletons[2].bodynodes[0]),
        [],
    ),
    "constraint": (lambda w: WeldJointConstraint(w.skeletons[4].bodynodes[0]).add_to_world(w), [1, 2, 3]),
    "states": (lambda w: w.set_states(w.x), []),
    "reset": (lambda w: w.reset(), []),
    "settings": (lambda w: w.set_sleeping(seconds=1.0), []),
    "switched off": (lambda w: w.set_sleeping(False), []),
}


@pytest.mark.parametrize("name", CHANGES)
def test_changes_wake(name: str) -> None:
    world = sleeping_pile()
    change, still = CHANGES[name]
    change(world)
    assert asleep(world) == still


QUIET: dict[str, Callable[[World], object]] = {
    "no forces": lambda w: w.skeletons[1].set_forces(np.zeros(6)),
    "no external force": lambda w: w.skeletons[1].bodynodes[0].add_ext_force([0.0, 0.0, 0.0]),
    "reading": lambda w: [(s.q, s.M, s.c, s.C, s.bodynodes[0].T, s.kinetic_energy(), repr(s)) for s in w.skeletons],
    "snapshot": lambda w: w.snapshot(),
    "clone": lambda w: w.clone(),
    "collision": lambda w: w.check_collision(),
    "ray": lambda w: w.raycast([0.0, 0.0, 3.0], [0.0, 0.0, -1.0]),
    "another skeleton": lambda w: w.add_box([0.1, 0.1, 0.1], 1.0, [3.0, 3.0, 5.0]),
    "contacts": lambda w: w.contacts,
}


@pytest.mark.parametrize("name", QUIET)
def test_does_not_wake(name: str) -> None:
    world = sleeping_pile()
    QUIET[name](world)
    world.step(5)
    assert asleep(world) == [1, 2, 3, 4]


def test_queries_and_collision_see_sleepers() -> None:
    world = sleeping_pile()
    assert world.raycast([1.0, 0.0, 3.0], [0.0, 0.0, -1.0]).distances == pytest.approx(2.8, abs=1e-3)
    kept = len(world.collision_result.contacts)
    world.check_collision()
    assert len(world.collision_result.contacts) == kept
    world.step()
    assert len(world.collision_result.contacts) == kept


def test_support_that_moves() -> None:
    """On a belt, an immobile body with a velocity, nothing falls asleep."""
    world = pile(fixed_ground=False)
    world.remove_skeleton(world.skeletons[0])
    belt = world.add_box([10.0, 10.0, 1.0], None, [0.0, 0.0, -0.5], name="belt")
    belt.set_mobile(False)
    belt.set_velocities([0, 0, 0, 0.02, 0, 0])
    world.step(700)
    assert asleep(world) == []


def test_driven_skeletons_stay_awake() -> None:
    world = pile()
    box = world.skeletons[4]
    box.set_controller(lambda: np.zeros(6))
    world.step(600)
    assert asleep(world) == [1, 2, 3]
    box.set_controller(None)
    world.step(400)
    assert asleep(world) == [1, 2, 3, 4]


@pytest.mark.parametrize("copied", [World.clone, lambda world: pickle.loads(pickle.dumps(world))])
def test_driven_skeletons_stay_awake_in_copies(copied: Callable[[World], World]) -> None:
    world = pile()
    world.skeletons[4].set_controller(_no_forces)
    other = copied(world)
    for each in (world, other):
        each.step(600)
    assert asleep(world) == asleep(other) == [1, 2, 3]
    np.testing.assert_array_equal(world.x, other.x)


def _no_forces() -> np.ndarray:
    return np.zeros(6)


def test_what_swings_stays_awake() -> None:
    """It is slow wherever it turns back; only times that follow each other count together."""
    world = World(0.005, up="z")
    pendulum = world.add_empty_skeleton("pendulum")
    pendulum.add_body(
        "bob", joint="revolute", axis=[0.0, 1.0, 0.0], mass=1.0, com=[0.0, 0.0, -1.0], inertia=0.1 * np.eye(3)
    )
    world.set_sleeping(linear_speed=0.1, angular_speed=0.1)
    pendulum.q = [0.2]
    for _ in range(100):  # 20 s, about nine times to and fro
        world.step(40)
        assert not pendulum.is_asleep()


def test_ball_that_rolls_comes_to_rest() -> None:
    """Nothing else would stop it; without sleeping it rolls on."""
    worlds = [World(0.002, up="z") for _ in range(2)]
    for world in worlds:
        world.set_collision_detector("native")
        world.set_constraint_solver("iterative")
        world.add_ground()
        ball = world.add_sphere(0.5, 1.0, [0.0, 0.0, 0.5])
        ball.dq = [0.0, 0.06, 0.05, 0.03, 0.0, 0.0]
    worlds[1].set_sleeping()
    for world in worlds:
        world.step(1000)
    assert worlds[0].skeletons[1].dq[3] == pytest.approx(0.03, abs=1e-3)
    assert asleep(worlds[1]) == [1]


@pytest.mark.parametrize("detector", DETECTORS)
def test_copies_go_on_bit_for_bit(detector: str) -> None:
    """With sleepers, and while they wake."""
    world = sleeping_pile(detector)
    falling = world.add_box([0.2, 0.2, 0.2], 1.0, [0.05, 0.0, 0.8], name="falling")
    falling.dq = [0.3, 0.2, 0.0, 0.0, 0.0, 0.0]
    world.step(20)
    saved = world.snapshot()
    copies = [world.clone(), pickle.loads(pickle.dumps(world))]
    assert [asleep(copy) for copy in copies] == [[1, 2, 3, 4]] * 2
    runs = []
    for w in (world, *copies):
        w.step(300)
        runs.append((w.x.tobytes(), asleep(w), len(w.contacts)))
    world.restore(saved)
    assert asleep(world) == [1, 2, 3, 4]
    world.step(300)
    runs.append((world.x.tobytes(), asleep(world), len(world.contacts)))
    assert runs == runs[:1] * 4
    assert copies[0].sleeping_options() == world.sleeping_options()


def test_snapshots_of_other_worlds() -> None:
    world = sleeping_pile()
    saved = world.snapshot()
    world.set_sleeping(False)
    with pytest.raises(ValueError, match="snapshot"):
        world.restore(saved, strict=False)
    unsaid = world.snapshot()
    world.set_sleeping()
    with pytest.raises(ValueError, match="does not say who sleeps"):
        world.restore(unsaid, strict=False)


def test_batch() -> None:
    batch = pydart2.Batch(sleeping_pile(), 2)
    batch.step(50)
    batch.tau = np.zeros_like(batch.tau)
    assert [asleep(world) for world in batch.worlds] == [[1, 2, 3, 4]] * 2
    batch.x = batch.x
    assert [asleep(world) for world in batch.worlds] == [[]] * 2


def test_robots_sleep_whole() -> None:
    """A limp robot that has fallen lies still as a group of its own; its steps then cost nothing and move nothing."""
    world = World(0.001, "skel/fullbody1.skel")
    world.set_sleeping(linear_speed=0.05, angular_speed=0.2)
    robot = world.skeletons[1]
    world.step(8000)
    assert robot.is_asleep()
    pose = robot.q
    world.step(1000)
    assert robot.q.tobytes() == pose.tobytes()
    robot.dofs[8].set_force(100.0)
    assert not robot.is_asleep()


@pytest.mark.parametrize("setting", ["linear_speed", "angular_speed", "seconds"])
def test_settings(setting: str) -> None:
    world = pile()
    world.set_sleeping(**{setting: 0.3})  # type: ignore[arg-type]
    assert world.sleeping_options()[setting] == 0.3
    for wrong in (0.0, -1.0, np.inf, np.nan):
        with pytest.raises(ValueError, match="setting of sleep"):
            world.set_sleeping(**{setting: wrong})  # type: ignore[arg-type]
