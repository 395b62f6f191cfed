"""A plain window by GLUT. Subclasses may call GLUT themselves: `initGL`, `resizeGL` and `drawGL` need no more than a
current OpenGL context in the compatibility profile."""

from __future__ import annotations

import sys
import time
from typing import Any

from pydart2.errors import PydartError
from pydart2.gui.capture import CaptureFolder
from pydart2.gui.closing import interrupt_calls, seconds_to_show
from pydart2.gui.context import load_opengl
from pydart2.gui.display import require_x_display
from pydart2.gui.opengl.scene import OpenGLScene
from pydart2.gui.runtime import Runtime
from pydart2.gui.user_input import GLUT_KEYS, drag_action

__all__ = ["GLUTWindow"]

_REDRAW_MS = 20
_BUTTONS = ("left", "middle", "right")  # GLUT_LEFT_BUTTON is 0, and so on


class GLUTWindow:
    """A window that shows and drives a simulation.

    >>> GLUTWindow(world, "My robot").run()

    Parameters
    ----------
    sim
        A World, or any object with some of the functions of `callbacks.EVENTS`.
    title
        Of the window; None for "GLUT Window".

    Attributes
    ----------
    window_size : (width, height)
    scene : OpenGLScene
    mouseLastPos : [x, y] or None
    is_simulating, is_animating : bool
    frame_index, capture_index : int
    window : int or None
        GLUT's number, after run().
    """

    def __init__(self, sim: Any, title: str | None) -> None:
        self.sim = sim
        self.title = "GLUT Window" if title is None else title
        self.window_size = (1280, 720)
        self.scene = OpenGLScene(*self.window_size)
        self.runtime = Runtime(sim)
        self.captures = CaptureFolder()
        self.mouseLastPos: list[float] | None = None
        self.is_simulating = False
        self.is_animating = False
        self.window: int | None = None
        self._action = ""
        self._interrupted = False
        self._raised: BaseException | None = None

    @property
    def frame_index(self) -> int:
        """The recorded frame that is shown."""
        return self.runtime.frame

    @property
    def capture_index(self) -> int:
        """Number of the next picture."""
        return self.captures.index

    # OpenGL

    def initGL(self, w: int, h: int) -> None:  # noqa: N802 (the original's)
        """Set up the context that is current."""
        load_opengl()
        self.scene.init()
        self.resizeGL(w, h)

    def resizeGL(self, w: int, h: int) -> None:  # noqa: N802
        """Draw in another size from now on."""
        self.window_size = (w, h)
        self.scene.resize(w, h)

    def drawGL(self) -> None:  # noqa: N802
        """Draw, and show what was drawn."""
        from OpenGL import GLUT

        self.scene.render(self.sim)
        GLUT.glutSwapBuffers()

    # Keys and mouse

    def close(self) -> None:
        """Close the window; run() returns."""
        from OpenGL import GLUT

        if self.window is not None:
            GLUT.glutDestroyWindow(self.window)
            self.window = None
            GLUT.glutLeaveMainLoop()

    def keyPressed(self, key: bytes, x: int, y: int) -> None:  # noqa: N802
        """Obey one of user_input.GLUT_KEYS; any other goes to the simulation's `on_key_press`, as a str."""
        action = GLUT_KEYS.get(key, ("",))[0]
        if action == "close":
            self.close()
        elif action == "play":
            self.is_simulating = not self.is_simulating
            self.is_animating = False
        elif action == "animate":
            self.is_animating = not self.is_animating
            self.is_simulating = False
        elif action in ("back", "forward"):
            self._show_frame(self.runtime.frame + (1 if action == "forward" else -1))
        elif action == "capture":
            self.capture()
        else:
            with self.runtime.guarded():
                self.runtime.callbacks.call("on_key_press", key.decode("latin-1").upper())

    def _show_frame(self, frame: int) -> None:
        """Show a recorded frame; after the last one comes the first that is kept."""
        first, count = self.runtime.first_frame, self.runtime.num_frames
        if count > first:
            self.runtime.set_frame(first + (frame - first) % (count - first))

    def mouseFunc(self, button: int, state: int, x: int, y: int) -> None:  # noqa: N802
        """A button goes down (`state` 0) or up (1)."""
        from OpenGL import GLUT

        if state == GLUT.GLUT_DOWN:
            modifiers = GLUT.glutGetModifiers()
            shift, control = modifiers & GLUT.GLUT_ACTIVE_SHIFT, modifiers & GLUT.GLUT_ACTIVE_CTRL
            name = _BUTTONS[button] if button < len(_BUTTONS) else "left"
            self._action = drag_action(name, bool(shift), bool(control))
            self.mouseLastPos = [x, y]
        else:
            self.mouseLastPos = None

    def motionFunc(self, x: int, y: int) -> None:  # noqa: N802
        """The mouse is dragged."""
        if self.mouseLastPos is None:
            return
        dx, dy = x - self.mouseLastPos[0], y - self.mouseLastPos[1]
        trackball = self.scene.tb
        if self._action == "zoom":
            trackball.zoom_to(dx, -dy)
        elif self._action == "translate":
            trackball.trans_to(dx, -dy)
        else:
            trackball.drag_to(x, self.window_size[1] - y, dx, -dy)
        self.mouseLastPos = [x, y]

    # Time

    def idle(self) -> None:
        """One step when simulating, or the next recorded frame when animating; an error ends both."""
        try:
            self._idle()
        except BaseException as raised:  # such as SystemExit, which GLUT's loop would swallow
            self._raised = raised
        if self._interrupted or self._raised is not None:
            self.close()

    def _idle(self) -> None:
        if self.sim is None:
            return
        if self.is_simulating:
            self.is_simulating = self.runtime.step()
        elif self.is_animating:
            self._show_frame(self.runtime.frame + 1)
        else:
            time.sleep(0.001)  # GLUT calls again at once

    def renderTimer(self, timer: int) -> None:  # noqa: N802
        """Draw soon, and again in 20 ms."""
        from OpenGL import GLUT

        if self.window is not None:
            GLUT.glutPostRedisplay()
            GLUT.glutTimerFunc(_REDRAW_MS, self.renderTimer, 1)

    def capture(self) -> None:
        """Save the window's picture as a PNG file in data/captures."""
        from OpenGL import GL
        from PIL import Image

        width, height = self.window_size
        GL.glPixelStorei(GL.GL_PACK_ALIGNMENT, 1)
        pixels = GL.glReadPixels(0, 0, width, height, GL.GL_RGB, GL.GL_UNSIGNED_BYTE)
        path = self.captures.next_path("capture")
        Image.frombytes("RGB", (width, height), pixels).transpose(Image.Transpose.FLIP_TOP_BOTTOM).save(path)
        print(f"captured: {path}")

    # Running

    def run(self) -> None:
        """Show the window, and come back when it is closed.

        With PYDART2_VIEWER_SECONDS=N in the environment it plays at once and closes after N seconds; the process
        then ends with status 1 if user code has raised.

        Raises
        ------
        NoDisplayError
            Without an X server; GLUT itself would end the process.
        PydartError
            Without the freeglut library.
        """
        for _, keys, text in GLUT_KEYS.values():
            print(f"{keys}: {text}")
        init_glut(self.title)
        from OpenGL import GLUT

        GLUT.glutInitDisplayMode(GLUT.GLUT_RGBA | GLUT.GLUT_DOUBLE | GLUT.GLUT_DEPTH | GLUT.GLUT_MULTISAMPLE)
        GLUT.glutInitWindowSize(*self.window_size)
        GLUT.glutInitWindowPosition(0, 0)
        self.window = GLUT.glutCreateWindow(self.title.encode())
        GLUT.glutSetOption(GLUT.GLUT_ACTION_ON_WINDOW_CLOSE, GLUT.GLUT_ACTION_GLUTMAINLOOP_RETURNS)
        GLUT.glutDisplayFunc(self.drawGL)
        GLUT.glutIdleFunc(self.idle)
        GLUT.glutReshapeFunc(self.resizeGL)
        GLUT.glutKeyboardFunc(self.keyPressed)
        GLUT.glutMouseFunc(self.mouseFunc)
        GLUT.glutMotionFunc(self.motionFunc)
        GLUT.glutTimerFunc(_REDRAW_MS, self.renderTimer, 1)
        self.initGL(*self.window_size)
        self._interrupted, self._raised = False, None
        seconds = seconds_to_show()
        if seconds is not None:
            self.is_simulating = True
            GLUT.glutTimerFunc(round(1000.0 * seconds), lambda _: self._interrupt(), 0)
        with interrupt_calls(self._interrupt):
            GLUT.glutMainLoop()
        self.window = None
        if self._raised is not None:
            raise self._raised
        if seconds is not None and self.runtime.errors:
            sys.exit(1)

    def _interrupt(self) -> None:
        """Close at the next idle call: in the midst of a picture GLUT would end the process."""
        self._interrupted = True


def init_glut(title: str) -> None:
    """glutInit, if it has not been called; raises where it would end the process."""
    require_x_display()
    load_opengl()
    from OpenGL import GLUT
    from OpenGL.GLUT import special

    if not GLUT.glutInit:
        raise PydartError("no GLUT; on Debian: apt-get install libglut3.12 (or freeglut3)")
    if not GLUT.glutGet(GLUT.GLUT_INIT_STATE):
        # The end of a main loop ends freeglut, but PyOpenGL would not start it a second time.
        special.INITIALIZED = False
        GLUT.glutInit([title.encode()])
