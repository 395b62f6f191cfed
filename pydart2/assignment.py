"""What is assigned is looked at: a method or a read-only property in the way, and names that are nearly others."""

from __future__ import annotations

import inspect
import logging
from collections.abc import Callable, Iterator
from functools import cache
from typing import Any, ClassVar

from pydart2._native import LookedAt
from pydart2.habits import answer, here
from pydart2.original_names import ORIGINAL

_log = logging.getLogger("pydart2")

_PACKAGE = __name__.partition(".")[0]
#: Short names, and what sets them.
_SETTERS = {"m": "set_mass", "I": "set_inertia"}
#: These are no setters of what their name says.
_NO_SETTERS = ("set_frame", "set_recording", "set_name")
#: Who leaves out the last letter means the vector.
_VECTORS = ("positions", "velocities", "accelerations", "forces", "commands")
_SHORT = 4  # letters: names with fewer are near another only if they differ in case


class Assignable(LookedAt):
    """The part of all objects of a world that looks at what is assigned to them.

    Assigning over a method `x()` calls ``set_x(value)``, where there is one. Over another method or a read-only
    property of the original's it is an AttributeError; functions may take a method's place. Over names that are younger
    than the original it is said once and taken, as older code may have attributes of that name.
    """

    _unlooked: ClassVar[set[str]] = set()

    def __init_subclass__(cls, **options: Any) -> None:
        super().__init_subclass__(**options)
        cls._unlooked = set()
        if not _is_ours(cls):
            _say_what_is_hidden(cls)

    def _is_taken(self, name: str, value: Any) -> bool:
        return _takes(self, name, value)

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state)
        for name, value in state.items():
            if callable(value):  # of which the short names have to hear
                setattr(self, name, value)

    def _missing(self, name: str) -> Any:
        """What a name is that is not there: an AttributeError; with an object in it Python would guess too."""
        cls: type = type(self)
        raise AttributeError(answer(cls, name), name=name, obj=None)


def _takes(owner: Assignable, name: str, value: Any) -> bool:
    """Whether the value becomes the attribute `name`; else it is done with already. AttributeError if it cannot be."""
    cls = type(owner)
    known, home = _find(cls, name)
    if known is None:
        setter = _setter(cls, name)
        if setter is not None and name not in vars(owner):
            setter(owner, value)
            return False
        _say_what_is_near(cls, name)
    elif home is not None and _is_ours(home) and _is_in_the_way(known):
        return _takes_over(owner, name, value, known)
    cls._unlooked.add(name)
    return True


def _takes_over(owner: Assignable, name: str, value: Any, known: Any) -> bool:
    """As _takes(), over a method or a read-only property of ours."""
    if callable(value) and not isinstance(known, property):
        return True
    setter = _setter(type(owner), name)
    if setter is not None:
        setter(owner, value)
        return False
    if _is_original(type(owner), name):
        raise AttributeError(_refusal(_known_as(type(owner)), name, known, value))
    if name not in vars(owner):
        _log.warning("%s.%s hides %s.%s", type(owner).__name__, name, _known_as(type(owner)).__name__, name)
    if isinstance(known, property):
        setattr(type(owner), name, _Yielding(known))
        type(owner)._unlooked.add(name)
    return True


class _Yielding:
    """A property that yields to an attribute of the instance, as methods do."""

    def __init__(self, hidden: property) -> None:
        self._hidden = hidden
        self.__doc__ = hidden.__doc__

    def __get__(self, owner: Any, cls: type | None = None) -> Any:
        return self._hidden.__get__(owner, cls)


def _refusal(home: type, name: str, known: Any, value: Any) -> str:
    text, owner = f"{home.__name__}.{name}", home.__name__.lower()
    if isinstance(known, property):
        other = f"; {owner}.set_{name}() is something else" if hasattr(home, f"set_{name}") else ""
        return f"{text} is read-only{other}"
    return f"{text} is a method: call {owner}.{name}(); only a function can take its place, not {value!r}"


