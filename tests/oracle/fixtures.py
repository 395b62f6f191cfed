"""The oracles as pytest fixtures; a conftest imports them by name."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from .cpp_oracle import CppOracle
from .dartpy_oracle import DartpyOracle


@pytest.fixture(scope="session")
def oracle() -> Iterator[DartpyOracle]:
    """Debian's dartpy in one child process for the whole session."""
    with DartpyOracle() as running:
        yield running


@pytest.fixture(scope="session")
def cpp_oracle() -> CppOracle:
    """The C++ program, built at its first question."""
    return CppOracle()
