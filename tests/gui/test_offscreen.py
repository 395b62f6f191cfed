"""Pictures as arrays: depth and ids against closed forms, colours where they must be, sizes, threads, mistakes."""

from __future__ import annotations

import gc
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import pydart2
from pydart2.gui import Camera, OffscreenRenderer, Trackball, render
from pydart2.gui.background import Background
from pydart2.gui.context import ContextError
from pydart2.gui.overlays import Overlays
from pydart2.gui.pyqt5.stage import Stage
from pydart2.gui.runtime import Runtime
from pydart2.gui.shadow import Shadow

from .worlds import body, box, primitives, sphere, textured_board, world_of

Array = NDArray[np.float64]
FRONT = Camera(np.array([[1.0, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, -4], [0, 0, 0, 1]]))  # 4 m in front of the origin


def rays(camera: Camera, width: int, height: int) -> Array:
    """Direction of the ray through each pixel's middle, eye's axes, with 1 m along the optical axis."""
    top = np.tan(camera.fov / 2.0)
    x = (2.0 * (np.arange(width) + 0.5) / width - 1.0) * top * width / height
    y = (1.0 - 2.0 * (np.arange(height) + 0.5) / height) * top
    return np.stack([*np.meshgrid(x, y), np.full((height, width), -1.0)], axis=2)


def depth_of_sphere(directions: Array, centre: Array, radius: float) -> Array:
    a, b = np.sum(directions**2, axis=2), directions @ centre
    under_root = b**2 - a * (centre @ centre - radius**2)
    with np.errstate(invalid="ignore"):
        return np.where(under_root < 0.0, np.inf, (b - np.sqrt(under_root)) / a)


def depth_of_box(directions: Array, pose: Array, size: Array) -> Array:
    """By slabs; the pose is in the eye's axes."""
    turn, origin = pose[:3, :3].T, -pose[:3, :3].T @ pose[:3, 3]
    slopes = directions @ turn.T
    with np.errstate(divide="ignore"):
        near, far = np.sort(np.stack([(s * size / 2.0 - origin) / slopes for s in (-1.0, 1.0)]), axis=0)
    first, last = near.max(axis=2), far.min(axis=2)
    return np.where(first < last, first, np.inf)


