"""The C++ half of the oracle: built once with CMake, asked by subcommand."""

from __future__ import annotations

import fcntl
import os
import shutil
import subprocess
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from .wire import OracleError, OracleMissing, decode

SOURCE = Path(__file__).parent
BUILD = SOURCE.parents[1] / "build" / "oracle"


class CppOracle:
    """The program of ``oracle.cpp``: markers, soft bodies, VSK files, collision filters and mimic joints.

    Parameters
    ----------
    build
        Folder to build in. CMake compiles only what changed since the last time.
    """

    def __init__(self, build: str | Path = BUILD) -> None:
        self._build = Path(build)
        self._program: Path | None = None

    def ask(
        self,
        question: str,
        model: str | Path,
        *arguments: object,
        skeleton_states: Sequence[tuple[ArrayLike, ArrayLike]] | None = None,
    ) -> Any:
        """Return the answer to one subcommand of ``oracle.cpp`` (its `usage` lists them) with NumPy arrays.

        Parameters
        ----------
        question, model, arguments
            As on the program's command line, for instance ``ask("soft", path, 100)``.
        skeleton_states
            (q, dq) of every skeleton of the world in order; None for the state that the file gives.
        """
        if self._program is None:
            self._program = build(self._build)
        # repr of a float is the shortest decimal that reads back as the same double.
        numbers = [repr(float(x)) for state in skeleton_states or () for vector in state for x in np.ravel(vector)]
        done = subprocess.run(
            [self._program, question, os.path.abspath(model), *map(str, arguments)],
            input=" ".join(numbers),
            capture_output=True,
            text=True,
        )
        if done.returncode != 0:
            raise OracleError(
                f"oracle {question} {model} ended with status {done.returncode} (negative: a signal).\n"
                f"{done.stderr[-4000:]}"
            )
        return decode(done.stdout.splitlines()[-1])


def build(folder: Path) -> Path:
    """Build the program in `folder` if it is not up to date and return its path."""
    if shutil.which("cmake") is None:
        raise OracleMissing("the C++ oracle needs cmake: apt-get install cmake g++ libdart-all-dev")
    folder.mkdir(parents=True, exist_ok=True)
    with (folder / "lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)  # several test processes may start at once
        if not (folder / "Makefile").exists():
            _run("cmake", "-G", "Unix Makefiles", "-S", str(SOURCE), "-B", str(folder))
        _run("cmake", "--build", str(folder))
    return folder / "oracle"


def _run(*command: str) -> None:
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        raise OracleError(
            f"{' '.join(command)} failed; the C++ oracle needs: apt-get install cmake g++ libdart-all-dev\n"
            f"{done.stdout[-2000:]}{done.stderr[-4000:]}"
        )
