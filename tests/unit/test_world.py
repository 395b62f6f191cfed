"""Worlds: time, states, skeletons, stepping, controllers, collision detectors."""

from __future__ import annotations

from pathlib import Path
from typing import ClassVar

import numpy as np
import pytest

import pydart2
from physics.models import arm, floor, free_body, make_world, pendulum, save_skeleton, slider


def test_empty_world() -> None:
    world = pydart2.World(0.002)
    np.testing.assert_array_equal(world.g, [0, -9.81, 0])
    assert (world.dt, world.t, world.frame, world.num_frames(), world.num_skeletons()) == (0.002, 0, 0, 1, 0)
    assert world.skeletons == [] and world.skel is None and world.control_skel is None
    assert world.x.shape == (0,)
    world.step()
    assert world.collision_result.contacts == []


def test_world_of_a_file(cubes: pydart2.World) -> None:
    """The time step is the argument, the gravity the file's."""
    assert cubes.dt == 0.001
    np.testing.assert_array_equal(cubes.g, [0, -9.81, 0])
    assert [skel.id for skel in cubes.skeletons] == [0, 1, 2, 3]
    assert [skel.world for skel in cubes.skeletons] == [cubes] * 4
    assert pydart2.World(1 / 2000, pydart2.data_path("skel/cubes.skel")).dt == 1 / 2000


def test_create_world(tmp_path: Path) -> None:
    assert pydart2.create_world(0.01).dt == 0.01
    assert pydart2.create_world(0.01, Path(pydart2.data_path("skel/cubes.skel"))).num_skeletons() == 4


def test_time(cubes: pydart2.World) -> None:
    for _ in range(10):
        cubes.step()
    assert cubes.t == cubes.time() == pytest.approx(0.01) and cubes.frame == 10
    cubes.dt = 0.005
    assert cubes.time_step() == 0.005
    cubes.step(2)
    assert cubes.t == pytest.approx(0.02) and cubes.frame == 12
    cubes.t = 3.0
    assert cubes.time() == 3.0
    cubes.reset()
    assert (cubes.t, cubes.frame) == (0, 0)


def test_step_n_is_n_steps(tmp_path: Path) -> None:
    one, many = make_world(tmp_path, arm()), make_world(tmp_path, arm())
    for world in (one, many):
        world.skeletons[0].q = [1.0, 0.5]
    for _ in range(50):
        one.step()
    many.step(50)
    np.testing.assert_array_equal(one.x, many.x)
    many.step(0)
    np.testing.assert_array_equal(one.x, many.x)


def test_step_n_calls_no_overridden_step() -> None:
    class Counting(pydart2.World):
        steps = 0

        def step(self, n: int = 1) -> None:
            self.steps += 1
            super().step(n)

    world = Counting(0.001)
    world.step(7)
    assert (world.steps, world.frame) == (1, 7)


def test_states(tmp_path: Path) -> None:
    world = make_world(tmp_path, arm(), pendulum())
    world.x = [1, 2, 3, 4, 5, 6]
    a, b = world.skeletons
    assert [a.q.tolist(), a.dq.tolist(), b.q.tolist(), b.dq.tolist()] == [[1, 2], [3, 4], [5], [6]]
    a.dq = [7, 8]
    assert world.states().tolist() == [1, 2, 7, 8, 5, 6]
    assert type(world.x) is np.ndarray
    world.x[0] = 100
    assert world.x[0] == 1
    world.set_states(np.zeros(6))
    assert a.x.tolist() == [0] * 4


def test_gravity(tmp_path: Path) -> None:
    world = make_world(tmp_path, free_body())
    world.g = [1, 2, 3]
    assert world.gravity().tolist() == [1, 2, 3]
    world.step()
    np.testing.assert_allclose(world.skeletons[0].dC, 0.001 * np.array([1, 2, 3]))
    world.set_gravity((0, 0, 0))
    world.gravity()[0] = 5
    assert world.g.tolist() == [0, 0, 0]


