"""Movies of one's own loop, and cameras that move."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import pydart2
from pydart2.gui import Camera, Movie, between, follow, orbit
from pydart2.gui.first_look import look, middle_of
from pydart2.gui.moving_cameras import MovingCamera


@pytest.fixture
def world() -> pydart2.World:
    world = pydart2.World(0.01, up="z")
    world.add_ground()
    world.add_box((0.4, 0.4, 0.4), position=(0.0, 0.0, 2.0), color=(1.0, 0.0, 0.0))
    return world


def frames(path: Path) -> list[np.ndarray]:
    with Image.open(path) as movie:
        pictures = []
        for i in range(movie.n_frames):  # type: ignore[attr-defined]
            movie.seek(i)
            pictures.append(np.asarray(movie.convert("RGB")).astype(int))
    return pictures


def red(picture: np.ndarray) -> np.ndarray:
    """Middle of what is red, [row, column], from 0 to 1."""
    mask = picture[..., 0] > picture[..., 1] + picture[..., 2]
    assert mask.any()
    return np.argwhere(mask).mean(axis=0) / mask.shape


def test_a_movie_of_ones_own_loop(world: pydart2.World, tmp_path: Path) -> None:
    eye = Camera.look_at([6.0, 0.0, 1.2], [0.0, 0.0, 1.2], [0.0, 0.0, 1.0])
    with Movie(world, tmp_path / "fall.webp", fps=10, camera=eye, size=(96, 64)) as movie:
        movie.look()
        for _ in range(50):
            world.step()
            movie.look()
    pictures = frames(tmp_path / "fall.webp")
    assert len(pictures) == 6 and pictures[0].shape == (64, 96, 3)
    assert red(pictures[-1])[0] > red(pictures[0])[0] + 0.1  # it has fallen


def test_a_movie_ends_where_the_loop_does(world: pydart2.World, tmp_path: Path) -> None:
    with pytest.raises(ZeroDivisionError), Movie(world, tmp_path / "x.gif", fps=50, size=(48, 32)) as movie:
        for i in range(5):
            world.step()
            movie.look()
            1 / (2 - i)
    assert 1 <= len(frames(tmp_path / "x.gif")) <= 3
    with Movie(world, tmp_path / "none.gif"):
        pass
    assert not (tmp_path / "none.gif").exists()


def test_what_makes_no_movie(world: pydart2.World, tmp_path: Path) -> None:
    with pytest.raises(TypeError, match=r"size is a width and a height in pixels, as \(640, 480\), not 640"):
        pydart2.gui.record(world, tmp_path / "x.gif", 1.0, size=640)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="fps must be positive, got 0"):
        Movie(world, tmp_path / "x.gif", fps=0)
    with pytest.raises(pydart2.NameNotFound, match=r"no camera 'frnt' in .*; did you mean 'front'"):
        Movie(world, tmp_path / "x.gif", camera="frnt")


def test_a_camera_follows(world: pydart2.World, tmp_path: Path) -> None:
    box = world.skeletons[1].body(0)
    camera = follow(box, "front", distance=3.0)
    for height in (0.3, 7.0):
        world.skeletons[1].set_positions([0.0, 0.0, 0.0, 0.0, 0.0, height])
        eye = camera(0.5)
        assert np.linalg.norm(eye.position - box.C) == pytest.approx(3.0)
        np.testing.assert_allclose((eye.view @ [*box.C, 1.0])[:2], 0.0, atol=1e-9)  # in the middle
    world.reset()
    pydart2.gui.record(world, tmp_path / "fall.webp", 0.4, fps=10, camera=camera, size=(96, 64))
    for picture in frames(tmp_path / "fall.webp"):
        np.testing.assert_allclose(red(picture), 0.5, atol=0.05)


def test_a_camera_orbits(world: pydart2.World) -> None:
    camera, middle = orbit(world, period=8.0, distance=5.0), middle_of(world)
    eyes = [camera(t) for t in (0.0, 2.0, 4.0, 8.0)]
    away = np.array([eye.position - middle for eye in eyes])
    np.testing.assert_allclose(np.linalg.norm(away, axis=1), 5.0)
    np.testing.assert_allclose(away[:, 2], away[0, 2])
    np.testing.assert_allclose(away[1, :2], [-away[0, 1], away[0, 0]], atol=1e-9)  # a quarter, against the clock
    np.testing.assert_allclose(away[2, :2], -away[0, :2], atol=1e-9)
    np.testing.assert_allclose(eyes[3].view, eyes[0].view, atol=1e-9)


def test_a_camera_goes_from_view_to_view(world: pydart2.World) -> None:
    camera: MovingCamera = between(world, {1.0: "front", 2.0: "left", 4.0: "top"})
    for t, view in ((0.0, "front"), (1.0, "front"), (2.0, "left"), (4.0, "top"), (9.0, "top")):
        np.testing.assert_allclose(camera(t).pose, look(world, view=view).pose, atol=1e-9)
    half = camera(1.5).pose
    np.testing.assert_allclose(half[:3, :3] @ half[:3, :3].T, np.eye(3), atol=1e-12)
    np.testing.assert_allclose(half[:3, 2], np.array([1.0, 1.0, 0.0]) / np.sqrt(2.0), atol=1e-6)
    for t in np.linspace(1.0, 4.0, 13):  # the box stays in the middle
        np.testing.assert_allclose((camera(t).view @ [*middle_of(world), 1.0])[:2], 0.0, atol=1e-9)
    speed = [np.linalg.norm(camera(t + 1e-4).position - camera(t).position) for t in (1.0, 1.5)]
    assert speed[0] < 0.01 * speed[1]  # it sets out slowly
    with pytest.raises(ValueError, match="needs one or more"):
        between(world, {})
