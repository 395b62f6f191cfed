"""The same motion in other parts: joints as chains, frames of links at their joints."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection
from dataclasses import replace

import numpy as np

from pydart2.exporting.losses import Losses
from pydart2.exporting.numbers import inverse, is_identity
from pydart2.exporting.parts import Array, DofPart, JointPart, LinkPart, ShapePart, SkeletonPart

#: What a root on a joint hangs from; no body.
GROUND = "world"
_X, _Y, _Z = np.eye(3)
_ON_AXIS = 1e-14  # m


def motions(joint: JointPart) -> list[tuple[str, Array]] | None:
    """A joint as revolute and prismatic ones with their unit axes, shape (3,), 1, one after another with the same q.

    None if it is no such chain.
    """
    if joint.kind in ("revolute", "prismatic"):
        return [(joint.kind, joint.axes[0])]
    if joint.kind == "universal":
        return [("revolute", axis) for axis in joint.axes]
    if joint.kind == "euler":
        axes = {"X": _X, "Y": _Y, "Z": _Z}
        return [("revolute", axes[letter]) for letter in joint.order]
    if joint.kind == "translational":
        return [("prismatic", axis) for axis in (_X, _Y, _Z)]
    if joint.kind == "translational2d":
        return [("prismatic", axis) for axis in joint.axes]
    if joint.kind == "planar":
        return [*(("prismatic", axis) for axis in joint.axes), ("revolute", np.cross(joint.axes[0], joint.axes[1]))]
    return None


def split_joints(skel: SkeletonPart, held: Collection[str], losses: Losses) -> None:
    """Make chains, by links without mass, of the joints of kinds that are not held; ExportError for others."""
    links: list[LinkPart] = []
    for link in skel.links:
        if link.joint.kind in held:
            links.append(link)
            continue
        chain = motions(link.joint)
        if chain is None:
            raise losses.refuse(f"joint {link.joint.name!r} of {skel.name!r} is of the kind {link.joint.kind!r}")
        losses.add("joints of several dofs, now chains", link.joint.name)
        links += _chain(link, chain)
    skel.links = links
    for names in ([link.name for link in links], [link.joint.name for link in links]):
        if twice := [name for name in names if names.count(name) > 1]:
            raise losses.refuse(f"{twice[0]!r} of {skel.name!r} would be the name of two, as joints are chains there")


def _chain(link: LinkPart, chain: list[tuple[str, Array]]) -> list[LinkPart]:
    """The links of a chain; the last of them is the link itself."""
    joint, above, new = link.joint, link.parent, list[LinkPart]()
    for i, ((kind, axis), dof) in enumerate(zip(chain, joint.dofs, strict=True)):
        follows = replace(joint.follows, leader=joint.follows.dofs[i]) if joint.follows else None
        part = replace(joint, name=dof.name, kind=kind, dofs=[dof], axes=[axis], order="", follows=follows)
        in_parent = link.in_parent if i == 0 else np.eye(4)
        if i == len(chain) - 1:
            link.joint, link.parent, link.in_parent = part, above, in_parent
            above = link
        else:
            name = f"{link.name}/{dof.name}"
            above = LinkPart(name, above, part, in_parent, np.eye(4), 0.0, np.zeros(3), np.zeros((3, 3)))
        new.append(above)
    return new


def put_frames_at_joints(skel: SkeletonPart, losses: Losses, needs: Callable[[LinkPart], bool]) -> None:
    """Give the links that need it the frame of their joint, if no turned axis does it."""
    for link in skel.links:
        if needs(link) and not is_identity(link.in_link) and not _turn_axes(link):
            losses.add("frames of links apart from their joints, now at them", link.name)
            _move_frame(skel, link, losses)


def _turn_axes(link: LinkPart) -> bool:
    """Let the joint have the axes of the link, which stays where it is, if that is the same motion."""
    turn, offset = link.in_link[:3, :3], link.in_link[:3, 3]
    joint = link.joint
    axes = [turn @ axis for axis in joint.axes]
    if joint.kind in ("revolute", "screw"):
        if math.dist(offset, (offset @ axes[0]) * axes[0]) > _ON_AXIS:
            return False
    elif joint.kind not in ("weld", "prismatic", "translational2d"):
        return False
    joint.axes = axes
    link.in_parent, link.in_link = link.in_parent @ inverse(link.in_link), np.eye(4)
    return True


def _move_frame(skel: SkeletonPart, link: LinkPart, losses: Losses) -> None:
    """Let the link's frame be that of its joint."""
    back = inverse(link.in_link)
    turn = back[:3, :3]
    link.com = _point(back, link.com)
    link.inertia = turn @ link.inertia @ turn.T
    link.shapes = [_placed(shape, back) for shape in link.shapes]
    link.markers = [(name, _point(back, point)) for name, point in link.markers]
    losses.add_cameras(camera for camera in link.cameras if camera.mode == "track")  # from an origin that is no more
    link.cameras = [
        camera if camera.mode == "trackcom" else replace(camera, pose=back @ camera.pose)
        for camera in link.cameras
        if camera.mode != "track"
    ]
    for child in skel.links:
        if child.parent is link:
            child.in_parent = back @ child.in_parent
    link.in_link = np.eye(4)


