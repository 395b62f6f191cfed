"""Vectors that are indexed by name: every key means what it says, names follow the entries, nothing leaks."""

from __future__ import annotations

import copy
import gc
import pickle
import sys
import tracemalloc
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import pydart2
from physics.models import arm, make_world
from pydart2 import NameNotFound, SkelVector
from pydart2.skel_vector import DofArray

NAMES = ["hinge0", "hinge1", "hinge2", "hinge3"]
VALUES = [10.0, 11.0, 12.0, 13.0]


@pytest.fixture(scope="module")
def skel(tmp_path_factory: pytest.TempPathFactory) -> pydart2.Skeleton:
    return make_world(tmp_path_factory.mktemp("vector"), arm(4)).skeletons[0]


@pytest.fixture
def v(skel: pydart2.Skeleton) -> SkelVector:
    return SkelVector(np.array(VALUES), skel)


def check(got: Any, keys: list[str], values: list[float]) -> None:
    assert isinstance(got, SkelVector)
    assert got.keys == keys
    assert got.tolist() == values
    for key, value in zip(keys, values, strict=True):
        assert got[key] == value


def test_of_a_skeleton(skel: pydart2.Skeleton) -> None:
    for vector in (skel.q, skel.dq, skel.ddq, skel.tau, SkelVector(skel=skel)):
        check(vector, NAMES, [0.0] * 4)
        assert vector.skel is skel
        assert vector.dtype == np.float64


@pytest.mark.parametrize(("name", "index"), list(zip(NAMES, range(4), strict=True)))
def test_one_entry(v: SkelVector, name: str, index: int) -> None:
    for key in (name, np.str_(name), index, index - 4, np.int64(index), np.int32(index - 4), np.uint8(index)):
        assert v[key] == VALUES[index]
        assert isinstance(v[key], float)
    assert v.to_index(name) == v.to_index(index) == v.to_index(index - 4) == v.to_index(np.int64(index)) == index


SAME = [  # a key with names, the key with integers
    (("hinge0", "hinge2"), (0, 2)),
    (["hinge0", "hinge2"], [0, 2]),
    (("hinge3",), [3]),
    (["hinge3"], [3]),
    (("hinge2", "hinge1", "hinge0"), (2, 1, 0)),
    (("hinge0", -1), (0, 3)),
    ((np.int64(1), "hinge3"), (1, 3)),
    (np.array(["hinge1", "hinge0"]), np.array([1, 0])),
    (np.array(["hinge1", "hinge0"], dtype=object), [1, 0]),
    (NAMES, slice(None)),
    (NAMES[1:3], slice(1, 3)),
    (NAMES[::2], slice(None, None, 2)),
    (NAMES[::-1], slice(None, None, -1)),
    (NAMES[-2:], slice(-2, None)),
    (["hinge1", "hinge3"], [False, True, False, True]),
    (["hinge1", "hinge3"], (False, True, False, True)),
    (["hinge1", "hinge3"], np.array([False, True, False, True])),
    (["hinge3", "hinge0"], np.array([-1, 0])),
    (["hinge3", "hinge0"], [np.int64(-1), np.int32(0)]),
    (NAMES, ...),
    ([], []),
    ([], slice(2, 2)),
]


@pytest.mark.parametrize(("by_name", "by_number"), SAME, ids=str)
def test_names_equal_integers(v: SkelVector, by_name: Any, by_number: Any) -> None:
    expected = np.array(VALUES)[list(by_number) if isinstance(by_number, tuple) else by_number].tolist()
    keys = np.array(NAMES)[list(by_number) if isinstance(by_number, tuple) else by_number].tolist()
    check(v[by_name], keys, expected)
    check(v[by_number], keys, expected)


@pytest.mark.parametrize(("by_name", "by_number"), SAME, ids=str)
def test_assignment_by_name_equals_by_integer(skel: pydart2.Skeleton, by_name: Any, by_number: Any) -> None:
    one, two, plain = SkelVector(skel=skel), SkelVector(skel=skel), np.zeros(4)
    index = list(by_number) if isinstance(by_number, tuple) else by_number
    values = np.arange(1.0, 1 + len(plain[index]))
    one[by_name], two[by_number], plain[index] = values, values, values
    np.testing.assert_array_equal(one, plain)
    np.testing.assert_array_equal(two, plain)


