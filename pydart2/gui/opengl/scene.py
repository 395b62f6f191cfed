"""What a window draws into: cameras, a world, and what the user adds to it."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from OpenGL import GL

from pydart2.gui import drawing
from pydart2.gui.camera import Camera, default_trackballs
from pydart2.gui.draw_list import Show
from pydart2.gui.opengl.renderer import Renderer
from pydart2.gui.scene_renderer import Style, blend
from pydart2.gui.trackball import Trackball
from pydart2.simulation.up import up_of


class OpenGLScene:
    """Draws a world into the framebuffer of a window, or of nobody, in the context that is current.

    Parameters
    ----------
    width, height
        Of the picture in the coordinates of `draw_with_ri` and of the mouse.
    window
        Told of new cameras by ``add_camera_event(scene, trackball, name)``, if it has that.

    Attributes
    ----------
    renderer : Renderer
        Handed to the user's `render_with_ri` and `draw_with_ri`.
    cameras : list of Trackball
    tb : Trackball
        The camera in use.
    style : Style
        How pictures look.
    show : Show
        What of a world is drawn.
    """

    def __init__(self, width: int, height: int, window: Any = None) -> None:
        self.width, self.height = width, height
        self.window = window
        self.renderer = Renderer()
        self.style, self.show = Style(), Show()
        self.cameras: list[Trackball] = []
        self.init_cameras()
        self.tb = self.cameras[0]

    def init(self) -> None:
        """Make what is needed in the context that is current, and set it up for user code that calls OpenGL itself."""
        drawing.renderer()
        self._set_up_fixed_pipeline()

    def resize(self, w: int, h: int) -> None:
        """Draw into a viewport of another size, pixels."""
        self.width, self.height = max(w, 1), max(h, 1)
        GL.glViewport(0, 0, self.width, self.height)
        for trackball in self.cameras:
            trackball.viewport = (self.width, self.height)

    def render(self, sim: Any = None, camera: Camera | None = None) -> None:
        """Draw the background, then ``sim.render()``, ``sim.render_with_ri(ri)`` and ``sim.draw_with_ri(ri)``, those
        that `sim` has, with the camera `tb` or another."""
        self._begin(sim, camera or Camera(self.tb.view, self.tb.fov))
        if sim is None:
            return
        with _undone():
            if hasattr(sim, "render"):
                sim.render()
            if (draw_in_world := getattr(sim, "render_with_ri", None)) is not None:
                self._set_up_fixed_pipeline()
                draw_in_world(self.renderer)
        if (draw_over := getattr(sim, "draw_with_ri", None)) is not None:
            with _undone():
                self.enable2D()
                draw_over(self.renderer)

    def _begin(self, sim: Any, camera: Camera) -> None:
        renderer = drawing.renderer()
        renderer.style, renderer.show = self.style, self.show
        _, _, width, height = GL.glGetIntegerv(GL.GL_VIEWPORT)
        view, projection = camera.view, camera.projection(width / max(height, 1))
        GL.glMatrixMode(GL.GL_PROJECTION)
        GL.glLoadMatrixd(projection.T.copy())
        GL.glMatrixMode(GL.GL_MODELVIEW)
        GL.glLoadMatrixd(view.T.copy())
        renderer.begin_frame(view, projection, up_of(sim))
        if not getattr(sim, "draws_background", False):
            renderer.clear()

    def enable2D(self) -> None:  # noqa: N802 (the original's)
        """Draw in pixels from now on: x to the right and y downwards from the upper left corner."""
        GL.glMatrixMode(GL.GL_PROJECTION)
        GL.glPushMatrix()
        GL.glLoadIdentity()
        GL.glOrtho(0.0, self.width, self.height, 0.0, -1.0, 1.0)
        GL.glMatrixMode(GL.GL_MODELVIEW)
        GL.glPushMatrix()
        GL.glLoadIdentity()
        GL.glDisable(GL.GL_LIGHTING)
        GL.glDisable(GL.GL_DEPTH_TEST)
        GL.glDisable(GL.GL_CULL_FACE)
        blend()

    def disable2D(self) -> None:  # noqa: N802
        """Draw in the world again."""
        GL.glMatrixMode(GL.GL_PROJECTION)
        GL.glPopMatrix()
        GL.glMatrixMode(GL.GL_MODELVIEW)
        GL.glPopMatrix()
        GL.glEnable(GL.GL_DEPTH_TEST)

    def init_cameras(self) -> None:
        """Add the cameras "Camera Y up" and "Camera Z up"."""
        for name, trackball in default_trackballs():
            self.add_camera(trackball, name)

    def num_cameras(self) -> int:
        """How many cameras there are."""
        return len(self.cameras)

    def replace_camera(self, idx: int, trackball: Trackball) -> bool:
        """Put another trackball in the place of a camera, in use or not; False if there is no such camera."""
        if not 0 <= idx < len(self.cameras):
            return False
        if self.tb is self.cameras[idx]:
            self.tb = trackball
        trackball.viewport = (self.width, self.height)
        self.cameras[idx] = trackball
        return True

    def add_camera(self, trackball: Trackball, name: str) -> None:
        """Add a camera."""
        trackball.viewport = (self.width, self.height)
        self.cameras.append(trackball)
        if self.window is not None and hasattr(self.window, "add_camera_event"):
            self.window.add_camera_event(self, trackball, name)

    def remove_camera(self, idx: int) -> None:
        """Take a camera away; if it was in use, the first one is. IndexError if there is none of that number."""
        gone = self.cameras.pop(idx)
        if self.tb is gone:
            self.tb = self.cameras[0]

    def set_camera(self, camera_index: int) -> None:
        """Use a camera; IndexError if there is none of that number."""
        if not 0 <= camera_index < len(self.cameras):
            raise IndexError(f"no camera {camera_index}; there are {len(self.cameras)}, counted from 0")
        self.tb = self.cameras[camera_index]

    def _set_up_fixed_pipeline(self) -> None:
        """The lights and the state that user code finds in `render_with_ri` when it calls OpenGL itself."""
        GL.glEnable(GL.GL_DEPTH_TEST)
        GL.glEnable(GL.GL_LIGHTING)
        GL.glEnable(GL.GL_NORMALIZE)
        GL.glEnable(GL.GL_COLOR_MATERIAL)
        blend()
        for light, direction in ((GL.GL_LIGHT0, (1.0, 1.0, 0.0, 0.0)), (GL.GL_LIGHT1, (-1.0, 0.0, 0.0, 0.0))):
            GL.glLightfv(light, GL.GL_POSITION, direction)
            GL.glLightfv(light, GL.GL_DIFFUSE, (0.7, 0.7, 0.7, 1.0))
            GL.glEnable(light)


@contextmanager
def _undone() -> Iterator[None]:
    """Afterwards OpenGL's state is as it was, also if user code raised or forgot a pop()."""
    stacks = (
        (GL.GL_PROJECTION, GL.GL_PROJECTION_STACK_DEPTH),
        (GL.GL_MODELVIEW, GL.GL_MODELVIEW_STACK_DEPTH),
    )
    depths = [GL.glGetIntegerv(depth) for _, depth in stacks]
    GL.glPushAttrib(GL.GL_ALL_ATTRIB_BITS)
    try:
        yield
    finally:
        GL.glPopAttrib()
        for (mode, depth), before in zip(stacks, depths):
            GL.glMatrixMode(mode)
            for _ in range(GL.glGetIntegerv(depth) - before):
                GL.glPopMatrix()
