"""Loading models: from a path, a URI or a text; checked, and tried in a helper process, before the engine reads them.

>>> world.add_skeleton("robot.urdf", packages={"robot_description": "/opt/robots/description"})

The format is known by the root element: ``<skel>``, ``<sdf>``, ``<robot>`` (URDF), ``<world>`` (URDF world),
``<mujoco>`` (MJCF), ``<KinematicModel>`` (VSK).
"""

from __future__ import annotations

import contextlib
import logging
import os
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from html import escape

from pydart2._native import ModelSource, WorldHandle
from pydart2.errors import LoadError
from pydart2.loading import files
from pydart2.loading.checks import check, relevant, rules_of
from pydart2.loading.mass import settle_masses
from pydart2.loading.mending import mend, mend_fields, mirror
from pydart2.loading.options import Missing as Missing
from pydart2.loading.options import Options as Options
from pydart2.loading.options import Reader as Reader
from pydart2.loading.parts import names_of, skeletons_of, split
from pydart2.loading.readable import Readable
from pydart2.loading.rules import URDF, URDF_WORLD, Rules
from pydart2.loading.trial import getting_ready, seconds_for, try_model
from pydart2.loading.xml import Document, Element, parse
from pydart2.resources import data_folder, find_model

Source = str | bytes | os.PathLike[str]

MAX_INCLUDE_DEPTH = 8
#: What the engine and we put before a name, and the elements that may be meant.
_NAMED = re.compile(r"(\w*)\s*(?:'([^']+)'|\[([^\]]+)\])")
_KINDS = {
    "body": ("link", "body", "segment"),
    "link": ("link", "body", "segment"),
    "joint": ("joint",),
    "shape": ("visual", "collision", "visualization_shape", "collision_shape", "geom"),
    "skeleton": ("skeleton", "robot", "model"),
}
_QUICK = 1.0  # s: Ctrl-C may wait as long
_log = logging.getLogger("pydart2")


@dataclass
class Model(Readable):
    """A file that was read and checked, ready for the engine. As a path, it is that of its file."""

    document: Document
    rules: Rules
    source: ModelSource
    safe: bool  # whether to try it first
    files: list[str] = field(default_factory=list)
    light: bool = False  # whether links without <inertial> weigh less than in the engine
    load_seconds: float | None = None
    ours: bool = False  # whether it is not tried as it comes with the package

    @property
    def has_world(self) -> bool:
        """Whether it is a world; a world can hold several skeletons, and has a gravity."""
        root = self.document.root
        return root.tag in ("mujoco", "world") or root.find("world") is not None

    @property
    def has_skeleton(self) -> bool:
        """Whether add_skeleton() takes it."""
        root = self.document.root
        return root.tag != "world" and not (
            root.tag in ("skel", "sdf") and root.find("skeleton" if root.tag == "skel" else "model") is None
        )

    def load_world(self) -> WorldHandle:
        """A new world with the content of the file."""
        if not self.has_world:
            raise self.document.error(self.document.root, "it has no world")
        seconds, is_quick = self._try(world=True)
        with self._located():
            return WorldHandle.load(self.source, seconds, is_quick)

    def add_to(self, world: WorldHandle) -> int:
        """Add the skeleton to a world; returns its index there."""
        if not self.has_skeleton:
            inside = names_of(skeletons_of(self.document.root))
            many = f"; world.add_skeletons(file) adds what is in it: {inside}" if inside else ""
            what = f"is a world; load it with World(step, file){many}" if self.has_world else "has no model"
            raise self.document.error(self.document.root, f"it {what}")
        seconds, is_quick = self._try(world=False)
        with self._located():
            return world.add_skeleton(self.source, seconds, is_quick)

    def _try(self, world: bool) -> tuple[float, bool]:
        """In a helper process; how long the reading may take then, s of processor time, and whether it is known to be
        so quick that nobody would end it."""
        seconds = seconds_for(self.source, self.files) if self.load_seconds is None else self.load_seconds
        if not self.safe:
            return seconds, self.ours
        reason, took = try_model(self.source, world, self.files, seconds)
        if reason is not None:
            hint = "; it may be for want of mass: engine_defaults=True gives each link without <inertial> 1 kg"
            raise self._error(reason + hint * (self.light and "Nan" in reason))
        return seconds, took < _QUICK

    @contextlib.contextmanager
    def _located(self) -> Iterator[None]:
        """Adds the file and the line to the engine's errors."""
        try:
            yield
        except LoadError as error:
            raise self._error(str(error)) from None

    def _error(self, reason: str) -> LoadError:
        """At the line of the element that the reason names, else at that of the root."""
        quoted = [(kind.lower(), a or b) for kind, a, b in _NAMED.findall(reason)]
        elements = [e for e in self.document.root.all() if e.get("@name") or e.get("@NAME")]
        for kind, name in quoted:  # a joint may have the name of its link
            for element in elements:
                if name in (element.get("@name"), element.get("@NAME")) and element.tag.lower() in _KINDS.get(kind, ()):
                    return self.document.error(element, reason)
        names = {name for _, name in quoted}
        return self.document.error(next((e for e in elements if e.get("@name") in names), self.document.root), reason)


