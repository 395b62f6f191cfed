"""Logging for scripts."""

from __future__ import annotations

import logging
import os
import sys
from collections.abc import Callable

from pydart2.utils import colored_text

_FORMAT = "%(asctime)s [%(levelname)s] %(name)s: %(message)s"
_COLORS: dict[int, Callable[[str], str]] = {
    logging.DEBUG: colored_text.cyan,
    logging.INFO: colored_text.green,
    logging.WARNING: colored_text.yello,
    logging.ERROR: colored_text.red,
    logging.CRITICAL: colored_text.bright_red,
}
_installed: list[logging.Handler] = []


class _ColoredFormatter(logging.Formatter):
    def format(self, record: logging.LogRecord) -> str:
        plain = record.levelname
        record.levelname = _COLORS.get(record.levelno, str)(plain)
        try:
            return super().format(record)
        finally:
            record.levelname = plain  # other handlers get the same record


def setup(filename: str | os.PathLike[str] | None = None) -> None:
    """Let the root logger write everything from DEBUG on to stdout, with coloured level names.

    Parameters
    ----------
    filename
        Also write to this file, without colours; what it held is lost.

    A second call replaces what the first one set up.
    """
    handlers: list[logging.Handler] = [logging.StreamHandler(sys.stdout)]
    handlers[0].setFormatter(_ColoredFormatter(_FORMAT))
    if filename is not None:
        handlers.append(logging.FileHandler(filename, mode="w+", encoding="utf-8"))
        handlers[1].setFormatter(logging.Formatter(_FORMAT))
    root = logging.getLogger()
    for old in _installed:
        root.removeHandler(old)
        old.close()
    for new in handlers:
        root.addHandler(new)
    _installed[:] = handlers
    root.setLevel(logging.DEBUG)
