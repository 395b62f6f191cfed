"""Skins of soft bodies: point masses on springs, and the triangles between them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pydart2.building import solids

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Skin:
    """What `Skeleton.add_body` makes a body soft with.

    >>> finger = hand.add_body("finger", palm, "revolute", skin=Skin.box((0.02, 0.02, 0.1), mass=0.02))
    >>> finger.add_box((0.01, 0.01, 0.09))  # the core, and its mass

    Attributes
    ----------
    points : array, shape (n, 3)
        Where the points are at rest, body frame, m.
    triangles : array of int, shape (f, 3)
        Indices of the points, counter-clockwise from outside; points with an edge in common are neighbours.
    masses : array, shape (n,)
        kg.
    stiffness : float
        Of the spring that ties each point to its place in the body, N/m.
    edge_stiffness : float
        Of the springs between neighbours, N/m.
    damping : float
        Of the points' motion in the body, N s/m.
    """

    points: Array
    triangles: NDArray[np.intp]
    masses: Array
    stiffness: float = 500.0
    edge_stiffness: float = 0.0
    damping: float = 5.0

    def __post_init__(self) -> None:
        for name in ("stiffness", "edge_stiffness", "damping"):
            if not 0.0 <= getattr(self, name) < np.inf:
                raise ValueError(f"the {name} of a skin is a finite number >= 0, got {getattr(self, name)}")

    @classmethod
    def box(cls, size: ArrayLike, mass: float, cells: ArrayLike = 2, **springs: float) -> Skin:
        """Of a box with edges of shape (3,), m.

        Parameters
        ----------
        mass
            Of all points, kg.
        cells
            Into how many pieces each edge is cut, at most 100; one number or shape (3,).
        **springs
            stiffness and edge_stiffness, N/m, and damping, N s/m.
        """
        edges = np.array(solids.box(size).sizes)
        points, triangles = _cube(cells)
        return cls.mesh(points * edges / 2.0, triangles, mass, **springs)

    @classmethod
    def ellipsoid(cls, size: ArrayLike, mass: float, cells: int = 3, **springs: float) -> Skin:
        """Of an ellipsoid with diameters of shape (3,), m: a cube's mesh blown up; else as box()."""
        diameters = np.array(solids.ellipsoid(size).sizes)
        cube, triangles = _cube(cells)
        directions = np.tan(np.pi / 4.0 * cube)  # so that the points are about as far apart everywhere
        unit = directions / np.linalg.norm(directions, axis=1, keepdims=True)
        return cls.mesh(unit * diameters / 2.0, triangles, mass, **springs)

    @classmethod
    def mesh(cls, vertices: ArrayLike, triangles: ArrayLike, mass: float, **springs: float) -> Skin:
        """Of corners, shape (n, 3), m, and triangles of their indices, shape (f, 3); else as box()."""
        points, faces = np.array(vertices, dtype=float), np.array(triangles, dtype=np.intp)
        if points.ndim != 2 or points.shape[1:] != (3,) or faces.ndim != 2 or faces.shape[1:] != (3,):
            raise ValueError(f"vertices are (n, 3) and triangles (f, 3), got {points.shape} and {faces.shape}")
        if not mass > 0.0:
            raise ValueError(f"the points of a skin need a mass, got {mass}")
        return cls(points, faces, np.full(len(points), mass / len(points)), **springs)

    @property
    def edges(self) -> NDArray[np.intp]:
        """The pairs of neighbours, shape (e, 2), indices of the points."""
        pairs = self.triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2)
        return np.unique(np.sort(pairs, axis=1), axis=0)


def _cube(cells: ArrayLike) -> tuple[Array, NDArray[np.intp]]:
    """The surface of the cube from -1 to 1: points on a grid, and triangles."""
    n = np.broadcast_to(np.asarray(cells), (3,))
    if not np.issubdtype(n.dtype, np.integer) or (n < 1).any():
        raise ValueError(f"an edge has one cell or more, a whole number, got {cells!r}")
    if (n > 100).any():  # 60,000 points, far more than a step can move
        raise ValueError(f"an edge of a skin is cut into 100 cells at most, got {cells!r}")
    grid = np.stack(np.meshgrid(*(np.arange(k + 1) for k in n), indexing="ij"), axis=-1)
    on_surface = ((grid == 0) | (grid == n)).any(axis=-1)
    index = np.full(on_surface.shape, -1)
    index[on_surface] = np.arange(on_surface.sum())
    triangles = []
    for axis in range(3):
        for side in (0, -1):
            corner = np.take(index, side, axis=axis)  # its two axes follow x, y, z, so that y's normal is turned
            a, b, c, d = corner[:-1, :-1], corner[1:, :-1], corner[1:, 1:], corner[:-1, 1:]
            outwards = (side == -1) == (axis != 1)
            for one in ((a, b, c), (a, c, d)):
                triangles.append(np.stack(one if outwards else one[::-1], axis=-1).reshape(-1, 3))
    return 2.0 * grid[on_surface] / n - 1.0, np.concatenate(triangles).astype(np.intp)
