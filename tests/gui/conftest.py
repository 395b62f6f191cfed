"""A renderer, an X server, and windows: on Qt's `offscreen` unless QT_QPA_PLATFORM says another platform."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable, Iterator
from typing import Any

import pytest

from pydart2.gui import OffscreenRenderer

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
os.environ.setdefault("XDG_RUNTIME_DIR", "/tmp")

MakeWindow = Callable[..., Any]


@pytest.fixture(scope="session")
def renderer() -> Iterator[OffscreenRenderer]:
    """One for all tests of pictures, 240 by 180."""
    made = OffscreenRenderer(240, 180)
    yield made
    made.close()


@pytest.fixture(scope="session")
def display() -> Iterator[str]:
    """The name of an X server's display, as in DISPLAY. The server chooses a free one and says when it answers.

    One for all tests: under xvfb-run, which waits for none of its servers to end, a server that ends can take
    the display of the next one with it.
    """
    command = ["Xvfb", "-displayfd", "1", "-screen", "0", "1680x1050x24", "-noreset", "-nolisten", "tcp"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True) as server:
        assert server.stdout
        number = server.stdout.readline().strip()
        assert number, "Xvfb does not start"
        yield f":{number}"
        server.terminate()


@pytest.fixture
def make_window(monkeypatch: pytest.MonkeyPatch, tmp_path: Any) -> Iterator[MakeWindow]:
    """Makes windows that capture into a temporary folder; they are closed, and no slot may have raised."""
    from PyQt5.QtWidgets import QApplication

    from pydart2.gui.pyqt5.window import PyQt5Window

    raised: list[BaseException] = []
    monkeypatch.setattr(sys, "excepthook", lambda kind, value, trace: raised.append(value))
    windows: list[PyQt5Window] = []

    def make(sim: Any = None, title: str | None = None, size: tuple[int, int] = (900, 600)) -> PyQt5Window:
        window = PyQt5Window(sim, title)
        window.set_capture_dir(tmp_path / "captures")
        window.resize(*size)
        window.show()
        QApplication.setActiveWindow(window)  # as a window manager would
        windows.append(window)
        QApplication.processEvents()
        return window

    yield make
    for window in windows:
        window.close()
        window.deleteLater()
    QApplication.processEvents()
    assert raised == []
