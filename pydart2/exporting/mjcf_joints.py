"""Joints of MJCF: hinges and slides of one body, one after another, from where its positions start."""

from __future__ import annotations

import math

import numpy as np

from pydart2.exporting.losses import Losses
from pydart2.exporting.numbers import Element, add, attributes, inverse, text
from pydart2.exporting.parts import Array, DofPart, JointPart, LinkPart, SkeletonPart
from pydart2.exporting.reshape import motions, rotation_of, start_of_free

_TYPES = {"revolute": "hinge", "prismatic": "slide"}
_HELD = {"lower", "upper", "initial", "stiffness", "damping", "friction", "armature"}


def _displacements(joint: JointPart) -> list[Array]:
    """What each joint of a chain does to reach its initial position, poses of shape (4, 4), m."""
    made = []
    for (kind, axis), dof in zip(motions(joint) or (), joint.dofs, strict=False):
        pose = np.eye(4)
        if kind == "revolute":
            pose[:3, :3] = rotation_of(axis * dof.initial)
        else:
            pose[:3, 3] = axis * dof.initial
        made.append(pose)
    return made


def pose_at_start(link: LinkPart) -> Array:
    """The pose in its parent at the initial positions, shape (4, 4), m."""
    pose = link.in_parent
    if link.joint.kind == "free":
        pose = pose @ start_of_free(link.joint)
    for displacement in _displacements(link.joint):
        pose = pose @ displacement
    where: Array = pose @ inverse(link.in_link)
    return where


def add_joints(body: Element, link: LinkPart) -> list[tuple[str, str, Element]]:
    """The joints of a body: each with the dof that it is, and the name that it is to have."""
    joint = link.joint
    if joint.kind == "free":
        return [("", joint.name, add(body, "freejoint"))]
    if joint.kind == "ball":
        ball = add(body, "joint", type="ball", pos=text(link.in_link[:3, 3]))
        _resistance(ball, joint.dofs[0])
        return [("", joint.name, ball)]
    chain, after, elements = motions(joint) or [], link.in_link, list[tuple[str, str, Element]]()
    # Axes are those at the start, so each is turned back by those of the joints after it.
    for (kind, axis), dof, displacement in reversed(list(zip(chain, joint.dofs, _displacements(joint), strict=True))):
        element = Element("joint", type=_TYPES[kind], axis=text(after[:3, :3] @ axis))
        if kind == "revolute":
            element.set("pos", text(after[:3, 3]))
        if dof.initial != 0.0:
            element.set("ref", text(dof.initial))
        _numbers(element, joint, dof)
        elements.append((dof.name, joint.name if len(chain) == 1 else dof.name, element))
        after = after @ inverse(displacement)
    elements.reverse()
    body.extend(element for *_, element in elements)
    return elements


def _resistance(element: Element, dof: DofPart) -> None:
    for name, value in (("damping", dof.damping), ("armature", dof.armature), ("frictionloss", dof.friction)):
        if value != 0.0:
            element.set(name, text(value))


def _numbers(element: Element, joint: JointPart, dof: DofPart) -> None:
    _resistance(element, dof)
    limited = joint.enforced and math.isfinite(dof.lower) and math.isfinite(dof.upper)
    element.set("limited", "true" if limited else "false")
    if limited:
        element.attrib.update(attributes(range=[dof.lower, dof.upper]))
    if dof.stiffness != 0.0:
        element.attrib.update(attributes(stiffness=dof.stiffness, springref=dof.rest))


def note_joint(link: LinkPart, skel: SkeletonPart, losses: Losses) -> None:
    """Refuse joints that there are not, and note what the numbers of the others do not come back as."""
    joint = link.joint
    if joint.kind == "free" and link.parent is not None:
        raise losses.refuse(f"joint {joint.name!r} of {skel.name!r} is free and not that of a root")
    if joint.kind not in ("free", "ball", "weld") and motions(joint) is None:
        raise losses.refuse(f"joint {joint.name!r} of {skel.name!r} is of the kind {joint.kind!r}")
    if joint.actuator not in ("FORCE", "MIMIC"):
        losses.add("actuators that are no forces", joint.name)
    if joint.kind == "weld":
        return
    if joint.kind == "free":
        if (link.in_parent != np.eye(4)).any():
            losses.add("where the positions of free roots count from, now the origin", link.name)
        losses.add_dofs(joint, {"initial"})
    elif joint.kind == "ball":
        same = all((dof.damping, dof.armature, dof.friction) == _resists(joint.dofs[0]) for dof in joint.dofs)
        losses.add_dofs(joint, {"damping", "armature", "friction"} if same else ())
    else:
        losses.add_dofs(joint, _HELD)
        _note_limits(joint, losses)
    if joint.kind != "ball" and joint.kind != "free" and len(joint.dofs) > 1:
        losses.add("joints of several dofs, now several joints", joint.name)
    if len(joint.dofs) == 1:
        losses.add_names(joint, [joint.name])


def _resists(dof: DofPart) -> tuple[float, float, float]:
    return dof.damping, dof.armature, dof.friction


def _note_limits(joint: JointPart, losses: Losses) -> None:
    for dof in joint.dofs:
        finite = math.isfinite(dof.lower), math.isfinite(dof.upper)
        if any(finite) and not joint.enforced:
            losses.add("position limits that are not enforced", dof.name)
        elif any(finite) and not all(finite):
            losses.add("position limits on one side", dof.name)
