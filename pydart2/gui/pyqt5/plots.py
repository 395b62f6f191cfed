"""Live plots of chosen dofs."""

from __future__ import annotations

from bisect import bisect_left

import numpy as np
import pyqtgraph as pg
from PyQt5.QtCore import Qt
from PyQt5.QtWidgets import QComboBox, QLabel, QVBoxLayout, QWidget

from pydart2.dof import Dof

#: Quantity → (function of a dof, unit).
QUANTITIES = {
    "position": (Dof.position, "rad, m"),
    "velocity": (Dof.velocity, "rad/s, m/s"),
    "force": (Dof.force, "N m, N"),
}
COLORS = ("#2468c9", "#e07b16", "#2a9d5c", "#cf3b34", "#7d55c7", "#8a6142", "#d659a5", "#5d6d7e")
WINDOW = 10.0  # s that are shown
_SPACING = 0.005  # s between two samples
_KEPT = 100_000  # samples of a dof, at least


class Samples:
    """Times, in order, and the values of a dof then."""

    def __init__(self) -> None:
        self.times: list[float] = []
        self.values: list[float] = []

    def add(self, time: float, value: float) -> None:
        """Add a sample; those that are not before it go, as after a reset, and the oldest if there are very many."""
        del self.times[(i := bisect_left(self.times, time)) :], self.values[i:]
        if len(self.times) >= 2 * _KEPT:
            del self.times[:_KEPT], self.values[:_KEPT]
        self.times.append(time)
        self.values.append(value)

    def between(self, start: float, end: float) -> tuple[list[float], list[float]]:
        """Those from `start` to `end`, with one more at each side."""
        part = slice(max(bisect_left(self.times, start) - 1, 0), bisect_left(self.times, end) + 1)
        return self.times[part], self.values[part]


class DofPlots(QWidget):
    """Ten simulated seconds of some dofs.

    What is recorded already is there when a dof is chosen, but for its force, which no recording has. While a recorded
    frame is shown, a line marks its time.

    Attributes
    ----------
    quantity : str
        One of QUANTITIES.
    """

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.box = QComboBox()
        self.box.addItems(list(QUANTITIES))
        self.box.setToolTip("What is plotted")
        self.box.currentIndexChanged.connect(lambda _index: self.look_back())
        self.plot = pg.PlotWidget(background="#ffffff")
        self.plot.setMenuEnabled(False)
        self.plot.hideButtons()
        self.plot.showGrid(x=True, y=True, alpha=0.15)
        self.plot.setLabel("bottom", "time, s")
        self.legend = self.plot.addLegend(offset=(6, 4), labelTextSize="8pt", labelTextColor="#39424e")
        for axis in ("left", "bottom"):
            self.plot.getAxis(axis).setPen("#a9b1bc")
            self.plot.getAxis(axis).setTextPen("#39424e")
            self.plot.getAxis(axis).enableAutoSIPrefix(False)
        self.legend.setBrush("#ffffff50")
        self.marker = pg.InfiniteLine(pen=pg.mkPen("#39424e", width=1.2, style=Qt.DashLine))
        self.marker.hide()
        self.plot.addItem(self.marker, ignoreBounds=True)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        self.hint = QLabel("The button at the end of a joint's row plots it here.")
        self.hint.setAlignment(Qt.AlignTop)
        self.hint.setWordWrap(True)
        layout.addWidget(self.box)
        layout.addWidget(self.hint, 1)
        layout.addWidget(self.plot, 1)
        self.plot.hide()
        self._curves: dict[Dof, pg.PlotDataItem] = {}
        self._samples: dict[Dof, Samples] = {}
        self._time = float("-inf")

    @property
    def quantity(self) -> str:
        """What is plotted."""
        return self.box.currentText()

    @property
    def dofs(self) -> list[Dof]:
        """What it is plotted of."""
        return list(self._curves)

    def set_plotted(self, dof: Dof, on: bool) -> None:
        """Plot a dof or not."""
        if on and dof not in self._curves:
            color = next((c for c in COLORS if c not in {curve.color for curve in self._curves.values()}), COLORS[0])
            curve = self.plot.plot(pen=pg.mkPen(color, width=1.6), name=dof.name, antialias=True)
            curve.color = color
            self._curves[dof] = curve
            self._samples[dof] = self._past(dof)
        elif not on and dof in self._curves:
            self.plot.removeItem(self._curves.pop(dof))
            del self._samples[dof]
        self.plot.setVisible(bool(self._curves))
        self.hint.setVisible(not self._curves)

    def forget(self) -> None:
        """Plot nothing."""
        for dof in self.dofs:
            self.set_plotted(dof, False)

    def look_back(self) -> None:
        """Plot what is recorded now; the quantity is another one, or there was a reset."""
        self._samples = {dof: self._past(dof) for dof in self._samples}
        self.refresh(None)

    def _past(self, dof: Dof) -> Samples:
        """What is recorded of a dof."""
        samples = Samples()
        recording = dof.skel.world.recording
        if recording is not None and self.quantity in ("position", "velocity"):
            read = recording.q if self.quantity == "position" else recording.dq
            times, values = recording.t, np.asarray(read(dof.skel))[:, dof.index_in_skeleton()]
            rows = np.flatnonzero(np.diff(np.floor(times / _SPACING + 1e-6), prepend=-1.0) > 0.0)
            for row in rows[np.isfinite(values[rows])]:
                samples.add(float(times[row]), float(values[row]))
        return samples

    def sample(self, time: float) -> None:
        """Take a sample at a simulated time, s; those of an earlier run go when time has gone back."""
        if not self._curves or 0.0 <= time - self._time < _SPACING - 1e-9:
            return
        self._time = time
        read = QUANTITIES[self.quantity][0]
        for dof, samples in self._samples.items():
            samples.add(time, read(dof))

    def samples(self, dof: Dof) -> list[tuple[float, float]]:
        """(time, value) of a plotted dof, oldest first."""
        return list(zip(self._samples[dof].times, self._samples[dof].values))

    def refresh(self, time: float | None) -> None:
        """Draw the samples around the time that is shown, s."""
        self.marker.setVisible(bool(self._curves))
        if not self._curves or not self.isVisible():
            return
        self.plot.setLabel("left", QUANTITIES[self.quantity][1])
        newest = max((samples.times[-1] for samples in self._samples.values() if samples.times), default=0.0)
        shown = newest if time is None else time
        end = min(max(newest, shown), shown + 0.5 * WINDOW)
        for dof, curve in self._curves.items():
            curve.setData(*self._samples[dof].between(end - WINDOW, end))
        self.marker.setPos(shown)
        self.marker.setVisible(shown < newest - _SPACING)
        self.plot.setXRange(max(end - WINDOW, 0.0), max(end, 1.0), padding=0.0)