def near_an_edge(mask: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Pixels with a pixel of the other kind beside them."""
    padded = np.pad(mask, 1, mode="edge")
    shifted = [padded[1 + i : padded.shape[0] - 1 + i, 1 + j : padded.shape[1] - 1 + j] for i, j in np.ndindex(2, 2)]
    shifted += [padded[i : padded.shape[0] - 2 + i, j : padded.shape[1] - 2 + j] for i, j in np.ndindex(2, 2)]
    return np.any([s != mask for s in shifted], axis=0)


@pytest.mark.parametrize("centre", [(0.0, 0.0, 0.0), (0.8, -0.5, 1.0), (-1.0, 0.6, -2.0)])
def test_a_sphere_has_its_silhouette_and_distance(renderer: OffscreenRenderer, centre: tuple[float, ...]) -> None:
    radius = 0.7
    world = world_of(body(sphere(radius), " ".join(map(str, centre)) + " 0 0 0"))
    exact = depth_of_sphere(rays(FRONT, 240, 180), FRONT.view[:3, :3] @ centre + FRONT.view[:3, 3], radius)
    depth = renderer.render(world, camera=FRONT, mode="depth")
    ids = renderer.render(world, camera=FRONT, mode="segmentation")
    hit = np.isfinite(depth)
    assert (hit == (ids[:, :, 0] == 0)).all() and (hit == (ids[:, :, 1] == 0)).all()
    wrong = hit != np.isfinite(exact)
    assert not wrong[~near_an_edge(np.isfinite(exact))].any()
    inner = hit & ~near_an_edge(hit)
    error = np.abs(depth[inner] - exact[inner])
    assert error.max() < 0.04 * radius  # at grazing rays, where facets tell most
    assert error.mean() < 0.003 * radius
    assert abs(hit.sum() / np.isfinite(exact).sum() - 1.0) < 0.01


@pytest.mark.parametrize("pose", ["0 0 0 0 0 0", "0.3 -0.2 0.5 0.4 0.7 0.2", "-0.5 0.4 1 1 2 3"])
def test_a_box_is_exact(renderer: OffscreenRenderer, pose: str) -> None:
    world = world_of(body(box(1.0, 0.6, 0.8), pose))
    transform = FRONT.view @ world.skeletons[0].bodynodes[0].T
    exact = depth_of_box(rays(FRONT, 240, 180), transform, np.array([1.0, 0.6, 0.8]))
    depth = renderer.render(world, camera=FRONT, mode="depth")
    agree = np.isfinite(depth) == np.isfinite(exact)
    assert (~agree).sum() <= 2  # pixels that an edge goes through the middle of
    both = np.isfinite(depth) & np.isfinite(exact)
    assert both.sum() > 1000
    assert np.abs(depth[both] - exact[both]).max() < 2e-5


def test_ids_of_several_bodies(renderer: OffscreenRenderer) -> None:
    places = ("-1 0 0 0 0 0", "0 0 0 0 0 0", "1 0 0 0 0 0", "1 0 -1 0 0 0")
    ids = renderer.render(world_of(*(body(box(0.5, 0.5, 0.5), p) for p in places)), camera=FRONT, mode="segmentation")
    assert ids.dtype == np.int32 and ids.shape == (180, 240, 2)
    assert [tuple(ids[90, x]) for x in (66, 120, 174, 2)] == [(0, 0), (1, 0), (2, 0), (-1, -1)]
    assert 3 not in ids[90, 160:185, 0]  # behind the third


def test_robot_ids_are_those_of_its_bodies(renderer: OffscreenRenderer, atlas: pydart2.Skeleton) -> None:
    ids = renderer.render(atlas.world, 480, 360, camera=1, mode="segmentation")
    assert set(np.unique(ids[:, :, 1])) - {-1} <= set(range(len(atlas.bodynodes)))
    pelvis = renderer_pixel(atlas.bodynodes[0].C)
    assert ids[pelvis][0] == 0
    depth = renderer.render(atlas.world, 480, 360, camera=1, mode="depth")
    assert (np.isfinite(depth) == (ids[:, :, 0] == 0)).all()


def renderer_pixel(point: Array) -> tuple[int, int]:
    """Row and column of a point of the world in a picture of 480 by 360 with camera 1."""
    from pydart2.gui.camera import as_camera

    camera = as_camera(1)
    clip = camera.projection(480 / 360) @ camera.view @ np.append(point, 1.0)
    x, y = clip[:2] / clip[3]
    return int((1.0 - y) / 2.0 * 360), int((1.0 + x) / 2.0 * 480)


def test_shape_type_and_orientation_of_colours(renderer: OffscreenRenderer, tmp_path: Path) -> None:
    world = textured_board(tmp_path)
    picture = renderer.render(world, camera=FRONT)
    assert picture.dtype == np.uint8 and picture.shape == (180, 240, 3) and picture.flags.c_contiguous
    for (row, column), color in (
        ((60, 90), (1, 0, 0)),
        ((60, 150), (0, 1, 0)),
        ((120, 90), (0, 0, 1)),
        ((120, 150), (1, 1, 1)),
        ((90, 235), (1, 1, 0)),
    ):
        pixel = picture[row, column].astype(int)
        assert all((pixel > 110) == np.array(color, bool)), (row, column, pixel)


def test_camera_forms_agree(renderer: OffscreenRenderer) -> None:
    world = primitives()
    trackball = Trackball(rot=[-0.152, 0.045, -0.002, 0.987], trans=[0.05, 0.21, -2.5])
    pictures = [
        renderer.render(world, camera=camera)
        for camera in (0, trackball, (np.linalg.inv(trackball.view), np.pi / 4.0), Camera(trackball.view))
    ]
    assert all(np.abs(p.astype(int) - pictures[0]).max() <= 1 for p in pictures[1:])
    assert (renderer.render(world, camera=1) != pictures[0]).any()


def test_many_sizes_and_worlds_from_one_renderer(renderer: OffscreenRenderer, cubes: pydart2.World) -> None:
    first = renderer.render(cubes)
    for width, height in ((1, 1), (33, 17), (17, 33), (640, 480)):
        assert renderer.render(primitives(), width, height).shape == (height, width, 3)
        assert renderer.render(cubes, width, height, mode="depth").shape == (height, width)
    assert (renderer.render(cubes) == first).all()


def test_render_function(cubes: pydart2.World) -> None:
    assert render(cubes, 64, 48).shape == (48, 64, 3)
    assert render(cubes, 64, 48, camera=1, mode="segmentation").shape == (48, 64, 2)
    assert pydart2.gui.render is render


def test_threads_share_a_renderer(renderer: OffscreenRenderer) -> None:
    worlds = [world_of(body(sphere(0.1 * i), color=f"{0.1 * i} 0.5 0.5")) for i in range(1, 9)]
    one_by_one = [renderer.render(world, camera=FRONT) for world in worlds]
    with ThreadPoolExecutor(4) as pool:
        at_once = list(pool.map(lambda world: renderer.render(world, camera=FRONT), worlds * 3))
    assert all((a == b).all() for a, b in zip(at_once, one_by_one * 3))


def test_each_thread_with_a_renderer_of_its_own(cubes: pydart2.World) -> None:
    expected = OffscreenRenderer(120, 90).render(cubes)

    def draw(_: int) -> NDArray[np.uint8]:
        return OffscreenRenderer(120, 90).render(cubes)

    with ThreadPoolExecutor(1) as pool:  # one world belongs to one thread at a time
        assert all((picture == expected).all() for picture in pool.map(draw, range(3)))
    gc.collect()


def test_moving_changes_the_picture_and_going_back_restores_it(renderer: OffscreenRenderer) -> None:
    world = world_of(body(box(0.5, 0.5, 0.5)))
    skel = world.skeletons[0]
    before = renderer.render(world, camera=FRONT)
    skel.q = skel.q + np.array([0.3, 0.2, 0.0, 0.4, 0.0, 0.0])
    moved = renderer.render(world, camera=FRONT)
    skel.q = np.zeros(6)
    assert (moved != before).any() and (renderer.render(world, camera=FRONT) == before).all()


def test_a_shape_that_changes_its_size(renderer: OffscreenRenderer) -> None:
    world = world_of(body(sphere(0.2)))
    small = np.isfinite(renderer.render(world, camera=FRONT, mode="depth")).sum()
    world.skeletons[0].bodynodes[0].shapenodes[0].shape.set_radius(0.4)  # type: ignore[union-attr]
    large = np.isfinite(renderer.render(world, camera=FRONT, mode="depth")).sum()
    assert large / small == pytest.approx(4.0, rel=0.05)


def test_shadows_fall_away_from_the_light() -> None:
    floor = body(box(8.0, 0.1, 8.0), "0 -1 0 0 0 0", "0.9 0.9 0.9", fixed=True)
    renderer = OffscreenRenderer(240, 180)
    camera = Camera.look_at([0.0, 6.0, 0.01], [0.0, 0.0, 0.0], [0.0, 0.0, -1.0])  # from above, x to the right, -z up
    world = world_of(floor, body(sphere(0.3)))
    with_shadow = renderer.render(world, camera=camera).astype(int)
    renderer.scene.style.shadows = False
    without = renderer.render(world, camera=camera).astype(int)
    rows, columns = np.nonzero((without - with_shadow).mean(axis=2) > 20)
    assert len(rows) > 100
    # The light is to the right, above and in front, so that the shadow is to the left and behind.
    assert columns.mean() < 118 and rows.mean() < 88
    assert ((without - with_shadow)[150:, 200:] == 0).all()


def test_transparent_bodies_show_what_is_behind(renderer: OffscreenRenderer) -> None:
    world = world_of(body(box(2, 2, 0.1), "0 0 -1 0 0 0", "1 0 0"), body(box(2, 2, 0.1), "0 0 1 0 0 0", "0 0 1"))
    opaque = renderer.render(world, camera=FRONT)[90, 120].astype(int)
    world.skeletons[1].bodynodes[0].shapenodes[0].set_visual_aspect_rgba([0.0, 0.0, 1.0, 0.5])
    clear = renderer.render(world, camera=FRONT)[90, 120].astype(int)
    assert clear[0] > opaque[0] + 60 and 40 < clear[2] < opaque[2]
    assert tuple(renderer.render(world, camera=FRONT, mode="segmentation")[90, 120]) == (1, 0)


def test_transparent_bodies_are_drawn_from_far_to_near(renderer: OffscreenRenderer) -> None:
    places, colors = ("0 0 -1 0 0 0", "0 0 0 0 0 0", "0 0 1 0 0 0"), ("1 0 0", "0 1 0", "0 0 1")
    pictures = []
    for order in ((0, 1, 2), (2, 0, 1), (1, 2, 0)):
        world = world_of(*(body(box(2, 2, 0.1), places[i], colors[i]) for i in order))
        for skel in world.skeletons:
            node = skel.bodynodes[0].shapenodes[0]
            rgba = node.visual_aspect_rgba()
            assert rgba is not None
            node.set_visual_aspect_rgba([*rgba[:3], 0.5])
        pictures.append(renderer.render(world, camera=FRONT))
    assert (pictures[0] == pictures[1]).all() and (pictures[0] == pictures[2]).all()


def test_anti_aliasing_makes_edges_of_many_colours(cubes: pydart2.World) -> None:
    counts = []
    for samples in (0, 4):
        picture = OffscreenRenderer(120, 90, samples).render(world_of(body(sphere(0.8))), camera=FRONT)
        counts.append(len(np.unique(picture.reshape(-1, 3), axis=0)))
    assert counts[1] > counts[0]


def test_wireframe_shows_the_background_through(renderer: OffscreenRenderer) -> None:
    world = world_of(body(box(1, 1, 1), "0 0 0 0.3 0.4 0"))
    empty, solid = renderer.render(None, camera=FRONT), renderer.render(world, camera=FRONT)
    renderer.scene.style.wireframe = True
    try:
        wires = renderer.render(world, camera=FRONT)
    finally:
        renderer.scene.style.wireframe = False
    changed, covered = (wires != empty).any(axis=2).sum(), (solid != empty).any(axis=2).sum()
    assert 0 < changed < 0.3 * covered


def test_an_empty_world_is_background(renderer: OffscreenRenderer) -> None:
    world = pydart2.World(0.001)
    assert (renderer.render(world) == renderer.render(None)).all()
    assert np.isinf(renderer.render(world, mode="depth")).all()
    assert (renderer.render(world, mode="segmentation") == -1).all()


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"mode": "rgba"}, "no mode 'rgba'; there are rgb, depth, segmentation"),
        ({"camera": 7}, "no camera 7"),
        ({"width": 0}, "0 by 180"),
        ({"height": -3}, "240 by -3"),
        ({"camera": (np.eye(3), 0.7)}, "pose"),
    ],
)
def test_mistakes_are_told(
    renderer: OffscreenRenderer, cubes: pydart2.World, arguments: dict[str, Any], message: str
) -> None:
    with pytest.raises(ValueError, match=message):
        renderer.render(cubes, **arguments)
    assert renderer.render(cubes).any()


def test_other_mistakes(renderer: OffscreenRenderer, cubes: pydart2.World) -> None:
    with pytest.raises(TypeError, match="bodies of a World"):
        renderer.render(None, mode="depth")
    with pytest.raises(ContextError, match="samples"):
        OffscreenRenderer(64, 48, samples=999).render(cubes)
    closed = OffscreenRenderer(64, 48)
    closed.close()
    closed.close()
    with pytest.raises(ContextError, match="closed"):
        closed.render(cubes)


def test_a_texture_that_is_missing_is_drawn_white(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    world = textured_board(tmp_path)
    (tmp_path / "quarters.png").unlink()
    picture = OffscreenRenderer(240, 180).render(world, camera=FRONT)
    assert picture[60, 90].min() > 110
    assert "quarters.png" in caplog.text


@pytest.mark.parametrize("draft", [False, True])
@pytest.mark.parametrize("light", [(0.45, 1.0, 0.6), (3.0, 0.5, 1.0), (0.2, -1.0, 0.1)])
def test_floors_are_shaded_wherever_shadows_reach(
    monkeypatch: pytest.MonkeyPatch, light: tuple[float, float, float], draft: bool
) -> None:
    """They are looked up only there; the oracle looks everywhere."""
    floor = body(box(8.0, 0.1, 8.0), "0 -1 0 0 0 0", "0.9 0.9 0.9", fixed=True)
    world = world_of(floor, body(sphere(0.3)), body(box(0.2, 1.0, 0.2), "1 0 -1 0.5 0 0.3"))
    eyes = [(0.0, 6.0, 0.01), (2.0, 1.0, 3.0), (0.5, -0.5, 0.8), (-3.0, -0.8, 0.1), (1.0, -2.0, 1.0), (9.0, 9.0, 9.0)]
    cameras = [Camera.look_at(eye, [0.2, -0.2, 0.0], [0.0, 1.0, 0.0]) for eye in eyes]
    areas = []
    part_of_picture = Shadow.part_of_picture

    def noted(*args: Any) -> tuple[int, int, int, int]:
        areas.append(part_of_picture(*args))
        return areas[-1]

    def pictures() -> list[NDArray[np.uint8]]:
        renderer = OffscreenRenderer(240, 180, samples=0 if draft else 4)
        renderer.scene.style.light, renderer.scene.style.draft = light, draft
        drawn = [renderer.render(world, camera=camera) for camera in cameras for _ in range(3)]
        renderer.close()
        return drawn

    monkeypatch.setattr(Shadow, "part_of_picture", noted)
    found = pictures()
    monkeypatch.setattr(Shadow, "part_of_picture", lambda *_: (0, 0, 240, 180))
    assert all((ours == whole).all() for ours, whole in zip(found, pictures(), strict=True))
    assert (min(width * height for *_, width, height in areas) < 240 * 180 / 4) == (light[1] > 0.0)


def test_shadows_of_drafts_are_at_most_two_pictures_old(cubes: pydart2.World) -> None:
    renderer = OffscreenRenderer(160, 120, samples=0)
    renderer.scene.style.draft = True
    first, again = (renderer.render(cubes, camera="auto") for _ in range(2))
    assert (first == again).all()
    q = cubes.skeletons[-1].q
    q[3:5] += 0.3, 0.5
    cubes.skeletons[-1].q = q
    camera = pydart2.gui.Camera.look_at([1.0, 1.0, 1.5], [0.0, 0.0, 0.0], [0.0, 1.0, 0.0])
    late, _, now, same = (renderer.render(cubes, camera=camera) for _ in range(4))
    assert (now == same).all()
    assert (late != now).any()
    renderer.scene.style.draft = False
    assert (renderer.render(cubes, camera=camera) != now).any()  # edges
    renderer.scene.style.draft = True
    assert (renderer.render(cubes, camera=camera) == now).all()  # the first draft waits for its own shadows
    renderer.close()


def test_drafts_keep_what_lies_behind(monkeypatch: pytest.MonkeyPatch) -> None:
    """Sky and floors, as long as they look the same; the oracle draws them each time."""
    floor = body(box(8.0, 0.1, 8.0), "0 -1 0 0 0 0", "0.9 0.9 0.9", fixed=True)
    put_back = Background.put_back

    def pictures() -> list[NDArray[np.uint8]]:
        world = world_of(floor, body(sphere(0.3)), body(box(0.2, 1.0, 0.2), "1 0 -1 0.5 0 0.3"))
        stage, shape = Stage(Runtime(world), Overlays()), world.skeletons[0].bodynodes[0].shapenodes[0]
        renderer = OffscreenRenderer(240, 180, samples=0)
        renderer.scene.style.draft = True
        drawn = []

        def draw(eye: tuple[float, float, float], width: int = 240) -> None:
            camera = Camera.look_at(eye, [0.2, -0.2, 0.0], [0.0, 1.0, 0.0])
            drawn.extend(renderer.render(stage, width, 180, camera) for _ in range(3))

        draw((2.0, 1.0, 3.0))
        draw((3.0, 2.0, 2.0))
        draw((2.0, 1.0, 3.0))
        draw((2.0, 1.0, 3.0), width=200)
        renderer.scene.style.background_top = (0.1, 0.2, 0.3)
        draw((2.0, 1.0, 3.0))
        shape.set_visual_aspect_rgba([0.2, 0.9, 0.2, 1.0])
        draw((2.0, 1.0, 3.0))
        shape.set_offset([0.0, 0.3, 0.0])
        draw((2.0, 1.0, 3.0))
        renderer.close()
        return drawn

    found: list[bool] = []
    monkeypatch.setattr(Background, "put_back", lambda self, key: found.append(put_back(self, key)) or found[-1])
    kept = pictures()
    assert found == 7 * [False, True, True]
    monkeypatch.setattr(Background, "put_back", lambda *_: False)
    assert all((ours == oracle).all() for ours, oracle in zip(kept, pictures(), strict=True))
    assert all(a.shape != b.shape or (a != b).any() for a, b in zip(kept[2::3], kept[5::3], strict=False))
