"""Pictures against stored ones, by what an eye would see: not single pixels, but small areas."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image

from pydart2.gui import OffscreenRenderer

from .pictures import FOLDER, PICTURES, primitives

Picture = NDArray[np.uint8]


def difference(a: Picture, b: Picture) -> float:
    """The greatest difference of colour between the same areas of 6 by 6 pixels, 0 to 255."""
    height, width = a.shape[0] // 6 * 6, a.shape[1] // 6 * 6
    change = (a[:height, :width].astype(float) - b[:height, :width]).reshape(height // 6, 6, width // 6, 6, 3)
    return float(np.abs(change.mean(axis=(1, 3))).max())


LIMIT = 6.0


def stored(name: str) -> Picture:
    with Image.open(FOLDER / f"{name}.png") as picture:
        return np.asarray(picture.convert("RGB"))


@pytest.mark.parametrize("name", PICTURES)
def test_pictures_look_as_they_did(renderer: OffscreenRenderer, tmp_path: Path, name: str) -> None:
    drawn = PICTURES[name](renderer, tmp_path)
    assert drawn.shape == stored(name).shape
    assert difference(drawn, stored(name)) < LIMIT


def test_the_measure_sees_what_an_eye_sees(renderer: OffscreenRenderer) -> None:
    world = primitives()
    picture = renderer.render(world)
    for style, value in (("shadows", False), ("light", (-0.45, 1.0, 0.6)), ("background_top", (0.7, 0.86, 0.93))):
        before = getattr(renderer.scene.style, style)
        setattr(renderer.scene.style, style, value)
        assert difference(renderer.render(world), picture) > LIMIT, style
        setattr(renderer.scene.style, style, before)
    world.skeletons[3].q = world.skeletons[3].q + np.array([0.0, 0.0, 0.0, 0.02, 0.0, 0.0])  # about two pixels
    assert difference(renderer.render(world), picture) > LIMIT
    smooth_edges = OffscreenRenderer(240, 180, samples=0).render(primitives())
    assert 0.0 < difference(smooth_edges, picture) < 6 * LIMIT


def test_stored_pictures_are_small() -> None:
    assert sum(path.stat().st_size for path in FOLDER.glob("*.png")) < 500_000
    assert {path.stem for path in FOLDER.glob("*.png")} == set(PICTURES)
