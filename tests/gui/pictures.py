"""The pictures that are compared with stored ones.

``python tests/gui/pictures.py`` draws them anew into tests/gui/pictures/. Look at them before they are committed.
"""

from __future__ import annotations

import sys
import tempfile
from collections.abc import Callable
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image

import pydart2
from pydart2.gui import Camera, OffscreenRenderer
from pydart2.gui.opengl.renderer import Renderer

if __name__ == "__main__":
    sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from gui.worlds import primitives, textured_board

FOLDER = Path(__file__).with_name("pictures")
SIZE = 240, 180
Picture = NDArray[np.uint8]


class Drawn(pydart2.World):
    """With a bit of everything that user code draws."""

    def render_with_ri(self, ri: Renderer) -> None:
        ri.set_color(0.9, 0.6, 0.1)
        ri.render_arrow([0.0, 0.0, 0.0], [0.5, 0.5, 0.0], 0.02, 0.05, 0.1)
        ri.set_color(0.2, 0.4, 0.8, 0.5)
        ri.render_sphere([-0.4, 0.2, 0.0], 0.2)
        ri.render_axes([0.5, 0.0, 0.3], 0.4)

    def draw_with_ri(self, ri: Renderer) -> None:
        ri.set_color(0.0, 0.0, 0.0)
        ri.draw_text([10, 25], "t = 0.000 s")
        ri.draw_arrow([10, 40], [110, 40])
        ri.set_color(0.8, 0.1, 0.1, 0.5)
        ri.draw_circle(15, center=[30, 65], fill=True)


def _cubes(renderer: OffscreenRenderer, folder: Path) -> Picture:
    world = pydart2.World(0.001, pydart2.data_path("skel/cubes.skel"))
    return renderer.render(world, *SIZE, Camera.look_at([0.5, 0.3, 0.7], [0.0, -0.25, 0.0], [0, 1, 0]))


def _primitives(renderer: OffscreenRenderer, folder: Path) -> Picture:
    return renderer.render(primitives(), *SIZE, camera=0)


def _textured(renderer: OffscreenRenderer, folder: Path) -> Picture:
    return renderer.render(textured_board(folder), *SIZE, Camera.look_at([1.5, 1.0, 5.0], [1.0, 0.0, 0.0], [0, 1, 0]))


def _soft(renderer: OffscreenRenderer, folder: Path) -> Picture:
    world = pydart2.World(0.001, pydart2.data_path("skel/softBodies.skel"))
    return renderer.render(world, *SIZE, camera=0)


def _robot(renderer: OffscreenRenderer, folder: Path) -> Picture:
    world = pydart2.World(0.001)
    world.set_gravity([0.0, 0.0, -9.81])
    world.add_skeleton(pydart2.data_path("sdf/atlas/atlas_v3_no_head.sdf"))
    return renderer.render(world, *SIZE, camera=1)


def _drawn(renderer: OffscreenRenderer, folder: Path) -> Picture:
    return renderer.render(Drawn(0.001, pydart2.data_path("skel/cubes.skel")), *SIZE, camera=0)


PICTURES: dict[str, Callable[[OffscreenRenderer, Path], Picture]] = {
    "cubes": _cubes,
    "primitives": _primitives,
    "textured": _textured,
    "soft": _soft,
    "robot": _robot,
    "drawn": _drawn,
}


def main() -> None:
    FOLDER.mkdir(exist_ok=True)
    renderer = OffscreenRenderer(*SIZE)
    with tempfile.TemporaryDirectory() as folder:
        for name, draw in PICTURES.items():
            Image.fromarray(draw(renderer, Path(folder))).save(FOLDER / f"{name}.png", optimize=True)


if __name__ == "__main__":
    main()
