"""SDF 1.6, as the engine reads it."""

from __future__ import annotations

from pathlib import Path

from pydart2.exporting.losses import Losses
from pydart2.exporting.numbers import Element, add, add_nonzero, fixed_angles, is_identity, moments, text
from pydart2.exporting.parts import Array, DofPart, JointPart, LinkPart, ShapePart, SkeletonPart, WorldPart
from pydart2.exporting.reshape import (
    GROUND,
    note_order,
    put_frames_at_joints,
    refuse_ground,
    split_joints,
    start_free_root,
    start_of,
    world_poses,
)
from pydart2.exporting.shapes import Use, mesh_file, mesh_scale, note_surfaces, uses

_TYPES = {
    "weld": "fixed",
    **{kind: kind for kind in ("revolute", "prismatic", "screw", "universal", "ball")},
}
_SHAPES = ("box", "sphere", "cylinder", "mesh")
_HELD = {"lower", "upper", "stiffness", "damping", "friction"}
_ROOT = "root"  # what readers call the joint of a root without one


def root_of(skeletons: list[SkeletonPart], world: WorldPart | None, losses: Losses, folder: str | None) -> Element:
    """The file of a world, or of one skeleton."""
    root = Element("sdf", version="1.6")
    home = root if world is None else add(root, "world", name="world")
    if world is not None:
        add(home, "gravity", text(world.gravity))
        add(add(home, "physics", type="dart"), "max_step_size", text(world.time_step))
        if world.detector != "fcl":
            losses.add("the collision detector", world.detector)
        losses.add_world(world)
    for skel in skeletons:
        _model(home, skel, losses, folder)
    return root


def _model(home: Element, skel: SkeletonPart, losses: Losses, folder: str | None) -> None:
    model = add(home, "model", name=skel.name)
    if not skel.links:
        raise losses.refuse(f"skeleton {skel.name!r} has no body")
    refuse_ground(skel, losses)
    if not skel.mobile:
        add(model, "static", "true")
    losses.add_skeleton(skel, {"mobile", "gravity"})
    split_joints(skel, {*_TYPES, "free"}, losses)
    put_frames_at_joints(skel, losses, lambda link: link.joint.kind == "free")
    for link in skel.links:
        if link.joint.kind == "free":
            if link.parent is not None:
                raise losses.refuse(f"joint {link.joint.name!r} of {skel.name!r} is free and not that of a root")
            start_free_root(link, losses)
    poses = world_poses(skel)
    for link in skel.links:
        _link(model, link, poses[id(link)], losses, folder)
    for link in skel.links:
        _joint(model, link, losses)
    note_order(skel, _as_read(skel), losses)


def _as_read(skel: SkeletonPart) -> list[LinkPart]:
    """The links in the order that the engine gives them: by name, each after those above it."""
    order: dict[int, LinkPart] = {}
    for link in sorted(skel.links, key=lambda link: link.name.encode()):
        path: list[LinkPart] = []
        above: LinkPart | None = link
        while above is not None and id(above) not in order:
            path.append(above)
            above = above.parent
        order.update((id(one), one) for one in reversed(path))
    return list(order.values())


def _pose(parent: Element, pose: Array) -> None:
    if not is_identity(pose):
        add(parent, "pose", text([*pose[:3, 3], *fixed_angles(pose[:3, :3])]))


def _link(model: Element, link: LinkPart, pose: Array, losses: Losses, folder: str | None) -> None:
    element = add(model, "link", name=link.name)
    if not link.gravity:
        add(element, "gravity", "false")
    _pose(element, pose)
    inertial = add(element, "inertial")
    add(inertial, "mass", text(link.mass))
    if link.com.any():
        add(inertial, "pose", text([*link.com, 0.0, 0.0, 0.0]))
    inertia = add(inertial, "inertia")
    for name, moment in moments(link.inertia).items():
        add(inertia, name, text(moment))
    for use in uses(link, _SHAPES, losses):
        _shape(element, link, use, losses, folder)
    note_surfaces(link, losses)
    for name, _ in link.markers:
        losses.add("markers", name)


def _shape(element: Element, link: LinkPart, use: Use, losses: Losses, folder: str | None) -> None:
    shape = use.shape
    name = use.name.removeprefix(f"{link.name} - ")  # which readers put before it
    node = add(element, "collision" if use.collides else "visual", name=name)
    _pose(node, shape.pose)
    _geometry(add(node, "geometry"), shape, losses, folder)
    if not use.collides and shape.rgba is not None and shape.rgba.size:
        if shape.kind == "mesh":
            losses.add("that a mesh has one colour", shape.name)
        material = add(node, "material")
        for light in ("ambient", "diffuse"):
            add(material, light, text(shape.rgba))


def _geometry(geometry: Element, shape: ShapePart, losses: Losses, folder: str | None) -> None:
    element = add(geometry, shape.kind)
    if shape.kind == "mesh":
        path = mesh_file(shape, folder, losses)
        add(element, "uri", Path(path).as_uri() if path.startswith("/") else path)
        add(element, "scale", text(mesh_scale(shape)))
        return
    for name, numbers in shape.sizes.items():
        add(element, "length" if name == "height" else name, text(numbers))


def _joint(model: Element, link: LinkPart, losses: Losses) -> None:
    joint = link.joint
    if joint.actuator == "MIMIC":
        losses.add("joints that follow others", joint.name)
    elif joint.actuator != "FORCE":
        losses.add("actuators that are no forces", joint.name)
    if joint.kind == "free":
        if joint.name != _ROOT:
            losses.add("names of the joints of free roots", joint.name)
        losses.add_dofs(joint, ())
        return
    element = add(model, "joint", name=joint.name, type=_TYPES[joint.kind])
    add(element, "parent", link.parent.name if link.parent else GROUND)
    add(element, "child", link.name)
    _pose(element, link.in_link)
    if joint.kind == "screw":
        add(element, "thread_pitch", text(joint.pitch))
    for tag, axis, dof in zip(("axis", "axis2"), joint.axes, joint.dofs, strict=False):
        child = add(element, tag)
        add(child, "xyz", text(axis))
        _numbers(child, dof)
    _note(joint, losses)


def _numbers(axis: Element, dof: DofPart) -> None:
    limit = add(axis, "limit")
    add(limit, "lower", text(dof.lower))
    add(limit, "upper", text(dof.upper))
    dynamics = Element("dynamics")
    values = {
        "damping": dof.damping,
        "friction": dof.friction,
        "spring_reference": dof.rest,
        "spring_stiffness": dof.stiffness,
    }
    add_nonzero(dynamics, values)
    if len(dynamics):
        axis.append(dynamics)


def _note(joint: JointPart, losses: Losses) -> None:
    """Note what the numbers of a joint do not come back as."""
    if not joint.axes:
        losses.add_dofs(joint, ())
        return
    losses.add_dofs(joint, {*_HELD, "initial"})
    losses.add_names(joint, [joint.name] if len(joint.axes) == 1 else [f"{joint.name}_1", f"{joint.name}_2"])
    for dof in joint.dofs:
        start = start_of(dof)
        if dof.initial != start:
            losses.add("initial positions", dof.name)
        if start != 0.0 and dof.stiffness != 0.0 and dof.rest != start:
            losses.add("where springs rest", dof.name)
