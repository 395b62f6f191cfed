"""pydart2.utils.misc against NumPy, SciPy and closed forms."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy import optimize

from pydart2.utils import misc

numbers = st.floats(-1e6, 1e6)


@pytest.mark.parametrize(
    ("x", "precision", "text"),
    [
        (None, 6, "None"),
        (1, 6, "1.000000"),
        (-0.125, 2, "-0.12"),
        (np.float64(2.5), 1, "2.5"),
        (np.array(2.5), 1, "2.5"),
        ([1, None, 0.5], 2, "[1.00, None, 0.50]"),
        ((), 3, "[]"),
        (np.array([[1.0, 2.0], [3.0, 4.0]]), 0, "[[1, 2], [3, 4]]"),
    ],
)
def test_text(x: object, precision: int, text: str) -> None:
    assert misc.S(x, precision) == text


def test_text_has_six_digits_by_default() -> None:
    assert misc.S([np.pi]) == "[3.141593]"


@given(st.lists(st.integers(0, 5), max_size=6))
def test_split_by_sizes_puts_together_again(sizes: list[int]) -> None:
    whole = np.arange(sum(sizes) * 2).reshape(-1, 2)
    pieces = misc.split_by_sizes(whole, sizes)
    assert [len(piece) for piece in pieces] == sizes
    np.testing.assert_array_equal(np.concatenate([whole[:0], *pieces]), whole)


@pytest.mark.parametrize("sizes", [[1, 1], [2, 2], [4, -1]])
def test_split_by_sizes_refuses_other_sums(sizes: list[int]) -> None:
    with pytest.raises(ValueError, match="length 3"):
        misc.split_by_sizes([1, 2, 3], sizes)


@given(arrays(float, 4, elements=numbers))
def test_norm2(x: np.ndarray) -> None:
    assert misc.norm2(x) == pytest.approx(np.linalg.norm(x) ** 2)


@given(numbers, numbers, st.floats(0.0, 1e6))
def test_penalize_and_confine(x: float, lo: float, width: float) -> None:
    hi = lo + width
    assert misc.confine(x, lo, hi) == np.clip(x, lo, hi)
    assert misc.penalize(x, lo, hi) == pytest.approx(abs(x - np.clip(x, lo, hi)))
    assert type(misc.confine(x, lo, hi)) is type(misc.penalize(x, lo, hi)) is float


def test_penalize_and_confine_elementwise() -> None:
    np.testing.assert_array_equal(misc.confine([-2, 0.5, 3], 0.0, [1, 1, 2]), [0.0, 0.5, 2.0])
    np.testing.assert_array_equal(misc.penalize([-2, 0.5, 3], 0.0, [1, 1, 2]), [2.0, 0.0, 1.0])


def test_finite_differences_are_exact_for_a_parabola() -> None:
    h, t = 0.1, 0.7
    x0, x1, x2 = (np.array([3.0, 1.0]) * s**2 + np.array([1.0, -2.0]) * s for s in (t - h, t, t + h))
    np.testing.assert_allclose(misc.vel(h, x0, x1, x2), [6 * t + 1, 2 * t - 2], rtol=1e-12)
    np.testing.assert_allclose(misc.acc(h, x0, x1, x2), [6.0, 2.0], rtol=1e-10)


def test_finite_differences_without_ends() -> None:
    assert misc.vel(0.5, None, 1.0, 4.0) == 6.0
    assert misc.vel(0.5, 3.0, 1.0, None) == -4.0
    assert misc.vel(0.5, None, 1.0, None) == 0.0
    assert misc.acc(0.5, None, 1.0, 4.0) == misc.acc(0.5, 3.0, 1.0, None) == 0.0
    np.testing.assert_array_equal(misc.vel(0.5, [1.0, 2.0], [3.0, 3.0], None), [4.0, 2.0])
    np.testing.assert_array_equal(misc.acc(0.5, [1.0, 2.0], [3.0, 3.0], None), [0.0, 0.0])


def test_gradients_of_rosenbrock() -> None:
    x = np.array([1.3, 0.7, 0.8, 1.9])
    exact = optimize.rosen_der(x)
    np.testing.assert_allclose(misc.grad(optimize.rosen, x, 1e-5), exact, rtol=1e-6)
    np.testing.assert_allclose(misc.grad4(optimize.rosen, x, 1e-3), exact, rtol=1e-9)


@pytest.mark.parametrize(("gradient", "order"), [(misc.grad, 2), (misc.grad4, 4)])
def test_order_of_the_error(gradient: object, order: int) -> None:
    errors = [abs(gradient(lambda x: np.exp(x[0]), [1.0], h)[0] - np.e) for h in (0.1, 0.05)]
    assert np.log2(errors[0] / errors[1]) == pytest.approx(order, abs=0.05)


def test_gradient_leaves_its_argument_and_takes_integers() -> None:
    x = np.array([1, 2])
    np.testing.assert_allclose(misc.grad(misc.norm2, x, 0.1), [2.0, 4.0])
    np.testing.assert_array_equal(x, [1, 2])


def test_degrees() -> None:
    assert misc.deg2rad(180) == np.pi
    assert misc.rad2deg(np.pi) == 180.0
    np.testing.assert_allclose(misc.deg2rad([0, 90, -45]), [0.0, np.pi / 2, -np.pi / 4])
    np.testing.assert_allclose(misc.rad2deg(misc.deg2rad([1.0, 2.0])), [1.0, 2.0])
