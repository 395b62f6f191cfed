"""Skeletons with muscles."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from pydart2.errors import PydartError
from pydart2.muscle.route import Route
from pydart2.muscle.tendon_unit import MusculoTendonUnit
from pydart2.skeleton import Skeleton

if TYPE_CHECKING:
    from pydart2.bodynode import BodyNode


class MusculoSkeleton(Skeleton):
    """A skeleton whose bodies are pulled by muscles: ``world.add_skeleton(path, MusculoSkeleton)``.

    Before each step of the world call stimulate() and apply_muscle_forces().

    Attributes
    ----------
    muscles : list of (MusculoTendonUnit, Route)
    """

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        self.muscles: list[tuple[MusculoTendonUnit, Route]] = []
        super().__init__(*args, **kwargs)

    def build(self) -> None:
        """Make all parts anew, and attach the muscles to the new bodies."""
        super().build()
        for _, route in self.muscles:
            route.initialize_points(self)

    def _check_may_leave(self, bodies: list[BodyNode]) -> None:
        """ValueError if a muscle is fixed to one of the bodies."""
        for _, route in self.muscles:
            held = next((point.body for point in route.points if point.body in bodies), None)
            if held is not None:
                raise ValueError(f"a muscle of {self.name!r} is fixed to {held.name!r}; take it from `muscles` before")

    def num_muscles(self) -> int:
        """How many muscles there are."""
        return len(self.muscles)

    def add_muscle(self, mtu: MusculoTendonUnit, route: Route) -> None:
        """Add a muscle.

        Raises
        ------
        NameNotFound
            If the route names a body that is not there.
        ValueError
            If the route has less than two points.
        """
        route.initialize_points(self)
        self.muscles.append((mtu, route))

    def update(self) -> None:
        """Bring the muscles up to date with the pose, the same as update_route_geometry()."""
        self.update_route_geometry()

    def update_route_geometry(self) -> None:
        """Compute the routes of all muscles anew from the pose."""
        for _, route in self.muscles:
            route.update_geometry_variables()

    def reset_muscles(self) -> None:
        """Let all muscles go back to the begin."""
        for mtu, _ in self.muscles:
            mtu.reset()
        self.update_route_geometry()

    def stimulate(self, stimulation: ArrayLike) -> None:
        """Let all muscles take a step of their TIMESTEP at their length in the present pose.

        Parameters
        ----------
        stimulation
            Of each muscle, 0 to 1, shape (num_muscles(),).

        Raises
        ------
        ValueError
            If the shape is another or a number is not finite.
        """
        values = np.asarray(stimulation, dtype=float)
        if values.shape != (len(self.muscles),) or not np.all(np.isfinite(values)):
            raise ValueError(f"{len(self.muscles)} finite numbers expected, got {stimulation!r}")
        self.update_route_geometry()
        for (mtu, route), value in zip(self.muscles, values):
            assert route.length is not None
            mtu.update(float(value), route.length)

    def apply_muscle_forces(self) -> None:
        """Add the forces of all muscles to the bodies, for the next step of the world.

        A muscle pulls the two ends of each segment of its route towards each other. Segments between points of one
        body have no effect.

        Raises
        ------
        PydartError
            If a muscle has no force yet: call stimulate() before.
        """
        for mtu, route in self.muscles:
            if mtu.F_mtu is None:
                raise PydartError(f"{mtu!r} has no force yet: stimulate() comes before apply_muscle_forces()")
            segments = zip(route.bodynodes_as_pair(), route.local_points_as_pair(), route.world_directions)
            for (body0, body1), (offset0, offset1), direction in segments:
                if body0.id != body1.id:
                    body0.add_ext_force(mtu.F_mtu * direction, offset0, False, True)
                    body1.add_ext_force(-mtu.F_mtu * direction, offset1, False, True)

    def render_with_ri(self, ri: Any) -> None:
        """Draw the muscles with a renderer, from blue at activation 0 to red at 1."""
        self.update_route_geometry()
        for mtu, route in self.muscles:
            ri.set_color(mtu.a, 0.0, 1.0 - mtu.a)
            route.render_with_ri(ri)

    def __repr__(self) -> str:
        return f"[MusculoSkeleton({self.id}): {self.name} # Muscles = {len(self.muscles)}]"
