"""Helpers for scripts. Each module loads on first use: ``pydart2.utils`` itself imports nothing."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pydart2.utils import colored_text, jsonpickle, log, misc, time_measure, transformations

__all__ = ["colored_text", "jsonpickle", "log", "misc", "time_measure", "transformations"]


def __getattr__(name: str) -> object:
    if name in __all__:
        return import_module(f"{__name__}.{name}")
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
