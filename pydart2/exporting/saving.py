"""Texts and files of skeletons and worlds, by format."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from pydart2.errors import ExportError
from pydart2.exporting import mjcf, sdf, skel, urdf
from pydart2.exporting.losses import Losses
from pydart2.exporting.numbers import Element, document
from pydart2.exporting.parts import SkeletonPart, WorldPart, skeleton_part, world_part

if TYPE_CHECKING:
    from pydart2.skeleton import Skeleton
    from pydart2.world import World

_Writer = Callable[[list[SkeletonPart], WorldPart | None, Losses, str | None], Element]
_WRITERS: dict[str, _Writer] = {
    "URDF": urdf.root_of,
    "SKEL": skel.root_of,
    "SDF": sdf.root_of,
    "MJCF": mjcf.root_of,
}
_SUFFIXES = {".urdf": "URDF", ".skel": "SKEL", ".sdf": "SDF", ".world": "SDF", ".xml": "MJCF", ".mjcf": "MJCF"}


def text_of(
    skeletons: Sequence[Skeleton], world: World | None, title: str, strict: bool, place: str, folder: str | None = None
) -> str:
    """The text of a file of a format; `folder` is where it will be, `place` what a warning calls it."""
    parts = [skeleton_part(skel) for skel in skeletons]
    losses = Losses(title)
    for part in parts:
        _check(part, losses)
    root = _WRITERS[title](parts, None if world is None else world_part(world), losses, folder)
    losses.say(place, strict)
    return document(root)


def save(skeletons: Sequence[Skeleton], world: World | None, path: str | os.PathLike[str], strict: bool) -> None:
    """Write a file of the format that its suffix names; nothing is written if it cannot hold what there is."""
    file = Path(os.path.abspath(path))
    title = _SUFFIXES.get(file.suffix.lower())
    if title is None:
        raise ExportError(f"no format for {str(path)!r}; its suffix is one of {', '.join(_SUFFIXES)}")
    text = text_of(skeletons, world, title, strict, str(path), str(file.parent))
    file.write_text(text, encoding="utf-8")


def _check(one: SkeletonPart, losses: Losses) -> None:
    """ExportError for what no format holds: soft bodies, and names that do not come back from XML."""
    for link in one.links:
        if link.soft:
            raise losses.refuse(f"body {link.name!r} of {one.name!r} is soft")
    names = [one.name]
    for link in one.links:
        names += [link.name, link.joint.name, *(dof.name for dof in link.joint.dofs)]
        names += [name for name, _ in link.markers]
    for name in names:
        if not name.isprintable() or not name or name != " ".join(name.split()):
            raise losses.refuse(f"the name {name!r} has spaces or signs that do not come back from a file")
