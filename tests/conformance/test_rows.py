"""Every row of the promised API has a check or a reason for having none, and every check a row."""

from __future__ import annotations

import importlib
from pathlib import Path

import pytest

from .differences import DIFFERENCES
from .open_rows import DRAWING, LEFT_OUT
from .table import CHECKS, ROWS


@pytest.fixture(autouse=True, scope="module")
def all_checks() -> None:
    for path in Path(__file__).parent.glob("test_*.py"):
        importlib.import_module(f"{__package__}.{path.stem}")


def test_rows_are_unique() -> None:
    assert len(set(ROWS)) == len(ROWS) > 900


def test_every_row_has_a_check() -> None:
    assert [row for row in ROWS if row not in CHECKS and row not in DRAWING | LEFT_OUT] == []


def test_every_check_has_a_row() -> None:
    assert [row for row in CHECKS if row not in ROWS] == []


def test_open_rows_are_rows_without_a_check() -> None:
    assert [row for row in (*DRAWING, *LEFT_OUT) if row not in ROWS or row in CHECKS] == []


def test_drawing_is_checked_by_tests_of_pictures() -> None:
    for test in DRAWING.values():
        module, _, name = test.rpartition(".")
        assert hasattr(importlib.import_module(module), name), test


def test_differences_are_of_checked_rows() -> None:
    assert [row for row in DIFFERENCES if row not in CHECKS] == []


def test_reasons_are_given() -> None:
    assert [row for row, reason in (LEFT_OUT | DIFFERENCES).items() if len(reason.split()) < 2] == []
