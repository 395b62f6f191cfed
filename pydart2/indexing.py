"""Names for the entries of a vector: built once per skeleton, shared by all of its vectors."""

from __future__ import annotations

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

    def _to_numpy_index(self, key: Any) -> Any:
        if isinstance(key, np.ndarray) and key.dtype.kind in "UO":
            key = key.tolist()
        if not isinstance(key, (tuple, list)) or _is_multidimensional(key):
            return key
        if not key:
            return np.empty(0, dtype=np.intp)
        return np.asarray([self.index(k) if isinstance(k, str) else k for k in key])


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
