"""Soft bodies: a rigid core with a skin of point masses on springs."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pydart2.bodynode import BodyNode


class SoftBodyNode(BodyNode):
    """A body whose skin deforms. One row per point mass in the arrays below.

    The points are not among the skeleton's dofs; M, c and the Jacobians are those of the rigid core.
    """

    def build(self) -> None:
        """Link to the other parts of the skeleton."""
        super().build()
        self._soft = self._handle.soft_body()

    def num_points(self) -> int:
        """How many point masses there are."""
        return self._soft.num_points()

    def point_masses(self) -> NDArray[np.float64]:
        """Masses, shape (n,), kg."""
        return self._soft.point_masses()

    def point_displacements(self) -> NDArray[np.float64]:
        """Displacements from rest, body axes, shape (n, 3), m."""
        return self._soft.point_displacements()

    def set_point_displacements(self, displacements: ArrayLike) -> None:
        """Set the displacements from rest, body axes, shape (n, 3), m."""
        self._soft.set_point_displacements(displacements)

    def point_velocities(self) -> NDArray[np.float64]:
        """Rates of the displacements, body axes, shape (n, 3), m/s."""
        return self._soft.point_velocities()

    def set_point_velocities(self, velocities: ArrayLike) -> None:
        """Set the rates of the displacements, body axes, shape (n, 3), m/s."""
        self._soft.set_point_velocities(velocities)

    def point_rest_positions(self) -> NDArray[np.float64]:
        """Where the points are at rest, body frame, shape (n, 3), m."""
        return self._soft.point_rest_positions()

    def point_local_positions(self) -> NDArray[np.float64]:
        """Where the points are, body frame, shape (n, 3), m."""
        return self._soft.point_local_positions()

    def point_world_positions(self) -> NDArray[np.float64]:
        """Where the points are, world frame, shape (n, 3), m."""
        return self._soft.point_world_positions()

    def add_point_forces(self, forces: ArrayLike) -> None:
        """Push the points in the next step, in addition to other forces; world axes, shape (n, 3), N."""
        self._soft.add_point_forces(forces)

    def faces(self) -> NDArray[np.intp]:
        """The triangles of the skin: indices of their points, shape (f, 3)."""
        return self._soft.faces().astype(np.intp)

    def vertex_stiffness(self) -> float:
        """Stiffness of the springs that tie the points to the core, N/m."""
        return self._soft.vertex_stiffness()

    def set_vertex_stiffness(self, stiffness: float) -> None:
        """Set the stiffness of the springs that tie the points to the core, N/m, >= 0."""
        self._soft.set_vertex_stiffness(stiffness)

    def edge_stiffness(self) -> float:
        """Stiffness of the springs between neighbouring points, N/m."""
        return self._soft.edge_stiffness()

    def set_edge_stiffness(self, stiffness: float) -> None:
        """Set the stiffness of the springs between neighbouring points, N/m, >= 0."""
        self._soft.set_edge_stiffness(stiffness)

    def damping_coefficient(self) -> float:
        """Damping of the springs, N s/m."""
        return self._soft.damping_coefficient()

    def set_damping_coefficient(self, coefficient: float) -> None:
        """Set the damping of the springs, N s/m, >= 0."""
        self._soft.set_damping_coefficient(coefficient)

    def __repr__(self) -> str:
        return f"[SoftBodyNode({self.id}): {self.name}]"