def test_numpy_forms(v: SkelVector) -> None:
    check(v[()], NAMES, VALUES)
    check(v[...], NAMES, VALUES)
    assert v[:, None].shape == (4, 1) and v[:, None].keys == []
    assert v[None].shape == (1, 4) and v[None].keys == []
    assert v[np.newaxis, 1:3].shape == (1, 2)
    assert v[np.array([[0, 1], [2, 3]])].tolist() == [[10, 11], [12, 13]]
    assert v[np.array([[0, 1], [2, 3]])].keys == []
    assert v[np.array(2)] == 12.0
    check(v[v > 11], NAMES[2:], VALUES[2:])


def test_repeated_entries_keep_their_names(v: SkelVector) -> None:
    got = v["hinge2", "hinge1", "hinge2"]
    assert got.tolist() == [12.0, 11.0, 12.0]
    assert got.keys == ["hinge2", "hinge1", "hinge2"]


@pytest.mark.parametrize("first", [(), [], (3,), [3]], ids=str)
@pytest.mark.parametrize("then", [(), [], (3,), [3]], ids=str)
def test_keys_mean_the_same_whatever_was_asked_before(skel: pydart2.Skeleton, first: Any, then: Any) -> None:
    """The keys are remembered; a tuple of one integer or none is NumPy's, a list always gathers."""
    v = SkelVector(np.array(VALUES))
    v._names = pydart2.indexing.Names(NAMES)
    v[first]
    expected = np.array(VALUES)[then]
    assert np.shape(v[then]) == expected.shape
    assert np.array_equal(v[then], expected)


def test_slices_have_their_own_names(v: SkelVector) -> None:
    """The original kept the whole skeleton's names, so that v[1:3]["hinge1"] was wrong."""
    part = v[1:3]
    assert part["hinge1"] == 11.0
    assert "hinge0" not in part
    with pytest.raises(NameNotFound):
        part["hinge0"]
    assert part[1:]["hinge2"] == 12.0


def test_writes(v: SkelVector) -> None:
    v["hinge0"] = -1
    v["hinge1", "hinge2"] = 1, 2
    check(v, NAMES, [-1, 1, 2, 13])
    v[("hinge0", "hinge3")] = [5, 6]
    v[["hinge1", "hinge2"]] = 0.5, -0.5
    check(v, NAMES, [5, 0.5, -0.5, 6])
    v[(0, 2, 3)] = [7, 8, 9]
    v[np.array([1])] = 3
    check(v, NAMES, [7, 3, 8, 9])
    v[1:3] = 0
    v[-1] = 1
    v["hinge0"] += 1
    v["hinge1", "hinge2"] += [4, 5]
    check(v, NAMES, [8, 4, 5, 1])
    v[:] = VALUES
    v[v > 12] = np.nan
    assert np.isnan(v["hinge3"])


def test_slices_are_views_and_gathers_are_copies(v: SkelVector) -> None:
    v[1:3]["hinge2"] = 99.0
    assert v["hinge2"] == 99.0
    v["hinge0", "hinge1"]["hinge0"] = -1.0
    assert v["hinge0"] == 10.0
    base = np.zeros(4)
    SkelVector(base, v.skel)["hinge1"] = 5.0
    assert base.tolist() == [0, 5, 0, 0]


@pytest.mark.parametrize("write", [False, True])
def test_unknown_name(v: SkelVector, write: bool) -> None:
    for key in ("hinge_2", ("hinge0", "hinge_2"), ["hinge_2"]):
        with pytest.raises(NameNotFound, match=r"no dof 'hinge_2' in skeleton 'arm'; did you mean 'hinge\d'\?") as info:
            if write:
                v[key] = 1.0
            else:
                v[key]
        assert isinstance(info.value, KeyError) and isinstance(info.value, ValueError)
    with pytest.raises(NameNotFound, match=r"no dof 'zzz' in skeleton 'arm'$"):
        v["zzz"]
    assert v.tolist() == VALUES


@pytest.mark.parametrize("key", [4, -5, np.int64(4), (0, 4), [0, -5], np.array([7])])
def test_index_out_of_range(v: SkelVector, key: Any) -> None:
    with pytest.raises(IndexError):
        v[key]
    with pytest.raises(IndexError):
        v[key] = 0
    assert v.tolist() == VALUES


