"""Checks a model's XML before the engine's parsers see it."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator

from pydart2.loading.rules import ANY, ROOTS, SOFT_SHAPES, Rules
from pydart2.loading.xml import Document, Element

_NUMBER = re.compile(r"[-+]?(\d+(\.\d*)?|\.\d+)([eE][-+]?\d+)?|[-+]?(inf|infinity|nan)", re.IGNORECASE)
SDF_VERSIONS = ("1.4", "1.5", "1.6")


def rules_of(document: Document) -> Rules:
    """The rules of a document's format, by its root element; LoadError if there are none."""
    root = document.root
    if root.tag not in ROOTS:
        known = ", ".join(f"<{tag}>" for tag in ROOTS)
        raise document.error(root, f"its root element is <{root.tag}>; known are {known}")
    return ROOTS[root.tag]


def check(document: Document, rules: Rules, part: bool = False) -> None:
    """LoadError at the first element that the engine would stumble over; the root of a part may lack anything."""
    for element in relevant(document.root, rules):
        if not part or element is not document.root:
            _check_required(document, element, rules)
        _check_numbers(document, element, rules)
        if element.tag == "joint" and rules.joint_types:
            _check_joint_type(document, element, rules)
        elif element.tag == "soft_shape":
            _check_soft_shape(document, element)
        elif element.tag == "skeleton":
            _check_tree(document, element, "body", every_body_needs_a_joint=True)
        elif element.tag == "model":
            _check_tree(document, element, "link")
        elif element.tag == "sdf" and element.get("@version") not in SDF_VERSIONS:
            version = element.get("@version")
            raise document.error(element, f"its SDF version is {version}; the engine reads {', '.join(SDF_VERSIONS)}")


def relevant(root: Element, rules: Rules) -> Iterator[Element]:
    """The elements that the engine reads, in the order of the file."""
    waiting = [root]
    while waiting:
        element = waiting.pop()
        yield element
        if element.children:
            waiting += [child for child in reversed(element.children) if child.tag not in rules.skipped]


def _names(element: Element) -> tuple[str, ...]:
    """How rules name an element."""
    return (element.tag,) if element.parent is None else (element.tag, f"{element.parent.tag}/{element.tag}")


def _shown(name: str) -> str:
    return f"the attribute {name[1:]!r}" if name.startswith("@") else f"<{name.replace('/', '><')}>"


def _check_required(document: Document, element: Element, rules: Rules) -> None:
    for name in _names(element):
        for needed in rules.required.get(name, ()):
            if element.get(needed) is None:
                raise document.error(element, f"{element} needs {_shown(needed)}")
        choice = rules.one_of.get(name, ())
        if choice and all(element.get(one) is None for one in choice) and not _is_soft(element):
            raise document.error(element, f"{element} needs one of {', '.join(map(_shown, choice))}")


def _check_numbers(document: Document, element: Element, rules: Rules) -> None:
    for name in _names(element):
        for asked, count in rules.numbers.get(name, {}).items():
            text = element.get(asked)
            if text is None:
                continue
            place = element if asked.startswith("@") else element.find(asked) or element
            _check_text(document, place, f"{_shown(asked)} of {element}", text, count, asked in rules.limits)


def _check_text(document: Document, place: Element, what: str, text: str, count: int, limit: bool) -> None:
    words = text.split()
    shown = _clipped(text)
    if count not in (ANY, len(words)) or not words:
        wanted = f"{count} numbers" if count > 1 else "numbers" if count == ANY else "a number"
        raise document.error(place, f"{what} must be {wanted}, got {shown!r}")
    for word in words:
        if not _NUMBER.fullmatch(word):
            raise document.error(place, f"{what}: {_clipped(word)!r} is not a number")
        number = float(word)
        if math.isnan(number) or (math.isinf(number) and not limit):
            raise document.error(place, f"{what} must be finite, got {shown!r}")


def _clipped(text: str) -> str:
    return text if len(text) < 60 else text[:60] + "…"


def _check_joint_type(document: Document, joint: Element, rules: Rules) -> None:
    kind = joint.get("@type") or ""
    if kind not in rules.joint_types:
        raise document.error(joint, f"{joint} is of type {kind!r}; known are {', '.join(rules.joint_types)}")
    for needed in rules.joint_types[kind]:
        if joint.get(needed) is None:
            raise document.error(joint, f"{joint} is of type {kind!r} and needs {_shown(needed)}")


def _is_soft(geometry: Element) -> bool:
    return geometry.parent is not None and geometry.parent.tag == "soft_shape"


def _check_soft_shape(document: Document, soft: Element) -> None:
    geometry = soft.find("geometry")
    shape = next((child for child in geometry.children if child.tag in SOFT_SHAPES), None) if geometry else None
    if shape is None:
        raise document.error(soft, f"{soft} needs one of {', '.join(f'<{tag}>' for tag in SOFT_SHAPES)}")
    for needed in SOFT_SHAPES[shape.tag]:
        if shape.get(needed) is None:
            raise document.error(shape, f"{shape} of {soft} needs {_shown(needed)}")


def _check_tree(document: Document, model: Element, body_tag: str, every_body_needs_a_joint: bool = False) -> None:
    """Joints must join bodies that are there, to a tree."""
    bodies = {body.get("@name"): body for body in model.children if body.tag == body_tag}
    parents: dict[str, str] = {}
    for joint in (child for child in model.children if child.tag == "joint"):
        parent, child = (joint.get("parent") or "").strip(), (joint.get("child") or "").strip()
        for role, name in (("parent", parent), ("child", child)):
            if name not in bodies and (role, name) != ("parent", "world"):
                raise document.error(joint, f"{joint}: its {role} {name!r} is not a <{body_tag}> of {model}")
        parents.setdefault(child, parent)
    if every_body_needs_a_joint:
        joined: set[str | None] = {*parents, *parents.values()}
        for body in bodies.values():
            if body.get("@name") not in joined:
                raise document.error(body, f"{body} is in no joint of {model}")
    _check_no_cycle(document, bodies, parents)


def _check_no_cycle(document: Document, bodies: dict[str | None, Element], parents: dict[str, str]) -> None:
    """Going from child to parent must end."""
    good: set[str] = set()
    for start in parents:
        path: dict[str, None] = {}
        name: str = start
        while name in parents and name not in good:
            if name in path:
                raise document.error(bodies[name], f"{bodies[name]} is among its own ancestors")
            path[name] = None
            name = parents[name]
        good.update(path)
