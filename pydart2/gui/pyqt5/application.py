"""The Qt application: made when there is a display, with errors that do not end the process."""

from __future__ import annotations

import atexit
import sys
import traceback
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import TracebackType

from PyQt5 import sip
from PyQt5.QtCore import Qt
from PyQt5.QtGui import QSurfaceFormat
from PyQt5.QtWidgets import QApplication

from pydart2.gui.display import require_qt_display

_application: QApplication | None = None  # Qt needs it to outlive every widget


def application(title: str = "pydart2") -> QApplication:
    """The process's QApplication, made at the first call.

    Raises
    ------
    NoDisplayError
        If there is no display to open a window on; Qt itself would end the process.
    """
    global _application
    existing = QApplication.instance()
    if isinstance(existing, QApplication):
        return existing
    require_qt_display()
    surface = QSurfaceFormat.defaultFormat()
    surface.setDepthBufferSize(24)
    QSurfaceFormat.setDefaultFormat(surface)
    QApplication.setAttribute(Qt.AA_EnableHighDpiScaling)
    QApplication.setAttribute(Qt.AA_UseHighDpiPixmaps)
    _application = QApplication([title])
    _application.setStyle("Fusion")
    return _application


@atexit.register
def _delete_windows() -> None:
    """Delete windows while Qt and all of Python are there, before its last search for garbage does, in any order."""
    for widget in [widget for widget in QApplication.topLevelWidgets() if sip.ispyowned(widget)]:
        sip.delete(widget)


@contextmanager
def exceptions_to(report: Callable[[str], object]) -> Iterator[None]:
    """Within it an exception in a Qt slot goes to `report` as a traceback's text; otherwise PyQt ends the process."""
    before = sys.excepthook

    def hook(kind: type[BaseException], value: BaseException, trace: TracebackType | None) -> None:
        if issubclass(kind, Exception):
            report("".join(traceback.format_exception(kind, value, trace)))
        else:
            before(kind, value, trace)

    sys.excepthook = hook
    try:
        yield
    finally:
        sys.excepthook = before
