"""The panel beside the picture: the tree, the sliders and the plots."""

from __future__ import annotations

from typing import Any

from PyQt5.QtCore import Qt, pyqtSignal
from PyQt5.QtWidgets import QDockWidget, QLabel, QSplitter, QVBoxLayout, QWidget

from pydart2.bodynode import BodyNode
from pydart2.dof import Dof
from pydart2.gui.pyqt5.plots import DofPlots
from pydart2.gui.pyqt5.sliders import DofSliders
from pydart2.gui.pyqt5.tree import Part, SkeletonTree
from pydart2.skeleton import Skeleton
from pydart2.world import World


class Inspector(QDockWidget):
    """Shows a world's skeletons.

    Emits `chosen(part)` when the user selects a body or a skeleton, and `posed(dof, position)`.

    Attributes
    ----------
    tree : SkeletonTree
    sliders : DofSliders
    plots : DofPlots
    """

    chosen = pyqtSignal(object)
    posed = pyqtSignal(object, float)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__("Inspector", parent)
        self.setObjectName("inspector")
        self.setFeatures(QDockWidget.DockWidgetClosable | QDockWidget.DockWidgetMovable)
        self.world: World | None = None
        self.tree, self.sliders, self.plots = SkeletonTree(), DofSliders(), DofPlots()
        splitter = QSplitter(Qt.Vertical)
        self.heading = QLabel("Joints")
        for title, widget in (("Bodies", self.tree), (self.heading, self.sliders), ("Plot", self.plots)):
            widget.setMinimumHeight(40)  # so that the window fits a low screen
            splitter.addWidget(_titled(title, widget))
        splitter.setSizes([200, 240, 340])
        splitter.setMinimumWidth(330)
        splitter.setChildrenCollapsible(False)
        self.setWidget(splitter)
        self.setMinimumWidth(330)
        self.tree.chosen.connect(self._on_chosen)
        self.sliders.posed.connect(self.posed)
        self.sliders.plotted.connect(self.plots.set_plotted)

    def show_world(self, world: World | None) -> None:
        """Show a world, and the sliders of the skeleton that moves with the most dofs."""
        if world is not self.world:
            self.plots.forget()
        self.world = world
        self.tree.show_world(world)
        skeletons = world.skeletons if world is not None else []
        if self.sliders.skeleton not in skeletons:
            movers = [skel for skel in skeletons if skel.ndofs and skel.is_mobile()]
            self.show_skeleton(max(movers, key=lambda skel: skel.ndofs, default=None))

    def show_skeleton(self, skel: Skeleton | None) -> None:
        """Show the sliders of a skeleton."""
        self.heading.setText(f"Joints of {skel.name}" if skel is not None else "Joints")
        self.sliders.show_skeleton(skel, {dof.name for dof in self.plots.dofs if dof.skel is skel})

    def select(self, part: Part | None) -> None:
        """Show a part as selected."""
        self.tree.select(part)
        self._reveal(part)

    def _reveal(self, part: Part | None) -> None:
        if part is None:
            return
        self.show_skeleton(part.skel if isinstance(part, BodyNode) else part)
        dofs: list[Dof] = list(part.parent_joint.dofs) if isinstance(part, BodyNode) else []
        self.sliders.reveal(dofs)

    def _on_chosen(self, part: Part | None) -> None:
        self._reveal(part)
        self.chosen.emit(part)

    def refresh(self, time: float | None) -> None:
        """Show the present state, and in the plots what is around the time that is shown, s."""
        if not self.isVisible() or self.world is None:
            return
        self.show_world(self.world)
        self.sliders.refresh()
        self.plots.refresh(time)


def _titled(title: Any, widget: QWidget) -> QWidget:
    label = title if isinstance(title, QLabel) else QLabel(title)
    label.setObjectName("heading")
    box = QWidget()
    layout = QVBoxLayout(box)
    layout.setContentsMargins(6, 2, 6, 4)
    layout.setSpacing(2)
    layout.addWidget(label)
    layout.addWidget(widget)
    return box
