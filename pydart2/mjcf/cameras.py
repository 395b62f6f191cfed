"""The cameras of a compiled model, mounted where the bodies of ours are."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import TYPE_CHECKING

import numpy as np

from pydart2.cameras import Mode, MountedCamera
from pydart2.mjcf.compile import Compiled
from pydart2.mjcf.trees import Built, name_of, world_poses
from pydart2.poses import pose

if TYPE_CHECKING:
    from pydart2.bodynode import BodyNode
    from pydart2.world import World

_MODES: tuple[Mode, ...] = ("fixed", "track", "trackcom", "targetbody", "targetbodycom")  # mjtCamLight
_LOOKS_AT = 3  # the first mode with a target


def note_cameras(model: Compiled, built: Built, unknown: set[str]) -> None:
    """Note in `unknown` which cameras cameras_of() leaves out."""
    if any(not _perspective(model, i) for i in range(model.ncam)):
        unknown.add("orthographic cameras")
    if np.any(model.cam_intrinsic[:, 2:]):
        unknown.add("principal points of cameras")
    if any(not _has_counterpart(model, built, i) for i in range(model.ncam)):
        unknown.add("cameras that follow or look at what cannot move")


def cameras_of(model: Compiled, built: Built, world: World, still: bool) -> Iterable[tuple[str, MountedCamera]]:
    """Names and cameras; those on what cannot move only if that is `still` in the world, too."""
    for i in range(model.ncam):
        on = _moving(model, built, int(model.cam_bodyid[i]))
        if _perspective(model, i) and _has_counterpart(model, built, i) and (on or still):
            yield name_of(model, "camera", i), _mounted(model, built, world, i)


def _mounted(model: Compiled, built: Built, world: World, i: int) -> MountedCamera:
    mode, fov = _MODES[int(model.cam_mode[i])], math.radians(float(model.cam_fovy[i]))
    body, target = _body(model, built, world, int(model.cam_bodyid[i])), None
    where = pose(model.cam_pos[i], model.cam_quat[i])
    if mode.startswith("track"):
        away = model.cam_pos0[i] if mode == "track" else model.cam_poscom0[i]
        where = pose(away, np.reshape(model.cam_mat0[i], (3, 3)))
    if mode.startswith("target"):
        target = _body(model, built, world, int(model.cam_targetbodyid[i]))
    if body is None:
        above = world_poses(model)[int(model.cam_bodyid[i])]
        where = pose(above[:3, 3] + where[:3, 3], where[:3, :3]) if mode == "track" else above @ where
    return MountedCamera(body, where, fov, "fixed" if body is None and mode == "track" else mode, target)


def _moving(model: Compiled, built: Built, body: int) -> bool:
    """Whether a body is in one of the trees that were built."""
    return body in built.places and bool(model.body_treeid[body] >= 0)


def _body(model: Compiled, built: Built, world: World, body: int) -> BodyNode | None:
    """Ours; None for one that cannot move, all of which are in one."""
    if not _moving(model, built, body):
        return None
    skeleton, index = built.places[body]
    return world.skeletons[skeleton].bodynodes[index]


def _perspective(model: Compiled, i: int) -> bool:
    kinds = model.cam_projection if hasattr(model, "cam_projection") else model.cam_orthographic  # in older MuJoCo
    return not int(kinds[i])


def _has_counterpart(model: Compiled, built: Built, i: int) -> bool:
    """Whether what it follows or looks at moves."""
    mode = int(model.cam_mode[i])
    if _MODES[mode] == "trackcom":
        return _moving(model, built, int(model.cam_bodyid[i]))
    return mode < _LOOKS_AT or _moving(model, built, int(model.cam_targetbodyid[i]))
