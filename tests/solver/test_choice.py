"""Choosing the constraint solver, and the worlds of the documentation with both."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

import pydart2
from physics.models import standing_atlas
from pydart2.constraints import BallJointConstraint
from pydart2.state import Snapshot

Array = NDArray[np.float64]


def skel(name: str) -> pydart2.World:
    return pydart2.World(0.001, pydart2.data_path(f"skel/{name}.skel"))


def held_cubes() -> pydart2.World:
    """A ball joint between two of the cubes that lie on each other."""
    world = skel("cubes")
    plate, cube = (world.skeletons[i].bodynodes[0] for i in (1, 2))
    BallJointConstraint(plate, cube, cube.C - np.array([0.0, 0.05, 0.0])).add_to_world(world)
    return world


def results(world: pydart2.World, steps: int) -> bytes:
    """States and contacts of all steps, bit by bit."""
    seen = []
    for _ in range(steps):
        world.step()
        seen.append(world.x.tobytes())
        seen += [contact.force.tobytes() + contact.point.tobytes() for contact in world.collision_result.contacts]
    return b"".join(seen)


def with_solver(make: Callable[[], pydart2.World], name: str, steps: int) -> bytes:
    world = make()
    world.set_constraint_solver(name)
    return results(world, steps)


@pytest.mark.parametrize(
    ("make", "steps"),
    [(standing_atlas, 100), (held_cubes, 1000), (lambda: skel("fullbody1"), 300), (lambda: skel("softBodies"), 60)],
    ids=["Atlas", "cubes", "fullbody1", "softBodies"],
)
def test_same_bits(make: Callable[[], pydart2.World], steps: int) -> None:
    assert with_solver(make, "fast", steps) == with_solver(make, "dart", steps)


@pytest.mark.parametrize("detector", range(4))
def test_change_while_running(detector: int) -> None:
    """Each change keeps collision detector, filter, contacts and constraints."""
    worlds = [held_cubes() for _ in range(2)]
    for world in worlds:
        world.set_collision_detector(detector)
        world.step(200)
    for i in range(50):
        worlds[0].set_constraint_solver(("dart", "fast")[i % 2])
        assert [len(w.collision_result.contacts) for w in worlds] == [len(worlds[1].collision_result.contacts)] * 2
        assert results(worlds[0], 5) == results(worlds[1], 5)
    assert worlds[0].collision_detector() == detector


def test_names(cubes: pydart2.World) -> None:
    assert cubes.constraint_solver() == "fast"
    cubes.set_constraint_solver("dart")
    assert cubes.constraint_solver() == "dart"
    with pytest.raises(ValueError, match="no constraint solver 'quick'; there are fast, dart and iterative"):
        cubes.set_constraint_solver("quick")
    assert cubes.constraint_solver() == "dart"


@pytest.mark.parametrize("name", ["", "fast", "dart", "quick"])
def test_environment_variable(name: str) -> None:
    code = "import pydart2; print(pydart2.World(0.1).constraint_solver(), pydart2.engine_info().solver)"
    environment = os.environ | {"PYDART2_SOLVER": name}
    done = subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, text=True)
    if name == "quick":
        assert "ValueError: environment variable PYDART2_SOLVER: no constraint solver 'quick'" in done.stderr
    else:
        assert done.stdout.split() == [name or "fast"] * 2


def test_check_collision_without_a_step() -> None:
    """The contact forces of a state, the same as the next step's, and the state stays."""
    world = skel("cubes")
    world.step(1500)
    before = world.x
    world.check_collision()
    found = {solver: None for solver in ("fast", "dart")}
    for solver in found:
        world.set_constraint_solver(solver)
        world.check_collision()
        found[solver] = [contact.f.tolist() for contact in world.collision_result.contacts]
    assert found["fast"] == found["dart"] != []
    np.testing.assert_array_equal(world.x, before)


def test_threads() -> None:
    """Worlds that step at the same time do as they do one after the other."""
    with ThreadPoolExecutor(2) as pool:
        together = list(pool.map(lambda _: results(skel("fullbody1"), 300), range(2)))
    assert together == [results(skel("fullbody1"), 300)] * 2


def test_contact_reduction_keeps_the_sum_of_forces() -> None:
    """Atlas stands on four contacts a foot instead of nine, and they bear its weight."""
    world = standing_atlas()
    assert not world.contact_reduction()
    world.set_contact_reduction(True)
    world.step(500)
    robot = world.skeletons[-1]
    forces = []
    for _ in range(200):
        world.step()
        bearing = [contact for contact in world.collision_result.contacts if np.any(contact.f)]
        assert len(world.collision_result.contacts) > len(bearing) > 4
        assert len(bearing) <= 8
        forces.append(sum(abs(contact.f[1]) for contact in bearing))
    assert np.mean(forces) == pytest.approx(9.81 * robot.m, rel=0.01)


