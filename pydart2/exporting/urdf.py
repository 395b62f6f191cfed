"""URDF: one robot, its links at their joints."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np

from pydart2.exporting.losses import Losses
from pydart2.exporting.numbers import Element, add, attributes, fixed_angles, is_identity, moments, text
from pydart2.exporting.parts import Array, DofPart, JointPart, LinkPart, ShapePart, SkeletonPart, WorldPart
from pydart2.exporting.reshape import GROUND, note_order, put_frames_at_joints, refuse_ground, split_joints, start_of
from pydart2.exporting.shapes import Use, mesh_file, mesh_scale, note_surfaces, uses
from pydart2.loading.mending import infinite_limit

_TYPES = {"weld": "fixed", "revolute": "revolute", "prismatic": "prismatic", "free": "floating", "planar": "planar"}
_FREE_ROOT = "rootJoint"  # of which the engine makes the joint of a root without one
_SHAPES = ("box", "sphere", "cylinder", "capsule", "mesh")


def root_of(skeletons: list[SkeletonPart], world: WorldPart | None, losses: Losses, folder: str | None) -> Element:
    """The file of a skeleton."""
    if world is not None or len(skeletons) != 1:
        raise losses.refuse("a world; save its skeletons one by one")
    skel = skeletons[0]
    root = Element("robot", name=skel.name)
    if not skel.links:
        raise losses.refuse(f"skeleton {skel.name!r} has no body")
    refuse_ground(skel, losses)
    losses.add_skeleton(skel, ())
    split_joints(skel, _TYPES, losses)
    for link in skel.links:
        if link.joint.kind == "planar":
            _turn_to_xy(link)
    put_frames_at_joints(skel, losses, lambda link: True)
    implied = _is_implied(skel)
    if implied:
        _note_free_root(skel.links[0], losses)
    else:
        add(root, "link", name=GROUND)
    for link in skel.links:
        _link(root, link, losses, folder)
    for link in skel.links:
        if link.parent is not None or not implied:
            _joint(root, link, losses)
    note_order(skel, _as_read(skel), losses)
    return root


def _is_implied(skel: SkeletonPart) -> bool:
    """Whether there is one root and it is free: a link without a joint, which readers let float."""
    first, *others = (link for link in skel.links if link.parent is None)
    return first.joint.kind == "free" and not others


def _note_free_root(root: LinkPart, losses: Losses) -> None:
    if root.joint.name != _FREE_ROOT:
        losses.add("names of the joints of free roots", root.joint.name)
    if not is_identity(root.in_parent):
        losses.add("where the positions of free roots count from, now the origin", root.name)
    losses.add_dofs(root.joint, ())


def _turn_to_xy(link: LinkPart) -> None:
    """Let a planar joint move in the plane of its x and y, as the engine reads it."""
    frame = np.eye(4)
    frame[:3, :3] = np.column_stack([*link.joint.axes, np.cross(link.joint.axes[0], link.joint.axes[1])])
    if not is_identity(frame):
        link.in_parent, link.in_link = link.in_parent @ frame, link.in_link @ frame
        link.joint.axes = list(np.eye(3)[:2])


def _as_read(skel: SkeletonPart) -> list[LinkPart]:
    """The links in the order that readers give them: each before its children, these by the names of their joints."""
    children: dict[int, list[LinkPart]] = {}
    for link in sorted(skel.links, key=lambda link: link.joint.name):
        children.setdefault(id(link.parent), []).append(link)
    order: list[LinkPart] = []
    waiting = children[id(None)][::-1]
    while waiting:
        order.append(waiting.pop())
        waiting += children.get(id(order[-1]), [])[::-1]
    return order


def _origin(parent: Element, pose: Array) -> None:
    if not is_identity(pose):
        add(parent, "origin", **attributes(xyz=pose[:3, 3], rpy=fixed_angles(pose[:3, :3])))


def _link(root: Element, link: LinkPart, losses: Losses, folder: str | None) -> None:
    element = add(root, "link", name=link.name)
    inertial = add(element, "inertial")
    if link.com.any():
        add(inertial, "origin", **attributes(xyz=link.com))
    add(inertial, "mass", **attributes(value=link.mass))
    add(inertial, "inertia", **attributes(**moments(link.inertia)))
    for use in uses(link, _SHAPES, losses):
        _shape(element, use, losses, folder)
    note_surfaces(link, losses)
    for name, _ in link.markers:
        losses.add("markers", name)


def _shape(link: Element, use: Use, losses: Losses, folder: str | None) -> None:
    shape = use.shape
    element = add(link, "collision" if use.collides else "visual", name=use.name)
    _origin(element, shape.pose)
    _geometry(add(element, "geometry"), shape, losses, folder)
    if not use.collides and shape.rgba is not None and shape.rgba.size:
        add(add(element, "material", name=f"{link.get('name')}/{use.name}"), "color", rgba=text(shape.rgba))


def _geometry(geometry: Element, shape: ShapePart, losses: Losses, folder: str | None) -> None:
    if shape.kind == "mesh":
        path = mesh_file(shape, folder, losses)
        uri = Path(path).as_uri() if path.startswith("/") else path
        add(geometry, "mesh", filename=uri, scale=text(mesh_scale(shape)))
    elif shape.kind in ("cylinder", "capsule"):
        sizes = {"radius": shape.sizes["radius"], "length": shape.sizes["height"]}
        add(geometry, shape.kind, **attributes(**sizes))
        if shape.kind == "capsule":
            losses.add("capsules, read as a cylinder and two spheres", shape.name)
    else:
        add(geometry, shape.kind, **attributes(**shape.sizes))


def _joint(root: Element, link: LinkPart, losses: Losses) -> None:
    joint = link.joint
    if joint.kind == "free":
        losses.add("free joints, which other readers may take for fixed", joint.name)
    one = joint.kind in ("revolute", "prismatic")
    endless = joint.kind == "revolute" and (joint.dofs[0].lower, joint.dofs[0].upper) == (-math.inf, math.inf)
    element = add(root, "joint", name=joint.name, type="continuous" if endless else _TYPES[joint.kind])
    _origin(element, link.in_parent)
    add(element, "parent", link=link.parent.name if link.parent else GROUND)
    add(element, "child", link=link.name)
    if joint.kind == "planar":
        add(element, "axis", xyz="0 0 1")
        losses.add_names(joint, [f"{joint.name}_x", f"{joint.name}_y", "default"])  # as the engine names them
    if one:
        add(element, "axis", xyz=text(joint.axes[0]))
        _numbers(element, joint, joint.dofs[0], endless, losses)
    else:
        losses.add_dofs(joint, ())
    if joint.follows is not None and one:
        follows = joint.follows
        numbers = attributes(multiplier=follows.multiplier, offset=follows.offset)
        add(element, "mimic", joint=follows.leader, **numbers)
    elif joint.actuator != "FORCE":
        losses.add("actuators that are no forces", joint.name)


def _numbers(element: Element, joint: JointPart, dof: DofPart, endless: bool, losses: Losses) -> None:
    """Limits, damping and friction of a joint with one dof."""
    held = {"lower", "upper", "velocity_lower", "velocity_upper", "force_lower", "force_upper", "damping", "friction"}
    for kind in ("velocity", "force"):
        lower, upper = getattr(dof, f"{kind}_lower"), getattr(dof, f"{kind}_upper")
        if lower != -upper:
            losses.add(f"{kind} limits that are not the same both ways", dof.name)
    if dof.initial != start_of(dof):
        losses.add("initial positions", dof.name)
    losses.add_dofs(joint, {*held, "initial"})
    losses.add_names(joint, [joint.name])
    values = {"effort": dof.force_upper, "velocity": dof.velocity_upper}
    if not endless:
        values = {"lower": dof.lower, "upper": dof.upper, **values}
    if not endless or any(map(math.isfinite, values.values())):
        add(element, "limit", **{name: _bounded(value) for name, value in values.items()})
    if dof.damping or dof.friction:
        add(element, "dynamics", **attributes(damping=dof.damping, friction=dof.friction))


def _bounded(value: float) -> str:
    return text(value) if math.isfinite(value) else infinite_limit(value)
