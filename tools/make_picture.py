"""Draws the README's picture of Atlas: python tools/make_picture.py docs/images/atlas.png.

A painter's algorithm over the triangles of the visual meshes, with one light; needs Pillow.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw

import pydart2
from pydart2.shape import MeshShape

SIZE, SMOOTH = 640, 3  # pixels of the picture, and how many of a drawing make one of them
CAMERA = np.array([3.2, 2.0, 0.9])
TARGET = np.array([0.0, 0.0, 0.05])
FOCAL = 3.7
LIGHT = np.array([0.55, 0.25, 0.8]) / np.linalg.norm([0.55, 0.25, 0.8])
POSE = {"l_arm_shx": -1.1, "r_arm_shx": 1.1, "l_arm_elx": 0.9, "r_arm_elx": -0.9, "l_leg_kny": 0.3, "r_leg_kny": 0.3}
POSE |= {"l_leg_hpy": -0.15, "r_leg_hpy": -0.15, "l_leg_aky": -0.15, "r_leg_aky": -0.15, "l_arm_shy": -0.4}


def colours(library: Path) -> dict[str, NDArray[np.float64]]:
    """Diffuse colour of each material of an MTL file."""
    found, name = {}, ""
    for line in library.read_text().splitlines():
        words = line.split()
        if words[:1] == ["newmtl"]:
            name = words[1]
        elif words[:1] == ["Kd"]:
            found[name] = np.array(words[1:], dtype=float)
    return found


def triangles(mesh: Path) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Corners (n, 3, 3) and colours (n, 3) of an OBJ file."""
    points: list[list[float]] = []
    faces, shades = [], []
    library: dict[str, NDArray[np.float64]] = {}
    colour = np.full(3, 0.8)
    for words in map(str.split, mesh.read_text().splitlines()):
        if words[:1] == ["mtllib"]:
            library = colours(mesh.parent / words[1])
        elif words[:1] == ["usemtl"]:
            colour = library[words[1]]
        elif words[:1] == ["v"]:
            points.append([float(w) for w in words[1:4]])
        elif words[:1] == ["f"]:
            corners = [int(w.split("/")[0]) - 1 for w in words[1:]]
            for i in range(1, len(corners) - 1):
                faces.append([corners[0], corners[i], corners[i + 1]])
                shades.append(colour)
    return np.array(points)[faces], np.array(shades)


def scene(skel: pydart2.Skeleton) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """All triangles of a skeleton in the world, and their colours."""
    parts = []
    for node in (node for body in skel.bodynodes for node in body.shapenodes if node.has_visual_aspect()):
        if isinstance(node.shape, MeshShape):
            corners, shades = triangles(Path(node.shape.path().removeprefix("file://")))
            T = node.world_transform()
            parts.append((corners @ T[:3, :3].T + T[:3, 3], shades))
    return np.concatenate([c for c, _ in parts]), np.concatenate([s for _, s in parts])


def draw(corners: NDArray[np.float64], shades: NDArray[np.float64]) -> Image.Image:
    """The triangles from the camera, far ones first."""
    forward = (TARGET - CAMERA) / np.linalg.norm(TARGET - CAMERA)
    right = np.cross(forward, [0, 0, 1])
    right /= np.linalg.norm(right)
    view = (corners - CAMERA) @ np.stack([right, np.cross(right, forward), forward], axis=1)
    side = SIZE * SMOOTH
    pixels = side / 2 + side * FOCAL / 2 * view[..., :2] / view[..., 2:] * [1, -1]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True) + 1e-12
    towards = np.sign(np.sum(normals * (CAMERA - corners[:, 0]), axis=1, keepdims=True))
    brightness = 0.45 + 0.6 * np.clip(normals * towards @ LIGHT, 0, 1)
    rgb = (255 * np.clip(shades * brightness[:, None], 0, 1)).astype(int)
    picture = Image.new("RGB", (side, side), (236, 239, 243))
    pen = ImageDraw.Draw(picture)
    for i in np.argsort(-view[..., 2].mean(axis=1)):
        pen.polygon([tuple(p) for p in pixels[i]], fill=tuple(rgb[i]))
    return picture.resize((SIZE, SIZE), Image.Resampling.LANCZOS)


def main() -> None:
    """Pose Atlas and draw it."""
    skel = pydart2.World(0.001).add_skeleton("./data/sdf/atlas/atlas_v3_no_head.sdf")
    skel.set_positions(POSE)
    target = Path(sys.argv[1])
    target.parent.mkdir(parents=True, exist_ok=True)
    draw(*scene(skel)).save(target, optimize=True)


if __name__ == "__main__":
    main()
