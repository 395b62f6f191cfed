"""The JSON that the oracles speak: one message a line, every double bit-exact.

Python's ``json`` writes the shortest decimal that reads back as the same double and spells the rest ``NaN``,
``Infinity`` and ``-Infinity``; the C++ program prints 17 significant digits and the same three words. An
array is ``{"dtype": "float64", "shape": [rows, columns], "values": [...]}``, values in row-major order, so
that empty arrays keep their shape.
"""

from __future__ import annotations

import json
from typing import Any

import numpy as np


class OracleError(RuntimeError):
    """An oracle could not answer; the message holds what the engine printed."""


class OracleMissing(OracleError):
    """Something the oracle stands on is not installed; the message says what to install."""


def encode(message: Any) -> str:
    """Return `message` as one line of JSON; arrays are written as nested lists."""
    return json.dumps(message, default=lambda value: np.asarray(value).tolist())


def decode(text: str) -> Any:
    """Return the message in `text`, arrays as ``numpy.ndarray``."""
    return json.loads(text, object_hook=_array)


def _array(item: dict[str, Any]) -> Any:
    if item.keys() == {"dtype", "shape", "values"}:
        return np.array(item["values"], dtype=item["dtype"]).reshape(item["shape"])
    return item
