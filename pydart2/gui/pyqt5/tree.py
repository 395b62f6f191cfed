"""The tree of skeletons and bodies."""

from __future__ import annotations

from PyQt5.QtCore import Qt, pyqtSignal
from PyQt5.QtWidgets import QHeaderView, QTreeWidget, QTreeWidgetItem, QWidget

from pydart2.bodynode import BodyNode
from pydart2.skeleton import Skeleton
from pydart2.world import World

Part = BodyNode | Skeleton


class SkeletonTree(QTreeWidget):
    """Skeletons, and their bodies as they hang on one another.

    Emits `chosen(part)` when the user selects a BodyNode or a Skeleton; None for nothing.
    """

    chosen = pyqtSignal(object)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setHeaderLabels(["Body", "Joint", "kg"])
        self.setAlternatingRowColors(True)
        self.setUniformRowHeights(True)
        self.setIndentation(11)
        self.header().setStretchLastSection(False)
        self.header().setMinimumSectionSize(30)
        self.header().setSectionResizeMode(0, QHeaderView.Stretch)
        for column in (1, 2):
            self.header().setSectionResizeMode(column, QHeaderView.ResizeToContents)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarAlwaysOff)
        self._parts: list[Part] = []
        self._items: dict[Part, QTreeWidgetItem] = {}
        self.itemSelectionChanged.connect(self._on_selection)

    def show_world(self, world: World | None) -> None:
        """Show the skeletons of a world; nothing happens if they are shown already."""
        parts: list[Part] = []
        for skel in world.skeletons if world is not None else ():
            parts += [skel, *skel.bodynodes]
        if parts == self._parts:
            return
        self.blockSignals(True)
        self.clear()
        self._items.clear()
        self._parts = parts
        for skel in world.skeletons if world is not None else ():
            self._add_skeleton(skel)
        self.blockSignals(False)

    def _add_skeleton(self, skel: Skeleton) -> None:
        item = QTreeWidgetItem(self, [skel.name, f"{skel.ndofs} dofs", f"{skel.m:.4g}"])
        font = item.font(0)
        font.setBold(True)
        item.setFont(0, font)
        self._items[skel] = item
        for body in skel.bodynodes:  # parents come before children
            above = item if body.parent_bodynode is None else self._items[body.parent_bodynode]
            kind = type(body.parent_joint).__name__.removesuffix("Joint")
            row = QTreeWidgetItem(above, [body.name, kind, f"{body.m:.4g}"])
            row.setToolTip(0, f"{body.name}, by {body.parent_joint.name}")
            self._items[body] = row
        if skel.ndofs and skel.num_bodynodes() <= 60:
            self.expandItem(item)
            for body in skel.bodynodes:
                self.expandItem(self._items[body])

    def select(self, part: Part | None) -> None:
        """Show a part as selected, without a signal."""
        item = self._items.get(part) if part is not None else None
        self.blockSignals(True)
        if item is None:
            self.setCurrentItem(None)
            self.clearSelection()
        else:
            self.setCurrentItem(item)
            self.scrollToItem(item)
        self.blockSignals(False)

    def _on_selection(self) -> None:
        chosen = self.selectedItems()
        self.chosen.emit(next((part for part, item in self._items.items() if item in chosen), None))
