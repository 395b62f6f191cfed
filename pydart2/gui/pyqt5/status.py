"""The status bar: what the simulation says, the frame, and how fast it runs."""

from __future__ import annotations

import math

from PyQt5.QtCore import Qt
from PyQt5.QtGui import QPainter, QPaintEvent, QPalette
from PyQt5.QtWidgets import QLabel, QSizePolicy, QStatusBar

from pydart2.gui.runtime import Runtime


class _Elided(QLabel):
    """A label whose text ends with … where there is no room for all of it."""

    def paintEvent(self, event: QPaintEvent) -> None:  # noqa: N802
        """Draw what there is room for."""
        text = self.fontMetrics().elidedText(self.text(), Qt.ElideRight, self.contentsRect().width())
        self.style().drawItemText(
            QPainter(self), self.contentsRect(), int(self.alignment()), self.palette(), True, text, QPalette.WindowText
        )


class StatusView:
    """Labels of a status bar.

    Attributes
    ----------
    text, frame, pace : QLabel
        The simulation's own words; `frame 120 of 431, 0.120 s`; `0.98× real time`.
    """

    def __init__(self, bar: QStatusBar) -> None:
        bar.setSizeGripEnabled(False)
        self.text, self.frame, self.pace = _Elided(), QLabel(), QLabel()
        self.pace.setToolTip("Simulated seconds per second, over the last second")
        self.text.setSizePolicy(QSizePolicy.Ignored, QSizePolicy.Preferred)  # long ones make no window wider
        bar.addWidget(self.text, 1)
        for label in (self.frame, self.pace):
            label.setMinimumWidth(130)
            bar.addPermanentWidget(label)

    def show(self, runtime: Runtime, status: object) -> None:
        """Show what a runtime does; `status` is the simulation's answer, None if it has none."""
        own = str(runtime.sim) if runtime.sim is not None else "No simulation: drop a model file on the window"
        _set(self.text, own.partition("\n")[0] if status is None else str(status))
        self.text.setToolTip(own)
        frames = runtime.num_frames
        time = runtime.frame_time
        at = "" if time is None else f", {time:.3f} s"
        _set(self.frame, f"frame {runtime.frame} of {frames - 1}{at}" if frames else "")
        _set(self.pace, pace_text(runtime))


def pace_text(runtime: Runtime) -> str:
    """`paused`, `replaying`, or the real-time factor beside the speed that is asked for."""
    if not runtime.playing:
        return runtime.mode.value
    factor, speed = runtime.pacer.real_time_factor, runtime.pacer.speed
    if factor is None:
        return "playing"
    wanted = "" if speed == 1.0 or math.isinf(speed) else f" (asked: {speed:g}×)"
    return f"{factor:.2f}× real time{wanted}"


def _set(label: QLabel, text: str) -> None:
    if label.text() != text:
        label.setText(text)
