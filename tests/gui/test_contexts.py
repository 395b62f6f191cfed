"""The same picture from every context; what is said when there is none; nothing loaded before it is used."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from pydart2.gui import context
from pydart2.gui.context import ContextError, create_context

ROOT = Path(__file__).resolve().parents[2]

DIGESTS = """
import hashlib, pydart2
from pydart2.gui import render
world = pydart2.World(0.001, pydart2.data_path("skel/shapes.skel"))
world.step(40)
pictures = [render(world, 200, 150, mode=mode) for mode in ("rgb", "depth", "segmentation")]
print(*[hashlib.sha256(picture.tobytes()).hexdigest() for picture in pictures])
"""

GLUT = """
import numpy as np, pydart2
from OpenGL import GL, GLUT
GLUT.glutInit([])
GLUT.glutInitDisplayMode(GLUT.GLUT_RGBA | GLUT.GLUT_DOUBLE | GLUT.GLUT_DEPTH)
GLUT.glutInitWindowSize(200, 150)
GLUT.glutCreateWindow(b"test")
from pydart2.gui.opengl.scene import OpenGLScene
from pydart2.gui import OffscreenRenderer, render
world = pydart2.World(0.001, pydart2.data_path("skel/shapes.skel"))
world.step(40)
scene = OpenGLScene(200, 150)
scene.init()
scene.resize(200, 150)
for i in range(2):  # a picture without the window between those of the window
    scene.render(world)
    pixels = GL.glReadPixels(0, 0, 200, 150, GL.GL_RGBA, GL.GL_UNSIGNED_BYTE)
    shown = np.frombuffer(pixels, np.uint8).reshape(150, 200, 4)[::-1, :, :3]
    difference = np.abs(OffscreenRenderer(200, 150, samples=0).render(world, camera=0).astype(int) - shown)
    # The window's own buffer has the channels in another order, and Mesa rounds some colours there the other way.
    assert difference.max() <= 1 and (difference > 0).sum() < 20, (difference.max(), (difference > 0).sum())
    assert shown.std() > 10
print("same")
"""

QT = """
import numpy as np, pydart2
from PyQt5.QtGui import QSurfaceFormat
from PyQt5.QtWidgets import QApplication, QOpenGLWidget
from pydart2.gui import render
from pydart2.gui.opengl.scene import OpenGLScene

world = pydart2.World(0.001, pydart2.data_path("skel/shapes.skel"))
world.step(40)
wanted = QSurfaceFormat()
wanted.setSamples(4)
wanted.setDepthBufferSize(24)
QSurfaceFormat.setDefaultFormat(wanted)

class Widget(QOpenGLWidget):
    def initializeGL(self):
        self.scene = OpenGLScene(200, 150)
        self.scene.init()

    def paintGL(self):
        render(world, 64, 48)  # a picture without the window, while that is being drawn
        self.scene.render(world)

application = QApplication([])
widget = Widget()
widget.resize(200, 150)
widget.show()
for _ in range(5):
    application.processEvents()
shown = widget.grabFramebuffer()
shown = shown.convertToFormat(shown.Format_RGBA8888)
pixels = np.frombuffer(shown.bits().asstring(shown.byteCount()), np.uint8).reshape(150, 200, 4)[:, :, :3]
assert (render(world, 200, 150, camera=0) == pixels).all()
print("same")
"""


def run(code: str, **variables: str) -> str:
    environment = {key: value for key, value in os.environ.items() if key not in ("PYDART2_GL", "PYOPENGL_PLATFORM")}
    environment |= {"PYTHONPATH": str(ROOT), **variables}
    command = [sys.executable, "-c", code]
    done = subprocess.run(command, env=environment, cwd=ROOT, capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr
    return done.stdout.strip()


FORK = """
import os, pydart2
from pydart2.gui import OffscreenRenderer, render
world = pydart2.World(0.001)
render(world, 8, 8)
if (child := os.fork()) == 0:
    errors = []
    for draw in (lambda: render(world, 8, 8), lambda: OffscreenRenderer(8, 8)):
        try:
            draw()
        except pydart2.PydartError as error:
            errors.append("spawn" in str(error))
    raise SystemExit(0 if errors == [True, True] else 1)  # with all that is freed at the end
