"""MuJoCo's compiler: a file or text to a compiled model, with its errors and warnings as ours."""

from __future__ import annotations

import hashlib
import logging
import os
import subprocess
import sys
from typing import Any

from pydart2.errors import LoadError

_log = logging.getLogger("pydart2")

#: The compiled model and the module that made it; MuJoCo has no types of its own.
Compiled = Any


def mujoco_module() -> Any:
    """The module; LoadError that says what to install if it is not there."""
    try:
        import mujoco
    except ImportError as error:
        raise LoadError(
            "MJCF files are compiled by MuJoCo, which is not installed: pip install 'pydart2[mjcf]'; "
            "or load with reader='engine', whose numbers differ"
        ) from error
    return mujoco


_TRIAL = """
import sys, mujoco
path, text = sys.argv[1], sys.stdin.buffer.read()
mujoco.set_mju_user_warning(lambda warning: None)
try:
    mujoco.MjModel.from_xml_path(path) if path else mujoco.MjModel.from_xml_string(text.decode("utf-8", "replace"))
except ValueError:
    pass
"""
_known_to_work: set[bytes] = set()


def try_to_compile(path: str | None, text: bytes, seconds: float) -> None:
    """Compile in a process of its own; LoadError if that ends it or takes longer; what worked is not tried again."""
    mujoco_module()
    key = hashlib.sha256(repr(path).encode() + text).digest()
    if key in _known_to_work:
        return
    # close_fds=False lets subprocess use posix_spawn: this process is not forked.
    command = [sys.executable, "-c", _TRIAL, path or ""]
    try:
        done = subprocess.run(command, input=text, capture_output=True, timeout=seconds, close_fds=False)
    except subprocess.TimeoutExpired:
        raise LoadError.at(
            path, None, f"MuJoCo does not finish it in {seconds:.3g} s; load_seconds= waits longer"
        ) from None
    if done.returncode != 0:
        said = done.stderr.decode("utf-8", "replace").strip().splitlines()
        raise LoadError.at(path, None, f"MuJoCo's compiler ends its process: {said[-1] if said else done.returncode}")
    _known_to_work.add(key)


def compile_model(path: str | None, text: bytes) -> Compiled:
    """The compiled model of a file, or of a text without one; LoadError with the compiler's words."""
    mujoco = mujoco_module()
    warnings: list[str] = []
    before = mujoco.get_mju_user_warning()
    mujoco.set_mju_user_warning(warnings.append)  # or it would write a log file
    try:
        if path is None:
            return mujoco.MjModel.from_xml_string(text.decode("utf-8", "replace"))
        return mujoco.MjModel.from_xml_path(os.fspath(path))
    except ValueError as error:
        raise LoadError.at(path, None, f"MuJoCo says: {error}") from None
    finally:
        mujoco.set_mju_user_warning(before)
        for warning in warnings:
            _log.warning("%s: MuJoCo says: %s", path or "XML text", warning)
