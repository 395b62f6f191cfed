"""Shapes and markers of the geoms and sites of a compiled model."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pydart2._native import BodyNodeHandle
from pydart2.building import solids
from pydart2.building.bodies import ShapeOptions, attach
from pydart2.mjcf.compile import Compiled
from pydart2.poses import pose

_Array = NDArray[np.float64]
_DRAWN = 3  # MuJoCo draws the geoms of the groups 0 to 2
GEOMS = ("plane", "hfield", "sphere", "capsule", "ellipsoid", "cylinder", "box", "mesh", "sdf")  # mjtGeom


def add_geoms(model: Compiled, handle: BodyNodeHandle, body: int, where: _Array, mass: bool) -> None:
    """Add the geoms of a body as shapes without mass, at the body's pose in that of the handle."""
    first = int(model.body_geomadr[body])
    for geom in range(first, first + int(model.body_geomnum[body])):
        solid = solid_of(model, geom)
        if solid is None:
            continue
        transform = where @ pose(model.geom_pos[geom], model.geom_quat[geom])
        options: ShapeOptions = {
            "position": transform[:3, 3],
            "orientation": transform[:3, :3],
            "mass": 0.0,
            "name": str(model.geom(geom).name) or f"geom{geom}",
            "visible": bool(model.geom_group[geom] < _DRAWN),
            "collides": bool(model.geom_contype[geom] or model.geom_conaffinity[geom]),
        }
        if options["visible"]:
            options["color"] = color_of(model, geom)
        if options["collides"]:
            options["friction"] = float(model.geom_friction[geom][0])
        attach(handle, solid, options)


def add_sites(model: Compiled, handle: BodyNodeHandle, body: int, where: _Array) -> None:
    """Add the sites of a body as markers."""
    for site in np.flatnonzero(model.site_bodyid == body):
        point = where @ [*model.site_pos[site], 1.0]
        handle.add_marker(str(model.site(int(site)).name) or f"site{site}", point[:3])


def solid_of(model: Compiled, geom: int) -> solids.Solid | None:
    """The shape of a geom; None for one that the engine does not have."""
    kind, size = GEOMS[int(model.geom_type[geom])], np.array(model.geom_size[geom])
    if kind == "plane":
        return solids.plane((0.0, 0.0, 1.0), 0.0)
    if kind == "sphere":
        return solids.sphere(float(size[0]))
    if kind == "capsule":
        return solids.capsule(float(size[0]), float(2 * size[1]))
    if kind == "cylinder":
        return solids.cylinder(float(size[0]), float(2 * size[1]))
    if kind == "ellipsoid":
        return solids.ellipsoid(2 * size)
    if kind == "box":
        return solids.box(2 * size)
    data = int(model.geom_dataid[geom])
    if kind in ("mesh", "sdf") and data >= 0:
        return _mesh(model, data)
    return _hfield(model, data) if kind == "hfield" else None


def color_of(model: Compiled, geom: int) -> _Array:
    """RGBA of a geom: its own, or if it has not changed that its material's."""
    material, own = int(model.geom_matid[geom]), np.array(model.geom_rgba[geom], dtype=float)
    if material >= 0 and np.allclose(own, [0.5, 0.5, 0.5, 1.0]):
        return np.array(model.mat_rgba[material], dtype=float)
    return own


def _mesh(model: Compiled, mesh: int) -> solids.Solid:
    first, faces = int(model.mesh_vertadr[mesh]), int(model.mesh_faceadr[mesh])
    vertices = model.mesh_vert[first : first + int(model.mesh_vertnum[mesh])]
    return solids.mesh(vertices, model.mesh_face[faces : faces + int(model.mesh_facenum[mesh])])


def _hfield(model: Compiled, field: int) -> solids.Solid:
    rows, cols = int(model.hfield_nrow[field]), int(model.hfield_ncol[field])
    first = int(model.hfield_adr[field])
    heights = np.array(model.hfield_data[first : first + rows * cols], dtype=float).reshape(rows, cols)
    x, y, top, _ = (float(number) for number in model.hfield_size[field])
    # MuJoCo's first row is at the least y.
    return solids.heightfield(heights[::-1] * top, (2 * x / (cols - 1), 2 * y / (rows - 1), 1.0))
