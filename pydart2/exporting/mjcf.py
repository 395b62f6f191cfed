"""MJCF, as MuJoCo compiles it: bodies in bodies, each with the joints that move it."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

import numpy as np

from pydart2.exporting.losses import Losses
from pydart2.exporting.mjcf_cameras import add_cameras, add_mounted
from pydart2.exporting.mjcf_geoms import Assets, add_geom
from pydart2.exporting.mjcf_joints import add_joints, note_joint, pose_at_start
from pydart2.exporting.mjcf_masses import add_inertial, leader_of, settle_masses
from pydart2.exporting.numbers import Element, add, attributes, is_identity, text
from pydart2.exporting.parts import LinkPart, SkeletonPart, WorldPart
from pydart2.exporting.reshape import note_order, put_frames_at_joints, refuse_ground
from pydart2.exporting.shapes import note_surfaces

_HELD = {"gravity", "collidable", "self_collision", "pairs", "enforced", "cameras"}
_ALL = 0x7FFFFFFF  # bits of the groups that collide
_GROUPS = 30


@dataclass
class _File:
    """What the skeletons of a file share: its sections, and which names are taken."""

    losses: Losses
    world: Element
    contact: Element
    equality: Element
    assets: Assets
    taken: dict[str, set[str]] = field(default_factory=dict)
    names: dict[tuple[str, str], str] = field(default_factory=dict)
    elements: dict[int, Element] = field(default_factory=dict)  # id of the link → its body
    groups: int = 0

    def name(self, kind: str, name: str, skel: SkeletonPart) -> str:
        """A name that no other of the kind has in the file."""
        taken = self.taken.setdefault(kind, set())
        chosen = f"{skel.name}/{name}" if name in taken else name
        while chosen in taken:
            chosen += "_"
        if chosen != name and kind in ("body", "joint"):
            self.losses.add("names of bodies and joints that others have, now after their skeleton's", chosen)
        taken.add(chosen)
        return chosen


def root_of(skeletons: list[SkeletonPart], world: WorldPart | None, losses: Losses, folder: str | None) -> Element:
    """The file of a world, or of one skeleton."""
    root = Element("mujoco", model="world" if world else skeletons[0].name)
    add(root, "compiler", angle="radian", inertiafromgeom="false")
    assets = Assets(Element("asset"), folder, losses)
    file = _File(losses, Element("worldbody"), Element("contact"), Element("equality"), assets)
    if world is not None:
        add(root, "option", **attributes(timestep=world.time_step, gravity=world.gravity))
    for skel in skeletons:
        _skeleton(skel, file)
    add_cameras(file.world, world.cameras if world else (), file.names, losses)
    for skel in skeletons:
        add_mounted(skel, file.elements, file.names, losses)
    for one, two in world.pairs if world else ():
        add(file.contact, "exclude", body1=file.names[one], body2=file.names[two])
    root.extend(part for part in (assets.element, file.world, file.contact, file.equality) if len(part))
    return root


def _skeleton(skel: SkeletonPart, file: _File) -> None:
    losses = file.losses
    if not skel.links:
        raise losses.refuse(f"skeleton {skel.name!r} has no body")
    refuse_ground(skel, losses)
    put_frames_at_joints(skel, losses, _needs_frame)
    losses.add_skeleton(skel, _HELD)
    _note_skeleton(skel, losses)
    settle_masses(skel, losses)
    bits = _bits(skel, file)
    names: dict[str, str] = {}
    for link in skel.links:
        above = file.world if link.parent is None else file.elements[id(link.parent)]
        file.elements[id(link)] = body = _body(above, link, skel, file, names)
        _geoms(body, link, skel, file, bits)
        file.names[skel.name, link.name] = body.get("name", "")
    for link in skel.links:
        _follow(link, file, names)
    for one, two in skel.pairs:
        body1, body2 = (file.names[skel.name, name] for name in (one, two))
        add(file.contact, "exclude", body1=body1, body2=body2)


def _needs_frame(link: LinkPart) -> bool:
    """Free joints are at the link's frame, and ball joints count along its axes."""
    turned = bool((link.in_link[:3, :3] != np.eye(3)).any())
    return link.joint.kind == "free" or (link.joint.kind == "ball" and turned)


