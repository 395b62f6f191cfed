"""What a picture in a window does, whatever it is drawn with: the mouse, the camera, selecting, pulling, capturing."""

from __future__ import annotations

from contextlib import AbstractContextManager
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np
from numpy.typing import NDArray
from OpenGL import GL
from PyQt5.QtCore import QPointF, QSize, Qt
from PyQt5.QtGui import QImage, QMouseEvent, QWheelEvent

from pydart2.bodynode import BodyNode
from pydart2.gui import drawing
from pydart2.gui.camera import as_camera
from pydart2.gui.camera_control import CameraControl
from pydart2.gui.opengl.scene import OpenGLScene
from pydart2.gui.overlays import Overlays
from pydart2.gui.pull import Pull
from pydart2.gui.pyqt5.stage import Stage
from pydart2.gui.targets import BodiesTarget, ColorTarget, draws_in_software
from pydart2.gui.trackball import Trackball
from pydart2.gui.user_input import drag_action
from pydart2.skeleton import Skeleton

if TYPE_CHECKING:
    from PyQt5.QtCore import pyqtBoundSignal
    from PyQt5.QtWidgets import QAction, QWidget

    from pydart2.gui.capture import CaptureFolder
    from pydart2.gui.runtime import Runtime
    from pydart2.world import World

    _Base = QWidget
else:
    _Base = object

SIZE = (1280, 720)
SAMPLES = 4  # a pixel, as in pictures without a window
_CLICK = 4  # pixels that the mouse may move in a click
_BUTTONS = {Qt.LeftButton: "left", Qt.RightButton: "right", Qt.MiddleButton: "middle"}


class Viewer(Protocol):
    """What a picture knows of its window."""

    runtime: Runtime
    captures: CaptureFolder
    named_actions: dict[str, QAction]

    @property
    def sim(self) -> Any:
        """The simulation."""

    @property
    def world(self) -> World | None:
        """The simulation if it is a World."""

    def safe_call_callback(self, evt: str, *args: Any) -> Any:
        """Call the function of an event if there is one; arrays that it gets have the shape (2,), pixels."""


