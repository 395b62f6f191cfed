"""What a world did, as arrays with names: to compute with, to plot, to keep."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from pydart2.errors import NameNotFound, PydartError
from pydart2.indexing import Names
from pydart2.skel_vector import DofArray

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from pandas import DataFrame
    from xarray import Dataset

    from pydart2.skeleton import Skeleton

Array = NDArray[np.float64]
VERSION = 1
_COLUMNS = 16  # contact.hpp
_PARTS = ("version", "first_frame", "t", "skeletons", "ndofs", "dofs", "states", "contacts", "num_contacts")


class ContactArrays:
    """The contacts of a frame, without their world.

    Attributes
    ----------
    points, normals, forces : arrays, shape (n, 3)
        World frame, m, unit vectors, and N on the first body; the normals are towards that body.
    depths : array, shape (n,)
        Penetration depths, m.
    bodies : array of int, shape (n, 4)
        Ids of skeleton and body of the first, then of the second; -1 where there is none.
    """

    def __init__(self, rows: Array) -> None:
        self.points: Array = rows[:, 0:3].copy()
        self.forces: Array = rows[:, 3:6].copy()
        self.bodies = rows[:, 6:10].astype(int)
        self.normals: Array = rows[:, 12:15].copy()
        self.depths: Array = rows[:, 15].copy()

    def __len__(self) -> int:
        return len(self.points)

    def __repr__(self) -> str:
        return f"[ContactArrays: {len(self)} contacts]"


@dataclass(frozen=True, repr=False, eq=False)
class Run:
    """The frames of a recording, without their world.

    >>> run = pydart2.Run.load("run.npz")
    >>> run.t, run["j_knee"]

    Attributes
    ----------
    t : array, shape (n,)
        Simulated time of each frame, s.
    states : array, shape (n, 2 * sum of ndofs)
        [q, dq] of each skeleton, one after another, rad, m, rad/s and m/s; NaN where a skeleton was not there.
    dofs : dict
        Name of a skeleton → names of its dofs, in order.
    first_frame : int
        Index of the first row in the recording: frames before it were no longer kept.
    """

    t: Array
    states: Array
    dofs: Mapping[str, Sequence[str]]
    first_frame: int = 0
    contact_rows: Sequence[Array] = field(default=())

    def q(self, skeleton: Skeleton | str | int | None = None) -> DofArray:
        """Positions of a skeleton over time, shape (n, ndofs), rad or m; by name, index or object, or the only one."""
        return self._part(skeleton, 0)

    def dq(self, skeleton: Skeleton | str | int | None = None) -> DofArray:
        """Velocities of a skeleton over time, shape (n, ndofs), rad/s or m/s; as q()."""
        return self._part(skeleton, 1)

    def __getitem__(self, dof: str) -> Array:
        """Position of a dof over time, shape (n,), rad or m; by its name, or as ``"skeleton.dof"``."""
        skeleton, name = self._find(dof)
        column: Array = np.asarray(self.q(skeleton)[name])
        return column

    def contacts(self, index: int) -> ContactArrays:
        """The contacts of row `index`, from the end if negative; IndexError if there is none."""
        return ContactArrays(self.contact_rows[index])

    def __len__(self) -> int:
        return len(self.t)

    def __repr__(self) -> str:
        span = f", {self.t[0]:g} to {self.t[-1]:g} s" if len(self.t) else ""
        return f"[{type(self).__name__}: {len(self)} frames{span}, {', '.join(self.dofs) or 'no skeletons'}]"

    def _ipython_key_completions_(self) -> list[str]:
        return list(dict.fromkeys(name for names in self.dofs.values() for name in names))

    # For others

    def columns(self) -> Iterator[tuple[str, Array]]:
        """A name and an array of shape (n,) for each dof: ``box.q.joint_x`` in rad or m, then ``box.dq.joint_x``."""
        for skeleton, names in self.dofs.items():
            for kind, values in (("q", self.q(skeleton)), ("dq", self.dq(skeleton))):
                for i, name in enumerate(names):
                    yield f"{skeleton}.{kind}.{name}", np.asarray(values)[:, i]

    def to_pandas(self) -> DataFrame:
        """A table with a row for each frame, over the time `t`, and the columns of columns(). Needs pandas."""
        pandas = _need("pandas", "data")
        table: DataFrame = pandas.DataFrame(dict(self.columns()), index=pandas.Index(self.t, name="t"))
        return table

    def to_xarray(self) -> Dataset:
        """A data set with `q` and `dq` over `t` and `dof`, whose labels are as ``box.joint_x``. Needs xarray."""
        xarray = _need("xarray", "data")
        labels = [f"{skeleton}.{name}" for skeleton, names in self.dofs.items() for name in names]
        data = {
            kind: (("t", "dof"), np.hstack([np.empty((len(self), 0)), *(np.asarray(part(s)) for s in self.dofs)]))
            for kind, part in (("q", self.q), ("dq", self.dq))
        }
        dataset: Dataset = xarray.Dataset(data, coords={"t": self.t, "dof": labels})
        return dataset

    def to_csv(self, path: str | os.PathLike[str]) -> None:
        """Write a table with names in its first line: ``t``, then those of columns()."""
        columns = dict(self.columns())
        table = np.column_stack([self.t, *columns.values()])
        header = ",".join(_quoted(name) for name in ("t", *columns))
        np.savetxt(path, table, fmt="%.17g", delimiter=",", header=header, comments="", encoding="utf-8")

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write all of it to an ``.npz`` file, without pickled objects; OSError if it cannot be written."""
        rows = list(self.contact_rows)
        parts = (
            VERSION,
            self.first_frame,
            self.t,
            np.array(list(self.dofs), dtype=str),
            [len(names) for names in self.dofs.values()],
            np.array([name for names in self.dofs.values() for name in names], dtype=str),
            self.states,
            np.vstack([np.empty((0, _COLUMNS)), *rows]),
            [len(frame) for frame in rows],
        )
        named: dict[str, Any] = dict(zip(_PARTS, parts, strict=True))
        with open(os.fspath(path), "wb") as file:  # a number would be a file descriptor
            np.savez_compressed(file, **named)

    @staticmethod
    def load(path: str | os.PathLike[str]) -> Run:
        """Read a file that save() wrote; OSError if there is none, ValueError if it is
        another file or of another version."""
        try:
            with np.load(path, allow_pickle=False) as file:
                parts: dict[str, Any] = {name: file[name] for name in _PARTS}
        except (KeyError, ValueError, EOFError) as error:
            raise ValueError(f"{os.fspath(path)!r} is not a saved recording: {error}") from None
        if parts["version"] != VERSION:
            raise ValueError(f"{os.fspath(path)!r} is a recording of version {parts['version']}, not of {VERSION}")
        names = np.split(parts["dofs"], np.cumsum(parts["ndofs"])[:-1].astype(int)) if len(parts["ndofs"]) else []
        dofs = {str(s): [str(name) for name in own] for s, own in zip(parts["skeletons"], names, strict=True)}
        rows = np.split(parts["contacts"], np.cumsum(parts["num_contacts"])[:-1].astype(int))
        rows = rows[: len(parts["num_contacts"])]
        return Run(parts["t"], parts["states"], dofs, int(parts["first_frame"]), rows)

    def plot(self, *dofs: str, axes: Axes | None = None) -> Axes:
        """Plot positions of dofs over time with Matplotlib (``pip install 'pydart2[plot]'``); all, if none is named.

        Into the given axes, else into those that are current; returns them. ``matplotlib.pyplot.show()`` shows them.
        """
        pyplot = _need("matplotlib.pyplot", "plot")
        into: Axes = axes if axes is not None else pyplot.gca()
        for name in dofs or [f"{s}.{dof}" for s, names in self.dofs.items() for dof in names]:
            into.plot(self.t, self[name], label=name)
        into.set_xlabel("t / s")
        into.set_ylabel("position / rad or m")
        into.legend()
        return into

    def _part(self, skeleton: Skeleton | str | int | None, half: int) -> DofArray:
        place = self._place(skeleton)
        sizes = [len(names) for names in self.dofs.values()]
        start = 2 * sum(sizes[:place]) + half * sizes[place]
        labels = list(self.dofs.values())[place]
        return DofArray.of(self.states[:, start : start + sizes[place]].copy(), Names(labels))

    def _place(self, skeleton: Skeleton | str | int | None) -> int:
        names = list(self.dofs)
        if skeleton is None:
            moving = [i for i, own in enumerate(self.dofs.values()) if own]
            if len(moving) != 1:
                raise ValueError(f"{len(moving)} skeletons have dofs: say which, of {', '.join(names) or 'none'}")
            return moving[0]
        if isinstance(skeleton, str):
            if skeleton not in names:
                raise NameNotFound("skeleton", skeleton, repr(self), names)
            return names.index(skeleton)
        place = skeleton if isinstance(skeleton, (int, np.integer)) else getattr(skeleton, "id", None)
        if place is None or not -len(names) <= place < len(names):
            raise IndexError(f"no skeleton {skeleton!r} in {self!r}: there are {len(names)}")
        return int(place) % len(names)

    def _find(self, dof: str) -> tuple[str, str]:
        """Skeleton and name of a dof."""
        found = [(s, own) for s, names in self.dofs.items() for own in names if dof in (own, f"{s}.{own}")]
        if not found:
            known = [name for s, names in self.dofs.items() for own in names for name in (own, f"{s}.{own}")]
            raise NameNotFound("dof", dof, repr(self), known)
        if len(found) > 1:
            raise ValueError(f"{len(found)} skeletons have a dof {dof!r}: say '{found[0][0]}.{dof}'")
        return found[0]


def _need(module: str, extra: str) -> Any:
    from importlib import import_module

    try:
        return import_module(module)
    except ImportError:
        name = module.partition(".")[0]
        raise PydartError(f"this needs {name}: pip install 'pydart2[{extra}]'") from None


def _quoted(name: str) -> str:
    return '"' + name.replace('"', '""') + '"' if set(name) & set(',"\r\n') else name
