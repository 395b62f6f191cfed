"""Choosing the dynamics; ``test_bitwise.py`` compares them in all models, joints and actuators."""

from __future__ import annotations

import os
import pickle
import subprocess
import sys
from collections.abc import Callable

import numpy as np
import pytest

import pydart2
from physics.models import standing_atlas
from physics.test_integrators import tree
from pydart2.joint import Joint

from .test_choice import held_cubes, results, skel

ENVIRONMENT = os.environ.get("PYDART2_DYNAMICS") or "fast"


def robot() -> pydart2.World:
    """Targets, armature, external forces, and joints of each actuator."""
    world = skel("fullbody1")
    body = world.skeletons[1]
    kinds = (Joint.PASSIVE, Joint.SERVO, Joint.ACCELERATION, Joint.VELOCITY, Joint.LOCKED, Joint.FORCE)
    for joint, kind in zip(body.joints[3:], kinds, strict=False):
        joint.set_actuator_type(kind)
    for dof in body.dofs[-4:]:
        dof.set_armature(0.01)
    body.bodynodes[2].add_ext_force([0.0, 50.0, 10.0])
    body.set_commands(np.linspace(-1.0, 1.0, body.ndofs))
    return world


def chain() -> pydart2.World:
    world = skel("chain")
    world.skeletons[0].set_positions(world.skeletons[0].q + 0.3)
    return world


MAKERS: list[tuple[Callable[[], pydart2.World], int]] = [
    (chain, 500),
    (held_cubes, 300),
    (standing_atlas, 60),
    (robot, 200),
    (lambda: skel("softBodies"), 30),
]


