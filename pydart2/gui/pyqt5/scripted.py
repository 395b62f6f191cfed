"""What scripts call on the window, as they did on the original's: the simulation, callbacks, cameras, captures."""

from __future__ import annotations

import os
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from PyQt5.QtWidgets import QAction, QActionGroup, QComboBox, QMainWindow, QMenu

from pydart2.gui.callbacks import EVENTS, Callbacks
from pydart2.gui.capture import CaptureFolder
from pydart2.gui.opengl.scene import OpenGLScene
from pydart2.gui.pyqt5.glwidget import GLWidget, ImageWidget
from pydart2.gui.pyqt5.inspector import Inspector
from pydart2.gui.pyqt5.panes import ErrorPane, HelpOverlay
from pydart2.gui.riding import RidingTrackball
from pydart2.gui.runtime import Runtime
from pydart2.gui.trackball import Trackball
from pydart2.world import World

_TOLD_MS = 5000  # a message stays in the status bar


class Scripted(QMainWindow):
    """The part of PyQt5Window that scripts use."""

    runtime: Runtime
    captures: CaptureFolder
    glwidget: GLWidget | ImageWidget
    scene: OpenGLScene
    inspector: Inspector
    named_actions: dict[str, QAction]
    speedBox: QComboBox  # noqa: N815 (the original's)
    errorPane: ErrorPane  # noqa: N815
    helpOverlay: HelpOverlay  # noqa: N815
    cameraMenu: QMenu  # noqa: N815 (the original's)
    cameraGroup: QActionGroup  # noqa: N815
    _capture_rate = 100

    if TYPE_CHECKING:

        def set_simulation(self, sim: Any) -> None: ...
        def refresh(self) -> None: ...
        def look_upright(self) -> None: ...

    # Simulation

    @property
    def sim(self) -> Any:
        """The simulation."""
        return self.runtime.sim

    @property
    def world(self) -> World | None:
        """The simulation if it is a World."""
        return self.sim if isinstance(self.sim, World) else None

    def get_simulation(self) -> Any:
        """The simulation."""
        return self.runtime.sim

    # Callbacks

    @property
    def callbacks(self) -> Callbacks:
        """Event name → function or None."""
        return self.runtime.callbacks

    @property
    def callback_events(self) -> list[str]:
        """The names of the events."""
        return list(EVENTS)

    def init_callbacks(self) -> None:
        """Read the callbacks anew."""
        self.read_default_callbacks_from_sim()

    def read_default_callbacks_from_sim(self) -> None:
        """Take the simulation's functions as callbacks."""
        self.callbacks.read(self.sim)

    def callback(self, evt: str) -> Callable[..., Any] | None:
        """The function of an event; KeyError for an unknown one."""
        return self.callbacks[evt]

    def has_callback(self, evt: str) -> bool:
        """Whether an event has a function; KeyError for an unknown one."""
        return self.callbacks[evt] is not None

    def set_callback(self, evt: str, func: Callable[..., Any] | None) -> None:
        """Give an event another function; KeyError for an unknown one."""
        self.callbacks.set(evt, func)

    def safe_call_callback(self, evt: str, *args: Any) -> Any:
        """Call the function of an event if there is one; what it raises is shown in the window."""
        with self.runtime.guarded():
            return self.callbacks.call(evt, *args)
        return None

    def callbacks_as_string(self) -> str:
        """The names of the events that have a function."""
        return str(self.callbacks)

    # Cameras

    def num_cameras(self) -> int:
        """How many cameras there are."""
        return self.scene.num_cameras()

    def replace_camera(self, idx: int, trackball: Trackball) -> bool:
        """Put another trackball in a camera's place; False if there is no such camera."""
        return self.scene.replace_camera(idx, trackball)

    def add_camera(self, trackball: Trackball, name: str | None = None) -> None:
        """Add a camera, and its name to the menu."""
        self.scene.add_camera(trackball, name or f"Camera {self.num_cameras()}")

    def add_camera_event(self, scene: Any, trackball: Trackball, name: str) -> None:
        """Add an entry to the camera menu; the scene calls it for each of its cameras."""
        action = QAction(name, self)
        action.setCheckable(True)
        action.triggered.connect(lambda: self.camera_event(self.cameraGroup.actions().index(action)))
        self.cameraGroup.addAction(action)
        self.cameraMenu.addAction(action)

    def show_cameras_of(self, world: World | None) -> None:
        """Have the cameras of a world in the menu, and no longer those of another one."""
        for index, trackball in reversed(list(enumerate(self.scene.cameras))):
            if isinstance(trackball, RidingTrackball):
                self.scene.remove_camera(index)
                action = self.cameraGroup.actions()[index]
                self.cameraGroup.removeAction(action)
                self.cameraMenu.removeAction(action)
        for name, camera in (world._cameras if world is not None else {}).items():
            self.add_camera(RidingTrackball(camera), name)

    def camera_event(self, cam_id: int) -> None:
        """Look through a camera: 0 has Y up, 1 has Z up."""
        self.scene.set_camera(cam_id)
        entries = self.cameraGroup.actions()
        if 0 <= cam_id < len(entries):
            entries[cam_id].setChecked(True)
        self.glwidget.update()

    def printCamEvent(self) -> None:  # noqa: N802
        """Print the present camera, ready to be pasted into a script."""
        print(repr(self.scene.tb))

    # Captures

    def capture_rate(self) -> int:
        """While playing, every n-th frame is captured."""
        return self._capture_rate

    def set_capture_rate(self, _capture_rate: int) -> None:
        """Capture every n-th frame while playing."""
        if _capture_rate < 1:
            raise ValueError(f"the capture rate is a number of frames, at least 1, not {_capture_rate}")
        self._capture_rate = int(_capture_rate)

    def capture_dir(self) -> str:
        """Folder of the pictures, made when needed."""
        return self.captures.path

    def set_capture_dir(self, _capture_dir: str | os.PathLike[str]) -> None:
        """Set the folder of the pictures."""
        self.captures = CaptureFolder(_capture_dir)

    def prob_name(self) -> str:
        """What the simulation is called, `robot` if it does not say."""
        return str(self.safe_call_callback("name") or "robot")

    def screenshotEvent(self) -> None:  # noqa: N802
        """Save a picture as `<name>_frame.0000.png` in the capture folder."""
        self._save_picture(f"{self.prob_name()}_frame")

    def capture(self) -> None:
        """Save a picture as `<name>.0000.png` in the capture folder."""
        self._save_picture(self.prob_name())

    def _save_picture(self, name: str) -> None:
        with self.runtime.guarded():
            self.glwidget.capture(name)

    def tell(self, text: str) -> None:
        """Print a line, and show it in the status bar for a while."""
        print(text)
        self.statusBar().showMessage(text, _TOLD_MS)

    def emptyEvent(self) -> None:  # noqa: N802
        """Remove the pictures of the capture folder."""
        with self.runtime.guarded():
            self.tell(f"{self.captures.empty()} pictures removed from {self.captures.path}")

    def movieEvent(self) -> None:  # noqa: N802
        """Make `<name>.mp4` of the captured pictures, in real time."""
        name = self.prob_name()
        if not self.captures.pictures(name):
            self.statusBar().showMessage("No pictures for a movie: tick Capture and play first", _TOLD_MS)
            return
        with self.runtime.guarded():
            self.tell(f"movie: {self.captures.movie(name, self.movie_rate())}")

    def movie_rate(self) -> float:
        """Pictures a second, so that the movie runs in real time: one per `capture_rate` steps."""
        step = self.runtime.time_step
        return min(max(1.0 / (step * self._capture_rate), 1.0), 100.0) if step else 25.0
