"""A column of labels, buttons and boxes beside the picture, made by the user's script."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from PyQt5.QtWidgets import (
    QAbstractButton,
    QCheckBox,
    QComboBox,
    QDoubleSpinBox,
    QHBoxLayout,
    QLabel,
    QPushButton,
    QSpinBox,
    QVBoxLayout,
    QWidget,
)

from pydart2.errors import NameNotFound

Callback = Callable[..., Any] | None


class SidePanel:
    """Widgets by name, in rows.

    >>> panel = SidePanel()
    >>> panel.add_label("gain", next_line=False)
    >>> panel.add_double_spinbox("kp", 0.0, 100.0, default=40.0, label=False)
    >>> panel.add_push_button("push", callback=push)
    >>> window.add_right_panel(panel)

    Each builder returns the Qt widget; with `next_line=False` the next one comes beside it.

    Attributes
    ----------
    width : int
        Pixels.
    widgets : dict of name to QWidget
    layout : list of rows, each a list of QWidget
    line : list of QWidget
        The row that is not finished yet.
    vbox : QVBoxLayout
        Made by build_layout().
    """

    vbox: QVBoxLayout

    def __init__(self, width: int = 300) -> None:
        self.width = width
        self.widgets: dict[str, QWidget] = {}
        self.layout: list[list[QWidget]] = []
        self.line: list[QWidget] = []

    # Rows

    def register_widget(self, widget: QWidget, name: str, next_line: bool) -> None:
        """Add any widget to the present row, and end the row if `next_line`."""
        self.widgets[name] = widget
        self.line.append(widget)
        if next_line:
            self.push_line()

    def process_line(self) -> None:
        """End the present row if there is something in it."""
        if self.line:
            self.push_line()

    def push_line(self) -> None:
        """End the present row."""
        self.layout.append(self.line)
        self.line = []

    def build_layout(self) -> QVBoxLayout:
        """The rows from top to bottom as a Qt layout."""
        self.process_line()
        self.vbox = QVBoxLayout()
        for row in self.layout:
            if len(row) == 1:
                self.vbox.addWidget(row[0])
                continue
            box = QHBoxLayout()
            for widget in row:
                box.addWidget(widget)
            self.vbox.addLayout(box)
        self.vbox.addStretch(1)
        return self.vbox

    # Builders

    def add_label(self, name: str, label: str | None = None, next_line: bool = True) -> QLabel:
        """A text, `name` unless `label` is given."""
        widget = QLabel(name if label is None else label)
        self.register_widget(widget, name, next_line)
        return widget

    def add_push_button(
        self, name: str, callback: Callback = None, label: str | None = None, next_line: bool = True
    ) -> QPushButton:
        """A button; a click calls `callback(checked)`."""
        widget = QPushButton(name if label is None else label)
        if callback is not None:
            widget.clicked.connect(lambda checked=False: callback(checked))
        self.register_widget(widget, name, next_line)
        return widget

    def add_toggle_button(
        self,
        name: str,
        default: bool = True,
        callback: Callback = None,
        label: str | None = None,
        next_line: bool = True,
    ) -> QPushButton:
        """A button that stays down; a click calls `callback(checked)`."""
        widget = self.add_push_button(name, callback, label, next_line)
        widget.setCheckable(True)
        widget.setChecked(default)
        return widget

    def add_checkbox(
        self,
        name: str,
        default: bool = True,
        callback: Callback = None,
        label: str | None = None,
        next_line: bool = True,
    ) -> QCheckBox:
        """A box to tick; a click calls `callback(checked)`."""
        widget = QCheckBox(name if label is None else label)
        widget.setChecked(default)
        if callback is not None:
            widget.clicked.connect(lambda checked=False: callback(checked))
        self.register_widget(widget, name, next_line)
        return widget

    def add_combobox(
        self,
        name: str,
        items: Sequence[str],
        default: int = 0,
        label: bool | str = True,
        callback: Callback = None,
        next_line: bool = True,
    ) -> QComboBox:
        """A choice; a change calls `callback(index)`. `label`: True shows `name`, a text shows itself."""
        self._add_label_of(name, label)
        widget = QComboBox()
        widget.addItems(list(items))
        widget.setCurrentIndex(default)
        if callback is not None:
            widget.currentIndexChanged[int].connect(lambda index: callback(index))
        self.register_widget(widget, name, next_line)
        return widget

    def add_spinbox(
        self,
        name: str,
        min: int,
        max: int,
        default: int | None = None,
        step: int | None = None,
        label: bool | str = True,
        prefix: str | None = None,
        suffix: str | None = None,
        callback: Callback = None,
        next_line: bool = True,
    ) -> QSpinBox:
        """A whole number from `min` to `max`; a change calls `callback(value)`."""
        widget = QSpinBox()
        self._add_spinbox(widget, name, min, max, default, step, label, prefix, suffix, callback, next_line)
        return widget

    def add_double_spinbox(
        self,
        name: str,
        min: float,
        max: float,
        default: float | None = None,
        step: float | None = None,
        label: bool | str = True,
        prefix: str | None = None,
        suffix: str | None = None,
        callback: Callback = None,
        next_line: bool = True,
    ) -> QDoubleSpinBox:
        """A number from `min` to `max`; a change calls `callback(value)`."""
        widget = QDoubleSpinBox()
        self._add_spinbox(widget, name, min, max, default, step, label, prefix, suffix, callback, next_line)
        return widget

    def _add_spinbox(
        self,
        widget: Any,
        name: str,
        low: float,
        high: float,
        default: float | None,
        step: float | None,
        label: bool | str,
        prefix: str | None,
        suffix: str | None,
        callback: Callback,
        next_line: bool,
    ) -> None:
        self._add_label_of(name, label)
        widget.setRange(low, high)
        if step is not None:
            widget.setSingleStep(step)
        if default is not None:
            widget.setValue(default)
        widget.setPrefix(prefix or "")
        widget.setSuffix(suffix or "")
        if callback is not None:
            widget.valueChanged.connect(lambda value: callback(value))
        self.register_widget(widget, name, next_line)

    def _add_label_of(self, name: str, label: bool | str) -> None:
        if label is not False:
            self.add_label(name, name if label is True else label, next_line=False)

    # What is in them

    def _widget(self, name: str) -> Any:
        if name not in self.widgets:
            raise NameNotFound("widget", name, "the side panel", self.widgets)
        return self.widgets[name]

    def set_text(self, name: str, label: str) -> None:
        """Set the text of a label, button or check box."""
        self._widget(name).setText(label)

    def value(self, name: str) -> Any:
        """The number of a spin box, the index of a combo box, whether a button is down."""
        widget = self._widget(name)
        if isinstance(widget, QComboBox):
            return widget.currentIndex()
        return widget.isChecked() if isinstance(widget, QAbstractButton) else widget.value()

    def set_value(self, name: str, value: Any) -> None:
        """Set what value() returns."""
        widget = self._widget(name)
        if isinstance(widget, QComboBox):
            widget.setCurrentIndex(value)
        elif isinstance(widget, QAbstractButton):
            widget.setChecked(value)
        else:
            widget.setValue(value)

    def is_checked(self, name: str) -> bool:
        """Whether a button is down or a box ticked."""
        return bool(self._widget(name).isChecked())

    def set_checked(self, name: str, value: bool) -> None:
        """Put a button down or tick a box."""
        self._widget(name).setChecked(value)

    def set_enabled(self, name: str, enabled: bool = True) -> None:
        """Let a widget take input or not."""
        self._widget(name).setEnabled(enabled)
