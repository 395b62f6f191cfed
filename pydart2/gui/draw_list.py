"""What there is to draw in a world: meshes with poses and colours. NumPy only."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pydart2.gui import geometry
from pydart2.gui.geometry import Mesh
from pydart2.gui.placing import between as between
from pydart2.gui.placing import grid_of
from pydart2.gui.shapes import add_shapenode
from pydart2.simulation.up import up_of

if TYPE_CHECKING:
    from pydart2.joint import Joint
    from pydart2.shapenode import ShapeNode
    from pydart2.skeleton import Skeleton
    from pydart2.world import World

Array = NDArray[np.float64]

NOBODY = (-1, -1)
_OPAQUE, _ORIGIN = np.ones(4), np.eye(4)

_MARKER = (0.95, 0.35, 0.15)
_FORCE = (0.9, 0.15, 0.15)
_CENTER = (0.95, 0.75, 0.1)
_AXIS = (0.95, 0.6, 0.1)
_FLOOR = (0.86, 0.88, 0.9)
_COLLISION = (0.35, 0.6, 0.85)
_ASLEEP = np.array((0.62, 0.68, 0.82))
_METRES_PER_NEWTON = 0.005


@dataclass
class Show:
    """What of a world is drawn.

    Attributes
    ----------
    bodies, markers, contacts : bool
        `contacts` with their forces.
    collision_shapes : bool
        What collides in place of what is to be seen.
    forces : bool
        External forces that were added "with arrow".
    centers_of_mass, frames, joint_axes : bool
    sleepers : bool
        Bodies that sleep (`World.set_sleeping`), or slept in the recorded frame shown, in a paler, bluish colour.
    floor : Item or None
        Drawn besides, as what `first_look.floor_of` makes.
    """

    bodies: bool = True
    markers: bool = True
    contacts: bool = True
    collision_shapes: bool = False
    forces: bool = True
    centers_of_mass: bool = False
    frames: bool = False
    joint_axes: bool = False
    sleepers: bool = False
    floor: Item | None = None


class Item(NamedTuple):
    """One mesh to draw.

    Attributes
    ----------
    mesh : Mesh
        Items with the same object are drawn in one go.
    transform : (4, 4)
        From the mesh to the world, m; may scale.
    rgba : (4,)
        0 to 1, the alpha too.
    ids : (skeleton id, body id)
        -1 for what belongs to no body.
    casts : bool
        Whether it throws a shadow; floors and signs do not.
    specular : float
        Strength of highlights, 0 to 1.
    grid : float
        Edge of the cells of the grid on top of a floor, m; 0 for none.
    """

    mesh: Mesh
    transform: Array
    rgba: Array
    ids: tuple[int, int] = NOBODY
    casts: bool = True
    specular: float = 0.2
    grid: float = 0.0


class Scene:
    """Items, and which way is up.

    >>> scene = Scene()
    >>> scene.add_world(world)
    >>> scene.add_frame(world.skeletons[-1].bodynodes[0].T, 0.2)

    Attributes
    ----------
    items : list of Item
    up : (3,)
        Unit vector; light comes from above.
    """

    def __init__(self, up: ArrayLike = (0.0, 1.0, 0.0)) -> None:
        self.items: list[Item] = []
        self.up: Array = np.asarray(up, dtype=float)

    def __iter__(self) -> Iterator[Item]:
        return iter(self.items)

    def __len__(self) -> int:
        return len(self.items)

    def add(
        self,
        mesh: Mesh,
        transform: Array,
        scale: ArrayLike = 1.0,
        rgba: ArrayLike = (0.7, 0.7, 0.7, 1.0),
        ids: tuple[int, int] = NOBODY,
        *,
        casts: bool = True,
        specular: float = 0.2,
        grid: float = 0.0,
    ) -> None:
        """Add a mesh: pose in the world (4, 4), factors along the mesh's axes (3,) or one, colour of 3 or 4 numbers."""
        matrix = transform.copy()
        matrix[:, :3] *= np.asarray(scale, dtype=float)
        given, color = np.asarray(rgba, dtype=float), _OPAQUE.copy()
        color[: given.size] = given
        if color[3] > 0.0:
            self.items.append(Item(mesh, matrix, color, ids, casts, specular, grid))

    def add_world(self, world: World, show: Show | None = None) -> None:
        """Add what is to be shown of a world, and take its up."""
        show = show or Show()
        self.up = up_of(world)
        sleepers = {skel.id for skel in world._sleepers_shown()} if show.sleepers else set()
        for skel in world.skeletons:
            first = len(self.items)
            if show.bodies:
                self.add_skeleton(skel, collision_shapes=show.collision_shapes)
            if skel.id in sleepers:
                self.items[first:] = [
                    item._replace(rgba=np.append(0.35 * item.rgba[:3] + 0.65 * _ASLEEP, item.rgba[3]))
                    for item in self.items[first:]
                ]
            if show.markers:
                self.add_markers(skel)
            self._add_signs(skel, show)
        if show.floor is not None:
            self.items.append(show.floor)
        if show.contacts:
            self.add_contacts(world.collision_result.rows)

    def add_skeleton(self, skel: Skeleton, rgba: ArrayLike | None = None, *, collision_shapes: bool = False) -> None:
        """Add the visible shapes of a skeleton, or those that collide; all in one colour (4,), 0 to 1, if given."""
        for body in skel.bodynodes:
            for node in body.shapenodes:
                if collision_shapes:
                    if node.shape is not None and node.has_collision_aspect():
                        fixed = not body.dependent_dofs or not skel.is_mobile()
                        add_shapenode(self, node, (_FLOOR if fixed else _COLLISION) if rgba is None else rgba)
                elif _is_drawn(node):
                    add_shapenode(self, node, rgba)

    def _add_signs(self, skel: Skeleton, show: Show) -> None:
        size = size_of_signs(skel)
        if show.centers_of_mass and skel.bodynodes:
            self.add(geometry.sphere(2), _at(skel.C), 0.25 * size, _CENTER, casts=False)
        for body in skel.bodynodes:
            if show.frames:
                self.add_frame(body.T, size)
            if show.forces:
                for point, force in body.force_arrows:
                    self.add_arrow(point, point + _METRES_PER_NEWTON * force, 0.06 * size, _FORCE)
        for joint in skel.joints if show.joint_axes else ():
            if joint.num_dofs() == 1 and hasattr(joint, "axis_in_world_frame"):
                middle = _place_of(joint)
                reach = 0.7 * size * np.asarray(joint.axis_in_world_frame())
                self.add_arrow(middle - reach, middle + reach, 0.04 * size, _AXIS)

    def add_markers(self, skel: Skeleton) -> None:
        """Add the markers of a skeleton."""
        for marker in skel.markers:
            self.add_marker(marker.p, (skel.id, marker.bodynode.id))

    def add_marker(self, position: Array, ids: tuple[int, int] = NOBODY, radius: float = 0.01) -> None:
        """Add a marker at a position (3,), m."""
        self.add(geometry.sphere(2), _at(position), radius, _MARKER, ids, casts=False)

    def add_contacts(self, rows: Array, size: float = 0.01, force_scale: float = -0.005) -> None:
        """Add contacts, rows of `CollisionResult.rows`: a dot of radius `size`, m, and an arrow along the force.

        `force_scale` is the length of the arrow, m/N; negative shows the force on the second body.
        """
        for row in rows:
            point, force = row[:3], row[3:6]
            self.add(geometry.sphere(2), _at(point), size, _FORCE, casts=False)
            self.add_arrow(point, point + force_scale * force, 0.3 * size)

    def add_arrow(
        self, start: ArrayLike, end: ArrayLike, radius: float = 0.01, rgba: ArrayLike = (0.85, 0.2, 0.2)
    ) -> None:
        """Add an arrow between two points (3,), m; the head is part of its length. No arrow if they are the same."""
        tail, tip = np.asarray(start, dtype=float), np.asarray(end, dtype=float)
        length = math.dist(tail, tip)
        if not 1e-9 < length < np.inf:
            return
        head = min(5.0 * radius, 0.5 * length)
        shaft = between(tail, tip, 0.5 - 0.5 * head / length)
        cone = shaft.copy()
        cone[:3, 3] += 0.5 * (tip - tail)
        self.add(geometry.cylinder(), shaft, (radius, radius, length - head), rgba, casts=False)
        self.add(geometry.cone(), cone, (2.2 * radius, 2.2 * radius, head), rgba, casts=False)

    def add_line(self, start: ArrayLike, end: ArrayLike, radius: float, rgba: ArrayLike) -> None:
        """Add a thin rod between two points (3,), m."""
        a, b = np.asarray(start, dtype=float), np.asarray(end, dtype=float)
        length = float(np.linalg.norm(b - a))
        if length > 0.0:
            self.add(geometry.cylinder(), between(a, b), (radius, radius, length), rgba)

    def add_frame(self, transform: Array, length: float = 0.1) -> None:
        """Add the axes of a frame, pose (4, 4): x red, y green, z blue; `length` in m."""
        for axis, rgba in enumerate(((0.9, 0.2, 0.2), (0.2, 0.7, 0.2), (0.2, 0.35, 0.95))):
            origin = transform[:3, 3]
            self.add_arrow(origin, origin + length * transform[:3, axis], 0.04 * length, rgba)

    def add_ground(
        self, height: float = 0.0, size: float = 20.0, rgba: ArrayLike = _FLOOR, centre: ArrayLike = (0.0, 0.0, 0.0)
    ) -> None:
        """Add a square floor with a grid at a height over the origin, m; its colour has shape (4,), and its middle is
        over or under `centre` (3,)."""
        middle = np.asarray(centre, dtype=float)
        middle = middle + (height - middle @ self.up) * self.up
        pose = between(middle, middle + self.up, 0.0)
        self.add(geometry.quad(), pose, size, rgba, casts=False, specular=0.0, grid=grid_of(size))


def from_world(world: World, show: Show | None = None) -> Scene:
    """What is to be drawn of a world."""
    scene = Scene()
    scene.add_world(world, show)
    return scene


def size_of_signs(skel: Skeleton) -> float:
    """A length in keeping with a skeleton's links, m: that of frames drawn at them."""
    offsets = [body.T[:3, 3] for body in skel.bodynodes]
    extent = float(np.ptp(offsets, axis=0).max()) if len(offsets) > 1 else 0.0
    return float(np.clip(0.1 * extent, 0.05, 0.3)) if extent > 0.0 else 0.1


def _place_of(joint: Joint) -> Array:
    body = joint.child_bodynode
    return (body.T @ joint.transform_from_child_body_node())[:3, 3]


def _is_drawn(node: ShapeNode) -> bool:
    handle = node._handle
    return node.shape is not None and handle.has_visual_aspect() and not handle.is_hidden()


def _at(position: Array) -> Array:
    pose = _ORIGIN.copy()
    pose[:3, 3] = position
    return pose
