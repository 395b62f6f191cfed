"""Triangle meshes to draw: primitives, hulls, grids. NumPy only; lengths in the units of the caller."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float32]


@dataclass(frozen=True, eq=False)
class Mesh:
    """Triangles with what colours them. Counterclockwise corners face outwards.

    Attributes
    ----------
    vertices : (n, 3)
    normals : (n, 3), unit length
    triangles : (m, 3)
        Indices of the corners.
    texture_coordinates : (n, 2) or None
        (0, 0) is the lower left corner of the picture.
    colors : (n, 4) or None
        RGBA, 0 to 1, times the colour of what is drawn.
    texture : str or None
        Path of a picture, times the colour of what is drawn.
    is_lasting : bool
        Whether it will be drawn again; the skin of a soft body is another in each frame.
    """

    vertices: Floats
    normals: Floats
    triangles: NDArray[np.uint32]
    texture_coordinates: Floats | None = None
    colors: Floats | None = None
    texture: str | None = None
    is_lasting: bool = True

    @cached_property
    def bounds(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Lowest and highest corner, two of shape (3,)."""
        if not len(self.vertices):
            return np.zeros(3), np.zeros(3)
        return self.vertices.min(0).astype(float), self.vertices.max(0).astype(float)

    @cached_property
    def is_closed(self) -> bool:
        """Whether it bounds a volume and every triangle faces outwards, so that back sides are never seen."""
        if not self.is_lasting or not len(self.triangles):
            return False
        _, corner = np.unique(np.round(self.vertices, 6), axis=0, return_inverse=True)
        faces = corner.reshape(-1)[self.triangles].astype(np.int64)
        a, b, c = faces.T
        faces = faces[(a != b) & (b != c) & (c != a)]
        start, end = faces.reshape(-1), np.roll(faces, -1, axis=1).reshape(-1)
        count = len(self.vertices)
        same_edges = np.array_equal(np.sort(start * count + end), np.sort(end * count + start))
        x, y, z = self.vertices[self.triangles].astype(float).transpose(1, 0, 2)
        return same_edges and bool(np.einsum("ij,ij->", x, np.cross(y, z)) > 0.0)


def mesh(
    vertices: ArrayLike, triangles: ArrayLike, normals: ArrayLike | None = None, *, is_lasting: bool = True
) -> Mesh:
    """A mesh from corners (n, 3) and triangles (m, 3); smooth normals unless they are given, (n, 3)."""
    points = np.asarray(vertices, dtype=np.float32).reshape(-1, 3)
    faces = np.asarray(triangles, dtype=np.uint32).reshape(-1, 3)
    vectors = smooth_normals(points, faces) if normals is None else np.asarray(normals, dtype=np.float32)
    return Mesh(points, vectors, faces, is_lasting=is_lasting)


def smooth_normals(vertices: NDArray[np.floating], triangles: NDArray[np.integer]) -> Floats:
    """Unit normal of each vertex, (n, 3): the mean of those of its triangles, weighted by their areas."""
    corners = vertices[triangles]
    faces = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals = np.empty((len(vertices), 3))
    for axis in range(3):
        weights = np.repeat(faces[:, axis], 3)
        normals[:, axis] = np.bincount(triangles.reshape(-1), weights, minlength=len(vertices))
    return _unit(normals)


