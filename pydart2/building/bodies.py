"""What can be added to a body: shapes with their mass, markers."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, TypedDict, Unpack

import numpy as np
from numpy.typing import ArrayLike

from pydart2.building import solids
from pydart2.errors import nearest
from pydart2.given import number, numbers
from pydart2.poses import pose
from pydart2.shapenode import ShapeNode

if TYPE_CHECKING:
    from pydart2._native import BodyNodeHandle, ShapeNodeHandle
    from pydart2.marker import Marker
    from pydart2.skeleton import Skeleton

#: kg/m³, that of water.
DENSITY = 1000.0


class ShapeOptions(TypedDict, total=False):
    """What all shapes have.

    Attributes
    ----------
    position, orientation
        Of the shape in the body: shape (3,), m, and a quaternion [w, x, y, z] or a (3, 3) matrix.
    mass, density
        Its mass, kg, or its density, kg/m³, by default 1000. ``mass=0`` adds no mass.
    name
        Of the shape node.
    color
        RGB or RGBA, 0 to 1.
    friction, restitution
        Coefficients of contacts; by default the engine's, 1 and 0.
    visible, collides
        Whether it is drawn, and takes part in contacts; by default both.
    """

    position: ArrayLike
    orientation: ArrayLike
    mass: float | None
    density: float
    name: str
    color: ArrayLike
    friction: float
    restitution: float
    visible: bool
    collides: bool


class BodyOptions(TypedDict, total=False):
    """What all single bodies have.

    Attributes
    ----------
    orientation
        A quaternion [w, x, y, z] or a (3, 3) matrix.
    density
        kg/m³, where no mass is given; by default 1000.
    name
        Of the skeleton and the body; a number is added if it is taken.
    color
        RGB or RGBA, 0 to 1.
    friction, restitution
        Coefficients of contacts; by default the engine's, 1 and 0.
    fixed
        Whether it is welded to the world.
    """

    orientation: ArrayLike
    density: float
    name: str
    color: ArrayLike
    friction: float
    restitution: float
    fixed: bool


def check_options(options: Mapping[str, object], kind: type) -> None:
    """TypeError for an option that a TypedDict does not have; says the nearest."""
    known = dict.fromkeys(("position", "mass", *kind.__annotations__))
    for name in options:
        if name not in known:
            near = nearest(name, known)
            raise TypeError(
                f"no option {name!r}; " + (f"did you mean {near!r}?" if near else f"there are {', '.join(known)}")
            )


class BodyBuilding:
    """The part of BodyNode that adds to it."""

    _handle: BodyNodeHandle
    skeleton: Skeleton
    shapenodes: list[ShapeNode]
    markers: list[Marker]

    def add_box(self, size: ArrayLike, **options: Unpack[ShapeOptions]) -> ShapeNode:
        """Add a box with edges of shape (3,), m. Options: `ShapeOptions`. Its mass adds to the body's."""
        return self._add(solids.box(size), options)

    def add_sphere(self, radius: float, **options: Unpack[ShapeOptions]) -> ShapeNode:
        """Add a sphere; lengths in m, options as for add_box()."""
        return self._add(solids.sphere(radius), options)

    def add_ellipsoid(self, size: ArrayLike, **options: Unpack[ShapeOptions]) -> ShapeNode:
        """Add an ellipsoid with diameters of shape (3,); lengths in m, options as for add_box()."""
        return self._add(solids.ellipsoid(size), options)

    def add_capsule(self, radius: float, length: float, **options: Unpack[ShapeOptions]) -> ShapeNode:
        """Add a capsule along z, `length` without its round ends; lengths in m, options as for add_box()."""
        return self._add(solids.capsule(radius, length), options)

    def add_cylinder(self, radius: float, height: float, **options: Unpack[ShapeOptions]) -> ShapeNode:
        """Add a cylinder along z; lengths in m, options as for add_box()."""
        return self._add(solids.cylinder(radius, height), options)

    def add_cone(self, radius: float, height: float, **options: Unpack[ShapeOptions]) -> ShapeNode:
        """Add a cone along z, the tip at height/2; lengths in m, options as for add_box()."""
        return self._add(solids.cone(radius, height), options)

    def add_plane(self, normal: ArrayLike, offset: float = 0.0, **options: Unpack[ShapeOptions]) -> ShapeNode:
        """Add the half-space normal . x <= offset, normal of shape (3,), offset in m, without mass.

        FCL, the default detector, does not have it.
        """
        return self._add(solids.plane(normal, offset), options)

    def add_mesh(self, vertices: ArrayLike, triangles: ArrayLike, **options: Unpack[ShapeOptions]) -> ShapeNode:
        """Add a surface of corners, shape (n, 3), m, and triangles of their indices, shape (m, 3).

        Triangles are counter-clockwise from outside. The mass is that of the volume within; a surface that encloses
        none has none. Corners are kept in single precision. Options as for add_box().
        """
        return self._add(solids.mesh(vertices, triangles), options)

    def add_heightfield(self, heights: ArrayLike, scale: ArrayLike, **options: Unpack[ShapeOptions]) -> ShapeNode:
        """Add heights, shape (rows, columns), over a grid in the xy plane about the origin, row 0 at the greatest y.

        `scale`, shape (3,): distance of columns and of rows, m, and what heights are multiplied by. No mass.
        In single precision.
        """
        return self._add(solids.heightfield(heights, scale), options)

    def add_mass(self, mass: float, com: ArrayLike = (0.0, 0.0, 0.0), inertia: ArrayLike | None = None) -> None:
        """Add the mass, kg, of a part with its centre, shape (3,), m, and moment of inertia about it, (3, 3), kg m²."""
        if inertia is None and number(mass, "mass") > 0.0:
            raise ValueError(
                f"a mass of {mass} kg needs its inertia, or is given to a shape: body.add_box(size, mass={mass})"
            )
        self._handle.add_mass(mass, com, np.zeros((3, 3)) if inertia is None else inertia)

    def add_marker(self, name: str, position: ArrayLike) -> Marker:
        """Add a marker at a point of the body, shape (3,), m."""
        index = self._handle.add_marker(name, position)
        return self.skeleton._new_marker(index)

    def remove_shape(self, shape: ShapeNode) -> None:
        """Take a shape away; the mass stays."""
        if shape not in self.shapenodes:
            raise ValueError(f"{shape!r} is not a shape of {self!r}")
        self._handle.remove_shape(shape.id)
        self.shapenodes.remove(shape)
        for i, other in enumerate(self.shapenodes):
            other._id = i

    def _add(self, solid: solids.Solid, options: ShapeOptions) -> ShapeNode:
        check_options(options, ShapeOptions)
        node = ShapeNode(self, attach(self._handle, solid, options))  # type: ignore[arg-type]
        self.shapenodes.append(node)
        return node


