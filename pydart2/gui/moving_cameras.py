"""Cameras that move while a movie is made: functions of the time since its start, in s.

>>> pydart2.gui.record(world, "walk.mp4", seconds=5.0, camera=follow(robot.body("pelvis")))
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.spatial.transform import Rotation, Slerp

from pydart2.gui.camera import Camera, as_camera
from pydart2.gui.first_look import look, middle_of, mounted
from pydart2.simulation.up import up_of

if TYPE_CHECKING:
    from pydart2.bodynode import BodyNode
    from pydart2.gui.offscreen import CameraLike

MovingCamera = Callable[[float], Camera]


def follow(body: BodyNode, view: str = "auto", distance: float | None = None) -> MovingCamera:
    """A camera that goes along with a body's centre of mass, and turns not with it.

    Parameters
    ----------
    body
        What it looks at.
    view
        Where it looks from, by name, as of `render`.
    distance
        From the body, m; by default as far as the whole world takes.
    """
    world = body.skeleton.world
    start = look(world, view=view)
    away = np.asarray(start.pose[:3, 2]) * _distance(world, start, distance)
    return lambda t: _seen(start, body.C + away, body.C, up_of(world))


def orbit(world: Any, period: float = 10.0, view: str = "auto", distance: float | None = None) -> MovingCamera:
    """A camera that goes round what is in a world now, seen from above against the clock; `period` is of a turn, s."""
    start, middle, up = look(world, view=view), middle_of(world), up_of(world)
    away = np.asarray(start.pose[:3, 2]) * _distance(world, start, distance)

    def camera(t: float) -> Camera:
        turned = Rotation.from_rotvec(2.0 * np.pi * t / period * up).apply(away)
        return _seen(start, middle + turned, middle, up)

    return camera


def between(world: Any, views: Mapping[float, CameraLike]) -> MovingCamera:
    """A camera that goes from view to view: time in s → camera, as of `render`. Before and after them it stands still.

    What they look at stays in the middle; it leaves each and comes to the next without a jerk.

    Raises ValueError if there is no view.
    """
    if not views:
        raise ValueError("a camera between views needs one or more")
    times = sorted(views)
    cameras = [_as_it_is(world, views[t]) for t in times]
    poses, middle = [camera.pose for camera in cameras], middle_of(world)
    # What they look at: the points on their axes next to the middle of the world.
    distances = [float((pose[:3, 3] - middle) @ pose[:3, 2]) for pose in poses]
    targets = [pose[:3, 3] - distance * pose[:3, 2] for pose, distance in zip(poses, distances, strict=True)]

    def camera(t: float) -> Camera:
        i = int(np.clip(np.searchsorted(times, t, side="right") - 1, 0, max(len(times) - 2, 0)))
        j = min(i + 1, len(times) - 1)
        s = float(np.clip((t - times[i]) / (times[j] - times[i]), 0.0, 1.0)) if j > i else 0.0
        s = s * s * (3.0 - 2.0 * s)
        turns: Any = Rotation.from_matrix(np.array([poses[i][:3, :3], poses[j][:3, :3]]))
        pose = np.eye(4)
        pose[:3, :3] = Slerp([0.0, 1.0], turns)(s).as_matrix()
        target, distance = ((1.0 - s) * of[i] + s * of[j] for of in (targets, distances))
        pose[:3, 3] = target + distance * pose[:3, 2]
        fov = (1.0 - s) * cameras[i].fov + s * cameras[j].fov
        far = max(cameras[i].far, cameras[j].far)
        return Camera(np.asarray(np.linalg.inv(pose), dtype=float), fov, min(cameras[i].near, cameras[j].near), far)

    return camera


def _as_it_is(world: Any, view: CameraLike) -> Camera:
    """A camera as of `render`, where it is now."""
    view = mounted(world, view) or view
    return look(world, view=view or "auto") if view is None or isinstance(view, str) else as_camera(view)


def _distance(world: Any, start: Camera, distance: float | None) -> float:
    if distance is not None and not distance > 0.0:
        raise ValueError(f"a camera's distance must be positive, got {distance}")
    return distance if distance is not None else float(np.linalg.norm(start.position - middle_of(world)))


def _seen(start: Camera, eye: Any, target: Any, up: Any) -> Camera:
    return replace(start, view=Camera.look_at(eye, target, up).view)
