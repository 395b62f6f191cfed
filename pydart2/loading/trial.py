"""Tries a model in a small helper process, where a crash of the engine's parsers does no harm."""

from __future__ import annotations

import contextlib
import hashlib
import math
import os
import re
import select
import signal
import time
from collections.abc import Iterable, Iterator
from pathlib import Path

from pydart2._native import ModelSource
from pydart2.errors import PydartError

HELPER = Path(__file__).resolve().parent.parent / "_try_load"
SECONDS = 5.0  # of processor time, and one more for each megabyte
BYTES = 4e9  # of memory, and a hundred more for each byte of the files
MOST_IDLE = 2
_ASSERTION = re.compile(r"(?:.*/)?([^/\s]+\.\w+:\d+): .*Assertion `(.*)' failed")

_took: dict[bytes, float] = {}  # s by the clock, of what worked


def seconds_for(source: ModelSource, files: Iterable[str]) -> float:
    """How long a model may take that names these files, in its trial and again when it is read, s of processor time."""
    return SECONDS + (len(source.packed()) + _stamp(files)[0]) / 1e6


def try_model(source: ModelSource, world: bool, files: Iterable[str], seconds: float) -> tuple[str | None, float]:
    """Why a model cannot be loaded or simulated, None if it can, and how long it took to see, s by the clock.

    `files` are those that it names. A model that worked is not tried again in this process unless it or one of its
    files has changed.
    """
    packed = source.packed().encode()
    sizes, stamp = _stamp(files)
    key = hashlib.sha256(packed + stamp + bytes([world])).digest()
    return _try(key, b"world " * world + b"skeleton " * (not world) + packed, seconds, 100 * (len(packed) + sizes))


def try_mjcf(libraries: Iterable[str], path: str | None, text: bytes, seconds: float) -> str | None:
    """Why MuJoCo's compiler does not end by itself, None if it does, if only to refuse the model.

    `libraries` are the paths of MuJoCo's, then of its plugins. What worked is not tried again in this process.
    """
    key = hashlib.sha256(repr(path).encode() + text).digest()
    head = "\n".join(["mjcf", *libraries, "", path or "", ""])
    return _try(key, head.encode() + text, seconds, 100 * len(text), "MuJoCo")[0]


def _try(
    key: bytes, request: bytes, seconds: float, memory: float, who: str = "the engine"
) -> tuple[str | None, float]:
    """Asks a helper, unless what has this key is known to work."""
    if key in _took:
        return None, _took[key]
    start = time.monotonic()
    reason = _run(request, seconds, BYTES + memory, who)
    took = time.monotonic() - start
    if reason is None:
        _took[key] = took
    return reason, took


def _stamp(files: Iterable[str]) -> tuple[int, bytes]:
    """The sizes of files, added up, and what changes when one of them does."""
    states = [(name, os.stat(name)) for name in sorted(set(files))]
    stamp = [(name, state.st_size, state.st_mtime_ns) for name, state in states]
    return sum(state.st_size for _, state in states), repr(stamp).encode()