assert os.waitpid(child, 0)[1] == 0
render(world, 8, 8)
print("told")
"""


def test_a_fork_is_told_instead_of_hanging() -> None:
    assert run(FORK) == "told"


def test_egl_and_osmesa_draw_equal_pixels() -> None:
    assert run(DIGESTS, PYDART2_GL="egl") == run(DIGESTS, PYDART2_GL="osmesa") == run(DIGESTS)


def test_a_qt_window_shows_equal_pixels(tmp_path: Path, display: str) -> None:
    assert run(QT, DISPLAY=display, QT_QPA_PLATFORM="xcb", XDG_RUNTIME_DIR=str(tmp_path)) == "same"


def test_a_glut_window_shows_equal_pixels(display: str) -> None:
    assert run(GLUT, DISPLAY=display) == "same"


def test_an_unknown_way_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PYDART2_GL", "wgl")
    with pytest.raises(ContextError, match="'wgl' is not known; it may be 'egl' or 'osmesa'"):
        create_context()


def test_without_libraries_the_packages_are_named(monkeypatch: pytest.MonkeyPatch) -> None:
    def missing(*names: str) -> None:
        raise OSError(f"{names[0]}: cannot open shared object file")

    monkeypatch.delenv("PYDART2_GL", raising=False)
    monkeypatch.setattr(context, "_load", missing)
    with pytest.raises(ContextError) as error:
        create_context()
    for word in ("apt-get install", "libegl1", "libgl1-mesa-dri", "libosmesa6", "libEGL.so.1", "libOSMesa.so.8"):
        assert word in str(error.value)


def test_osmesa_after_another_is_refused_with_a_reason(monkeypatch: pytest.MonkeyPatch) -> None:
    import OpenGL.platform  # noqa: F401

    monkeypatch.setenv("PYDART2_GL", "osmesa")
    with pytest.raises(ContextError, match="set PYDART2_GL=osmesa before the start"):
        create_context()


def test_drawing_without_a_context_is_refused() -> None:
    import pydart2

    with pytest.raises(ContextError, match=r"pydart2\.gui\.render\(world\)"):
        pydart2.World(0.001).render()


def test_nothing_is_loaded_before_it_is_used() -> None:
    code = """
import sys, pydart2
def heavy():
    return sorted({m.split(".")[0] for m in sys.modules} & {"OpenGL", "PyQt5", "scipy", "PIL"})
assert not heavy() and "pydart2.gui" not in sys.modules, heavy()
pydart2.gui.Trackball, pydart2.gui.Camera
import pydart2.gui.draw_list, pydart2.gui.shapes
assert not heavy(), heavy()
pydart2.gui.render
assert not heavy(), heavy()
"""
    run(code)


def test_a_core_profile_or_an_old_context_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    from OpenGL import GL

    from pydart2.gui import scene_renderer as renderer

    answers = {GL.GL_MAJOR_VERSION: 3, GL.GL_MINOR_VERSION: 1, GL.GL_CONTEXT_PROFILE_MASK: 1}
    monkeypatch.setattr(renderer.GL, "glGetIntegerv", answers.__getitem__)
    monkeypatch.setattr(renderer.GL, "glGetString", lambda _: b"3.1 Mesa")
    with pytest.raises(ContextError, match=r"4\.3 is needed, this is 3\.1 Mesa"):
        renderer.check_context()
    answers[GL.GL_MAJOR_VERSION] = 4
    answers[GL.GL_MINOR_VERSION] = 5
    with pytest.raises(ContextError, match="core profile"):
        renderer.check_context()
