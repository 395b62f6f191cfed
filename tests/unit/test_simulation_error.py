"""A simulation that blows up raises SimulationError, and the world can be used on."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

import pydart2
from oracle.models import dart_model
from physics.models import arm, box, floor, free_body, make_world
from pydart2 import SimulationError


def read_everything(world: pydart2.World) -> None:
    """Ask the engine for what it derives from the state; all of it must be finite."""
    for skel in world.skeletons:
        for values in (skel.q, skel.dq, skel.ddq, skel.M, skel.c, skel.C, skel.constraint_forces()):
            assert np.isfinite(values).all()
        for body in skel.bodynodes:
            assert np.isfinite(body.T).all() and np.isfinite(body.com_spatial_velocity()).all()


def blow_up(world: pydart2.World, skel: pydart2.Skeleton, steps: int = 200) -> SimulationError:
    """Accelerate until the numbers no longer fit: 1e28 N m, again and again."""
    with pytest.raises(SimulationError) as info:
        for _ in range(steps):
            skel.tau = np.full(skel.ndofs, 1e28) * np.sign(skel.dq + 1e-30)
            world.step()
    return info.value


def test_names_dof_skeleton_and_time(tmp_path: Path) -> None:
    world = make_world(tmp_path, arm(), dt=0.01)
    message = str(blow_up(world, world.skeletons[0]))
    found = re.search(r"t = ([\d.]+) s: velocity of dof '(hinge\d)' in skeleton 'arm' became", message)
    assert found and float(found[1]) == pytest.approx(world.t + world.dt)


def test_random_torques_on_the_humanoid(fullbody: pydart2.World) -> None:
    """5 N m on every dof are too much for its light feet: the engine would end the process after 0.3 s."""
    skel, rng = fullbody.skeletons[1], np.random.default_rng(0)
    with pytest.raises(SimulationError, match=r"t = 0\.\d+ s: velocity of dof 'j_\w+' in skeleton 'fullbody1' became"):
        for _ in range(2000):
            skel.tau = rng.uniform(-5, 5, skel.ndofs)
            fullbody.step()
    read_everything(fullbody)
    fresh = pydart2.World(fullbody.dt, dart_model("skel/fullbody1.skel"))
    fresh.step()
    for world in (fullbody, fresh):
        world.reset()
        world.step(200)
    assert fullbody.x.tobytes() == fresh.x.tobytes()


def test_the_failing_step_leaves_the_state_before_it(tmp_path: Path) -> None:
    world = make_world(tmp_path, arm(), free_body(), recording=True)
    skel = world.skeletons[0]
    skel.tau = [1.0, -1.0]
    world.step(5)
    skel.dq = [1e29, -1e29]
    before = world.x, skel.ddq.copy(), world.t, world.frame, world.num_frames()
    with pytest.raises(SimulationError):
        world.step()
    after = world.x, skel.ddq.copy(), world.t, world.frame, world.num_frames()
    for a, b in zip(before, after, strict=True):
        assert np.array_equal(a, b)
    read_everything(world)
    skel.dq = [0.0, 0.0]
    world.step(3)
    assert world.frame == 8


def test_soft_bodies(tmp_path: Path) -> None:
    world = pydart2.World(0.001, pydart2.data_path("skel/softBodies.skel"))
    soft = next(b for s in world.skeletons for b in s.bodynodes if isinstance(b, pydart2.SoftBodyNode))
    soft.set_point_velocities(np.full((soft.num_points(), 3), 9e29) * np.array([1, -1, 1]))
    before = soft.point_displacements()
    with pytest.raises(SimulationError, match=re.escape(f"in skeleton '{soft.skeleton.name}'")):
        world.step(20)
    assert np.isfinite(soft.point_displacements()).all()
    assert soft.point_displacements().shape == before.shape
    world.reset()
    world.step(10)
    read_everything(world)


def test_what_the_engine_refuses_in_a_step_names_the_fastest_dof(fullbody: pydart2.World) -> None:
    """Self-collision of a model whose bodies overlap: contacts push with all they have."""
    fullbody.skeletons[1].set_self_collision_check(True)
    with pytest.raises(SimulationError, match=r"of dof 'j_.*' in skeleton 'fullbody1'"):
        fullbody.step(1000)
    read_everything(fullbody)
    fullbody.skeletons[1].set_self_collision_check(False)
    fullbody.reset()
    fullbody.step(10)


@pytest.mark.parametrize("detector", (0, 1, 2, 3, 10))
def test_far_away(tmp_path: Path, detector: int) -> None:
    """ODE would end the process; the others would find contacts without a direction."""
    world = make_world(tmp_path, floor(), free_body(shape=box((1, 1, 1))))
    world.set_collision_detector(detector)
    free = world.skeletons[1]
    free.q = [0, 0, 0, 0, 1e20, 0]
    for call in (world.step, world.check_collision):
        with pytest.raises(SimulationError, match=r"body 'body' of skeleton 'free' is 1e\+20 m from the origin"):
            call()
    free.q = [0, 0, 0, 0, 1e7, 0]
    world.step()
    world.reset()
    world.step(10)


def test_assertions_of_the_engine_are_exceptions(tmp_path: Path) -> None:
    """The second line, for what gets past the checks: an inverse inertia that overflows."""
    world = make_world(tmp_path, arm())
    world.set_dynamics("engine")
    for body in (skel := world.skeletons[0]).bodynodes:
        body.set_mass(1e-310)
        body.set_inertia(np.eye(3) * 1e-310)
    with pytest.raises(
        SimulationError, match=r"t = 0.001 s: the engine cannot go on: it expects !math::isNan\(PI\)"
    ) as info:
        world.step(5)
    assert "the fastest dof is 'hinge0' of skeleton 'arm'" in str(info.value)
    with pytest.raises(pydart2.PydartError, match="the engine cannot go on: it expects"):
        skel.inv_mass_matrix()
    for body in skel.bodynodes:
        body.set_mass(1.0)
        body.set_inertia(np.eye(3))
    world.step(5)
    read_everything(world)


@pytest.mark.parametrize("bad", [1e31, -1e31, 1e300])
def test_numbers_that_count_as_infinite(tmp_path: Path, bad: float) -> None:
    skel = make_world(tmp_path, arm()).skeletons[0]
    for call in (skel.set_positions, skel.set_velocities, skel.set_forces):
        with pytest.raises(ValueError, match=r"must be finite, got -?1e\+\d+ \(beyond 1e\+30 counts as infinite\)"):
            call([0.0, bad])


def test_an_empty_world_steps() -> None:
    world = pydart2.World(0.01)
    world.step(3)
    assert world.t == pytest.approx(0.03) and world.frame == 3


def test_a_shape_that_moves_out_of_the_detectors_range(tmp_path: Path) -> None:
    """What was found within it is looked at again."""
    world = make_world(tmp_path, free_body(shape=box((0.1, 0.1, 0.1))), gravity=(0.0, 0.0, 0.0))
    node = world.skeletons[0].bodynodes[0].shapenodes[0]
    world.step(3)
    node.set_relative_transform([[1, 0, 0, 2e12], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])
    with pytest.raises(SimulationError, match=r"a shape of body .* is 2e\+12 m from the origin"):
        world.step()
    node.set_relative_transform(np.eye(4))
    world.step()
