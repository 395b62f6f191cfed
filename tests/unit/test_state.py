"""Snapshots, clones and pickles: what is put back goes on bit for bit as it would have."""

from __future__ import annotations

import copy
import itertools
import pickle
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import pytest

import pydart2
from oracle.models import dart_model
from physics.models import (
    arm,
    body,
    box,
    creature,
    floor,
    free_body,
    joint,
    make_world,
    save_skeleton,
    skeleton,
    sphere,
)
from pydart2 import Snapshot

STEPS = 1000
DETECTORS = range(4)
MODELS = ("fullbody1", "soft_cubes")
Changed = Callable[[pydart2.World], None]


def path_of(model: str) -> Path:
    return Path(
        dart_model("skel/soft_cubes.skel") if model == "soft_cubes" else pydart2.data_path(f"skel/{model}.skel")
    )


def moving(model: str, detector: int) -> pydart2.World:
    """A world in the middle of a motion with contacts, and forces that wait for the next step."""
    world = pydart2.World(0.001, path_of(model))
    world.set_collision_detector(detector)
    world.set_recording(False)
    world.step(100)
    for skel in world.skeletons:
        skel.tau = np.linspace(-1, 1, skel.ndofs)
        skel.bodynodes[-1].add_ext_force([0.5, 0.25, 0.125])
    return world


def bits(world: pydart2.World) -> bytes:
    return world.snapshot().values.tobytes() + world.collision_result.rows.tobytes()


@pytest.mark.parametrize("detector", DETECTORS)
@pytest.mark.parametrize("model", MODELS)
def test_the_next_thousand_steps(tmp_path: Path, model: str, detector: int) -> None:
    """Into the same world, a fresh one and another process."""
    world = moving(model, detector)
    start = world.snapshot(exact=True)
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
def test_a_snapshot_is_a_pure_read(model: str, detector: int) -> None:
    plain, watched = moving(model, detector), moving(model, detector)
    plain.step(60)
    for _ in range(60):
        watched.snapshot()
        watched.step()
    assert bits(plain) == bits(watched)


@pytest.mark.parametrize("detector", (0, 3))
def test_two_detectors_need_no_exact_snapshot(detector: int) -> None:
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
    world.step()
    assert snapshot != world.snapshot() and snapshot != "another thing"


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


# Clones


def everything(tmp_path: Path) -> pydart2.World:
    """Skeletons that came with a world and others that were added, and most kinds of joints."""
    text = skeleton(
        body("base", shape=box((0.1, 0.2, 0.3)), at=(3, 0, 0, 0, 0, 0)),
        joint("free", "base", name="base_joint"),
        body("ball", shape=sphere(0.1), at=(3, 1, 0, 0, 0, 0)),
        joint("prismatic", "ball", "base", axis=(0, 1, 0), name="ball_joint"),
        name="extra",
    )
    world = make_world(tmp_path, floor(), creature(), arm(), recording=True)
    world.add_skeleton(save_skeleton(tmp_path, text))
    world.add_skeleton(save_skeleton(tmp_path, creature("euler"), "euler"))
    screw = tmp_path / "screw.sdf"
    screw.write_text(
        '<sdf version="1.4"><model name="screw"><link name="nut"/><joint name="thread" type="screw">'
        "<parent>world</parent><child>nut</child><axis><xyz>0 0 1</xyz></axis><thread_pitch>0.5</thread_pitch></joint>"
        "</model></sdf>"
    )
    world.add_skeleton(screw)
    return world


def equal(one: pydart2.World, two: pydart2.World, steps: int = 50) -> None:
    """They are equal now and stay so."""
    assert one is not two and one.id != two.id
    for world in (one, two):
        world.snapshot(exact=True)
    assert one.snapshot() == two.snapshot()
    for world in (one, two):
        world.step(steps)
    assert bits(one) == bits(two)


def copies(world: pydart2.World) -> list[pydart2.World]:
    return [world.clone(), copy.copy(world), pickle.loads(pickle.dumps(world))]


