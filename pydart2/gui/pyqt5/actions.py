"""The window's actions, its toolbars and menus: made from tables."""

from __future__ import annotations

from PyQt5.QtCore import QSize, Qt
from PyQt5.QtGui import QKeySequence
from PyQt5.QtWidgets import QAction, QComboBox, QMainWindow, QMenu, QSizePolicy, QSlider, QToolBar

from pydart2.gui.overlays import Overlays
from pydart2.gui.pyqt5.style import icon
from pydart2.gui.user_input import KEYS

#: Action → text on the button, and a method: of the window if it ends with Event, else of its Commands.
#: The key and the sentence come from user_input.KEYS.
_TEXTS = {
    "reset": ("Reset", "resetEvent"),
    "step": ("Step", "stepEvent"),
    "play": ("Play", "playEvent"),
    "animate": ("Anim", "animEvent"),
    "screenshot": ("Screenshot", "screenshotEvent"),
    "capture": ("Capture", ""),
    "empty": ("Empty", "emptyEvent"),
    "movie": ("Movie", "movieEvent"),
    "print_camera": ("Print Camera", "printCamEvent"),
    "back": ("One Frame Back", "back"),
    "first_frame": ("First Frame", "first_frame"),
    "last_frame": ("Last Frame", "last_frame"),
    "faster": ("Faster", "faster"),
    "slower": ("Slower", "slower"),
    "next_camera": ("Next Camera", "next_camera"),
    "frame_all": ("Show Everything", "frame_all"),
    "follow": ("Follow Selected Body", "follow"),
    "contacts": ("Contacts", "show_overlays"),
    "contact_forces": ("Contact Forces", "show_overlays"),
    "centers_of_mass": ("Centres of Mass", "show_overlays"),
    "frames": ("Body Frames", "show_overlays"),
    "joint_axes": ("Joint Axes", "show_overlays"),
    "collision_shapes": ("Collision Shapes", "show_overlays"),
    "sleepers": ("Sleeping Bodies", "show_overlays"),
    "wireframe": ("Wireframe", "show_overlays"),
    "shadows": ("Shadows", "show_overlays"),
    "inspector": ("Inspector", "show_inspector"),
    "full_screen": ("Full Screen", "full_screen"),
    "open": ("Open Model…", "open"),
    "help": ("Keys and Mouse", "show_help"),
    "close": ("Close", "escapeEvent"),
}
_CHECKABLE = {"play", "animate", "capture", "follow", "inspector", "full_screen", "help", *Overlays.TOGGLES}
_SHOWN = {name for name in Overlays.TOGGLES if getattr(Overlays(), name)}
_TOOLBAR = ("reset", "step", "play", "animate", None, "screenshot", "capture", "empty", "movie", None)
_VIEW_BAR = ("frame_all", "follow", None, *Overlays.TOGGLES, None, "help")
_SCRUB = ("back", "first_frame", "last_frame")
_MENUS: dict[str, tuple[str | None, ...]] = {
    "File": ("open", None, "close"),
    "Simulation": ("reset", "step", "play", None, "faster", "slower"),
    "Camera": ("print_camera", None, "next_camera", "frame_all", "follow", None),
    "View": (*Overlays.TOGGLES, None, "inspector", "full_screen"),
    "Recording": ("screenshot", None, "capture", "movie", "empty", None, "animate", *_SCRUB),
    "Help": ("help",),
}
SPEEDS = (0.1, 0.25, 0.5, 1.0, 2.0, 4.0, 8.0, float("inf"))


def make_actions(window: QMainWindow, commands: object) -> dict[str, QAction]:
    """All actions by name, with shortcuts, which call the window and its commands; those to tick by `toggled`."""
    rows = {key.action: key for key in KEYS}
    actions = {}
    for name, (text, method) in _TEXTS.items():
        action = QAction(text, window)
        action.setObjectName(name)
        action.setShortcuts([QKeySequence(key) for key in rows[name].keys])
        action.setToolTip(f"{rows[name].text} ({' or '.join(rows[name].keys)})")
        action.setStatusTip("")
        action.setCheckable(name in _CHECKABLE)
        action.setChecked(name in _SHOWN)
        if method:
            slot = getattr(window if method.endswith("Event") else commands, method)
            if name in _CHECKABLE:
                action.toggled.connect(slot)
            else:
                action.triggered.connect(lambda _checked=False, slot=slot: slot())
        window.addAction(action)
        actions[name] = action
    return actions


def make_toolbars(window: QMainWindow, actions: dict[str, QAction]) -> tuple[QToolBar, QSlider, QComboBox]:
    """The control bar on top with the frame slider and the choice of speed; on the left what is shown."""
    bar = QToolBar("Control", window)
    bar.setObjectName("control")
    bar.setMovable(False)
    bar.setIconSize(QSize(20, 20))
    bar.setToolButtonStyle(Qt.ToolButtonTextBesideIcon)
    _fill(bar, _TOOLBAR, actions)
    slider = QSlider(Qt.Horizontal)
    slider.setMinimumWidth(120)
    slider.setSizePolicy(QSizePolicy.Expanding, QSizePolicy.Fixed)
    slider.setFocusPolicy(Qt.NoFocus)
    slider.setToolTip("Frame of the recording")
    bar.addWidget(slider)
    speed = QComboBox()
    speed.setFocusPolicy(Qt.NoFocus)
    speed.setToolTip("Simulated seconds per second")
    for value in SPEEDS:
        speed.addItem("max" if value == float("inf") else f"{value:g}×", value)
    speed.setCurrentIndex(SPEEDS.index(1.0))
    bar.addWidget(speed)
    window.addToolBar(Qt.TopToolBarArea, bar)

    view = QToolBar("View", window)
    view.setObjectName("view")
    view.setMovable(False)
    view.setIconSize(QSize(20, 20))
    _fill(view, _VIEW_BAR, actions)
    window.addToolBar(Qt.LeftToolBarArea, view)
    return bar, slider, speed


def _fill(bar: QToolBar, names: tuple[str | None, ...], actions: dict[str, QAction]) -> None:
    for name in names:
        if name is None:
            bar.addSeparator()
        else:
            actions[name].setIcon(icon(name, "pause" if name == "play" else None))
            bar.addAction(actions[name])


def make_menus(window: QMainWindow, actions: dict[str, QAction]) -> dict[str, QMenu]:
    """The menus by title."""
    menus = {}
    for title, names in _MENUS.items():
        menu = window.menuBar().addMenu(title)
        for name in names:
            if name is None:
                menu.addSeparator()
            else:
                menu.addAction(actions[name])
        menus[title] = menu
    return menus
