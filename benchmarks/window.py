"""Pictures a second of the window while Atlas falls in real time: python benchmarks/window.py [seconds].

The picture has 1280 by 720 pixels. Prints where the time of the main thread goes and what OpenGL's threads take beside
it. Without a screen it runs with `QT_QPA_PLATFORM=offscreen`, or under `xvfb-run -s "-screen 0 1920x1080x24"`.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from typing import Any

from PyQt5.QtTest import QTest

import pydart2
from pydart2.gui.pyqt5.window import PyQt5Window

WIDTH, HEIGHT, BAR = 1280, 720, 25.0


class Watch:
    """Counts the calls of a method, and the processor's seconds in them."""

    def __init__(self, owner: Any, name: str) -> None:
        self.calls, self.seconds = 0, 0.0
        self._function: Callable[..., Any] = getattr(owner, name)
        setattr(owner, name, self)

    def __call__(self, *args: Any, **options: Any) -> Any:
        start = time.thread_time()
        try:
            return self._function(*args, **options)
        finally:
            self.calls += 1
            self.seconds += time.thread_time() - start


def atlas_in_a_window() -> PyQt5Window:
    """Atlas over a ground, with the inspector beside the picture."""
    world = pydart2.World(0.001, up="z")
    world.add_skeleton("./data/sdf/atlas/atlas_v3_no_head.sdf")
    world.add_ground(-0.93)
    world.reset()
    window = PyQt5Window(world, "Atlas")
    window.show()
    QTest.qWait(200)
    picture = window.glwidget
    window.resize(window.width() + WIDTH - picture.width(), window.height() + HEIGHT - picture.height())
    QTest.qWait(200)
    window.commands.frame_all()
    return window


def main() -> None:
    window = atlas_in_a_window()
    world, picture = window.sim, window.glwidget
    window.playAction.setChecked(True)
    QTest.qWait(500)
    watches = {
        "simulation": Watch(window.runtime, "advance"),
        "drawing": Watch(picture, "draw"),
        "widgets": Watch(window, "synchronize"),
    }
    start = time.perf_counter(), time.thread_time(), time.process_time(), world.t
    QTest.qWait(round(1000 * (float(sys.argv[1]) if len(sys.argv) > 1 else 5.0)))
    now = time.perf_counter(), time.thread_time(), time.process_time(), world.t
    clock, thread, process, simulated = (after - before for after, before in zip(now, start))
    window.playAction.setChecked(False)
    window.close()

    pictures = watches["drawing"].calls
    where = f"{type(picture).__name__}, platform {window.app.platformName()}"
    print(f"Atlas, {picture.width()} by {picture.height()}, {where}")
    print(f"  {pictures / clock:.1f} pictures/s (bar {BAR:g}) at {simulated / clock:.2f} x real time")
    print("  ms of a processor for each picture:")
    spent = {name: watch.seconds for name, watch in watches.items()}
    spent["reading, showing, Qt"] = thread - sum(spent.values())
    spent["OpenGL's threads"] = process - thread
    for name, seconds in spent.items():
        print(f"    {name:22s} {1000.0 * seconds / pictures:6.1f}")
    print(f"  in all {process / clock:.2f} processors were busy with it")


if __name__ == "__main__":
    main()
