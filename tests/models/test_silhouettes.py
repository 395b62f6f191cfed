"""Our Atlas has the outline of the robot: pictures from far away, against the meshes of Debian's `dart-doc`."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

import pydart2
from oracle.models import dart_model
from pydart2.gui import Camera, OffscreenRenderer

ATLAS = "sdf/atlas/atlas_v3_no_head.sdf"
AWAY = 100.0  # m, so that the picture is close to a parallel projection
VIEWS = {"front": ((1, 0, 0), (0, 0, 1)), "side": ((0, -1, 0), (0, 0, 1)), "top": ((0, 0, 1), (1, 0, 0))}


@pytest.fixture(scope="module")
def renderer() -> OffscreenRenderer:
    return OffscreenRenderer(600, 600)


def silhouette(renderer: OffscreenRenderer, path: str | Path, view: str) -> NDArray[np.bool_]:
    """Where a robot is seen that stands with q = 0, 2.4 m across the picture."""
    world = pydart2.World(0.001)
    world.add_skeleton(path)
    direction, up = VIEWS[view]
    camera = Camera.look_at(AWAY * np.array(direction), (0, 0, 0), up, fov=2.0 * np.arctan(1.2 / AWAY))
    ids = renderer.render(world, camera=replace(camera, near=AWAY - 5.0, far=AWAY + 5.0), mode="segmentation")
    return ids[:, :, 0] == 0


@pytest.mark.parametrize("view", VIEWS)
def test_atlas_has_the_outline_of_the_robot(renderer: OffscreenRenderer, view: str) -> None:
    """The area that both cover, over the area that either covers."""
    ours = silhouette(renderer, pydart2.data_path(ATLAS), view)
    robot = silhouette(renderer, dart_model(ATLAS), view)
    assert robot.sum() > 20_000
    assert (ours & robot).sum() / (ours | robot).sum() >= 0.85
