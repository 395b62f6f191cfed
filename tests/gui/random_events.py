"""Random events on the window: `python tests/gui/random_events.py 500 cubes` does 500 of each kind.

Prints what was done; raises AssertionError for an exception or a leak.
"""

from __future__ import annotations

import ctypes
import gc
import os
import random
import sys
import tempfile
from collections import Counter
from collections.abc import Callable
from pathlib import Path
from typing import Any

from PyQt5.QtCore import QPoint, QPointF, Qt
from PyQt5.QtGui import QWheelEvent
from PyQt5.QtTest import QTest
from PyQt5.QtWidgets import QApplication

import pydart2
from gui.hands import drag
from pydart2.gui.pyqt5.side_panel import SidePanel
from pydart2.gui.pyqt5.window import PyQt5Window

MODELS = {  # and the time step of the examples, s; limp limbs in the air need a shorter one
    "cubes": ("skel/cubes.skel", 1.0 / 1000.0),
    "chain": ("skel/chain.skel", 1.0 / 5000.0),
    "fullbody1": ("skel/fullbody1.skel", 1.0 / 10000.0),
    "softBodies": ("skel/softBodies.skel", 1.0 / 1000.0),
    "atlas": ("sdf/atlas/atlas_v3_no_head.sdf", 1.0 / 1000.0),
}
NOT_TRIGGERED = ("open", "close")  # a dialog that waits for a person; the end
MAX_GROWTH = 20.0  # MB of memory in the second half of the events