@pytest.mark.parametrize("key", [1.5, [True, False], ([0], "hinge1"), {"hinge0"}])
def test_nonsense_keys(v: SkelVector, key: Any) -> None:
    with pytest.raises((IndexError, TypeError, ValueError)):
        v[key]


def test_in(v: SkelVector) -> None:
    assert "hinge0" in v and np.str_("hinge0") in v
    assert "hinge" not in v and 10.0 not in v and None not in v


def test_to_index(v: SkelVector) -> None:
    assert v.to_index(1.0) is None and v.to_index(None) is None
    with pytest.raises(NameNotFound):
        v.to_index("elbow")


def test_ufuncs_keep_names(v: SkelVector) -> None:
    for got, values in [
        (v + 1, [11, 12, 13, 14]),
        (1 + v, [11, 12, 13, 14]),
        (-v, [-10, -11, -12, -13]),
        (v - v, [0] * 4),
        (np.arange(4) * v, [0, 11, 24, 39]),
        (np.maximum(v, 12), [12, 12, 12, 13]),
        (np.clip(v, 11, 12), [11, 11, 12, 12]),
        (np.linalg.solve(2 * np.eye(4), v), [5, 5.5, 6, 6.5]),
        (v.copy(), VALUES),
        (np.zeros_like(v), [0] * 4),
        (v.astype(int), [10, 11, 12, 13]),
    ]:
        check(got, NAMES, values)
    w = v.copy()
    w += 1
    check(w, NAMES, [11, 12, 13, 14])
    check(v > 11, NAMES, [False, False, True, True])


def test_reductions_are_numbers(v: SkelVector) -> None:
    for got, value in [
        (v.sum(), 46),
        (np.max(v), 13),
        (np.mean(v), 11.5),
        (v @ v, 534),
        (v @ np.eye(4) @ v, 534),
        (np.dot(v, np.ones(4)), 46),
        (np.linalg.norm(v), np.sqrt(534)),
        (np.abs(-v).max(), 13),
    ]:
        assert isinstance(got, float) and got == pytest.approx(value)
        assert round(got, 1) == round(float(value), 1)
    assert int(v.argmax()) == 3
    total = np.array(0.0).view(SkelVector)
    assert np.add.reduce(v, out=total) is total and total == 46


def test_plain_results(v: SkelVector) -> None:
    assert type(np.array(v)) is np.ndarray
    both = np.concatenate([v, v])
    assert both.shape == (8,) and getattr(both, "keys", []) == []
    assert np.asarray(np.eye(4).dot(v)).tolist() == VALUES
    assert np.eye(4)[:2].dot(v).shape == (2,)


def test_other_lengths_lose_their_names(v: SkelVector) -> None:
    for got in (v.reshape(2, 2), np.append(v, 1.0), np.resize(v, 3), np.outer(v, v), v[:2].repeat(2)):
        assert getattr(got, "keys", []) == []
    square = v.reshape(2, 2)
    assert square[0, 1] == 11.0  # two dimensions, so no gather
    with pytest.raises((IndexError, NameNotFound)):
        square["hinge0"]
    check(v.reshape(2, 2).reshape(4)[:0].reshape(0), [], [])


@pytest.mark.parametrize("order", ["sort", "reverse", "roll", "take", "sorted"])
def test_names_do_not_mislead_after_reordering(skel: pydart2.Skeleton, order: str) -> None:
    """Entries in another order: either their names went with them, or there are none."""
    v = SkelVector(np.array([13.0, 12.0, 11.0, 10.0]), skel)
    truth = dict(zip(NAMES, v.tolist(), strict=True))
    got = {
        "sort": lambda: np.sort(v),
        "reverse": lambda: v[::-1],
        "roll": lambda: np.roll(v, 1),
        "take": lambda: v.take([3, 2, 1, 0]),
        "sorted": lambda: v[np.argsort(v)],
    }[order]()
    for key in getattr(got, "keys", []):
        assert got[key] == truth[key], f"{key} is {got[key]}"


