"""The programs of ``check.cpp`` and ``lcp.cpp``, built with CMake at their first use."""

from __future__ import annotations

import fcntl
import subprocess
import sys
from pathlib import Path
from typing import NamedTuple

from oracle.models import dart_data

SOURCE = Path(__file__).parent
ROOT = SOURCE.parents[1]
BUILD = ROOT / "build" / "solver"
CORE = ROOT / "build" / f"cmake-{sys.implementation.cache_tag}" / "libpydart2_core.a"

DETECTORS = ("dart", "fcl", "bullet", "ode")
VARIATIONS = ("plain", "joints", "surface", "joined", "pile")  # scenes.hpp


class Scene(NamedTuple):
    """One scene's outcome, as ``check.cpp`` describes it."""

    detector: str
    variation: str
    result: str
    steps: int
    contacts: int
    rows: int
    difference: float
    skeletons: int


def models(*suffixes: str) -> list[Path]:
    """All files of the package's data and of DART's own that may be models; skel_old/ is of a format of the past."""
    folders = (ROOT / "data", dart_data())
    files = (path for folder in folders for path in sorted(folder.rglob("*")))
    return [path for path in files if path.suffix in suffixes and "skel_old" not in path.parts]


def check(model: Path, steps: int, scenes: list[tuple[str, str]]) -> list[Scene]:
    """Compare the solvers in scenes of a model, given as (detector, variation)."""
    arguments = [word for scene in scenes for word in scene]
    done = subprocess.run(
        [build() / "check", str(steps), str(model), *arguments],
        capture_output=True,
        text=True,
        check=True,
        errors="replace",
    )
    return [_read(line) for line in done.stdout.splitlines()]


def compare_lcp(count: int) -> dict[str, int]:
    """How many random complementarity problems had which outcome, as ``lcp.cpp`` describes it."""
    words = subprocess.run([build() / "lcp", str(count)], capture_output=True, text=True, check=True).stdout.split()
    return dict(zip(words[::2], map(int, words[1::2])))


def _read(line: str) -> Scene:
    detector, variation, result, *numbers = line.split()
    steps, contacts, rows, difference, skeletons = (number.partition("=")[2] for number in numbers)
    return Scene(detector, variation, result, int(steps), int(contacts), int(rows), float(difference), int(skeletons))


def build(jobs: int = 2) -> Path:
    """Compile what has changed since the last time; returns the folder of the programs."""
    assert CORE.exists(), f"{CORE} is not there: pip install --no-build-isolation -e ."
    BUILD.mkdir(parents=True, exist_ok=True)
    with (BUILD / "lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)  # several test processes may start at once
        configure = ["cmake", "-S", str(SOURCE), "-B", str(BUILD), f"-DPYDART2_CORE={CORE}"]
        for command in (configure, ["cmake", "--build", str(BUILD), f"-j{jobs}"]):
            done = subprocess.run(command, capture_output=True, text=True)
            assert done.returncode == 0, f"{' '.join(command)} failed:\n{done.stdout[-2000:]}{done.stderr[-4000:]}"
    return BUILD
