"""Numbers as arguments; for anything else there is a sentence with the argument's name."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray


def number(value: Any, what: str) -> float:
    """The value as a number; TypeError if it is none."""
    try:
        return float(value)
    except (TypeError, ValueError):
        raise TypeError(f"{what} must be a number, got {value!r}") from None


def numbers(values: ArrayLike, what: str) -> NDArray[np.float64]:
    """The values as an array of any shape, in their unit, which need not be a copy; TypeError for other things."""
    try:
        return np.asarray(values, dtype=float)
    except (TypeError, ValueError):
        raise TypeError(f"{what} must be numbers, got {values!r}") from None