def attach(body: BodyNodeHandle, solid: solids.Solid, options: ShapeOptions) -> int:
    """Add a shape and its mass to a body of the engine; returns the shape's index."""
    transform = pose(options.get("position", (0.0, 0.0, 0.0)), options.get("orientation"))
    mass = solid.mass(options.get("mass"), options.get("density", DENSITY))
    index = _new_node(body, solid, options)
    node = body.shapenode(index)
    node.set_relative_transform(transform)
    paint(node, options)
    if mass != 0.0:
        turn = transform[:3, :3]
        body.add_mass(mass, transform[:3, 3] + turn @ solid.com, mass * (turn @ solid.inertia @ turn.T))
    return index


def paint(node: ShapeNodeHandle, options: ShapeOptions | BodyOptions) -> None:
    """Give a shape of the engine its colour and coefficients, where there are any."""
    if "color" in options:
        rgba = np.ones(4)
        color = numbers(options["color"], "a color")
        if color.shape not in ((3,), (4,)):
            raise ValueError(f"a color is red, green and blue, and opacity if you like, from 0 to 1, got {color}")
        rgba[: len(color)] = color
        node.set_rgba(rgba)
    if "friction" in options:
        node.set_friction_coeff(options["friction"])
    if "restitution" in options:
        node.set_restitution_coeff(options["restitution"])


def _new_node(body: BodyNodeHandle, solid: solids.Solid, options: ShapeOptions) -> int:
    name, visible, collides = options.get("name", ""), options.get("visible", True), options.get("collides", True)
    if solid.vertices is not None and solid.triangles is not None:
        return body.add_mesh(solid.vertices, solid.triangles, name, visible, collides)
    if solid.heights is not None and solid.scale is not None:
        return body.add_heightfield(solid.heights, solid.scale, name, visible, collides)
    return body.add_shape(solid.type, solid.sizes, name, visible, collides)