@pytest.mark.parametrize("detector", DETECTORS)
@pytest.mark.parametrize("model", MODELS)
def test_clones_go_on_as_the_original(model: str, detector: int) -> None:
    world = moving(model, detector)
    clones = [world.clone(exact=True), pickle.loads(pickle.dumps(world)), world._handle.clone()]
    for item in (world, *clones):
        item.step(300)
    assert len({item.states(None).tobytes() for item in (world, *clones)}) == 1


def nested_pairs(one: pydart2.World, two: pydart2.World) -> Iterator[tuple[object, object]]:
    """The handles of two equal worlds, side by side."""
    yield one._handle, two._handle
    for a, b in zip(one.skeletons, two.skeletons, strict=True):
        yield a._handle, b._handle
        for parts in ("bodynodes", "joints", "dofs", "markers"):
            for x, y in zip(getattr(a, parts), getattr(b, parts), strict=True):
                yield x._handle, y._handle
                if hasattr(x, "_soft"):
                    yield x._soft, y._soft
                for node, node2 in zip(getattr(x, "shapenodes", ()), getattr(y, "shapenodes", ()), strict=True):
                    yield node._handle, node2._handle
                    if node.shape is not None:
                        yield node.shape._handle, node2.shape._handle


def another(value: object) -> object:
    """A valid value that is not this one."""
    if isinstance(value, bool):
        return not value
    if isinstance(value, str):
        return {"XYZ": "ZYX", "ZYX": "XYZ", "FORCE": "SERVO", "fcl": "bullet", "dart": "fcl", "fast": "dart"}.get(
            value, value + " 2"
        )
    array = np.asarray(value)
    if array.shape == (4, 4):
        return array @ np.array([[0, -1, 0, 0.1], [1, 0, 0, 0.2], [0, 0, 1, 0.3], [0, 0, 0, 1.0]])
    if array.shape == (3, 3):
        return array * 1.25
    if array.dtype == float and not np.isfinite(array).all():
        return np.where(np.isfinite(array), array, np.sign(array) * 9.5)[()]
    return array * 0.75 + np.linspace(0.1, 0.2, array.size).reshape(array.shape)


def every_kind(tmp_path: Path) -> Iterator[pydart2.World]:
    """Worlds that have, together, every kind of part."""
    yield everything(tmp_path)
    plane = "<plane><normal>0 1 0</normal><offset>-9</offset></plane>"
    yield make_world(tmp_path, skeleton(body("plain", shape=plane), joint("weld", "plain")))
    for model in ("softBodies", "fullbody1"):
        yield pydart2.World(0.001, pydart2.data_path(f"skel/{model}.skel"))
    yield pydart2.World(0.001, dart_model("skel/shapes.skel"))


# The recording is no part of a clone; the state of a skeleton is, and is tested above.
NOT_TRIED = {"set_recording", "set_frame", "set_recording_limit"} | {
    f"set_{name}" for name in ("states", "positions", "velocities", "accelerations", "forces", "commands")
}


def getters(handle: object) -> Iterator[tuple[str, Callable[[], object], Callable[..., object]]]:
    """(name of the setter, getter, setter) for each set_x() of a handle that has an x() or is_x()."""
    for setter in (name for name in dir(handle) if name.startswith("set_") and name not in NOT_TRIED):
        name = setter.removeprefix("set_")
        read = next((g for g in (name, f"is_{name}") if hasattr(handle, g)), None)
        if read is not None:
            yield setter, getattr(handle, read), getattr(handle, setter)


def change_everything(world: pydart2.World) -> dict[tuple[str, str], int]:
    """Call each setter of each handle with another value; counts the calls that were accepted."""
    accepted: dict[tuple[str, str], int] = {}
    for handle, _ in nested_pairs(world, world):
        for name, read, write in getters(handle):
            key = type(handle).__name__, name
            accepted.setdefault(key, 0)
            try:
                write(another(read()), *((True,) if key == ("JointHandle", "set_name") else ()))
                accepted[key] += 1
            except (TypeError, ValueError):
                pass  # a shape without a radius, a joint without an axis
    return accepted