def test_names_do_not_mislead_after_sorting_in_place(skel: pydart2.Skeleton) -> None:
    v = SkelVector(np.array([13.0, 12.0, 11.0, 10.0]), skel)
    v.sort()
    assert v.tolist() == VALUES
    assert v.keys in ([], NAMES[::-1])


def test_resize_in_place(skel: pydart2.Skeleton) -> None:
    v = skel.q
    v.resize((2, 2), refcheck=False)
    assert v.keys == []


def test_str_and_repr(v: SkelVector) -> None:
    assert str(v) == "[10. 11. 12. 13.]"
    assert repr(v) == "SkelVector(\n  hinge0   10\n  hinge1   11\n  hinge2   12\n  hinge3   13\n)"
    assert repr(v.reshape(2, 2)) == "SkelVector([[10., 11.],\n            [12., 13.]])"
    for other in (v[1:2], v[[]], v.reshape(2, 2), v[:, None], v.sum(), v > 11):
        assert str(other) and repr(other)
    assert f"{v}" == str(v) and f"{v['hinge0']:.2f}" == "10.00"


@pytest.mark.parametrize("how", ["pickle", "copy", "deepcopy", "method"])
def test_copies(v: SkelVector, how: str) -> None:
    make = {
        "pickle": lambda x: pickle.loads(pickle.dumps(x)),
        "copy": copy.copy,
        "deepcopy": copy.deepcopy,
        "method": lambda x: x.copy(),
    }[how]
    got = make(v)
    check(got, NAMES, VALUES)
    got["hinge0"] = 0.0
    assert v["hinge0"] == 10.0
    check(make(v[1:3]), NAMES[1:3], VALUES[1:3])
    assert make(v.reshape(2, 2)).tolist() == [[10, 11], [12, 13]]


@pytest.mark.parametrize("protocol", range(2, pickle.HIGHEST_PROTOCOL + 1))
def test_pickle_keeps_dtype_and_names(v: SkelVector, protocol: int) -> None:
    got = pickle.loads(pickle.dumps(v.astype(np.float32), protocol))
    assert got.dtype == np.float32
    check(got, NAMES, VALUES)


def test_pickle_without_a_skeleton(v: SkelVector) -> None:
    got = pickle.loads(pickle.dumps(v))
    assert got.skel is None
    with pytest.raises(NameNotFound, match="no dof 'hinge9' in this vector; did you mean"):
        got["hinge9"]


def test_bad_construction(skel: pydart2.Skeleton) -> None:
    with pytest.raises(TypeError, match="data, a skeleton or both"):
        SkelVector()
    with pytest.raises(ValueError, match=r"'arm' has 4 dofs, got data of shape \(3,\)"):
        SkelVector([1, 2, 3], skel)
    assert SkelVector([1.0, 2.0]).keys == []


def test_reads_are_copies(skel: pydart2.Skeleton) -> None:
    q = skel.q
    q["hinge0"] = 5.0
    assert skel.q["hinge0"] == 0.0


@given(st.data())
def test_any_gather(data: st.DataObject) -> None:
    """A list of names and integers in any mixture is NumPy's gather by the integers."""
    v = SkelVector(np.array(VALUES))
    v._names = pydart2.indexing.Names(NAMES)
    index = data.draw(st.lists(st.integers(-4, 3), max_size=4, unique_by=lambda i: i % 4))
    mixed = [NAMES[i] if data.draw(st.booleans()) else i for i in index]
    check(v[mixed], [NAMES[i] for i in index], [VALUES[i] for i in index])


@given(st.slices(4), st.slices(4))
def test_any_slice(one: slice, two: slice) -> None:
    v = SkelVector(np.array(VALUES))
    v._names = pydart2.indexing.Names(NAMES)
    check(v[one], NAMES[one], VALUES[one])
    check(v[one][two], NAMES[one][two], VALUES[one][two])


def use(skel: pydart2.Skeleton) -> None:
    """Every path of the C code."""
    v = skel.q
    v["hinge0"], v[1], v[1:3], v["hinge0", 1], v[[True, False, True, False]], v + 1, v.copy(), v.keys
    v["hinge0"] = 1.0
    v["hinge0", "hinge1"] = 1.0, 2.0
    v.reshape(2, 2)[0, 0], v[:, None], str(v), pickle.loads(pickle.dumps(v))
    for key in ("elbow", 9, ("elbow",)):
        with pytest.raises((KeyError, IndexError)):
            v[key]
    with pytest.raises(ValueError, match="could not convert"):
        v["hinge0"] = "text"


