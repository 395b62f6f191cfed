"""The first look at a file or a world: which way is up, a camera that finds it by itself, a floor where it has none."""

from __future__ import annotations

import os
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from pydart2.cameras import MountedCamera
from pydart2.errors import NameNotFound
from pydart2.gui.camera import MARGIN, Camera, nearest
from pydart2.gui.draw_list import NOBODY, Item, Scene, from_world
from pydart2.gui.placing import boxes, corners
from pydart2.gui.trackball import FIELD_OF_VIEW
from pydart2.simulation.up import Axis, is_z_up

if TYPE_CHECKING:
    from pydart2.world import World

Array = NDArray[np.float64]

#: Where the eye is, as parts of what is ahead of a model, on its left, and up.
VIEWS = {
    "auto": (1.0, -0.6, 0.4),
    "front": (1.0, 0.0, 0.0),
    "back": (-1.0, 0.0, 0.0),
    "left": (0.0, 1.0, 0.0),
    "right": (0.0, -1.0, 0.0),
    "top": (-1e-3, 0.0, 1.0),
}

_LEAST_RADIUS = 0.02  # m
_LEAST_FLOOR = 20.0  # m
_TIME_STEP = 0.001  # s, of a file that has none
_TIME_STEPS = {"skel": "world/physics/time_step", "sdf": "world/physics/max_step_size"}


def open_world(
    path: str | os.PathLike[str], ground: bool = False, step: float | None = None, fixed: bool = False
) -> World:
    """A world with what a file holds, with the file's gravity if it has one, else along the format's down.

    With `ground`, what has no floor gets one, right under it, where there is gravity along it. Without a `step`, in s,
    it is the file's own, or 1 ms. `fixed` welds roots that float to the world.
    """
    from pydart2.loading import read_model
    from pydart2.world import World

    model: Any = read_model(path)
    up: Axis | None = None if model.has_world else "z" if is_z_up(model) else "y"
    world = World(_time_step(model) if step is None else step, model, up=up)
    for skel in (skel for skel in world.skeletons if fixed and skel.ndofs and skel.joints[0].type() == "FreeJoint"):
        skel.set_root_joint_to_weld()
    if ground and -world.gravity() @ world.up > 0.0:
        height = height_of_floor(world)
        if height is not None:
            world.add_ground(height)
            world.reset()  # the recording, too, begins with the ground
    return world


def _time_step(model: Any) -> float:
    """That of a file, s."""
    if model.time_step is not None:
        return float(model.time_step)
    root = model.document.root
    text = root.get(_TIME_STEPS[root.tag]) if root.tag in _TIME_STEPS else None
    return float(text) if text else _TIME_STEP


def mounted(world: Any, camera: Any) -> MountedCamera | None:
    """The camera that a world has by this name; None where it has none of it, or it is no name."""
    cameras: dict[str, MountedCamera] = getattr(world, "_cameras", {})  # not hidden by one of a subclass
    return cameras.get(camera) if isinstance(camera, str) else None


def look(world: Any, aspect: float = 1.0, view: str = "auto", still: bool = False) -> Camera:
    """A camera that sees all of a world but its floors, from one of VIEWS; `aspect` is width / height.

    It sees all however that turns about its middle, or if it is `still` comes as near as it can. Ahead is where models
    look by custom, along x. NameNotFound for another view.
    """
    if view not in VIEWS:
        raise NameNotFound("camera", view, "pydart2.gui", [*VIEWS, *getattr(world, "_cameras", ())])
    scene = _scene_of(world)
    low, high = _extent(scene)
    middle, radius = (low + high) / 2.0, max(float(np.linalg.norm(high - low)) / 2.0, _LEAST_RADIUS)
    distance = MARGIN * radius / np.sin(np.arctan(np.tan(FIELD_OF_VIEW / 2.0) * min(aspect, 1.0)))
    ahead = np.array([1.0, 0.0, 0.0] if abs(scene.up[0]) < 0.9 else [0.0, 0.0, -1.0])
    ahead -= (ahead @ scene.up) * scene.up
    ahead /= np.linalg.norm(ahead)
    direction = np.asarray(VIEWS[view]) @ np.array([ahead, np.cross(scene.up, ahead), scene.up])
    camera = Camera.look_at(middle + distance * direction / np.linalg.norm(direction), middle, scene.up)
    points = _corners(scene)
    if still and len(points):
        near = camera.view.copy()
        near[:3, 3] = nearest(near[:3, :3], points, camera.fov, aspect)
        camera = replace(camera, view=near)
    return replace(camera, near=min(0.01, 0.01 * distance), far=max(100.0, 4.0 * distance))


def middle_of(world: Any) -> Array:
    """The middle of what look() sees, shape (3,), m."""
    return np.asarray(_extent(_scene_of(world)).mean(axis=0))


def floor_of(world: Any) -> Item | None:
    """A floor to be drawn under all that a world shows now; None where a body of it is a floor, or nothing is there."""
    scene = _scene_of(world)
    lowest = _height_of_floor(scene)
    if lowest is None:
        return None
    low, high = _extent(scene)
    ground = Scene(scene.up)
    ground.add_ground(lowest, max(_LEAST_FLOOR, 4.0 * float(np.linalg.norm(high - low))), centre=(low + high) / 2.0)
    return ground.items[0]


def height_of_floor(world: Any) -> float | None:
    """How high that floor is, m; None where there is none to be drawn."""
    return _height_of_floor(_scene_of(world))


def _height_of_floor(scene: Scene) -> float | None:
    bodies = [item for item in scene.items if item.ids != NOBODY]
    if not bodies or not all(item.casts for item in bodies):
        return None
    low, high = _extent(scene)
    return float(np.where(scene.up > 0.0, low, high) @ scene.up)


def _scene_of(world: Any) -> Scene:
    return from_world(world) if hasattr(world, "skeletons") else Scene()


def _extent(scene: Scene) -> Array:
    """Lowest and highest corner (2, 3), m, of all that is no floor, else of all."""
    around = boxes(_things(scene))
    around = around[np.isfinite(around).all(axis=(1, 2))]
    return np.array([around[:, 0].min(axis=0), around[:, 1].max(axis=0)]) if len(around) else np.zeros((2, 3))


def _corners(scene: Scene) -> Array:
    """Of the boxes around the meshes of all that _extent() is about, shape (n, 3), m."""
    ends = np.array([corners(item) for item in _things(scene)]).reshape(-1, 3)
    return np.asarray(ends[np.isfinite(ends).all(axis=1)])


def _things(scene: Scene) -> list[Item]:
    return [item for item in scene.items if item.casts] or scene.items
