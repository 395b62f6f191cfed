"""Vectors of pydart2.utils.transformations."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from pydart2.utils import transformations as tf

V0 = np.array([[2.0, 0.0, 0.0, 2.0], [0.0, 2.0, 0.0, 2.0], [0.0, 0.0, 2.0, 2.0]])
V1 = np.array([[3.0], [0.0], [0.0]])


@pytest.mark.parametrize("axis", [None, 0, 1, -1])
def test_vector_norm(axis: int | None) -> None:
    data = np.random.default_rng(1).normal(size=(4, 3))
    expected = np.linalg.norm(data.ravel() if axis is None else data, axis=axis)
    np.testing.assert_allclose(tf.vector_norm(data, axis), expected)
    out = np.empty(expected.shape)
    assert tf.vector_norm(data, axis, out) is None
    np.testing.assert_allclose(out, expected)


def test_vector_norm_of_small_things() -> None:
    assert tf.vector_norm([]) == 0.0
    assert tf.vector_norm([-3]) == 3.0


@pytest.mark.parametrize("axis", [None, 0, 1])
def test_unit_vector(axis: int | None) -> None:
    data = np.random.default_rng(2).normal(size=(4, 3))
    units = tf.unit_vector(data, axis)
    np.testing.assert_allclose(tf.vector_norm(units, axis), np.ones(np.shape(tf.vector_norm(data, axis))))
    np.testing.assert_allclose(units * np.expand_dims(tf.vector_norm(data, axis), axis or 0), data)
    assert tf.unit_vector(data, axis, out=data) is None
    np.testing.assert_array_equal(data, units)


def test_unit_vector_of_small_things() -> None:
    assert tf.unit_vector([]).tolist() == []
    assert tf.unit_vector([-2]).tolist() == [-1.0]
    with pytest.raises(ValueError, match="zero vector"):
        tf.unit_vector([[1.0, 0.0], [0.0, 0.0]], axis=1)


def test_random_vector() -> None:
    np.random.seed(3)
    first = tf.random_vector(1000)
    np.random.seed(3)
    np.testing.assert_array_equal(tf.random_vector(1000), first)
    assert 0.0 <= first.min() < 0.05 < 0.95 < first.max() < 1.0
    assert tf.random_vector((2, 3)).shape == (2, 3)


def test_vector_product() -> None:
    expected = np.array([[0.0, 0.0, 0.0, 0.0], [0.0, 0.0, 6.0, 6.0], [0.0, -6.0, 0.0, -6.0]])
    np.testing.assert_array_equal(tf.vector_product(V0, V1), expected)
    np.testing.assert_array_equal(tf.vector_product(V0.T, V1.T, axis=1), expected.T)
    np.testing.assert_array_equal(tf.vector_product([1, 0, 0], [0, 1, 0]), [0.0, 0.0, 1.0])


def test_angle_between_vectors() -> None:
    expected = [0.0, np.pi / 2, np.pi / 2, np.arccos(1.0 / np.sqrt(3.0))]
    np.testing.assert_allclose(tf.angle_between_vectors(V0, V1), expected)
    np.testing.assert_allclose(tf.angle_between_vectors(V0.T, V1.T, axis=1), expected)
    np.testing.assert_allclose(tf.angle_between_vectors(V0, -V1), np.pi - np.array(expected))
    np.testing.assert_allclose(tf.angle_between_vectors(V0, -V1, directed=False), expected)


@given(st.floats(0.0, np.pi), st.floats(0.1, 10.0))
def test_angle_is_exact_everywhere(angle: float, length: float) -> None:
    turned = [length * np.cos(angle), length * np.sin(angle)]
    assert tf.angle_between_vectors([2.0, 0.0], turned) == pytest.approx(angle, rel=1e-12, abs=1e-15)


def test_angle_of_a_zero_vector() -> None:
    with pytest.raises(ValueError, match="zero vector"):
        tf.angle_between_vectors([0, 0, 0], [1, 0, 0])
