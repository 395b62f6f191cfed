"""What closes a window besides hands: Ctrl+C, and a time that the environment gives."""

from __future__ import annotations

import os
import signal
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType


def seconds_to_show() -> float | None:
    """PYDART2_VIEWER_SECONDS, after which windows close by themselves; None if they do not."""
    seconds = os.environ.get("PYDART2_VIEWER_SECONDS")
    return float(seconds) if seconds else None


@contextmanager
def interrupt_calls(close: Callable[[], object]) -> Iterator[None]:
    """Within it Ctrl+C calls `close`; in a thread other than the main one it stays as it is."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return

    def handler(_signal: int, _frame: FrameType | None) -> None:
        close()

    before = signal.signal(signal.SIGINT, handler)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)
