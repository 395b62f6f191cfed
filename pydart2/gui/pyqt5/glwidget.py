"""The picture in the window: by OpenGL where Qt has it, else a picture that was drawn without a display."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator
from contextlib import AbstractContextManager, contextmanager
from typing import TYPE_CHECKING

from PyQt5.QtCore import QRect, pyqtSignal
from PyQt5.QtGui import QImage, QOpenGLContext, QPainter, QPaintEvent
from PyQt5.QtWidgets import QOpenGLWidget, QWidget

from pydart2.gui import context as contexts
from pydart2.gui.pyqt5.application import SAMPLES
from pydart2.gui.pyqt5.picture import Picture, make_opaque, set_viewport
from pydart2.gui.targets import ColorTarget

if TYPE_CHECKING:
    from pydart2.gui.pyqt5.window import PyQt5Window


class GLWidget(Picture, QOpenGLWidget):
    """The picture, drawn by OpenGL into the window. Emits `picked(body)` when a body, or none, is clicked."""

    picked = pyqtSignal(object)

    def __init__(self, parent: PyQt5Window) -> None:
        QOpenGLWidget.__init__(self, parent)
        self.set_up(parent)

    def initializeGL(self) -> None:  # noqa: N802 (Qt's)
        """Make what the context needs; Qt calls it again when the widget gets a new one."""
        contexts.load_opengl()
        self.scene.init()

    def resizeGL(self, w: int, h: int) -> None:  # noqa: N802
        """Draw in another size from now on."""
        self.scene.resize(w, h)

    def paintGL(self) -> None:  # noqa: N802
        """Draw."""
        start = time.perf_counter()
        set_viewport(self.pixels)
        self.draw()
        make_opaque()
        self.paint_seconds = time.perf_counter() - start

    @contextmanager
    def current(self) -> Iterator[None]:
        """Within it the widget's context is current."""
        self.makeCurrent()
        try:
            yield
        finally:
            self.doneCurrent()

    def grab_image(self) -> QImage:
        """The picture as it is drawn now, in pixels of the screen."""
        return self.grabFramebuffer()


class ImageWidget(Picture, QWidget):
    """The picture where Qt has no OpenGL, as on its platform `offscreen`. Emits `picked(body)` like GLWidget."""

    picked = pyqtSignal(object)

    def __init__(self, parent: PyQt5Window) -> None:
        QWidget.__init__(self, parent)
        self._context = contexts.create_context()
        contexts.free_with(self, self._context)
        self._lock = threading.RLock()
        self._target: ColorTarget | None = None
        self.set_up(parent)
        with self.current():
            self.scene.init()

    def current(self) -> AbstractContextManager[None]:
        """Within it the picture's own context is current."""
        return contexts.current(self._context, self._lock)

    def grab_image(self) -> QImage:
        """The picture as it is drawn now, in pixels of the screen."""
        width, height = self.pixels
        with self.current():
            if self._target is None or (self._target.width, self._target.height) != (width, height):
                if self._target is not None:
                    self._target.free()
                self._target = ColorTarget(width, height, SAMPLES)
            self.scene.resize(self.width(), self.height())
            self._target.begin()
            self.draw()
            rows = self._target.read()
        return QImage(rows.tobytes(), width, height, 3 * width, QImage.Format_RGB888).copy()

    def paintEvent(self, _event: QPaintEvent) -> None:  # noqa: N802
        """Draw."""
        start = time.perf_counter()
        painter = QPainter(self)
        painter.drawImage(QRect(0, 0, self.width(), self.height()), self.grab_image())
        painter.end()
        self.paint_seconds = time.perf_counter() - start


def make_picture(window: PyQt5Window) -> GLWidget | ImageWidget:
    """The picture of a window, with what works on Qt's platform."""
    return GLWidget(window) if QOpenGLContext().create() else ImageWidget(window)
