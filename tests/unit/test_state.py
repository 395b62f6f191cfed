"""Snapshots: what is put back goes on bit for bit as it would have."""

from __future__ import annotations

import copy
import pickle
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import pydart2
from physics.models import (
    arm,
    box,
    floor,
    free_body,
    make_world,
)
from physics.moving import DETECTORS, MODELS, bits, moving, path_of
from pydart2 import Snapshot

STEPS = 1000


@pytest.mark.parametrize("detector", DETECTORS)
@pytest.mark.parametrize("model", MODELS)
def test_the_next_thousand_steps(tmp_path: Path, model: str, detector: int) -> None:
    """Into the same world, a fresh one and another process."""
    world = moving(model, detector)
    start = world.snapshot()
    other = in_another_process(model, detector, start, tmp_path)
    world.step(STEPS)
    end = bits(world)
    assert end != start.values.tobytes() and world.frame == start.frame + STEPS
    world.restore(start)
    assert world.snapshot() == start
    world.step(STEPS)
    assert bits(world) == end
    fresh = pydart2.World(0.001, path_of(model))
    fresh.set_collision_detector(detector)
    fresh.step(7)
    fresh.restore(start)
    fresh.step(STEPS)
    assert bits(fresh) == end
    assert other() == end


def in_another_process(model: str, detector: int, start: Snapshot, folder: Path) -> Callable[[], bytes]:
    """Begins the steps there; the call waits for their end."""
    start.save(folder / "start.npz")
    code = f"""
import sys, pydart2
world = pydart2.World(0.001, {str(path_of(model))!r})
world.set_collision_detector({detector})
world.restore(pydart2.Snapshot.load({str(folder / "start.npz")!r}))
world.step({STEPS})
open({str(folder / "end")!r}, "wb").write(world.snapshot().values.tobytes() + world.collision_result.rows.tobytes())
"""
    child = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)

    def wait() -> bytes:
        _, errors = child.communicate(timeout=300)
        assert child.returncode == 0, errors
        return (folder / "end").read_bytes()

    return wait


@pytest.mark.parametrize("detector", DETECTORS)
@pytest.mark.parametrize("model", MODELS)
def test_an_inexact_snapshot_is_a_pure_read(model: str, detector: int) -> None:
    plain, watched = moving(model, detector), moving(model, detector)
    plain.step(60)
    for _ in range(60):
        watched.snapshot(exact=False)
        watched.step()
    assert bits(plain) == bits(watched)


@pytest.mark.parametrize("detector", (0, 3, 10))
def test_three_detectors_need_no_exact_snapshot(detector: int) -> None:
    world = moving("fullbody1", detector)
    start = world.snapshot()
    world.step(200)
    end = bits(world)
    world.restore(start)
    world.step(200)
    assert bits(world) == end


@pytest.mark.parametrize("detector", DETECTORS)
def test_every_run_after_a_reset_is_the_same(detector: int) -> None:
    """What came before it leaves no trace, not in the memory of a detector either."""
    ends = set()
    for steps in (1, 40, 150):
        world = moving("fullbody1", detector)
        world.step(steps)
        world.reset()
        world.step(150)
        ends.add(bits(world))
    assert len(ends) == 1


def test_what_a_snapshot_holds(tmp_path: Path) -> None:
    world = make_world(tmp_path, arm(), floor(), free_body(shape=box((1, 1, 1)), at=(0, 0.49, 0, 0, 0, 0)))
    skel = world.skeletons[0]
    world.step(3)
    skel.dofs[0].set_command(2.0)
    skel.dofs[1].set_constraint_impulse(0.5)
    skel.bodynodes[0].add_ext_torque([1, 2, 3])
    snapshot = world.snapshot()
    read = lambda: [skel.q, skel.dq, skel.ddq, [d.command() for d in skel.dofs], skel.constraint_forces()]  # noqa: E731
    before, rows = [np.array(v) for v in read()], world.collision_result.rows
    assert snapshot.time == world.t and snapshot.frame == 3 and "time 0.0030 frame 3" in repr(snapshot)
    assert len(rows) > 0
    world.step(5)
    world.restore(snapshot)
    for a, b in zip(before, read(), strict=True):
        np.testing.assert_array_equal(a, b)
    assert world.t == snapshot.time and world.frame == 3
    assert np.array_equal(world.collision_result.rows, rows)
    with pytest.raises(ValueError, match="read-only"):
        snapshot.values[0] = 1.0


