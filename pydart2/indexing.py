"""Names for the entries of a vector: built once per skeleton, shared by all of its vectors."""

from __future__ import annotations

import math
import weakref
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np

from pydart2.errors import NameNotFound

if TYPE_CHECKING:
    from pydart2.skeleton import Skeleton

_CACHE_SIZE = 256


class Names(dict[Any, int]):
    """Name → index of one axis, with the indices that names, slices, lists and masks stand for.

    Parameters
    ----------
    labels
        The names in order.
    skel
        The skeleton whose dofs they are; held weakly.
    """

    __slots__ = ("__weakref__", "_cache", "_skel", "labels")

    def __init__(self, labels: Iterable[str], skel: Skeleton | weakref.ref[Skeleton] | None = None) -> None:
        self.labels = list(labels)
        super().__init__()
        for i, label in enumerate(self.labels):
            self[(label, i) if label in self else label] = i  # a repeated label: as many keys as entries all the same
        self._skel = skel if skel is None or isinstance(skel, weakref.ref) else weakref.ref(skel)
        self._cache: dict[Any, tuple[Any, Names | None]] = {}

    @property
    def skel(self) -> Skeleton | None:
        """The skeleton whose dofs these are, None if there is none (any more)."""
        return None if self._skel is None else self._skel()

    def index(self, name: str) -> int:
        """The index of a name; NameNotFound with the nearest name if there is none."""
        try:
            return self[name]
        except KeyError:
            where = "this vector" if self.skel is None else f"skeleton {self.skel.name!r}"
            raise NameNotFound("dof", name, where, self.labels) from None

    def resolve(self, key: Any) -> tuple[Any, Names | None]:
        """NumPy's index for `key`, and the names of what it picks (None unless that is one-dimensional).

        A tuple or list of names and integers gathers, as in the original pydart2: ``q[0, 2]`` has two entries.
        """
        if isinstance(key, str):
            return self.index(key), None
        cache_key = _cache_key(key)
        if cache_key is not None and cache_key in self._cache:
            return self._cache[cache_key]
        index = self._to_numpy_index(key)
        picked = np.arange(len(self.labels))[index]
        names = Names((self.labels[i] for i in picked), self._skel) if picked.ndim == 1 else None
        if cache_key is not None:
            if len(self._cache) >= _CACHE_SIZE:
                self._cache.clear()
            self._cache[cache_key] = (index, names)
        return index, names

    def resolve_last(self, key: Any, shape: tuple[int, ...]) -> tuple[Any, Names | None]:
        """As resolve(), for an array of this shape whose last axis they name.

        A name, or several, pick there; so they do as the last of NumPy's indices: ``q[3, "knee"]``, ``q[:9, ["hip"]]``.
        """
        if _are_names(key):
            index, names = self.resolve(key)
            return (..., index), names
        if isinstance(key, tuple) and key and _are_names(key[-1]):
            key = (*key[:-1], self.resolve(key[-1])[0])
        places = np.broadcast_to(np.arange(len(self.labels)), shape)[key]  # on the last axis, and on all before it
        others = np.broadcast_to(np.arange(math.prod(shape[:-1])).reshape(*shape[:-1], 1), shape)[key]
        if places.ndim == 0 or places.size == 0:
            return key, self if places.shape[-1:] == shape[-1:] else None
        row = places[(0,) * (places.ndim - 1)]
        if not (_is_constant(places, range(places.ndim - 1)) and _is_constant(others, [places.ndim - 1])):
            return key, None
        whole = len(row) == len(self.labels) and np.array_equal(row, np.arange(len(row)))
        return key, self if whole else Names((self.labels[i] for i in row), self._skel)

    def _to_numpy_index(self, key: Any) -> Any:
        if isinstance(key, np.ndarray) and key.dtype.kind in "UO":
            key = key.tolist()
        if not isinstance(key, (tuple, list)) or _is_multidimensional(key):
            return key
        if not key:
            return np.empty(0, dtype=np.intp)
        return np.asarray([self.index(k) if isinstance(k, str) else k for k in key])


def _is_constant(array: np.ndarray, axes: Iterable[int]) -> bool:
    """Whether it is the same along some axes. Views that are have strides of 0 there, which is seen at once."""
    return all(
        array.strides[axis] == 0 or array.shape[axis] == 1 or not np.ptp(array, axis=axis).any() for axis in axes
    )


def _are_names(key: Any) -> bool:
    """Whether a key is a name, or some."""
    several = isinstance(key, (tuple, list)) and len(key) > 0
    return all(isinstance(k, str) for k in key) if several else isinstance(key, str)


def _is_multidimensional(key: Any) -> bool:
    """Whether a tuple is one of NumPy's own forms: (), (3,), and with slices, None or an ellipsis."""
    if not isinstance(key, tuple):
        return False
    if len(key) == 1 and not isinstance(key[0], str):
        return True
    return not key or any(k is None or k is ... or isinstance(k, slice) for k in key)


def _cache_key(key: Any) -> Any:
    """A hashable stand-in for keys that come again and again, None for the others."""
    if isinstance(key, slice):
        return slice, key.start, key.stop, key.step
    if isinstance(key, (tuple, list)) and all(type(k) is str or type(k) is int for k in key):
        return type(key), *key
    return None
