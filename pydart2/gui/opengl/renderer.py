"""The renderer interface that user code draws with: `ri` in `render_with_ri(ri)` and `draw_with_ri(ri)`."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from OpenGL import GL

from pydart2.gui import drawing, geometry
from pydart2.gui.draw_list import between
from pydart2.gui.geometry import Mesh
from pydart2.gui.opengl.flat import FlatRenderer, number, numbers

Array = NDArray[np.float64]


def norm(v: ArrayLike) -> float:
    """Length of a vector, shape (n,), in its unit."""
    return float(np.linalg.norm(v))


def normalize(v: ArrayLike) -> Array:
    """The unit vector along a vector, shape (n,); zeros for zeros."""
    vector = np.asarray(v, dtype=float)
    length = np.linalg.norm(vector)
    return vector / length if length > 0.0 else vector


def rot2d(v: ArrayLike, theta: float) -> Array:
    """A vector of shape (2,) turned by an angle in rad."""
    cos, sin = np.cos(theta), np.sin(theta)
    return np.asarray(np.array([[cos, -sin], [sin, cos]]) @ np.asarray(v, dtype=float))


def rad_to_deg(th: float) -> float:
    """Rad as degrees."""
    return float(np.degrees(th))


def R_axis_angle(axis: ArrayLike, angle: float) -> Array:  # noqa: N802 (the original's)
    """The rotation about an axis of shape (3,) by an angle in rad, shape (3, 3). Rodrigues' formula."""
    x, y, z = normalize(axis)
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.asarray(np.eye(3) + np.sin(angle) * cross + (1.0 - np.cos(angle)) * (cross @ cross))


class Renderer(FlatRenderer):
    """Draws with OpenGL's current matrices and colour, so that OpenGL calls in between work as they look.

    Arrays: points, directions and sizes have shape (3,) and are, in `render_with_ri`, the world's, in m.

    Bodies are lit, and shadowed by the world, as the world is.
    """

    def __init__(self) -> None:
        super().__init__()
        self.quadric: Any = None

    def render_line(self, p0: ArrayLike, p1: ArrayLike) -> None:
        """Draw a line."""
        self.render_lines([p0, p1])

    def render_lines(self, points: Sequence[ArrayLike] | Array) -> None:
        """Draw lines from point to point, (n, 3)."""
        with self._unlit():
            GL.glBegin(GL.GL_LINE_STRIP)
            for point in points:
                GL.glVertex3d(*numbers(point))
            GL.glEnd()

    def render_sphere(self, pos: ArrayLike, r: float, num_seg1: int = 20, num_seg2: int = 10) -> None:
        """Draw a ball. The numbers of segments of the original are of no effect; it is always round."""
        self._solid(geometry.sphere(), _at(pos), (r, r, r))

    def render_box(self, pos: ArrayLike, size: ArrayLike) -> None:
        """Draw a box about `pos` with edges `size` along the axes."""
        self._solid(geometry.box(), _at(pos), size)

    def render_box_two_points(self, p: ArrayLike, q: ArrayLike, sx: float, sy: float) -> None:
        """Draw a box from `p` to `q`, `sx` by `sy` across."""
        start, end = numbers(p), numbers(q)
        if (length := norm(end - start)) > 0.0:
            self._solid(geometry.box(), between(start, end), (sx, sy, length))

    def render_chessboard(
        self, sz: float, n: int = 10, color1: ArrayLike | None = None, color2: ArrayLike | None = None
    ) -> None:
        """Draw a board of `n` by `n` squares, `sz` wide, in the plane y = 0; white and black by default."""
        GL.glPushMatrix()
        GL.glRotated(-90.0, 1.0, 0.0, 0.0)
        self.render_chessboard_xy(sz, n, color1, color2)
        GL.glPopMatrix()

    def render_chessboard_xy(
        self, sz: float, n: int = 10, color1: ArrayLike | None = None, color2: ArrayLike | None = None
    ) -> None:
        """Draw a board of `n` by `n` squares, `sz` wide, in the plane z = 0; white and black by default."""
        GL.glPushAttrib(GL.GL_CURRENT_BIT)
        colors = ((0.9, 0.9, 0.9) if color1 is None else color1, (0.15, 0.15, 0.15) if color2 is None else color2)
        for squares, color in zip(geometry.chessboard(n), colors):
            self.color(*numbers(color))
            self._solid(squares, np.eye(4), (sz, sz, 1.0))
        GL.glPopAttrib()

    def render_cylinder(self, pos: ArrayLike, r: float, h: float, num_seg1: int = 20, num_seg2: int = 10) -> None:
        """Draw a cylinder from `pos` along z. The numbers of segments are of no effect."""
        middle = numbers(pos) + np.array([0.0, 0.0, number(h) / 2.0])
        self._solid(geometry.cylinder(), _at(middle), (r, r, h))

    def render_cylinder_two_points(self, p0: ArrayLike, p1: ArrayLike, radius: float) -> None:
        """Draw a cylinder from one point to another; nothing if they are the same."""
        self._between(geometry.cylinder(), p0, p1, radius)

    def render_arrow(
        self, p: ArrayLike, q: ArrayLike, r_base: float = 0.01, head_width: float = 0.015, head_len: float = 0.01
    ) -> None:
        """Draw an arrow from `p` to `q`: radius of the shaft, radius and length of the head; nothing if p = q."""
        start, end = numbers(p), numbers(q)
        neck = end - min(head_len, norm(end - start)) * normalize(end - start)
        self._between(geometry.cylinder(), start, neck, r_base)
        self._between(geometry.cone(), neck, end, head_width)

    def render_axes(self, pos: ArrayLike, r: float, rgb: bool = True, r_base_: float | None = None) -> None:
        """Draw lines of length `r` along x, y and z with `pos` in their middle; red, green and blue, or as they come.

        `r_base_` is a radius, m, for rods in place of lines.
        """
        middle, r = numbers(pos), number(r)
        GL.glPushAttrib(GL.GL_CURRENT_BIT)
        for axis in np.eye(3):
            if rgb:
                self.color(*axis)
            ends = middle - 0.5 * r * axis, middle + 0.5 * r * axis
            if r_base_ is None:
                self.render_line(*ends)
            else:
                self.render_cylinder_two_points(*ends, r_base_)
        GL.glPopAttrib()

    def _between(self, mesh: Mesh, p: ArrayLike, q: ArrayLike, radius: float) -> None:
        start, end = numbers(p), numbers(q)
        if (length := norm(end - start)) > 0.0:
            self._solid(mesh, between(start, end), (radius, radius, length))

    def _solid(self, mesh: Mesh, pose: Array, size: ArrayLike) -> None:
        GL.glPushMatrix()
        GL.glMultMatrixd(pose.T.copy())
        GL.glScaled(*numbers(size))
        drawing.renderer().draw_fixed(mesh)
        GL.glPopMatrix()


def _at(position: ArrayLike) -> Array:
    pose = np.eye(4)
    pose[:3, 3] = numbers(position)
    return pose
