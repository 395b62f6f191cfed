"""Euler angles and quaternions of pydart2.utils.transformations against SciPy."""

from __future__ import annotations

from itertools import product

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from scipy import linalg, stats
from scipy.spatial.transform import Rotation, Slerp

from pydart2.utils import transformations as tf

LETTERS = ["xyz", "xyx", "xzy", "xzx", "yzx", "yzy", "yxz", "yxy", "zxy", "zxz", "zyx", "zyz"]
AXES = [frame + letters for frame, letters in product("sr", LETTERS)]
angles = st.floats(-3.1, 3.1)
numbers = st.floats(-2.0, 2.0)
quaternions = st.tuples(*[numbers] * 4).map(np.array).filter(lambda q: np.linalg.norm(q) > 0.1)
unit_quaternions = quaternions.map(lambda q: q / np.linalg.norm(q))


def close(actual: object, expected: object, tolerance: float = 1e-10) -> None:
    np.testing.assert_allclose(actual, expected, rtol=tolerance, atol=tolerance)


def to_scipy(q: np.ndarray) -> Rotation:
    return Rotation.from_quat([*q[1:], q[0]])


def about(letter: str, angle: float) -> np.ndarray:
    """The rotation about a coordinate axis, as an exponential."""
    generator = np.zeros((3, 3))
    i, j = {"x": (1, 2), "y": (2, 0), "z": (0, 1)}[letter]
    generator[i, j], generator[j, i] = -angle, angle
    return linalg.expm(generator)


@pytest.mark.parametrize("axes", AXES)
def test_euler_matrix(axes: str) -> None:
    turn = (0.7, -1.1, 2.3)
    first, second, third = (about(letter, angle) for letter, angle in zip(axes[1:], turn))
    expected = third @ second @ first if axes[0] == "s" else first @ second @ third
    matrix = tf.euler_matrix(*turn, axes)
    close(matrix[:3, :3], expected)
    np.testing.assert_array_equal(matrix[3], [0.0, 0.0, 0.0, 1.0])
    np.testing.assert_array_equal(matrix[:3, 3], np.zeros(3))
    close(tf.quaternion_matrix(tf.quaternion_from_euler(*turn, axes)), matrix)


@pytest.mark.parametrize("axes", AXES)
@given(turn=st.tuples(angles, angles, angles))
def test_euler_round_trip(axes: str, turn: tuple[float, float, float]) -> None:
    matrix = tf.euler_matrix(*turn, axes)
    close(tf.euler_matrix(*tf.euler_from_matrix(matrix, axes), axes), matrix)
    close(tf.euler_matrix(*tf.euler_from_matrix(5.0 * matrix[:3, :3], axes), axes), matrix)
    quaternion = tf.quaternion_from_euler(*turn, axes)
    close(tf.euler_matrix(*tf.euler_from_quaternion(quaternion, axes), axes), matrix)


@pytest.mark.parametrize("axes", AXES)
def test_euler_from_matrix_against_scipy(axes: str) -> None:
    letters = axes[1:].upper() if axes[0] == "r" else axes[1:]
    even = axes[1:3] in ("xy", "yz", "zx") if axes[0] == "s" else axes[3:1:-1] in ("xy", "yz", "zx")
    for seed in range(20):
        rotation = Rotation.random(random_state=seed)
        found = tf.euler_from_matrix(rotation.as_matrix(), axes)
        expected = rotation.as_euler(letters)
        if axes[1] == axes[3] and not even:  # the other one of two solutions
            assert -np.pi <= found[1] <= 0.0
            expected = expected * [1, -1, 1] + [np.pi, 0.0, np.pi]
        close(np.exp(1j * np.array(found)), np.exp(1j * expected), 1e-9)


@pytest.mark.parametrize("axes", AXES)
@pytest.mark.parametrize("end", [-1, 0, 1, 2])
def test_euler_angles_where_two_axes_meet(axes: str, end: int) -> None:
    middle = end * np.pi if axes[1] == axes[3] else (end - 0.5) * np.pi
    matrix = tf.euler_matrix(0.4, middle, 0.9, axes)
    found = tf.euler_from_matrix(matrix, axes)
    close(tf.euler_matrix(*found, axes), matrix, 1e-9)
    assert found[2 if axes[0] == "s" else 0] == 0.0


