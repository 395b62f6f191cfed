"""SKEL, the engine's own format."""

from __future__ import annotations

import math

from pydart2.exporting.losses import Losses
from pydart2.exporting.numbers import Element, add, add_nonzero, attributes, is_identity, moments, moving_angles, text
from pydart2.exporting.parts import Array, DofPart, JointPart, LinkPart, ShapePart, SkeletonPart, WorldPart
from pydart2.exporting.reshape import split_joints, world_poses
from pydart2.exporting.shapes import mesh_file, mesh_scale, note_surfaces, uses

_JOINTS = ("weld", "prismatic", "revolute", "universal", "ball", "euler", "translational", "planar", "free")
_SHAPES = (
    *("sphere", "box", "ellipsoid", "cylinder", "capsule", "cone", "pyramid"),
    *("plane", "multi_sphere", "mesh"),
)
_DETECTORS = {"fcl": "fcl_mesh", "dart": "dart", "bullet": "bullet", "ode": "ode"}
#: What the engine adds to a joint's name for its dofs.
_SUFFIXES = {
    "universal": ("_1", "_2"),
    "ball": ("_x", "_y", "_z"),
    "translational": ("_x", "_y", "_z"),
    "free": ("_rot_x", "_rot_y", "_rot_z", "_pos_x", "_pos_y", "_pos_z"),
}


def root_of(skeletons: list[SkeletonPart], world: WorldPart | None, losses: Losses, folder: str | None) -> Element:
    """The file of a world, or of one skeleton."""
    root = Element("skel", version="1.0")
    home = root if world is None else add(root, "world", name="world")
    if world is not None:
        physics = add(home, "physics")
        add(physics, "time_step", text(world.time_step))
        add(physics, "gravity", text(world.gravity))
        if world.detector in _DETECTORS:
            add(physics, "collision_detector", _DETECTORS[world.detector])
        else:
            losses.add("the collision detector", world.detector)
        losses.add_world(world)
    for skel in skeletons:
        _skeleton(home, skel, losses, folder)
    return root


def _skeleton(home: Element, skel: SkeletonPart, losses: Losses, folder: str | None) -> None:
    element = add(home, "skeleton", name=skel.name)
    if not skel.links:
        raise losses.refuse(f"skeleton {skel.name!r} has no body")
    if not skel.mobile:
        add(element, "mobile", "false")
    losses.add_skeleton(skel, {"mobile", "gravity"})
    split_joints(skel, _JOINTS, losses)
    poses = world_poses(skel)
    for link in skel.links:
        _body(element, link, poses[id(link)], losses, folder)
    for link in skel.links:
        _joint(element, link, losses)


def _pose(parent: Element, pose: Array) -> None:
    if not is_identity(pose):
        add(parent, "transformation", text([*pose[:3, 3], *moving_angles(pose[:3, :3])]))


def _body(skeleton: Element, link: LinkPart, pose: Array, losses: Losses, folder: str | None) -> None:
    body = add(skeleton, "body", name=link.name)
    if not link.gravity:
        add(body, "gravity", "false")
    _pose(body, pose)
    inertia = add(body, "inertia")
    add(inertia, "mass", text(link.mass))
    matrix = add(inertia, "moment_of_inertia")
    for name, moment in moments(link.inertia).items():
        add(matrix, name, text(moment))
    if link.com.any():
        add(inertia, "offset", text(link.com))
    for use in uses(link, _SHAPES, losses):
        _shape(body, use.shape, use.collides, losses, folder)
    note_surfaces(link, losses)
    for name, point in link.markers:
        add(add(body, "marker", name=name), "offset", text(point))


def _shape(body: Element, shape: ShapePart, collides: bool, losses: Losses, folder: str | None) -> None:
    node = add(body, "collision_shape" if collides else "visualization_shape")
    _pose(node, shape.pose)
    _geometry(add(node, "geometry"), shape, losses, folder)
    if not collides and shape.rgba is not None and shape.rgba.size:
        if shape.kind == "mesh":
            losses.add("that a mesh has one colour", shape.name)
        add(node, "color", text(shape.rgba))


def _geometry(geometry: Element, shape: ShapePart, losses: Losses, folder: str | None) -> None:
    element = add(geometry, shape.kind)
    if shape.kind == "mesh":
        add(element, "file_name", mesh_file(shape, folder, losses))
        add(element, "scale", text(mesh_scale(shape)))
    elif shape.kind == "multi_sphere":
        for radius, *centre in shape.sizes["spheres"]:
            sphere = add(element, "sphere")
            add(sphere, "radius", text(radius))
            add(sphere, "position", text(centre))
    else:
        for name, numbers in shape.sizes.items():
            add(element, name, text(numbers))


def _joint(skeleton: Element, link: LinkPart, losses: Losses) -> None:
    joint = link.joint
    element = add(skeleton, "joint", type=joint.kind, name=joint.name)
    if joint.actuator == "MIMIC":
        losses.add("joints that follow others", joint.name)
    elif joint.actuator != "FORCE":
        element.set("actuator", joint.actuator.lower())
    add(element, "parent", link.parent.name if link.parent else "world")
    add(element, "child", link.name)
    _pose(element, link.in_link)
    if joint.kind == "euler":
        add(element, "axis_order", joint.order.lower())
    elif joint.kind == "planar":
        plane = add(element, "plane", type="arbitrary")
        for i, axis in enumerate(joint.axes, 1):
            add(add(plane, f"translation_axis{i}"), "xyz", text(axis))
    else:
        for tag, axis in zip(("axis", "axis2"), joint.axes, strict=False):
            add(add(element, tag), "xyz", text(axis))
    losses.add_dofs(joint, set(DofPart.__dataclass_fields__) - {"armature"})
    for i, dof in enumerate(joint.dofs):
        _dof(element, joint, dof, i)


def _dof(element: Element, joint: JointPart, dof: DofPart, index: int) -> None:
    """The numbers that are not those of a dof about which nothing is said."""
    part = Element("dof", local_index=str(index))
    if dof.name != joint.name + (_SUFFIXES[joint.kind][index] if joint.kind in _SUFFIXES else ""):
        part.set("name", dof.name)
    ranges = {
        "position": {"lower": dof.lower, "upper": dof.upper, "initial": dof.initial},
        "velocity": {"lower": dof.velocity_lower, "upper": dof.velocity_upper, "initial": dof.initial_velocity},
        "force": {"lower": dof.force_lower, "upper": dof.force_upper},
    }
    for tag, values in ranges.items():
        told = {
            name: value for name, value in values.items() if math.isfinite(value) and (name, value) != ("initial", 0)
        }
        if told:
            add(part, tag, **attributes(**told))
    values = {
        "damping": dof.damping,
        "friction": dof.friction,
        "spring_rest_position": dof.rest,
        "spring_stiffness": dof.stiffness,
    }
    add_nonzero(part, values)
    if len(part) or "name" in part.attrib:
        element.append(part)
