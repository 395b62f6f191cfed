"""How long something takes."""

from __future__ import annotations

import functools
import logging
import time
from collections.abc import Callable
from types import TracebackType
from typing import Any, Concatenate, ParamSpec, TypeVar

P = ParamSpec("P")
R = TypeVar("R")
Self = TypeVar("Self")
Method = Callable[Concatenate[Self, P], R]
Paint = Callable[[str], str]


def decorator_time_measure(func: Method[Self, P, R], text_decor: Paint | None = None) -> Method[Self, P, R]:
    """Let a method report the time of each call, through ``self.logger`` if there is one, else by print().

    Parameters
    ----------
    func
        The method.
    text_decor
        str → str for the report, such as a function of pydart2.utils.colored_text.
    """

    @functools.wraps(func)
    def measured(self: Self, /, *args: P.args, **kwargs: P.kwargs) -> R:
        with TimeMeasure(getattr(self, "logger", None), getattr(func, "__name__", str(func)), text_decor):
            return func(self, *args, **kwargs)

    return measured


def decorator_time_measure_colored(text_decor: Paint) -> Callable[[Method[Self, P, R]], Method[Self, P, R]]:
    """decorator_time_measure() with a decorated report: ``@decorator_time_measure_colored(red)``."""

    def decorate(func: Method[Self, P, R]) -> Method[Self, P, R]:
        return decorator_time_measure(func, text_decor)

    return decorate


class TimeMeasure:
    """Context manager that reports the time spent inside.

    Parameters
    ----------
    logger
        Where to report, as INFO; None for print().
    name
        What is measured; None for "time".
    color
        str → str for the report, such as a function of pydart2.utils.colored_text.

    Attributes
    ----------
    tic, toc : float
        time.perf_counter() at the begin and the end, s.
    """

    def __init__(
        self, logger: logging.Logger | None = None, name: str | None = None, color: Paint | None = None
    ) -> None:
        self.logger = logger
        self.name = name
        self.color = color
        self.tic = self.toc = 0.0

    def __enter__(self) -> TimeMeasure:
        self.tic = time.perf_counter()
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        self.toc = time.perf_counter()
        text = f"{self.name or 'time'}: {self.toc - self.tic:.6f} s"
        if self.color is not None:
            text = self.color(text)
        report: Callable[[str], Any] = print if self.logger is None else self.logger.info
        report(text)