def test_every_setter_survives(tmp_path: Path) -> None:
    """A setter that is added without a line in model.cpp fails here."""
    accepted: dict[tuple[str, str], int] = {}
    for world in every_kind(tmp_path):
        for key, count in change_everything(world).items():
            accepted[key] = accepted.get(key, 0) + count
        for a, b in nested_pairs(world, world.clone()):
            for (name, read, _), (_, read_copy, _) in zip(getters(a), getters(b), strict=True):
                try:
                    want = read()
                except (TypeError, ValueError):
                    continue
                assert np.array_equal(want, read_copy()), (type(a).__name__, name)  # type: ignore[arg-type]
    assert len(accepted) > 50 and [key for key, count in accepted.items() if count == 0] == []


CHANGES: dict[str, Changed] = {
    "masses": lambda w: w.skeletons[1].bodynodes[0].set_mass(3.0),
    "time step and gravity": lambda w: (w.set_time_step(0.002), w.set_gravity([1, -5, 2]))[0],
    "weld": lambda w: w.skeletons[1].set_root_joint_to_weld(),
    "trans and euler": lambda w: w.skeletons[1].set_root_joint_to_trans_and_euler(),
    "both": lambda w: (
        w.skeletons[1].set_root_joint_to_trans_and_euler(),
        w.skeletons[1].set_root_joint_to_weld(),
    )[0],
    "removed first": lambda w: w.remove_skeleton(w.skeletons[0]),
    "removed several": lambda w: (w.remove_skeleton(w.skeletons[3]), w.remove_skeleton(w.skeletons[1]))[0],
    "ignored pair": lambda w: w.collision_filter.add_to_black_list(
        w.skeletons[0].bodynodes[0], w.skeletons[3].bodynodes[0]
    ),
    "flags": lambda w: (w.skeletons[2].set_mobile(False), w.skeletons[4].set_self_collision_check(True))[0],
    "mimic": lambda w: w.skeletons[2].joints[1]._handle.set_mimic(w.skeletons[2].joints[0]._handle, 2.0, 0.1),
    "constraint": lambda w: pydart2.constraints.BallJointConstraint(
        w.skeletons[2].bodynodes[1], w.skeletons[3].bodynodes[0], [0.5, -1.0, 0.2]
    ).add_to_world(w),
}


@pytest.mark.parametrize("change", CHANGES)
def test_changes_survive(tmp_path: Path, change: str) -> None:
    world = everything(tmp_path)
    world.step(5)
    CHANGES[change](world)
    world.step(5)
    for clone in copies(world):
        assert [s.name for s in clone.skeletons] == [s.name for s in world.skeletons]
        assert clone._handle.num_constraints() == world._handle.num_constraints()
        state = world.snapshot(exact=True)
        equal(world, clone)
        world.restore(state)


@pytest.mark.parametrize("seed", range(40))
def test_axes_survive_to_the_last_bit(tmp_path: Path, seed: int) -> None:
    """The engine normalizes again what is normalized already, which changes the last bit of one axis in three."""
    world = make_world(tmp_path, arm())
    axis = np.random.default_rng(seed).normal(size=3)
    for part in world.skeletons[0].joints:
        part.set_axis(axis)
    want = world.skeletons[0].joints[0]._handle.axis()
    assert world.clone().skeletons[0].joints[0]._handle.axis().tobytes() == want.tobytes()


def test_an_engine_without_files(tmp_path: Path) -> None:
    empty = pydart2.World(0.01)
    assert empty.clone().dt == 0.01
    text = pydart2.World(0.002, Path(pydart2.data_path("skel/cubes.skel")).read_text(), xmlstr=True)
    text.step(20)
    equal(text, pickle.loads(pickle.dumps(text)))


def test_recording_goes_on_in_a_clone(tmp_path: Path) -> None:
    world = make_world(tmp_path, arm(), recording=True)
    assert world.recording is not None
    world.recording.limit_bytes = 12345
    world.step(4)
    clone = world.clone()
    assert clone.is_recording() and clone.recording is not None and clone.recording.limit_bytes == 12345
    assert clone.num_frames() == 1 and clone.frame == 4
    clone.step(2)
    assert clone.num_frames() == 3 and world.num_frames() == 5
    world.set_recording(False)
    assert world.clone().recording is None


