"""Calls by keyword with the original's names of parameters, for each function whose names once differed."""

from __future__ import annotations

import inspect
import signal
from typing import Any

import numpy as np
import pytest

import pydart2
from pydart2.gui.opengl.renderer import Renderer
from pydart2.gui.opengl.scene import OpenGLScene
from pydart2.gui.pyqt5.side_panel import SidePanel
from pydart2.gui.pyqt5.window import PyQt5Window, signal_handler
from pydart2.utils import colored_text, transformations

QUATERNION = [0.5, 0.5, 0.5, 0.5]
INERTIA = np.diag([1.0, 1.5, 2.0])

#: Where in the zoo, the function, its arguments by name.
CALLS: list[tuple[str, str, dict[str, Any]]] = [
    ("body", "expand_jacobian", {"jacobian": np.zeros((6, 1))}),
    ("body", "set_collidable", {"_isCollidable": False}),
    ("body", "set_gravity_mode", {"_gravityMode": False}),
    ("body", "set_inertia", {"I": INERTIA}),
    ("dof", "set_constraint_impulse", {"_friction": 0.5}),
    ("dof", "set_damping_coefficient", {"_coeff": 0.5}),
    ("dof", "set_initial_position", {"_initial": 0.5}),
    ("dof", "set_initial_velocity", {"_initial": 0.5}),
    ("dof", "set_rest_position", {"_q0": 0.5}),
    ("dof", "set_spring_stiffness", {"_k": 0.5}),
    ("joint", "set_damping_coefficient", {"_index": 0, "_coeff": 0.5}),
    ("joint", "set_rest_position", {"_index": 0, "_q0": 0.5}),
    ("joint", "set_spring_stiffness", {"_index": 0, "_k": 0.5}),
    ("joint", "set_transform_from_child_body_node", {"T": np.eye(4)}),
    ("joint", "set_transform_from_parent_body_node", {"T": np.eye(4)}),
    ("euler", "set_axis_order", {"_axis_order": "ZYX"}),
    ("marker", "set_local_position", {"inv3": [1.0, 2.0, 3.0]}),
    ("spheres", "add_sphere", {"r": 0.1, "pos": [0.0, 0.0, 1.0]}),
    ("plane", "set_normal", {"inv3": [0.0, 0.0, 2.0]}),
    ("skeleton", "set_mobile", {"mobile": False}),
    ("skeleton", "set_velocities", {"_qdot": None}),
]

#: What takes the setting back: getter and value.
READ = {
    "set_collidable": ("is_collidable", False),
    "set_gravity_mode": ("gravity_mode", False),
    "set_inertia": ("inertia", INERTIA),
    "set_damping_coefficient": ("damping_coefficient", 0.5),
    "set_initial_position": ("initial_position", 0.5),
    "set_initial_velocity": ("initial_velocity", 0.5),
    "set_rest_position": ("rest_position", 0.5),
    "set_spring_stiffness": ("spring_stiffness", 0.5),
    "set_constraint_impulse": ("constraint_impulse", 0.5),
    "set_axis_order": ("axis_order", "ZYX"),
    "set_local_position": ("local_position", [1.0, 2.0, 3.0]),
    "set_normal": ("normal", [0.0, 0.0, 1.0]),
    "set_mobile": ("is_mobile", False),
}

#: Those that need a window or a context: their names alone.
NAMES: list[tuple[Any, list[str]]] = [
    (Renderer.bind_texture, ["texture"]),
    (Renderer.delete_textures, ["textures"]),
    (Renderer.mult_matrix, ["m"]),
    (Renderer.mult_matrix_raw, ["m"]),
    (OpenGLScene.set_camera, ["camera_index"]),
    (SidePanel.set_checked, ["name", "value"]),
    (SidePanel.set_text, ["name", "label"]),
    (SidePanel.set_value, ["name", "value"]),
    (PyQt5Window.replace_camera, ["idx", "trackball"]),
    (PyQt5Window.set_capture_dir, ["_capture_dir"]),
    (PyQt5Window.set_capture_rate, ["_capture_rate"]),
]

COLORS = ["red", "green", "yello", "blue", "magenta", "cyan"]


@pytest.fixture
def parts(zoo: pydart2.Skeleton) -> dict[str, Any]:
    def shape(kind: str) -> Any:
        return next(n.shape for b in zoo.bodynodes for n in b.shapenodes if type(n.shape).__name__ == kind)

    return {
        "skeleton": zoo,
        "body": zoo.bodynodes[1],
        "dof": zoo.dofs[0],
        "joint": zoo.joints[1],
        "euler": zoo.joint("euler joint"),
        "marker": zoo.markers[1],
        "spheres": shape("MultiSphereShape"),
        "plane": shape("PlaneShape"),
    }


@pytest.mark.parametrize(
    ("where", "name", "arguments"), CALLS, ids=lambda value: str(value) if isinstance(value, str) else ""
)
def test_a_call_by_keyword(parts: dict[str, Any], where: str, name: str, arguments: dict[str, Any]) -> None:
    part = parts[where]
    if name == "set_velocities":
        arguments = {"_qdot": np.arange(float(part.ndofs))}
    getattr(part, name)(**arguments)
    if name == "set_velocities":
        np.testing.assert_array_equal(part.dq, arguments["_qdot"])
    elif name in READ:
        getter, value = READ[name]
        got = getattr(part, getter)
        got = (got(0) if where == "joint" else got()) if callable(got) else got
        assert got == value if isinstance(value, str) else np.allclose(got, value)


@pytest.mark.parametrize(("function", "names"), NAMES, ids=lambda value: getattr(value, "__qualname__", ""))
def test_the_names(function: Any, names: list[str]) -> None:
    assert list(inspect.signature(function).parameters)[1 : 1 + len(names)] == names


@pytest.mark.parametrize("name", [prefix + color for prefix in ("", "bright_", "dim_") for color in COLORS])
def test_colored_text(name: str) -> None:
    paint = getattr(colored_text, name)
    assert paint(txt="no") == paint("no")


def test_quaternions() -> None:
    t = transformations
    conjugate = t.quaternion_conjugate(quaternion=QUATERNION)
    np.testing.assert_array_equal(conjugate, [0.5, -0.5, -0.5, -0.5])
    np.testing.assert_array_equal(t.quaternion_inverse(quaternion=QUATERNION), conjugate)
    np.testing.assert_array_equal(t.quaternion_multiply(quaternion1=QUATERNION, quaternion0=conjugate), [1, 0, 0, 0])
    assert t.quaternion_real(quaternion=QUATERNION) == 0.5
    np.testing.assert_array_equal(t.quaternion_imag(quaternion=QUATERNION), [0.5] * 3)


def test_the_handler_of_old_scripts(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as end:
        signal_handler(signal=signal.SIGINT, frame=None)
    assert end.value.code == 0 and capsys.readouterr().out
    assert PyQt5Window.GLUT_INITED is False
