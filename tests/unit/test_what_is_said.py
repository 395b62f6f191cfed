"""Sentences in place of puzzles, and old code's ways."""

from __future__ import annotations

import numpy as np
import pytest

import pydart2
from pydart2.gui import OffscreenRenderer
from pydart2.utils.transformations import rotation_matrix

MOMENTS = '<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/>'
LINK = f'<link name="a"><inertial><mass value="1"/>{MOMENTS}</inertial></link>'


@pytest.mark.parametrize("controlled", [False, True])
def test_a_negative_number_of_steps_is_refused(cubes: pydart2.World, controlled: bool) -> None:
    if controlled:
        cubes.skeletons[1].set_controller(lambda: np.zeros(6))
    with pytest.raises(ValueError, match="the number of steps must be zero or positive, got -1"):
        cubes.step(-1)
    cubes.step(0)
    assert cubes.frame == 0


def test_a_function_is_a_controller(cubes: pydart2.World) -> None:
    cube = cubes.skeletons[-1]
    up = np.append(np.zeros(3), -cube.m * cubes.g)
    cube.set_controller(lambda: up)
    height = cube.C[1]
    cubes.step(10)
    assert cube.C[1] == pytest.approx(height, abs=1e-12)
    cube.set_controller(None)
    cubes.step(10)
    assert cube.C[1] < height


@pytest.mark.parametrize("controller", [3, "compute", np.zeros(6), object()])
def test_what_cannot_control_is_refused_at_once(cubes: pydart2.World, controller: object) -> None:
    with pytest.raises(TypeError, match=r"a controller is a function of no arguments, or has compute\(\)"):
        cubes.skeletons[1].set_controller(controller)
    assert cubes.skeletons[1].controller is None


def test_tau_is_a_copy_that_stays(cubes: pydart2.World) -> None:
    cube = cubes.skeletons[1]
    cube.tau = force = np.arange(6.0)
    force[:] = 7.0
    tau = cube.tau
    tau[:] = 8.0
    cubes.step()
    np.testing.assert_array_equal(cube.tau, np.arange(6.0))
    assert cube.tau["joint 1_pos_x"] == 3.0


def test_out_says_what_is_wrong_with_it(cubes: pydart2.World) -> None:
    cube = cubes.skeletons[1]
    locked = np.zeros(6)
    locked.flags.writeable = False
    for out, flaw in (
        (locked, r"got one of shape \(6,\) that may not be written to"),
        (np.zeros(12)[::2], r"got one of shape \(6,\) whose numbers do not follow each other in C order"),
        (np.zeros(6, ">f8"), "needs to be an array of float64|in another byte order"),
        (np.zeros(7), r"of shape \(6,\), got one of shape \(7,\)$"),
    ):
        with pytest.raises((TypeError, ValueError), match=flaw):
            cube.coriolis_and_gravity_forces(out)


@pytest.mark.parametrize("size", [((640, 480), 480), (640, 4.5), ("640", 480)])
def test_a_size_that_is_none(cubes: pydart2.World, size: tuple[object, object]) -> None:
    with pytest.raises(TypeError, match="a picture's width and height are two whole numbers, as 640, 480, not "):
        pydart2.gui.render(cubes, *size)


@pytest.mark.parametrize("camera", [(1, 2, 3), np.eye(4), object(), (640,)])
def test_a_camera_that_is_none(cubes: pydart2.World, camera: object) -> None:
    with pytest.raises(
        ValueError, match=r"a camera is 0, 1, a name as 'front', a Trackball, a Camera or \(pose, field"
    ):
        pydart2.gui.render(cubes, 64, 48, camera)


def test_numbers_in_arrays_of_one_element() -> None:
    """Old code computes sizes and places with column vectors."""

    class Drawn:
        one = staticmethod(lambda number: np.array([number]))

        def draw_with_ri(self, ri) -> None:
            one = self.one
            ri.set_color(1.0, 0.0, 0.0)
            ri.draw_box(one(10.0), one(8.0), [one(20.0), one(20.0)], one(0.3), fill=True)
            ri.draw_circle(one(5.0), center=[one(50.0), 20.0], fill=True)
            ri.draw_arrow([one(5.0), one(40.0)], [40.0, one(40.0)])

        def render_with_ri(self, ri) -> None:
            one = self.one
            ri.set_color(0.0, 0.0, 1.0)
            ri.render_sphere([one(0.0), 0.0, 0.0], one(0.1))
            ri.render_box(np.zeros((3, 1)), [one(0.1), 0.1, 0.1])
            ri.render_cylinder([0.0, one(0.2), 0.0], one(0.1), one(0.2))

    class Plain(Drawn):
        one = staticmethod(float)

        def render_with_ri(self, ri) -> None:
            ri.set_color(0.0, 0.0, 1.0)
            ri.render_sphere([0.0, 0.0, 0.0], 0.1)
            ri.render_box(np.zeros(3), [0.1, 0.1, 0.1])
            ri.render_cylinder([0.0, 0.2, 0.0], 0.1, 0.2)

    renderer = OffscreenRenderer(80, 60)
    picture = renderer.render(Drawn(), camera=0)
    assert (picture == renderer.render(Plain(), camera=0)).all()
    assert picture.std() > 20.0


def test_a_column_is_a_direction() -> None:
    column = rotation_matrix(0.3, np.array([[0.0], [0.0], [1.0]]), np.array([[1.0], [2.0], [3.0]]))
    np.testing.assert_array_equal(column, rotation_matrix(0.3, [0.0, 0.0, 1.0], [1.0, 2.0, 3.0]))


@pytest.mark.parametrize(
    ("before", "codec"),
    [
        ("<!-- made by hand -->\n", "utf-8"),
        ("\n\n<!-- a\nb --> <!-- c -->\n", "latin-1"),
        ("  \n", "utf-8"),
        ("\ufeff", "utf-8"),
        ("\ufeff", "utf-16"),
    ],
)
def test_a_declaration_that_does_not_come_first(before: str, codec: str) -> None:
    text = f'{before}<?xml version="1.0" encoding="{codec}"?>\n<robot name="Jürgen">{LINK}</robot>'
    assert pydart2.World(0.001).add_skeleton(text.encode(codec)).name == "Jürgen"


def test_lines_stay_where_a_declaration_was() -> None:
    text = '<!-- one\ntwo -->\n<?xml version="1.0"?>\n<robot name="x">\n<link/></robot>'
    with pytest.raises(pydart2.LoadError, match="line 5"):
        pydart2.World(0.001).add_skeleton(text)
