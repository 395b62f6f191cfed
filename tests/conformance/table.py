"""The rows of the promised API, and which test checks which."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, TypeVar

import pytest

Test = TypeVar("Test", bound=Callable[..., Any])

ROWS: list[str] = [
    row
    for rows in json.loads(Path(__file__).with_name("rows.json").read_text(encoding="utf-8")).values()
    for row in rows
]

#: Row → the test that checks it.
CHECKS: dict[str, str] = {}


def row(*names: str) -> Callable[[Test], Test]:
    """Say that a test checks these rows."""

    def mark(test: Test) -> Test:
        for name in names:
            if name in CHECKS:
                raise ValueError(f"row {name} is checked by {CHECKS[name]} and {test.__name__}")
            CHECKS[name] = test.__name__
        return test

    return mark


def rows(prefix: str, cases: Mapping[str, Any]) -> Callable[[Test], Any]:
    """Say that a test with an argument ``case`` checks the rows ``prefix + key``, each with its case."""

    def mark(test: Test) -> Any:
        row(*(prefix + key for key in cases))(test)
        return pytest.mark.parametrize("case", list(cases.values()), ids=list(cases))(test)

    return mark