class _Helper:
    """A process that tries one model after another, each in a process of its own (src/try_load/main.cpp).

    It ends when this one does, and is no child of it, so that who waits for all children does not wait for it.
    """

    def __init__(self) -> None:
        self.path = str(HELPER)
        self._is_ready = True
        theirs_in, self.requests = os.pipe()
        self.answers, theirs_out = os.pipe()
        actions = [
            (os.POSIX_SPAWN_DUP2, theirs_in, 0),
            (os.POSIX_SPAWN_DUP2, theirs_out, 1),
            (os.POSIX_SPAWN_OPEN, 2, os.devnull, os.O_WRONLY, 0),
        ]
        try:
            self.group = os.posix_spawn(self.path, [self.path], os.environ, file_actions=actions, setpgroup=0)
        except BaseException:
            self.close()
            raise
        finally:
            os.close(theirs_in)
            os.close(theirs_out)
        self._is_ready = False

    def ask(self, request: bytes, seconds: float, memory: float) -> tuple[int, str, str]:
        """Exit code, or minus a signal's number; what was said; what was complained of.

        EOFError if the helper is gone, TimeoutError if the trial takes ten times the processor time that it has.
        """
        self.wait_for_first()
        deadline = time.monotonic() + 10.0 * seconds
        left = memoryview(f"{math.ceil(seconds)} {memory:.0f} {len(request)}\n".encode() + request)
        try:
            while left:
                left = left[os.write(self.requests, left) :]
        except BrokenPipeError:
            raise EOFError from None
        got = b""
        while b"\n" not in got:
            got += self._read(deadline)
        head, _, texts = got.partition(b"\n")
        code, *sizes = map(int, head.split())
        while len(texts) < sum(sizes):
            texts += self._read(deadline)
        return code, texts[: sizes[0]].decode("utf-8", "replace"), texts[sizes[0] :].decode("utf-8", "replace")

    def wait_for_first(self) -> None:
        """The process that was started here ends when it has made the one that stays."""
        if not self._is_ready:
            with contextlib.suppress(ChildProcessError):  # another waited for it
                os.waitpid(self.group, 0)
        self._is_ready = True

    def _read(self, deadline: float) -> bytes:
        poll = select.poll()
        poll.register(self.answers, select.POLLIN)
        if not poll.poll(max(0.0, deadline - time.monotonic()) * 1000.0):
            raise TimeoutError
        data = os.read(self.answers, 1 << 16)
        if not data:
            raise EOFError
        return data

    def close(self) -> None:
        """Let it end, when it has answered."""
        self.wait_for_first()
        os.close(self.requests)
        os.close(self.answers)

    def kill(self) -> None:
        """End it, and a trial that it has under way."""
        with contextlib.suppress(ProcessLookupError):
            os.killpg(self.group, signal.SIGKILL)
        self.close()


_idle: list[_Helper] = []


def _forget_helpers() -> None:
    """In a forked process: they are its parent's."""
    while _idle:
        _idle.pop().close()


os.register_at_fork(after_in_child=_forget_helpers)


def _helper() -> _Helper:
    """One that has nothing to do, else a new one."""
    while _idle:
        helper = _idle.pop()
        if helper.path == str(HELPER):
            return helper
        helper.close()
    try:
        return _Helper()
    except OSError as error:
        raise PydartError(f"cannot run {HELPER}: {error}; reinstall pydart2, or load with safe=False") from error


@contextlib.contextmanager
def getting_ready() -> Iterator[None]:
    """Start a helper if none waits, which takes a while, beside what is done here."""
    if not _idle:
        with contextlib.suppress(PydartError):  # is told when it is needed
            _idle.append(_helper())
    try:
        yield
    finally:
        for helper in _idle:
            helper.wait_for_first()


def _run(request: bytes, seconds: float, memory: float, who: str) -> str | None:
    for _ in range(2 + MOST_IDLE):  # somebody may have ended those that wait
        helper = _helper()
        try:
            code, said, complained = helper.ask(request, seconds, memory)
        except EOFError:
            helper.close()
            continue
        except TimeoutError:
            helper.kill()
            return f"{who} does not finish it in {10 * seconds:.3g} s; load_seconds= waits longer"
        except BaseException:
            helper.kill()
            raise
        if len(_idle) < MOST_IDLE:
            _idle.append(helper)
        else:
            helper.close()
        if code < 0:
            return _crash(-code, complained, seconds, who)
        return (said or f"the helper ended with code {code}") if code > 0 else None
    raise PydartError(f"{HELPER} ends at once; reinstall pydart2, or load with safe=False")


def _crash(number: int, said: str, seconds: float, who: str) -> str:
    """What a signal means."""
    if number in (signal.SIGXCPU, signal.SIGKILL):
        return f"{who} does not finish it in {seconds:.3g} s of processor time; load_seconds= waits longer"
    assertion = _ASSERTION.search(said)
    if assertion:
        return f"{who} would abort: it needs {assertion[2]} ({assertion[1]})"
    return f"{who} would crash ({signal.Signals(number).name})"
