"""Soft bodies that can be added to a world without files."""

from __future__ import annotations

from typing import TYPE_CHECKING, Unpack

import numpy as np
from numpy.typing import ArrayLike

from pydart2.building import solids
from pydart2.building.bodies import DENSITY, BodyOptions, check_options, paint
from pydart2.building.skins import Skin
from pydart2.given import number
from pydart2.simulation.members import Members

if TYPE_CHECKING:
    from pydart2.skeleton import Skeleton


class SoftOptions(BodyOptions, total=False):
    """What all soft bodies have, besides `BodyOptions`.

    Attributes
    ----------
    stiffness
        Of the spring that ties each point of the skin to its place in the body, N/m; by default 500.
    edge_stiffness
        Of the springs between neighbouring points, N/m; by default 0.
    damping
        Of the points' motion in the body, N s/m; by default 5.
    """

    stiffness: float
    edge_stiffness: float
    damping: float


class SoftBuilding(Members):
    """The part of World that adds soft bodies to it.

    Half of the mass is that of the rigid core, spread over the whole inside; half is shared by the points. The core has
    no shape: nothing but the skin collides, before one is added to the body.
    """

    def add_soft_box(
        self,
        size: ArrayLike,
        mass: float | None = None,
        position: ArrayLike = (0.0, 0.0, 0.0),
        *,
        cells: ArrayLike = 2,
        **options: Unpack[SoftOptions],
    ) -> Skeleton:
        """Add a soft box that is free to move.

        Half of the mass is the core's, half the points'. Of the detectors, only "fcl", the default, collides skins.

        Parameters
        ----------
        size
            Edges at rest, shape (3,), m.
        mass
            Of core and skin together, kg; by default by its density.
        position
            Of its centre, shape (3,), m; there it is after a reset, too.
        cells
            Into how many pieces each edge is cut, one number or shape (3,).
        **options
            See `SoftOptions`.
        """
        solid, points = solids.box(size), Skin.box(size, 1.0, cells)
        return self._add_soft(solid, points, mass, position, {"name": "soft_box", **options})

    def add_soft_ellipsoid(
        self,
        size: ArrayLike,
        mass: float | None = None,
        position: ArrayLike = (0.0, 0.0, 0.0),
        *,
        cells: int = 3,
        **options: Unpack[SoftOptions],
    ) -> Skeleton:
        """Add a soft ellipsoid with diameters of shape (3,) at a position of shape (3,), m; as add_soft_box().

        Its points are those of a cube with `cells` by `cells` squares on each side that is blown up.
        """
        solid, points = solids.ellipsoid(size), Skin.ellipsoid(size, 1.0, cells)
        return self._add_soft(solid, points, mass, position, {"name": "soft_ellipsoid", **options})

    def add_soft_sphere(
        self,
        radius: float,
        mass: float | None = None,
        position: ArrayLike = (0.0, 0.0, 0.0),
        *,
        cells: int = 3,
        **options: Unpack[SoftOptions],
    ) -> Skeleton:
        """Add a soft sphere, its radius in m, at a position of shape (3,), m; as add_soft_ellipsoid()."""
        named: SoftOptions = {"name": "soft_sphere", **options}
        return self.add_soft_ellipsoid(np.full(3, 2.0 * number(radius, "radius")), mass, position, cells=cells, **named)

    def add_soft_mesh(
        self,
        vertices: ArrayLike,
        triangles: ArrayLike,
        mass: float | None = None,
        position: ArrayLike = (0.0, 0.0, 0.0),
        **options: Unpack[SoftOptions],
    ) -> Skeleton:
        """Add a soft body with a point at each corner, shape (n, 3), m, of a closed surface.

        Its triangles are indices of the corners, shape (m, 3), counter-clockwise from outside; the position, shape
        (3,), m, is that of the corners' origin. Else as add_soft_box().
        """
        solid, points = solids.mesh(vertices, triangles), Skin.mesh(vertices, triangles, 1.0)
        return self._add_soft(solid, points, mass, position, {"name": "soft_mesh", **options})

    def _add_soft(
        self, solid: solids.Solid, points: Skin, mass: float | None, position: ArrayLike, options: SoftOptions
    ) -> Skeleton:
        check_options(options, SoftOptions)
        half = solid.mass(mass, options.get("density", DENSITY)) / 2.0
        if not 0.0 < half < np.inf or not solid.volume > 0.0:
            raise ValueError("a soft body needs a mass, and a surface that encloses something")
        springs = {name: float(options[name]) for name in ("stiffness", "edge_stiffness", "damping") if name in options}
        with self._all_or_nothing():
            skel = self.add_skeleton_from_id(self._handle.add_empty_skeleton(options["name"]))
            body = skel.add_body(
                options["name"],
                joint="weld" if options.get("fixed", False) else "free",
                position=position,
                orientation=options.get("orientation"),
                mass=half,
                com=solid.com,
                inertia=half * solid.inertia,
                skin=Skin.mesh(points.points, points.triangles, half, **springs),
            )
            paint(body.shapenodes[0]._handle, options)
            return skel
