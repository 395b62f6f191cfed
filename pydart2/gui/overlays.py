"""What a viewer shows of a world: the choices of `Show`, the selection, a pull."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, ClassVar

import numpy as np
from numpy.typing import NDArray

from pydart2.gui import geometry
from pydart2.gui.draw_list import Item, Scene, Show, size_of_signs
from pydart2.skeleton import Skeleton

if TYPE_CHECKING:
    from pydart2.bodynode import BodyNode
    from pydart2.gui.pull import Pull
    from pydart2.world import World

Array = NDArray[np.float64]

SELECTED = np.array([1.0, 0.55, 0.1])
FORCE_SCALE = -0.005  # m/N, World.render's
_PULL = (0.15, 0.45, 0.95)
_SEE_THROUGH = 0.35  # alpha of bodies when something inside them is shown


@dataclass
class Overlays(Show):
    """What is shown; the toggles have the names of the actions in `user_input.KEYS`.

    Attributes
    ----------
    contact_forces : bool
        The arrows at the contacts; `contacts` alone shows dots.
    wireframe, shadows : bool
    selected : BodyNode or Skeleton or None
        Drawn in another colour.
    pull : Pull or None
        Drawn as an arrow.
    """

    contact_forces: bool = True
    wireframe: bool = False
    shadows: bool = True
    selected: BodyNode | Skeleton | None = None
    pull: Pull | None = None

    TOGGLES: ClassVar = (
        *("contacts", "contact_forces", "centers_of_mass", "frames"),
        *("joint_axes", "collision_shapes", "sleepers", "wireframe", "shadows"),
    )

    def scene(self, world: World) -> Scene:
        """The bodies of a world with what is shown besides."""
        scene = Scene()
        show = Show(**{f.name: getattr(self, f.name) for f in fields(Show)})
        show.contacts = False
        scene.add_world(world, show)
        scene.items = [self._tinted(item) for item in scene.items]
        self._add_contacts(scene, world)
        if self.pull is not None:
            radius = 0.12 * size_of_signs(self.pull.body.skel)
            scene.add(geometry.sphere(2), _at(self.pull.point), 2.0 * radius, _PULL)
            scene.add_arrow(self.pull.point, self.pull.target, radius, _PULL)
        return scene

    def _tinted(self, item: Item) -> Item:
        if item.ids[0] < 0:
            return item
        rgba = item.rgba
        if self._is_selected(item.ids):
            rgba = np.append(0.35 * rgba[:3] + 0.65 * SELECTED, rgba[3])
        if (self.centers_of_mass or self.frames or self.joint_axes) and item.casts:
            rgba = np.append(rgba[:3], _SEE_THROUGH * rgba[3])
        return item if rgba is item.rgba else item._replace(rgba=rgba)

    def _is_selected(self, ids: tuple[int, int]) -> bool:
        if self.selected is None:
            return False
        if isinstance(self.selected, Skeleton):
            return ids[0] == self.selected.id
        return ids == (self.selected.skel.id, self.selected.id)

    def _add_contacts(self, scene: Scene, world: World) -> None:
        if not (self.contacts or self.contact_forces):
            return
        rows = world.collision_result.rows
        if self.contacts:
            scene.add_contacts(rows, force_scale=FORCE_SCALE if self.contact_forces else 0.0)
        else:
            for row in rows:
                scene.add_arrow(row[:3], row[:3] + FORCE_SCALE * row[3:6], 0.003)


def _at(position: Array) -> Array:
    pose = np.eye(4)
    pose[:3, 3] = position
    return pose
