"""Vectors over named dofs."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

import pydart2
from pydart2 import Skeleton, SkelVector

from .table import row, rows

A, B = "back_bkz", "l_arm_ely"  # dofs 6 and 11
J = 11
PREFIX = "skel_vector.SkelVector: "


@pytest.fixture
def v(atlas: Skeleton) -> SkelVector:
    """The numbers 0 to 32 with the names of the dofs."""
    return SkelVector(np.arange(33.0), atlas)


@row("skel_vector.SkelVector")
def test_constructor(atlas: Skeleton) -> None:
    assert_allclose(SkelVector(skel=atlas), np.zeros(33))
    data = np.arange(33.0)
    SkelVector(data, atlas)[A] = 100.0
    assert data[6] == 100.0  # a view
    with pytest.raises(ValueError):
        SkelVector(np.zeros(3), atlas)


@row("skel_vector.SkelVector.skel", "skel_vector.SkelVector.keys")
def test_attributes(atlas: Skeleton, v: SkelVector) -> None:
    assert v.skel is atlas
    assert v.keys == [dof.name for dof in atlas.dofs]


# What an expression gives: the numbers, and the names of what it picks (None where names have no meaning).
Read = tuple[Callable[[Any], Any], Any, list[int] | None]
READS: dict[str, Read] = {
    "v['name']": (lambda v: v[A], 6.0, None),
    "v[i]": (lambda v: v[4], 4.0, None),
    "v[-1]": (lambda v: v[-1], 32.0, None),
    "v[np.int64(1)]": (lambda v: v[np.int64(1)], 1.0, None),
    "v['a','b']": (lambda v: v[A, B], [6, J], [6, J]),
    "v[('a','b')]": (lambda v: v[(A, B)], [6, J], [6, J]),
    "v[['a','b']]": (lambda v: v[[A, B]], [6, J], [6, J]),
    "v[(2,4,5)]": (lambda v: v[(2, 4, 5)], [2, 4, 5], [2, 4, 5]),
    "v[0,2]": (lambda v: v[0, 2], [0, 2], [0, 2]),
    "v[(-1,0)]": (lambda v: v[(-1, 0)], [32, 0], [32, 0]),
    "v[i:j:k]": (lambda v: v[1:8:2], [1, 3, 5, 7], [1, 3, 5, 7]),
    "v[ndarray]": (lambda v: v[np.array([3, 1])], [3, 1], [3, 1]),
    "v[mask]": (lambda v: v[v > 30.5], [31, 32], [31, 32]),
    "copy()": (lambda v: v.copy(), range(33), [*range(33)]),
    "np.clip": (lambda v: np.clip(v, 0, 1), np.minimum(range(33), 1), [*range(33)]),
    "np.linalg.solve": (lambda v: np.linalg.solve(2 * np.eye(33), v), np.arange(33) / 2, [*range(33)]),
    "v[()]": (lambda v: v[()], range(33), [*range(33)]),
    "v[(np.int64(1), np.int64(2))]": (lambda v: v[(np.int64(1), np.int64(2))], [1, 2], [1, 2]),
    "v[[]]": (lambda v: v[[]], [], []),
    "v[[True, False, …]]": (lambda v: v[[True, False, True] + 30 * [False]], [0, 2], [0, 2]),
}


@rows(PREFIX, READS)
def test_read(v: SkelVector, case: Read) -> None:
    expression, numbers, picked = case
    result = expression(v)
    assert_allclose(result, list(numbers) if isinstance(numbers, range) else numbers)
    if picked is not None:
        assert isinstance(result, SkelVector)
        assert result.keys == [v.keys[i] for i in picked]
        for i in picked:
            assert result[v.keys[i]] == pytest.approx(result[picked.index(i)])
    else:
        assert np.ndim(result) == 0


def _set(key: Any, value: Any) -> Callable[[Any], None]:
    return lambda v: v.__setitem__(key, value)


WRITES: dict[str, tuple[Callable[[Any], None], dict[int, float]]] = {
    "v['a'] = x": (_set(A, -1.0), {6: -1}),
    "v['a','b'] = 1, 2": (_set((A, B), (-1, -2)), {6: -1, J: -2}),
    "v[('a','b')] = …": (_set((A, B), -3.0), {6: -3, J: -3}),
    "v[['a','b']] = 0.5, -0.5": (_set([A, B], (-0.5, 0.5)), {6: -0.5, J: 0.5}),
    "v[(2,4,5)] = [..]": (_set((2, 4, 5), [-1, -2, -3]), {2: -1, 4: -2, 5: -3}),
    "v[ndarray_of_int] = x": (_set(np.array([7, 8]), -1.0), {7: -1, 8: -1}),
}


@rows(PREFIX, WRITES)
def test_write(v: SkelVector, case: tuple[Callable[[Any], None], dict[int, float]]) -> None:
    write, changed = case
    write(v)
    expected = np.arange(33.0)
    expected[list(changed)] = list(changed.values())
    assert_allclose(v, expected)


@row(PREFIX + "'a' in v")
def test_contains(v: SkelVector) -> None:
    assert A in v and "nothing" not in v and 1.0 not in v
    for use in (lambda: v["nothing"], lambda: v.__setitem__("nothing", 1.0)):
        with pytest.raises(ValueError, match="nothing"):
            use()


@row(PREFIX + "to_index(key)")
def test_to_index(v: SkelVector) -> None:
    assert [v.to_index(key) for key in (3, -1, A)] == [3, 32, 6]
    key: Any = 1.5
    assert v.to_index(key) is None


@rows(
    PREFIX,
    {
        "M.dot(v)": (lambda v: (2 * np.eye(33)).dot(v), 2 * np.arange(33.0)),
        "np.concatenate": (lambda v: np.concatenate([v, v[:1]]), [*range(33), 0]),
        "np.array(v)": (lambda v: np.array(v), np.arange(33.0)),
    },
)
def test_plain(v: SkelVector, case: tuple[Callable[[Any], Any], Any]) -> None:
    expression, expected = case
    result = expression(v)
    assert_allclose(result, expected)
    assert not getattr(result, "keys", [])  # no names that would be wrong


@row(PREFIX + "v.sum()")
def test_sum(v: SkelVector) -> None:
    assert float(v.sum()) == sum(range(33))


@row(PREFIX + "str(v)", PREFIX + "repr(v)")
def test_text(v: SkelVector) -> None:
    assert str(v[:3]) == "[0. 1. 2.]"
    assert repr(v[A, B]) == "SkelVector(\n  back_bkz    6\n  l_arm_ely   11\n)"


@row(PREFIX + "v[:, None]", PREFIX + "v.reshape(2,2)")
def test_two_dimensions(v: SkelVector) -> None:
    assert v[:, None].shape == (33, 1)
    square = v[:4].reshape(2, 2)
    assert_allclose(square, [[0, 1], [2, 3]])
    assert repr(square) == "SkelVector([[0., 1.],\n            [2., 3.]])"


def test_arithmetic_keeps_names(atlas: Skeleton) -> None:
    assert (atlas.q + pydart2.SkelVector(np.ones(33), atlas))[A] == 1.0
