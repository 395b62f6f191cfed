"""What a command has to say."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Report:
    """The same for people and for programs.

    Attributes
    ----------
    text : str
    data
        Of dicts, lists, numbers, strings, bools and None.
    good : bool
        False ends the process with status 1.
    """

    text: str
    data: Any
    good: bool = True


def table(rows: Iterable[Sequence[object]], head: Sequence[str]) -> str:
    """Columns as wide as what stands in them; numbers to the right."""
    cells = [list(head), *([_text(value) for value in row] for row in rows)]
    values = list(zip(*cells[1:], strict=True))
    widths = [max(map(len, column)) for column in zip(*cells, strict=True)]
    right = [bool(column) and all(_is_number(text) for text in column) for column in values] or [False] * len(head)
    lines = (
        "  ".join(f"{text:>{w}}" if r else f"{text:<{w}}" for text, w, r in zip(row, widths, right, strict=True))
        for row in cells
    )
    return "\n".join(line.rstrip() for line in lines)


def _text(value: object) -> str:
    return "" if value is None else f"{value:.4g}" if isinstance(value, float) else str(value)


def _is_number(text: str) -> bool:
    try:
        float(text or 0)
    except ValueError:
        return False
    return True
