"""Worlds."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

import pydart2
from oracle.models import dart_model
from pydart2 import World
from pydart2.collision_result import CollisionResult
from pydart2.recording import Recording

from .table import row, rows

FREE_FALL = -9.81 * 0.001  # speed after one step of 1 ms


@row("world.World")
def test_constructor(tmp_path: Path) -> None:
    world = World(0.002, "./data/skel/cubes.skel")
    assert (world.dt, world.num_skeletons(), world.t, world.frame, world.num_frames()) == (0.002, 4, 0.0, 0, 1)
    assert_allclose(world.g, [0, -9.81, 0])
    empty = World(0.001)
    assert (empty.num_skeletons(), empty.num_frames()) == (0, 1)
    assert_allclose(empty.g, [0, -9.81, 0])
    with pytest.raises(pydart2.LoadError):
        World(0.001, tmp_path / "missing.skel")


@rows(
    "world.World.", {f"{name}_COLLISION_DETECTOR": (i, name) for i, name in enumerate(("DART", "FCL", "BULLET", "ODE"))}
)
def test_detector_constant(cubes: World, case: tuple[int, str]) -> None:
    number, name = case
    assert getattr(World, f"{name}_COLLISION_DETECTOR") == number
    cubes.set_collision_detector(number)
    assert cubes.collision_detector() == number
    assert cubes.collision_detector_string() == f"{name}_COLLISION_DETECTOR"


@row("world.World.CLASS_SKELETON")
def test_class_of_skeletons() -> None:
    class Robot(pydart2.Skeleton):
        pass

    class Lab(World):
        CLASS_SKELETON = Robot

    assert World.CLASS_SKELETON is pydart2.Skeleton
    assert [type(skel) for skel in Lab(0.001, "./data/skel/cubes.skel").skeletons] == [Robot] * 4


@row("world.World.id")
def test_ids_differ() -> None:
    first, second = World(0.001), World(0.001)
    assert second.id == first.id + 1


@row("world.World.skeletons", "world.World.num_skeletons")
def test_skeletons(cubes: World) -> None:
    assert [skel.name for skel in cubes.skeletons] == ["ground skeleton", "box skeleton", "skeleton_2", "skeleton_3"]
    assert cubes.num_skeletons() == len(cubes.skeletons) == 4


@row("world.World.control_skel", "world.World.skel")
def test_control_skel(cubes: World) -> None:
    assert cubes.control_skel is None and cubes.skel is None
    cubes.control_skel = cubes.skeletons[-1]
    assert cubes.skel is cubes.skeletons[-1]


@row("world.World.destroy")
def test_destroy(cubes: World) -> None:
    skel = cubes.skeletons[1]
    cubes.destroy()
    for use in (cubes.step, lambda: cubes.t, lambda: skel.q, lambda: skel.bodynodes[0].C):
        with pytest.raises(pydart2.DestroyedError):
            use()


@row("world.World.add_skeleton")
def test_add_skeleton() -> None:
    class Robot(pydart2.Skeleton):
        pass

    world = World(0.001)
    atlas = world.add_skeleton("./data/sdf/atlas/atlas_v3_no_head.sdf")
    arm = world.add_skeleton(dart_model("urdf/KR5/KR5 sixx R650.urdf"), Robot)
    actor = world.add_skeleton(dart_model("vsk/Nick01.vsk"))
    assert [atlas.ndofs, arm.ndofs > 5, actor.ndofs > 30] == [33, True, True]
    assert world.skeletons == [atlas, arm, actor]
    assert [skel.id for skel in world.skeletons] == [0, 1, 2]
    assert (type(atlas), type(arm)) == (pydart2.Skeleton, Robot)
    with pytest.raises(pydart2.LoadError):
        world.add_skeleton("missing.urdf")


@row("world.World.add_skeleton_from_id")
def test_add_skeleton_from_id(cubes: World) -> None:
    again = cubes.add_skeleton_from_id(2)
    again.set_positions(np.full(6, 0.5))
    assert_allclose(cubes.skeletons[2].q, 0.5)
    assert cubes.skeletons[-1] is again


@row("world.World.time", "world.World.t")
def test_time(cubes: World) -> None:
    assert cubes.t == cubes.time() == 0
    cubes.step(3)
    assert cubes.t == cubes.time() == pytest.approx(0.003)


@row("world.World.time_step", "world.World.dt", "world.World.set_time_step")
def test_time_step(cubes: World) -> None:
    cubes.set_time_step(0.002)
    assert cubes.dt == cubes.time_step() == 0.002
    cubes.dt = 0.004
    cubes.step()
    assert cubes.t == pytest.approx(cubes.time_step()) == 0.004
    with pytest.raises(ValueError):
        cubes.dt = 0.0


@row("world.World.frame")
def test_frame(cubes: World) -> None:
    cubes.step(3)
    cubes.set_frame(1)
    assert cubes.frame == 3
    cubes.reset()
    assert cubes.frame == 0


@row("world.World.num_frames", "world.World.nframes")
def test_num_frames(cubes: World) -> None:
    cubes.step(3)
    assert cubes.num_frames() == cubes.nframes == 4
    cubes.disable_recording()
    assert cubes.num_frames() == cubes.nframes == 0


@row("world.World.set_frame")
def test_set_frame(cubes: World) -> None:
    states = [cubes.x]
    for _ in range(20):
        cubes.step()
        states.append(cubes.x)
    cubes.reset()
    for _ in range(20):
        cubes.step()
    assert cubes.set_frame(10) is True
    assert_allclose(cubes.x, states[10], atol=1e-12)
    assert cubes.collision_result.num_contacts() > 0
    assert cubes.set_frame(0) and cubes.collision_result.num_contacts() == 0
    assert (cubes.t, cubes.frame) == (pytest.approx(0.02), 20)
    assert cubes.set_frame(21) is False
    cubes.disable_recording()
    assert cubes.set_frame(0) is False


@row("world.World.reset")
def test_reset(cubes: World) -> None:
    start, result = cubes.x, cubes.collision_result
    box = cubes.skeletons[1]
    cubes.step(20)
    box.set_forces(np.full(6, 100.0))
    box.bodynodes[0].add_ext_force([0, 500.0, 0])
    cubes.reset()
    assert_allclose(cubes.x, start)
    assert (cubes.t, cubes.frame, cubes.num_frames()) == (0, 0, 1)
    assert cubes.collision_result is not result and cubes.collision_result.num_contacts() == 0
    assert_allclose(box.ddq, 0)
    cubes.step()
    assert cubes.skeletons[3].dq[4] == pytest.approx(FREE_FALL)
    assert abs(box.dq[4]) < 0.02  # the old forces would make it 0.6


@row("world.World.step")
def test_step(cubes: World) -> None:
    cube = cubes.skeletons[3]
    cubes.step()
    assert (cubes.frame, cubes.t, cubes.num_frames()) == (1, 0.001, 2)
    assert cube.dq[4] == pytest.approx(FREE_FALL)
    cube.set_forces([0, 0, 0, cube.m, 0, 0])
    cubes.step()
    assert cube.dq[3] == pytest.approx(0.001)
    cubes.step()  # the force was for one step
    assert cube.dq[3] == pytest.approx(0.001)

    class Lift:
        def compute(self) -> np.ndarray:
            return cube.m * np.array([0, 0, 0, 0, 9.81, 0])

    cube.set_controller(Lift())
    before = cube.dq[4]
    cubes.step(5)
    assert cube.dq[4] == pytest.approx(before)


@row("world.World.check_collision")
def test_check_collision(cubes: World) -> None:
    before = cubes.x
    cubes.check_collision()
    assert cubes.collision_result.num_contacts() > 0
    assert cubes.t == 0
    assert_allclose(cubes.x, before)


@row("world.World.states", "world.World.x", "world.World.set_states")
def test_states(cubes: World) -> None:
    expected = np.concatenate([part for skel in cubes.skeletons for part in (skel.q, skel.dq)])
    assert_allclose(cubes.states(), expected)
    assert_allclose(cubes.x, expected)
    assert cubes.x.shape == (36,)
    cubes.set_states(expected + 0.25)
    assert_allclose(cubes.skeletons[2].dq, expected[18:24] + 0.25)
    cubes.x = expected
    assert_allclose(cubes.skeletons[2].dq, expected[18:24])
    assert World(0.001).x.shape == (0,)


@row("world.World.gravity", "world.World.g", "world.World.set_gravity")
def test_gravity(cubes: World) -> None:
    assert_allclose(cubes.gravity(), [0, -9.81, 0])
    cubes.set_gravity([1, 2, 3])
    assert_allclose(cubes.g, [1, 2, 3])
    cubes.g = (4.0, 0, 0)
    cubes.step()
    assert_allclose(cubes.gravity(), [4, 0, 0])
    assert cubes.skeletons[3].dq[3] == pytest.approx(0.004)


@row("world.World.remove_all_constraints", "constraints.BallJointConstraint.add_to_world")
def test_constraints(cubes: World) -> None:
    def gap(hold: bool) -> float:
        cubes.reset()
        a, b = cubes.skeletons[2].bodynodes[0], cubes.skeletons[3].bodynodes[0]
        if hold:
            pydart2.constraints.BallJointConstraint(a, b, b.C).add_to_world(cubes)
        point = a.to_local(b.C)
        cubes.skeletons[3].dq = [0, 0, 0, 0.5, 0, 0]
        cubes.step(20)
        return float(np.linalg.norm(a.to_world(point) - b.C))

    free = gap(hold=False)
    assert free > 0.005
    assert gap(hold=True) < 0.2 * free
    cubes.remove_all_constraints()
    assert gap(hold=False) == pytest.approx(free)


@row("world.World.set_collision_detector", "world.World.collision_detector", "world.World.collision_detector_string")
def test_collision_detector(cubes: World) -> None:
    for number in (World.BULLET_COLLISION_DETECTOR, World.DART_COLLISION_DETECTOR):
        cubes.set_collision_detector(number)
        cubes.reset()
        cubes.step(10)
        assert cubes.collision_detector() == number
        assert cubes.collision_result.num_contacts() > 0
    assert cubes.collision_detector_string() == "DART_COLLISION_DETECTOR"
    with pytest.raises(ValueError):
        cubes.set_collision_detector(7)


@row("world.World.is_recording", "world.World.set_recording")
def test_set_recording(cubes: World) -> None:
    assert cubes.is_recording() is True
    cubes.step(2)
    cubes.set_recording(False)
    assert (cubes.is_recording(), cubes.num_frames(), cubes.recording) == (False, 0, None)
    cubes.set_recording(True)
    assert (cubes.is_recording(), cubes.num_frames()) == (True, 1)


@row("world.World.enable_recording", "world.World.disable_recording")
def test_enable_recording(cubes: World) -> None:
    cubes.disable_recording()
    cubes.step(5)
    assert cubes.num_frames() == 0
    cubes.enable_recording()
    cubes.step(2)
    assert cubes.num_frames() == 3


@row("world.World.recording")
def test_recording(cubes: World) -> None:
    assert isinstance(cubes.recording, Recording)
    assert cubes.recording.num_frames() == 1


@row("world.World.collision_result")
def test_collision_result(cubes: World) -> None:
    result: Any = cubes.collision_result
    assert isinstance(result, CollisionResult) and result.num_contacts() == 0
    cubes.step(10)
    assert cubes.collision_result is result and result.num_contacts() > 0


@row("world.World.__repr__")
def test_repr(cubes: World) -> None:
    cubes.step(2)
    assert repr(cubes) == f"[World ID:{cubes.id} time:0.0020 # frames: 3]"
