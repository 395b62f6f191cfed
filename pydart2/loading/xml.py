"""XML with the line of each element, read by the standard library's expat within limits."""

from __future__ import annotations

import logging
import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from xml.parsers import expat

from pydart2.errors import LoadError

MAX_BYTES = 32_000_000
MAX_ELEMENTS = 500_000
MAX_DEPTH = 200

_log = logging.getLogger("pydart2")
_DECLARATION = re.compile(rb"(?:\xef\xbb\xbf)?(?:\s|<!--.*?-->)*(<\?xml\s[^>]*\?>)", re.DOTALL)
_ENCODING = re.compile(rb"""encoding\s*=\s*["']([\w.-]+)["']""")
_TAG = re.compile(rb"""<(?:"[^"]*"|'[^']*'|[^>"'])*>""")


@dataclass(eq=False, slots=True)
class Element:
    """An XML element; `start` and `end` are its first byte and the one after its last."""

    tag: str
    attributes: dict[str, str]
    line: int
    start: int
    parent: Element | None = None
    end: int = 0
    text: str = ""
    children: list[Element] = field(default_factory=list)

    def all(self) -> Iterator[Element]:
        """This element and all below it, in the order of the file."""
        waiting = [self]
        while waiting:
            element = waiting.pop()
            yield element
            waiting += reversed(element.children)

    def find(self, *tags: str) -> Element | None:
        """The first element at the end of a path of tags."""
        element: Element | None = self
        for tag in tags:
            element = next((child for child in element.children if child.tag == tag), None) if element else None
        return element

    def get(self, field: str) -> str | None:
        """The text of the child `field` (``a/b`` for a child's child), or with a leading @ the attribute, or None."""
        if field.startswith("@"):
            return self.attributes.get(field[1:])
        child = self.find(*field.split("/"))
        return None if child is None else child.text

    def ancestor(self, *tags: str) -> Element | None:
        """The nearest element above with one of these tags."""
        element = self.parent
        while element is not None and element.tag not in tags:
            element = element.parent
        return element

    def __str__(self) -> str:
        name = self.attributes.get("name") or self.attributes.get("NAME")
        return f"<{self.tag}>" if name is None else f"<{self.tag}> {name!r}"


@dataclass
class Document:
    """A file that was read: its path (None for a text), its bytes as UTF-8, its root."""

    path: str | None
    data: bytes
    root: Element
    _edits: list[tuple[int, int, bytes]] = field(default_factory=list)

    def error(self, element: Element | int, reason: str) -> LoadError:
        """A LoadError at an element or a line."""
        return LoadError.at(self.path, element if isinstance(element, int) else element.line, reason)

    def remove(self, elements: list[Element]) -> None:
        """Overwrite elements with spaces; the lines of all others stay."""
        for element in elements:
            self._edits = [edit for edit in self._edits if not element.start <= edit[0] < element.end]
        data = bytearray(self.data)
        for element in elements:
            data[element.start : element.end] = re.sub(rb"[^\n]", b" ", data[element.start : element.end])
        self.data = bytes(data)

    def append(self, element: Element, xml: bytes) -> None:
        """Let changed() have more at the end of an element."""
        if self.data.endswith(b"/>", element.start, element.end):
            self._edits.append((element.end - 2, element.end, b">" + xml + f"</{element.tag}>".encode()))
        else:
            end = self.data.rindex(b"</", element.start, element.end)
            self._edits.append((end, end, xml))

    def set(self, element: Element, field: str, value: str) -> None:
        """Let changed() have a new value, which needs no escapes; the field is as in get(), a child that is there."""
        if not field.startswith("@"):
            child = element.find(*field.split("/"))
            if child is not None:
                child.text = value
                opening = _TAG.match(self.data, child.start)
                after = opening.end() if opening else child.start
                self._edits.append((after, self.data.rindex(b"</", child.start, child.end), value.encode()))
            return
        attribute = field[1:]
        element.attributes[attribute] = value
        tag = _TAG.match(self.data, element.start)
        found = re.search(rb"\s%s\s*=\s*(\"[^\"]*\"|'[^']*')" % re.escape(attribute.encode()), tag[0]) if tag else None
        place = element.start + 1 + len(element.tag.encode())
        new = f' {attribute}="{value}"'.encode()
        start, end = (element.start + found.start(), element.start + found.end()) if found else (place, place)
        self._edits = [edit for edit in self._edits if start == end or edit[:2] != (start, end)]
        self._edits.append((start, end, new))

    def changed(self) -> bytes:
        """The bytes with what append() and set() ask for."""
        pieces, at = [], 0
        for start, end, new in sorted(self._edits, key=lambda edit: edit[:2]):
            pieces += [self.data[at:start], new]
            at = end
        return b"".join([*pieces, self.data[at:]])