def _find(cls: type, name: str) -> tuple[Any, type | None]:
    """A name's value in a class, and which class of its bases has it."""
    for home in cls.__mro__:
        if name in vars(home):
            return vars(home)[name], home
    return None, None


def _is_in_the_way(known: Any) -> bool:
    if isinstance(known, property):
        return known.fset is None
    return inspect.isfunction(known) or isinstance(known, (classmethod, staticmethod, _Yielding))


def _setter(cls: type, name: str) -> Callable[[Any, Any], Any] | None:
    """Our function that sets `name` from one value."""
    setter, home = _find(cls, _SETTERS.get(name, f"set_{name}"))
    if home is None or not _is_ours(home) or not inspect.isfunction(setter) or setter.__name__ in _NO_SETTERS:
        return None
    _, *parameters = inspect.signature(setter).parameters.values()
    positional = [p for p in parameters if p.kind in (p.POSITIONAL_ONLY, p.POSITIONAL_OR_KEYWORD)]
    return setter if positional and all(p.default is not p.empty for p in positional[1:]) else None


def _is_ours(cls: type) -> bool:
    return cls.__module__.partition(".")[0] == _PACKAGE


def _known_as(cls: type) -> type:
    """Our class that a user's is made of, not the part of it that has a name."""
    return next(base for base in cls.__mro__ if _is_ours(base))


def _is_original(cls: type, name: str) -> bool:
    return any(name in ORIGINAL.get(base.__name__, ()) for base in cls.__mro__ if _is_ours(base))


def _say_what_is_hidden(cls: type) -> None:
    """Warn of names that a user's class declares over younger ones of another kind."""
    for name, value in vars(cls).items():
        known, home = next(((vars(b)[name], b) for b in cls.__mro__[1:] if name in vars(b)), (None, None))
        if name[:1] == "_" or home is None or not _is_ours(home) or _is_original(cls, name):
            continue
        if isinstance(known, property) != isinstance(value, property) and _is_in_the_way(known):
            _log.warning("%s.%s hides %s.%s", cls.__name__, name, _known_as(cls).__name__, name)


def _say_what_is_near(cls: type, name: str) -> None:
    """Warn of a name that is nearly one that can be set, or is another library's for something here."""
    if any(name in vars(base).get("__annotations__", ()) for base in cls.__mro__):
        return
    near = next((known for known in _settable(cls) if _are_near(name, known)), None)
    other = here(cls, name)
    if near is not None:
        _log.warning("%s has no %r, which is now an attribute of your own; did you mean %r?", cls.__name__, name, near)
    elif other is not None:
        _log.warning("%s has no %r, which is now an attribute of your own; here that is %s", cls.__name__, name, other)


@cache
def _settable(cls: type) -> tuple[str, ...]:
    return tuple(_names(cls))


def _names(cls: type) -> Iterator[str]:
    for name in dir(cls):
        known, home = _find(cls, name)
        if name[0] != "_" and home is not None and _is_ours(home):
            if isinstance(known, property) and known.fset is not None:
                yield name
            elif _setter(cls, name.removeprefix("set_")) is not None:
                yield name.removeprefix("set_")


def _are_near(one: str, known: str) -> bool:
    """Whether they differ in case, or by one letter that is too few, too many, wrong, or at its neighbour's place."""
    if one.lower() == known.lower():
        return True
    if min(len(one), len(known)) < _SHORT:
        return False
    if one + "s" == known or one == known + "s":
        return known in _VECTORS
    start = next((i for i, (a, b) in enumerate(zip(one, known, strict=False)) if a != b), min(len(one), len(known)))
    rest, other = one[start:], known[start:]
    swapped = rest[:2] == other[:2][::-1] and rest[2:] == other[2:]
    return rest[1:] == other[1:] or rest[1:] == other or rest == other[1:] or swapped
