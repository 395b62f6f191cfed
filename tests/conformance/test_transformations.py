"""Homogeneous matrices and quaternions [w, x, y, z]."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.linalg import block_diag
from scipy.spatial.transform import Rotation

from pydart2.utils import transformations as t

from .table import row, rows

PREFIX = "utils.transformations."
X, Y, Z = np.eye(3)
POINT = np.array([0.2, -0.3, 0.5])
HALF, QUARTER = np.pi, np.pi / 2
SQRT = math.sqrt(0.5)


def apply(matrix: Any, point: Any) -> np.ndarray:
    """The point that a homogeneous matrix makes of one."""
    image = np.asarray(matrix) @ [*point, 1]
    return np.asarray(image[:3] / image[3])


# (expression, expected numbers)
Value = tuple[Callable[[], Any], Any]
VALUES: dict[str, Value] = {
    "identity_matrix": (lambda: t.identity_matrix(), np.eye(4)),
    "translation_matrix": (lambda: apply(t.translation_matrix([1, 2, 3]), POINT), np.add(POINT, [1, 2, 3])),
    "translation_from_matrix": (lambda: t.translation_from_matrix(t.translation_matrix([1, 2, 3])), [1, 2, 3]),
    "reflection_matrix": (lambda: apply(t.reflection_matrix([0, 0, 1], Z), POINT), [0.2, -0.3, 1.5]),
    "rotation_matrix": (lambda: apply(t.rotation_matrix(QUARTER, Z, X), [2, 0, 5]), [1, 1, 5]),
    "scale_matrix": (lambda: apply(t.scale_matrix(-2, X), POINT), X - 2 * (POINT - X)),
    "projection_matrix": (lambda: apply(t.projection_matrix([0, 0, 1], Z), POINT), [0.2, -0.3, 1]),
    "clip_matrix": (lambda: apply(t.clip_matrix(0, 2, 0, 4, 0, 8), [2, 4, 4]), [1, 1, 0]),
    "shear_matrix": (lambda: apply(t.shear_matrix(np.pi / 4, X, [0, 0, 0], Z), [0, 0, 2]), [2, 0, 2]),
    "orthogonalization_matrix": (lambda: t.orthogonalization_matrix([2, 3, 4], [90, 90, 90]), np.diag([2, 3, 4, 1])),
    "euler_matrix": (  # about the fixed axes x, then y, then z
        lambda: t.euler_matrix(0.1, 0.2, 0.3, "sxyz"),
        block_diag(Rotation.from_euler("xyz", [0.1, 0.2, 0.3]).as_matrix(), 1),
    ),
    "euler_from_matrix": (
        lambda: t.euler_from_matrix(t.euler_matrix(0.1, 0.2, 0.3, "ryxz"), "ryxz"),
        [0.1, 0.2, 0.3],
    ),
    "euler_from_quaternion": (lambda: t.euler_from_quaternion([math.cos(0.2), math.sin(0.2), 0, 0]), [0.4, 0, 0]),
    "quaternion_from_euler": (lambda: t.quaternion_from_euler(0.4, 0, 0), [math.cos(0.2), math.sin(0.2), 0, 0]),
    "quaternion_about_axis": (lambda: t.quaternion_about_axis(0.4, Y), [math.cos(0.2), 0, math.sin(0.2), 0]),
    "quaternion_matrix": (lambda: apply(t.quaternion_matrix([SQRT, 0, 0, SQRT]), X), Y),
    "quaternion_from_matrix": (lambda: t.quaternion_from_matrix(t.rotation_matrix(QUARTER, Z)), [SQRT, 0, 0, SQRT]),
    "quaternion_multiply": (lambda: t.quaternion_multiply([4, 1, -2, 3], [8, -5, 6, 7]), [28, -44, -14, 48]),
    "quaternion_conjugate": (lambda: t.quaternion_conjugate([1, 2, 3, 4]), [1, -2, -3, -4]),
    "quaternion_inverse": (lambda: t.quaternion_inverse([1, 1, 1, 1]), [0.25, -0.25, -0.25, -0.25]),
    "quaternion_real": (lambda: t.quaternion_real([3, 0, 1, 2]), 3),
    "quaternion_imag": (lambda: t.quaternion_imag([3, 0, 1, 2]), [0, 1, 2]),
    "quaternion_slerp": (lambda: t.quaternion_slerp([1, 0, 0, 0], [0, 0, 0, 1], 0.5), [SQRT, 0, 0, SQRT]),
    "arcball_map_to_sphere": (lambda: t.arcball_map_to_sphere([3, 4], [0, 0], 10), [0.3, -0.4, math.sqrt(0.75)]),
    "arcball_constrain_to_axis": (lambda: t.arcball_constrain_to_axis([0.6, 0, 0.8], Z), X),
    "arcball_nearest_axis": (lambda: t.arcball_nearest_axis([0.1, 0.9, 0.4], [X, Z]), X),
    "vector_norm": (lambda: t.vector_norm([[3, 4], [6, 8]], axis=1), [5, 10]),
    "unit_vector": (lambda: t.unit_vector([0, 3, 4]), [0, 0.6, 0.8]),
    "vector_product": (lambda: t.vector_product(X, 2 * Y), 2 * Z),
    "angle_between_vectors": (lambda: t.angle_between_vectors(X, X + Y), np.pi / 4),
    "inverse_matrix": (
        lambda: apply(t.inverse_matrix(t.translation_matrix([1, 2, 3])), POINT),
        np.subtract(POINT, [1, 2, 3]),
    ),
    "concatenate_matrices": (
        lambda: apply(t.concatenate_matrices(t.rotation_matrix(QUARTER, Z), t.translation_matrix(X)), [0, 0, 0]),
        Y,
    ),
}


@rows(PREFIX, VALUES)
def test_value(case: Value) -> None:
    expression, expected = case
    assert_allclose(expression(), expected, atol=1e-12)


# Functions that take a matrix apart: put together again, their results make it.
APART: dict[str, tuple[Callable[[], Any], Callable[[Any], Any]]] = {
    "rotation_from_matrix": (lambda: t.rotation_matrix(0.4, [1, 2, 3], POINT), lambda p: t.rotation_matrix(*p)),
    "reflection_from_matrix": (lambda: t.reflection_matrix(POINT, [1, 2, 3]), lambda p: t.reflection_matrix(*p)),
    "scale_from_matrix": (lambda: t.scale_matrix(0.5, POINT, [1, 2, 3]), lambda p: t.scale_matrix(*p)),
    "projection_from_matrix": (
        lambda: t.projection_matrix(POINT, [1, 2, 3], direction=[3, 2, 2]),
        lambda p: t.projection_matrix(*p),
    ),
    "shear_from_matrix": (lambda: t.shear_matrix(0.4, X, POINT, Z), lambda p: t.shear_matrix(*p)),
    "decompose_matrix": (
        lambda: t.translation_matrix(POINT) @ t.euler_matrix(0.1, 0.2, 0.3) @ np.diag([2, 3, 4, 1]),
        lambda p: t.compose_matrix(*p),
    ),
    "compose_matrix": (
        lambda: t.translation_matrix(POINT) @ t.euler_matrix(0.1, 0.2, 0.3) @ np.diag([2, 3, 4, 1]),
        lambda p: t.compose_matrix(scale=[2, 3, 4], angles=[0.1, 0.2, 0.3], translate=POINT),
    ),
}


@rows(PREFIX, {name: (name, *case) for name, case in APART.items()})
def test_apart(case: tuple[str, Callable[[], Any], Callable[[Any], Any]]) -> None:
    name, make, again = case
    matrix = make()
    parts = getattr(t, name)(matrix) if "from" in name or name.startswith("de") else None
    assert_allclose(again(parts), matrix, atol=1e-9)


@rows(PREFIX, {name: name for name in ("affine_matrix_from_points", "superimposition_matrix")})
def test_fit(case: str) -> None:
    points = np.random.default_rng(1).normal(size=(3, 10))
    matrix = t.translation_matrix(POINT) @ t.rotation_matrix(0.4, [1, 2, 3])
    moved = (matrix @ np.vstack([points, np.ones(10)]))[:3]
    assert_allclose(getattr(t, case)(points, moved), matrix, atol=1e-9)


@row(PREFIX + "random_quaternion", PREFIX + "random_rotation_matrix")
def test_random_rotations() -> None:
    given = np.array([0.1, 0.4, 0.7])
    q, matrix = t.random_quaternion(given), t.random_rotation_matrix(given)
    assert np.linalg.norm(q) == pytest.approx(1)
    assert_allclose(matrix[:3, :3] @ matrix[:3, :3].T, np.eye(3), atol=1e-12)
    assert_allclose(t.quaternion_matrix(q), matrix, atol=1e-12)
    assert not np.allclose(t.random_quaternion(), t.random_quaternion())


@row(PREFIX + "random_vector")
def test_random_vector() -> None:
    vector = t.random_vector(1000)
    assert vector.shape == (1000,)
    assert vector.min() >= 0 and vector.max() < 1 and abs(vector.mean() - 0.5) < 0.1


@row(PREFIX + "is_same_transform")
def test_same_transform() -> None:
    matrix = t.rotation_matrix(0.4, X)
    assert t.is_same_transform(matrix, 2 * matrix)
    assert not t.is_same_transform(matrix, np.eye(4))


BALL = PREFIX + "Arcball"


@row(BALL, BALL + ".place", BALL + ".down", BALL + ".drag", BALL + ".matrix")
def test_arcball() -> None:
    ball = t.Arcball()
    ball.place([320, 320], 320)
    assert_allclose(ball.matrix(), np.eye(4))
    ball.down([320, 320])
    ball.drag([480, 320])  # half a radius to the right: twice the arc of 30 degrees about y
    assert_allclose(apply(ball.matrix(), Z), [math.sin(np.pi / 3), 0, math.cos(np.pi / 3)], atol=1e-9)


@row(BALL + ".next")
def test_next() -> None:
    ball = t.Arcball()
    ball.place([320, 320], 320)
    ball.down([320, 320])
    ball.drag([400, 320])
    before = ball.matrix()
    ball.next()
    assert np.trace(ball.matrix()) < np.trace(before)  # it turns on


@row(BALL + ".setaxes", BALL + ".constrain")
def test_constrain() -> None:
    ball = t.Arcball()
    ball.place([320, 320], 320)
    assert ball.constrain is False
    ball.setaxes(X, Y)
    ball.constrain = True
    assert ball.constrain is True
    ball.down([320, 320])
    ball.drag([480, 340])
    axis = t.rotation_from_matrix(ball.matrix())[1]
    assert np.sort(np.abs(axis)) == pytest.approx([0, 0, 1], abs=1e-9)
