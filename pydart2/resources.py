"""The models that come with the package, and how a model's path is found."""

from __future__ import annotations

import logging
import os
from pathlib import Path

from pydart2.errors import LoadError

_log = logging.getLogger("pydart2")
_package = Path(__file__).resolve().parent


def data_folder() -> Path:
    """Where the models are: inside the installed package, or beside it in a checkout."""
    installed = _package / "data"
    return installed if installed.is_dir() else _package.parent / "data"


def examples_folder() -> Path:
    """Where the examples are: inside the installed package, or beside it in a checkout."""
    installed = _package / "examples"
    return installed if installed.is_dir() else _package.parent / "examples"


def data_path(name: str) -> str:
    """The path of a model of the package.

    >>> pydart2.data_path("skel/cubes.skel")

    Raises LoadError if there is no such file.
    """
    path = data_folder() / name
    if not os.path.isfile(path):  # Path.is_file() raises for a name that is too long
        raise LoadError(f"no file {name!r} among the models of pydart2 ({data_folder()}); see pydart2.data_files()")
    return str(path)


def data_files() -> list[str]:
    """The names that data_path() takes, sorted."""
    folder = data_folder()
    return sorted(str(path.relative_to(folder)) for path in folder.rglob("*") if path.is_file())


def find_model(path: str | os.PathLike[str]) -> str:
    """The absolute path of a model file: from the current folder, else among the package's own models.

    A leading ``./`` and ``data/`` are left out for the second, so that the documentation's
    ``./data/skel/cubes.skel`` works from any folder. Raises LoadError if it is in neither.
    """
    name = os.fspath(path)
    if os.path.exists(name):
        return os.path.realpath(name)
    fallback = data_folder() / Path(*_without_data(Path(name).parts))
    if os.path.isabs(name) or not os.path.isfile(fallback):
        raise LoadError(f"no file {name!r}, neither in {os.getcwd()} nor among the models of pydart2")
    _log.info("no file %r in the current folder; using %s", name, fallback)
    return str(fallback)


def _without_data(parts: tuple[str, ...]) -> tuple[str, ...]:
    return parts[1:] if parts[:1] == ("data",) else parts
