"""Short names of methods, declared in one line: ``M = Alias(mass_matrix)``.

The long form is looked up on the object at each use, as in the original: a subclass that changes the one changes the
other. Type and docstring are the long form's.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from typing import TYPE_CHECKING, Any, Generic, Never, Self, TypeVar, cast, overload

Got = TypeVar("Got")
Given = TypeVar("Given")
Method = TypeVar("Method", bound=Callable[..., Any])


# Compiled, as namedtuple does: with getattr() and a name that is looked up, each use takes twice the time.


def _reader(method: str) -> Callable[[Any], Any]:
    return cast("Callable[[Any], Any]", eval(f"lambda self: self.{method}()"))


def _setter(method: str) -> Callable[[Any, Any], Any]:
    """None is refused, which the method may take for an argument that is left out."""
    code = f"lambda self, value: self.{method}(value) if value is not None else refuse({method[4:]!r})"
    return cast("Callable[[Any, Any], Any]", eval(code, {"refuse": _refuse_none}))


def _refuse_none(what: str) -> None:
    raise TypeError(f"{what} cannot be None")


class Alias(property, Generic[Got]):
    """A property that gives what a method without arguments returns.

    Parameters
    ----------
    long
        The method.
    """

    def __init__(self, long: Callable[[Any], Got]) -> None:
        super().__init__(_reader(long.__name__), doc=long.__doc__)

    if TYPE_CHECKING:

        @overload
        def __get__(self, owner: None, cls: type | None = None, /) -> Self: ...
        @overload
        def __get__(self, owner: object, cls: type | None = None, /) -> Got: ...
        def __get__(self, owner: object, cls: type | None = None, /) -> Got | Self: ...
        def __set__(self, owner: object, value: Never, /) -> None: ...


class Settable(Alias[Got], Generic[Got, Given]):
    """As Alias, of a pair of methods: it can be assigned to.

    Parameters
    ----------
    long, set_long
        What reads, and what sets from one value.
    """

    def __init__(self, long: Callable[[Any], Got], set_long: Callable[[Any, Given], object]) -> None:
        property.__init__(self, _reader(long.__name__), _setter(set_long.__name__), doc=long.__doc__)

    if TYPE_CHECKING:

        def __set__(self, owner: object, value: Given, /) -> None: ...


def also(method: Method) -> Method:
    """The same method under another name: ``body = also(bodynode)``."""
    name = method.__name__

    @wraps(method)
    def call(self: Any, *args: Any, **named: Any) -> Any:
        return getattr(self, name)(*args, **named)

    return cast("Method", call)
