"""Clones and pickles are equal to the original in everything, and go on bit for bit as it does."""

from __future__ import annotations

import copy
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
    joint,
    make_world,
    save_skeleton,
    skeleton,
    sphere,
)
from physics.moving import DETECTORS, MODELS, bits, moving
from pydart2.multibody.structure import PARTS
from pydart2.state import model_hash

Changed = Callable[[pydart2.World], None]


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
    clones = [world.clone(), pickle.loads(pickle.dumps(world))]
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


OTHER_NAME = {
    **{"XYZ": "ZYX", "ZYX": "XYZ", "FORCE": "SERVO"},
    **{"fcl": "bullet", "dart": "fcl", "fast": "dart", "engine": "fast"},
}


def another(value: object) -> object:
    """A valid value that is not this one."""
    if isinstance(value, bool):
        return not value
    if isinstance(value, str):
        return OTHER_NAME.get(value, value + " 2")
    if isinstance(value, int):
        return value + 3
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


# The recording is no part of a clone; the state of a skeleton is, and is tested above. The engine's dynamics exclude
# integrators; solver/test_dynamics.py copies them. Bits are read by body: test_collision_groups.py copies them.
NOT_TRIED = {"set_recording", "set_frame", "set_recording_limit", "set_dynamics", "set_collision_bits"} | {
    f"set_{name}"
    for name in ("states", "positions", "velocities", "accelerations", "forces", "last_forces", "commands")
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
                value = "implicit" if name == "set_integrator" else another(read())
                write(value, *((True,) if key == ("JointHandle", "set_name") else ()))
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


def test_no_setter_leaves_the_digest_of_the_model_before(tmp_path: Path) -> None:
    """It is kept until something may have changed."""
    tried = set()
    for world in every_kind(tmp_path):
        for handle, _ in nested_pairs(world, world):
            for name, read, write in getters(handle):
                if (key := (type(handle).__name__, name)) in tried or name == "set_integrator":
                    continue
                model_hash(world._handle)
                try:
                    write(another(read()), *((True,) if key == ("JointHandle", "set_name") else ()))
                except (TypeError, ValueError):
                    continue
                tried.add(key)
                digest = model_hash(world._handle)
                world._handle.remember_model_digest("")
                assert model_hash(world._handle) == digest, key
    assert len(tried) > 50


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
        state = world.snapshot()
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


def test_a_copy_looks_at_its_trees_when_it_is_asked(tmp_path: Path) -> None:
    """A skeleton that others before it have left by then is still itself; one that is gone has nothing to look at."""
    world = make_world(tmp_path, arm(), floor(), creature())
    names = [body.name for body in world.skeletons[2].bodynodes]
    for clone in copies(world):
        gone, _, last = clone.skeletons
        assert not any(part in vars(skel) for skel in clone.skeletons for part in PARTS)
        clone.remove_skeleton(gone)
        assert last.q.skel is last and last.q.tobytes() == world.skeletons[2].q.tobytes() and "dofs" not in vars(last)
        assert [body.name for body in last.bodynodes] == names and last.bodynodes[0].world is clone
        assert all(part in vars(last) for part in PARTS)
        with pytest.raises(pydart2.DestroyedError):
            gone.body(0)


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


@pytest.mark.parametrize(
    "data",
    [
        {"plan": ["", "fcl", "x"]},
        {"plan": ["", "fcl", "", "0", ""]},
        {"plan": ["", "x"]},
        {"numbers": []},
        {"texts": []},
    ],
)
def test_damaged_blueprints(tmp_path: Path, data: dict[str, list[str]]) -> None:
    handle = make_world(tmp_path, arm())._handle
    blueprint = handle.blueprint()
    parts = dict(zip(("plan", "texts", "numbers", "state"), blueprint, strict=True)) | data
    with pytest.raises(ValueError, match=r"of another model|no collision detector 'x'"):
        type(handle).rebuild(tuple(parts.values()))
    with pytest.raises(TypeError, match="plan needs a list of str"):
        type(handle).rebuild(([1], *blueprint[1:]))
    with pytest.raises(TypeError, match="state needs numbers"):
        type(handle).rebuild((*blueprint[:3], "x"))
    with pytest.raises(TypeError, match="needs a tuple of plan, texts, numbers and state"):
        type(handle).rebuild(blueprint[:3])


DAMAGE = """
import contextlib, logging, sys
from pathlib import Path
sys.path.insert(0, sys.argv[1])
import pydart2
from unit.test_clones import everything

logging.disable(logging.CRITICAL)
handle = everything(Path(sys.argv[2]))._handle
plan, texts, numbers, state = handle.blueprint()
for value in (-1.0, float("nan"), 1e300):
    for i in range(len(numbers)):
        damaged = numbers.copy()
        damaged[i] = value
        print(i, value, flush=True)
        with contextlib.suppress(pydart2.PydartError, ValueError):
            type(handle).rebuild((plan, texts, damaged, state)).step(1)
"""


def test_damaged_numbers(tmp_path: Path) -> None:
    """Whichever of them is not what it was, the process lives."""
    command = [sys.executable, "-c", DAMAGE, str(Path(__file__).resolve().parents[1]), str(tmp_path)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, (done.stdout.splitlines()[-1:], done.stderr[-1000:])


def test_a_blueprint_whose_numbers_are_of_another_model(tmp_path: Path) -> None:
    world = make_world(tmp_path, arm(), floor())
    handle = world._handle
    plan, texts, _, state = handle.blueprint()
    world.skeletons[0].set_root_joint_to_weld()
    with pytest.raises(ValueError, match="of another model"):
        type(handle).rebuild((plan, texts, handle.model_numbers(), state))
