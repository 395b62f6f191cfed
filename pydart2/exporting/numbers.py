"""Numbers as files have them."""

from __future__ import annotations

import math
from typing import Any
from xml.etree import ElementTree

import numpy as np
from numpy.typing import ArrayLike

from pydart2.exporting.parts import Array

Element = ElementTree.Element


def text(values: ArrayLike) -> str:
    """Numbers of any shape and unit, one after another, each in as many digits as bring it back."""
    return " ".join(repr(float(value) + 0.0) for value in np.ravel(values))


def add(parent: Element, tag: str, content: str | None = None, **attributes: str) -> Element:
    """A new child of an element."""
    child = ElementTree.SubElement(parent, tag, attributes)
    child.text = content
    return child


def add_nonzero(parent: Element, values: dict[str, float]) -> None:
    """A new child for each number that is not zero."""
    for tag, value in values.items():
        if value != 0.0:
            add(parent, tag, text(value))


def document(root: Element) -> str:
    """The text of a file, with a line for each element."""
    ElementTree.indent(root)
    return '<?xml version="1.0"?>\n' + ElementTree.tostring(root, encoding="unicode") + "\n"


def inverse(pose: Array) -> Array:
    """Of a pose, shape (4, 4), m."""
    result = np.eye(4)
    result[:3, :3] = pose[:3, :3].T
    result[:3, 3] = -pose[:3, :3].T @ pose[:3, 3]
    return result


def is_identity(pose: Array) -> bool:
    """Whether a pose, shape (4, 4), m, is that of what it is in."""
    return bool((pose == np.eye(4)).all())


def fixed_angles(rotation: Array) -> tuple[float, float, float]:
    """Angles about the fixed x, y and z, rad, of a rotation, shape (3, 3); exact for all of them."""
    z = math.atan2(rotation[1, 0], rotation[0, 0])
    sine, cosine = math.sin(z), math.cos(z)
    x = math.atan2(sine * rotation[0, 2] - cosine * rotation[1, 2], cosine * rotation[1, 1] - sine * rotation[0, 1])
    y = math.atan2(-rotation[2, 0], cosine * rotation[0, 0] + sine * rotation[1, 0])
    return x, y, z


def moving_angles(rotation: Array) -> tuple[float, float, float]:
    """Angles about x, then the turned y, then the turned z, rad, of a rotation, shape (3, 3)."""
    x, y, z = fixed_angles(rotation.T)
    return -x, -y, -z


def moments(inertia: Array) -> dict[str, float]:
    """The six moments of inertia, kg m², by their names, of a matrix of shape (3, 3)."""
    names: dict[str, tuple[int, int]] = {
        "ixx": (0, 0),
        "iyy": (1, 1),
        "izz": (2, 2),
        "ixy": (0, 1),
        "ixz": (0, 2),
        "iyz": (1, 2),
    }
    return {name: float(inertia[place]) for name, place in names.items()}


def attributes(**values: Any) -> dict[str, str]:
    """Numbers as attributes."""
    return {name: text(value) for name, value in values.items()}
