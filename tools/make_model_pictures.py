"""Draws every model of data/ from three sides: python tools/make_model_pictures.py [FOLDER].

Makes one PNG a model, by default in docs/images/models: from the front, from the side, and from behind.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image

import pydart2
from pydart2.gui import Camera, OffscreenRenderer, drawing
from pydart2.gui.draw_list import from_world
from pydart2.gui.placing import boxes

ROOT = Path(__file__).resolve().parent.parent
SIZE, SMOOTH = 400, 2  # pixels of a picture, and how many of a drawing make one of them


class OnFloor:
    """A world, drawn with a floor under it if it has none."""

    def __init__(self, world: pydart2.World) -> None:
        self.scene = from_world(world)
        self.low, self.high = bounds([item for item in self.scene if item.casts] or self.scene.items)
        if all(item.casts for item in self.scene):
            self.scene.add_ground(float(self.low @ np.abs(self.scene.up)), 30.0)

    def render(self) -> None:
        drawing.draw(self.scene)


def bounds(items: list) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Lowest and highest corner of the box around them all."""
    found = boxes(items)
    return (found[:, 0].min(axis=0), found[:, 1].max(axis=0)) if len(found) else (np.full(3, -1.0), np.full(3, 1.0))


def worlds() -> dict[str, pydart2.World]:
    """All models by name, in the pose of their files; what hangs or falls, a while later."""
    made = {path.stem: pydart2.World(0.001, path) for path in sorted((ROOT / "data" / "skel").glob("*.skel"))}
    for name, path in (("atlas", "sdf/atlas/atlas_v3_no_head.sdf"), ("pr2", "urdf/PR2/pr2.urdf")):
        made[name] = pydart2.World(0.001)
        made[name].set_gravity([0.0, 0.0, -9.81])
        made[name].add_skeleton(ROOT / "data" / path)
    chain = made["chain"].skeletons[-1]
    chain.q = np.linspace(0.5, -0.1, chain.ndofs) * 0.6
    return made


def three_sides(renderer: OffscreenRenderer, world: pydart2.World) -> Image.Image:
    """The pictures side by side."""
    model = OnFloor(world)
    up = model.scene.up
    front = np.array([1.0, 0.0, 0.0])
    side = np.cross(up, front)
    directions = (front + 0.25 * up + 0.25 * side, side + 0.2 * up, 0.55 * up - front - 0.6 * side)
    sheet = Image.new("RGB", (3 * SIZE, SIZE))
    for i, direction in enumerate(directions):
        camera = Camera.around(model.low, model.high, direction, up)
        sheet.paste(Image.fromarray(renderer.render(model, camera=camera)).reduce(SMOOTH), (i * SIZE, 0))
    return sheet


def main() -> None:
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "docs" / "images" / "models"
    folder.mkdir(parents=True, exist_ok=True)
    renderer = OffscreenRenderer(SMOOTH * SIZE, SMOOTH * SIZE)
    renderer.scene.style.shadow_size = 2048
    for name, world in worlds().items():
        three_sides(renderer, world).save(folder / f"{name}.png", optimize=True)


if __name__ == "__main__":
    main()
