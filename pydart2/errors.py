"""The exceptions of this package. Wrong arguments are plain ValueError, TypeError or IndexError."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Self


class PydartError(RuntimeError):
    """Something that the engine cannot do; the base of the errors below."""


class LoadError(PydartError, OSError):
    """A model file that is missing or cannot be read.

    Attributes
    ----------
    path : str or None
        The file; None if it is a text that has none.
    line : int or None
        Where in it, from 1, if that is known.
    reason : str
        Why, without the place.
    """

    path: str | None = None
    line: int | None = None
    reason: str = ""

    def __new__(cls, *args: object) -> Self:  # else RuntimeError's is found, by tblib (Dask) too, which refuses
        return OSError.__new__(cls, *args)

    @classmethod
    def at(cls, path: str | None, line: int | None, reason: str) -> LoadError:
        """An error that says the place and the reason."""
        place = repr(path) if path else "the XML text"
        error = cls(f"cannot load {place}{f', line {line}' if line else ''}: {reason}")
        error.path, error.line, error.reason = path, line, reason
        return error


class ExportError(PydartError, ValueError):
    """A skeleton or world that a file format cannot hold."""


class SimulationError(PydartError):
    """A simulation whose state is no longer finite."""


class DestroyedError(PydartError):
    """The use of something that is gone: its world was destroyed, or its skeleton's tree has changed."""


class NameNotFound(KeyError, ValueError):
    """A name that is not there; says where it was looked for and the nearest name."""

    def __init__(self, kind: str, name: object, where: str, names: Iterable[str] = ()) -> None:
        message = f"no {kind} {name!r} in {where}"
        near = nearest(str(name), names)
        if near is not None:
            message += f"; did you mean {near!r}?"
        super().__init__(message)

    def __str__(self) -> str:
        return str(self.args[0])  # KeyError would quote the sentence

    def __reduce__(self) -> tuple[object, ...]:
        return _restore_name_not_found, (str(self),)


def nearest(name: str, names: Iterable[str], cutoff: float = 0.4) -> str | None:
    """What `name` is misspelt from, or the shortest name that it is a part of, or else what is a little like it."""
    from difflib import get_close_matches

    names = list(names)
    longer = [known for known in names if len(name) > 2 and name.lower() in known.lower()]
    likely, possible = (get_close_matches(name, names, n=1, cutoff=c) for c in (0.75, cutoff))
    return next(iter([*likely, *sorted(longer, key=len), *possible]), None)


def _restore_name_not_found(message: str) -> NameNotFound:
    error = NameNotFound.__new__(NameNotFound)
    error.args = (message,)
    return error
