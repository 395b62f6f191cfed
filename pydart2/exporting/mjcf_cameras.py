"""Cameras of MJCF, which has them in their bodies, where these start."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import replace

import numpy as np

from pydart2.exporting.losses import Losses
from pydart2.exporting.mjcf_joints import pose_at_start
from pydart2.exporting.numbers import Element, add, attributes
from pydart2.exporting.parts import Array, CameraPart, LinkPart, SkeletonPart

_Names = Mapping[tuple[str, str], str]


def add_cameras(body: Element, cameras: Iterable[CameraPart], names: _Names, losses: Losses) -> None:
    """Cameras with their poses in a body, or in the world."""
    for camera in cameras:
        if camera.target is not None and camera.target not in names:
            losses.add("cameras that look at what is not in the file", camera.name)
            continue
        element = add(body, "camera", name=camera.name, mode=camera.mode)
        element.attrib.update(
            attributes(pos=camera.pose[:3, 3], xyaxes=camera.pose[:3, :2].T, fovy=math.degrees(camera.fov))
        )
        if camera.target is not None:
            element.set("target", names[camera.target])


def add_mounted(skel: SkeletonPart, bodies: Mapping[int, Element], names: _Names, losses: Losses) -> None:
    """The cameras on the bodies of a skeleton; `bodies` by the id of their link."""
    if not any(link.cameras for link in skel.links):
        return
    poses: dict[int, Array] = {}
    for link in skel.links:
        above = np.eye(4) if link.parent is None else poses[id(link.parent)]
        poses[id(link)] = above @ pose_at_start(link)
    for link in skel.links:
        cameras = [_in_body(camera, link, skel, poses) for camera in link.cameras]
        add_cameras(bodies[id(link)], cameras, names, losses)


def _in_body(camera: CameraPart, link: LinkPart, skel: SkeletonPart, poses: Mapping[int, Array]) -> CameraPart:
    """As it starts, if it is one that keeps its distance in axes parallel to the world's."""
    if not camera.mode.startswith("track"):
        return camera
    turn, origin = poses[id(link)][:3, :3], poses[id(link)][:3, 3]
    away = camera.pose[:3, 3]
    if camera.mode == "trackcom":
        away = away + _com(link, skel, poses) - origin
    pose = np.eye(4)
    pose[:3, :3], pose[:3, 3] = turn.T @ camera.pose[:3, :3], turn.T @ away
    return replace(camera, pose=pose)


def _com(link: LinkPart, skel: SkeletonPart, poses: Mapping[int, Array]) -> Array:
    """The centre of mass of a body and all after it at the start, shape (3,), m."""
    after = [link]
    for one in after:
        after += [child for child in skel.links if child.parent is one]
    masses = [one.mass for one in after]
    if sum(masses) == 0.0:
        return poses[id(link)][:3, 3]
    coms = [poses[id(one)][:3, :3] @ one.com + poses[id(one)][:3, 3] for one in after]
    return np.asarray(np.average(coms, axis=0, weights=masses))
