"""Fits and the arcball of pydart2.utils.transformations."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import minimize
from scipy.spatial.transform import Rotation

from pydart2.utils import transformations as tf

RNG = np.random.default_rng(20)


def close(actual: object, expected: object, tolerance: float = 1e-9) -> None:
    np.testing.assert_allclose(actual, expected, rtol=tolerance, atol=tolerance)


def move(matrix: np.ndarray, points: np.ndarray) -> np.ndarray:
    return matrix[:-1, :-1] @ points + matrix[:-1, -1:]


@pytest.mark.parametrize("dimension", [2, 3, 4, 5])
def test_affine_is_found_exactly(dimension: int) -> None:
    matrix = np.eye(dimension + 1)
    matrix[:-1] = RNG.normal(size=(dimension, dimension + 1))
    points = RNG.normal(size=(dimension, dimension + 4))
    close(tf.affine_matrix_from_points(points, move(matrix, points)), matrix, 1e-8)


def test_affine_of_the_original_documentation() -> None:
    v0 = [[0, 1031, 1031, 0], [0, 0, 1600, 1600]]
    v1 = [[675, 826, 826, 677], [55, 52, 281, 277]]
    expected = [[0.14549, 0.00062, 675.50008], [0.00048, 0.14094, 53.24971], [0.0, 0.0, 1.0]]
    np.testing.assert_allclose(tf.affine_matrix_from_points(v0, v1), expected, atol=6e-6)


def test_affine_minimizes_the_distance_in_both_sets() -> None:
    x = RNG.normal(size=(2, 12))
    y = np.array([[1.5, 0.3], [-0.2, 0.8]]) @ x + 0.2 * RNG.normal(size=(2, 12))
    x, y = x - x.mean(axis=1, keepdims=True), y - y.mean(axis=1, keepdims=True)

    def squares(entries: np.ndarray) -> float:
        """Of the distances of the pairs (x, y) from the graph of the map."""
        linear = entries.reshape(2, 2)
        across = np.linalg.inv(np.eye(2) + linear @ linear.T)
        rest = y - linear @ x
        return float(np.einsum("in,ij,jn", rest, across, rest))

    found = tf.affine_matrix_from_points(x, y)[:2, :2]
    best = minimize(squares, np.eye(2).ravel(), method="BFGS", options={"gtol": 1e-9})
    close(found, best.x.reshape(2, 2), 1e-5)


@pytest.mark.parametrize("usesvd", [True, False])
@pytest.mark.parametrize("scale", [True, False])
def test_similarity_is_found_exactly(usesvd: bool, scale: bool) -> None:
    matrix = tf.translation_matrix([1, -2, 3]) @ tf.random_rotation_matrix([0.3, 0.6, 0.9])
    if scale:
        matrix = matrix @ tf.scale_matrix(2.5)
    points = RNG.normal(size=(3, 10))
    images = move(matrix, points)
    close(tf.affine_matrix_from_points(points, images, shear=False, scale=scale, usesvd=usesvd), matrix)
    close(tf.superimposition_matrix(points, images, scale=scale, usesvd=usesvd), matrix)
    ones = np.ones((1, 10))
    close(tf.superimposition_matrix(np.vstack([points, ones]), np.vstack([images, ones]), scale, usesvd), matrix)


@pytest.mark.parametrize("usesvd", [True, False])
def test_superimposition_against_scipy(usesvd: bool) -> None:
    for _ in range(10):
        x, y = RNG.normal(size=(2, 3, 6))  # nothing in common, so reflections are tempting
        expected, _ = Rotation.align_vectors(
            (y - y.mean(axis=1, keepdims=True)).T, (x - x.mean(axis=1, keepdims=True)).T
        )
        matrix = tf.superimposition_matrix(x, y, usesvd=usesvd)
        close(matrix[:3, :3], expected.as_matrix(), 1e-7)
        close(move(matrix, x).mean(axis=1), y.mean(axis=1))


def test_superimposition_scales_by_the_ratio_of_sizes() -> None:
    x, y = RNG.normal(size=(2, 3, 6))
    matrix = tf.superimposition_matrix(x, y, scale=True)
    assert np.var(move(matrix, x), axis=1).sum() == pytest.approx(np.var(y, axis=1).sum())


def test_rotation_in_the_plane() -> None:
    points, angle = RNG.normal(size=(2, 5)), 0.7
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    for usesvd in (True, False):
        close(tf.affine_matrix_from_points(points, turn @ points, False, False, usesvd)[:2, :2], turn)


@pytest.mark.parametrize(
    ("v0", "v1"),
    [
        (np.zeros((3, 4)), np.zeros((3, 5))),
        (np.zeros((3, 2)), np.zeros((3, 2))),
        (np.zeros((1, 4)), np.zeros((1, 4))),
        (np.zeros(3), np.zeros(3)),
    ],
)
def test_wrong_points(v0: np.ndarray, v1: np.ndarray) -> None:
    with pytest.raises(ValueError, match="expected, got"):
        tf.affine_matrix_from_points(v0, v1)
    with pytest.raises(ValueError, match="expected, got"):
        tf.superimposition_matrix(v0, v1)


def test_scale_of_one_point() -> None:
    with pytest.raises(ValueError, match="coincide"):
        tf.superimposition_matrix(np.ones((3, 4)), RNG.normal(size=(3, 4)), scale=True)


# Arcball


def test_map_to_sphere() -> None:
    close(tf.arcball_map_to_sphere([320, 320], [320, 320], 320), [0.0, 0.0, 1.0])
    close(tf.arcball_map_to_sphere([480, 320], [320, 320], 320), [0.5, 0.0, np.sqrt(0.75)])
    close(tf.arcball_map_to_sphere([320, 160], [320, 320], 320), [0.0, 0.5, np.sqrt(0.75)])  # up in the window
    close(tf.arcball_map_to_sphere([320 + 3000, 320 + 4000], [320, 320], 320), [0.6, -0.8, 0.0])


def test_constrain_to_axis() -> None:
    for _ in range(20):
        point, axis = tf.unit_vector(RNG.normal(size=3)), tf.unit_vector(RNG.normal(size=3))
        found = tf.arcball_constrain_to_axis(point, 2.0 * axis)
        close(found @ axis, 0.0)
        close(np.linalg.norm(found), 1.0)
        assert found[2] >= 0.0
        close(np.cross(axis, point) @ found, 0.0)  # in the plane of point and axis
    for axis in ([0, 0, 1], [0, 0, -1]):
        close(tf.arcball_constrain_to_axis(axis, axis), [1.0, 0.0, 0.0])
    close(tf.arcball_constrain_to_axis([1, 0, 0], [1, 0, 0]), [0.0, 1.0, 0.0])


def test_nearest_axis() -> None:
    point = tf.unit_vector([0.1, 0.9, 0.4])
    np.testing.assert_array_equal(tf.arcball_nearest_axis(point, np.eye(3)), [1.0, 0.0, 0.0])
    np.testing.assert_array_equal(tf.arcball_nearest_axis(point, [[0, 1, 0], [0, 0, 1]]), [0.0, 0.0, 1.0])


def ball_at(constrain: bool = False) -> tf.Arcball:
    ball = tf.Arcball()
    ball.place([100, 100], 100)
    ball.setaxes([1, 0, 0], [0, 1, 0])
    ball.constrain = constrain
    return ball


def test_drag_turns_by_twice_the_arc() -> None:
    ball = ball_at()
    ball.down([100, 100])
    close(ball.matrix(), np.eye(4))
    ball.drag([150, 100])  # 30 degrees of arc to the right: about +y
    close(ball.matrix(), tf.rotation_matrix(np.pi / 3, [0, 1, 0]))
    ball.drag([100, 50])  # up: about -x
    close(ball.matrix(), tf.rotation_matrix(-np.pi / 3, [1, 0, 0]))
    ball.drag([100, 100])
    close(ball.matrix(), np.eye(4))


def test_drags_add_up() -> None:
    ball = ball_at()
    ball.down([100, 100])
    ball.drag([150, 100])
    ball.down([100, 100])
    close(ball.matrix(), tf.rotation_matrix(np.pi / 3, [0, 1, 0]))
    ball.drag([100, 50])
    close(ball.matrix(), tf.rotation_matrix(-np.pi / 3, [1, 0, 0]) @ tf.rotation_matrix(np.pi / 3, [0, 1, 0]))


def test_next_goes_on() -> None:
    ball = ball_at()
    ball.down([100, 100])
    ball.drag([100 + 100 * np.sin(0.1), 100])
    ball.drag([100 + 100 * np.sin(0.2), 100])
    ball.next()
    close(ball.matrix(), tf.rotation_matrix(0.6, [0, 1, 0]))
    ball.next()
    close(ball.matrix(), tf.rotation_matrix(0.8, [0, 1, 0]))
    ball.next(acceleration=0.5)
    close(ball.matrix(), tf.rotation_matrix(1.1, [0, 1, 0]))


def test_constrained_drag_keeps_to_the_axis() -> None:
    ball = ball_at(constrain=True)
    assert ball.constrain is True
    ball.down([120, 101])
    ball.drag([160, 60])
    rotation = Rotation.from_matrix(ball.matrix()[:3, :3]).as_rotvec()
    close(rotation[[0, 2]], [0.0, 0.0])
    assert rotation[1] > 0.1
    ball.setaxes(None)
    ball.down([120, 101])
    ball.drag([120, 60])
    assert abs(Rotation.from_matrix(ball.matrix()[:3, :3]).as_rotvec()[0]) > 0.1


def test_initial_rotation() -> None:
    matrix = tf.random_rotation_matrix([0.3, 0.6, 0.9])
    close(tf.Arcball(matrix).matrix(), matrix)
    close(tf.Arcball(2.0 * tf.quaternion_from_matrix(matrix)).matrix(), matrix)
    with pytest.raises(ValueError, match="expected, got"):
        tf.Arcball(np.eye(3))


def test_arcball_of_the_original_documentation() -> None:
    ball = tf.Arcball(initial=np.identity(4))
    ball.place([320, 320], 320)
    ball.down([500, 250])
    ball.drag([475, 275])
    assert ball.matrix().sum() == pytest.approx(3.90583455, abs=1e-8)
    ball = tf.Arcball(initial=[1, 0, 0, 0])
    ball.place([320, 320], 320)
    ball.setaxes([1, 1, 0], [-1, 1, 0])
    ball.constrain = True
    ball.down([400, 200])
    ball.drag([200, 400])
    assert ball.matrix().sum() == pytest.approx(0.2055924, abs=1e-7)
