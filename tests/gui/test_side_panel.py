"""The column of widgets that scripts make."""

from __future__ import annotations

from typing import Any

import pytest
from PyQt5.QtCore import Qt
from PyQt5.QtTest import QTest
from PyQt5.QtWidgets import QHBoxLayout, QWidget

import pydart2
from pydart2.gui.pyqt5.application import application
from pydart2.gui.pyqt5.side_panel import SidePanel


@pytest.fixture
def panel() -> SidePanel:
    application()
    return SidePanel()


def test_rows_become_a_layout(panel: SidePanel) -> None:
    panel.add_label("title")
    panel.add_push_button("a", next_line=False)
    panel.add_push_button("b", next_line=True)
    panel.add_checkbox("open row", next_line=False)
    layout = panel.build_layout()
    assert (panel.width, [len(row) for row in panel.layout], layout.count()) == (300, [1, 2, 1], 4)  # and a stretch
    assert isinstance(layout.itemAt(1), QHBoxLayout)
    assert layout.itemAt(3).spacerItem() is not None
    assert list(panel.widgets) == ["title", "a", "b", "open row"]
    holder = QWidget()
    holder.setLayout(layout)


def test_callbacks_and_values(panel: SidePanel) -> None:
    heard: list[Any] = []
    push = panel.add_push_button("push", lambda checked: heard.append(("push", checked)), label="Push!")
    toggle = panel.add_toggle_button("toggle", False, lambda checked: heard.append(("toggle", checked)))
    tick = panel.add_checkbox("tick", True, lambda checked: heard.append(("tick", checked)))
    assert (push.text(), panel.is_checked("toggle"), panel.value("tick")) == ("Push!", False, True)
    for widget in (push, toggle, tick):
        QTest.mouseClick(widget, Qt.LeftButton, pos=widget.rect().topLeft() + widget.rect().center() / 20)
    assert heard[:2] == [("push", False), ("toggle", True)]
    panel.add_combobox("choice", ["x", "y", "z"], 1, callback=lambda index: heard.append(("choice", index)))
    panel.add_spinbox("count", 1, 9, 4, 2, suffix=" steps", callback=lambda value: heard.append(("count", value)))
    panel.add_double_spinbox("gain", 0.0, 2.0, 0.5, 0.25, prefix="k=", callback=lambda v: heard.append(("gain", v)))
    assert [panel.value(name) for name in ("choice", "count", "gain")] == [1, 4, 0.5]
    heard.clear()
    panel.set_value("choice", 2)
    panel.set_value("count", 7)
    panel.set_value("gain", 5.0)  # more than the maximum
    assert heard == [("choice", 2), ("count", 7), ("gain", 2.0)]
    assert panel.widgets["gain"].text() == "k=2.00"  # type: ignore[attr-defined]


def test_labels_of_boxes(panel: SidePanel) -> None:
    for label, texts in ((True, ["n", ""]), ("Number", ["Number", ""]), (False, [""])):
        fresh = SidePanel()
        fresh.add_spinbox("n", 0, 1, label=label)
        assert len(fresh.layout[0]) == len(texts)
        assert [getattr(widget, "text")() for widget in fresh.layout[0][:-1]] == texts[:-1]  # noqa: B009
        assert fresh.value("n") == 0


def test_setters(panel: SidePanel) -> None:
    label = panel.add_label("time", "0 s")
    panel.set_text("time", "1 s")
    panel.set_enabled("time", False)
    panel.add_toggle_button("on", True)
    panel.set_checked("on", False)
    panel.set_value("on", True)
    assert (label.text(), label.isEnabled(), panel.value("on")) == ("1 s", False, True)
    with pytest.raises(pydart2.NameNotFound, match="no widget 'tiem' in the side panel; did you mean 'time'"):
        panel.set_text("tiem", "")