@pytest.mark.parametrize("solver", ["fast", "dart", "iterative"])
def test_contact_reduction_keeps_the_corners(solver: str) -> None:
    world = pydart2.World(0.002, up="z")
    world.add_box([4.0, 4.0, 1.0], None, [0.0, 0.0, -0.5], fixed=True)
    world.add_box([1.0, 0.6, 0.2], 1.0, [0.0, 0.0, 0.1])
    world.set_constraint_solver(solver)
    world.set_contact_reduction(True)
    world.step(50)
    bearing = {tuple(contact.p[:2].round(3)) for contact in world.collision_result.contacts if np.any(contact.f)}
    assert bearing == {(-0.5, -0.3), (-0.5, 0.3), (0.5, -0.3), (0.5, 0.3)}


def test_reduced_contacts_do_not_depend_on_the_solver() -> None:
    worlds = [standing_atlas() for _ in range(2)]
    for world, name in zip(worlds, ("fast", "dart")):
        world.set_contact_reduction(True)
        world.set_constraint_solver(name)
        assert world.contact_reduction()
    assert results(worlds[0], 50) == results(worlds[1], 50)


def warm(world: pydart2.World) -> pydart2.World:
    world.set_warm_start(True)
    return world


@pytest.mark.parametrize(
    "make", [standing_atlas, held_cubes, lambda: skel("fullbody1")], ids=["Atlas", "cubes", "fullbody1"]
)
def test_warm_start_gives_the_engines_forces_to_rounding(make: Callable[[], pydart2.World]) -> None:
    """In each step from the engine's own state: of four hundred, the forces of all contacts."""
    ours, engine = warm(make()), make()
    engine.set_constraint_solver("dart")
    bearing = 0
    for _ in range(400):
        ours.x = engine.x
        ours.step()
        engine.step()
        forces, expected = (world.collision_result.rows[:, 3:6] for world in (ours, engine))
        assert np.abs(forces - expected).max(initial=0.0) <= 1e-6 * np.abs(expected).max(initial=1.0)
        bearing += len(expected)
    assert bearing > 400


def test_warm_start_is_kept_and_restored() -> None:
    """A clone has the option; after restore() the steps are those that followed the snapshot, bit by bit."""
    world = warm(standing_atlas())
    world.set_collision_detector(world.BULLET_COLLISION_DETECTOR)
    world.step(100)
    snapshot = world.snapshot()
    twin = world.clone()
    after = results(world, 50)
    world.restore(snapshot)
    assert twin.warm_start()
    assert results(world, 50) == results(twin, 50) == after
    world.set_warm_start(False)
    assert not world.warm_start()


def test_what_warm_start_remembers_is_in_a_snapshot(tmp_path: Path) -> None:
    """Without ``exact``, with a detector that has no memory of its own; a snapshot is checked before it is taken."""
    world = warm(skel("cubes"))
    world.set_collision_detector(world.DART_COLLISION_DETECTOR)
    before = world.snapshot()
    world.step(300)
    snapshot = world.snapshot()
    contacts = len(world.collision_result.contacts)
    remembered = snapshot.values[len(before.values) :]
    assert len(remembered) >= 6 * contacts  # three rows of each contact, twice, and the sizes of the groups
    twin = world.clone()
    after = results(world, 50)
    world.reset()
    assert len(world.snapshot().values) == len(before.values)
    world.restore(snapshot)
    assert world.snapshot() == snapshot
    assert results(world, 50) == results(twin, 50) == after

    path = tmp_path / "warm.npz"
    for damaged in (snapshot.values[:-1], np.append(snapshot.values, 3.0)):
        Snapshot(damaged.copy(), np.array(snapshot.contacts), snapshot.model).save(path)
        state = world.snapshot()
        with pytest.raises(ValueError, match="warm start"):
            world.restore(Snapshot.load(path))
        assert world.snapshot() == state
    world.set_warm_start(False)
    with pytest.raises(ValueError, match="the snapshot needs"):
        world.restore(snapshot, strict=False)


def test_engine_info() -> None:
    info = pydart2.engine_info()
    assert info.dart.startswith("6.")
    assert info.solver == os.environ.get("PYDART2_SOLVER", "fast")
    assert info.dynamics == os.environ.get("PYDART2_DYNAMICS", "fast")
    if info.prefix == "/usr":
        assert info.assertions, "Debian builds DART with its assertions"