class Monkey:
    """Plays with a window."""

    def __init__(self, model: str, seed: int, folder: str) -> None:
        self.random = random.Random(seed)
        name, step = MODELS[model]
        world = pydart2.World(step)
        path = pydart2.data_path(name)
        if path.endswith(".skel"):
            world = pydart2.World(step, path)
        else:
            world.add_skeleton(path)
        assert world.recording is not None
        world.recording.limit_bytes = 2_000_000
        self.world = world
        self.window = PyQt5Window(world, model)
        self.window.set_capture_dir(Path(folder) / "captures")
        self.window.set_capture_rate(200)
        panel = SidePanel(120)
        panel.add_push_button("button", lambda checked: None)
        panel.add_checkbox("box", True, lambda checked: None)
        self.panel = panel
        self.window.add_right_panel(panel)
        self.window.resize(720, 480)
        self.window.show()
        self.steps = 0
        self.window.runtime.after_step.append(self.count)
        self.kinds: dict[str, Callable[[], object]] = {
            f"action {name}": action.trigger
            for name, action in self.window.named_actions.items()
            if name not in NOT_TRIGGERED
        }
        for name in ("key", "click", "double_click", "wheel", "frame_slider", "dof_slider", "dof_box", "plot", "tree"):
            self.kinds[name] = getattr(self, name)
        for name in ("quantity", "speed", "camera", "resize", "panel_button", "panel_box", "dismiss"):
            self.kinds[name] = getattr(self, name)
        for name, button, modifier in (
            ("turn", Qt.LeftButton, Qt.NoModifier),
            ("zoom", Qt.LeftButton, Qt.ShiftModifier),
            ("move", Qt.LeftButton, Qt.ControlModifier),
            ("pull", Qt.RightButton, Qt.NoModifier),
        ):
            self.kinds[f"drag to {name}"] = lambda button=button, modifier=modifier: self.drag(button, modifier)

    def count(self) -> None:
        self.steps += 1

    def point(self) -> tuple[int, int]:
        picture = self.window.glwidget
        return self.random.randrange(picture.width()), self.random.randrange(picture.height())

    def key(self) -> None:
        QTest.keyClick(self.window, self.random.choice("ABCXYZ0123456789,.-+"))

    def click(self) -> None:
        QTest.mouseClick(self.window.glwidget, Qt.LeftButton, Qt.NoModifier, QPoint(*self.point()))

    def double_click(self) -> None:
        QTest.mouseDClick(self.window.glwidget, Qt.LeftButton, Qt.NoModifier, QPoint(*self.point()))

    def wheel(self) -> None:
        where, turn = QPointF(*self.point()), QPoint(0, self.random.choice((-240, -120, 120, 240)))
        event = QWheelEvent(where, where, QPoint(), turn, Qt.NoButton, Qt.NoModifier, Qt.NoScrollPhase, False)
        QApplication.sendEvent(self.window.glwidget, event)

    def drag(self, button: Any, modifier: Any) -> None:
        drag(self.window.glwidget, self.point(), self.point(), button, modifier)

    def frame_slider(self) -> None:
        slider = self.window.rangeSlider
        slider.setValue(self.random.randint(slider.minimum(), slider.maximum()))

    def row(self) -> Any:
        rows = self.window.inspector.sliders.rows
        return self.random.choice(rows) if rows else None

    def dof_slider(self) -> None:
        if row := self.row():
            row.slider.setValue(self.random.randint(0, 1000))

    def dof_box(self) -> None:
        if row := self.row():
            row.box.setValue(self.random.uniform(-3.0, 3.0))

    def plot(self) -> None:
        if row := self.row():
            row.plot.click()

    def tree(self) -> None:
        tree = self.window.inspector.tree
        tree.setCurrentItem(self.random.choice([*tree._items.values(), None]))

    def quantity(self) -> None:
        self.window.inspector.plots.box.setCurrentIndex(self.random.randrange(3))

    def speed(self) -> None:
        box = self.window.speedBox
        box.setCurrentIndex(self.random.randrange(box.count() - 1))  # not as fast as possible

    def camera(self) -> None:
        self.random.choice(self.window.cameraGroup.actions()).trigger()

    def resize(self) -> None:
        self.window.resize(self.random.randint(500, 760), self.random.randint(360, 520))

    def panel_button(self) -> None:
        QTest.mouseClick(self.panel.widgets["button"], Qt.LeftButton)

    def panel_box(self) -> None:
        QTest.mouseClick(self.panel.widgets["box"], Qt.LeftButton, pos=QPoint(8, 8))

    def dismiss(self) -> None:
        self.window.errorPane.dismiss_button.click()

    def play(self, times: int) -> Counter[str]:
        """Do each kind so many times, in random order."""
        order = [kind for kind in self.kinds for _ in range(times)]
        self.random.shuffle(order)
        done: Counter[str] = Counter()
        memory = widgets = 0.0
        for i, kind in enumerate(order):
            self.kinds[kind]()
            done[kind] += 1
            if i % 4 == 0:
                QApplication.processEvents()
            self.window.playAction.setChecked(True)
            errors = self.window.runtime.errors
            assert not errors, f"after {i} events, at {kind}: {errors[-1]}"
            if i == len(order) // 2:
                memory, widgets = resident_megabytes(), len(QApplication.allWidgets())
        QApplication.processEvents()
        grown, more = resident_megabytes() - memory, len(QApplication.allWidgets()) - widgets
        print(f"{len(order)} events, {self.steps} steps")
        print(f"second half: {grown:+.1f} MB, {more:+.0f} widgets")
        if "ASAN_OPTIONS" not in os.environ:  # AddressSanitizer keeps what has been freed
            assert grown < MAX_GROWTH, f"{grown} MB more"
        assert self.steps > len(order) // 20, "it hardly played"
        assert more < 400, f"{more} widgets more"
        return done


def resident_megabytes() -> float:
    """Memory of the process, without what it has freed and only the allocator still holds."""
    gc.collect()
    ctypes.CDLL("libc.so.6").malloc_trim(0)
    for line in Path("/proc/self/status").read_text().splitlines():
        if line.startswith("VmRSS"):
            return float(line.split()[1]) / 1024.0
    return 0.0


def main(times: int, model: str, seed: int = 1) -> None:
    """Play, and close the window."""
    from pydart2.gui.pyqt5.application import application

    raised: list[BaseException] = []
    application("random events")
    before, sys.excepthook = sys.excepthook, lambda kind, value, trace: raised.append(value)
    try:
        with tempfile.TemporaryDirectory() as folder:
            monkey = Monkey(model, seed, folder)
            done = monkey.play(times)
            monkey.window.close()
    finally:
        sys.excepthook = before
    assert not raised, raised
    assert min(done.values()) >= times
    print(f"{model}: {len(done)} kinds, {sum(done.values())} events")


if __name__ == "__main__":
    main(int(sys.argv[1]), sys.argv[2])