def _point(pose: Array, point: Array) -> Array:
    moved: Array = pose[:3, :3] @ point + pose[:3, 3]
    return moved


def _placed(shape: ShapePart, pose: Array) -> ShapePart:
    return replace(shape, pose=pose @ shape.pose)


def start_of_free(joint: JointPart) -> Array:
    """The motion of a free joint at its initial positions, shape (4, 4), m: a rotation vector, then a translation."""
    vector, place = np.split(np.array([dof.initial for dof in joint.dofs]), 2)
    motion = np.eye(4)
    motion[:3, :3], motion[:3, 3] = rotation_of(vector), place
    return motion


def rotation_of(vector: Array) -> Array:
    """The matrix, shape (3, 3), of an axis times an angle, shape (3,), rad."""
    angle = float(np.linalg.norm(vector))
    if angle == 0.0:
        return np.eye(3)
    x, y, z = vector / angle
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    matrix: Array = np.eye(3) + math.sin(angle) * cross + (1.0 - math.cos(angle)) * cross @ cross
    return matrix


def start_free_root(link: LinkPart, losses: Losses) -> None:
    """Let a free root's positions count from where it starts."""
    if any(dof.initial for dof in link.joint.dofs):
        losses.add("where the positions of free roots count from, now where they start", link.name)
        link.in_parent = link.in_parent @ start_of_free(link.joint)
        for dof in link.joint.dofs:
            dof.initial = 0.0


def world_poses(skel: SkeletonPart) -> dict[int, Array]:
    """id of the link → its pose where all dofs are 0, shape (4, 4), m."""
    poses: dict[int, Array] = {}
    for link in skel.links:
        above = poses[id(link.parent)] if link.parent is not None else np.eye(4)
        poses[id(link)] = above @ link.in_parent @ inverse(link.in_link)
    return poses


def start_of(dof: DofPart) -> float:
    """Where readers of URDF and SDF let a dof start: at 0, or if that is out of its limits, between them."""
    if dof.lower <= 0.0 <= dof.upper:
        return 0.0
    if math.isfinite(dof.lower) and math.isfinite(dof.upper):
        return (dof.lower + dof.upper) / 2.0
    return dof.lower if math.isfinite(dof.lower) else dof.upper


def refuse_ground(skel: SkeletonPart, losses: Losses) -> None:
    """ExportError for a body that has the name of the ground."""
    if any(link.name == GROUND for link in skel.links):
        raise losses.refuse(f"a body {GROUND!r} of {skel.name!r}, which is the ground there")


def note_order(skel: SkeletonPart, order: list[LinkPart], losses: Losses) -> None:
    """Note it if a reader's order of the dofs is another one."""
    theirs = [dof.name for link in order for dof in link.joint.dofs]
    if theirs != [dof.name for link in skel.links for dof in link.joint.dofs]:
        losses.add("the order of the dofs", skel.name)
