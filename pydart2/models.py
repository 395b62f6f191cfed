"""Robots of installed packages, by name.

>>> world.add_skeleton(pydart2.models.find("ur5e"))

Packages with models are installed as others are, ``pip install airo-models example-robot-data``; nothing is downloaded
here. Their ``package://`` URIs are found in the same way.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from functools import cache
from importlib.metadata import distributions
from pathlib import Path

from pydart2.errors import NameNotFound
from pydart2.resources import data_files, data_path

_SUFFIXES = (".urdf", ".sdf", ".skel", ".xml")
_FILE = re.compile(r'^"?([^"\n]*\.(?:urdf|sdf|skel|xml))"?,', re.MULTILINE)  # in a wheel's RECORD
_ENDINGS = re.compile(r"_(robot|description)$")
_PACKAGES = "pip install airo-models example-robot-data"


def find(name: str) -> str:
    """The path of a model of an installed package, or of this one: by the file's name, without its suffix.

    Case does not matter, nor ``_robot`` or ``_description`` at the end. Of several of a name, folders above it say
    which, as in ``find("anymal_c_simple_description/anymal")``.

    Raises
    ------
    NameNotFound
        If there is none.
    ValueError
        If there are several; says which.
    """
    *folders, stem = name.lower().split("/")
    stem = next((stem.removesuffix(suffix) for suffix in _SUFFIXES if stem.endswith(suffix)), stem)
    models = [path for path in _models() if _is_below(path, folders)]
    found = [path for path in models if path.stem.lower() == stem]
    found = found or [path for path in models if _ENDINGS.sub("", path.stem.lower()) == _ENDINGS.sub("", stem)]
    found = [path for path in found if _is_model(path)]
    if not found:
        known = {path.stem for path in _models()}
        raise NameNotFound("model", name, f"the {len(known)} of installed packages ({_PACKAGES} brings more)", known)
    if len(found) > 1:
        raise ValueError(f"there are {len(found)} models {name!r}; say which: {', '.join(_distinct_names(found))}")
    return str(found[0])


def names() -> list[str]:
    """The names of the models of installed packages and of this one, as find() takes them, sorted."""
    return sorted({path.stem for path in _models() if _is_model(path)})


def package_folders(name: str) -> Iterator[str]:
    """The folders of installed packages that have a model below them and are called `name`."""
    yield from dict.fromkeys(str(above) for path in _models() for above in path.parents if above.name == name)


@cache
def _models() -> tuple[Path, ...]:
    """Files that may be models, in the order in which Python finds their packages; this one's come last."""
    files: dict[Path, None] = {}
    for package in distributions():
        for file in _FILE.findall(package.read_text("RECORD") or ""):
            files[Path(os.path.abspath(str(package.locate_file(file))))] = None
    own = (Path(data_path(file)) for file in data_files() if file.endswith(_SUFFIXES))
    return (*files, *own)


def _is_below(path: Path, folders: list[str]) -> bool:
    """Whether the folders are above it, in their order."""
    above = iter(part.lower() for part in path.parts[:-1])
    return all(folder in above for folder in folders)


def _distinct_names(paths: list[Path]) -> Iterator[str]:
    """Each with a folder that is above it and not above the others."""
    for path in paths:
        others = {part.lower() for other in paths if other != path for part in other.parts[:-1]}
        own = next((part for part in reversed(path.parts[:-1]) if part.lower() not in others), path.parent.name)
        yield repr(f"{own}/{path.stem}")


def _is_model(path: Path) -> bool:
    """Whether it is there, and is MJCF if it is .xml, which much else is."""
    if path.suffix != ".xml":
        return path.is_file()
    try:
        with open(path, "rb") as file:
            return b"<mujoco" in file.read(4096)
    except OSError:
        return False
