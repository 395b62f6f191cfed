"""Where the files are that a model names: packages, URIs, meshes."""

from __future__ import annotations

import gzip
import os
import posixpath
import re
import zlib
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from urllib.parse import unquote

from pydart2.errors import LoadError
from pydart2.loading.xml import MAX_BYTES, Document, Element

DART_DATA = ("/usr/share/doc/dart/data", "/usr/local/share/doc/dart/data")
_URI = re.compile(r"([a-zA-Z][a-zA-Z0-9+.-]+)://(.*)", re.DOTALL)
_PACKAGE_SCHEMES = ("package", "model")


@dataclass(frozen=True)
class Places:
    """Where to look: the model's folder, and the packages that the caller named."""

    folder: str
    packages: Mapping[str, str]

    def candidates(self, uri: str) -> Iterator[str]:
        """The paths where a URI or relative path may be, best first."""
        match = _URI.fullmatch(uri)
        if match is None:
            yield os.path.normpath(os.path.join(self.folder, uri))
        elif match[1] == "file":
            yield os.path.normpath(os.path.join(self.folder, match[2]))
        elif match[1] in _PACKAGE_SCHEMES:
            name, _, rest = match[2].partition("/")
            for folder in package_folders(name, self.folder, self.packages):
                yield os.path.normpath(os.path.join(folder, rest))
        elif match[1] == "dart" and match[2].startswith("sample/"):
            folders = [*os.environ.get("DART_DATA_PATH", "").split(os.pathsep), *DART_DATA]
            for folder in filter(None, folders):
                yield os.path.normpath(os.path.join(folder, match[2].removeprefix("sample/")))

    def find(self, uri: str, packed: bool = False) -> str | None:
        """The path of the file that a URI or relative path names; None if there is none.

        With `packed`, there may be a packed one (.gz) instead of it.
        """
        for name in dict.fromkeys((uri, unquote(uri))):
            for path in self.candidates(name):
                if os.path.isfile(path) or (packed and os.path.isfile(path + ".gz")):
                    return path
        return None

    def explain(self, uri: str) -> str:
        """Why find() found nothing, and what to do."""
        match = _URI.fullmatch(uri)
        paths = list(self.candidates(uri))
        if match and match[1] in _PACKAGE_SCHEMES and not paths:
            name = match[2].partition("/")[0]
            return (
                f"there is no package {name!r}; name its folder with packages={{{name!r}: folder}}, "
                "or put it into ROS_PACKAGE_PATH"
            )
        if not paths:
            return "URIs of this kind are not read"
        return f"there is no file {' or '.join(dict.fromkeys(paths))}"


def package_folders(name: str, folder: str, packages: Mapping[str, str]) -> Iterator[str]:
    """Folders that may be the package `name`: as the caller says, else in ROS_PACKAGE_PATH, above, installed."""
    if name in packages:
        yield packages[name]
        return
    for entry in filter(None, os.environ.get("ROS_PACKAGE_PATH", "").split(os.pathsep)):
        for candidate in (Path(entry), Path(entry) / name, *sorted(Path(entry).glob(f"*/{_escaped(name)}"))):
            if candidate.name == name and os.path.isdir(candidate):
                yield str(candidate)
    for above in (Path(folder), *Path(folder).parents):
        if above.name == name:
            yield str(above)
        elif name and os.path.isdir(above / name):
            yield str(above / name)
    from pydart2 import models  # which reads the records of all installed packages

    yield from models.package_folders(name)


def _escaped(name: str) -> str:
    return re.sub(r"([*?[])", r"[\1]", name)


def composed(folder: str, uri: str) -> str:
    """The URI that the engine makes of one in a file in `folder`."""
    return uri if _URI.fullmatch(uri) else "file://" + posixpath.normpath(posixpath.join(folder, uri))


def read_bytes(path: str) -> bytes:
    """The content of a file, or of the packed one beside it (.gz); LoadError if it cannot be read or is too large."""
    try:
        if os.path.isdir(path):
            raise LoadError.at(path, None, "it is a folder, not a model file")
        if os.path.exists(path) and not os.path.isfile(path):
            raise LoadError.at(path, None, "it is a pipe or a device, not a model file; pass its content as text")
        packed = not os.path.exists(path) and os.path.exists(path + ".gz")
        with gzip.open(path + ".gz") if packed else open(path, "rb") as file:
            return file.read(MAX_BYTES + 1)
    except (OSError, EOFError, zlib.error) as error:
        if isinstance(error, LoadError):
            raise
        raise LoadError.at(path, None, str(error)) from error


@dataclass(frozen=True)
class Mesh:
    """The use of a mesh file by a shape."""

    uri: str
    shape: Element
    element: Element

    @property
    def collides(self) -> bool:
        """Whether the shape is for collisions, too."""
        if self.shape.tag == "geom":
            return (self.shape.get("@contype"), self.shape.get("@conaffinity")) != ("0", "0")
        return self.shape.tag in ("collision", "collision_shape")


_SHAPES = ("visual", "collision", "visualization_shape", "collision_shape")
_MESH_FIELD = {"urdf": "@filename", "sdf": "uri", "skel": "file_name"}


def meshes(kind: str, elements: Iterable[Element], folder: str = "") -> Iterator[Mesh]:
    """The meshes that a model of this kind uses; `folder` is where an MJCF file's are (its meshdir)."""
    elements = list(elements)
    if kind == "mjcf":
        assets = {mesh.get("@name"): mesh for mesh in elements if mesh.tag == "mesh" and mesh.get("@file")}
        for geom in (element for element in elements if element.tag == "geom" and element.get("@mesh")):
            asset = assets.get(geom.get("@mesh"))
            if asset is not None:
                yield Mesh(posixpath.join(folder, asset.get("@file") or ""), geom, asset)
    for mesh in (element for element in elements if kind in _MESH_FIELD and element.tag == "mesh"):
        uri, shape = mesh.get(_MESH_FIELD[kind]), mesh.ancestor(*_SHAPES)
        if uri and shape is not None:
            yield Mesh(uri.strip(), shape, mesh)


def includes(kind: str, document: Document) -> Iterator[tuple[Element, str]]:
    """The files that a document includes, each with the element that does so."""
    names = {"mjcf": "@file", "urdf_world": "@filename"}
    for element in document.root.all():
        name = element.get(names[kind]) if kind in names and element.tag == "include" else None
        if name:
            yield element, name
