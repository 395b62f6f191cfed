"""Live plots of chosen dofs."""

from __future__ import annotations

from collections import deque

import pyqtgraph as pg
from PyQt5.QtWidgets import QComboBox, QVBoxLayout, QWidget

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


class DofPlots(QWidget):
    """The last ten simulated seconds of some dofs.

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
        self.box.currentIndexChanged.connect(lambda _index: self.clear())
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
        self.legend.setBrush("#ffffffc0")
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addWidget(self.box)
        layout.addWidget(self.plot)
        self._curves: dict[Dof, pg.PlotDataItem] = {}
        self._samples: dict[Dof, deque[tuple[float, float]]] = {}
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
            self._samples[dof] = deque(maxlen=round(WINDOW / _SPACING))
        elif not on and dof in self._curves:
            self.plot.removeItem(self._curves.pop(dof))
            del self._samples[dof]

    def forget(self) -> None:
        """Plot nothing."""
        for dof in self.dofs:
            self.set_plotted(dof, False)

    def clear(self) -> None:
        """Forget the samples."""
        self._time = float("-inf")
        for samples in self._samples.values():
            samples.clear()
        self.refresh()

    def sample(self, time: float) -> None:
        """Take a sample at a simulated time, s; those of an earlier run go when time has gone back."""
        if time < self._time:
            self.clear()
        if not self._curves or time - self._time < _SPACING:
            return
        self._time = time
        read = QUANTITIES[self.quantity][0]
        for dof, samples in self._samples.items():
            samples.append((time, read(dof)))

    def samples(self, dof: Dof) -> list[tuple[float, float]]:
        """(time, value) of a plotted dof, oldest first."""
        return list(self._samples[dof])

    def refresh(self) -> None:
        """Draw the samples."""
        if not self.isVisible():
            return
        self.plot.setLabel("left", QUANTITIES[self.quantity][1])
        for dof, curve in self._curves.items():
            samples = self._samples[dof]
            curve.setData([t for t, _ in samples], [value for _, value in samples])
        if self._curves and self._time > float("-inf"):
            self.plot.setXRange(max(self._time - WINDOW, 0.0), max(self._time, 1.0), padding=0.0)
