"""A slider for each dof of a skeleton."""

from __future__ import annotations

from math import isfinite, pi

from PyQt5.QtCore import Qt, pyqtSignal
from PyQt5.QtGui import QPalette
from PyQt5.QtWidgets import QDoubleSpinBox, QGridLayout, QLabel, QScrollArea, QSlider, QToolButton, QWidget

from pydart2.dof import Dof
from pydart2.gui.pyqt5.style import icon
from pydart2.skeleton import Skeleton

_STEPS = 1000


def dof_range(dof: Dof) -> tuple[float, float]:
    """From where to where a slider goes: the dof's limits, or 2 m or half a turn around its initial position."""
    low, high = dof.position_lower_limit(), dof.position_upper_limit()
    middle = dof.initial_position()
    reach = pi if _turns(dof) else 2.0
    return (low if isfinite(low) else middle - reach), (high if isfinite(high) else middle + reach)


def _turns(dof: Dof) -> bool:
    kind = dof.joint.type().removesuffix("Joint")
    slides = {"Prismatic": 1, "Translational": 3, "Translational2D": 2, "TranslationalJoint2D": 2, "Planar": 2}
    if kind == "Free":
        return dof.index_in_joint() < 3
    return dof.index_in_joint() >= slides.get(kind, 0)


class DofRow:
    """The name, the slider, the number and the plot button of one dof."""

    def __init__(self, dof: Dof, grid: QGridLayout, row: int, owner: DofSliders) -> None:
        self.dof = dof
        self.low, self.high = dof_range(dof)
        self.owner = owner
        self.label = QLabel(dof.name)
        self.label.setToolTip(f"{dof.name}: {'rad' if _turns(dof) else 'm'}, {self.low:.4g} to {self.high:.4g}")
        self.label.setFixedWidth(112)
        self.slider = QSlider(Qt.Horizontal)
        self.slider.setRange(0, _STEPS)
        self.slider.setMinimumWidth(70)
        self.box = QDoubleSpinBox()
        self.box.setRange(-1e6, 1e6)
        self.box.setDecimals(3)
        self.box.setSingleStep(0.01)
        self.box.setButtonSymbols(QDoubleSpinBox.NoButtons)
        self.box.setKeyboardTracking(False)
        self.box.setFixedWidth(66)
        self.plot = QToolButton()
        self.plot.setIcon(icon("plot"))
        self.plot.setCheckable(True)
        self.plot.setAutoRaise(True)
        self.plot.setToolTip(f"Plot {dof.name}")
        for column, widget in enumerate((self.label, self.slider, self.box, self.plot)):
            grid.addWidget(widget, row, column)
        self.slider.valueChanged.connect(lambda value: self._pose(self.low + value / _STEPS * (self.high - self.low)))
        self.box.valueChanged.connect(self._pose)
        self.plot.toggled.connect(lambda on: owner.plotted.emit(dof, on))

    def _pose(self, position: float) -> None:
        self.owner.posed.emit(self.dof, position)
        self.refresh()

    def refresh(self) -> None:
        """Show the dof's position."""
        position = self.dof.position()
        if not isfinite(position):
            return
        if not self.slider.isSliderDown():
            part = (position - self.low) / (self.high - self.low) if self.high > self.low else 0.0
            self.slider.blockSignals(True)
            self.slider.setValue(round(min(max(part, 0.0), 1.0) * _STEPS))
            self.slider.blockSignals(False)
        if not self.box.hasFocus() or self.slider.isSliderDown():
            self.box.blockSignals(True)
            self.box.setValue(position)
            self.box.blockSignals(False)


class DofSliders(QScrollArea):
    """Rows for the dofs of the selected skeleton.

    Emits `posed(dof, position)` when the user moves one, and `plotted(dof, on)`.
    """

    posed = pyqtSignal(object, float)
    plotted = pyqtSignal(object, bool)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setWidgetResizable(True)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarAlwaysOff)
        self.skeleton: Skeleton | None = None
        self.rows: list[DofRow] = []

    def show_skeleton(self, skel: Skeleton | None, plotted: set[str] = frozenset()) -> None:  # type: ignore[assignment]
        """Show the dofs of a skeleton; `plotted` names those whose plot button is down."""
        if skel is self.skeleton and skel is not None and len(self.rows) == skel.ndofs:
            return
        self.skeleton = skel
        content = QWidget()
        content.setBackgroundRole(QPalette.Base)
        content.setAutoFillBackground(True)
        grid = QGridLayout(content)
        grid.setContentsMargins(6, 4, 4, 4)
        grid.setVerticalSpacing(1)
        grid.setColumnStretch(1, 1)
        self.rows = [DofRow(dof, grid, row, self) for row, dof in enumerate(skel.dofs)] if skel is not None else []
        for row in self.rows:
            row.plot.setChecked(row.dof.name in plotted)
        if not self.rows:
            grid.addWidget(QLabel("No degrees of freedom" if skel is not None else "Select a skeleton"), 0, 0)
        grid.setRowStretch(len(self.rows) + 1, 1)
        self.setWidget(content)
        self.refresh()

    def reveal(self, dofs: list[Dof]) -> None:
        """Scroll to the dofs of a joint and mark them."""
        ids = {dof.id for dof in dofs}
        for row in self.rows:
            chosen = row.dof.id in ids
            row.label.setStyleSheet("font-weight: 600;" if chosen else "")
            if chosen:
                self.ensureWidgetVisible(row.label)

    def refresh(self) -> None:
        """Show the present positions of the rows that can be seen."""
        for row in self.rows:
            if not row.label.visibleRegion().isEmpty():
                row.refresh()
