"""The camera that finds the world by itself, and the floor under it."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from PIL import Image, ImageSequence

import pydart2
from pydart2.gui import OffscreenRenderer
from pydart2.gui.draw_list import from_world
from pydart2.gui.first_look import VIEWS, floor_of, look

BOX = """<robot name="box"><link name="box">
  <inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
  <visual><geometry><box size="0.2 0.2 0.2"/></geometry></visual></link></robot>"""
ATLAS = "sdf/atlas/atlas_v3_no_head.sdf"


@pytest.fixture
def atlas() -> pydart2.World:
    world = pydart2.World(0.001)
    world.set_gravity([0.0, 0.0, -9.81])
    world.add_skeleton(pydart2.data_path(ATLAS))
    return world


def on_screen(world: pydart2.World, view: str, aspect: float) -> np.ndarray:
    """Where the bodies' origins are in the picture, -1 to 1, shape (n, 2)."""
    camera = look(world, aspect, view)
    points = np.array([body.T[:, 3] for skel in world.skeletons for body in skel.bodynodes])
    clip = points @ (camera.projection(aspect) @ camera.view).T
    return clip[:, :2] / clip[:, 3:]


@pytest.mark.parametrize("aspect", [0.5, 4 / 3, 2.0])
@pytest.mark.parametrize("view", VIEWS)
def test_all_is_in_the_picture(atlas: pydart2.World, view: str, aspect: float) -> None:
    places = on_screen(atlas, view, aspect)
    assert np.abs(places).max() < 1.0
    assert np.abs(places).max() > 0.25  # and not far away


@pytest.mark.parametrize("name", ["skel/chain.skel", "urdf/PR2/pr2.urdf", "skel/shapes.skel"])
@pytest.mark.parametrize("view", VIEWS)
def test_a_picture_is_filled_but_for_a_margin(name: str, view: str) -> None:
    """On two sides by what is there, unless that would be so near that what is in front looks large."""
    world = pydart2.World(0.001, pydart2.data_path(name))
    camera = look(world, 4 / 3, view, still=True)
    points = corners(world)
    clip = np.column_stack([points, np.ones(len(points))]) @ (camera.projection(4 / 3) @ camera.view).T
    left, below = (clip[:, :2] / clip[:, 3:]).min(axis=0)
    right, above = (clip[:, :2] / clip[:, 3:]).max(axis=0)
    seen = points @ camera.view[:3, :3].T + camera.view[:3, 3]
    middle = (seen.min(axis=0) + seen.max(axis=0)) / 2.0
    radii = -middle[2] / np.linalg.norm(seen - middle, axis=1).max()
    filled = max(min(right, -left), min(above, -below))
    assert filled == pytest.approx(1.0 / 1.1, abs=1e-9) or (
        filled < 1.0 / 1.1 and radii == pytest.approx(2.2, abs=1e-9)
    )


def corners(world: pydart2.World) -> np.ndarray:
    """Of the boxes around the meshes that are no floors, shape (n, 3), m."""
    boxes = []
    for item in from_world(world):
        if item.casts:
            low, high = item.mesh.bounds
            ends = np.array(
                [[x, y, z, 1.0] for x in (low[0], high[0]) for y in (low[1], high[1]) for z in (low[2], high[2])]
            )
            boxes.append(ends @ item.transform[:3].T)
    return np.concatenate(boxes)


def test_up_is_up(atlas: pydart2.World) -> None:
    robot = atlas.skeletons[0]
    places = on_screen(atlas, "auto", 1.0)
    assert places[robot.body("utorso").id, 1] > places[robot.body("l_foot").id, 1] + 0.3
    atlas.set_gravity([0.0, 9.81, 0.0])
    assert look(atlas).view[:3, :3] @ [0.0, -1.0, 0.0] @ [0.0, 1.0, 0.0] > 0.8


def test_front_sees_the_left_hand_on_the_right(atlas: pydart2.World) -> None:
    robot = atlas.skeletons[0]
    hand, other = robot.body("l_hand").id, robot.body("r_hand").id
    front, back = on_screen(atlas, "front", 1.0), on_screen(atlas, "back", 1.0)
    assert front[hand, 0] > 0.3 > -0.3 > front[other, 0]
    np.testing.assert_allclose(front[hand, 0], -back[hand, 0], atol=0.1)


def test_the_floor_is_under_the_lowest_point_and_only_drawn(atlas: pydart2.World) -> None:
    world = pydart2.World(0.001)
    world.set_gravity([0.0, 0.0, -9.81])
    world.add_skeleton(BOX)
    world.skeletons[0].q = [0.0, 0.0, 0.0, 3.0, 0.0, 0.5]
    floor = floor_of(world)
    assert floor is not None and world.num_skeletons() == 1
    np.testing.assert_allclose(floor.transform[:3, 3], [3.0, 0.0, 0.4], atol=1e-12)
    assert floor_of(pydart2.World(0.001, pydart2.data_path("skel/cubes.skel"))) is None
    assert floor_of(pydart2.World(0.001)) is None


def test_the_floor_of_a_movie_stays(tmp_path: Path) -> None:
    """It is under the first picture: what falls without anything to stand on falls past it."""
    world = pydart2.World(0.001)
    world.set_gravity([0.0, 0.0, -9.81])
    world.add_skeleton(BOX)
    pydart2.gui.record(world, tmp_path / "fall.gif", seconds=0.4, fps=10, size=(64, 48))
    with Image.open(tmp_path / "fall.gif") as movie:
        pictures = [np.asarray(frame.convert("RGB"), float) for frame in ImageSequence.Iterator(movie)]
    assert np.abs(pictures[-1] - pictures[0]).max() > 50.0


def test_a_picture_by_name_has_a_floor_and_one_by_number_has_none(atlas: pydart2.World) -> None:
    renderer = OffscreenRenderer(160, 120)
    plain = renderer.render(atlas, camera=look(atlas, 160 / 120))
    assert (renderer.render(atlas) != plain).any(axis=2).mean() > 0.3
    assert (renderer.render(atlas, camera=look(atlas, 160 / 120)) == plain).all()


def test_an_unknown_name_is_answered(atlas: pydart2.World) -> None:
    with pytest.raises(pydart2.NameNotFound, match=r"no camera 'frnt' in pydart2\.gui; did you mean 'front'"):
        pydart2.gui.render(atlas, camera="frnt")
