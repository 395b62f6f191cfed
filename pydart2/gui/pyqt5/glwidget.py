"""The picture in the window: by OpenGL where Qt has it, else a picture that was drawn without a display."""

from __future__ import annotations

import os
import threading
import time
from collections.abc import Iterator
from contextlib import AbstractContextManager, contextmanager
from typing import Any, cast

from OpenGL import GL
from PyQt5.QtCore import QRect, pyqtSignal
from PyQt5.QtGui import QImage, QOffscreenSurface, QOpenGLContext, QPainter, QPaintEvent
from PyQt5.QtWidgets import QOpenGLWidget, QWidget

from pydart2.gui import context as contexts
from pydart2.gui.pyqt5.picture import Picture, Viewer, make_opaque
from pydart2.gui.targets import draws_in_software

QT_PICTURES = "PYDART2_QT_PICTURES"


class GLWidget(Picture, QOpenGLWidget):
    """The picture, drawn by OpenGL into the window. Emits `picked(body)` when a body, or none, is clicked."""

    picked = pyqtSignal(object)

    def __init__(self, parent: Viewer) -> None:
        QOpenGLWidget.__init__(self, cast("QWidget", parent))
        self.set_up(parent)

    def initializeGL(self) -> None:  # noqa: N802 (Qt's)
        """Make what the context needs; Qt calls it again when the widget gets a new one."""
        contexts.load_opengl()
        self._target = None
        self.scene.init()

    def paintGL(self) -> None:  # noqa: N802
        """Draw."""
        start = time.perf_counter()
        with contexts.keeping_garbage():
            self.to_show().copy_to(self.defaultFramebufferObject())
            self.begin_next()
            GL.glBindFramebuffer(GL.GL_FRAMEBUFFER, self.defaultFramebufferObject())
            make_opaque()
        self.paint_seconds = time.perf_counter() - start

    @contextmanager
    def current(self) -> Iterator[None]:
        """Within it the widget's context is current."""
        with contexts.keeping_garbage():
            self.makeCurrent()
            try:
                yield
            finally:
                self.doneCurrent()


class ImageWidget(Picture, QWidget):
    """The picture where Qt has no OpenGL, as on its platform `offscreen`. Emits `picked(body)` like GLWidget."""

    picked = pyqtSignal(object)

    def __init__(self, parent: Viewer) -> None:
        QWidget.__init__(self, cast("QWidget", parent))
        self._context = contexts.create_context()
        contexts.free_with(self, self._context)
        self._lock = threading.RLock()
        self.set_up(parent)
        with self.current():
            self.scene.init()

    def current(self) -> AbstractContextManager[None]:
        """Within it the picture's own context is current."""
        return contexts.current(self._context, self._lock)

    def paintEvent(self, _event: QPaintEvent) -> None:  # noqa: N802
        """Draw."""
        start = time.perf_counter()
        with self.current():
            target = self.to_show()
            with self.viewer.runtime.simulating_beside():  # OpenGL's threads may not be ready
                rows = target.read_rows()
                height, width = rows.shape[:2]
                memory: Any = rows.data  # mirrored() copies it
                image = QImage(memory, width, height, 4 * width, QImage.Format_RGBX8888).mirrored()
            self.begin_next()
        painter = QPainter(self)
        painter.drawImage(QRect(0, 0, self.width(), self.height()), image)
        painter.end()
        self.paint_seconds = time.perf_counter() - start


def make_picture(window: Viewer) -> GLWidget | ImageWidget:
    """The picture of a window: by Qt's OpenGL on a graphics card, else by ours, beside which the simulation goes on.

    PYDART2_QT_PICTURES=1 in the environment takes Qt's in any case.
    """
    card = _qt_has_a_card()
    if card or (card is not None and os.environ.get(QT_PICTURES)):
        return GLWidget(window)
    try:
        return ImageWidget(window)
    except contexts.ContextError:
        if card is None:
            raise
        return GLWidget(window)


def _qt_has_a_card() -> bool | None:
    """Whether Qt's OpenGL has a graphics card; None if there is no OpenGL on Qt's platform."""
    context, surface = QOpenGLContext(), QOffscreenSurface()
    surface.create()
    if not context.create() or not context.makeCurrent(surface):
        return None
    contexts.load_opengl()
    found = not draws_in_software()
    context.doneCurrent()
    return found
