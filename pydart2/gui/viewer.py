"""Windows that show and drive simulations.

>>> pydart2.gui.viewer.launch(world)
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from pydart2.gui.glut.window import GLUTWindow
    from pydart2.gui.pyqt5.window import PyQt5Window
    from pydart2.gui.pyqt5.window import PyQt5Window as PydartWindow

__all__ = ["PydartWindow", "launch", "launch_glut", "launch_pyqt4", "launch_pyqt5", "launch_window"]


def __getattr__(name: str) -> Any:
    """`PydartWindow` is the original's older name of PyQt5Window; Qt is imported when it is used."""
    if name in ("PydartWindow", "PyQt5Window"):
        from pydart2.gui.pyqt5.window import PyQt5Window

        return PyQt5Window
    raise AttributeError(f"module 'pydart2.gui.viewer' has no attribute {name!r}")


def launch_window(sim: Any, win: Any, default_camera: int | None) -> Any:
    """Show a window with a camera (0: Y up, 1: Z up, None: as it is) until it is closed; returns it."""
    if default_camera is not None:
        win.scene.set_camera(default_camera)
    win.run()
    return win


def launch_pyqt5(sim: Any, title: str | None = None, default_camera: int | str | None = None) -> PyQt5Window:
    """Show a simulation until the window is closed.

    Parameters
    ----------
    sim
        A World, or any object with some of the functions of `callbacks.EVENTS`.
    title
        Of the window.
    default_camera
        0: Y up, 1: Z up; None takes the world's up, sees all that is there, and draws a floor where the
        world has none. The same by name, from "front", "back", "left", "right" or "top"; or one of ``world.cameras``,
        which goes with what it is mounted on. They are in the menu, too.

    Returns
    -------
    The window; `window.runtime.errors` has the tracebacks of user code.

    Raises
    ------
    NoDisplayError
        If there is no display.
    NameNotFound
        If there is no camera of that name.
    """
    from pydart2.gui.pyqt5.window import PyQt5Window

    window = PyQt5Window(sim, title)
    if default_camera is None or isinstance(default_camera, str):
        window.commands.first_look(default_camera or "auto")
        default_camera = None
    launch_window(sim, window, default_camera)
    return window


def launch_glut(sim: Any, title: str | None = None, default_camera: int | None = None) -> GLUTWindow:
    """Show a simulation in a window by GLUT until it is closed; NoDisplayError without an X server."""
    from pydart2.gui.glut.window import GLUTWindow

    window: GLUTWindow = launch_window(sim, GLUTWindow(sim, title), default_camera)
    return window


launch_pyqt4 = launch_pyqt5
launch = launch_pyqt5