class Picture(_Base):
    """The part that GLWidget and ImageWidget have in common.

    Attributes
    ----------
    viewer : Viewer
        The window.
    scene : OpenGLScene
    overlays : Overlays
    lock_camera : bool
        Whether the mouse leaves the camera alone; the callbacks come all the same.
    captureIndex : int
        Number of the next picture.
    """

    if TYPE_CHECKING:
        picked: pyqtBoundSignal

        def current(self) -> AbstractContextManager[object]:
            """Within it the picture's OpenGL context is current."""

    def set_up(self, window: Viewer) -> None:
        """Make the picture that of a window."""
        self.viewer = window
        self.scene = OpenGLScene(*SIZE, window)
        self.overlays = Overlays()
        self.control = CameraControl(self.scene.tb)
        self.followed: BodyNode | Skeleton | None = None
        self.lock_camera = False
        self.paint_seconds = 0.0
        self.lastPos = QPointF()
        self._pressed: QPointF | None = None
        self._action = ""
        self._target: ColorTarget | None = None
        self._in_software: bool | None = None
        self._begun = False
        self.setMinimumSize(160, 120)
        self.setFocusPolicy(Qt.ClickFocus)

    def sizeHint(self) -> QSize:  # noqa: N802 (Qt's)
        """1280 x 720."""
        return QSize(*SIZE)

    @property
    def sim(self) -> Any:
        """The simulation."""
        return self.viewer.sim

    @property
    def renderer(self) -> Any:
        """What user code draws with, `ri`."""
        return self.scene.renderer

    @property
    def pixels(self) -> tuple[int, int]:
        """Width and height in pixels of the screen."""
        ratio = self.devicePixelRatioF()
        return max(round(self.width() * ratio), 1), max(round(self.height() * ratio), 1)

    @property
    def camera(self) -> CameraControl:
        """Moves the camera that is in use."""
        trackball: Trackball = self.scene.tb
        if trackball is not self.control.trackball:
            self.control = CameraControl(trackball)
        return self.control

    def forget(self) -> None:
        """Another simulation is shown from now on."""
        self.overlays.selected = self.overlays.pull = None
        self.followed = None

    # Drawing

    @property
    def is_draft(self) -> bool:
        """Whether pictures are drawn with hard edges now: without a graphics card, while they move."""
        runtime = self.viewer.runtime
        return bool(self._in_software) and (runtime.playing or runtime.replaying)

    def drawn(self, draft: bool) -> ColorTarget:
        """The picture of now, in the context that is current; a draft takes half the time."""
        if self._in_software is None:
            self._in_software = draws_in_software()
        size, samples = self.pixels, 0 if draft else min(SAMPLES, int(GL.glGetIntegerv(GL.GL_MAX_SAMPLES)))
        target = self._target
        if target is None or (target.width, target.height, target.samples) != (*size, samples):
            if target is not None:
                target.free()
            target = self._target = ColorTarget(*size, samples)
        self._begun = False
        self.scene.resize(self.width(), self.height())
        self.scene.style.draft = draft
        target.begin()
        self.draw()
        return target

    def to_show(self) -> ColorTarget:
        """The picture of now; of drafts the one that begin_next() has begun, which is a picture old."""
        target = self._target
        if self._begun and self.is_draft and target is not None and (target.width, target.height) == self.pixels:
            return target
        return self.drawn(self.is_draft)

    def begin_next(self) -> None:
        """Let OpenGL's threads draw the next draft while this one simulates."""
        if self.is_draft:
            self.drawn(draft=True)
            GL.glFlush()
            self._begun = True

    def grab_image(self) -> QImage:
        """The picture as it is drawn when nothing moves, in pixels of the screen."""
        with self.current():
            rows = self.drawn(draft=False).read()
        height, width = rows.shape[:2]
        return QImage(rows.tobytes(), width, height, 3 * width, QImage.Format_RGB888).copy()

    def draw(self) -> None:
        """Draw into the framebuffer and viewport that are set, in the context that is current."""
        self._keep_up()
        self.scene.style.wireframe = self.overlays.wireframe
        self.scene.style.shadows = self.overlays.shadows
        self.scene.render(Stage(self.viewer.runtime, self.overlays))

    def _keep_up(self) -> None:
        if self.followed is not None:
            with self.viewer.runtime.guarded():
                self.camera.follow(self.followed.C)

    def picture(self) -> NDArray[np.uint8]:
        """The picture as it would be drawn now, (height, width, 3), row 0 on top, in pixels of the screen."""
        image = self.grab_image().convertToFormat(QImage.Format_RGB888)
        data = image.constBits().asstring(image.sizeInBytes())
        rows: NDArray[np.uint8] = np.frombuffer(data, np.uint8).reshape(image.height(), image.bytesPerLine())
        return rows[:, : 3 * image.width()].reshape(image.height(), image.width(), 3).copy()

    def capture(self, name: str | None = None) -> None:
        """Save the picture as a PNG file, numbered, in the window's capture folder, and print its path."""
        path = self.viewer.captures.next_path(name or "frame")
        if not self.grab_image().save(str(path), "PNG"):
            raise OSError(f"the picture could not be written to {path}")
        print(f"captured: {path}")

    @property
    def captureIndex(self) -> int:  # noqa: N802 (the original's)
        """Number of the next picture."""
        return self.viewer.captures.index

    # Selecting and pulling

    def body_at(self, position: QPointF) -> tuple[BodyNode | None, float]:
        """The body under a point of the widget and its depth in m; None, inf where there is none."""
        world = self.viewer.world
        x, y = int(position.x()), int(position.y())
        if world is None or not self.rect().contains(x, y):
            return None, np.inf
        width, height = self.width(), self.height()
        camera = as_camera(self.scene.tb)
        with self.current():
            target = BodiesTarget(width, height)
            try:
                target.begin()
                scene = self.overlays.scene(world)
                drawing.renderer().draw_bodies(scene, camera.view, camera.projection(width / height))
                (skel, body), depth = target.read_ids()[y, x], float(target.read_depth()[y, x])
            finally:
                target.free()
        if not 0 <= skel < len(world.skeletons):
            return None, np.inf
        return world.skeletons[skel].bodynodes[body], depth

    def follow(self, part: BodyNode | Skeleton | None) -> None:
        """Let the camera move with a part's centre of mass; None for no longer."""
        self.followed = part
        if part is not None:
            self.camera.pivot = part.C
        self.update()

    def start_pull(self, position: QPointF) -> None:
        """Take hold of the body under a point of the widget."""
        body, depth = self.body_at(position)
        if body is not None and body.skel.is_mobile() and body.skel.ndofs:
            self.overlays.pull = Pull(body, self.camera.point_at(_array(position), self._size, depth))

    def move_pull(self, position: QPointF) -> None:
        """Pull to a point of the widget, in the plane of the picture."""
        pull = self.overlays.pull
        if pull is not None:
            pull.target = self.camera.point_at(_array(position), self._size, self.camera.depth_of(pull.target))

    def end_pull(self) -> None:
        """Let go."""
        self.overlays.pull = None

    def apply_pull(self) -> None:
        """Pull in the next step, if something is held."""
        if self.overlays.pull is not None:
            self.overlays.pull.apply()

    @property
    def _size(self) -> tuple[int, int]:
        return max(self.width(), 1), max(self.height(), 1)

    # The mouse

    def set_lock_camera(self, lock: bool = True) -> None:
        """Let the mouse leave the camera alone, or move it."""
        self.lock_camera = lock

    def mousePressEvent(self, event: QMouseEvent) -> None:  # noqa: N802 (Qt's)
        """Start a click or a drag."""
        self.lastPos = self._pressed = event.localPos()
        control, shift = bool(event.modifiers() & Qt.ControlModifier), bool(event.modifiers() & Qt.ShiftModifier)
        self._action = drag_action(_BUTTONS.get(event.button(), "left"), shift, control)
        if self._action == "pull":
            with self.viewer.runtime.guarded():
                self.start_pull(event.localPos())
        self.viewer.safe_call_callback("on_mouse_press", _array(event.localPos()))
        self.update()

    def mouseMoveEvent(self, event: QMouseEvent) -> None:  # noqa: N802
        """Drag: turn, move or zoom the camera, or pull."""
        before, now = _array(self.lastPos), _array(event.localPos())
        self.lastPos = event.localPos()
        with self.viewer.runtime.guarded():
            self._drag(event.localPos(), now - before)
        self.viewer.safe_call_callback("on_mouse_move", before, now)
        self.update()

    def _drag(self, position: QPointF, change: NDArray[np.float64]) -> None:
        if self._action == "pull":
            self.move_pull(position)
        elif self.lock_camera:
            return
        elif self._action == "rotate":
            self.camera.rotate(_array(position), change, self._size)
        elif self._action == "translate":
            self.camera.translate(change, self._size)
        elif self._action == "zoom":
            self.camera.zoom(change, self._size)

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:  # noqa: N802
        """End a drag; a click selects."""
        pressed, action = self._pressed, self._action
        self._pressed, self._action = None, ""
        self.end_pull()
        if pressed is not None and action == "rotate":
            moved = event.localPos() - pressed
            if abs(moved.x()) + abs(moved.y()) < _CLICK:
                with self.viewer.runtime.guarded():
                    self.picked.emit(self.body_at(event.localPos())[0])
        self.viewer.safe_call_callback("on_mouse_release")
        self.update()

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:  # noqa: N802
        """Follow the body under the mouse, or none."""
        if event.button() == Qt.LeftButton and not self.lock_camera:
            with self.viewer.runtime.guarded():
                body, _ = self.body_at(event.localPos())
                self.picked.emit(body)
                self.viewer.named_actions["follow"].setChecked(body is not None)
                self.follow(body)

    def wheelEvent(self, event: QWheelEvent) -> None:  # noqa: N802
        """Zoom."""
        if not self.lock_camera:
            self.camera.zoom_by(0.9 ** (event.angleDelta().y() / 120.0))
            self.update()
        event.accept()


def _array(position: QPointF) -> NDArray[np.float64]:
    return np.array([position.x(), position.y()])


def make_opaque() -> None:
    """Let nothing behind the widget shine through where something transparent was drawn."""
    GL.glColorMask(False, False, False, True)
    GL.glClearColor(0.0, 0.0, 0.0, 1.0)
    GL.glClear(GL.GL_COLOR_BUFFER_BIT)
    GL.glColorMask(True, True, True, True)
