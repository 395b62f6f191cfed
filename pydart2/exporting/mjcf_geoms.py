"""Geoms of MJCF, and the meshes of its assets."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from pydart2.exporting.losses import Losses
from pydart2.exporting.numbers import Element, add, attributes, is_identity, text
from pydart2.exporting.parts import LinkPart, ShapePart
from pydart2.exporting.shapes import mesh_file, mesh_scale
from pydart2.poses import between, pose

_STL_HEADER, _STL_TRIANGLE, _STL_MOST = 84, 50, 200_000  # bytes, bytes, and what MuJoCo takes


@dataclass
class Assets:
    """The meshes of a file, each once."""

    element: Element
    folder: str | None
    losses: Losses
    names: dict[tuple[str, str], str] = field(default_factory=dict)

    def mesh(self, shape: ShapePart) -> str:
        """The name of a shape's mesh."""
        scale = text(mesh_scale(shape))
        path = shape.sizes["path"].removeprefix("file://")
        key = (path or f"{id(shape)}", scale)
        if key not in self.names:
            name = self.names[key] = f"mesh{len(self.names)}"
            element = add(self.element, "mesh", name=name, scale=scale)
            if path and _is_read(Path(path)):
                element.set("file", mesh_file(shape, self.folder, self.losses))
            else:
                _add_corners(element, shape)
        return self.names[key]


def _is_read(path: Path) -> bool:
    """Whether MuJoCo reads the file: OBJ, and STL in binary that is not too large."""
    if path.suffix.lower() == ".stl" and path.is_file():
        with path.open("rb") as file:
            count = int.from_bytes(file.read(_STL_HEADER)[80:], "little")
        return path.stat().st_size == _STL_HEADER + _STL_TRIANGLE * count and 0 < count <= _STL_MOST
    return path.suffix.lower() == ".obj" and path.is_file()


def _add_corners(element: Element, shape: ShapePart) -> None:
    """The corners and triangles of other meshes."""
    corners, triangles, count = [], [], 0
    for vertices, faces in shape.meshes():
        corners.append(vertices)
        triangles.append(faces.astype(int) + count)
        count += len(vertices)
    # In single precision, as files and MuJoCo have them; str() of one is in as many digits as bring it back.
    element.set("vertex", " ".join(map(str, np.concatenate(corners).ravel().astype(np.float32))))
    element.set("face", " ".join(map(str, np.concatenate(triangles).ravel())))


def add_geom(body: Element, link: LinkPart, shape: ShapePart, assets: Assets, static: bool) -> Element | None:
    """The geom of a shape; None for one that is only drawn and that there is not, ExportError if it collides."""
    where, sizes = shape.pose, shape.sizes
    if shape.kind == "plane" and not static and shape.collides:
        raise assets.losses.refuse(f"the plane {shape.name!r} of {link.name!r}, which moves")
    if shape.kind in ("box", "ellipsoid"):
        values = attributes(size=np.asarray(sizes["size"]) / 2.0)
    elif shape.kind == "sphere":
        values = attributes(size=sizes["radius"])
    elif shape.kind in ("cylinder", "capsule"):
        values = attributes(size=[sizes["radius"], sizes["height"] / 2.0])
    elif shape.kind == "plane" and static:
        values = attributes(size=[0.0, 0.0, 1.0])
        normal = np.asarray(sizes["normal"])
        where = where @ pose(normal * sizes["offset"], between(normal))
    elif shape.kind == "mesh":
        values = {"mesh": assets.mesh(shape)}
        if shape.collides:
            assets.losses.add("meshes, which collide in MuJoCo as their convex hulls", shape.name)
    elif shape.collides:
        raise assets.losses.refuse(f"collision shape {shape.name!r} of {link.name!r} is of the kind {shape.kind!r}")
    else:
        assets.losses.add(f"drawn shapes of the kind {shape.kind}", shape.name)
        return None
    geom = add(body, "geom", type=shape.kind, **values)
    if not is_identity(where):
        geom.attrib.update(attributes(pos=where[:3, 3], xyaxes=where[:3, :2].T))
    if shape.rgba is None:
        geom.set("group", "3")  # which is not drawn
    elif shape.rgba.size:
        geom.set("rgba", text(shape.rgba))
    return geom
