"""Cameras: where the eye is and how wide it sees. NumPy only."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pydart2.cameras import MountedCamera
from pydart2.gui.trackball import Trackball
from pydart2.poses import looking

Matrix = NDArray[np.float64]

#: What is seen, to what shall be seen.
MARGIN = 1.1
_NEAREST = 2.2  # radii: from nearer, what is in front looks much larger than what is behind


@dataclass(frozen=True, eq=False)
class Camera:
    """A perspective camera.

    Attributes
    ----------
    view : (4, 4)
        From the world to the eye, which looks along its -z, with x to the right and y upwards.
    fov : float
        Vertical field of view, rad.
    near, far : float
        What is nearer or further along the optical axis is not drawn, m.
    """

    view: Matrix
    fov: float = np.pi / 4.0
    near: float = 0.01
    far: float = 100.0

    @classmethod
    def look_at(cls, eye: ArrayLike, target: ArrayLike, up: ArrayLike, fov: float = np.pi / 4.0) -> Camera:
        """A camera at `eye` that sees `target` in the middle and `up` upwards, each of shape (3,), m."""
        view = np.eye(4)
        view[:3, :3] = looking(eye, target, up).T
        view[:3, 3] = -view[:3, :3] @ np.asarray(eye, dtype=float)
        return cls(view, fov)

    @classmethod
    def around(
        cls, low: ArrayLike, high: ArrayLike, direction: ArrayLike, up: ArrayLike, fov: float = np.pi / 6.0
    ) -> Camera:
        """A camera that sees the box between two corners (3,), m, from a direction (3,), in a square picture."""
        corners = np.array([low, high], dtype=float)
        back = np.asarray(direction, dtype=float) / np.linalg.norm(direction)
        radius = float(np.linalg.norm(corners[1] - corners[0])) / 2.0
        middle = corners.mean(axis=0)
        return cls.look_at(middle + back * max(radius, 1e-3) / np.sin(fov / 2.0), middle, up, fov)

    @property
    def pose(self) -> Matrix:
        """Of the eye in the world, shape (4, 4), m."""
        return np.asarray(np.linalg.inv(self.view), dtype=float)

    @cached_property
    def position(self) -> NDArray[np.float64]:
        """Of the eye in the world, shape (3,), m."""
        return np.asarray(-np.linalg.solve(self.view[:3, :3], self.view[:3, 3]))

    def projection(self, aspect: float) -> Matrix:
        """From the eye to OpenGL's clip coordinates, shape (4, 4); `aspect` is width / height."""
        top = 1.0 / np.tan(self.fov / 2.0)
        depth = self.near - self.far
        matrix = np.zeros((4, 4))
        matrix[0, 0], matrix[1, 1] = top / aspect, top
        matrix[2, 2:] = (self.far + self.near) / depth, 2.0 * self.far * self.near / depth
        matrix[3, 2] = -1.0
        return matrix


def nearest(turn: Matrix, points: Matrix, fov: float, aspect: float) -> Matrix:
    """Where an eye has the world's origin, shape (3,), m, that sees some points from as near as it can, with a margin.

    From height h and depth d, a point at height y and depth z is seen where ``|y - h| <= (d - z) tan(fov/2)``. The
    least d is that of the points that are an equality above and below; the width has another.

    Parameters
    ----------
    turn
        From the world's to the eye's axes, shape (3, 3).
    points
        In the world, shape (n, 3), m.
    fov, aspect
        Vertical field of view, rad; width / height of the picture.
    """
    seen = points @ turn.T
    slopes = np.tan(fov / 2.0) / MARGIN * np.array([aspect, 1.0])
    above = (seen[:, :2] + slopes * seen[:, 2:]).max(axis=0)
    below = (seen[:, :2] - slopes * seen[:, 2:]).min(axis=0)
    middle = (seen.min(axis=0) + seen.max(axis=0)) / 2.0
    least = middle[2] + _NEAREST * np.linalg.norm(seen - middle, axis=1).max()
    return -np.array([*(above + below) / 2.0, max(np.max((above - below) / (2.0 * slopes)), least)])


def default_trackballs() -> list[tuple[str, Trackball]]:
    """The names and trackballs of cameras 0 and 1."""
    return [
        ("Camera Y up", Trackball(rot=[-0.152, 0.045, -0.002, 0.987], trans=[0.050, 0.210, -2.500])),
        ("Camera Z up", Trackball(rot=[0.535, 0.284, 0.376, 0.701], trans=[0.10, 0.02, -2.770])),
    ]


def as_camera(camera: int | Trackball | Camera | MountedCamera | tuple[ArrayLike, float]) -> Camera:
    """The camera that is meant: 0 (Y up), 1 (Z up), a Trackball, a Camera, one of a world, or (pose of shape (4, 4),
    vertical field of view in rad); the eye of a pose looks along its -z, with y upwards."""
    if isinstance(camera, Camera):
        return camera
    if isinstance(camera, MountedCamera):
        return Camera(np.asarray(np.linalg.inv(camera.eye()), dtype=float), camera.fov)
    if isinstance(camera, Trackball):
        return Camera(camera.view, camera.fov)
    if isinstance(camera, (int, np.integer)):
        trackballs = default_trackballs()
        if not 0 <= camera < len(trackballs):
            raise ValueError(f"no camera {camera}; 0 is Y up, 1 is Z up")
        return Camera(trackballs[int(camera)][1].view)
    if not isinstance(camera, (tuple, list)) or len(camera) != 2:
        raise ValueError(
            "a camera is 0, 1, a name as 'front', a Trackball, a Camera or (pose, field of view in rad), "
            f"not {camera!r}"
        )
    pose, fov = camera
    matrix = np.asarray(pose, dtype=float)
    if matrix.shape != (4, 4) or not np.isfinite(matrix).all() or abs(np.linalg.det(matrix)) < 1e-9:
        raise ValueError(f"a camera's pose is an invertible (4, 4) matrix, not one of shape {matrix.shape}")
    if not 0.0 < fov < np.pi:
        raise ValueError(f"a camera's field of view is an angle between 0 and pi rad, not {fov}")
    return Camera(np.linalg.inv(matrix), float(fov))