def read_model(what: Source | Readable, options: Options | None = None) -> Readable:
    """Read and check a model.

    Parameters
    ----------
    what
        A path (from the current folder, else among the package's models), a URI (``file://``, ``package://``,
        ``dart://sample/``), or the XML itself: bytes, or a str that begins with ``<``.
    options
        How to load.

    Raises
    ------
    LoadError
        With file, line and reason, if it is missing or cannot be read.
    """
    if isinstance(what, Readable):
        return what
    options = options or Options()
    where, text = _source_of(what, options)
    with getting_ready() if _is_tried(where, options) else contextlib.nullcontext():
        document = parse(text, where)
        if document.root.tag == "mujoco":
            if options.name is not None:
                raise ValueError("name= is for the skeletons of URDF, SDF and SKEL files, not of <mujoco>")
            if options.reader == "mujoco":
                from pydart2.mjcf import MjcfModel

                return MjcfModel(document, options.safe is not False, options.load_seconds)
            place = document.path or "XML text"
            _log.warning("%s: read with reader='engine', whose numbers differ from MuJoCo's", place)
        return _Builder(document, options).build()


def read_models(what: Source, options: Options, only: str | Iterable[str] | None) -> Iterator[Model]:
    """Read and check the skeletons of a SKEL or SDF file, or those of some names, each as a model of its own.

    Raises LoadError as read_model() does, and NameNotFound.
    """
    where, text = _source_of(what, options)
    for document in split(parse(text, where), only):
        yield _Builder(document, options).build()


def _source_of(what: Source, options: Options) -> tuple[str | None, bytes]:
    """The file that a path or URI means, and its content; None and a text."""
    options.check()
    if isinstance(what, bytes):
        return None, what
    if isinstance(what, str) and (options.text or what.lstrip("\ufeff \t\r\n").startswith("<")):
        return None, what.encode("utf-8", "replace")
    if not isinstance(what, (str, os.PathLike)):
        raise TypeError(f"a model is a path, a URI or the text of a file, got {what!r}")
    path = _path_of(os.fspath(what), options)
    return path, files.read_bytes(path)


def _is_tried(path: str | None, options: Options) -> bool:
    """Whether a file, or a text without, is tried first: all but the package's own models."""
    if options.safe is not None:
        return options.safe
    return path is None or not path.startswith(str(data_folder().resolve()) + os.sep)


def _path_of(name: str, options: Options) -> str:
    """The absolute path that a path or URI means."""
    if "\0" in name or not name.isprintable():
        raise LoadError(f"no file {name!r}: a path has no such characters")
    if "://" not in name:
        return find_model(name)
    places = files.Places(os.getcwd(), _folders(options))
    path = places.find(name, packed=True)
    if path is None:
        raise LoadError(f"no file {name!r}: {places.explain(name)}")
    return os.path.realpath(path)


def _folders(options: Options) -> dict[str, str]:
    """The packages that the caller named, with absolute folders; LoadError if one is not there."""
    folders = {name: os.path.abspath(folder) for name, folder in (options.packages or {}).items()}
    for name, folder in folders.items():
        if not os.path.isdir(folder):
            raise LoadError(f"no folder {folder!r}, which packages= gives for {name!r}")
    return folders


