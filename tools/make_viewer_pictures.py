"""Makes the pictures of the viewer in docs/images; under `xvfb-run -s "-screen 0 1680x1050x24"` without a screen."""

from __future__ import annotations

import linecache
import sys
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image
from PyQt5.QtCore import QPoint, QPointF, Qt
from PyQt5.QtTest import QTest

import pydart2
from pydart2.gui.camera import as_camera
from pydart2.gui.pyqt5.window import PyQt5Window
from pydart2.gui.trackball import Trackball

IMAGES = Path(__file__).resolve().parent.parent / "docs" / "images"
SCRIPT_NAME = "my_robot.py"
SCRIPT = """
class Robot(pydart2.World):
    gain = 0.0

    def on_step_event(self):
        if self.frame > 500:
            self.skeletons[0].set_forces({"joint 7_x": 1.0 / self.gain})
"""
SIZE = (1280, 760)


class Hold:
    """Stable PD control of the initial pose, without forces on the root."""

    def __init__(self, skel: pydart2.Skeleton, stiffness: float, damping: float) -> None:
        self.skel, self.target = skel, skel.q
        self.kp, self.kd = (np.array([0.0] * 6 + [gain] * (skel.ndofs - 6)) for gain in (stiffness, damping))

    def compute(self) -> Any:
        tau = self.skel.get_spd(self.target, self.skel.world.dt, self.kp, self.kd)
        tau[:6] = 0.0
        return tau


def window_of(world: pydart2.World, title: str) -> PyQt5Window:
    window = PyQt5Window(world, title)
    window.resize(*SIZE)
    window.show()
    window.app.setActiveWindow(window)
    QTest.qWait(300)
    return window


def pixel_of(window: PyQt5Window, point: Any) -> QPoint:
    picture = window.glwidget
    camera = as_camera(window.scene.tb)
    clip = camera.projection(picture.width() / picture.height()) @ camera.view @ np.append(point, 1.0)
    x, y = clip[:2] / clip[3]
    return QPoint(int((x + 1.0) / 2.0 * picture.width()), int((1.0 - y) / 2.0 * picture.height()))


def plot(window: PyQt5Window, *names: str) -> None:
    for row in window.inspector.sliders.rows:
        if row.dof.name in names:
            row.plot.setChecked(True)


def steps(window: PyQt5Window, count: int) -> None:
    for _ in range(count):
        window.runtime.step()


def save(window: PyQt5Window, name: str) -> None:
    window.refresh()
    QTest.qWait(400)
    path = IMAGES / f"viewer-{name}.png"
    window.grab().save(str(path))
    with Image.open(path) as image:
        image.convert("RGB").save(path, optimize=True)
    print(path.name, path.stat().st_size // 1000, "kB")
    window.close()


def pull() -> None:
    """A standing human whose hand is pulled."""
    world = pydart2.World(0.001, "./data/skel/fullbody1.skel")
    human = world.skeletons[1]
    q = human.q
    q["j_pelvis_pos_y"] = -0.05
    q["j_thigh_left_z", "j_shin_left", "j_heel_left_1"] = 0.15, -0.4, 0.25
    q["j_thigh_right_z", "j_shin_right", "j_heel_right_1"] = 0.15, -0.4, 0.25
    human.set_positions(q)
    human.set_controller(Hold(human, 400.0, 40.0))
    window = window_of(world, "Pulling a hand")
    window.scene.replace_camera(0, Trackball(rot=[-0.10, 0.30, -0.03, 0.95], trans=[0.0, 0.25, -2.6]))
    window.camera_event(0)
    window.inspector.show_skeleton(human)
    plot(window, "j_bicep_right_x", "j_bicep_right_y", "j_forearm_right_1", "j_bicep_right_z")
    steps(window, 400)
    hand = human.body("h_hand_right")
    start = pixel_of(window, hand.C)
    QTest.mousePress(window.glwidget, Qt.RightButton, Qt.NoModifier, start)
    grip = window.glwidget.overlays.pull
    assert grip is not None
    for i in range(20):
        window.glwidget.move_pull(QPointF(start.x() + 13 * i, start.y() - 9 * i))
        steps(window, 12)
    window.named_actions["contact_forces"].setChecked(False)
    window.inspector.tree.scrollToItem(window.inspector.tree._items[hand])
    save(window, "pull")


def inspect() -> None:
    """Atlas with its frames and axes, a body selected."""
    world = pydart2.World(0.001)
    world.set_gravity([0.0, 0.0, -9.81])
    atlas = world.add_skeleton("./data/sdf/atlas/atlas_v3_no_head.sdf")
    q = atlas.q
    q["l_arm_shy", "r_arm_shy"] = -0.7, 0.7
    q["l_leg_hpy", "r_leg_hpy", "l_leg_kny", "r_leg_kny"] = -0.4, -0.4, 0.8, 0.8
    atlas.set_positions(q)
    window = window_of(world, "Atlas")
    window.commands.frame_all()
    for name in ("joint_axes", "centers_of_mass"):
        window.named_actions[name].setChecked(True)
    window.commands.select(atlas.body("l_lleg"))
    window.glwidget.overlays.selected = atlas.body("l_lleg")
    save(window, "inspect")


def help_and_error() -> None:
    """The help, and what is shown when user code raises."""
    world = pydart2.World(0.001, "./data/skel/softBodies.skel")
    window = window_of(world, "Soft bodies")
    window.commands.frame_all()
    steps(window, 300)
    window.named_actions["help"].setChecked(True)
    save(window, "help")

    names: dict[str, Any] = {"pydart2": pydart2}
    linecache.cache[SCRIPT_NAME] = len(SCRIPT), None, SCRIPT.splitlines(keepends=True), SCRIPT_NAME
    exec(compile(SCRIPT, SCRIPT_NAME, "exec"), names)
    world = names["Robot"](0.001, "./data/skel/chain.skel")
    window = window_of(world, "Chain")
    window.commands.frame_all()
    window.inspector.show_skeleton(world.skeletons[0])
    for row in window.inspector.sliders.rows[:3]:
        row.plot.setChecked(True)
    world.skeletons[0].q = 0.5 * np.sin(np.arange(world.skeletons[0].ndofs))
    while not window.runtime.errors:
        window.runtime.step()
    save(window, "error")


if __name__ == "__main__":
    for make in (pull, inspect, help_and_error):
        if len(sys.argv) < 2 or make.__name__ in sys.argv[1:]:
            make()
