"""A camera that turns about a point as if a ball were rolled with the mouse. NumPy only."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

_BALL = 0.8  # radius of the ball in half viewports
#: Vertical field of view of a trackball camera, rad.
FIELD_OF_VIEW = np.pi / 4.0
_ZOOM, _DISTANCE = (0.25, 10.0), 1.0


class Trackball:
    """Where the camera is: the world is turned by `matrix`, then moved by `trans`; the eye is at 0 and looks along -z.

    >>> tb = Trackball(rot=[-0.152, 0.045, -0.002, 0.987], trans=[0.05, 0.21, -2.5])
    >>> tb.trans[2] = -5.0  # further away

    Parameters
    ----------
    theta, phi
        Degrees about the eye's x axis, and about the world's z axis.
    zoom
        Only for `push`; 0.25 to 10.
    rot
        Quaternion [x, y, z, w] of the eye in the world; instead of theta and phi.
    trans
        Where the world's origin is in the eye's axes, m; the list is kept, and may be changed in place.
    distance
        Only for `push`, m, at least 1.

    Attributes
    ----------
    viewport : (width, height)
        Pixels of the picture, for `drag_to`.
    fov : float
        Vertical field of view, rad.
    """

    fov: float = FIELD_OF_VIEW

    def __init__(
        self,
        theta: float = 0,
        phi: float = 0,
        zoom: float = 1,
        rot: Sequence[float] | None = None,
        trans: list[float] | None = None,
        distance: float = 3,
    ) -> None:
        self.viewport = (1280, 720)
        self.zoom = zoom
        self.distance = distance
        self._trans = [0.0, 0.0, -1.2] if trans is None else trans
        self._theta, self._phi = float(theta), float(phi)
        if rot is None:
            self._set_orientation(theta, phi)
        else:
            self._set_rotation(rot)

    @property
    def trans(self) -> list[float]:
        """Where the world's origin is in the eye's axes, 3 numbers, m; may be changed in place."""
        return self._trans

    @property
    def matrix(self) -> NDArray[np.float32]:
        """Rotation from the world's to the eye's axes, 16 numbers as glMultMatrix takes them (column by column)."""
        return self._matrix.astype(np.float32)

    @property
    def view(self) -> NDArray[np.float64]:
        """From the world's to the eye's coordinates, shape (4, 4)."""
        view = self._matrix.reshape(4, 4).T.copy()
        view[:3, 3] = self._trans
        return view

    @property
    def zoom(self) -> float:
        """Factor of `push`, 0.25 to 10."""
        return self._zoom

    @zoom.setter
    def zoom(self, zoom: float) -> None:
        self._zoom = float(np.clip(zoom, *_ZOOM))

    @property
    def distance(self) -> float:
        """Distance of `push`, m, at least 1."""
        return self._distance

    @distance.setter
    def distance(self, distance: float) -> None:
        self._distance = max(float(distance), _DISTANCE)

    @property
    def theta(self) -> float:
        """Tilt about the eye's x axis, degrees."""
        return self._get_orientation()[0]

    @theta.setter
    def theta(self, theta: float) -> None:
        self._set_theta(theta)

    @property
    def phi(self) -> float:
        """Turn about the world's z axis, degrees."""
        return self._get_orientation()[1]

    @phi.setter
    def phi(self, phi: float) -> None:
        self._set_phi(phi)

    def drag_to(self, x: float, y: float, dx: float, dy: float) -> None:
        """Turn the ball: the mouse came to (x, y) by (dx, dy), pixels from the lower left corner, y upwards."""
        half = np.array(self.viewport) / 2.0
        end = np.array([x, y]) / half - 1.0
        start = end - np.array([dx, dy]) / half
        a, b = _on_ball(start), _on_ball(end)
        axis = np.cross(a, b)
        length = np.linalg.norm(axis)
        if length == 0.0:
            return
        # A way as long as the radius turns by 60 degrees, as on a ball that one looks at.
        angle = 2.0 * np.arcsin(min(float(np.linalg.norm(b - a)) / (2.0 * _BALL), 1.0))
        turn = np.append(np.sin(angle / 2.0) * axis / length, np.cos(angle / 2.0))
        self._set_rotation(_multiply(self._rotation, _conjugate(turn)))

    def zoom_to(self, dx: float, dy: float) -> None:
        """Bring the world nearer by 1 cm a pixel."""
        self._trans[2] += 0.01 * (dx + dy)

    def trans_to(self, dx: float, dy: float) -> None:
        """Move the world right and up by 1 cm a pixel."""
        self._trans[0] += 0.01 * dx
        self._trans[1] += 0.01 * dy

    def push(self) -> None:
        """Save OpenGL's matrices and load those of this camera, with `zoom` and `distance` in place of `trans`."""
        from OpenGL import GL

        width, height = GL.glGetIntegerv(GL.GL_VIEWPORT)[2:]
        top = 0.1 * np.tan(np.radians(35.0 / 2.0)) * self._zoom
        GL.glMatrixMode(GL.GL_PROJECTION)
        GL.glPushMatrix()
        GL.glLoadIdentity()
        GL.glFrustum(-top * width / height, top * width / height, -top, top, 0.1, 100.0)
        GL.glMatrixMode(GL.GL_MODELVIEW)
        GL.glPushMatrix()
        GL.glLoadIdentity()
        GL.glTranslatef(0.0, 0.0, -self._distance)
        GL.glMultMatrixd(self._matrix)

    def pop(self) -> None:
        """Give OpenGL the matrices back that `push` saved."""
        from OpenGL import GL

        GL.glMatrixMode(GL.GL_MODELVIEW)
        GL.glPopMatrix()
        GL.glMatrixMode(GL.GL_PROJECTION)
        GL.glPopMatrix()
        GL.glMatrixMode(GL.GL_MODELVIEW)

    def _set_theta(self, theta: float) -> None:
        self._set_orientation(theta, self._phi)

    def _set_phi(self, phi: float) -> None:
        self._set_orientation(self._theta, phi)

    def _set_orientation(self, theta: float, phi: float) -> None:
        self._theta, self._phi = float(np.fmod(theta, 360.0)), float(np.fmod(phi, 360.0))
        half = np.radians([self._theta, self._phi]) / 2.0
        (sin_x, sin_z), (cos_x, cos_z) = np.sin(half), np.cos(half)
        about_x, about_z = np.array([sin_x, 0.0, 0.0, cos_x]), np.array([0.0, 0.0, sin_z, cos_z])
        self._set_rotation(_multiply(about_z, about_x))

    def _get_orientation(self) -> tuple[float, float]:
        rotation = self._matrix.reshape(4, 4).T
        theta = np.degrees(np.arctan2(rotation[1, 2], rotation[2, 2]))
        phi = np.degrees(np.arctan2(rotation[0, 1], rotation[0, 0]))
        return float(theta), float(phi)

    def _set_rotation(self, quaternion: Sequence[float] | NDArray[np.float64]) -> None:
        q = np.asarray(quaternion, dtype=float)
        norm = float(np.linalg.norm(q))
        if q.shape != (4,) or not 0.0 < norm < np.inf:
            raise ValueError(f"a trackball's rot is a quaternion [x, y, z, w], not {list(quaternion)}")
        self._rotation = q / norm
        x, y, z, w = self._rotation
        eye = np.eye(4)  # the eye's axes in the world, column by column: the transpose turns the world
        eye[:3, :3] = [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (z * x + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (z * x - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
        self._matrix = eye.reshape(16)

    def __str__(self) -> str:
        return f"Trackball(phi={self.phi:g},theta={self.theta:g},zoom={self.zoom:g})"

    def __repr__(self) -> str:
        rot, trans = (", ".join(f"{v:.3f}" for v in values) for values in (self._rotation, self._trans))
        return f"Trackball(rot=[{rot}], \ntrans=[{trans}])"


def _on_ball(point: NDArray[np.float64]) -> NDArray[np.float64]:
    """The point of the ball over a point of the picture; of a hyperbola around it where the ball has fallen away."""
    squared = float(point @ point)
    flat = _BALL**2 / 2.0
    height = np.sqrt(_BALL**2 - squared) if squared < flat else flat / np.sqrt(squared)
    return np.append(point, height)


def _multiply(a: NDArray[np.float64], b: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.append(a[3] * b[:3] + b[3] * a[:3] + np.cross(a[:3], b[:3]), a[3] * b[3] - a[:3] @ b[:3])


def _conjugate(q: NDArray[np.float64]) -> NDArray[np.float64]:
    return q * [-1.0, -1.0, -1.0, 1.0]