@pytest.mark.parametrize(
    ("name", "four"),
    [
        ("sxyz", (0, 0, 0, 0)),
        ("sxzx", (0, 1, 1, 0)),
        ("szyx", (2, 1, 0, 0)),
        ("rzyx", (0, 0, 0, 1)),
        ("rxzy", (1, 0, 0, 1)),
        ("rzxy", (1, 1, 0, 1)),
        ("rxyz", (2, 1, 0, 1)),
        ("rzyz", (2, 1, 1, 1)),
    ],
)
def test_axes_as_numbers(name: str, four: tuple[int, int, int, int]) -> None:
    matrix = tf.euler_matrix(1.0, 0.2, 3.0, name)
    np.testing.assert_array_equal(tf.euler_matrix(1.0, 0.2, 3.0, four), matrix)
    assert tf.euler_from_matrix(matrix, list(four)) == tf.euler_from_matrix(matrix, name)


def test_all_axes_as_numbers_are_different() -> None:
    matrices = {
        tuple(np.round(tf.euler_matrix(1.0, 0.2, 3.0, four), 9).ravel())
        for four in product((0, 1, 2), (0, 1), (0, 1), (0, 1))
    }
    assert len(matrices) == 24


@pytest.mark.parametrize("axes", ["xyz", "sxxy", "sxyzx", "qxyz", (3, 0, 0, 0), (0, 0, 0), ""])
def test_unknown_axes(axes: object) -> None:
    with pytest.raises(ValueError, match="no Euler axes"):
        tf.euler_matrix(0.0, 0.0, 0.0, axes)
    with pytest.raises(ValueError, match="sxyz"):
        tf.euler_from_matrix(np.eye(4), axes)


def test_numbers_of_the_original_documentation() -> None:
    close(tf.quaternion_from_euler(1, 2, 3, "ryxz"), [0.435953, 0.310622, -0.718287, 0.444435], 1e-6)
    close(tf.quaternion_multiply([4, 1, -2, 3], [8, -5, 6, 7]), [28, -44, -14, 48])
    close(tf.euler_from_quaternion([0.99810947, 0.06146124, 0, 0]), [0.123, 0.0, 0.0], 1e-6)
    close(tf.quaternion_about_axis(0.123, [1, 0, 0]), [0.99810947, 0.06146124, 0, 0], 1e-7)
    rough = [[-0.545, 0.797, 0.260, 0], [0.733, 0.603, -0.313, 0], [-0.407, 0.021, -0.913, 0], [0, 0, 0, 1]]
    close(tf.quaternion_from_matrix(rough), [0.19069, 0.43736, 0.87485, -0.083611], 1e-5)


@given(angles, st.tuples(numbers, numbers, numbers).map(np.array))
def test_quaternion_about_axis(angle: float, axis: np.ndarray) -> None:
    assume(np.linalg.norm(axis) > 1e-3)
    close(tf.quaternion_matrix(tf.quaternion_about_axis(angle, axis)), tf.rotation_matrix(angle, axis))


def test_quaternion_about_no_axis() -> None:
    close(tf.quaternion_about_axis(0.0, [0, 0, 0]), [1.0, 0.0, 0.0, 0.0])
    with pytest.raises(ValueError, match="zero vector"):
        tf.quaternion_about_axis(0.1, [0, 0, 0])


@given(quaternions)
def test_quaternion_matrix(q: np.ndarray) -> None:
    w, x, y, z = q / np.linalg.norm(q)
    expected = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    close(tf.quaternion_matrix(q)[:3, :3], expected)


@given(unit_quaternions, st.booleans())
def test_quaternion_from_matrix(q: np.ndarray, isprecise: bool) -> None:
    found = tf.quaternion_from_matrix(tf.quaternion_matrix(q), isprecise)
    assert found[0] >= 0.0
    close(abs(found @ q), 1.0)


def test_quaternion_from_matrix_is_the_nearest() -> None:
    rng = np.random.default_rng(8)
    for _ in range(20):
        matrix = Rotation.random(random_state=rng.integers(1000)).as_matrix() + 0.2 * rng.normal(size=(3, 3))
        left, _, right = linalg.svd(matrix)
        nearest = left @ np.diag([1.0, 1.0, linalg.det(left @ right)]) @ right
        close(tf.quaternion_matrix(tf.quaternion_from_matrix(matrix))[:3, :3], nearest)


