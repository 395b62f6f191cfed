"""What the formats have in common about shapes."""

from __future__ import annotations

import os
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from pydart2.exporting.losses import Losses
from pydart2.exporting.parts import LinkPart, ShapePart


@dataclass
class Use:
    """A shape for one purpose, under the name that it is to have."""

    shape: ShapePart
    name: str
    collides: bool


def uses(link: LinkPart, kinds: tuple[str, ...], losses: Losses) -> Iterator[Use]:
    """The shapes of a link for each of their purposes, drawing first.

    Of those that are not of the kinds one that collides is an ExportError, and one that is drawn is left out.
    """
    for collides in (False, True):
        for shape in link.shapes:
            if not (shape.collides if collides else shape.drawn):
                continue
            if shape.kind in kinds:
                yield Use(shape, shape.name, collides)
            elif collides:
                raise losses.refuse(f"collision shape {shape.name!r} of {link.name!r} is of the kind {shape.kind!r}")
            else:
                losses.add(f"drawn shapes of the kind {shape.kind}", shape.name)


def note_surfaces(link: LinkPart, losses: Losses, friction: bool = False) -> None:
    """Note friction, unless it is held, slip and restitution of the shapes."""
    for shape in link.shapes:
        if shape.collides and shape.friction != 1.0 and not friction:
            losses.add("friction coefficients", link.name)
        if shape.collides and not shape.is_isotropic:
            losses.add("slip, secondary friction and its direction", link.name)
        if shape.collides and shape.restitution != 0.0:
            losses.add("restitution coefficients", link.name)


def mesh_file(shape: ShapePart, folder: str | None, losses: Losses) -> str:
    """The path of a mesh's file, from the folder of the model if it is in there; ExportError if it has none."""
    path: str = shape.sizes["path"].removeprefix("file://")
    if not path:
        raise losses.refuse(f"the mesh {shape.name!r} is made of arrays and has no file")
    if folder is not None and os.path.commonpath([folder, path]) == folder:
        return os.path.relpath(path, folder)
    return path


def mesh_scale(shape: ShapePart) -> Any:
    """The scale, shape (3,), dimensionless, negative along the axes where the file is mirrored."""
    return shape.sizes["scale"] * np.array([-1.0 if axis in shape.sizes["mirrored"] else 1.0 for axis in "xyz"])
