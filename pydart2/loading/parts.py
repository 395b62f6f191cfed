"""Files that hold several skeletons: each as a file of its own."""

from __future__ import annotations

import re
from collections.abc import Iterable

from pydart2.errors import NameNotFound
from pydart2.loading.xml import Document, Element, opening_tag, parse

_TAGS = {"skel": "skeleton", "sdf": "model"}


def skeletons_of(root: Element) -> list[Element]:
    """The skeletons of a SKEL or SDF file, in its worlds and beside them; none of other formats."""
    homes = [root, *(child for child in root.children if child.tag == "world")]
    found = [child for home in homes for child in home.children if child.tag == _TAGS.get(root.tag)]
    return sorted(found, key=lambda element: element.start)


def names_of(elements: Iterable[Element]) -> str:
    """Their names, as sentences have them."""
    return ", ".join(repr(element.get("@name")) for element in elements)


def split(document: Document, only: str | Iterable[str] | None) -> list[Document]:
    """The skeletons of a document, all or those of some names, each alone in it at its lines."""
    skeletons = skeletons_of(document.root)
    if not skeletons:
        what = "has no skeleton" if document.root.tag in _TAGS else "is no SKEL or SDF file; use add_skeleton()"
        raise document.error(document.root, f"it {what}")
    if only is not None:
        by_name = {element.get("@name"): element for element in reversed(skeletons)}
        names = [only] if isinstance(only, str) else list(only)
        for name in names:
            if name not in by_name:
                where = document.path or "the XML text"
                raise NameNotFound("skeleton", name, f"{where} with {names_of(skeletons)}", filter(None, by_name))
        skeletons = [by_name[name] for name in names]
    return [_alone(document, element) for element in skeletons]


def _alone(document: Document, element: Element) -> Document:
    """A file like this one with nothing but the element below its root."""
    data, root = document.data, document.root
    begin, end = opening_tag(data, root.start), data.rindex(b"</", root.start, root.end)
    before, after = (re.sub(rb"[^\n]", b" ", part) for part in (data[begin : element.start], data[element.end : end]))
    return parse(data[:begin] + before + data[element.start : element.end] + after + data[end:], document.path)
