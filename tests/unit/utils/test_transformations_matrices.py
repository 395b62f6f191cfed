"""Transforms of pydart2.utils.transformations: what they do to points, and back to their parameters."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from scipy import linalg
from scipy.spatial.transform import Rotation

from pydart2.utils import transformations as tf

numbers = st.floats(-10.0, 10.0)
points = st.tuples(numbers, numbers, numbers).map(np.array)
units = points.filter(lambda v: np.linalg.norm(v) > 0.1).map(lambda v: v / np.linalg.norm(v))
angles = st.floats(-3.1, 3.1)
RNG = np.random.default_rng(5)


def close(actual: object, expected: object, tolerance: float = 1e-9) -> None:
    np.testing.assert_allclose(actual, expected, rtol=tolerance, atol=tolerance)


def apply(matrix: np.ndarray, point: np.ndarray) -> np.ndarray:
    """Where a transform takes a point."""
    image = matrix @ [*point, 1.0]
    return image[:3] / image[3]


def across(vector: np.ndarray, normal: np.ndarray) -> np.ndarray:
    """A unit vector orthogonal to a unit vector."""
    rest = vector - (vector @ normal) * normal
    assume(np.linalg.norm(rest) > 1e-3)
    return rest / np.linalg.norm(rest)


def skew(v: np.ndarray) -> np.ndarray:
    return np.array([[0.0, -v[2], v[1]], [v[2], 0.0, -v[0]], [-v[1], v[0], 0.0]])


def test_identity() -> None:
    np.testing.assert_array_equal(tf.identity_matrix(), np.eye(4))
    tf.identity_matrix()[0, 0] = 5.0
    np.testing.assert_array_equal(tf.identity_matrix(), np.eye(4))


@given(points, points)
def test_translation(direction: np.ndarray, x: np.ndarray) -> None:
    matrix = tf.translation_matrix(direction)
    close(apply(matrix, x), x + direction)
    np.testing.assert_array_equal(tf.translation_from_matrix(matrix), direction)


def test_results_are_copies() -> None:
    matrix = np.eye(4)
    tf.translation_from_matrix(matrix)[:] = 1.0
    np.testing.assert_array_equal(matrix, np.eye(4))


@given(points, units, points, st.floats(0.1, 5.0))
def test_reflection(point: np.ndarray, normal: np.ndarray, x: np.ndarray, length: float) -> None:
    matrix = tf.reflection_matrix(point, length * normal)
    image = apply(matrix, x)
    close(apply(matrix, image), x)
    close(((x + image) / 2.0 - point) @ normal, 0.0)  # the middle lies in the plane
    close(np.cross(x - image, normal), np.zeros(3))
    found_point, found_normal = tf.reflection_from_matrix(matrix)
    close(abs(found_normal @ normal), 1.0)
    assert found_point.shape == (4,)
    close((found_point[:3] - point) @ normal, 0.0)
    close(tf.reflection_matrix(found_point, found_normal), matrix)


@given(angles, units, points)
def test_rotation_is_the_exponential(angle: float, direction: np.ndarray, point: np.ndarray) -> None:
    expected = linalg.expm(angle * skew(direction))
    close(tf.rotation_matrix(angle, 3.0 * direction)[:3, :3], expected)
    matrix = tf.rotation_matrix(angle, direction, point)
    close(matrix[:3, :3], expected)
    close(apply(matrix, point + 2.0 * direction), point + 2.0 * direction)


@given(angles, units, points)
def test_rotation_round_trip(angle: float, direction: np.ndarray, point: np.ndarray) -> None:
    assume(abs(angle) > 1e-3)
    found = tf.rotation_from_matrix(tf.rotation_matrix(angle, direction, point))
    assert found[0] == pytest.approx(abs(angle))
    close(found[1] * np.sign(angle), direction, 1e-7)
    close(np.cross(found[2][:3] - point, direction), np.zeros(3), 1e-6)
    assert found[2][3] == 1.0


def test_rotation_by_zero_and_by_pi() -> None:
    angle, direction, point = tf.rotation_from_matrix(np.eye(4))
    assert angle == 0.0
    close(direction, [0.0, 0.0, 1.0])
    close(point, [0.0, 0.0, 0.0, 1.0])
    angle, direction, point = tf.rotation_from_matrix(tf.rotation_matrix(np.pi, [0, 1, 0], [1, 7, 2]))
    assert angle == pytest.approx(np.pi)
    close(np.abs(direction), [0.0, 1.0, 0.0])
    close(point, [1.0, 0.0, 2.0, 1.0])


@given(st.floats(-5.0, 5.0), points, units, points)
def test_scale(factor: float, origin: np.ndarray, direction: np.ndarray, x: np.ndarray) -> None:
    close(apply(tf.scale_matrix(factor, origin), x) - origin, factor * (x - origin))
    close(apply(tf.scale_matrix(factor), x), factor * x)
    along = ((x - origin) @ direction) * direction
    image = apply(tf.scale_matrix(factor, origin, 2.0 * direction), x)
    close(image - x, (factor - 1.0) * along)


@given(st.floats(-5.0, 5.0), points, st.none() | units)
def test_scale_round_trip(factor: float, origin: np.ndarray, direction: np.ndarray | None) -> None:
    assume(abs(factor - 1.0) > 1e-3)
    matrix = tf.scale_matrix(factor, origin, direction)
    found = tf.scale_from_matrix(matrix)
    assert found[0] == pytest.approx(factor, abs=1e-9)
    assert (found[2] is None) == (direction is None)
    close(tf.scale_matrix(*found), matrix, 1e-8)
    close(apply(matrix, found[1][:3]), found[1][:3], 1e-8)


def test_scale_by_one() -> None:
    factor, origin, direction = tf.scale_from_matrix(np.eye(4))
    assert (factor, direction) == (1.0, None)
    close(origin, [0.0, 0.0, 0.0, 1.0])


@given(st.floats(-1.4, 1.4), points, points, units, points)
def test_shear(angle: float, direction: np.ndarray, point: np.ndarray, normal: np.ndarray, x: np.ndarray) -> None:
    direction = across(direction, normal)
    matrix = tf.shear_matrix(angle, direction, point, normal)
    height = (x - point) @ normal
    close(apply(matrix, x) - x, np.tan(angle) * height * direction)
    assume(abs(angle) > 1e-3)
    found = tf.shear_from_matrix(matrix)
    assert found[0] == pytest.approx(abs(angle))
    close(found[3] @ normal * (found[1] @ direction), np.sign(angle), 1e-6)
    close((found[2][:3] - point) @ normal, 0.0, 1e-6)
    close(tf.shear_matrix(*found), matrix, 1e-6)


def test_shear_along_its_normal() -> None:
    with pytest.raises(ValueError, match="orthogonal"):
        tf.shear_matrix(0.1, [1, 0, 0], [0, 0, 0], [1, 1, 0])


SCREW = tf.translation_matrix([0, 0, 1]) @ tf.rotation_matrix(0.5, [0, 0, 1])
GLIDE = tf.translation_matrix([0, 0, 1]) @ tf.reflection_matrix([0, 0, 0], [1, 0, 0])
SHEAR = tf.shear_matrix(0.3, [1, 0, 0], [0, 0, 0], [0, 1, 0])


@pytest.mark.parametrize(
    ("function", "matrices"),
    [
        (tf.rotation_from_matrix, [SCREW, GLIDE, SHEAR, tf.translation_matrix([1, 0, 0]), 2.0 * SCREW]),
        (tf.reflection_from_matrix, [SCREW, GLIDE, SHEAR, np.eye(4)]),
        (tf.scale_from_matrix, [SCREW, GLIDE, SHEAR, tf.translation_matrix([1, 0, 0])]),
        (tf.shear_from_matrix, [SCREW, GLIDE, np.eye(4), tf.scale_matrix(2.0)]),
        (tf.projection_from_matrix, [SCREW, GLIDE, SHEAR, np.eye(4), np.full((4, 4), 0.5)]),
    ],
)
def test_matrix_of_another_kind(function: object, matrices: list[np.ndarray]) -> None:
    for matrix in matrices:
        with pytest.raises(ValueError, match="not a "):
            function(matrix)


@given(points, units, units, points)
def test_parallel_projection(point: np.ndarray, normal: np.ndarray, direction: np.ndarray, x: np.ndarray) -> None:
    assume(abs(normal @ direction) > 0.05)
    matrix = tf.projection_matrix(point, normal, 2.0 * direction)
    image = apply(matrix, x)
    close((image - point) @ normal, 0.0, 1e-7)
    close(np.cross(image - x, direction), np.zeros(3), 1e-7)
    close(tf.projection_matrix(point, normal), tf.projection_matrix(point, normal, normal))
    found = tf.projection_from_matrix(matrix)
    close(abs(found[1] @ normal), 1.0, 1e-7)
    close(abs(found[2] @ direction), 1.0, 1e-7)
    assert found[3:] == (None, False)
    close(tf.projection_matrix(*found), matrix, 1e-7)


@given(points, units, points, points)
def test_perspective_projection(point: np.ndarray, normal: np.ndarray, eye: np.ndarray, x: np.ndarray) -> None:
    assume(abs((eye - point) @ normal) > 0.1)
    assume(abs((eye - x) @ normal) > 0.1)
    matrix = tf.projection_matrix(point, 2.0 * normal, perspective=eye)
    image = apply(matrix, x)
    close((image - point) @ normal, 0.0, 1e-6)
    close(np.cross(image - eye, x - eye), np.zeros(3), 1e-5)  # on the ray
    deep = apply(tf.projection_matrix(point, normal, perspective=eye, pseudo=True), x)
    close(apply(tf.projection_matrix(point, normal), deep), image, 1e-6)


@given(points, units, points, st.booleans(), st.floats(-3.0, 3.0).filter(lambda f: abs(f) > 0.1))
def test_perspective_round_trip(
    point: np.ndarray, normal: np.ndarray, eye: np.ndarray, pseudo: bool, factor: float
) -> None:
    assume(abs((eye - point) @ normal) > 0.1)
    matrix = tf.projection_matrix(point, normal, perspective=eye, pseudo=pseudo)
    found = tf.projection_from_matrix(factor * matrix, pseudo)
    close(abs(found[1] @ normal), 1.0)
    close((found[0][:3] - point) @ normal, 0.0, 1e-7)
    close(found[3], eye, 1e-7)
    assert found[2] is None
    assert found[4] is pseudo
    with pytest.raises(ValueError, match="not a projection"):
        tf.projection_from_matrix(matrix, not pseudo)


def test_pseudo_depth_is_in_order() -> None:
    matrix = tf.projection_matrix([0, 0, 1], [0, 0, 1], perspective=[0, 0, 0], pseudo=True)
    depths = [apply(matrix, np.array([0.3, 0.2, z]))[2] for z in (1.0, 2.0, 3.0, 10.0)]
    assert depths[0] == pytest.approx(1.0)
    assert np.all(np.diff(depths) > 0.0) or np.all(np.diff(depths) < 0.0)


def test_degenerate_projections() -> None:
    with pytest.raises(ValueError, match="parallel"):
        tf.projection_matrix([0, 0, 0], [0, 0, 1], direction=[1, 0, 0])
    with pytest.raises(ValueError, match="in the plane"):
        tf.projection_matrix([0, 0, 1], [0, 0, 1], perspective=[5, 0, 1])


BOUNDS = (-1.5, 2.0, -0.5, 1.0, 0.5, 4.0)


def test_clip_box() -> None:
    matrix = tf.clip_matrix(*BOUNDS)
    close(apply(matrix, np.array(BOUNDS[::2])), [-1.0, -1.0, -1.0])
    close(apply(matrix, np.array(BOUNDS[1::2])), [1.0, 1.0, 1.0])


def test_clip_pyramid() -> None:
    left, right, bottom, top, near, far = BOUNDS
    matrix = tf.clip_matrix(*BOUNDS, perspective=True)
    close(apply(matrix, np.array([left, bottom, near])), [-1.0, -1.0, -1.0])
    close(apply(matrix, np.array([right, top, near])), [1.0, 1.0, -1.0])
    close(apply(matrix, np.array([right, bottom, near]) * far / near), [1.0, -1.0, 1.0])
    assert (matrix @ [0.0, 0.0, 2.0, 1.0])[3] == -2.0


@pytest.mark.parametrize(
    ("bounds", "perspective"),
    [
        ((1, 1, 0, 1, 1, 2), False),
        ((0, 1, 1, 0, 1, 2), False),
        ((0, 1, 0, 1, 2, 1), True),
        ((0, 1, 0, 1, 0, 1), True),
    ],
)
def test_clip_bounds(bounds: tuple[float, ...], perspective: bool) -> None:
    with pytest.raises(ValueError, match=r"expected|positive"):
        tf.clip_matrix(*bounds, perspective=perspective)


def test_inverse_and_product() -> None:
    for size in range(1, 7):
        matrix = RNG.normal(size=(size, size))
        close(tf.inverse_matrix(matrix), linalg.inv(matrix), 1e-8)
    a, b, c = RNG.normal(size=(3, 4, 4))
    close(tf.concatenate_matrices(a, b, c), a @ b @ c)
    close(tf.concatenate_matrices(), np.eye(4))
    with pytest.raises(np.linalg.LinAlgError):
        tf.inverse_matrix(np.zeros((2, 2)))


def test_is_same_transform() -> None:
    matrix = tf.random_rotation_matrix()
    assert tf.is_same_transform(matrix, -3.0 * matrix) is True
    assert tf.is_same_transform(matrix, matrix + 1e-12) is True
    assert tf.is_same_transform(matrix, tf.translation_matrix([0.001, 0, 0]) @ matrix) is False


@pytest.mark.parametrize(
    "call",
    [
        lambda: tf.translation_matrix([1, 2]),
        lambda: tf.rotation_matrix(1.0, [1, 2, 3, 4, 5]),
        lambda: tf.rotation_from_matrix(np.eye(3)),
        lambda: tf.quaternion_multiply([1, 0, 0], [1, 0, 0, 0]),
        lambda: tf.euler_from_matrix(np.eye(2)),
        lambda: tf.compose_matrix(angles=[1, 2]),
    ],
)
def test_wrong_shapes_say_expected_and_got(call: object) -> None:
    with pytest.raises(ValueError, match="expected, got"):
        call()


def test_zero_axis() -> None:
    with pytest.raises(ValueError, match="direction: a zero vector"):
        tf.rotation_matrix(1.0, [0, 0, 0])


# compose and decompose

scales = st.floats(0.1, 5.0)


@given(
    st.tuples(scales, scales, scales),
    st.tuples(*[st.floats(-2.0, 2.0)] * 3),
    st.tuples(angles, st.floats(-1.5, 1.5), angles),
    points,
    st.sampled_from([1.0, -1.0]),
)
def test_decompose_undoes_compose(
    scale: tuple[float, ...], shear: tuple[float, ...], turn: tuple[float, ...], move: np.ndarray, sign: float
) -> None:
    matrix = tf.compose_matrix(sign * np.array(scale), shear, turn, move)
    found = tf.decompose_matrix(matrix)
    for actual, expected in zip(found, (sign * np.array(scale), shear, turn, move, [0, 0, 0, 1])):
        close(actual, expected, 1e-7)


def test_compose_is_a_product() -> None:
    scale, shear, turn, move, perspective = (
        [2.0, 3.0, -4.0],
        [0.1, 0.2, 0.3],
        [0.4, 0.5, 0.6],
        [1, 2, 3],
        [0, 0.1, 0, 2],
    )
    z = np.eye(4)
    z[0, 1], z[0, 2], z[1, 2] = shear
    r = np.eye(4)
    r[:3, :3] = Rotation.from_euler("xyz", turn).as_matrix()
    t = np.eye(4)
    t[:3, 3] = move
    p = np.eye(4)
    p[3] = perspective
    expected = p @ t @ r @ z @ np.diag([*scale, 1.0])
    close(tf.compose_matrix(scale, shear, turn, move, perspective), expected / expected[3, 3])
    close(tf.compose_matrix(), np.eye(4))
    close(tf.compose_matrix(angles=turn), r)
    close(tf.compose_matrix(scale=scale, translate=move), t @ np.diag([*scale, 1.0]))


def test_compose_undoes_decompose_of_any_matrix() -> None:
    for _ in range(100):
        matrix = RNG.normal(size=(4, 4))
        assert tf.is_same_transform(tf.compose_matrix(*tf.decompose_matrix(matrix)), matrix)


def test_decompose_singular() -> None:
    with pytest.raises(ValueError, match="singular"):
        tf.decompose_matrix(np.diag([1.0, 0.0, 1.0, 1.0]))
    with pytest.raises(ValueError, match="last entry"):
        tf.decompose_matrix(np.diag([1.0, 1.0, 1.0, 0.0]))


def test_orthogonalization() -> None:
    lengths, degrees = [9.8, 12.0, 15.5], [87.2, 80.7, 69.7]
    matrix = tf.orthogonalization_matrix(lengths, degrees)
    a, b, c = matrix[:3, :3].T
    close([np.linalg.norm(edge) for edge in (a, b, c)], lengths)
    close(np.rad2deg([tf.angle_between_vectors(*pair) for pair in ((b, c), (a, c), (a, b))]), degrees)
    assert b[0] == c[0] == c[1] == 0.0
    assert matrix.sum() == pytest.approx(43.063229, abs=1e-6)  # the number of Gohlke's documentation
    close(tf.orthogonalization_matrix([10, 10, 10], [90, 90, 90])[:3, :3], 10.0 * np.eye(3))
    with pytest.raises(ValueError, match="no cell"):
        tf.orthogonalization_matrix([1, 1, 1], [30, 30, 90])
