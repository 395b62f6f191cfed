"""Closed triangle and quad meshes for robot links, and their Wavefront OBJ text.

Every solid here is a loft: a stack of rings with the same number of points, joined by quads and
closed by a cap at each end.  Lengths are in metres.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Point = tuple[float, float, float]
Outline = Sequence[tuple[float, float]]

SMOOTH = np.cos(np.radians(50.0))  # faces that meet at a smaller angle are shaded as one surface


@dataclass(frozen=True)
class Mesh:
    """Points and the polygons between them, outside seen counter-clockwise, in one material."""

    points: Array
    faces: tuple[tuple[int, ...], ...]
    material: str

    def mirrored(self) -> Mesh:
        """The same solid on the other side of the plane y = 0."""
        return Mesh(self.points * (1.0, -1.0, 1.0), tuple(f[::-1] for f in self.faces), self.material)

    def normals(self) -> Array:
        """One vector per face, as long as twice the area of the face."""
        p = self.points
        return np.array([sum(np.cross(p[b] - p[f[0]], p[c] - p[f[0]]) for b, c in pairwise(f[1:])) for f in self.faces])


def skin(material: str, rings: Iterable[Array]) -> Mesh:
    """Joins rings of equal length and caps both ends."""
    stack = list(rings)
    n, m = len(stack[0]), len(stack)
    quads = [
        (k * n + i, k * n + (i + 1) % n, k * n + n + (i + 1) % n, k * n + n + i) for k in range(m - 1) for i in range(n)
    ]
    caps = [tuple(range(n))[::-1], tuple(range((m - 1) * n, m * n))]
    mesh = Mesh(np.concatenate(stack), tuple(quads + caps), material)
    heads = mesh.points[[f[0] for f in mesh.faces]]
    if np.sum(heads * mesh.normals()) >= 0.0:  # six times the enclosed volume
        return mesh
    return Mesh(mesh.points, tuple(f[::-1] for f in mesh.faces), material)


def oval(u: float, v: float, half_u: float, half_v: float, power: float = 4.0, n: int = 16) -> Outline:
    """A superellipse: power 2 is an ellipse, a greater power comes closer to a rectangle."""
    turn = 2.0 * np.pi * (np.arange(n) + 0.5) / n
    c, s = np.cos(turn), np.sin(turn)
    pu = u + half_u * np.sign(c) * np.abs(c) ** (2.0 / power)
    pv = v + half_v * np.sign(s) * np.abs(s) ** (2.0 / power)
    return list(zip(pu.tolist(), pv.tolist()))


def loft(material: str, axis: str, levels: Iterable[tuple[float, Outline]]) -> Mesh:
    """Outlines at heights along an axis; an outline is in the two other axes in the order x, y, z."""
    k = "xyz".index(axis)
    return skin(material, (np.insert(np.array(outline, float), k, height, axis=1) for height, outline in levels))


def prism(material: str, axis: str, low: float, high: float, outline: Outline) -> Mesh:
    """A convex outline swept along an axis."""
    return loft(material, axis, [(low, outline), (high, outline)])


def box(material: str, low: Point, high: Point, bevel: float = 0.004) -> Mesh:
    """A box between two corners with all its edges cut, of a thin box by at most a fifth."""
    bevel = min(bevel, 0.2 * min(b - a for a, b in zip(low, high)))

    def rectangle(inset: float) -> Outline:
        (a, b), (c, d) = (low[0] + inset, low[1] + inset), (high[0] - inset, high[1] - inset)
        e = bevel
        return [(c, b + e), (c, d - e), (c - e, d), (a + e, d), (a, d - e), (a, b + e), (a + e, b), (c - e, b)]

    heights = (low[2], low[2] + bevel, high[2] - bevel, high[2])
    return loft(material, "z", [(z, rectangle(i)) for z, i in zip(heights, (bevel, 0.0, 0.0, bevel))])


def tube(material: str, points: Sequence[Point], radius: float | Sequence[float], n: int = 8) -> Mesh:
    """A round bar through points, with mitred corners; the radius may differ from point to point."""
    path = np.array(points, float)
    steps = np.diff(path, axis=0)
    steps /= np.linalg.norm(steps, axis=1, keepdims=True)
    side = np.cross(steps[0], np.eye(3)[np.argmin(np.abs(steps[0]))])
    turn = 2.0 * np.pi * (np.arange(n) + 0.5) / n
    circle = np.outer(np.cos(turn), side / np.linalg.norm(side))
    circle += np.outer(np.sin(turn), np.cross(steps[0], side / np.linalg.norm(side)))
    rings = []
    for k, (centre, r) in enumerate(zip(path, np.broadcast_to(radius, len(path)))):
        before, after = steps[max(k - 1, 0)], steps[min(k, len(steps) - 1)]
        mitre = before + after
        # Slide each point of the circle along the incoming bar onto the plane of the mitre.
        circle = circle - np.outer(circle @ mitre / (before @ mitre), before)
        rings.append(centre + r * circle)
        circle = circle - np.outer(circle @ after, after)
        circle /= np.linalg.norm(circle, axis=1, keepdims=True)
    return skin(material, rings)


def panel(material: str, lower: Sequence[Point], upper: Sequence[Point], thickness: float) -> Mesh:
    """A bent plate between a lower and an upper edge, thickened level towards the middle of the edges."""
    low, high = np.array(lower, float), np.array(upper, float)
    inward = np.mean(np.concatenate([low, high]), axis=0) - (low + high) / 2.0
    inward[:, 2] = 0.0
    inward *= thickness / np.linalg.norm(inward, axis=1, keepdims=True)
    return skin(material, (np.array([a, b, b + t, a + t]) for a, b, t in zip(low, high, inward)))


def turned(mesh: Mesh, degrees: float, centre: Point) -> Mesh:
    """The mesh turned about the x axis through a centre."""
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    rotation = np.array([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]])
    return Mesh((mesh.points - centre) @ rotation.T + centre, mesh.faces, mesh.material)


def both(mesh: Mesh) -> list[Mesh]:
    """A part and its mirror image, for links that lie on the plane y = 0."""
    return [mesh, mesh.mirrored()]


def _corner_normals(mesh: Mesh) -> list[list[Array]]:
    """Per face and corner, the mean normal of the faces around that point which meet it smoothly."""
    large = mesh.normals()
    unit = large / np.maximum(np.linalg.norm(large, axis=1, keepdims=True), 1e-12)
    around: dict[int, list[int]] = {}
    for k, face in enumerate(mesh.faces):
        for i in face:
            around.setdefault(i, []).append(k)
    out = []
    for k, face in enumerate(mesh.faces):
        sums = [sum(large[j] for j in around[i] if unit[j] @ unit[k] > SMOOTH) for i in face]
        out.append([unit[k] if np.ndim(v) == 0 else v / np.linalg.norm(v) for v in sums])
    return out


def _triple(values: Array, digits: int) -> str:
    return " ".join(f"{round(float(v), digits) + 0.0:.{digits}f}" for v in values)


def obj_text(title: str, library: str, meshes: Sequence[Mesh]) -> str:
    """Wavefront OBJ text with a group of faces for each material."""
    lines = [f"# {title}", f"mtllib {library}"]
    lines += [f"v {_triple(p, 4)}" for mesh in meshes for p in mesh.points]
    normals: dict[str, int] = {}
    groups: dict[str, list[str]] = {}
    first = 1
    for mesh in meshes:
        for face, corners in zip(mesh.faces, _corner_normals(mesh)):
            index = [normals.setdefault(_triple(n, 2), len(normals) + 1) for n in corners]
            text = " ".join(f"{first + i}//{n}" for i, n in zip(face, index))
            groups.setdefault(mesh.material, []).append(f"f {text}")
        first += len(mesh.points)
    lines += [f"vn {n}" for n in normals]
    for material in sorted(groups):
        lines += [f"usemtl {material}", *groups[material]]
    return "\n".join(lines) + "\n"
