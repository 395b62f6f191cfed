"""What a URDF link without ``<inertial>`` weighs: nothing, unless the motion would then have no answer.

The engine and Bullet give each such link 1 kg and 1 kg m², Pinocchio nothing. Most are frames (of a tool, of a camera)
on fixed joints: they add no mass here. A joint that moves no mass has no acceleration, so a link that moves keeps the
engine's where the bodies with mass in its subtree are too few for the joints there, six coordinates to a body.
"""

from __future__ import annotations

import contextlib
from collections.abc import Iterator

from pydart2.loading.xml import Document, Element

_NOTHING = b'<inertial><mass value="0"/><inertia ixx="0" ixy="0" ixz="0" iyy="0" iyz="0" izz="0"/></inertial>'
_DOFS = {"fixed": 0, "planar": 3, "floating": 6}  # any other: 1
_GROUND = "world"  # a root of this name is no body


class _Tree:
    """The links of a robot by name, each after its parent; without those in a circle, which the engine refuses."""

    def __init__(self, robot: Element) -> None:
        self.links = {link.get("@name") or "": link for link in robot.children if link.tag == "link"}
        self.parent: dict[str, str] = {}
        self.dofs = {name: 0 if name == _GROUND else 6 for name in self.links}
        children: dict[str, list[str]] = {name: [] for name in self.links}
        for joint in (child for child in robot.children if child.tag == "joint"):
            parent, child = (joint.find(end) for end in ("parent", "child"))
            above, below = (end.get("@link") or "" if end else "" for end in (parent, child))
            if above in children and below in children and below not in self.parent:
                self.parent[below] = above
                self.dofs[below] = _DOFS.get(joint.get("@type") or "", 1)
                children[above].append(below)
        self.order = [name for name in self.links if name not in self.parent]
        for name in self.order:  # which grows
            self.order += children[name]

    def that_cannot_weigh_nothing(self) -> Iterator[str]:
        """The links that move with too little mass in their subtrees, each of which counts with what is fixed to it."""
        heavy = {name: _mass(self.links[name]) > 0.0 for name in self.order}
        dofs, bodies = dict.fromkeys(self.order, 0), dict.fromkeys(self.order, 0)
        for name in reversed(self.order):
            own = self.dofs[name]
            dofs[name] += own
            bodies[name] += own > 0 and heavy[name]
            if own > 0 and 6 * bodies[name] < dofs[name]:
                yield name
            if name in self.parent:
                parent = self.parent[name]
                dofs[parent] += dofs[name]
                bodies[parent] += bodies[name]
                heavy[parent] |= heavy[name] and own == 0


def _mass(link: Element) -> float:
    """What a link states, kg; 0 if nothing."""
    mass = link.find("inertial", "mass")
    with contextlib.suppress(ValueError):
        return float(mass.get("@value") or 0.0) if mass else 0.0
    return 0.0


def settle_masses(document: Document, massless: bool) -> list[Element]:
    """Let the links without ``<inertial>`` weigh nothing; those that keep the engine's 1 kg are returned.

    With `massless` none keeps it, and what moves no mass can be posed but not stepped.
    """
    tree = _Tree(document.root)
    needed = set() if massless else set(tree.that_cannot_weigh_nothing())
    kept = []
    for name in tree.order:
        link = tree.links[name]
        if link.find("inertial", "mass") is not None or name == _GROUND:
            continue
        if name in needed:
            kept.append(link)
        else:
            document.append(link, _NOTHING)
    return kept