@pytest.mark.parametrize(("make", "steps"), MAKERS, ids=["chain", "cubes", "Atlas", "robot", "softBodies"])
def test_same_bits(make: Callable[[], pydart2.World], steps: int) -> None:
    """Also where the world goes from one to the other while it runs, and where all is read in between."""
    worlds = [make() for _ in range(3)]
    for world, name in zip(worlds, ("engine", "fast", "fast"), strict=True):
        world.set_dynamics(name)
    for i in range(10):
        worlds[2].set_dynamics(("engine", "fast")[i % 2])
        seen = [results(world, steps // 10) for world in worlds]
        assert seen == seen[:1] * 3
        for engines, ours in zip(worlds[0].skeletons, worlds[1].skeletons, strict=True):
            assert [m.tobytes() for m in (ours.M, ours.c, ours.C)] == [
                m.tobytes() for m in (engines.M, engines.c, engines.C)
            ]
            for a, b in zip(engines.bodynodes, ours.bodynodes, strict=True):
                assert a.world_transform().tobytes() == b.world_transform().tobytes()
                assert a.com_linear_acceleration().tobytes() == b.com_linear_acceleration().tobytes()


def many() -> pydart2.World:
    """A dozen skeletons, of which some touch."""
    world = skel("fullbody1")
    for place in range(8):
        robot = world.add_skeleton(pydart2.data_path("sdf/atlas/atlas_v3_no_head.sdf"))
        q = robot.q
        q[0] = -np.pi / 2.0
        q[3:6] = 0.6 * place, 0.02 * place, 0.5
        robot.set_positions(q)
    for place in range(3):
        world.add_box((0.2, 0.2, 0.2), None, (0.1 * place, 0.19 * place, 3.0))
    return world


POINT = (0.1, -0.2, 0.3)


def motion(body: pydart2.BodyNode) -> bytes:
    """All that is read of where a body is and how fast."""
    poses = (body.T, body.C, body.to_world(POINT), body.to_local(POINT))
    velocities = (
        body.dC,
        body.world_angular_velocity(),
        body.world_linear_velocity(),
        body.world_linear_velocity(POINT),
    )
    spatial = (body.world_spatial_velocity(), body.world_spatial_velocity(POINT), body.com_spatial_velocity())
    rest = (body.J, body.dJ, body.linear_momentum(), body.angular_momentum())
    return b"".join(one.tobytes() for one in (*poses, *velocities, *spatial, *rest))


@pytest.mark.parametrize(
    "make",
    [lambda: tree(1e-3, "engine"), lambda: skel("fullbody1"), many],
    ids=["a joint of each kind", "fullbody1", "many"],
)
def test_motion_is_read_with_the_same_bits(make: Callable[[], pydart2.World]) -> None:
    """Of bodies in any order, after a step and after a change."""
    worlds = [make() for _ in range(2)]
    for world, name in zip(worlds, ("engine", "fast"), strict=True):
        world.set_dynamics(name)
    changes: list[Callable[[pydart2.Skeleton], object]] = [
        lambda robot: None,
        lambda robot: robot.set_positions(robot.q + 1e-3),
        lambda robot: robot.set_velocities(robot.dq * 0.9),
        lambda robot: robot.joints[-1].set_transform_from_parent_body_node(np.eye(4)),
    ]
    rng = np.random.default_rng(5)
    for i in range(40):
        assert results(worlds[0], i % 3) == results(worlds[1], i % 3)
        place = rng.integers(len(worlds[0].skeletons))
        pair = [world.skeletons[place] for world in worlds]
        for robot in pair:
            changes[i % 4](robot)
        for j in rng.permutation(pair[0].nbodies)[:10]:
            assert motion(pair[0].bodynodes[j]) == motion(pair[1].bodynodes[j])


def test_velocity_of_a_point_is_the_linear_part_of_the_spatial_one() -> None:
    """To the bit: the engine finds that one."""
    world = tree(1e-3, "engine")
    world.step(20)
    for body in world.skeletons[0].bodynodes:
        for point, velocity in ((POINT, body.world_linear_velocity(POINT)), (body.local_com(), body.dC)):
            assert velocity.tobytes() == body.world_spatial_velocity(point)[3:].tobytes()


def disturb(world: pydart2.World, rng: np.random.Generator) -> object:
    """One of the things that are done between steps, and what it reads."""
    robot = world.skeletons[1 + rng.integers(len(world.skeletons) - 1)]
    body, dof = robot.bodynodes[rng.integers(robot.nbodies)], robot.dofs[rng.integers(robot.ndofs)]
    deeds: list[Callable[[], object]] = [
        lambda: robot.set_forces(rng.uniform(-5.0, 5.0, robot.ndofs)),
        lambda: robot.set_positions(robot.q + rng.uniform(-1e-3, 1e-3, robot.ndofs)),
        lambda: robot.set_velocities(robot.dq * 0.9),
        lambda: body.add_ext_force(rng.uniform(-20.0, 20.0, 3)),
        lambda: body.set_friction_coeff(rng.uniform(0.0, 1.0)),
        lambda: robot.set_mobile(not robot.is_mobile()),
        lambda: body.set_mass(body.m * 1.01),
        lambda: body.set_gravity_mode(not body.gravity_mode()),
        lambda: dof.set_damping_coefficient(rng.uniform(0.0, 2.0)),
        lambda: dof.set_armature(rng.uniform(0.0, 0.02)),
        lambda: dof.set_constraint_impulse(0.01),
        lambda: dof.joint.set_actuator_type(int(rng.integers(6))),
        lambda: world.restore(world.snapshot()),
        lambda: world.check_collision(),
        lambda: [m.tobytes() for m in (robot.M, robot.invM, robot.c, robot.constraint_forces())],
        lambda: [m.tobytes() for m in (body.J, body.dJ, body.C, body.dC, body.com_linear_acceleration())],
        lambda: [shape.world_transform().tobytes() for shape in body.shapenodes],
        lambda: robot.ddq.tobytes(),
    ]
    return deeds[rng.integers(len(deeds))]()


@pytest.mark.parametrize("seed", range(4))
def test_many_skeletons_have_the_same_bits(seed: int) -> None:
    """Whatever is done and read in between."""
    worlds = [many() for _ in range(2)]
    for world, name in zip(worlds, ("engine", "fast"), strict=True):
        world.set_dynamics(name)
    for i in range(60):
        rngs = [np.random.default_rng((seed, i)) for _ in worlds]
        for _ in range(3):
            read = [disturb(world, rng) for world, rng in zip(worlds, rngs, strict=True)]
            assert read[0] == read[1]
        assert results(worlds[0], 3) == results(worlds[1], 3)


@pytest.mark.parametrize("kind", [Joint.ACCELERATION, Joint.VELOCITY, Joint.LOCKED])
@pytest.mark.parametrize("root", ["free", "ball"])
def test_motion_that_is_prescribed_in_a_contact(root: str, kind: int) -> None:
    """What the last impulses have changed is not taken once more."""
    worlds = [pydart2.World(0.001) for _ in range(2)]
    for world, name in zip(worlds, ("engine", "fast"), strict=True):
        world.set_dynamics(name)
        world.add_ground()
        robot = world.add_empty_skeleton("robot")
        robot.add_body("foot", joint=root, position=(0, 0.049, 0)).add_box((0.1, 0.1, 0.1), mass=1.0)
        toe = robot.add_body("toe", "foot", "prismatic", axis=(0, 1, 0), position=(0.3, 0, 0))
        toe.add_box((0.1, 0.1, 0.1), mass=1.0)
        world.step(3)
        assert world.contacts_between(world.skeletons[0], toe)
        robot.joints[0].set_actuator_type(kind)
    assert results(worlds[0], 20) == results(worlds[1], 20)


def test_locked_joint_that_moves() -> None:
    """The engine stops it in the middle of its pass: that step is the engine's."""
    worlds = [chain() for _ in range(2)]
    for world, name in zip(worlds, ("engine", "fast"), strict=True):
        world.set_dynamics(name)
        world.step(100)
        world.skeletons[0].joints[4].set_actuator_type(Joint.LOCKED)
    assert results(worlds[0], 50) == results(worlds[1], 50)


def test_tree_that_changes() -> None:
    worlds = [chain() for _ in range(2)]
    for world, name in zip(worlds, ("engine", "fast"), strict=True):
        world.set_dynamics(name)
        world.step(10)
        world.skeletons[0].set_root_joint_to_weld()
        world.skeletons[0].bodynodes[3].set_mass(3.0)
    assert results(worlds[0], 50) == results(worlds[1], 50)


def test_blow_up_goes_back() -> None:
    """To the state before the step; what is not a number stays in no memory."""
    world = chain()
    world.set_dynamics("fast")
    world.step(5)
    start = world.snapshot()
    world.skeletons[0].set_forces(np.full(world.skeletons[0].ndofs, 1e29))
    before = world.x
    with pytest.raises(pydart2.SimulationError, match="blew up"):
        for _ in range(10):
            before = world.x
            world.step()
    assert world.x.tobytes() == before.tobytes()
    world.restore(start)
    twin = chain()
    twin.set_dynamics("engine")
    twin.step(5)
    assert results(world, 20) == results(twin, 20)


def test_names() -> None:
    world = chain()
    assert world.dynamics() == ENVIRONMENT
    world.set_dynamics("fast")
    with pytest.raises(ValueError, match="no dynamics 'quick'; there are engine and fast"):
        world.set_dynamics("quick")
    assert world.dynamics() == "fast"
    assert world.clone().dynamics() == "fast"
    assert pickle.loads(pickle.dumps(world)).dynamics() == "fast"
    world.set_dynamics("engine")
    assert pickle.loads(pickle.dumps(world)).dynamics() == world.clone().dynamics() == "engine"


@pytest.mark.parametrize("name", ["", "fast", "engine", "quick"])
def test_environment_variable(name: str) -> None:
    code = "import pydart2; print(pydart2.World(0.1).dynamics(), pydart2.engine_info().dynamics)"
    environment = os.environ | {"PYDART2_DYNAMICS": name}
    done = subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, text=True)
    if name == "quick":
        assert "ValueError: environment variable PYDART2_DYNAMICS: no dynamics 'quick'" in done.stderr
    else:
        assert done.stdout.split() == [name or "fast"] * 2
