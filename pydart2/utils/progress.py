"""Progress bars on long work."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TypeVar

T = TypeVar("T")


def progress(items: Iterable[T], text: str = "", unit: str = "step", total: int | None = None) -> Iterable[T]:
    """The same items with a bar on stderr: by tqdm if that is installed, and only on a terminal.

    >>> for _ in progress(range(4000), "biped_stand"):
    ...     world.step()
    """
    try:
        from tqdm import tqdm
    except ImportError:
        return items
    return tqdm(items, desc=text, unit=unit, total=total, disable=None)