def test_no_reference_leaks(skel: pydart2.Skeleton) -> None:
    watched = [skel.names, skel.names.labels, SkelVector, "hinge0"]
    use(skel)
    gc.collect()
    before = [sys.getrefcount(x) for x in watched]
    for _ in range(200):
        use(skel)
    gc.collect()
    after = [sys.getrefcount(x) for x in watched]
    assert np.abs(np.subtract(after, before)).max() < 20, (before, after)


def test_no_memory_leaks(skel: pydart2.Skeleton) -> None:
    tracemalloc.start()
    grown = []
    for _ in range(3):  # the first time caches are filled
        gc.collect()
        start = tracemalloc.get_traced_memory()[0]
        for _ in range(300):
            use(skel)
        gc.collect()
        grown.append(tracemalloc.get_traced_memory()[0] - start)
    tracemalloc.stop()
    assert min(grown) < 50_000, grown  # 300 leaked vectors would be 60 kB or more


def test_names_do_not_keep_the_world_alive(tmp_path: Path) -> None:
    v = make_world(tmp_path, arm(4)).skeletons[0].q
    gc.collect()
    assert v.skel is None
    check(v[1:], NAMES[1:], [0.0] * 3)


# Arrays of more axes, the last with the names


@pytest.fixture
def rows(skel: pydart2.Skeleton) -> DofArray:
    return DofArray.of(np.arange(16.0).reshape(4, 4), skel.names)  # square, so that axes are easily mistaken


ROWS = [  # a key, the same for NumPy, the names that the result has
    ("hinge1", (..., 1), []),
    (("hinge2", "hinge0"), (..., [2, 0]), ["hinge2", "hinge0"]),
    (["hinge3"], (..., [3]), ["hinge3"]),
    ((2, "hinge1"), (2, 1), []),
    ((slice(1, 3), ["hinge1", "hinge3"]), (slice(1, 3), [1, 3]), ["hinge1", "hinge3"]),
    (1, 1, NAMES),
    (slice(0, 2), slice(0, 2), NAMES),
    ((slice(None), slice(2, None)), (slice(None), slice(2, None)), ["hinge2", "hinge3"]),
    ((slice(None), slice(None, None, -1)), (slice(None), slice(None, None, -1)), NAMES[::-1]),
    (np.array([True, False, True, False]), np.array([True, False, True, False]), NAMES),
    ((slice(None), 0), (slice(None), 0), []),
    ((..., None), (..., None), []),
    (([0, 1], [1, 0]), ([0, 1], [1, 0]), []),
    (slice(0, 0), slice(0, 0), NAMES),
]


@pytest.mark.parametrize(("key", "plain", "names"), ROWS, ids=str)
def test_the_last_axis_is_picked_by_name(rows: DofArray, key: Any, plain: Any, names: list[str]) -> None:
    got = rows[key]
    np.testing.assert_array_equal(got, np.asarray(rows)[plain])
    assert (got.keys if isinstance(got, DofArray) else []) == names
    other, expected = rows.copy(), np.array(rows)
    other[key], expected[plain] = -1.0, -1.0
    np.testing.assert_array_equal(other, expected)


def test_results_of_the_same_shape_keep_the_names_of_the_last_axis(rows: DofArray) -> None:
    for same in (
        rows + 1.0,
        np.sin(rows),
        rows.copy(),
        rows[::-1],
        copy.deepcopy(rows),
        pickle.loads(pickle.dumps(rows)),
    ):
        assert same.keys == NAMES and same["hinge1"].shape == (4,)
    orders = (rows.T, rows.T + 1.0, np.transpose(rows), np.swapaxes(rows, 0, 1), np.moveaxis(rows, 0, 1), np.sort(rows))
    for other in (*orders, rows.sum(axis=0), rows.mean(axis=1), rows.reshape(2, 8), rows @ rows.T[:, :3]):
        assert getattr(other, "keys", []) == [] and isinstance(other, np.ndarray)
    with pytest.raises(NameNotFound, match="hinge9"):
        rows["hinge9"]
