"""The shadow map: what the light sees."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from OpenGL import GL

from pydart2.gui import placing, shaders
from pydart2.gui.draw_list import Item

Matrix = NDArray[np.float64]

_BLUR = 6.0  # texels that a shadow reaches beyond what throws it: taps, filter, and the push along normals


class Shadow(NamedTuple):
    """A map as it was drawn.

    Attributes
    ----------
    matrix : (4, 4)
        The light's view and projection.
    texel : float
        Its size, m; 0 without shadows.
    corners : (4, 3)
        Of a rectangle across the light in front of which all lies that throws shadows, m.
    light : (3,)
        Towards the light.
    """

    matrix: Matrix
    texel: float
    corners: NDArray[np.float64]
    light: NDArray[np.float64]

    def part_of_picture(
        self, floors: list[Item], up: NDArray[np.float64], view_projection: Matrix, viewport: NDArray[np.int32]
    ) -> tuple[int, int, int, int]:
        """Where shadows may be on these items with up (3,), through a matrix (4, 4) of points in m, in a viewport (4,).

        Result and viewport are x, y, width and height in pixels, as glScissor() has them.
        """
        x, y, width, height = map(int, viewport)
        heights = placing.boxes(floors).reshape(-1, 3) @ up
        if self.light @ up < 0.01:
            return x, y, width, height
        ways = (np.array([[heights.min()], [heights.max()]]) - self.corners @ up) / (self.light @ up)
        points = (self.corners + ways[..., None] * self.light).reshape(-1, 3)
        seen = points @ view_projection[:, :3].T + view_projection[:, 3]
        if seen[:, 3].min() < 1e-6:  # behind the eye
            return x, y, width, height
        size = np.array([width, height])
        pixels = np.clip((seen[:, :2] / seen[:, 3:] + 1.0) / 2.0 * size, 0.0, size)
        low, high = np.floor(pixels.min(axis=0)).astype(int), np.ceil(pixels.max(axis=0)).astype(int)
        return x + int(low[0]), y + int(low[1]), int(high[0] - low[0]), int(high[1] - low[1])


class ShadowMap:
    """A depth picture from the light, `size` pixels wide and high."""

    def __init__(self, size: int) -> None:
        self.size = size
        self.program = shaders.shadow()
        self.texture = int(GL.glGenTextures(1))
        GL.glBindTexture(GL.GL_TEXTURE_2D, self.texture)
        kind = (GL.GL_DEPTH_COMPONENT, GL.GL_UNSIGNED_INT)
        GL.glTexImage2D(GL.GL_TEXTURE_2D, 0, GL.GL_DEPTH_COMPONENT16, size, size, 0, *kind, None)
        for key, value in (
            (GL.GL_TEXTURE_MIN_FILTER, GL.GL_LINEAR),
            (GL.GL_TEXTURE_MAG_FILTER, GL.GL_LINEAR),
            (GL.GL_TEXTURE_WRAP_S, GL.GL_CLAMP_TO_EDGE),
            (GL.GL_TEXTURE_WRAP_T, GL.GL_CLAMP_TO_EDGE),
            (GL.GL_TEXTURE_COMPARE_MODE, GL.GL_COMPARE_REF_TO_TEXTURE),
        ):
            GL.glTexParameteri(GL.GL_TEXTURE_2D, key, value)
        GL.glBindTexture(GL.GL_TEXTURE_2D, 0)
        self._framebuffer = int(GL.glGenFramebuffers(1))

    def begin(self, matrix: Matrix) -> Any:
        """Draw into the map from now on, through a matrix (4, 4) of points in m; returns what `end` wants."""
        before = GL.glGetIntegerv(GL.GL_DRAW_FRAMEBUFFER_BINDING), GL.glGetIntegerv(GL.GL_VIEWPORT)
        GL.glBindFramebuffer(GL.GL_DRAW_FRAMEBUFFER, self._framebuffer)
        target = (GL.GL_DRAW_FRAMEBUFFER, GL.GL_DEPTH_ATTACHMENT, GL.GL_TEXTURE_2D)
        GL.glFramebufferTexture2D(*target, self.texture, 0)
        GL.glViewport(0, 0, self.size, self.size)
        GL.glClear(GL.GL_DEPTH_BUFFER_BIT)
        GL.glEnable(GL.GL_POLYGON_OFFSET_FILL)
        GL.glPolygonOffset(1.5, 2.0)
        self.program.use()
        self.program.set(view_projection=matrix)
        return before

    def end(self, before: Any) -> None:
        """Draw again where that was done before."""
        GL.glDisable(GL.GL_POLYGON_OFFSET_FILL)
        GL.glBindFramebuffer(GL.GL_DRAW_FRAMEBUFFER, int(before[0]))
        GL.glViewport(*before[1])

    def fit(self, casters: list[Item], light: NDArray[np.float64]) -> Shadow:
        """The map around what throws shadows, lengths in m, with the light in a direction (3,).

        The edges keep to a coarse grid, so that shadows do not flicker when things move.
        """
        turn = placing.between(np.zeros(3), light)[:3, :3].T
        corners = np.stack(np.meshgrid([0, 1], [0, 1], [0, 1]), axis=-1).reshape(-1, 3)
        bounds = placing.boxes(casters)
        points = np.where(corners[None], bounds[:, 1, None], bounds[:, 0, None]).reshape(-1, 3) @ turn.T
        low, high = points.min(axis=0), points.max(axis=0)
        size = max(float((high - low)[:2].max()), 1e-3)
        size = 1.25 ** np.ceil(np.log(1.05 * size) / np.log(1.25))
        texel = size / self.size
        grid = 16.0 * texel
        middle = np.round((low + high) / 2.0 / grid) * grid
        depth = float(high[2] - low[2]) + 2.0 * grid
        matrix = np.eye(4)
        matrix[:3, :3] = turn
        matrix[:3, 3] = -middle
        around = np.array([low, high])[:, :2] + [[-_BLUR * texel], [_BLUR * texel]]
        edges = np.array([[x, y, middle[2]] for x in around[:, 0] for y in around[:, 1]]) @ turn
        return Shadow(np.diag([2.0 / size, 2.0 / size, -2.0 / depth, 1.0]) @ matrix, texel, edges, light)
