"""The viewer with Qt 5. Needs PyQt5; imported when it is used."""

from pydart2.gui.pyqt5 import side_panel, window

__all__ = ["side_panel", "window"]