@given(quaternions, quaternions, quaternions)
def test_quaternion_algebra(p: np.ndarray, q: np.ndarray, r: np.ndarray) -> None:
    mul = tf.quaternion_multiply
    close(mul(mul(p, q), r), mul(p, mul(q, r)))
    close(np.linalg.norm(mul(p, q)), np.linalg.norm(p) * np.linalg.norm(q))
    close(mul(p, tf.quaternion_inverse(p)), [1.0, 0.0, 0.0, 0.0])
    close(tf.quaternion_conjugate(mul(p, q)), mul(tf.quaternion_conjugate(q), tf.quaternion_conjugate(p)))
    close(tf.quaternion_matrix(mul(p, q)), tf.quaternion_matrix(p) @ tf.quaternion_matrix(q))


def test_parts_of_a_quaternion() -> None:
    q = np.array([3.0, 0.0, 1.0, 2.0])
    assert tf.quaternion_real(q) == 3.0
    assert type(tf.quaternion_real(q)) is float
    np.testing.assert_array_equal(tf.quaternion_imag(q), [0.0, 1.0, 2.0])
    np.testing.assert_array_equal(tf.quaternion_conjugate(q), [3.0, 0.0, -1.0, -2.0])
    tf.quaternion_imag(q)[:] = 9.0
    np.testing.assert_array_equal(q, [3.0, 0.0, 1.0, 2.0])


def test_zero_quaternion() -> None:
    for function in (tf.quaternion_matrix, tf.quaternion_inverse):
        with pytest.raises(ValueError, match="zero quaternion"):
            function([0, 0, 0, 0])


@given(unit_quaternions, unit_quaternions, st.floats(0.0, 1.0))
def test_slerp_against_scipy(p: np.ndarray, q: np.ndarray, fraction: float) -> None:
    assume(abs(p @ q) > 1e-3)  # else both ways are as short
    ends = Rotation.from_quat([[*p[1:], p[0]], [*q[1:], q[0]]])
    expected = Slerp([0.0, 1.0], ends)(fraction)
    found = tf.quaternion_slerp(2.0 * p, 3.0 * q, fraction)
    close(np.linalg.norm(found), 1.0)
    assert (to_scipy(found) * expected.inv()).magnitude() < 1e-7


@given(unit_quaternions, unit_quaternions, st.floats(0.01, 0.99), st.integers(-2, 2), st.booleans())
def test_slerp_turns_evenly(p: np.ndarray, q: np.ndarray, fraction: float, spin: int, shortest: bool) -> None:
    assume(abs(p @ q) < 0.999)
    found = tf.quaternion_slerp(p, q, fraction, spin, shortest)
    end = -q if shortest and p @ q < 0.0 else q
    angle = np.arccos(p @ end) + spin * np.pi
    close(np.linalg.norm(found), 1.0)
    close(found @ p, np.cos(fraction * angle), 1e-7)
    residual = found - np.linalg.lstsq(np.array([p, q]).T, found)[0] @ np.array([p, q])
    close(residual, np.zeros(4), 1e-6)  # in the plane of both


def test_slerp_ends() -> None:
    p, q = tf.random_quaternion([0.1, 0.2, 0.3]), -tf.random_quaternion([0.5, 0.9, 0.4])
    for spin in (0, 1, 2):
        close(tf.quaternion_slerp(p, q, 0.0, spin), p)
        close(tf.quaternion_slerp(p, q, 1.0, spin), q)
    close(tf.quaternion_slerp(p, p, 0.5), p)
    half = tf.quaternion_slerp([1, 0, 0, 0], [0, 1, 0, 0], 0.5)
    close(half, [np.sqrt(0.5), np.sqrt(0.5), 0, 0])
    close(tf.quaternion_slerp([1, 0, 0, 0], [0, 1, 0, 0], 2.0), [-1, 0, 0, 0])


@given(st.tuples(*[st.floats(0.0, 1.0)] * 3))
def test_random_with_given_numbers(rand: tuple[float, float, float]) -> None:
    q = tf.random_quaternion(rand)
    close(np.linalg.norm(q), 1.0)
    matrix = tf.random_rotation_matrix(rand)
    close(matrix, tf.quaternion_matrix(q))
    close(matrix.T @ matrix, np.eye(4))
    assert linalg.det(matrix) == pytest.approx(1.0)


def test_random_is_uniform() -> None:
    np.random.seed(12)
    sample = np.array([tf.random_quaternion() for _ in range(5000)])
    close(sample.T @ sample / len(sample), np.eye(4) / 4.0, 0.02)
    turn = 2.0 * np.arccos(np.abs(sample[:, 0]))  # its density is (1 - cos) / pi on [0, pi]
    assert stats.kstest(turn, lambda t: (t - np.sin(t)) / np.pi).pvalue > 0.01
