"""What can be added to a world: the ground, single bodies, empty skeletons to be built."""

from __future__ import annotations

from typing import TYPE_CHECKING, Unpack

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pydart2.building import solids
from pydart2.building.bodies import DENSITY, BodyOptions, ShapeOptions, attach, check_options
from pydart2.building.soft_bodies import SoftBuilding
from pydart2.given import number, numbers
from pydart2.poses import between, pose
from pydart2.simulation.up import Upright

if TYPE_CHECKING:
    from pydart2.skeleton import Skeleton

_NO_AXES = np.zeros((0, 3))


class WorldBuilding(SoftBuilding, Upright):
    """The part of World that adds to it without files."""

    _under_construction: Skeleton | None = None

    def add_empty_skeleton(self, name: str = "skeleton") -> Skeleton:
        """Add a skeleton without bodies, for `Skeleton.add_body`. If the name is taken, a number is added to it."""
        self._under_construction = self.add_skeleton_from_id(self._handle.add_empty_skeleton(name))
        return self._under_construction

    def add_ground(
        self,
        height: float = 0.0,
        size: ArrayLike = (100.0, 100.0),
        *,
        name: str = "ground",
        color: ArrayLike = (0.86, 0.88, 0.9),
        friction: float = 1.0,
        restitution: float = 0.0,
    ) -> Skeleton:
        """Add a level floor, a box 1 m thick that is welded to the world.

        Parameters
        ----------
        height
            Of the floor along the world's `up`, from the origin, m.
        size
            Its two edges, shape (2,), m.
        """
        up, top = self._upwards(), number(height, "height")
        edges = numbers(size, "the edges of a ground")
        if edges.shape != (2,):
            raise ValueError(f"a ground has two edges, got {size!r}")
        box = solids.box([edges[0], edges[1], 1.0])
        options: BodyOptions = {"orientation": between(up), "friction": friction, "restitution": restitution}
        return self._add_single(box, 0.0, (top - 0.5) * up, {**options, "name": name, "color": color, "fixed": True})

    def add_box(
        self,
        size: ArrayLike,
        mass: float | None = None,
        position: ArrayLike = (0.0, 0.0, 0.0),
        **options: Unpack[BodyOptions],
    ) -> Skeleton:
        """Add a box that is free to move.

        Parameters
        ----------
        size
            Edges, shape (3,), m.
        mass
            kg; by default by its density.
        position
            Of its centre, shape (3,), m; there it is after a reset, too.
        **options
            See `BodyOptions`.
        """
        return self._add_single(solids.box(size), mass, position, {"name": "box", **options})

    def add_sphere(
        self,
        radius: float,
        mass: float | None = None,
        position: ArrayLike = (0.0, 0.0, 0.0),
        **options: Unpack[BodyOptions],
    ) -> Skeleton:
        """Add a sphere that is free to move, at a position of shape (3,), m; as add_box()."""
        return self._add_single(solids.sphere(radius), mass, position, {"name": "sphere", **options})

    def add_capsule(
        self,
        radius: float,
        length: float,
        mass: float | None = None,
        position: ArrayLike = (0.0, 0.0, 0.0),
        *,
        parent: int | None = None,
        joint_loc: ArrayLike | None = None,
        cap_rot: ArrayLike = (0.0, 0.0, 0.0),
        cap_offset: ArrayLike = (0.0, 0.0, 0.0),
        joint_type: str = "BALL",
        joint_name: str = "",
        **options: Unpack[BodyOptions],
    ) -> Skeleton:
        """Add a free capsule along its z, `length` without round ends, at a position of shape (3,), m; as add_box().

        With `parent` or `joint_loc` it is a body of the skeleton that add_empty_skeleton() made last, as
        `Skeleton.add_capsule`; that skeleton is returned.
        """
        if parent is None and joint_loc is None:
            return self._add_single(solids.capsule(radius, length), mass, position, {"name": "capsule", **options})
        skel = self.add_built_skeleton()
        where = (0.0, 0.0, 0.0) if joint_loc is None else joint_loc
        skel.add_capsule(parent, radius, length, cap_rot, cap_offset, where, joint_type, joint_name)
        return skel

    def add_weld_box(
        self,
        width: float,
        length: float,
        height: float,
        joint_loc: ArrayLike = (0.0, 0.0, 0.0),
        box_rot: ArrayLike = (0.0, 0.0, 0.0),
        joint_name: str = "",
    ) -> Skeleton:
        """Add a welded box at `joint_loc`, shape (3,), m, to the skeleton that add_empty_skeleton() made last.

        As `Skeleton.add_weld_box`; the skeleton is returned.
        """
        skel = self.add_built_skeleton()
        skel.add_weld_box(width, length, height, joint_loc, box_rot, joint_name)
        return skel

    def add_built_skeleton(self, _skel_id: int | None = None, _skel_name: str = "") -> Skeleton:
        """The skeleton that add_empty_skeleton() made last; in the world since then. The arguments say nothing."""
        self._handle.time()  # a world that is gone says so
        skel = self._under_construction
        if skel is None or skel not in self.skeletons:
            raise ValueError("no skeleton is under construction: call add_empty_skeleton() first")
        return skel

    def add_cylinder(
        self,
        radius: float,
        height: float,
        mass: float | None = None,
        position: ArrayLike = (0.0, 0.0, 0.0),
        **options: Unpack[BodyOptions],
    ) -> Skeleton:
        """Add a cylinder along its z that is free to move, at a position of shape (3,), m; as add_box()."""
        return self._add_single(solids.cylinder(radius, height), mass, position, {"name": "cylinder", **options})

    def add_mesh(
        self,
        vertices: ArrayLike,
        triangles: ArrayLike,
        mass: float | None = None,
        position: ArrayLike = (0.0, 0.0, 0.0),
        **options: Unpack[BodyOptions],
    ) -> Skeleton:
        """Add a body with a surface of corners, shape (n, 3), m, and triangles of their indices, shape (m, 3).

        Triangles are counter-clockwise from outside; the position is that of the corners' origin. Else as add_box().
        """
        return self._add_single(solids.mesh(vertices, triangles), mass, position, {"name": "mesh", **options})

    def add_heightfield(
        self,
        heights: ArrayLike,
        scale: ArrayLike,
        position: ArrayLike = (0.0, 0.0, 0.0),
        **options: Unpack[BodyOptions],
    ) -> Skeleton:
        """Add terrain that is welded to the world: heights, shape (rows, columns), about a position of shape (3,), m.

        `scale`, shape (3,): distance of columns and of rows, m, and what heights are multiplied by. Heights go along
        the world's `up`, unless an orientation is given; row 0 is at the greatest y. Else as add_box().
        """
        upright: BodyOptions = {"name": "terrain", "orientation": between(self._upwards()), "fixed": True}
        return self._add_single(solids.heightfield(heights, scale), 0.0, position, {**upright, **options})

    def _add_single(
        self, solid: solids.Solid, mass: float | None, position: ArrayLike, options: BodyOptions
    ) -> Skeleton:
        check_options(options, BodyOptions)
        if mass is not None and not number(mass, "mass") >= 0.0:
            raise ValueError(f"a mass must be positive, got {mass}")
        fixed = options.get("fixed", False)
        if not fixed and (mass == 0.0 or (mass is None and solid.volume == 0.0)):
            raise ValueError("what moves needs a mass")
        where = pose(position, options.get("orientation"))
        with self._all_or_nothing():
            index = self._handle.add_empty_skeleton(options.get("name", "body"))
            self._fill(index, solid, mass, where, options)
            return self.add_skeleton_from_id(index)

    def _fill(
        self, index: int, solid: solids.Solid, mass: float | None, where: NDArray[np.float64], options: BodyOptions
    ) -> None:
        name = options.get("name", "body")
        joint = "WeldJoint" if options.get("fixed", False) else "FreeJoint"
        self._handle.skeleton(index).add_body(-1, name, joint, f"{name}_joint", _NO_AXES)
        skeleton = self._handle.skeleton(index)  # the one before is of a skeleton without a body
        skeleton.joint(0).place(where)
        shape: ShapeOptions = {"mass": mass, "name": name, "density": options.get("density", DENSITY)}
        for key in ("color", "friction", "restitution"):
            if key in options:
                shape[key] = options[key]
        attach(skeleton.bodynode(0), solid, shape)
