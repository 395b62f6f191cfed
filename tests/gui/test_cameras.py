"""Trackballs and cameras: plain geometry."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from pydart2.gui import Camera, Trackball
from pydart2.gui.camera import as_camera, default_trackballs

angles = st.floats(-179.0, 179.0)


def rotation_x(degrees: float) -> np.ndarray:
    cos, sin = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    return np.array([[1, 0, 0], [0, cos, -sin], [0, sin, cos]])


def rotation_z(degrees: float) -> np.ndarray:
    cos, sin = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    return np.array([[cos, -sin, 0], [sin, cos, 0], [0, 0, 1]])


def test_default_trackball() -> None:
    trackball = Trackball()
    assert trackball.trans == [0.0, 0.0, -1.2]
    assert trackball.matrix.dtype == np.float32
    assert trackball.matrix == pytest.approx(np.eye(4).reshape(16))
    assert (trackball.zoom, trackball.distance) == (1, 3)


def test_repr_is_the_originals() -> None:
    trackball = default_trackballs()[1][1]
    assert repr(trackball) == "Trackball(rot=[0.535, 0.284, 0.376, 0.701], \ntrans=[0.100, 0.020, -2.770])"
    assert str(Trackball(30, 20)) == "Trackball(phi=20,theta=30,zoom=1)"


@given(angles, angles)
def test_angles_turn_about_the_world_z_then_the_eye_x(theta: float, phi: float) -> None:
    view = Trackball(theta, phi).view
    assert view[:3, :3] == pytest.approx(rotation_x(-theta) @ rotation_z(-phi), abs=1e-6)


@given(st.floats(-80.0, 80.0), st.floats(-80.0, 80.0))
def test_angles_read_back_and_set_one_by_one(theta: float, phi: float) -> None:
    trackball = Trackball()
    trackball.theta = theta
    trackball._set_phi(phi)
    assert (trackball.theta, trackball.phi) == pytest.approx((theta, phi), abs=1e-3)
    assert trackball.matrix == pytest.approx(Trackball(theta, phi).matrix, abs=1e-6)


def test_default_cameras_look_from_above() -> None:
    (_, y_up), (_, z_up) = default_trackballs()
    for trackball, axis in ((y_up, 1), (z_up, 2)):
        assert trackball.view[1, axis] > 0.9  # the world's up is up in the picture
        assert Camera(trackball.view).position[axis] > 0.1


def test_the_list_of_trans_is_kept() -> None:
    place = [0.1, 0.2, -3.0]
    trackball = Trackball(trans=place)
    trackball.trans[2] = -5.0
    trackball.trans_to(10, -20)
    trackball.zoom_to(3, 4)
    assert place == pytest.approx([0.2, 0.0, -4.93])
    assert trackball.view[:3, 3] == pytest.approx(place)


def test_zoom_and_distance_are_clamped() -> None:
    trackball = Trackball(zoom=100.0, distance=0.0)
    assert (trackball.zoom, trackball.distance) == (10.0, 1.0)
    trackball.zoom = 0.0
    assert trackball.zoom == 0.25


@pytest.mark.parametrize(("dx", "dy", "row", "sign"), [(40, 0, 0, 1), (-40, 0, 0, -1), (0, 40, 1, 1), (0, -40, 1, -1)])
def test_what_is_in_front_follows_the_mouse(dx: int, dy: int, row: int, sign: int) -> None:
    trackball = Trackball()
    trackball.viewport = (400, 400)
    trackball.drag_to(200 + dx, 200 + dy, dx, dy)
    front = trackball.view[:3, :3] @ [0.0, 0.0, 1.0]
    assert sign * front[row] > 0.1 and front[2] > 0.9
    # A point of the ball stays under the mouse: of radius 0.8 half viewports, moved by 0.2 of them from its middle.
    start, end = np.array([0.0, 0.0, 0.8]), np.array([dx, dy, 0.0]) / 200.0
    end[2] = np.sqrt(0.64 - end @ end)
    assert trackball.view[:3, :3] @ start == pytest.approx(end, abs=1e-6)


@given(st.lists(st.tuples(*[st.integers(-300, 300)] * 4), max_size=30))
def test_drags_keep_it_a_rotation(drags: list[tuple[int, int, int, int]]) -> None:
    trackball = Trackball(rot=[0.535, 0.284, 0.376, 0.701])
    for drag in drags:
        trackball.drag_to(*drag)
    turn = trackball.view[:3, :3]
    assert turn @ turn.T == pytest.approx(np.eye(3), abs=1e-5)
    assert np.linalg.det(turn) == pytest.approx(1.0, abs=1e-5)


@pytest.mark.parametrize("rot", [[0.0, 0.0, 0.0, 0.0], [np.nan, 0.0, 0.0, 1.0], [1.0, 0.0, 0.0]])
def test_a_wrong_quaternion_is_refused(rot: list[float]) -> None:
    with pytest.raises(ValueError, match="quaternion"):
        Trackball(rot=rot)


def test_look_at() -> None:
    camera = Camera.look_at([3.0, 0.0, 1.0], [0.0, 0.0, 1.0], [0.0, 0.0, 1.0])
    assert camera.position == pytest.approx([3.0, 0.0, 1.0])
    assert camera.view @ [0.0, 0.0, 1.0, 1.0] == pytest.approx([0.0, 0.0, -3.0, 1.0])
    assert camera.view @ [0.0, 1.0, 2.0, 1.0] == pytest.approx([1.0, 1.0, -3.0, 1.0])
    assert camera.pose @ camera.view == pytest.approx(np.eye(4))
    with pytest.raises(ValueError, match="up"):
        Camera.look_at([0, 0, 1], [0, 0, 0], [0, 0, 1])


def test_the_view_around_a_box_has_all_its_corners() -> None:
    camera = Camera.around([-1, -2, -3], [2, 3, 4], [1, 1, 1], [0, 0, 1])
    for corner in np.ndindex(2, 2, 2):
        point = np.where(corner, [2, 3, 4], [-1, -2, -3])
        clip = camera.projection(1.0) @ camera.view @ np.append(point, 1.0)
        assert (np.abs(clip[:2]) <= clip[3]).all()


def test_projection_edges() -> None:
    camera = Camera(np.eye(4), fov=np.pi / 2, near=0.1, far=10.0)
    matrix = camera.projection(2.0)
    for point, expected in (([4.0, 2.0, -2.0], [1, 1]), ([0.0, 0.0, -0.1], [0, 0]), ([-4.0, -2.0, -2.0], [-1, -1])):
        clip = matrix @ [*point, 1.0]
        assert clip[:2] / clip[3] == pytest.approx(expected)
    for depth, expected_z in ((0.1, -1.0), (10.0, 1.0)):
        clip = matrix @ [0.0, 0.0, -depth, 1.0]
        assert clip[2] / clip[3] == pytest.approx(expected_z)


@pytest.mark.parametrize(
    "wrong", [2, -1, (np.zeros((4, 4)), 0.7), (np.eye(3), 0.7), (np.eye(4), 0.0), (np.eye(4), 4.0)]
)
def test_wrong_cameras_are_refused(wrong: object) -> None:
    with pytest.raises(ValueError, match="camera"):
        as_camera(wrong)  # type: ignore[arg-type]
