"""Models that others made: what the engine alone makes of each, and what we make of it.

python tests/models/third_party.py FOLDER    prints a table of outcomes, and every refusal with its reason
"""

from __future__ import annotations

import collections
import functools
import re
import subprocess
import sys
import time
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

import pydart2
from oracle import cpp_oracle
from oracle.wire import decode
from pydart2.loading.files import package_folders

SUFFIXES = (".urdf", ".sdf", ".skel", ".xml", ".world", ".vsk", ".mjcf", ".model")
ROOTS = ("robot", "world", "sdf", "skel", "mujoco", "KinematicModel")
_ROOT = re.compile(r"<([A-Za-z_][\w.-]*)[\s/>]")


@dataclass
class Outcome:
    """A file; what the engine makes of it in a process of its own; what we make of it here."""

    path: Path
    engine: list[Any] | None
    ours: list[tuple[int, Any, Any]] | None
    reason: str
    seconds: float

    @property
    def kind(self) -> str:
        if self.engine is None:
            return "both refuse" if self.ours is None else "only we load"
        return "only the engine loads" if self.ours is None else "both load"


def model_files(folder: Path) -> list[Path]:
    """The files in a folder that may be models, by suffix and root element."""
    files = sorted(path for path in folder.rglob("*") if path.suffix in SUFFIXES and path.is_file())
    return [path for path in files if root_of(path) in ROOTS]


def root_of(path: Path) -> str:
    """The first element of an XML file."""
    text = re.sub(r"<!--.*?-->|<\?.*?\?>|<!DOCTYPE.*?>", "", path.read_text(errors="replace"), flags=re.DOTALL)
    found = _ROOT.search(text)
    return found[1] if found else ""


def packages_of(path: Path) -> dict[str, str]:
    """The packages that a file names, where they can be found above it."""
    names = set(re.findall(r"package://([^/\"'<]+)/", path.read_text(errors="replace")))
    found = {name: next(package_folders(name, str(path.parent), {}), None) for name in names}
    return {name: folder for name, folder in found.items() if folder is not None}


@functools.cache
def engine_program() -> Path:
    """The program that loads with DART alone, built when needed."""
    return cpp_oracle.build(cpp_oracle.BUILD).with_name("engine_load")


def engine_load(path: Path) -> list[Any] | None:
    """Dofs, q and M of each skeleton, as DART alone loads it in a process of its own; None if it cannot."""
    packages = [f"{name}={folder}" for name, folder in packages_of(path).items()]
    command = [str(engine_program()), root_of(path), str(path.resolve()), *packages]
    try:
        done = subprocess.run(command, capture_output=True, timeout=60)
    except subprocess.TimeoutExpired:
        return None
    result: list[Any] | None = (
        decode(done.stdout.decode(errors="replace").splitlines()[-1]) if not done.returncode else None
    )
    return result


def our_load(path: Path, **options: Any) -> list[tuple[int, Any, Any]]:
    """Dofs, q and M of each skeleton, loaded here."""
    world = pydart2.World(0.001, path, reader="engine", engine_defaults=True, **options)
    world.step()  # whatever loads can be simulated
    world.reset()
    return [(skel.ndofs, np.array(skel.q), skel.M) for skel in world.skeletons]


def outcome(path: Path) -> Outcome:
    """Load a file in both ways; a collision mesh that is missing is left out."""
    start = time.monotonic()
    ours, reason = None, ""
    try:
        ours = our_load(path, missing_meshes="warn")
    except pydart2.LoadError as error:
        reason = str(error)
    except pydart2.SimulationError as error:
        ours, reason = [], str(error)
    seconds = time.monotonic() - start
    return Outcome(path, engine_load(path), ours, reason, seconds)


def outcomes(folder: Path) -> Iterator[Outcome]:
    """The outcome of each model in a folder."""
    return map(outcome, model_files(folder))


def differences(result: Outcome) -> list[str]:
    """Where the engine's and our dofs, q and M differ, to rounding."""
    if result.engine is None or result.ours is None:
        return []
    if len(result.engine) != len(result.ours):
        return [f"{len(result.engine)} skeletons, here {len(result.ours)}"]
    found = []
    for i, (theirs, (dofs, q, M)) in enumerate(zip(result.engine, result.ours)):
        if theirs["dofs"] != dofs:
            found.append(f"skeleton {i}: {theirs['dofs']} dofs, here {dofs}")
        elif not np.array_equal(theirs["q"], q):
            found.append(f"skeleton {i}: q {theirs['q']}, here {q}")
        elif not np.allclose(theirs["M"].reshape(M.shape), M, rtol=1e-12, atol=1e-12 * np.abs(M).max(initial=0)):
            found.append(f"skeleton {i}: M differs by {np.abs(theirs['M'].reshape(M.shape) - M).max()}")
    return found


def report(folder: Path, results: list[Outcome]) -> str:
    """Counts, and each refusal with its reason."""
    counts = collections.Counter(result.kind for result in results)
    lines = [f"{folder}: {len(results)} models; " + ", ".join(f"{n} {kind}" for kind, n in sorted(counts.items()))]
    lines += [f"  refused: {r.reason}" for r in results if r.ours is None]
    lines += [f"  DIFFERS: {r.path}: {difference}" for r in results for difference in differences(r)]
    lines += [f"  ONLY THE ENGINE: {r.path}" for r in results if r.kind == "only the engine loads"]
    slowest = max(results, key=lambda r: r.seconds, default=None)
    return "\n".join([*lines, f"  slowest: {slowest.path} {slowest.seconds:.1f} s"] if slowest else lines)


if __name__ == "__main__":
    for name in sys.argv[1:]:
        print(report(Path(name), list(outcomes(Path(name)))))
