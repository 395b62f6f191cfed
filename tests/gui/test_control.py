"""The camera's control, the spring of a pull, captures and records: without a window."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from PIL import Image

import pydart2
from pydart2.gui import user_input
from pydart2.gui.camera import as_camera
from pydart2.gui.camera_control import CameraControl
from pydart2.gui.capture import CaptureFolder, write_movie
from pydart2.gui.pull import MAX_ACCELERATION, Pull
from pydart2.gui.trackball import Trackball

numbers = st.floats(-5.0, 5.0)
SIZE = (640, 480)


def control() -> CameraControl:
    return CameraControl(Trackball(rot=[0.535, 0.284, 0.376, 0.701], trans=[0.10, 0.02, -2.770]))


@settings(max_examples=30)
@given(st.tuples(numbers, numbers, numbers), st.tuples(st.floats(1, 639), st.floats(1, 479)), st.floats(0.1, 20.0))
def test_a_point_of_a_ray_is_projected_back_to_its_pixel(
    pivot: tuple[float, ...], pixel: tuple[float, ...], depth: float
) -> None:
    mover = control()
    mover.pivot = np.array(pivot)
    mover.rotate((300, 200), (50, -20), SIZE)
    camera = as_camera(mover.trackball)
    point = mover.point_at(pixel, SIZE, depth)
    x, y, _, w = camera.projection(SIZE[0] / SIZE[1]) @ camera.view @ np.append(point, 1.0)
    assert w == pytest.approx(depth)
    assert mover.depth_of(point) == pytest.approx(depth)
    assert ((x / w + 1.0) / 2.0 * SIZE[0], (1.0 - y / w) / 2.0 * SIZE[1]) == pytest.approx(pixel, abs=1e-6)


def test_turning_leaves_the_pivot_where_it_is() -> None:
    mover = control()
    mover.pivot = np.array([1.0, 2.0, 3.0])
    before = mover.to_eye(mover.pivot)
    mover.rotate((100, 100), (80, 60), SIZE)
    assert mover.to_eye(mover.pivot) == pytest.approx(before)


def test_zoom_multiplies_the_distance_and_never_goes_through_the_pivot() -> None:
    mover = control()
    mover.zoom_by(0.5)
    assert mover.distance == pytest.approx(2.770 / 2.0)
    for _ in range(100):
        mover.zoom_by(0.1)
    assert mover.distance == pytest.approx(0.05)
    mover.zoom_by(1e9)
    assert np.isfinite(mover.trans).all()


def test_a_framed_box_touches_the_edge_of_the_picture_at_most() -> None:
    mover = control()
    low, high = np.array([3.0, -1.0, 5.0]), np.array([4.0, 2.0, 5.5])
    mover.frame(low, high, aspect=0.5)
    camera = as_camera(mover.trackball)
    for corner in np.array(np.meshgrid(*zip(low, high))).reshape(3, -1).T:
        x, y, _, w = camera.projection(0.5) @ camera.view @ np.append(corner, 1.0)
        assert abs(x / w) <= 1.0 and abs(y / w) <= 1.0
    assert mover.to_eye(mover.pivot)[:2] / mover.distance == pytest.approx([0.0, 0.0], abs=0.05)


def test_following_ignores_what_is_not_finite() -> None:
    mover = control()
    before = mover.trans
    mover.follow([np.nan, 0.0, 0.0])
    assert (mover.trans == before).all()
    mover.follow([1.0, 2.0, 3.0])
    assert mover.to_eye([1.0, 2.0, 3.0]) == pytest.approx(before)


def test_a_pull_brings_a_ball_to_the_target_at_critical_damping(cubes: pydart2.World) -> None:
    body = cubes.skeletons[1].bodynodes[0]
    cubes.g = [0.0, 0.0, 0.0]
    body.skel.q = [0.0, 0.0, 0.0, 0.0, 5.0, 0.0]
    pull = Pull(body, body.C)
    pull.target = pull.point + np.array([1.0, 0.0, 0.0])
    assert (pull.stiffness, pull.damping) == pytest.approx((40.0 * body.m, 2.0 * np.sqrt(40.0) * body.m))
    start = body.C[0]
    for i in range(1, 1001):
        pull.apply()
        cubes.step()
        if i % 250 == 0:  # x = 1 - (1 + w t) exp(-w t)
            phase = np.sqrt(40.0) * cubes.t
            assert body.C[0] - start == pytest.approx(1.0 - (1.0 + phase) * np.exp(-phase), abs=0.01)


def test_a_pull_at_any_body_of_a_robot_stays_finite(atlas: pydart2.Skeleton) -> None:
    world = atlas.world
    for body in atlas.bodynodes[::4]:
        world.reset()
        pull = Pull(body, body.C)
        pull.target = pull.point + 1.0
        for _ in range(300):
            pull.apply()
            world.step()
        assert np.abs(atlas.dq).max() < 200.0, body.name


def test_a_light_hand_is_pulled_gently() -> None:
    """Two metres of spring for the whole body's mass are 3.8 kN; they do not throw the hand."""
    world = pydart2.World(0.001, "skel/fullbody1.skel")
    world.g = [0.0, 0.0, 0.0]
    hand = world.skeletons[1].body("h_hand_left")
    pull = Pull(hand, hand.C)
    pull.target = pull.point + np.array([0.0, 2.0, 0.0])
    pull.apply()
    world.step()
    acceleration = hand.com_linear_velocity() / world.dt
    assert 0.9 * MAX_ACCELERATION < np.linalg.norm(acceleration) <= 1.01 * np.sqrt(3.0) * MAX_ACCELERATION


