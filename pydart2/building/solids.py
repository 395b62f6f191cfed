"""Shapes that a body can be built of: their sizes, volume and moment of inertia."""

from __future__ import annotations

from dataclasses import dataclass, field
from math import inf, pi

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pydart2.given import number, numbers

_LARGEST = 1e100  # m, whose third power is a number


@dataclass(frozen=True, eq=False)
class Solid:
    """A shape as the engine's class of this name, its sizes, and what a homogeneous one weighs.

    Attributes
    ----------
    volume : float
        m³.
    inertia : array, shape (3, 3)
        Moment of inertia of 1 kg about the centre of mass, m².
    com : array, shape (3,)
        Centre of mass, m.
    vertices, triangles : arrays or None
        Of a mesh.
    heights, scale : arrays or None
        Of a field of heights.
    """

    type: str
    sizes: tuple[float, ...]
    volume: float
    inertia: NDArray[np.float64]
    com: NDArray[np.float64] = field(default_factory=lambda: np.zeros(3))
    vertices: NDArray[np.float64] | None = None
    triangles: NDArray[np.float64] | None = None
    heights: NDArray[np.float64] | None = None
    scale: NDArray[np.float64] | None = None

    def mass(self, given: float | None, density: float) -> float:
        """The mass that is given, kg, or that of a density, kg/m³; TypeError if they are no numbers."""
        return number(density, "density") * self.volume if given is None else number(given, "mass")


def _three(size: ArrayLike, what: str) -> tuple[float, float, float]:
    edges = numbers(size, what)
    if edges.shape != (3,):
        raise ValueError(f"{what} are three numbers, got {size!r}")
    return float(edges[0]), float(edges[1]), float(edges[2])


def _lengths(*values: float) -> tuple[float, ...]:
    lengths = tuple(number(value, "a length") for value in values)
    if any(_LARGEST < abs(length) < inf for length in lengths):
        raise ValueError(f"lengths are at most {_LARGEST:g} m, got {', '.join(map(repr, values))}")
    return lengths


def _round(along: float, across: float) -> NDArray[np.float64]:
    """Of a body that is round about z."""
    return np.diag([across, across, along])


def box(size: ArrayLike) -> Solid:
    """A box with edges of shape (3,), m."""
    x, y, z = _three(size, "the edges of a box")
    return Solid("BoxShape", (x, y, z), x * y * z, np.diag([y * y + z * z, x * x + z * z, x * x + y * y]) / 12)


def ellipsoid(size: ArrayLike) -> Solid:
    """An ellipsoid with diameters of shape (3,), m."""
    x, y, z = _three(size, "the diameters of an ellipsoid")
    inertia = np.diag([y * y + z * z, x * x + z * z, x * x + y * y]) / 20
    return Solid("EllipsoidShape", (x, y, z), pi / 6 * x * y * z, inertia)


def sphere(radius: float) -> Solid:
    """A sphere."""
    (radius,) = _lengths(radius)
    return Solid("SphereShape", (radius,), 4 / 3 * pi * radius**3, 0.4 * radius**2 * np.eye(3))


def cylinder(radius: float, height: float) -> Solid:
    """A cylinder along z."""
    radius, height = _lengths(radius, height)
    inertia = _round(radius**2 / 2, radius**2 / 4 + height**2 / 12)
    return Solid("CylinderShape", (radius, height), pi * radius**2 * height, inertia)


def capsule(radius: float, length: float) -> Solid:
    """A cylinder along z, `length` long, with half a sphere at each end."""
    radius, length = _lengths(radius, length)
    tube, ball = pi * radius**2 * length, 4 / 3 * pi * radius**3
    whole = length + 4 / 3 * radius
    tubes = length / whole if whole else 0.0  # share of the volume; sizes of 0 are refused where they are used
    along = (tubes / 2 + (1 - tubes) * 0.4) * radius**2
    # Each half has its centre of mass 3/8 of the radius beyond the end of the tube.
    across_ball = 0.4 * radius**2 + length**2 / 4 + 3 / 8 * length * radius
    across = tubes * (radius**2 / 4 + length**2 / 12) + (1 - tubes) * across_ball
    return Solid("CapsuleShape", (radius, length), tube + ball, _round(along, across))


def cone(radius: float, height: float) -> Solid:
    """A cone along z, its tip at height/2."""
    radius, height = _lengths(radius, height)
    inertia = _round(0.3 * radius**2, 0.15 * radius**2 + 3 / 80 * height**2)
    com = np.array([0.0, 0.0, -height / 4])
    return Solid("ConeShape", (radius, height), pi / 3 * radius**2 * height, inertia, com)


def plane(normal: ArrayLike, offset: float) -> Solid:
    """The half-space normal . x <= offset, normal of shape (3,), offset in m, which weighs nothing."""
    return Solid("PlaneShape", (*_three(normal, "the normal of a plane"), offset), 0.0, np.zeros((3, 3)))


def heightfield(heights: ArrayLike, scale: ArrayLike) -> Solid:
    """Heights, shape (rows, columns), over a grid in the xy plane about the origin; it weighs nothing.

    Row 0 is at the greatest y. The scale, shape (3,), is the distance of columns and of rows, m, and what heights are
    multiplied by.
    """
    field = np.array(numbers(heights, "heights"), ndmin=2)
    factors = np.array(_three(scale, "the scales of a field of heights"))
    if not (factors.astype(np.float32) > 0.0).all():  # the precision in which the engine keeps them
        raise ValueError(f"the scales of a field of heights must be positive in single precision, got {scale!r}")
    return Solid("HeightmapShape", (), 0.0, np.zeros((3, 3)), heights=field, scale=factors)


def mesh(vertices: ArrayLike, triangles: ArrayLike) -> Solid:
    """A closed surface: corners, shape (n, 3), m, and triangles of their indices, shape (m, 3), counter-clockwise from
    outside. Its mass is that of the volume within.

    Mirtich, Fast and Accurate Computation of Polyhedral Mass Properties (1996), as a sum over tetrahedra.
    """
    points, faces = np.array(numbers(vertices, "vertices")), np.array(numbers(triangles, "triangles"))
    if points.ndim != 2 or points.shape[1] != 3 or faces.ndim != 2 or faces.shape[1] != 3:
        raise ValueError(f"vertices are (n, 3) and triangles (m, 3), got {points.shape} and {faces.shape}")
    if faces.size and (faces.min() < 0 or faces.max() >= len(points)):
        raise IndexError(f"triangles are of the indices 0 to {len(points) - 1} of the vertices")
    corners = points[faces.astype(int)]
    parts = np.einsum("ij,ij->i", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6
    volume = float(parts.sum())
    if not volume > 0.0:
        return Solid("MeshShape", (), 0.0, np.zeros((3, 3)), vertices=points, triangles=faces)
    com = parts @ corners.sum(axis=1) / 4 / volume
    sums = corners.sum(axis=1)
    second = np.einsum("i,iaj,iak->jk", parts, corners, corners) + np.einsum("i,ij,ik->jk", parts, sums, sums)
    spread = second / 20 / volume - np.outer(com, com)
    inertia = np.trace(spread) * np.eye(3) - spread
    return Solid("MeshShape", (), volume, inertia, com, points, faces)
