"""What a format cannot hold: noted while a file is written, and said once."""

from __future__ import annotations

import logging
from collections.abc import Collection, Iterable
from dataclasses import fields

from pydart2.errors import ExportError
from pydart2.exporting.parts import CameraPart, DofPart, JointPart, SkeletonPart, WorldPart

_log = logging.getLogger("pydart2")
_SHOWN = 5  # names of each kind

#: Field of a dof → what it is called.
_LABELS = {
    "lower": "position limits",
    "upper": "position limits",
    "initial": "initial positions",
    "velocity_lower": "velocity limits",
    "velocity_upper": "velocity limits",
    "initial_velocity": "initial velocities",
    "force_lower": "force limits",
    "force_upper": "force limits",
    "stiffness": "springs",
    "damping": "damping",
    "friction": "joint friction",
    "armature": "armature",
}
_DEFAULTS = {field.name: field.default for field in fields(DofPart) if field.name in _LABELS}


class Losses:
    """Of one file of a format."""

    def __init__(self, title: str) -> None:
        self.title = title
        self.names: dict[str, dict[str, None]] = {}

    def add(self, what: str, name: str = "") -> None:
        """Note that something of this name is left out."""
        self.names.setdefault(what, {})[name] = None

    def refuse(self, reason: str) -> ExportError:
        """The error for what must not be left out."""
        return ExportError(f"not in {self.title}: {reason}")

    def add_dofs(self, joint: JointPart, held: Iterable[str]) -> None:
        """Note what the dofs of a joint have besides what is held."""
        held = set(held)
        for dof in joint.dofs:
            for name, default in _DEFAULTS.items():
                if name not in held and getattr(dof, name) != default:
                    self.add(_LABELS[name], dof.name)

    def add_names(self, joint: JointPart, read: Iterable[str]) -> None:
        """Note it if the dofs of a joint have other names than those that are read."""
        if [dof.name for dof in joint.dofs] != list(read):
            self.add("names of dofs that are not those of their joints", joint.name)

    def add_world(self, world: WorldPart) -> None:
        """Note the pairs of bodies and the cameras of a world."""
        for one, two in world.pairs:
            self.add_pair(one[1], two[1])
        self.add_cameras(world.cameras)

    def add_cameras(self, cameras: Iterable[CameraPart]) -> None:
        """Note that there are no cameras."""
        for camera in cameras:
            self.add("cameras", camera.name)

    def add_pair(self, one: str, two: str) -> None:
        """Note that two bodies pass through each other."""
        self.add("bodies that pass through each other (create_collision_filter)", f"{one} and {two}")

    def add_skeleton(self, skel: SkeletonPart, held: Collection[str]) -> None:
        """Note what there is of a skeleton besides joints, masses and shapes, but for what is held."""
        for words in skel.constraints:
            self.add("constraints", words)
        for what, names in skel.besides.items():
            for name in names:
                self.add(what, name)
        for one, two in () if "pairs" in held else skel.pairs:
            self.add_pair(one, two)
        if not skel.mobile and "mobile" not in held:
            self.add("that they do not move (set_mobile)", skel.name)
        if skel.self_collision and "self_collision" not in held:
            self.add("self-collision", skel.name)
        for link in skel.links:
            self.add_cameras(() if "cameras" in held else link.cameras)
            if not link.gravity and "gravity" not in held:
                self.add("that gravity does not act (set_gravity_mode)", link.name)
            if not link.collidable and "collidable" not in held:
                self.add("that they do not collide (set_collidable)", link.name)
            if link.joint.enforced and "enforced" not in held:
                self.add("that position limits are enforced", link.joint.name)

    def sentence(self) -> str:
        """All of it; empty if there is nothing."""
        return "; ".join(what + _listed([name for name in names if name]) for what, names in self.names.items())

    def say(self, place: str, strict: bool) -> None:
        """Warn of all of it at once, or raise."""
        if not self.names:
            return
        if strict:
            raise self.refuse(self.sentence())
        _log.warning("%s: not in %s: %s", place, self.title, self.sentence())


def _listed(names: list[str]) -> str:
    if not names:
        return ""
    more = f" and {len(names) - _SHOWN} more" if len(names) > _SHOWN else ""
    return f" ({', '.join(map(repr, names[:_SHOWN]))}{more})"
