"""What the engine prints comes through Python's logging.

>>> logging.getLogger("pydart2.engine").setLevel(logging.ERROR)  # only its errors

DART writes to standard output and standard error. What it writes during a call of this package, in the thread of the
call, goes to the logger ``pydart2.engine`` instead; what other libraries write is left alone. Of a message that
repeats, the first ten are logged, then the 100th, the 1000th and so on, with their number; init() starts the count
again. After ``set_verbose(False)`` only errors are logged.
"""

from __future__ import annotations

import logging

_engine = logging.getLogger("pydart2.engine")


def log(level: int, text: str) -> None:
    """Log one message of the engine; the extension calls it at the end of the call that made it print."""
    from pydart2.manager import verbose

    if verbose() or level >= logging.ERROR:
        _engine.log(level, "%s", text)
