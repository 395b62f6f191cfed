"""GLUTWindow: its own loop, a foreign one, and none at all. Needs an X server: run by test_environments.py."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

import pydart2
from pydart2.gui.display import x_display_answers
from pydart2.gui.glut.window import GLUTWindow, init_glut

needs_x = pytest.mark.skipif(
    os.environ.get("QT_QPA_PLATFORM") != "xcb" or not x_display_answers(),
    reason="needs an X server; test_environments.py runs it with one",
)


class Scripted(GLUTWindow):
    """Calls itself at given idle calls."""

    def __init__(self, sim: Any, script: dict[int, Any]) -> None:
        super().__init__(sim, None)
        self.script = script
        self.calls = 0

    def idle(self) -> None:
        super().idle()
        self.calls += 1
        if self.calls in self.script:
            self.script[self.calls]()


@needs_x
def test_keys_drive_the_simulation_and_run_returns(
    cubes: pydart2.World, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)

    def press(key: bytes) -> Any:
        return lambda: window.keyPressed(key, 0, 0)

    frames: list[int] = []
    script: dict[int, Any] = {10: press(b" "), 110: press(b" "), 120: press(b"c"), 130: press(b"[")}
    script |= {131: lambda: frames.append(window.frame_index), 140: press(b"]"), 150: press(b"]")}
    script |= {151: lambda: frames.append(window.frame_index), 160: press(b"\x1b")}
    window = Scripted(cubes, script)
    window.window_size = (320, 240)
    window.run()
    assert cubes.frame == 100
    assert frames == [99, 0]  # back one; on one, and on from the last to the first
    assert window.capture_index == 1
    with Image.open(tmp_path / "data/captures/capture.0000.png") as image:
        assert image.size == window.window_size
        assert len(np.unique(np.asarray(image).reshape(-1, 3), axis=0)) > 100


@needs_x
def test_drawing_in_a_foreign_window_is_the_headless_picture(cubes: pydart2.World) -> None:
    init_glut("foreign")
    from OpenGL import GL, GLUT

    GLUT.glutInitDisplayMode(GLUT.GLUT_RGBA | GLUT.GLUT_DOUBLE | GLUT.GLUT_DEPTH)
    GLUT.glutInitWindowSize(320, 240)
    number = GLUT.glutCreateWindow(b"foreign")
    GLUT.glutDisplayFunc(lambda: None)
    window = GLUTWindow(cubes, "mine")
    window.initGL(320, 240)
    GLUT.glutMainLoopEvent()
    window.scene.render(cubes)
    pixels = GL.glReadPixels(0, 0, 320, 240, GL.GL_RGB, GL.GL_UNSIGNED_BYTE)
    window.drawGL()
    GLUT.glutDestroyWindow(number)
    shown = np.frombuffer(pixels, np.uint8).reshape(240, 320, 3)[::-1]
    renderer = pydart2.gui.OffscreenRenderer(320, 240, samples=0)
    difference = np.abs(shown.astype(int) - renderer.render(cubes, camera=0))
    assert difference.max() <= 1  # the window's depth buffer has other bits
    assert (difference > 0).mean() < 0.001
    renderer.close()


def test_without_a_display_there_is_an_error_and_not_the_end(
    cubes: pydart2.World, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delenv("DISPLAY", raising=False)
    with pytest.raises(pydart2.PydartError, match=r"DISPLAY is not set; .*pydart2.gui.render"):
        GLUTWindow(cubes, None).run()


def test_mouse_moves_the_camera_without_a_window(cubes: pydart2.World) -> None:
    window = GLUTWindow(cubes, None)
    assert (window.title, window.window_size, window.window) == ("GLUT Window", (1280, 720), None)
    window.motionFunc(5, 5)
    window.mouseLastPos, window._action = [0, 0], "zoom"
    before = list(window.scene.tb.trans)
    window.motionFunc(10, -5)
    assert window.scene.tb.trans[2] - before[2] == pytest.approx(0.15)
    window._action = "translate"
    window.motionFunc(20, 5)
    assert np.subtract(window.scene.tb.trans, before) == pytest.approx([0.1, -0.1, 0.15])
    window._action = "rotate"
    view = window.scene.tb.view
    window.motionFunc(60, 5)
    assert (window.scene.tb.view != view).any()
