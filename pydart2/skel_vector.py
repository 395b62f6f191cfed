"""Vectors over the dofs of a skeleton that are indexed by name as well as by number."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from pydart2._native import NamedVector
from pydart2.indexing import Names
from pydart2.telling import table_of_vector

if TYPE_CHECKING:
    from pydart2.skeleton import Skeleton


class Keys(list[str]):
    """Names, which are also had by a call, as those of a dict."""

    def __call__(self) -> list[str]:
        return self


class SkelVector(NamedVector):
    """A 1-D array with a name for each entry.

    >>> q = skel.q                      # a copy of the engine's positions
    >>> q["j_knee"] = 0.4
    >>> q["j_hip", "j_ankle"] = 0.1, -0.2
    >>> skel.q = q                      # now the robot has moved

    Integers, slices, masks and everything else of NumPy work as on any array; a tuple or list of names or integers
    picks these entries.

    What is picked has the names of what it picks, a result of the same shape those of what it was computed from; all
    else, and what NumPy puts into another order (sort, partition, take, roll), has none.

    Parameters
    ----------
    data
        Numbers, shape (n,); used without a copy where that is possible. Default: zeros.
    skel
        The skeleton whose dof names the entries get.

    Raises
    ------
    NameNotFound
        On an unknown name, with the nearest one; it is a KeyError and a ValueError.
    """

    __slots__ = ()

    def __new__(cls, data: Any = None, skel: Skeleton | None = None) -> SkelVector:
        if data is None:
            if skel is None:
                raise TypeError("SkelVector() needs data, a skeleton or both")
            data = np.zeros(skel.ndofs)
        vector = np.asarray(data).view(cls)
        if skel is not None:
            if vector.shape != (skel.ndofs,):
                raise ValueError(f"skeleton {skel.name!r} has {skel.ndofs} dofs, got data of shape {vector.shape}")
            vector._names = skel.names
        return vector

    @property
    def skel(self) -> Skeleton | None:
        """The skeleton whose dofs these are, if there is one."""
        return None if self._names is None else self._names.skel

    @property
    def keys(self) -> Keys:
        """The names of the entries, in order; empty without names. ``dict(vector)`` calls it."""
        return Keys(() if self._names is None else self._names.labels)

    def to_index(self, key: str | int) -> int | None:
        """The non-negative index of a name or integer; None for anything else."""
        if isinstance(key, str):
            return self._require_names().index(key)
        if isinstance(key, (int, np.integer)):
            return int(key) + self.shape[-1] if key < 0 else int(key)
        return None

    def __contains__(self, key: object) -> bool:
        """Whether there is an entry of this name."""
        return self._names is not None and isinstance(key, str) and key in self._names

    def sort(self, *args: Any, **kwargs: Any) -> None:
        """As of any array; the names are dropped."""
        super().sort(*args, **kwargs)
        self._names = None

    def partition(self, *args: Any, **kwargs: Any) -> None:
        """As of any array; the names are dropped."""
        super().partition(*args, **kwargs)
        self._names = None

    def take(self, *args: Any, **kwargs: Any) -> Any:
        """As of any array, and without names."""
        return np.asarray(self).take(*args, **kwargs)

    def __array_function__(self, func: Any, types: Any, args: Any, kwargs: Any) -> Any:
        result = super().__array_function__(func, types, args, kwargs)
        if func is np.roll and isinstance(result, SkelVector):
            result._names = None
        return result

    def __repr__(self) -> str:
        """A table of names and numbers."""
        if self._names is None or self.ndim != 1:
            return super().__repr__()
        width = max(map(len, self.keys), default=0)
        rows = (f"  {name:<{width}}  {value: .6g}\n" for name, value in zip(self.keys, self.tolist(), strict=True))
        return f"{type(self).__name__}(\n{''.join(rows)})"

    def _repr_html_(self) -> str | None:
        return table_of_vector(self)

    def __reduce__(self) -> tuple[Any, ...]:
        return _restore, (type(self), np.array(self), self.keys or None)

    def _ipython_key_completions_(self) -> list[str]:
        return self.keys

    def _require_names(self) -> Names:
        return Names(()) if self._names is None else self._names


class DofArray(SkelVector):
    """An array of two or more axes, the last of which is over the dofs of a skeleton.

    >>> batch.q["j_knee"]               # of all worlds
    >>> batch.q[3, "j_knee"], batch.q[:8, ["j_hip", "j_knee"]]

    A name, or several, pick there; all other keys are NumPy's. Names are kept and lost as those of a SkelVector.
    """

    __slots__ = ()

    @classmethod
    def of(cls, values: np.ndarray, names: Names) -> DofArray:
        """The values, any shape and units, without a copy, with names on the last axis."""
        array = values.view(cls)
        array._names = names
        return array

    @property
    def T(self) -> Any:  # noqa: N802 (NumPy's name)
        """As of any array, in its units, and without names."""
        return self.transpose()

    @property
    def mT(self) -> Any:  # noqa: N802 (NumPy's name)
        """As of any array, in its units, and without names."""
        return self.swapaxes(-1, -2)

    def transpose(self, *axes: Any) -> Any:
        """As of any array, and without names."""
        return np.asarray(self).transpose(*axes)

    def swapaxes(self, *axes: Any) -> Any:
        """As of any array, and without names."""
        return np.asarray(self).swapaxes(*axes)


def _restore(cls: type[SkelVector], data: np.ndarray, keys: list[str] | None) -> SkelVector:
    vector = data.view(cls)
    vector._names = None if keys is None else Names(keys)
    return vector
