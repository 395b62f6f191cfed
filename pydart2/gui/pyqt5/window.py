"""The viewer's window."""

from __future__ import annotations

import logging
import sys
import time
from signal import SIGINT
from types import FrameType
from typing import Any, ClassVar

from PyQt5.QtCore import QSize, Qt, QTimer
from PyQt5.QtGui import QCloseEvent, QDragEnterEvent, QDropEvent, QKeyEvent, QResizeEvent
from PyQt5.QtWidgets import QActionGroup, QApplication, QHBoxLayout, QVBoxLayout, QWidget

from pydart2.gui.capture import CaptureFolder
from pydart2.gui.closing import interrupt_calls, seconds_to_show
from pydart2.gui.pyqt5 import actions, style
from pydart2.gui.pyqt5.application import application, exceptions_to
from pydart2.gui.pyqt5.commands import Commands
from pydart2.gui.pyqt5.glwidget import make_picture
from pydart2.gui.pyqt5.inspector import Inspector
from pydart2.gui.pyqt5.panes import ErrorPane, HelpOverlay
from pydart2.gui.pyqt5.scripted import Scripted
from pydart2.gui.pyqt5.side_panel import SidePanel
from pydart2.gui.pyqt5.status import StatusView
from pydart2.gui.runtime import Runtime
from pydart2.simulation.up import up_of

_PICTURE_SIZE = (1280, 720)
_ACTIVE, _PAUSED = 1.0 / 30.0, 0.25  # s from one picture to the next
_TOLD = 0.1  # s from one text to the next while it moves; nobody reads faster
_WAIT_MS = 2
_SLICE = 0.003  # s of simulation before Qt has its turn
_ROOM = 800  # pixels of the window below which the inspector folds away, so that the picture keeps most of them


def signal_handler(signal: int, frame: FrameType | None) -> None:
    """End the process, for ``signal.signal(signal.SIGINT, signal_handler)`` in old scripts; windows do without."""
    print("You pressed Ctrl+C!" if signal == SIGINT else f"Signal {signal}")
    sys.exit(0)


