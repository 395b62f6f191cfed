"""Worlds for the tests of pictures, as SKEL texts."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
from PIL import Image

import pydart2

_BODY = """
<skeleton name="{name}"><mobile>{mobile}</mobile>
  <joint name="joint" type="{joint}"><parent>world</parent><child>body</child></joint>
  <body name="body"><transformation>{pose}</transformation>
    <visualization_shape><geometry>{geometry}</geometry><color>{color}</color></visualization_shape>
  </body>
</skeleton>"""


def world_of(*bodies: str) -> pydart2.World:
    """A world with y up, out of the texts of bodies."""
    physics = "<physics><time_step>0.001</time_step><gravity>0 -9.81 0</gravity></physics>"
    text = f'<?xml version="1.0"?><skel version="1.0"><world name="w">{physics}{"".join(bodies)}</world></skel>'
    return pydart2.World(0.001, text, xmlstr=True)


def body(geometry: str, pose: str = "0 0 0 0 0 0", color: str = "0.8 0.3 0.3", *, fixed: bool = False) -> str:
    """A skeleton with one body of one shape."""
    joint, mobile = ("weld", "false") if fixed else ("free", "true")
    name = re.sub(r"[^\w.]+", " ", geometry)
    return _BODY.format(name=name, pose=pose, geometry=geometry, color=color, joint=joint, mobile=mobile)


def sphere(radius: float) -> str:
    return f"<sphere><radius>{radius}</radius></sphere>"


def box(x: float, y: float, z: float) -> str:
    return f"<box><size>{x} {y} {z}</size></box>"


GEOMETRIES = {
    "SphereShape": sphere(0.1),
    "BoxShape": box(0.15, 0.1, 0.2),
    "EllipsoidShape": "<ellipsoid><size>0.1 0.2 0.3</size></ellipsoid>",
    "CylinderShape": "<cylinder><radius>0.08</radius><height>0.2</height></cylinder>",
    "CapsuleShape": "<capsule><radius>0.06</radius><height>0.15</height></capsule>",
    "ConeShape": "<cone><radius>0.1</radius><height>0.2</height></cone>",
    "MultiSphereConvexHullShape": "<multi_sphere><sphere><radius>0.05</radius><position>0 0 0</position></sphere>"
    "<sphere><radius>0.1</radius><position>0 0.1 0.1</position></sphere></multi_sphere>",
}


def primitives() -> pydart2.World:
    """One of each kind of shape on a floor."""
    made = [body(box(6.0, 0.1, 6.0), "0 -0.35 0 0 0 0", "0.9 0.9 0.9", fixed=True)]
    for i, geometry in enumerate(GEOMETRIES.values()):
        place = f"{0.35 * (i % 4) - 0.5} {0.3 * (i // 4) - 0.1} {0.2 * (i // 4)} 0.5 0.6 0.2"
        made.append(body(geometry, place, f"{0.3 + 0.1 * i:.1f} {0.8 - 0.1 * i:.1f} 0.5"))
    return world_of(*made)


def textured_board(folder: Path) -> pydart2.World:
    """A square with edges of 2 m in the plane z = 0, its upper left quarter red, upper right green, lower left blue,
    lower right white, beside a square of another material that is yellow."""
    pixels = np.array([[[255, 0, 0], [0, 255, 0]], [[0, 0, 255], [255, 255, 255]]], np.uint8)
    Image.fromarray(pixels.repeat(32, axis=0).repeat(32, axis=1)).save(folder / "quarters.png")
    (folder / "board.mtl").write_text("newmtl picture\nKd 1 1 1\nmap_Kd quarters.png\n\nnewmtl yellow\nKd 1 1 0\n")
    (folder / "board.obj").write_text(
        "mtllib board.mtl\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nv 1.5 -1 0\nv 3.5 -1 0\nv 3.5 1 0\nv 1.5 1 0\n"
        "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 1\nusemtl picture\nf 1/1/1 2/2/1 3/3/1 4/4/1\n"
        "usemtl yellow\nf 5/1/1 6/2/1 7/3/1 8/4/1\n"
    )
    mesh = f"<mesh><file_name>{folder}/board.obj</file_name><scale>1 1 1</scale></mesh>"
    return world_of(body(mesh, color="1 1 1", fixed=True))
