"""Tries a model in a small helper process, where a crash of the engine's parsers does no harm."""

from __future__ import annotations

import hashlib
import os
import re
import signal
import subprocess
from collections.abc import Iterable
from pathlib import Path

from pydart2._native import ModelSource
from pydart2.errors import PydartError

HELPER = Path(__file__).resolve().parent.parent / "_try_load"
SECONDS = 5.0  # of processor time, and one more for each megabyte
BYTES = 4e9  # of memory, and a hundred more for each byte of the files
_ASSERTION = re.compile(r"(?:.*/)?([^/\s]+\.\w+:\d+): .*Assertion `(.*)' failed")

_known_to_work: set[bytes] = set()


def try_model(source: ModelSource, world: bool, files: Iterable[str]) -> str | None:
    """Why a model cannot be loaded or simulated, None if it can; `files` are those that it names.

    A model that worked is not tried again in this process unless it or one of its files has changed.
    """
    packed = source.packed().encode()
    sizes, stamp = _stamp(files)
    key = hashlib.sha256(packed + stamp + bytes([world])).digest()
    if key in _known_to_work:
        return None
    reason = _run(b"world " * world + b"skeleton " * (not world) + packed, len(packed) + sizes)
    if reason is None:
        _known_to_work.add(key)
    return reason


def _stamp(files: Iterable[str]) -> tuple[int, bytes]:
    """The sizes of files, added up, and what changes when one of them does."""
    states = [(name, os.stat(name)) for name in sorted(set(files))]
    stamp = [(name, state.st_size, state.st_mtime_ns) for name, state in states]
    return sum(state.st_size for _, state in states), repr(stamp).encode()


def _run(request: bytes, size: int) -> str | None:
    seconds = SECONDS + size / 1e6
    command = [str(HELPER), f"{seconds:.0f}", f"{BYTES + 100 * size:.0f}"]
    try:
        # close_fds=False lets subprocess use posix_spawn: this process is not forked.
        done = subprocess.run(command, input=request, capture_output=True, timeout=10 * seconds, close_fds=False)
    except OSError as error:
        raise PydartError(f"cannot run {HELPER}: {error}; reinstall pydart2, or load with safe=False") from error
    except subprocess.TimeoutExpired:
        return f"the engine does not finish it in {10 * seconds:.0f} s"
    if done.returncode == 0:
        return None
    if done.returncode > 0:
        return done.stdout.decode("utf-8", "replace") or f"the helper ended with code {done.returncode}"
    return _crash(-done.returncode, done.stderr.decode("utf-8", "replace"), seconds)


def _crash(number: int, said: str, seconds: float) -> str:
    """What a signal means."""
    if number in (signal.SIGXCPU, signal.SIGKILL):
        return f"the engine does not finish it in {seconds:.0f} s of processor time"
    assertion = _ASSERTION.search(said)
    if assertion:
        return f"the engine would abort: it needs {assertion[2]} ({assertion[1]})"
    return f"the engine would crash ({signal.Signals(number).name})"
