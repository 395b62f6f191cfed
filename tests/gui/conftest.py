"""Fixtures of the tests of pictures; they run without a display."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from pydart2.gui import OffscreenRenderer


@pytest.fixture(scope="session")
def renderer() -> Iterator[OffscreenRenderer]:
    """One for all, 240 by 180."""
    made = OffscreenRenderer(240, 180)
    yield made
    made.close()
