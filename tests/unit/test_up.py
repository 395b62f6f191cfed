"""Which way is up: worlds, grounds, pictures, and the one warning."""

from __future__ import annotations

import copy
import pickle
from pathlib import Path

import numpy as np
import pytest

import pydart2
from physics.models import creature, save_skeleton
from pydart2.gui.draw_list import from_world
from pydart2.gui.first_look import open_world
from pydart2.simulation.up import up_of

ATLAS = "sdf/atlas/atlas_v3_no_head.sdf"
X, Y, Z = np.eye(3)
PENDULUM = """<robot name="p"><link name="l"><inertial><mass value="1"/>
  <inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
  <visual><geometry><box size="0.2 0.2 0.4"/></geometry></visual>
  <collision><geometry><box size="0.2 0.2 0.4"/></geometry></collision></link></robot>"""
SDF_WORLD = (
    """<sdf version="1.4"><world name="w"><physics name="p" type="ode"><gravity>{0}</gravity></physics></world></sdf>"""
)
WARNING = 'the models are z-up, gravity is along -y: World(dt, up="z")'


def test_a_world_is_y_up_unless_told() -> None:
    assert pydart2.World(0.001).up.tolist() == [0.0, 1.0, 0.0]
    for axis, unit in (("x", X), ("y", Y), ("z", Z)):
        world = pydart2.World(0.001, up=axis)
        np.testing.assert_array_equal(world.up, unit)
        np.testing.assert_array_equal(world.gravity(), -9.81 * unit)
    with pytest.raises(ValueError, match="no axis 'Z' in up: x, y or z"):
        pydart2.World(0.001, up="Z")


def test_up_follows_gravity_where_nobody_chose() -> None:
    world = pydart2.World(0.001)
    world.set_gravity([3.0, 0.0, -4.0])
    np.testing.assert_allclose(world.up, [-0.6, 0.0, 0.8])
    chosen = pydart2.World(0.001, up="z")
    chosen.set_gravity([3.0, 0.0, -4.0])
    np.testing.assert_array_equal(chosen.up, Z)
    chosen.up[0] = 7.0  # a copy
    np.testing.assert_array_equal(chosen.up, Z)


def test_copies_know_it_too() -> None:
    world = pydart2.World(0.001, up="z")
    world.set_gravity([0.0, 0.0, 0.0])
    world.add_skeleton(PENDULUM)
    copies = [world.clone(), copy.deepcopy(world), pickle.loads(pickle.dumps(world)), *pydart2.Batch(world, 2).worlds]
    for one in copies:
        np.testing.assert_array_equal(one.up, Z)
    unasked = pydart2.World(0.001)
    unasked.add_skeleton(PENDULUM)
    for one in (unasked, pickle.loads(pickle.dumps(unasked))):
        np.testing.assert_array_equal(one.up, Y)
        np.testing.assert_array_equal(up_of(one), Z)


def test_a_file_brings_its_own() -> None:
    world = pydart2.World(0.001, SDF_WORLD.format("0 0 -3"))
    np.testing.assert_array_equal(world.up, Z)
    np.testing.assert_array_equal(pydart2.World(0.001, SDF_WORLD.format("0 0 -3"), up="z").gravity(), -3.0 * Z)
    with pytest.raises(ValueError, match="up='y' is against the file's gravity"):
        pydart2.World(0.001, SDF_WORLD.format("0 0 -3"), up="y")
    with pytest.raises(ValueError, match="up='z' is against the file's gravity"):
        pydart2.World(0.001, "skel/cubes.skel", up="z")
    np.testing.assert_array_equal(pydart2.World(0.001, SDF_WORLD.format("0 0 0"), up="x").gravity(), 0.0 * X)
    np.testing.assert_array_equal(pydart2.World(0.001, PENDULUM, up="z").gravity(), -9.81 * Z)


def test_the_ground_is_level() -> None:
    world = pydart2.World(0.001, up="z")
    ground = world.add_ground(0.5)
    np.testing.assert_allclose(ground.body(0).com(), [0.0, 0.0, 0.0], atol=1e-12)  # 1 m thick, its top at 0.5 m
    box = world.add_box((0.2, 0.2, 0.2), position=(0.0, 0.0, 0.7))
    world.step(1000)
    assert box.C[2] == pytest.approx(0.6, abs=1e-3)


def test_pictures_show_robots_upright() -> None:
    world = pydart2.World(0.001)
    np.testing.assert_array_equal(up_of(world), Y)
    world.add_skeleton(PENDULUM)
    np.testing.assert_array_equal(from_world(world).up, Z)
    np.testing.assert_array_equal(world.gravity(), -9.81 * Y)  # which nothing but the user changes
    world.set_gravity([0.0, -9.81, 0.0])
    np.testing.assert_array_equal(up_of(world), Y)


def test_pictures_of_y_up_models_are_y_up(tmp_path: Path) -> None:
    world = pydart2.World(0.001)
    world.add_skeleton(save_skeleton(tmp_path, creature()))
    world.add_skeleton(PENDULUM)
    np.testing.assert_array_equal(up_of(world), Y)
    floating = pydart2.World(0.001, PENDULUM)
    floating.set_gravity([0.0, 0.0, 0.0])
    np.testing.assert_array_equal(floating.up, Z)


@pytest.mark.parametrize("ground", [False, True])
def test_the_first_step_warns_once(ground: bool, caplog: pytest.LogCaptureFixture) -> None:
    world = pydart2.World(0.001)
    if ground:
        world.add_ground(-1.0)
    world.add_skeleton(PENDULUM)
    assert WARNING not in caplog.text
    world.step()
    assert [record.getMessage() for record in caplog.records] == [WARNING]
    world.add_skeleton(PENDULUM)
    world.step(3)
    assert len(caplog.records) == 1


def test_who_chose_is_not_warned(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    asked, zup, mixed = pydart2.World(0.001), pydart2.World(0.001, up="z"), pydart2.World(0.001)
    asked.g = [0.0, -9.81, 0.0]
    mixed.add_skeleton(save_skeleton(tmp_path, creature()))
    for world in (asked, zup, mixed, pydart2.World(0.001, "skel/cubes.skel")):
        world.add_skeleton(PENDULUM)
        world.step()
    assert WARNING not in caplog.text


def test_programs_that_look_at_a_file_stand_it_on_a_ground(tmp_path: Path) -> None:
    model = tmp_path / "box.urdf"
    model.write_text(PENDULUM)
    world = open_world(model, ground=True)
    np.testing.assert_array_equal(world.up, Z)
    assert [skel.name for skel in world.skeletons] == ["p", "ground"]
    world.step(500)
    assert abs(world.skeletons[0].C[2]) < 1e-3
    assert len(open_world(model).skeletons) == 1
    cubes = open_world("skel/cubes.skel", ground=True)  # has a ground of its own
    assert len(cubes.skeletons) == len(pydart2.World(0.001, "skel/cubes.skel").skeletons)