class _Builder:
    """Makes the Model of a document: checks it and what it includes, and finds its meshes."""

    def __init__(self, document: Document, options: Options) -> None:
        self.main = document
        self.options = options
        self.rules = rules_of(document)
        self.path = document.path or os.path.join(os.getcwd(), "text.xml")
        self.places = files.Places(os.path.dirname(self.path), _folders(options))
        self.source = ModelSource(self.rules.kind, self.path)
        self.source.set_lenient(options.missing_meshes == "warn")
        self.documents: dict[str, Document] = {}
        self.files: list[str] = []

    def build(self) -> Model:
        self._add(self.path, self.main, ())
        skeletons = skeletons_of(self.main.root)
        if len(skeletons) > 1 and self.main.root.find("world") is None:
            reason = f"of {names_of(skeletons)} the first is taken; world.add_skeletons() takes all"
            self._warn(self.main, skeletons[1], reason)
        if self.options.name is not None:
            self._rename(self.options.name)
        self._settle_meshes()
        light = self._settle_masses()
        for path, document in self.documents.items():
            self.source.add_text(path, _for_the_engine(document).decode())
        if self.rules.kind == "mjcf" and all(d.root.find("default") is None for d in self.documents.values()):
            # The engine aborts without one.
            text = _for_the_engine(self.main)
            self.source.add_text(self.path, re.sub(rb"</mujoco\s*>\s*$", b"<default/></mujoco>", text).decode())
        safe = _is_tried(self.main.path, self.options)
        ours = not safe and self.options.safe is None
        return Model(self.main, self.rules, self.source, safe, self.files, light, self.options.load_seconds, ours)

    def _add(self, path: str, document: Document, above: tuple[str, ...]) -> None:
        """Check a document and those that it includes."""
        rules = URDF if self.rules is URDF_WORLD and above else self.rules
        mend_fields(document, relevant(document.root, rules), rules, self._warn)
        check(document, rules, part=rules.kind == "mjcf" and bool(above))
        mend(
            document,
            relevant(document.root, rules),
            rules,
            self._warn,
            lenient=self.options.missing_meshes == "warn",
            bounds_as_engine=self.options.engine_defaults,
        )
        self.documents[path] = document
        for element, name in files.includes(rules.kind, document):
            self._include(document, element, name, (*above, path))

    def _rename(self, name: str) -> None:
        root = self.main.root
        named = root if root.tag == "robot" else root.find("model") or root.find("skeleton")
        if named is None:
            raise ValueError(f"name= is for the skeletons of URDF, SDF and SKEL files, not of <{root.tag}>")
        self.main.set(named, "@name", escape(name))

    def _include(self, document: Document, element: Element, name: str, above: tuple[str, ...]) -> None:
        path = self.places.find(name, packed=True)
        if path is None:
            raise document.error(element, f"it includes {name!r}: {self.places.explain(name)}")
        if path in above:
            raise document.error(element, f"it includes {name!r}, which includes this file")
        if len(above) > MAX_INCLUDE_DEPTH:
            raise document.error(element, f"files include each other more than {MAX_INCLUDE_DEPTH} deep")
        self._redirect(name, path)
        if path not in self.documents:
            self._add(path, parse(files.read_bytes(path), path), above)

    def _settle_meshes(self) -> None:
        """Tell the engine where the meshes are; take out the shapes whose mesh is missing."""
        elements = [(element, doc) for doc in self.documents.values() for element in relevant(doc.root, self.rules)]
        owner = dict(elements)
        compilers = (element.get("@meshdir") for element in owner if element.tag == "compiler")
        folder = next(filter(None, compilers), "")
        kind = "urdf" if self.rules is URDF_WORLD else self.rules.kind
        missing: dict[Element, Document] = {}
        for mesh in files.meshes(kind, owner, folder):
            path = self.places.find(mesh.uri)
            if path is not None:
                self.files.append(path)
                if mirror(owner[mesh.shape], mesh.element, path):
                    continue
                self._redirect(mesh.uri if folder or kind != "mjcf" else "/" + mesh.uri, path)
                continue
            self._refuse_or_warn(owner[mesh.shape], mesh)
            missing[mesh.shape] = owner[mesh.shape]
            if kind == "mjcf":
                missing[mesh.element] = owner[mesh.element]
        for element, document in missing.items():
            document.remove([element])

    def _refuse_or_warn(self, document: Document, mesh: files.Mesh) -> None:
        kind = "collision" if mesh.collides else "visual"
        body = mesh.shape.ancestor("link", "body")
        reason = f"the {kind} mesh {mesh.uri!r} of {body} is missing: {self.places.explain(mesh.uri)}"
        if mesh.collides and self.options.missing_meshes == "error":
            raise document.error(mesh.element, f"{reason}; with missing_meshes='warn' it is left out")
        self._warn(document, mesh.element, f"{reason}; left out")

    def _settle_masses(self) -> bool:
        """Let URDF links without <inertial> weigh what they should; whether it is less than in the engine."""
        before = {name: document.changed() for name, document in self.documents.items()}
        for document in self.documents.values():
            if document.root.tag != "robot" or self.options.engine_defaults:
                continue
            kept = settle_masses(document, self.options.massless)
            if kept:
                names = ", ".join(repr(link.get("@name")) for link in kept)
                reason = f"no <inertial> in {names}, and too little mass below for it to move"
                self._warn(document, kept[0], f"{reason}: 1 kg, as the engine has it (massless=True: 0 kg)")
        return any(document.changed() != before[name] for name, document in self.documents.items())

    def _warn(self, document: Document, element: Element, reason: str) -> None:
        """A warning, or an error if they are asked for."""
        if self.options.strict:
            raise document.error(element, reason)
        _log.warning("%s, line %d: %s", document.path or "XML text", element.line, reason)

    def _redirect(self, uri: str, path: str) -> None:
        """Let the engine find `path` under the URI that it will ask for, and the files beside it."""
        asked = files.composed(self.places.folder, uri)
        if asked == "file://" + path:
            return
        if os.path.basename(asked) == os.path.basename(path) and os.path.dirname(asked) != "file:":
            asked, path = os.path.dirname(asked) + "/", os.path.dirname(path) + "/"
        self.source.add_prefix(asked, path)


def _for_the_engine(document: Document) -> bytes:
    """The text without what its parsers stumble over: line ends and tabs between numbers, spaces around them."""
    data = re.sub(rb"[\t\r\n]", b" ", document.changed())
    return re.sub(rb">\s+(?=[^<\s])", b">", re.sub(rb"(?<=[^>\s])\s+<", b"<", data))
