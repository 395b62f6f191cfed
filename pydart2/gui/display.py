"""Whether there is a display: Qt and GLUT would end the process instead of saying so."""

from __future__ import annotations

import ctypes
import os
import sys

from pydart2.errors import PydartError

HEADLESS_WAYS = (
    "for pictures without a display use pydart2.gui.render() or pydart2.gui.record(); "
    "for a window that nobody sees set QT_QPA_PLATFORM=offscreen, or run under xvfb-run"
)


class NoDisplayError(PydartError):
    """A window was wanted where there is no display."""


def x_display_answers() -> bool:
    """Whether the X server that DISPLAY names accepts a connection."""
    if not os.environ.get("DISPLAY"):
        return False
    try:
        xcb = ctypes.CDLL("libxcb.so.1")
    except OSError as error:
        raise NoDisplayError(f"no window without XCB: {error}; on Debian: apt-get install libxcb1") from None
    xcb.xcb_connect.restype = ctypes.c_void_p
    connection = ctypes.c_void_p(xcb.xcb_connect(None, None))
    failed = xcb.xcb_connection_has_error(connection)
    xcb.xcb_disconnect(connection)
    return not failed


def require_x_display() -> None:
    """Raise NoDisplayError unless an X server answers."""
    if not x_display_answers():
        name = os.environ.get("DISPLAY")
        what = f"the X server of DISPLAY={name} does not answer" if name else "DISPLAY is not set"
        raise NoDisplayError(f"no window: {what}; {HEADLESS_WAYS}")


def require_qt_display() -> None:
    """Raise NoDisplayError unless Qt can open a window: it has a display, or it is told not to need one."""
    if not sys.platform.startswith("linux"):
        return
    platform = os.environ.get("QT_QPA_PLATFORM", "").split(":")[0]
    if platform.split(";")[0] not in ("", "xcb") or (not platform and os.environ.get("WAYLAND_DISPLAY")):
        return
    require_x_display()
    _require_xcb_plugin()


def _require_xcb_plugin() -> None:
    """Qt's plugin for X needs libraries that its wheel does not bring."""
    from PyQt5.QtCore import QLibraryInfo

    folder = QLibraryInfo.location(QLibraryInfo.PluginsPath)
    plugin = os.path.join(folder, "platforms", "libqxcb.so")
    if not os.path.exists(plugin):
        return
    try:
        ctypes.CDLL(plugin)
    except OSError as error:
        raise NoDisplayError(
            f"no window: Qt's plugin for X cannot be loaded: {error}; on Debian: apt-get install libxcb-icccm4 "
            "libxcb-image0 libxcb-keysyms1 libxcb-render-util0 libxcb-shape0 libxcb-xinerama0 libxcb-xkb1 "
            "libxkbcommon-x11-0 libdbus-1-3 libgl1"
        ) from None
