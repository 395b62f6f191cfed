"""Shapes that move, change, leave the range or come broken from a file: a step works or says why, with any detector."""

from __future__ import annotations

import gc
import logging
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

import pydart2

DETECTORS = ["ode", "fcl", "bullet", "dart", "native"]


@pytest.fixture(params=DETECTORS)
def world(request: pytest.FixtureRequest) -> Iterator[pydart2.World]:
    world = pydart2.World(0.001)
    world.set_collision_detector(request.param)
    world.add_box([0.2, 0.2, 0.2], 1.0, [0.0, 0.3, 0.0])
    yield world
    del world
    gc.collect()  # a detector that is broken ends the process here


def plane(world: pydart2.World) -> pydart2.shape.PlaneShape:
    body = world.add_empty_skeleton("floor").add_body("floor", joint="weld")
    shape = body.add_plane([0.0, 1.0, 0.0], 0.0).shape
    assert isinstance(shape, pydart2.shape.PlaneShape)
    return shape


def test_a_plane_that_moves(world: pydart2.World) -> None:
    floor = plane(world)
    for i in range(5):
        floor.set_offset(0.01 * i)
        world.step(2)
        floor.set_normal([0.1 * i, 1.0, 0.0])
        world.step(2)
    assert np.isfinite(world.x).all()


@pytest.mark.parametrize("offset", [-0.05, 0.02])
def test_a_box_rests_on_a_plane_where_it_was_moved(offset: float) -> None:
    world = pydart2.World(0.001)
    world.set_collision_detector("ode")
    box = world.add_box([0.2, 0.2, 0.2], 1.0, [0.0, 0.15, 0.0])
    floor = plane(world)
    world.step(10)
    floor.set_offset(offset)
    world.step(800)
    assert box.bodynodes[0].com()[1] == pytest.approx(offset + 0.1, abs=2e-3)


@pytest.mark.parametrize("far", [1e13, 1e20, 1e29])
def test_a_shape_out_of_range_is_named_and_can_come_back(world: pydart2.World, far: float) -> None:
    node = world.skeletons[0].bodynodes[0].shapenodes[-1]
    node.set_offset([far, 0.0, 0.0])
    for call in (world.step, world.check_collision):
        with pytest.raises(pydart2.SimulationError, match="a shape of body 'box' of skeleton 'box' is 1e"):
            call()
    world.reset()
    node.set_offset([0.0, 0.0, 0.0])
    world.step(3)
    world.clone().step()
    assert world.t == pytest.approx(0.003)


@pytest.mark.parametrize("size", [1e-30, 1e-12, 1e9, 1e29])
def test_sizes_beyond_all_reason(world: pydart2.World, size: float) -> None:
    shape = world.skeletons[0].bodynodes[0].shapenodes[-1].shape
    world.add_ground()
    shape.set_size([size] * 3)  # type: ignore[attr-defined]
    for call in (world.step, world.check_collision):
        try:
            call()
        except pydart2.SimulationError:
            world.reset()
    shape.set_size([0.2] * 3)  # type: ignore[attr-defined]
    world.reset()
    world.step(300)
    assert np.isfinite(world.x).all()


CORNERS = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
TRIANGLES = "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
LINK = """<robot name="r"><link name="l">
<inertial><mass value="1"/><inertia ixx="0.01" iyy="0.01" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial>
<collision><geometry><mesh filename="{mesh}"/></geometry></collision></link></robot>"""


def robot_with(folder: Path, obj: str, name: str = "mesh") -> str:
    mesh = folder / f"{name}.obj"
    mesh.write_text(obj)
    return LINK.format(mesh=mesh)


@pytest.mark.parametrize(
    "more",
    ["f 1 2\n", "l 1 2\n", "p 1\n", "v nan 0 0\nf 5 2 3\n", "v 1e39 0 0\nf 5 2 3\n"],
    ids=["edge", "line", "point", "nan", "inf"],
)
@pytest.mark.parametrize("safe", [True, False])
def test_what_is_no_triangle_is_left_out(
    world: pydart2.World, tmp_path: Path, caplog: pytest.LogCaptureFixture, more: str, safe: bool
) -> None:
    caplog.set_level(logging.WARNING)
    name = f"{world.collision_detector_string()} {safe} {more.split()}"  # of equal messages only the first are logged
    robot = world.add_skeleton(robot_with(tmp_path, CORNERS + TRIANGLES + more, name), safe=safe)
    told = any("1 of 5 faces are left out" in text for text in caplog.messages)
    assert told == (more[0] not in "lp")  # the importer leaves lines and points of this format out by itself
    world.add_box([4.0, 0.2, 4.0], 1e3, [0.0, -0.11, 0.0])
    world.step(30)
    assert np.isfinite(world.x).all()
    assert np.max(robot.bodynodes[0].shapenodes[0].shape.bounding_box()) == pytest.approx(1.0)


@pytest.mark.parametrize("obj", ["v 0 0 0\nv 1 0 0\nl 1 2\n", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"])
def test_a_mesh_without_a_triangle_is_refused(tmp_path: Path, obj: str) -> None:
    world = pydart2.World(0.001)
    for safe in (True, False):
        with pytest.raises(pydart2.LoadError, match="mesh"):
            world.add_skeleton(robot_with(tmp_path, obj), safe=safe)
    assert world.skeletons == []


@pytest.mark.parametrize("detector", DETECTORS)
@pytest.mark.parametrize("soft", [False, True])
def test_a_ball_on_the_axis_of_a_cylinder(detector: str, soft: bool) -> None:
    """ODE finds a contact there whose normal is NaN, with which the engine ended the process."""
    world = pydart2.World(0.001)
    world.set_collision_detector(detector)
    if soft:
        world.add_soft_ellipsoid((0.3, 0.3, 0.3), 1.0, (0.0, 0.0, 0.0))
    else:
        world.add_sphere(0.01, 1.0, (0.0, 0.0, 0.0))
    world.add_cylinder(0.02, 0.2, 1.0, (0.0, 0.0, 0.0))
    world.check_collision()
    assert np.isfinite(world.collision_result.rows).all()
    world.step(20)
    assert np.isfinite(world.x).all()
