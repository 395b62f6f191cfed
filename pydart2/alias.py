"""Short names of methods, declared in one line: ``M = Alias(mass_matrix)``.

The long form is looked up on the object at each use (by `LongForm`), as in the original: a subclass that changes the
one changes the other. Type and docstring are the long form's.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from typing import TYPE_CHECKING, Any, Generic, Never, Self, TypeVar, cast, overload

from pydart2._native import LongForm

Got = TypeVar("Got")
Given = TypeVar("Given")
Method = TypeVar("Method", bound=Callable[..., Any])


class Alias(property, Generic[Got]):
    """A property that gives what a method without arguments returns.

    Parameters
    ----------
    long
        The method.
    """

    def __init__(self, long: Callable[[Any], Got]) -> None:
        super().__init__(LongForm(long), doc=long.__doc__)

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
        property.__init__(self, LongForm(long), LongForm(set_long), doc=long.__doc__)

    if TYPE_CHECKING:

        def __set__(self, owner: object, value: Given, /) -> None: ...


def forwards(*given: bool | str | None) -> Callable[[Method], Method]:
    """Marks a method that only hands on to its handle's of the same name: a short name then asks the handle itself.

    So it does while no subclass and no object has a method of its own, and where the value that is set is an array.

    Parameters
    ----------
    *given
        What a method that reads gives the handle if it is told nothing, at most three; a str is an attribute's name.
    """

    def marked(method: Method) -> Method:
        method.forwards = given  # type: ignore[attr-defined]
        return method

    return marked


def also(method: Method) -> Method:
    """The same method under another name: ``body = also(bodynode)``."""
    name = method.__name__

    @wraps(method)
    def call(self: Any, *args: Any, **named: Any) -> Any:
        return getattr(self, name)(*args, **named)

    return cast("Method", call)