def test_snapshots_are_values(tmp_path: Path) -> None:
    world = moving("cubes", 0)
    snapshot = world.snapshot()
    again = pickle.loads(pickle.dumps(snapshot))
    assert snapshot == again == copy.deepcopy(snapshot) and hash(snapshot) == hash(again)
    assert snapshot != Snapshot(snapshot.values.copy(), snapshot.contacts.copy(), "of another model")
    world.step()
    assert snapshot != world.snapshot() and snapshot != "another thing"


def test_numbers_are_no_paths(tmp_path: Path) -> None:
    """To open() a number is a file descriptor, which it writes to and closes: 1 is that of all that is printed."""
    world = pydart2.World(0.001, "skel/cubes.skel")
    world.step(2)
    with open(tmp_path / "mine.txt", "wb") as mine:
        assert world.recording is not None
        for save in (world.snapshot().save, world.recording.run.save):
            with pytest.raises(TypeError):
                save(mine.fileno())  # type: ignore[arg-type]
        mine.write(b"still open")
    assert (tmp_path / "mine.txt").read_bytes() == b"still open"


def test_save_and_load(tmp_path: Path) -> None:
    snapshot = moving("cubes", 0).snapshot()
    path = tmp_path / "snapshot.npz"
    snapshot.save(path)
    assert Snapshot.load(path) == snapshot
    with np.load(path, allow_pickle=False) as file:
        assert sorted(file) == ["contacts", "model", "values", "version"]
        parts = dict(file)
    parts["version"] = np.array(99)
    np.savez(path, **parts)
    with pytest.raises(ValueError, match="is a snapshot of version 99, not of 1"):
        Snapshot.load(path)
    for content in (b"", b"something else"):
        path.write_bytes(content)
        with pytest.raises(ValueError, match="is not a snapshot"):
            Snapshot.load(path)
    np.savez(path, values=np.zeros(3))
    with pytest.raises(ValueError, match="is not a snapshot"):
        Snapshot.load(path)
    with pytest.raises(FileNotFoundError):
        Snapshot.load(tmp_path / "missing.npz")


def test_another_model_is_refused(tmp_path: Path) -> None:
    one, two = make_world(tmp_path, arm()), make_world(tmp_path, arm(3))
    snapshot = one.snapshot()
    with pytest.raises(ValueError, match=r"is of another model than .* strict=False"):
        two.restore(snapshot)
    with pytest.raises(ValueError, match=r"the snapshot needs \d+ numbers, got \d+"):
        two.restore(snapshot, strict=False)
    one.skeletons[0].bodynodes[0].set_mass(7.0)
    with pytest.raises(ValueError, match="has changed since"):
        one.restore(snapshot)
    one.step()
    one.restore(snapshot, strict=False)
    assert one.frame == 0
    bad = Snapshot(np.full_like(snapshot.values, np.nan), snapshot.contacts, snapshot.model)
    with pytest.raises(ValueError, match="must be finite"):
        one.restore(bad, strict=False)


def test_restored_forces_are_read() -> None:
    world = pydart2.World(0.001, "skel/chain.skel")
    skel = world.skeletons[0]
    skel.tau = np.full(skel.ndofs, 1.0)
    saved = world.snapshot()
    skel.tau = np.full(skel.ndofs, 2.0)
    world.restore(saved)
    np.testing.assert_array_equal(skel.tau, 1.0)


def test_tau_outlives_the_step_after_a_state_is_put_back_and_after_the_tree_has_changed() -> None:
    """The step clears the engine's own."""
    world = pydart2.World(0.001, "skel/chain.skel")
    skel = world.skeletons[-1]
    skel.tau = np.full(skel.ndofs, 0.1)
    snapshot = world.snapshot()
    skel.tau = np.full(skel.ndofs, 9.0)
    world.restore(snapshot)
    world.step()
    assert (skel.tau == 0.1).all()
    skel.tau = np.arange(skel.ndofs) * 0.1
    skel.remove_body(skel.bodynodes[-1])
    world.step()
    assert (skel.tau == np.arange(skel.ndofs) * 0.1).all()
