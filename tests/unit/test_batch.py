"""Batches: the numbers of single worlds, whatever the threads; failures; parameters; rollouts."""

from __future__ import annotations

import os
import pickle
import re
import subprocess
import sys
import threading
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

import pydart2
from physics.models import G, box, floor, free_body, make_world, slider
from pydart2 import Batch

Array = NDArray[np.float64]
BODY = "h_heel_left"


def humanoid() -> pydart2.World:
    world = pydart2.World(0.001, "skel/fullbody1.skel")
    world.step(50)
    return world


def kicks(batch: Batch, times: int = 20) -> tuple[Array, Array]:
    """States around the start and random forces."""
    rng = np.random.default_rng(5)
    x = batch.x + rng.uniform(-0.02, 0.02, batch.x.shape)
    return x, rng.uniform(-5.0, 5.0, (len(batch), times, batch.skeleton.ndofs))


def alone(start: pydart2.Snapshot, x: Array, actions: Array, hold: int) -> Array:
    """What one world on its own does."""
    world = humanoid()
    world.restore(start)
    world.x = x
    states = [world.x]
    for tau in actions:
        for _ in range(hold):
            world.skeletons[-1].tau = tau
            world.step()
        states.append(world.x)
    return np.array(states)


def test_numbers_do_not_depend_on_the_threads() -> None:
    world = humanoid()
    x, actions = kicks(Batch(world, 5))
    found = [Batch(world, 5, threads=threads).rollout(x, actions, hold=3) for threads in (1, 2, 3, 8)]
    assert found[0].failed == {}
    for other in found[1:]:
        np.testing.assert_array_equal(other.states, found[0].states)
    start = world.snapshot()
    for i in (0, 4):
        np.testing.assert_array_equal(found[0].states[i], alone(start, x[i], actions[i], hold=3))


def test_rollouts_repeat() -> None:
    batch = Batch(humanoid(), 3)
    x, actions = kicks(batch)
    first = batch.rollout(x, actions)
    batch.step(7)
    calls: list[tuple[int, int]] = []
    again = batch.rollout(x, actions, progress=lambda done, of: calls.append((done, of)))
    np.testing.assert_array_equal(first.states, again.states)
    assert calls == [(i + 1, 20) for i in range(20)]
    np.testing.assert_array_equal(first.states[:, 0], x)
    np.testing.assert_array_equal(first.q["j_head_1"], first.q[..., batch.skeleton.dof_index("j_head_1")])
    assert first.dq["j_head_1", "j_head_2"].shape == (3, 21, 2)


def test_steps_are_those_of_a_rollout() -> None:
    batch = Batch(humanoid(), 3, threads=2)
    x, actions = kicks(batch)
    trajectories = batch.rollout(x, actions)
    batch.reset()
    batch.x = x
    for t in range(actions.shape[1]):
        batch.tau = actions[:, t]
        batch.step()
        np.testing.assert_array_equal(batch.q, trajectories.q[:, t + 1])
        np.testing.assert_array_equal(batch.dq, trajectories.dq[:, t + 1])
    assert batch.t == pytest.approx(np.full(3, 0.07))


def test_progress_can_end_a_rollout() -> None:
    batch = Batch(humanoid(), 2)

    def stop(done: int, of: int) -> None:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        batch.rollout(*kicks(batch), progress=stop)
    assert batch.t == pytest.approx(np.full(2, 0.051))


def test_a_world_that_fails_is_named_and_the_others_go_on() -> None:
    batch = Batch(humanoid(), 4, threads=2)
    x, actions = kicks(batch)
    good = batch.rollout(x, actions)
    actions[2, 5:] = 1e30
    found = batch.rollout(x, actions)
    assert list(found.failed) == [2]
    assert "the simulation blew up at t = " in found.failed[2]
    assert np.isfinite(found.states[2, :6]).all()
    assert np.isnan(found.states[2, 6:]).all()
    np.testing.assert_array_equal(found.states[[0, 1, 3]], good.states[[0, 1, 3]])
    before = batch.x
    batch.step()
    assert list(batch.failed) == [2]
    assert np.array_equal(batch.x[2], before[2])
    assert not np.array_equal(batch.x[1], before[1])
    batch.reset([2])
    assert batch.failed == {}
    batch.step()
    assert batch.t[2] == pytest.approx(0.051)


def test_each_world_has_parameters_of_its_own(tmp_path: Path) -> None:
    """Constant force F on a cart of mass m: velocity F t / m; with damping d and no force: v decays by d / m."""
    world = make_world(tmp_path, slider(), dt=1e-4)
    batch = Batch(world, 3)
    masses = np.array([0.5, 1.0, 4.0])
    batch.set_mass("cart", masses)
    found = batch.rollout(None, np.full((1, 1), 3.0), hold=1000)
    np.testing.assert_allclose(found.dq["rail"][:, -1], 3.0 * 0.1 / masses, rtol=1e-9)
    damping = np.array([0.0, 1.0, 2.0])
    batch.set_damping("rail", damping)
    batch.reset()
    batch.dq = [2.0]
    batch.step(1000)
    np.testing.assert_allclose(batch.dq["rail"], 2.0 * np.exp(-damping * 0.1 / masses), rtol=1e-4)


