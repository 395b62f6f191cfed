"""What hands do to a window."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

import numpy as np
from PyQt5.QtCore import QEvent, QMimeData, QPoint, QPointF, Qt, QUrl
from PyQt5.QtGui import QDropEvent, QMouseEvent
from PyQt5.QtTest import QTest
from PyQt5.QtWidgets import QApplication

from pydart2.gui.camera import as_camera


def drag(widget: Any, start: tuple[int, int], end: tuple[int, int], button: Any = None, modifiers: Any = None) -> None:
    """Press, move in five steps, release, as a hand does."""
    button = Qt.LeftButton if button is None else button
    modifiers = Qt.NoModifier if modifiers is None else modifiers
    QTest.mousePress(widget, button, modifiers, QPoint(*start))
    for i in range(1, 6):
        x, y = (a + (b - a) * i // 5 for a, b in zip(start, end))
        # QTest.mouseMove sends no drag without a display.
        move = QMouseEvent(QEvent.MouseMove, QPointF(x, y), Qt.NoButton, button, modifiers)
        QApplication.sendEvent(widget, move)
    QTest.mouseRelease(widget, button, modifiers, QPoint(*end))


def wait_for(condition: Callable[[], object], seconds: float = 10.0) -> None:
    """Let Qt work until something is true; AssertionError if that takes too long."""
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, "waited too long"
        spin(0.01)


def spin(seconds: float) -> None:
    """Let Qt work."""
    QTest.qWait(round(1000 * seconds))


def pixel_of(window: Any, point: Any) -> QPoint:
    """Where a point of the world is in the widget."""
    picture = window.glwidget
    camera = as_camera(window.scene.tb)
    clip = camera.projection(picture.width() / picture.height()) @ camera.view @ np.append(point, 1.0)
    x, y = clip[:2] / clip[3]
    return QPoint(int((x + 1.0) / 2.0 * picture.width()), int((1.0 - y) / 2.0 * picture.height()))


def drag_on(widget: Any, position: QPoint) -> None:
    """Move the mouse with the right button down."""
    event = QMouseEvent(QEvent.MouseMove, QPointF(position), Qt.NoButton, Qt.RightButton, Qt.NoModifier)
    QApplication.sendEvent(widget, event)


def drop(window: Any, path: Any) -> None:
    """Drop a file on a window."""
    data = QMimeData()
    data.setUrls([QUrl.fromLocalFile(str(path))])
    window.dropEvent(QDropEvent(QPointF(9, 9), Qt.CopyAction, data, Qt.LeftButton, Qt.NoModifier))
