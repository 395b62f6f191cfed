"""MuJoCo's compiler: a file or text to a compiled model, with its errors and warnings as ours."""

from __future__ import annotations

import logging
import os
import re
from pathlib import Path
from typing import Any

from pydart2.errors import LoadError
from pydart2.loading.trial import try_mjcf

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


_LIBRARY = re.compile(r"/\S.*(?:/libmujoco[^/\s]*\.so[.\d]*|/mujoco/plugin/[^/\s]*\.so)$", re.MULTILINE)


def try_to_compile(path: str | None, text: bytes, seconds: float) -> None:
    """Compile in a process of its own; LoadError if that ends it or takes longer; what worked is not tried again."""
    mujoco_module()
    loaded = dict.fromkeys(_LIBRARY.findall(Path("/proc/self/maps").read_text()))
    libraries = sorted(loaded, key=lambda library: "/plugin/" in library)
    reason = try_mjcf(libraries, path, text, seconds)
    if reason is not None:
        raise LoadError.at(path, None, reason)


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