def test_the_text_travels_along_but_not_the_meshes(tmp_path: Path) -> None:
    """A clone is of the model as it was loaded, whatever has become of the file; meshes are read again."""
    world = make_world(tmp_path, arm())
    data = pickle.dumps(world)
    (tmp_path / "model.skel").unlink()
    for again in (pickle.loads(data), world.clone()):
        np.testing.assert_array_equal(again.states(None), world.states(None))


class Push:
    """A controller that holds on to its skeleton, as they do."""

    def __init__(self, skel: pydart2.Skeleton, gain: float) -> None:
        self.skel = skel
        self.gain = gain

    def compute(self) -> np.ndarray:
        return -self.gain * self.skel.q


class Arm(pydart2.Skeleton):
    """A skeleton with an attribute of its own."""

    colour = "red"


class Task(pydart2.World):
    """A world with a constructor and attributes of its own."""

    def __init__(self, folder: Path, goal: float) -> None:
        super().__init__(0.001, folder / "model.skel")
        self.goal = goal
        self.arm = self.add_skeleton(save_skeleton(folder, arm()), Arm)
        self.arm.colour = "blue"
        self.hand = self.arm.bodynodes[-1]
        self.parts = (self.arm.dofs[0], self.arm.joints[1], self.skeletons[0].bodynodes[0].shapenodes[0].shape)
        self.arm.set_controller(Push(self.arm, 3.0))


def test_subclasses_controllers_and_references(tmp_path: Path) -> None:
    make_world(tmp_path, floor())
    task = Task(tmp_path, 0.5)
    task.control_skel = task.arm
    task.arm.q = [0.4, 0.2]
    task.step(10)
    for clone in copies(task):
        assert type(clone) is Task and clone.goal == 0.5 and type(clone.arm) is Arm and clone.arm.colour == "blue"
        assert clone.arm is clone.skeletons[1] is clone.control_skel and clone.hand is clone.arm.bodynodes[-1]
        assert clone.parts[0] is clone.arm.dofs[0] and clone.parts[1] is clone.arm.joints[1]
        assert clone.parts[2] is clone.skeletons[0].bodynodes[0].shapenodes[0].shape
        controller = clone.arm.controller
        assert isinstance(controller, Push) and controller.skel is clone.arm and controller.gain == 3.0
        state = task.snapshot()
        equal(task, clone)
        task.restore(state)


def test_a_part_brings_its_world(tmp_path: Path) -> None:
    world = make_world(tmp_path, arm(), floor())
    world.step(5)
    skel = world.skeletons[0]
    for part in (skel, skel.bodynodes[1], skel.dofs[0], skel.joints[0], world.collision_result, world.collision_filter):
        other = pickle.loads(pickle.dumps(part))
        assert type(other) is type(part)
        owner = other.world if hasattr(other, "world") else other.skeleton.world
        assert owner is not world and owner.x.tobytes() == world.x.tobytes()


def test_clones_share_nothing(tmp_path: Path) -> None:
    world = everything(tmp_path)
    clone = world.clone()
    model = world._handle.model_numbers().tobytes()
    change_everything(clone)
    assert world._handle.model_numbers().tobytes() == model and world.frame == 0
    for skel in world.skeletons:
        skel.bodynodes[0].set_mass(9.0)
    world.destroy()
    assert all(skel.bodynodes[0].mass() != 9.0 for skel in clone.skeletons)


@pytest.mark.parametrize("data", [{"plan": ["", "x"]}, {"plan": ["", "", "0", ""]}, {"numbers": []}, {"texts": []}])
def test_damaged_blueprints(tmp_path: Path, data: dict[str, list[str]]) -> None:
    handle = make_world(tmp_path, arm())._handle
    parts = {
        "plan": handle.plan(),
        "texts": handle.model_texts(),
        "numbers": handle.model_numbers(),
        "state": handle.snapshot(False),
    }
    parts.update(data)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="of another model"):
        type(handle).rebuild(*parts.values())
    with pytest.raises(TypeError, match="needs a list of str"):
        type(handle).rebuild([1], *itertools.islice(parts.values(), 1, None))  # type: ignore[list-item]