def split_at_edges(
    vertices: ArrayLike, triangles: ArrayLike, angle: float = np.radians(40.0)
) -> tuple[NDArray[np.intp], NDArray[np.uint32]]:
    """Double the vertices at sharp edges, so that smooth normals keep them sharp.

    Returns
    -------
    sources : (k,)
        The vertex that each of the new ones is a copy of.
    triangles : (m, 3)
        With the new vertices.
    """
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    points, faces = np.asarray(vertices, dtype=float), np.asarray(triangles)
    normals = flat(points, faces).normals[::3].astype(float)
    starts, ends = faces.reshape(-1), np.roll(faces, -1, axis=1).reshape(-1)
    edges = np.sort(np.stack([starts, ends], axis=1), axis=1)
    order = np.lexsort(edges.T)
    same = np.flatnonzero((edges[order[1:]] == edges[order[:-1]]).all(axis=1))
    a, b = order[same], order[same + 1]  # both sides of each edge, as corners where they start
    smooth = np.einsum("ij,ij->i", normals[a // 3], normals[b // 3]) > np.cos(angle)
    a, b = a[smooth], b[smooth]
    # The corner where one side starts is that where the other ends, and the other way round.
    next_a, next_b = a // 3 * 3 + (a + 1) % 3, b // 3 * 3 + (b + 1) % 3
    links = np.concatenate([a, next_a]), np.concatenate([next_b, b])
    graph = coo_array((np.ones(len(links[0])), links), shape=(faces.size, faces.size))
    count, group = connected_components(graph, directed=False)
    sources = np.empty(count, np.intp)
    sources[group] = starts
    return sources, group.reshape(-1, 3).astype(np.uint32)


def flat(vertices: ArrayLike, triangles: ArrayLike) -> Mesh:
    """A mesh whose triangles are shaded flat, of corners of shape (n, 3), m."""
    corners = np.asarray(vertices, dtype=float)[np.asarray(triangles)]
    faces = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    return mesh(corners.reshape(-1, 3), np.arange(3 * len(corners)), np.repeat(_unit(faces), 3, axis=0))


def join(parts: Sequence[Mesh]) -> Mesh:
    """One mesh out of several without textures or colours."""
    starts = np.cumsum([0] + [len(part.vertices) for part in parts[:-1]])
    return Mesh(
        np.concatenate([part.vertices for part in parts]),
        np.concatenate([part.normals for part in parts]),
        np.concatenate([part.triangles + np.uint32(start) for part, start in zip(parts, starts)]),
    )


@lru_cache(maxsize=8)
def sphere(level: int = 3) -> Mesh:
    """The unit sphere, from an icosahedron whose faces are cut in four `level` times. Its mean radius is 1."""
    golden = (1.0 + 5.0**0.5) / 2.0
    corners = [(0.0, s, t * golden) for s in (-1.0, 1.0) for t in (-1.0, 1.0)]
    points = np.array([np.roll(c, k) for k in range(3) for c in corners])
    from scipy.spatial import ConvexHull

    faces = _outwards(points, ConvexHull(points).simplices)
    points = _unit(points).astype(float)
    for _ in range(level):
        points, faces = _subdivide(points, faces)
        points = points / np.linalg.norm(points, axis=1, keepdims=True)
    return mesh(points / np.sqrt(_mean_square_radius(points, faces)), faces, points)


def _mean_square_radius(points: NDArray[np.float64], faces: NDArray[np.intp]) -> float:
    a, b, c = points[faces].transpose(1, 0, 2)
    # The mean of |x|² over a triangle, Strang & Fix's rule of degree 2 with the mid-edges.
    return float(np.mean([np.sum(((p + q) / 2) ** 2, axis=1) for p, q in ((a, b), (b, c), (c, a))]))


def _subdivide(points: NDArray[np.float64], faces: NDArray[np.intp]) -> tuple[NDArray[np.float64], NDArray[np.intp]]:
    a, b, c = faces.T
    edges = np.sort(np.stack([np.stack([a, b], 1), np.stack([b, c], 1), np.stack([c, a], 1)]), axis=2)
    unique, index = np.unique(edges.reshape(-1, 2), axis=0, return_inverse=True)
    ab, bc, ca = (len(points) + index.reshape(3, -1)).astype(np.intp)
    middle = points[unique].mean(axis=1)
    quarters = np.stack([np.stack(t, 1) for t in ((a, ab, ca), (b, bc, ab), (c, ca, bc), (ab, bc, ca))])
    return np.concatenate([points, middle]), quarters.reshape(-1, 3)


@lru_cache(maxsize=1)
def box() -> Mesh:
    """The cube with edges of length 1 about the origin."""
    faces = []
    for axis in range(3):
        for sign in (1.0, -1.0):
            out, u = np.roll([sign, 0.0, 0.0], axis), np.roll([0.0, 1.0, 0.0], axis)
            v = np.cross(out, u)
            corners = [0.5 * (out + s * u + t * v) for s, t in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
            faces.append(mesh(corners, [[0, 1, 2], [0, 2, 3]], np.tile(out, (4, 1))))
    return join(faces)


@lru_cache(maxsize=1)
def quad() -> Mesh:
    """The square with edges of length 1 about the origin, in the xy plane, facing +z."""
    corners = [(-0.5, -0.5, 0.0), (0.5, -0.5, 0.0), (0.5, 0.5, 0.0), (-0.5, 0.5, 0.0)]
    return mesh(corners, [[0, 1, 2], [0, 2, 3]], np.tile([0.0, 0.0, 1.0], (4, 1)))


@lru_cache(maxsize=16)
def chessboard(n: int) -> tuple[Mesh, Mesh]:
    """The squares of both colours of a board of `n` by `n`, 1 wide, about the origin in the xy plane, facing +z."""
    step = 1.0 / n
    colors: list[list[Mesh]] = [[], []]
    for row, column in np.ndindex(n, n):
        corner = np.array([column, row, 0]) * step - [0.5, 0.5, 0.0]
        square = quad()
        moved = Mesh(
            (square.vertices * step + corner + [step / 2, step / 2, 0.0]).astype(np.float32),
            square.normals,
            square.triangles,
        )
        colors[(row + column) % 2].append(moved)
    even, odd = (join(squares) if squares else mesh([], []) for squares in colors)
    return even, odd


def revolve(
    radii: Sequence[float], heights: Sequence[float], normals: Sequence[tuple[float, float]], segments: int
) -> Mesh:
    """The surface that a line in the (radius, z) plane sweeps about z; the line goes upwards on the outside.

    Parameters
    ----------
    radii, heights
        Points of the line.
    normals
        (radial, z) part of the normal at each point.
    segments
        Steps of the sweep.
    """
    angle = np.linspace(0.0, 2.0 * np.pi, segments, endpoint=False)
    x, y, n = np.cos(angle), np.sin(angle), len(radii)
    r, z, (radial, up) = np.array(radii), np.array(heights), np.array(normals).T
    points = np.stack([np.outer(r, x), np.outer(r, y), np.outer(z, np.ones(segments))], axis=2)
    vectors = np.stack([np.outer(radial, x), np.outer(radial, y), np.outer(up, np.ones(segments))], axis=2)
    ring, step = np.meshgrid(np.arange(n - 1), np.arange(segments), indexing="ij")
    a, b = ring * segments + step, ring * segments + (step + 1) % segments
    faces = np.stack([a, b, b + segments, a, b + segments, a + segments], axis=2).reshape(-1, 3)
    keep = [len({tuple(p) for p in points.reshape(-1, 3)[face]}) == 3 for face in faces]
    return mesh(points.reshape(-1, 3), faces[keep], _unit(vectors.reshape(-1, 3)))


@lru_cache(maxsize=1)
def cylinder(segments: int = 40) -> Mesh:
    """Radius 1, height 1 along z, about the origin."""
    return revolve(
        [0, 1, 1, 1, 1, 0],
        [-0.5, -0.5, -0.5, 0.5, 0.5, 0.5],
        [(0, -1), (0, -1), (1, 0), (1, 0), (0, 1), (0, 1)],
        segments,
    )


@lru_cache(maxsize=1)
def cone(segments: int = 40) -> Mesh:
    """Radius 1, height 1 along z, from the base at z = -0.5 to the tip at z = 0.5."""
    return revolve([0, 1, 1, 0], [-0.5, -0.5, -0.5, 0.5], [(0, -1), (0, -1), (1, 1), (1, 1)], segments)


@lru_cache(maxsize=256)
def capsule(height: float, segments: int = 40) -> Mesh:
    """A cylinder of radius 1 and this height along z, with half spheres at its ends; about the origin."""
    angle = np.linspace(-np.pi / 2, np.pi / 2, segments // 2 + 2)
    angle = (
        np.insert(angle, len(angle) // 2, [0.0, 0.0]) if len(angle) % 2 == 0 else np.insert(angle, len(angle) // 2, 0.0)
    )
    radial, up = np.cos(angle), np.sin(angle)
    radial[[0, -1]] = 0.0
    ends = np.where(np.arange(len(angle)) < len(angle) // 2, -0.5, 0.5) * height
    return revolve(list(radial), list(up + ends), list(zip(radial, up)), segments)


@lru_cache(maxsize=1)
def pyramid() -> Mesh:
    """Base 1 by 1 at z = -0.5, tip at z = 0.5."""
    corners = [(-0.5, -0.5, -0.5), (0.5, -0.5, -0.5), (0.5, 0.5, -0.5), (-0.5, 0.5, -0.5), (0.0, 0.0, 0.5)]
    return flat(corners, [[0, 2, 1], [0, 3, 2], [0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]])


@lru_cache(maxsize=64)
def hull_of_spheres(spheres: tuple[tuple[float, float, float, float], ...]) -> Mesh:
    """The convex hull of spheres ``(radius, x, y, z)``."""
    from scipy.spatial import ConvexHull

    ball = sphere(3)
    directions = ball.normals.astype(float)
    points = np.concatenate([np.array(centre) + radius * directions for radius, *centre in spheres])
    normals = np.tile(directions, (len(spheres), 1))
    hull = ConvexHull(points)
    faces = _outwards(points, hull.simplices)
    used, index = np.unique(faces, return_inverse=True)
    return mesh(points[used], index.reshape(-1, 3), normals[used])


def heightmap(heights: NDArray[np.float64]) -> Mesh:
    """The surface over a grid of heights, (rows, columns): x = column from the middle, y = row from the middle,
    downwards, cells of 1 by 1 m."""
    rows, columns = heights.shape
    row, column = np.meshgrid(np.arange(rows), np.arange(columns), indexing="ij")
    points = np.stack([column - (columns - 1) / 2, (rows - 1) / 2 - row, heights], axis=2)
    a = (row * columns + column)[:-1, :-1].reshape(-1)
    b, c, d = a + 1, a + columns, a + columns + 1
    return mesh(points.reshape(-1, 3), np.concatenate([np.stack([a, c, b], 1), np.stack([b, c, d], 1)]))


def _outwards(points: NDArray[np.float64], faces: NDArray[np.integer]) -> NDArray[np.intp]:
    """The faces of a convex body, each turned so that it faces outwards."""
    a, b, c = points[faces].transpose(1, 0, 2)
    inwards = np.einsum("ij,ij->i", np.cross(b - a, c - a), a - points.mean(axis=0)) < 0.0
    return np.where(inwards[:, None], faces[:, ::-1], faces).astype(np.intp)


def _unit(vectors: NDArray[np.floating]) -> Floats:
    length = np.linalg.norm(vectors, axis=1, keepdims=True)
    return (vectors / np.where(length > 0.0, length, 1.0)).astype(np.float32)