def _note_skeleton(skel: SkeletonPart, losses: Losses) -> None:
    roots = [link for link in skel.links if link.parent is None]
    if not any(link.joint.dofs for link in skel.links):
        losses.add("skeletons that cannot move, read as one that weighs nothing", skel.name)
    elif len(roots) > 1:
        losses.add("skeletons of several roots, read as one each", skel.name)
    elif not roots[0].joint.dofs:
        losses.add("bodies that are fixed to the world, read as one skeleton apart", roots[0].name)
    elif skel.name != roots[0].name:
        losses.add("names of skeletons that are not those of their roots", skel.name)
    note_order(skel, list(_depth_first(skel, None)), losses)


def _depth_first(skel: SkeletonPart, parent: LinkPart | None) -> Iterable[LinkPart]:
    for link in skel.links:
        if link.parent is parent:
            yield link
            yield from _depth_first(skel, link)


def _bits(skel: SkeletonPart, file: _File) -> dict[str, str]:
    """The groups of a skeleton's geoms: they collide with all, or if it does not with itself with all but one."""
    colliding = [link for link in skel.links if link.collidable and any(shape.collides for shape in link.shapes)]
    if len(colliding) < 2:
        return {}
    if skel.self_collision:
        for link in colliding if skel.adjacent else ():
            if link.parent in colliding and not _passes(skel, link):
                file.losses.add("that bodies collide with their parents", link.name)
        return {"contype": "1", "conaffinity": str(_ALL)}
    file.groups += 1
    if file.groups > _GROUPS:
        file.losses.add("that bodies of a skeleton pass through each other", skel.name)
        return {}
    bit = 1 << file.groups
    return {"contype": str(bit), "conaffinity": str(_ALL & ~bit)}


def _passes(skel: SkeletonPart, link: LinkPart) -> bool:
    return link.parent is not None and {link.name, link.parent.name} in [set(pair) for pair in skel.pairs]


def _body(above: Element, link: LinkPart, skel: SkeletonPart, file: _File, names: dict[str, str]) -> Element:
    body = add(above, "body", name=file.name("body", link.name, skel))
    if not link.gravity:
        body.set("gravcomp", "1")
    where = pose_at_start(link)
    if not is_identity(where):
        body.attrib.update(attributes(pos=where[:3, 3], xyaxes=where[:3, :2].T))
    note_joint(link, skel, file.losses)
    for dof, name, element in add_joints(body, link):
        names[dof] = file.name("joint", name, skel)
        element.set("name", names[dof])
    add_inertial(body, link)
    for name, point in link.markers:
        add(body, "site", name=file.name("site", name, skel), pos=text(point))
    return body


def _geoms(body: Element, link: LinkPart, skel: SkeletonPart, file: _File, bits: dict[str, str]) -> None:
    static = leader_of(link) is None
    for shape in link.shapes:
        if not shape.collides and not shape.drawn:
            continue
        geom = add_geom(body, link, shape, file.assets, static)
        if geom is None:
            continue
        geom.set("name", file.name("geom", shape.name, skel))
        if shape.collides and link.collidable:
            geom.attrib.update({**bits, "friction": text(shape.friction)})
        else:
            geom.attrib.update(contype="0", conaffinity="0")
    note_surfaces(link, file.losses, friction=True)


def _follow(link: LinkPart, file: _File, names: dict[str, str]) -> None:
    """The equality of a joint that follows another, between their positions from where both start."""
    joint, follows = link.joint, link.joint.follows
    if follows is None:
        return
    if not all(name in names for name in (*follows.dofs, *(dof.name for dof in joint.dofs))):
        file.losses.add("ball joints that follow others", joint.name)
        return
    for dof, (leader, start) in zip(joint.dofs, follows.starts.items(), strict=False):
        offset = follows.offset + follows.multiplier * start - dof.initial
        polynomial = text([offset, follows.multiplier, 0.0, 0.0, 0.0])
        add(file.equality, "joint", joint1=names[dof.name], joint2=names[leader], polycoef=polynomial)
