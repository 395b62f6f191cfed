"""Time of a call as CPU time of this thread: other programs on the machine are not counted. For every competitor."""

from __future__ import annotations

import time
from collections.abc import Callable


def per_call(call: Callable[[], object], seconds: float = 0.002, repeats: int = 5) -> float:
    """Seconds of one call, the least of several repeats."""
    call()
    count, taken = 1, 0.0
    while taken < seconds:
        count = max(2 * count, int(count * seconds / taken)) if taken else 2 * count
        begin = time.thread_time()
        for _ in range(count):
            call()
        taken = time.thread_time() - begin
    least = taken
    for _ in range(repeats - 1):
        begin = time.thread_time()
        for _ in range(count):
            call()
        least = min(least, time.thread_time() - begin)
    return least / count


def once(call: Callable[[], object], before: Callable[[], object], repeats: int = 3) -> float:
    """Seconds of one call with a preparation that is not counted, the least of several repeats."""
    least = float("inf")
    for _ in range(repeats):
        before()
        begin = time.thread_time()
        call()
        least = min(least, time.thread_time() - begin)
    return least