def opening_tag(data: bytes, start: int) -> int:
    """Where the opening tag ends that begins at `start`."""
    tag = _TAG.match(data, start)
    return tag.end() if tag else start


def parse(data: bytes, path: str | None) -> Document:
    """Read XML; LoadError with the line if it is not well-formed, beyond a limit, or declares entities."""
    data = _as_utf8(data, path)
    if not data.strip():
        raise LoadError.at(path, None, "it is empty")
    document = Document(path, data, Element("", {}, 0, 0))
    _Reader(document).read()
    return document


def _as_utf8(data: bytes, path: str | None) -> bytes:
    """The bytes of the same text in UTF-8, without a byte order mark."""
    if len(data) > MAX_BYTES:
        raise LoadError.at(path, None, f"it has {len(data)} bytes; at most {MAX_BYTES} are read")
    declaration = _DECLARATION.match(data)
    declared = _ENCODING.search(declaration[1]) if declaration else None
    encoding = declared[1].decode() if declared else "utf-8"
    if data.startswith((b"\xff\xfe", b"\xfe\xff")):
        encoding = "utf-16"
    try:
        text = data.decode("utf-8-sig" if encoding.lower() in ("utf-8", "utf8") else encoding)
    except (LookupError, UnicodeError):
        _log.warning("%s is not in %s, as it should be; reading it as Latin-1", path or "the XML text", encoding)
        text = data.decode("latin-1")
    text = text.rstrip("\0")  # as other readers do, which stop there
    if "\0" in text:
        raise LoadError.at(path, text.count("\n", 0, text.index("\0")) + 1, "it is not a text: it has a zero byte")
    utf8 = text.encode("utf-8", "replace")
    declaration = _DECLARATION.match(utf8)
    if declaration is not None:  # it may follow a comment here, as in other readers, though not in XML
        start, end = declaration.span(1)
        utf8 = utf8[:start] + re.sub(rb"[^\n]", b" ", utf8[start:end]) + utf8[end:]
    return utf8


class _Reader:
    """Makes the tree of a document from expat's calls."""

    def __init__(self, document: Document) -> None:
        self.document = document
        self.open = [document.root]
        self.count = 0
        self.parser = expat.ParserCreate("utf-8")
        self.parser.buffer_text = True
        self.parser.StartElementHandler = self.start
        self.parser.EndElementHandler = self.end
        self.parser.CharacterDataHandler = self.text
        self.parser.EntityDeclHandler = self.entity

    def read(self) -> None:
        try:
            self.parser.Parse(self.document.data, True)
        except expat.ExpatError as error:
            reason = expat.ErrorString(error.code)
            raise self.document.error(error.lineno, f"the XML is not well-formed: {reason}") from None
        self.document.root = self.document.root.children[0]
        self.document.root.parent = None

    def start(self, tag: str, attributes: dict[str, str]) -> None:
        line = self.parser.CurrentLineNumber
        self.count += 1
        if self.count > MAX_ELEMENTS:
            raise self.document.error(line, f"it has more than {MAX_ELEMENTS} elements")
        if len(self.open) > MAX_DEPTH:
            raise self.document.error(line, f"its elements are nested more than {MAX_DEPTH} deep")
        element = Element(tag, attributes, line, self.parser.CurrentByteIndex, self.open[-1])
        self.open[-1].children.append(element)
        self.open.append(element)

    def end(self, _tag: str) -> None:
        element = self.open.pop()
        tag = _TAG.match(self.document.data, element.start)
        if tag is not None and not tag[0].endswith(b"/>"):
            tag = _TAG.match(self.document.data, self.parser.CurrentByteIndex)
        element.end = tag.end() if tag else element.start

    def text(self, text: str) -> None:
        self.open[-1].text += text

    def entity(self, name: str, *_: object) -> None:
        raise self.document.error(self.parser.CurrentLineNumber, f"it declares the entity {name!r}; none are expanded")
