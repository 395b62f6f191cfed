"""OpenGLScene: cameras, and the order in which user code is called."""

from __future__ import annotations

from typing import Any

import pytest

from pydart2.gui import OffscreenRenderer, Trackball
from pydart2.gui.opengl.renderer import Renderer
from pydart2.gui.opengl.scene import OpenGLScene


class Window:
    """Notes the cameras that it is told of."""

    def __init__(self) -> None:
        self.told: list[tuple[Any, Trackball, str]] = []

    def add_camera_event(self, scene: OpenGLScene, trackball: Trackball, name: str) -> None:
        self.told.append((scene, trackball, name))


def test_a_new_scene() -> None:
    scene = OpenGLScene(640, 480)
    assert (scene.width, scene.height, scene.window) == (640, 480, None)
    assert isinstance(scene.renderer, Renderer)
    assert scene.num_cameras() == 2 and scene.tb is scene.cameras[0]
    assert repr(scene.cameras[0]) == "Trackball(rot=[-0.152, 0.045, -0.002, 0.987], \ntrans=[0.050, 0.210, -2.500])"
    assert repr(scene.cameras[1]) == "Trackball(rot=[0.535, 0.284, 0.376, 0.701], \ntrans=[0.100, 0.020, -2.770])"


def test_cameras_are_added_chosen_and_replaced(capsys: pytest.CaptureFixture[str]) -> None:
    window = Window()
    scene = OpenGLScene(640, 480, window)
    assert [name for _, _, name in window.told] == ["Camera Y up", "Camera Z up"]
    mine = Trackball(trans=[0, 0, -4.0])
    scene.add_camera(mine, "mine")
    assert window.told[-1] == (scene, mine, "mine")
    assert mine.viewport == (640, 480)
    scene.set_camera(2)
    assert scene.tb is mine
    assert capsys.readouterr().out == ""  # the original says the number each time
    other = Trackball()
    assert scene.replace_camera(2, other) is True
    assert scene.tb is other  # the one in use too
    assert scene.replace_camera(0, mine) is True and scene.tb is other
    assert scene.replace_camera(3, mine) is False
    with pytest.raises(IndexError, match="no camera 3; there are 3"):
        scene.set_camera(3)


def test_user_code_is_called_in_order(renderer: OffscreenRenderer) -> None:
    calls: list[str] = []

    class Sim:
        def render(self) -> None:
            calls.append("render")

        def render_with_ri(self, ri: Renderer) -> None:
            assert ri is renderer.scene.renderer
            calls.append("render_with_ri")

        def draw_with_ri(self, ri: Renderer) -> None:
            calls.append("draw_with_ri")

    renderer.render(Sim())
    assert calls == ["render", "render_with_ri", "draw_with_ri"]


def test_the_camera_in_use_is_the_trackball(renderer: OffscreenRenderer) -> None:
    class Sim:
        def render_with_ri(self, ri: Renderer) -> None:
            self.origin = ri.project(0, 0, 0)

    near, far = Sim(), Sim()
    renderer.render(near, camera=Trackball(trans=[0.5, 0, -2.0]))
    renderer.render(far, camera=Trackball(trans=[0.5, 0, -4.0]))
    assert near.origin[0] - 120 == pytest.approx(2 * (far.origin[0] - 120), rel=1e-5)
    assert near.origin[0] > 120 and near.origin[1] == pytest.approx(90)