def test_nothing_pulls_what_cannot_move(cubes: pydart2.World) -> None:
    ground = cubes.skeletons[0].bodynodes[0]
    pull = Pull(ground, ground.C)
    pull.target = pull.point + np.array([1.0, 0.0, 0.0])
    assert pull.force.tolist() == [0.0, 0.0, 0.0]


def test_captures_are_numbered_and_emptied(tmp_path: Path) -> None:
    folder = CaptureFolder(tmp_path / "a" / "b")
    (tmp_path / "a" / "b").mkdir(parents=True)
    other = tmp_path / "a" / "b" / "precious.png"
    other.touch()
    names = [folder.next_path("my/robot") for _ in range(2)]
    assert [path.name for path in names] == ["my_robot.0000.png", "my_robot.0001.png"]
    for path in names:
        path.touch()
    assert folder.pictures("my/robot") == names
    assert folder.empty() == 2
    assert other.exists()


@pytest.mark.parametrize("kind", ["gif", "mp4"])
def test_records_are_in_real_time(cubes: pydart2.World, tmp_path: Path, kind: str) -> None:
    path = tmp_path / f"cubes.{kind}"
    pydart2.gui.record(cubes, path, seconds=0.5, fps=20.0, size=(161, 121))
    assert cubes.t == pytest.approx(0.5)
    if kind == "gif":
        with Image.open(path) as movie:
            assert (movie.size, movie.n_frames) == ((161, 121), 11)  # type: ignore[attr-defined]
    else:
        import av

        with av.open(str(path)) as movie:
            stream = movie.streams.video[0]
            assert (stream.width, stream.height, stream.average_rate) == (160, 120, 20)
            assert sum(1 for _ in movie.decode(stream)) == 11


def test_a_record_of_user_code_that_raises_says_so(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    class Broken(pydart2.World):
        def on_step_event(self) -> None:
            raise LookupError("no such gain")

    world = Broken(0.001, "./data/skel/cubes.skel")
    with pytest.raises(pydart2.SimulationError, match="no such gain"):
        pydart2.gui.record(world, tmp_path / "x.gif", seconds=0.1, size=(64, 48))
    capsys.readouterr()


def test_a_movie_needs_pictures(tmp_path: Path) -> None:
    with pytest.raises(pydart2.PydartError, match="no pictures"):
        write_movie(tmp_path / "x.gif", [], 10.0)


def test_keys_are_unique_and_leave_characters_to_the_simulation() -> None:
    keys = [key for row in user_input.KEYS for key in row.keys]
    assert len(set(keys)) == len(keys)
    assert not [key for key in keys if len(key) == 1]
    assert user_input.drag_action("left", shift=True) == "zoom"
    assert user_input.drag_action("left", control=True) == user_input.drag_action("middle") == "translate"
    with pytest.raises(KeyError):
        user_input.shortcut("fly")