def test_friction_of_each_world(tmp_path: Path) -> None:
    """A box that slides on the floor loses mu g per second."""
    box_on_floor = free_body("sliding", shape=box((0.4, 0.1, 0.4)), at=(0, 0.05, 0, 0, 0, 0), inertia=(0.01,) * 3)
    world = make_world(tmp_path, floor(), box_on_floor)
    world.step(50)
    batch = Batch(world, 3)
    friction = np.array([0.0, 0.2, 0.5])
    batch.set_friction("body", friction)
    batch.dq = [0, 0, 0, 3.0, 0, 0]
    batch.step(200)
    np.testing.assert_allclose(batch.dq["joint_pos_x"], 3.0 - friction * G * 0.2, atol=0.02)


def test_arrays_with_names() -> None:
    batch = Batch(humanoid(), 3)
    batch.q = {"j_head_1": [0.1, 0.2, 0.3], "j_head_2": 0.5}
    np.testing.assert_array_equal(batch.q["j_head_1"], [0.1, 0.2, 0.3])
    np.testing.assert_array_equal(batch.q["j_head_1", "j_head_2"][1], [0.2, 0.5])
    for i, world in enumerate(batch.worlds):
        np.testing.assert_array_equal(world.skeletons[-1].q, batch.q[i])
        np.testing.assert_array_equal(world.skeletons[-1].C, batch.C[i])
        np.testing.assert_array_equal(world.skeletons[-1].dC, batch.dC[i])
        np.testing.assert_array_equal(world.skeletons[-1].body(BODY).T, batch.T(BODY)[i])
    batch.tau = {"j_head_1": 3.0}
    assert batch.tau.sum() == 9.0
    with pytest.raises(pydart2.NameNotFound, match="did you mean 'j_head_1'"):
        batch.q["j_head_11"]


def test_contacts() -> None:
    world = pydart2.World(0.001, "skel/cubes.skel")
    with pytest.raises(pydart2.NameNotFound, match="did you mean"):
        Batch(world, 1, skeleton=world.skeletons[0].name + "s")
    assert Batch(world, 1, skeleton=world.skeletons[0].name).skeleton.id == 0
    batch = Batch(world, 2)
    batch.step(800)
    up = batch.x
    up[1] = world.x
    batch.x = up
    batch.step()
    numbers = [w.collision_result.num_contacts() for w in batch.worlds]
    assert batch.num_contacts.tolist() == numbers and numbers[0] > numbers[1]
    assert batch.contacts.shape == (2, numbers[0], 16)
    np.testing.assert_array_equal(batch.contacts[0], batch.worlds[0].collision_result.rows)
    assert np.isnan(batch.contacts[1, numbers[1] :]).all()


def test_a_batch_pickles_by_value() -> None:
    batch = Batch(humanoid(), 3, threads=2)
    x, actions = kicks(batch)
    batch.set_mass(BODY, [1.0, 2.0, 3.0])
    actions[1, 3:] = 1e30
    found = batch.rollout(x, actions)
    copy = pickle.loads(pickle.dumps(batch))
    assert (len(copy), copy.threads, copy.failed) == (3, 2, found.failed)
    np.testing.assert_array_equal(copy.x, batch.x)
    again = copy.rollout(x, actions)
    np.testing.assert_array_equal(again.states, found.states)


def test_what_is_refused() -> None:
    world = humanoid()
    ndofs = world.skeletons[-1].ndofs
    with pytest.raises(ValueError, match="a batch needs one world or more, got 0"):
        Batch(world, 0)
    with pytest.raises(ValueError, match="a batch needs one thread or more, got -1"):
        Batch(world, 1, threads=-1)
    with pytest.raises(IndexError, match=r"no skeleton 7 in .*: there are 2"):
        Batch(world, 1, skeleton=7)
    with pytest.raises(IndexError, match=r"no skeleton -1 in .*: there are 0"):
        Batch(pydart2.World(0.001), 1)
    batch = Batch(world, 2)
    with pytest.raises(ValueError, match=rf"actions need shape \(2, T, {ndofs}\) or \(T, {ndofs}\), got \(2, 5, 1\)"):
        batch.rollout(None, np.zeros((2, 5, 1)))
    with pytest.raises(ValueError, match="actions must be finite, got nan"):
        batch.rollout(None, np.full((2, ndofs), np.nan))
    with pytest.raises(ValueError, match=r"forces needs shape \(2, 37\), or \(37,\) for all worlds, got \(3, 37\)"):
        batch.tau = np.zeros((3, ndofs))
    with pytest.raises(ValueError, match="positions must be finite"):
        batch.q = np.full(ndofs, np.inf)
    with pytest.raises(ValueError, match="one number, or one for each of the 2 worlds"):
        batch.set_mass(BODY, [1.0, 2.0, 3.0])
    with pytest.raises(ValueError, match="mass must be positive"):
        batch.set_mass(BODY, [1.0, -1.0])
    with pytest.raises(ValueError, match="must be zero or positive"):
        batch.step(-1)

    class Controller:
        def compute(self) -> Array:
            return np.zeros(ndofs)

    world.skeletons[-1].controller = Controller()
    with pytest.raises(ValueError, match="a batch runs no controllers"):
        Batch(world, 2)