def test_reset_clears_forces_and_contacts(cubes: pydart2.World) -> None:
    start = cubes.x
    cubes.step(100)
    assert cubes.collision_result.num_contacts() > 0
    cubes.skeletons[1].bodynodes[0].add_ext_force([1000, 0, 0])
    cubes.skeletons[2].tau = [0, 0, 0, 1000, 0, 0]
    cubes.reset()
    np.testing.assert_array_equal(cubes.x, start)
    assert cubes.collision_result.num_contacts() == 0
    cubes.step()
    once = cubes.x
    cubes.reset()
    cubes.step()
    np.testing.assert_array_equal(cubes.x, once)
    assert np.abs(once[len(once) // 2 :]).max() < 1


def test_controllers(tmp_path: Path) -> None:
    class Push:
        calls = 0

        def compute(self) -> list[float]:
            self.calls += 1
            return [6.0]

    world = make_world(tmp_path, slider(2.0), slider(2.0).replace("slider", "other"), gravity=(0, 0, 0))
    controller = Push()
    world.skeletons[0].set_controller(controller)
    world.step()
    world.step(9)
    assert controller.calls == 10
    assert world.skeletons[0].dq[0] == pytest.approx(3.0 * 0.01)
    assert world.skeletons[1].dq[0] == 0
    world.skeletons[0].controller = None
    world.step()
    assert controller.calls == 10


def test_each_controller_acts(tmp_path: Path) -> None:
    world = make_world(tmp_path, slider(1.0), slider(2.0).replace("slider", "second"))
    for skel, force in zip(world.skeletons, (3.0, 8.0), strict=True):
        skel.controller = lambda force=force: [force]  # type: ignore[misc]
    world.step()
    np.testing.assert_allclose([skel.ddq[0] for skel in world.skeletons], [3.0, 4.0])


def test_an_error_in_a_controller_comes_out(tmp_path: Path) -> None:
    class Broken:
        def compute(self) -> list[float]:
            raise ZeroDivisionError("controller")

    world = make_world(tmp_path, slider())
    world.skeletons[0].controller = Broken()
    with pytest.raises(ZeroDivisionError, match="controller"):
        world.step()
    assert world.frame == 0


def test_an_error_in_a_later_step_leaves_the_contacts_of_the_one_before(tmp_path: Path) -> None:
    ball = free_body("ball", at=(0, 0.49, 0, 0, 0, 0), shape="<sphere><radius>0.5</radius></sphere>")
    world, other = (make_world(tmp_path, floor(), ball, slider()) for _ in range(2))

    def compute() -> list[float]:
        if world.frame == 3:
            raise ZeroDivisionError
        return [1.0]

    world.skeletons[2].controller, other.skeletons[2].controller = compute, lambda: [1.0]
    world.step()
    assert len(world.collision_result.rows) > 0  # has been looked at
    with pytest.raises(ZeroDivisionError):
        world.step(5)
    other.step(3)
    np.testing.assert_array_equal(world.collision_result.rows, other.collision_result.rows)


def test_subclass_hooks() -> None:
    """reset() runs inside the constructor; CLASS_SKELETON of a subclass counts."""

    class MySkeleton(pydart2.Skeleton):
        pass

    class MyWorld(pydart2.World):
        CLASS_SKELETON: ClassVar[type[pydart2.Skeleton]] = MySkeleton
        resets = 0

        def reset(self) -> None:
            self.resets += 1
            super().reset()

    world = MyWorld(0.001, pydart2.data_path("skel/cubes.skel"))
    assert world.resets == 1
    assert {type(skel) for skel in world.skeletons} == {MySkeleton}


def test_add_skeleton(tmp_path: Path) -> None:
    class Mine(pydart2.Skeleton):
        pass

    world = make_world(tmp_path, arm())
    skel = world.add_skeleton(save_skeleton(tmp_path, pendulum()), Mine)
    assert type(skel) is Mine and skel.id == 1 and world.skeletons[1] is skel
    assert world.num_skeletons() == 2 and world.x.shape == (6,)
    assert skel.filename == str(tmp_path / "added.skel")
    assert type(world.add_skeleton(str(tmp_path / "added.skel"))) is pydart2.Skeleton


@pytest.mark.parametrize("extension", ["urdf", "URDF", "sdf", "SDF"])
def test_extensions_in_any_case(tmp_path: Path, extension: str) -> None:
    urdf = '<robot name="r"><link name="l"><inertial><mass value="2"/><inertia ixx="1" iyy="1" izz="1" ixy="0" '
    urdf += 'ixz="0" iyz="0"/></inertial></link></robot>'
    sdf = '<sdf version="1.4"><model name="r"><link name="l"><inertial><mass>2</mass></inertial></link></model></sdf>'
    path = tmp_path / f"robot.{extension}"
    path.write_text(urdf if extension.lower() == "urdf" else sdf)
    skel = pydart2.World(0.001).add_skeleton(path)
    assert (skel.name, skel.m, skel.ndofs, skel.joints[0].type()) == ("r", 2.0, 6, "FreeJoint")
    if extension.lower() == "urdf":
        axes = [f"{kind}_{x}" for kind in ("rot", "pos") for x in "xyz"]
        assert [dof.name for dof in skel.dofs] == [f"rootJoint_{axis}" for axis in axes]


def test_same_names_are_told_apart(tmp_path: Path) -> None:
    world = make_world(tmp_path, arm())
    path = save_skeleton(tmp_path, arm())
    names = [world.skeletons[0].name, world.add_skeleton(path).name, world.add_skeleton(path).name]
    assert len(set(names)) == 3


def test_remove_skeleton(tmp_path: Path) -> None:
    world = make_world(tmp_path, arm(), floor(), pendulum())
    first, _, last = world.skeletons
    last.q = [0.5]
    world.remove_skeleton(first)
    assert [skel.id for skel in world.skeletons] == [0, 1] and world.num_skeletons() == 2
    assert last.id == 1 and world.x.tolist() == [0.5, 0.0]
    assert last.bodynodes[0].skid == 1
    world.step()
    assert last.q[0] < 0.5
    with pytest.raises(ValueError, match="is not in"):
        world.remove_skeleton(first)


@pytest.mark.parametrize("detector", (0, 1, 2, 3, 10))
def test_collision_detectors(cubes: pydart2.World, detector: int) -> None:
    names = {0: "DART", 1: "FCL", 2: "BULLET", 3: "ODE", 10: "NATIVE"}
    cubes.set_collision_detector(detector)
    assert cubes.collision_detector() == detector
    assert cubes.collision_detector_string() == f"{names[detector]}_COLLISION_DETECTOR"
    assert getattr(pydart2.World, cubes.collision_detector_string()) == detector
    cubes.step(2000)
    heights = [skel.C[1] for skel in cubes.skeletons[1:3]]
    np.testing.assert_allclose(heights, [-0.325, -0.275], atol=5e-3)  # the plate on the floor, the cube on it


def test_detector_can_change_while_contacts_exist(cubes: pydart2.World) -> None:
    cubes.step(20)
    for detector in (1, 2, 3, 10, 0):
        cubes.set_collision_detector(detector)
        assert cubes.collision_result.num_contacts() >= 0
        cubes.step()
        assert cubes.collision_result.num_contacts() > 0


def test_repr(cubes: pydart2.World) -> None:
    cubes.step(250)
    assert repr(cubes) == f"[World ID:{cubes.id} time:0.2500 # frames: 251]"
    assert repr(cubes.skeletons[2]) == "[Skeleton(2): skeleton_2]"


def test_control_skel(cubes: pydart2.World) -> None:
    cubes.control_skel = cubes.skeletons[1]
    assert cubes.skel is cubes.skeletons[1]


def test_same_world_twice_is_the_same_run() -> None:
    runs = []
    for _ in range(2):
        world = pydart2.World(0.001, pydart2.data_path("skel/cubes.skel"))
        world.step(300)
        runs.append(world.x)
    np.testing.assert_array_equal(*runs)


@pytest.mark.parametrize("detector", (0, 1, 2, 3, 10))
def test_nothing_rests_on_a_removed_ground(detector: int) -> None:
    """Also where the world's detector was chosen, and where something still holds the ground."""
    world = pydart2.World(0.001, pydart2.data_path("skel/cubes.skel"))
    world.set_collision_detector(detector)
    ground = world.skeletons[0]
    world.remove_skeleton(ground)
    bottom = world.skeletons[0].C[1]
    world.step(400)
    assert bottom - world.skeletons[0].C[1] > 0.7  # g t² / 2 = 0.785 m