class PyQt5Window(Scripted):
    """A window that shows and drives a simulation.

    >>> window = PyQt5Window(world, "My robot")
    >>> window.camera_event(1)
    >>> window.run()

    Parameters
    ----------
    sim
        A World, or any object with some of the functions of `callbacks.EVENTS`.
    title
        Of the window.

    Attributes
    ----------
    runtime : Runtime
        Plays, pauses, steps; `runtime.errors` are the tracebacks of user code.
    glwidget : GLWidget or ImageWidget
        The picture.
    scene : OpenGLScene
        Cameras.
    inspector : Inspector
    right_panel : SidePanel or None
    input_keys : list of str
        The last 16 keys with a character.
    after_reset : bool
        Whether there was no step since the last reset.

    Raises
    ------
    NoDisplayError
        If there is no display.
    """

    #: Of the original, which drew its text by GLUT; it stays False.
    GLUT_INITED: ClassVar[bool] = False

    def __init__(self, sim: Any = None, title: str | None = None) -> None:
        title = "Simulation Viewer" if title is None else title
        self.app = application(title)
        super().__init__()
        self.setWindowTitle(title)
        self.setPalette(style.palette())
        self.setStyleSheet(style.SHEET)
        self.setAcceptDrops(True)
        self.logger = logging.getLogger("pydart2.gui")
        self.runtime = Runtime(sim)
        self.commands = Commands(self)
        self.captures = CaptureFolder()
        self.after_reset = True
        self.input_keys: list[str] = []
        self.right_panel: SidePanel | None = None
        self._has_room, self._folded = True, False
        self.initActions()
        self.initToolbar()
        self.initMenu()
        self.initUI()
        self.initTimers()
        self.runtime.before_step.append(self.glwidget.apply_pull)
        self.runtime.after_step.append(self._after_step)
        self.runtime.on_error.append(self.errorPane.show_error)
        self.captureAction.toggled.connect(self._pictures_of_steps)
        self._show_simulation()
        self.topLeft()

    # Construction

    def initActions(self) -> None:  # noqa: N802 (the original's)
        """Make the actions; each is also an attribute, as `playAction`."""
        self.named_actions = made = actions.make_actions(self, self.commands)
        self.resetAction, self.stepAction = made["reset"], made["step"]
        self.playAction, self.animAction = made["play"], made["animate"]
        self.screenshotAction, self.captureAction = made["screenshot"], made["capture"]
        self.emptyAction, self.movieAction = made["empty"], made["movie"]
        self.printCamAction = made["print_camera"]

    def initToolbar(self) -> None:  # noqa: N802
        """Make the toolbars."""
        self.toolbar, self.rangeSlider, self.speedBox = actions.make_toolbars(self, self.named_actions)
        self.rangeSlider.valueChanged.connect(self.rangeSliderEvent)
        self.speedBox.currentIndexChanged.connect(self.commands.set_speed)

    def initMenu(self) -> None:  # noqa: N802
        """Make the menus."""
        self.cameraMenu = actions.make_menus(self, self.named_actions)["Camera"]
        self.cameraGroup = QActionGroup(self)

    def initUI(self) -> None:  # noqa: N802
        """Make the picture and the panels."""
        self.ui = QWidget()
        self.hbox = QHBoxLayout()
        self.hbox.setContentsMargins(0, 0, 0, 0)
        self.hbox.setSpacing(0)
        self.glwidget = make_picture(self)
        self.scene = self.glwidget.scene
        self.hbox.addWidget(self.glwidget, 1)
        self.errorPane = ErrorPane()
        self.errorPane.dismissed.connect(self.commands.dismiss_error)
        column = QVBoxLayout(self.ui)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addLayout(self.hbox, 1)
        column.addWidget(self.errorPane)
        self.setCentralWidget(self.ui)
        self.helpOverlay = HelpOverlay(self.glwidget)
        self.inspector = Inspector(self)
        self.addDockWidget(Qt.RightDockWidgetArea, self.inspector)
        self.inspector.chosen.connect(self.commands.select)
        self.inspector.posed.connect(self.commands.pose)
        self.inspector.visibilityChanged.connect(self.named_actions["inspector"].setChecked)
        self.glwidget.picked.connect(self.commands.select)
        self.statusView = StatusView(self.statusBar())
        self.look_upright()

    def look_upright(self) -> None:
        """Look through the camera whose up is the world's."""
        x, y, z = abs(up_of(self.world)) if self.world is not None else (0.0, 1.0, 0.0)
        self.camera_event(1 if z > max(x, y) else 0)

    def initTimers(self) -> None:  # noqa: N802
        """Make the timers: one simulates, one draws."""
        self.idleTimer = QTimer(self)
        self.idleTimer.setInterval(0)
        self.idleTimer.timeout.connect(self.idleTimerEvent)
        self._due = time.monotonic()  # the next picture
        self._told = 0.0
        self.renderTimer = QTimer(self)
        self.renderTimer.setSingleShot(True)
        self.renderTimer.setTimerType(Qt.PreciseTimer)
        self.renderTimer.timeout.connect(self.renderTimerEvent)
        self.renderTimer.start(0)

    def topLeft(self) -> None:  # noqa: N802
        """Take a good size, no larger than the screen, in its top left corner."""
        width = _PICTURE_SIZE[0] + (self.inspector.minimumWidth() if not self.inspector.isHidden() else 0)
        size = QSize(width + 48, _PICTURE_SIZE[1] + 100)
        if self.app.platformName() not in ("offscreen", "minimal"):  # whose screen is made up
            screen = (QApplication.screenAt(self.pos()) or QApplication.primaryScreen()).availableGeometry()
            size = size.boundedTo(screen.size())
            self.move(screen.topLeft())
        self.resize(size)
        self.resizeDocks([self.inspector], [self.inspector.minimumWidth()], Qt.Horizontal)

    # Simulation

    def set_simulation(self, sim: Any) -> None:
        """Show another simulation, and read its callbacks."""
        self.runtime.set_simulation(sim)
        self._show_simulation()

    def _show_simulation(self) -> None:
        self.glwidget.forget()
        self.inspector.setVisible(self.world is not None and self._has_room)
        self._folded = self.world is not None and not self._has_room
        self.inspector.show_world(self.world)
        self.show_cameras_of(self.world)
        for name in ("follow", *self.glwidget.overlays.TOGGLES):
            self.named_actions[name].setEnabled(self.world is not None)
        self.after_reset = True
        self.errorPane.hide()
        self.synchronize()

    # Panels

    def add_right_panel(self, panel: SidePanel) -> None:
        """Add a panel beside the picture; the window becomes wider by the panel."""
        box = QWidget()
        box.setFixedWidth(panel.width)
        box.setLayout(panel.build_layout())
        self.right_panel = panel
        self.hbox.addWidget(box)
        self.resize(self.width() + panel.width, self.height())

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802
        """Fold the inspector and the buttons' texts away in a narrow window, and back when there is room again."""
        super().resizeEvent(event)
        self.helpOverlay.place()
        has_room = self.width() >= _ROOM
        if has_room == self._has_room:
            return
        self._has_room = has_room
        self.toolbar.setToolButtonStyle(Qt.ToolButtonTextBesideIcon if has_room else Qt.ToolButtonIconOnly)
        if has_room and self._folded:
            self.inspector.show()
        self._folded = not has_room and not self.inspector.isHidden()
        if self._folded:
            self.inspector.hide()

    # Time

    def playEvent(self, on: bool) -> None:  # noqa: N802
        """Play or pause."""
        if on and not self.runtime.playing:
            self.errorPane.hide()
            self.runtime.play()
        elif not on and self.runtime.playing:
            self.runtime.pause()
        self.refresh()

    def animEvent(self, on: bool) -> None:  # noqa: N802
        """Play the recording or pause."""
        if on and not self.runtime.replaying:
            self.runtime.replay()
        elif not on and self.runtime.replaying:
            self.runtime.pause()
        self.refresh()

    def resetEvent(self) -> None:  # noqa: N802
        """Reset the simulation."""
        self.errorPane.hide()
        self.runtime.reset()
        self.after_reset = True
        self.inspector.plots.look_back()
        self.refresh()

    def stepEvent(self) -> None:  # noqa: N802
        """One step; within the recording, one frame on."""
        runtime = self.runtime
        if runtime.frame < runtime.num_frames - 1:
            runtime.scrub(runtime.frame + 1)
        else:
            self.errorPane.hide()
            runtime.step()
        self.refresh()

    def rangeSliderEvent(self, frame: int) -> None:  # noqa: N802
        """Show a recorded frame."""
        self.runtime.scrub(frame)
        self.refresh()

    def idleTimerEvent(self) -> None:  # noqa: N802
        """Simulate for a moment, or go on in the recording."""
        runtime = self.runtime
        before = runtime.frame, runtime.time
        runtime.advance(budget=_SLICE)
        waits = before == (runtime.frame, runtime.time) and before[1] is not None
        if waits != (self.idleTimer.interval() > 0):
            self.idleTimer.setInterval(_WAIT_MS if waits else 0)  # nothing is due: leave the processors to OpenGL
        if runtime.replaying and runtime.frame != before[0] and self.captureAction.isChecked():
            self.capture()
        if not (self.runtime.playing or self.runtime.replaying):
            self.synchronize()

    def renderTimerEvent(self) -> None:  # noqa: N802
        """Draw, and show the state in the status bar, the slider and the inspector."""
        now = time.monotonic()
        self.refresh()
        active = self.runtime.playing or self.runtime.replaying
        least = min(self.glwidget.paint_seconds, 0.2) / 0.75  # the simulation gets a quarter of the time
        self._due = max(self._due + _ACTIVE, now + least) if active else now + _PAUSED  # a late one delays no other
        self.renderTimer.start(round(1000.0 * (self._due - now)))

    def refresh(self) -> None:
        """Show the present state, and draw it soon."""
        self.synchronize()
        self.glwidget.update()

    def synchronize(self) -> None:
        """Let the widgets show what the runtime does."""
        runtime = self.runtime
        active = runtime.playing or runtime.replaying
        self.playAction.setChecked(runtime.playing)
        self.animAction.setChecked(runtime.replaying)
        if active != self.idleTimer.isActive():
            self.idleTimer.start() if active else self.idleTimer.stop()
            self.renderTimer.start(0)
        self.rangeSlider.blockSignals(True)
        self.rangeSlider.setRange(runtime.first_frame, max(runtime.num_frames - 1, 0))
        self.rangeSlider.setValue(runtime.frame)
        self.rangeSlider.blockSignals(False)
        now = time.monotonic()
        if active and now < self._told + _TOLD:
            return
        self._told = now
        with runtime.guarded():
            self.statusView.show(runtime, self.callbacks.call("status"))
            self.inspector.refresh(runtime.frame_time)

    def _pictures_of_steps(self, on: bool) -> None:
        self.runtime.steps_beside = not on  # pictures are taken in this thread

    def _after_step(self) -> None:
        self.after_reset = False
        if self.world is not None:
            self.inspector.plots.sample(self.world.t)
        if self.runtime.playing and self.captureAction.isChecked():
            frame = getattr(self.sim, "frame", None)
            if isinstance(frame, int) and frame % self.capture_rate() == 0:
                self.capture()

    # Events of Qt

    def keyPressEvent(self, event: QKeyEvent) -> None:  # noqa: N802
        """Give keys with a character to `on_key_press`; letters come in upper case."""
        if event.key() < 256:
            self.input_keys = [*self.input_keys[-15:], chr(event.key())]
            self.safe_call_callback("on_key_press", chr(event.key()))
            self.glwidget.update()
        else:
            super().keyPressEvent(event)

    def dragEnterEvent(self, event: QDragEnterEvent) -> None:  # noqa: N802
        """Take files."""
        if any(url.isLocalFile() for url in event.mimeData().urls()):
            event.acceptProposedAction()

    def dropEvent(self, event: QDropEvent) -> None:  # noqa: N802
        """Open the models that were dropped."""
        for url in event.mimeData().urls():
            if url.isLocalFile():
                self.commands.open_model(url.toLocalFile())
        event.acceptProposedAction()

    def escapeEvent(self) -> None:  # noqa: N802
        """Hide the help, else close."""
        if self.helpOverlay.isVisible():
            self.named_actions["help"].setChecked(False)
        else:
            self.close()

    def closeEvent(self, event: QCloseEvent) -> None:  # noqa: N802
        """Stop, and tell the simulation."""
        self.runtime.pause()
        self.idleTimer.stop()
        self.renderTimer.stop()
        self.safe_call_callback("on_close")
        super().closeEvent(event)

    # Running

    def run(self) -> None:
        """Show the window, and come back when it is closed.

        With PYDART2_VIEWER_SECONDS=N in the environment it plays at once and closes after N seconds; the process
        then ends with status 1 if user code has raised.
        """
        seconds = seconds_to_show()
        with exceptions_to(self.runtime.fail), interrupt_calls(self._close_soon):
            self.show()
            if seconds is not None:
                self.playAction.setChecked(True)
                QTimer.singleShot(round(1000.0 * seconds), self.close)
            self.app.exec_()
        if seconds is not None and self.runtime.errors:
            sys.exit(1)

    def _close_soon(self) -> None:
        """Close when Qt has its turn: nothing would stop a window that is closed before it is shown."""
        QTimer.singleShot(0, self.close)

    def run_application(self) -> None:
        """Like run()."""
        self.run()
