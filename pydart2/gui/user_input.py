"""The one table of keys and mouse buttons: windows obey it, the help and the documentation are made from it.

Letters and digits are left to the simulation's `on_key_press`.
"""

from __future__ import annotations

from typing import NamedTuple


class Key(NamedTuple):
    """A key of the window: what it does, its names in Qt's spelling, and its sentence in the help."""

    action: str
    keys: tuple[str, ...]
    text: str


class Drag(NamedTuple):
    """A way to drag the mouse in the picture."""

    action: str
    keys: str
    text: str


KEYS = (
    Key("play", ("Space",), "Play or pause"),
    Key("step", ("Right",), "One step; in a recording one frame on"),
    Key("back", ("Left",), "One recorded frame back"),
    Key("first_frame", ("Home",), "First recorded frame"),
    Key("last_frame", ("End",), "Last recorded frame"),
    Key("animate", ("Ctrl+Space",), "Play the recording"),
    Key("reset", ("Ctrl+R",), "Reset"),
    Key("faster", ("Ctrl+Up",), "Twice as fast"),
    Key("slower", ("Ctrl+Down",), "Half as fast"),
    Key("next_camera", ("F2",), "Next camera"),
    Key("frame_all", ("F3",), "Show everything"),
    Key("follow", ("F4",), "Follow the selected body"),
    Key("contacts", ("F5",), "Contacts"),
    Key("contact_forces", ("F6",), "Contact forces"),
    Key("centers_of_mass", ("F7",), "Centres of mass"),
    Key("frames", ("F8",), "Body frames"),
    Key("joint_axes", ("F9",), "Joint axes"),
    Key("collision_shapes", ("Ctrl+F5",), "Collision shapes"),
    Key("sleepers", ("Ctrl+F8",), "Sleeping bodies in a paler colour"),
    Key("wireframe", ("Ctrl+F6",), "Wireframe"),
    Key("shadows", ("Ctrl+F7",), "Shadows"),
    Key("inspector", ("F10",), "Inspector"),
    Key("full_screen", ("F11",), "Full screen"),
    Key("screenshot", ("F12",), "Save a picture in the capture folder"),
    Key("capture", ("Ctrl+F12",), "Capture pictures while playing, and each frame of an animation"),
    Key("movie", ("Ctrl+M",), "Make a movie of the captured pictures"),
    Key("empty", ("Ctrl+E",), "Empty the capture folder of its pictures"),
    Key("print_camera", ("Ctrl+F2",), "Print the camera, ready for a script"),
    Key("open", ("Ctrl+O",), "Open a model (or drop its file on the window)"),
    Key("help", ("F1",), "This help"),
    Key("close", ("Esc",), "Close"),
)

DRAGS = (
    Drag("rotate", "drag", "Turn the camera"),
    Drag("zoom", "Shift + drag, wheel", "Zoom"),
    Drag("translate", "Ctrl + drag, middle drag", "Move the camera"),
    Drag("pull", "right drag", "Pull a body by a spring, while playing"),
    Drag("select", "click, double click", "Select a body; follow it"),
)

#: The keys of GLUTWindow, as its callback gets them.
GLUT_KEYS = {
    b"\x1b": ("close", "Esc", "Close"),
    b" ": ("play", "Space", "Play or pause"),
    b"a": ("animate", "a", "Play or pause the recording"),
    b"[": ("back", "[", "One recorded frame back"),
    b"]": ("forward", "]", "One recorded frame on"),
    b"c": ("capture", "c", "Save a picture"),
}


def shortcut(action: str) -> str:
    """The key of an action, in Qt's spelling; KeyError if it has none."""
    return {key.action: key.keys[0] for key in KEYS}[action]


def drag_action(button: str, shift: bool = False, control: bool = False) -> str:
    """What a drag with a button, `left` `middle` or `right`, does: the action of one of `DRAGS`."""
    if button == "right":
        return "pull"
    if button == "middle" or control:
        return "translate"
    return "zoom" if shift else "rotate"


def help_rows() -> list[tuple[str, str]]:
    """(keys, sentence) of everything that the window obeys."""
    rows = [(drag.keys, drag.text) for drag in DRAGS]
    return rows + [(" or ".join(key.keys), key.text) for key in KEYS]
