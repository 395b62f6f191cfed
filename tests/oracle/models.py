"""The models of Debian's ``dart-doc`` package, unpacked."""

from __future__ import annotations

import functools
import gzip
import shutil
import tempfile
from pathlib import Path

from .wire import OracleMissing

DART_DOC_DATA = Path("/usr/share/doc/dart/data")
_HOW = (
    "apt-get install dart-doc (where dpkg drops documentation, as in minimal images, first remove the "
    "path-exclude of /usr/share/doc from /etc/dpkg/dpkg.cfg.d, then apt-get install --reinstall dart-doc)"
)


def dart_model(name: str) -> Path:
    """Return the path of a model of DART's own collection, such as ``"skel/fullbody1.skel"``.

    The file lies in a temporary copy of the whole collection, with its meshes beside it and the files
    unpacked that Debian compressed. The copy lasts until the process ends; do not write to it.
    """
    path = dart_data() / name
    if not path.is_file():
        raise OracleMissing(f"no model {name!r} in {DART_DOC_DATA}: {_HOW}")
    return path


@functools.cache
def dart_data() -> Path:
    """Return the folder of the unpacked collection."""
    if not DART_DOC_DATA.is_dir():
        raise OracleMissing(f"no folder {DART_DOC_DATA}, which holds DART's own models: {_HOW}")
    folder = Path(_temporary_folder().name)
    for source in DART_DOC_DATA.rglob("*"):
        target = folder / source.relative_to(DART_DOC_DATA)
        if source.is_dir():
            target.mkdir(parents=True, exist_ok=True)
            continue
        target.parent.mkdir(parents=True, exist_ok=True)
        if source.suffix == ".gz":
            with gzip.open(source) as packed, target.with_suffix("").open("wb") as plain:
                shutil.copyfileobj(packed, plain)
        else:
            target.symlink_to(source)
    return folder


@functools.cache  # holds the only reference: the folder goes when the process ends
def _temporary_folder() -> tempfile.TemporaryDirectory[str]:
    return tempfile.TemporaryDirectory(prefix="dart-data-")