@pytest.mark.parametrize(
    "limit",
    [
        "",
        pytest.param(
            "import resource; resource.setrlimit(resource.RLIMIT_AS, (4 << 30, 4 << 30))",
            marks=pytest.mark.skipif(
                "ASAN_OPTIONS" in os.environ, reason="AddressSanitizer wants terabytes of addresses"
            ),
        ),
    ],
)
def test_more_worlds_than_memory_holds(limit: str) -> None:
    """It says so while there is room, where the system would end the process."""
    code = f"""
import pydart2
{limit}
world = pydart2.World(0.001, "skel/fullbody1.skel")
try:
    pydart2.Batch(world, 2**31)
except ValueError as error:
    print(error)
pydart2.Batch(world, 40).step()
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr[-2000:]
    assert re.match(r"2147483648 worlds of [\d.]+ MB each are [\d.e+]+ GB, and [\d.]+ GB are free; make", done.stdout)


def test_ode_takes_one_thread() -> None:
    world = pydart2.World(0.001, "skel/cubes.skel")
    world.set_collision_detector(pydart2.World.ODE_COLLISION_DETECTOR)
    with pytest.raises(ValueError, match="the ODE collision detector cannot run in several threads"):
        Batch(world, 2, threads=2)
    Batch(world, 2, threads=1).step(10)
    batch = Batch(pydart2.World(0.001, "skel/cubes.skel"), 2, threads=2)
    batch.worlds[1].set_collision_detector(pydart2.World.ODE_COLLISION_DETECTOR)
    with pytest.raises(ValueError, match="the ODE collision detector cannot run in several threads"):
        batch.step()


def test_a_second_thread_runs_on_and_is_refused() -> None:
    batch = Batch(humanoid(), 4)
    stepping = threading.Thread(target=batch.step, args=(300,))
    stepping.start()
    refused = 0
    while stepping.is_alive():
        try:
            batch.x  # noqa: B018
        except pydart2.PydartError as error:
            assert "is in use by another thread" in str(error)
            refused += 1
    assert refused > 10  # as often as this thread ran meanwhile
    assert batch.t == pytest.approx(np.full(4, 0.35))


def test_worlds_without_dofs(tmp_path: Path) -> None:
    world = make_world(tmp_path, floor())
    batch = Batch(world, 2)
    batch.step(3)
    assert batch.x.shape == batch.q.shape == (2, 0)
    assert batch.rollout(None, np.zeros((4, 0))).states.shape == (2, 5, 0)


def uses(batch: Batch) -> dict[str, Callable[[], object]]:
    """Everything that needs all worlds of a batch of cubes."""
    zeros = np.zeros(6)
    return {
        "step": lambda: batch.step(2),
        "x": lambda: batch.x,
        "x =": lambda: setattr(batch, "x", np.zeros((3, 60))),
        "q": lambda: batch.q,
        "q =": lambda: setattr(batch, "q", zeros),
        "dq": lambda: batch.dq,
        "dq =": lambda: setattr(batch, "dq", zeros),
        "tau =": lambda: setattr(batch, "tau", zeros),
        "reset": batch.reset,
        "rollout": lambda: batch.rollout(None, np.zeros((3, 6))),
    }


@pytest.mark.parametrize("which", [0, 1, 2])
def test_a_batch_with_a_destroyed_world_refuses_every_use(which: int) -> None:
    batch = Batch(pydart2.World(0.001, "skel/cubes.skel"), 3, threads=2)
    batch.worlds[which].destroy()
    for use in uses(batch).values():
        with pytest.raises(pydart2.DestroyedError, match=f"world {batch.worlds[which].id} was destroyed"):
            use()


def test_a_batch_is_refused_after_init() -> None:
    batch = Batch(pydart2.World(0.001, "skel/cubes.skel"), 3, threads=2)
    pydart2.init(verbose=False)
    for use in uses(batch).values():
        with pytest.raises(pydart2.DestroyedError, match="by a later init"):
            use()


@pytest.mark.parametrize("which", [0, 1, 2])
def test_a_batch_whose_worlds_are_no_longer_alike_has_no_arrays(which: int) -> None:
    batch = Batch(pydart2.World(0.001, "skel/cubes.skel"), 3, threads=2)
    batch.worlds[which].skeletons[1].set_root_joint_to_weld()
    for name in ("x", "x =", "q", "q =", "dq", "dq =", "tau ="):
        with pytest.raises(ValueError, match=r"no longer has the skeletons and dofs of world 0; make a new Batch"):
            uses(batch)[name]()
    forces, part = np.zeros((3, 6)), np.zeros((3, 60))
    with pytest.raises(ValueError, match="no longer has"):
        batch._handle.rollout(5, forces, 1, part)
    for same in (batch, pickle.loads(pickle.dumps(batch))):
        same.step(2)
        assert (same.t == 0.002).all()
