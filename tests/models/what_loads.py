"""Writes the page of what loads: python tests/models/what_loads.py FOLDER >docs/what-loads.md

FOLDER is where tools/fetch_models.py has put pybullet's models; example-robot-data and airo-models are installed.
"""

from __future__ import annotations

import importlib.util
import logging
import sys
from dataclasses import dataclass, field
from pathlib import Path

import pydart2

HEAD = """# What loads

URDF and SDF files that others wrote, each in a world of its own, with a warning where a collision mesh is missing.
`make test-third-party` fetches the files and writes this page. [Models](howto/models.md) says what is mended in a file.

| collection | files | load |
|---|---|---|"""
MIDDLE = """
A file that does not load is one that has an error or is of another kind. What Pinocchio, another reader, makes of it:

| file | line | reason | Pinocchio |
|---|---|---|---|"""
TAIL = """
Every URDF file of the first two that Pinocchio reads and that moves has the same `M`, `c`, poses and Jacobians there
and here (`massless=True`), with a floating and with a fixed base, to 1e-12 of the largest entry."""


@dataclass
class Collection:
    """Files of one package, and what was refused: file, line, reason, Pinocchio's word."""

    name: str
    files: int = 0
    refused: list[tuple[str, int, str, str]] = field(default_factory=list)


def files_in(folder: Path) -> list[Path]:
    """Its URDF and SDF files; of pybullet's thousand random bodies every fiftieth."""
    files = sorted(path for path in folder.rglob("*") if path.suffix in (".urdf", ".sdf") and path.is_file())
    random = [path for path in files if "random_urdfs" in path.parts]
    return [path for path in files if path not in set(random)] + random[::50]


def pinocchios_word(path: Path) -> str:
    """What Pinocchio says to a URDF file."""
    import pinocchio

    try:
        return f"loads, {pinocchio.buildModelFromUrdf(str(path)).nv} dofs"
    except ValueError as error:
        return f"refuses: {str(error).replace(str(path), path.name).splitlines()[0]}"


def collection(name: str, folder: Path) -> Collection:
    """Load all files of a folder."""
    found = Collection(name)
    for path in files_in(folder):
        found.files += 1
        try:
            pydart2.World(0.001, path, missing_meshes="warn")
        except pydart2.LoadError as error:
            where = f"{name}: {path.relative_to(folder)}"
            found.refused.append((where, error.line or 0, error.reason, pinocchios_word(path)))
    return found


def page(collections: list[Collection]) -> str:
    """The page."""
    counts = [f"| {c.name} | {c.files} | {c.files - len(c.refused)} |" for c in collections]
    rows = [
        f"| {where} | {line} | {reason.replace('<', '&lt;')} | {word} |"
        for c in collections
        for where, line, reason, word in c.refused
    ]
    return "\n".join([HEAD, *counts, MIDDLE, *rows, TAIL])


def folder_of(module: str) -> Path:
    """Where a package is installed."""
    found = importlib.util.find_spec(module)
    assert found and found.origin, f"{module} is not installed"
    return Path(found.origin).parent


if __name__ == "__main__":
    logging.disable(logging.WARNING)
    robots = folder_of("pinocchio").parents[3] / "share" / "example-robot-data"
    print(
        page(
            [
                collection("example-robot-data", robots),
                collection("airo-models", folder_of("airo_models")),
                collection("pybullet", Path(sys.argv[1]) / "pybullet_data"),
            ]
        )
    )
