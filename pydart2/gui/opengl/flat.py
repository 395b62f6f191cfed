"""The part of `ri` that sets the state and draws in the plane."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from OpenGL import GL

from pydart2.gui import drawing, text
from pydart2.gui.buffers import upload_texture

Array = NDArray[np.float64]


class FlatRenderer:
    """State, text, textures, and drawing in pixels from the upper left corner.

    Arrays: points have shape (2,) and are in pixels, as sizes are; matrices have shape (4, 4).

    Attributes
    ----------
    textures : list of int
        Those of `gen_textures`.
    """

    def __init__(self) -> None:
        self.textures: list[int] = []

    # State

    def color(self, r: float, g: float, b: float, a: float = 1.0) -> None:
        """Draw in this colour from now on, 0 to 1."""
        GL.glColor4d(r, g, b, a)

    def set_color(self, r: float, g: float, b: float, a: float = 1.0) -> None:
        """Draw in this colour from now on, 0 to 1."""
        self.color(r, g, b, a)

    def push(self) -> None:
        """Save the transform."""
        GL.glPushMatrix()

    def pop(self) -> None:
        """Go back to the transform that was saved last."""
        GL.glPopMatrix()

    def parse_flag(self, x: Any) -> Any:
        """OpenGL's number for a name as "COLOR_MATERIAL"; numbers stay."""
        if not isinstance(x, str):
            return x
        name = x if x.startswith("GL_") else f"GL_{x}"
        if not hasattr(GL, name):
            raise ValueError(f"OpenGL has no {name}")
        return getattr(GL, name)

    def enable(self, x: Any) -> None:
        """Switch something of OpenGL on."""
        GL.glEnable(self.parse_flag(x))

    def disable(self, x: Any) -> None:
        """Switch something of OpenGL off."""
        GL.glDisable(self.parse_flag(x))

    def translate(self, x: float, y: float, z: float = 0.0) -> None:
        """Move what is drawn from now on."""
        GL.glTranslated(x, y, z)

    def scale(self, x: float, y: float, z: float = 1.0) -> None:
        """Stretch what is drawn from now on."""
        GL.glScaled(x, y, z)

    def rotate2d(self, angle_in_rad: float) -> None:
        """Turn what is drawn from now on about z."""
        GL.glRotated(np.degrees(angle_in_rad), 0.0, 0.0, 1.0)

    def mult_matrix(self, m: ArrayLike) -> None:
        """Transform what is drawn from now on by a matrix (4, 4)."""
        GL.glMultMatrixd(np.asarray(m, dtype=float).reshape(4, 4).T.copy())

    def mult_matrix_raw(self, m: ArrayLike) -> None:
        """Transform what is drawn from now on by a matrix of 16 numbers, column by column."""
        GL.glMultMatrixd(np.asarray(m, dtype=float).reshape(16))

    def line_width(self, w: float) -> None:
        """Draw lines so many pixels wide from now on."""
        GL.glLineWidth(w)

    def set_line_width(self, w: float) -> None:
        """Draw lines so many pixels wide from now on."""
        GL.glLineWidth(w)

    def project(self, x: float, y: float, z: float, auto_flip_vertical: bool = True) -> list[float]:
        """Where a point of the world is in the picture: pixels from the upper left corner (from the lower left one
        without flipping), and depth from 0 (near) to 1 (far). In `draw_with_ri` too."""
        px, py, depth = _in_picture(self._to_clip(), (x, y, z))
        return [px, py if auto_flip_vertical else float(GL.glGetIntegerv(GL.GL_VIEWPORT)[3]) - py, depth]

    def unproject(self, x: float, y: float, z: float, auto_flip_vertical: bool = True) -> list[float]:
        """The point of the world that `project` takes to (x, y, z)."""
        _, _, width, height = GL.glGetIntegerv(GL.GL_VIEWPORT)
        up = 1.0 - 2.0 * y / height if auto_flip_vertical else 2.0 * y / height - 1.0
        point = np.linalg.solve(self._to_clip(), [2.0 * x / width - 1.0, up, 2.0 * z - 1.0, 1.0])
        return [float(v) for v in point[:3] / point[3]]

    def _to_clip(self) -> Array:
        view, projection = drawing.matrices()
        if projection[3, 3] == 1.0:  # parallel: this is draw_with_ri, and the camera is put away
            view, projection = drawing.renderer().frame_matrices
        return projection @ view

    # In the plane

    def draw_line(self, p0: ArrayLike, p1: ArrayLike) -> None:
        """Draw a line."""
        self._draw(GL.GL_LINES, [p0, p1])

    def draw_arrow(self, p0: ArrayLike, p1: ArrayLike, head_len: float = 20.0, head_angle: float = 0.25) -> None:
        """Draw an arrow of lines from `p0` to `p1`; the head's lines are at `head_angle` * pi rad to the shaft."""
        start, end = numbers(p0)[:2], numbers(p1)[:2]
        self.draw_line(start, end)
        if (length := float(np.linalg.norm(end - start))) == 0.0:
            return
        back = (start - end) / length * head_len
        for angle in (head_angle * np.pi, -head_angle * np.pi):
            cos, sin = np.cos(angle), np.sin(angle)
            self.draw_line(end, end + np.array([cos * back[0] - sin * back[1], sin * back[0] + cos * back[1]]))

    def draw_box(
        self, sx: float, sy: float, center: ArrayLike | None = None, angle: float | None = None, fill: bool = False
    ) -> None:
        """Draw a rectangle, turned by an angle in rad about its middle."""
        x, y = number(sx) / 2.0, number(sy) / 2.0
        corners = np.array([(-x, -y), (x, -y), (x, y), (-x, y)])
        self._outline(corners, center, angle, fill)

    def draw_circle(
        self, r: float, num_segments: int = 20, center: ArrayLike | None = None, fill: bool = False
    ) -> None:
        """Draw a circle of radius `r`."""
        self.draw_ellipse_at(r, r, center, None, num_segments, fill)

    def draw_ellipse(self, p0: ArrayLike, p1: ArrayLike, b: float, num_segments: int = 20, fill: bool = False) -> None:
        """Draw an ellipse by the ends of its long axis, marked with circles of radius 5, and its half short axis."""
        start, end = numbers(p0)[:2], numbers(p1)[:2]
        along = end - start
        half, angle = float(np.linalg.norm(along)) / 2.0, float(np.arctan2(along[1], along[0]))
        self.draw_ellipse_at(half, b, (start + end) / 2.0, angle, num_segments, fill)
        for mark in (start, end):
            self.draw_circle(5.0, center=mark, fill=fill)

    def draw_ellipse_at(
        self,
        a: float,
        b: float,
        center: ArrayLike | None = None,
        angle: float | None = None,
        num_segments: int = 20,
        fill: bool = False,
    ) -> None:
        """Draw an ellipse with these half axes, turned by an angle in rad about its middle."""
        turn = np.linspace(0.0, 2.0 * np.pi, num_segments, endpoint=False)
        self._outline(np.stack([number(a) * np.cos(turn), number(b) * np.sin(turn)], axis=1), center, angle, fill)

    def draw_text(self, pos: ArrayLike, text: str, font: Any = 18) -> None:
        """Draw a line of text whose baseline starts at `pos`, 2 or 3 numbers. `font` is a height in pixels or one of
        GLUT's bitmap fonts."""
        view, projection = drawing.matrices()
        _draw_text(drawing.renderer().letters, *_in_picture(projection @ view, pos), str(text), font)

    def draw_image(
        self, sx: float, sy: float, texture: int = -1, center: ArrayLike | None = None, angle: float | None = None
    ) -> None:
        """Draw a texture, by default the last one, `sx` wide and `sy` high, turned by an angle in rad."""
        corners = _placed(np.array([(-sx, -sy), (sx, -sy), (sx, sy), (-sx, sy)]) / 2.0, center, angle)
        with self._unlit():
            GL.glEnable(GL.GL_TEXTURE_2D)
            GL.glTexEnvi(GL.GL_TEXTURE_ENV, GL.GL_TEXTURE_ENV_MODE, GL.GL_REPLACE)
            self.bind_texture(texture)
            GL.glBegin(GL.GL_QUADS)
            for corner, place in zip(corners, ((0.0, 1.0), (1.0, 1.0), (1.0, 0.0), (0.0, 0.0))):
                GL.glTexCoord2d(*place)
                GL.glVertex2d(*corner)
            GL.glEnd()
            GL.glBindTexture(GL.GL_TEXTURE_2D, 0)

    # Textures

    def gen_textures(self, num_textures: int = 1) -> list[int]:
        """Make textures; their names, which `textures` has too."""
        made = [int(name) for name in np.atleast_1d(GL.glGenTextures(num_textures))]
        self.textures += made
        return made

    def delete_textures(self, textures: int | Sequence[int]) -> None:
        """Free textures."""
        names = [int(name) for name in np.atleast_1d(textures)]
        GL.glDeleteTextures(len(names), names)
        self.textures = [name for name in self.textures if name not in names]

    def bind_texture(self, texture: int) -> None:
        """Draw with a texture from now on; -1 is the last one."""
        GL.glBindTexture(GL.GL_TEXTURE_2D, self._texture(texture))

    def set_texture_as_image(self, img: Any, texture: int = -1) -> None:
        """Give a texture, by default the last one, the pixels of a Pillow picture."""
        upload_texture(np.asarray(img.convert("RGBA"))[::-1], self._texture(texture))

    def _texture(self, texture: int) -> int:
        if texture != -1:
            return int(texture)
        if not self.textures:
            raise ValueError("there is no texture yet; gen_textures() makes one")
        return self.textures[-1]

    # How

    def _outline(self, points: Array, center: ArrayLike | None, angle: float | None, fill: bool) -> None:
        self._draw(GL.GL_POLYGON if fill else GL.GL_LINE_LOOP, _placed(points, center, angle))

    def _draw(self, kind: int, points: Sequence[ArrayLike] | Array) -> None:
        with self._unlit():
            GL.glBegin(kind)
            for point in points:
                GL.glVertex2d(*numbers(point)[:2])
            GL.glEnd()

    @contextmanager
    def _unlit(self) -> Iterator[None]:
        """In the current colour as it is; all state as before afterwards."""
        GL.glPushAttrib(GL.GL_ENABLE_BIT | GL.GL_TEXTURE_BIT)
        GL.glUseProgram(0)
        GL.glDisable(GL.GL_LIGHTING)
        GL.glDisable(GL.GL_TEXTURE_2D)
        GL.glEnable(GL.GL_BLEND)
        try:
            yield
        finally:
            GL.glPopAttrib()


def number(value: ArrayLike) -> float:
    """A length (m or pixels) or an angle (rad), which old code gives in an array of shape (1,) too."""
    return float(np.asarray(value, dtype=float).item())


def numbers(values: Any) -> Array:
    """A point or a size (m or pixels), or a colour (0 to 1), shape (n,); its entries may be arrays of one element."""
    return np.array([number(value) for value in values])


def _placed(points: Array, center: ArrayLike | None, angle: float | None) -> Array:
    if angle:
        cos, sin = np.cos(number(angle)), np.sin(number(angle))
        points = points @ np.array([[cos, sin], [-sin, cos]])
    return points if center is None else points + numbers(center)[:2]


def _in_picture(to_clip: Array, position: ArrayLike) -> tuple[float, float, float]:
    """Pixels from the upper left corner of the viewport, and depth from 0 to 1."""
    clip = to_clip @ np.append(np.append(numbers(position), 0.0)[:3], 1.0)
    x, y, z = clip[:3] / clip[3]
    _, _, width, height = GL.glGetIntegerv(GL.GL_VIEWPORT)
    return float(width * (1.0 + x) / 2.0), float(height * (1.0 - y) / 2.0), float((1.0 + z) / 2.0)


def _draw_text(letters: dict[int, int], x: float, y: float, depth: float, line: str, font: Any) -> None:
    """Quads with the letters of an atlas, in the picture; `letters` has the textures by size."""
    atlas = text.atlas(size := text.size_of(font))
    if size not in letters:
        letters[size] = upload_texture(atlas.pixels)
    height, width = atlas.pixels.shape[:2]
    w, h = atlas.cell
    with _pixels():
        GL.glBindTexture(GL.GL_TEXTURE_2D, letters[size])
        GL.glTexParameteri(GL.GL_TEXTURE_2D, GL.GL_TEXTURE_MIN_FILTER, GL.GL_NEAREST)
        GL.glBegin(GL.GL_QUADS)
        for letter in text.plain(line):
            glyph = atlas.glyphs[letter]
            left, top = round(x) - 1, round(y) - atlas.ascent
            for dx, dy in ((0, 0), (w, 0), (w, h), (0, h)):
                GL.glTexCoord2d((glyph.x + dx) / width, (glyph.y + dy) / height)
                GL.glVertex3d(left + dx, top + dy, -depth)
            x += glyph.advance
        GL.glEnd()
        GL.glBindTexture(GL.GL_TEXTURE_2D, 0)


@contextmanager
def _pixels() -> Iterator[None]:
    """Draw textures in the current colour, in pixels of the viewport from its upper left corner; all state as before
    afterwards."""
    _, _, width, height = GL.glGetIntegerv(GL.GL_VIEWPORT)
    GL.glPushAttrib(GL.GL_ENABLE_BIT | GL.GL_TEXTURE_BIT | GL.GL_TRANSFORM_BIT | GL.GL_DEPTH_BUFFER_BIT)
    GL.glDepthMask(False)  # letters overlap
    GL.glUseProgram(0)
    GL.glDisable(GL.GL_LIGHTING)
    GL.glEnable(GL.GL_BLEND)
    GL.glEnable(GL.GL_TEXTURE_2D)
    GL.glTexEnvi(GL.GL_TEXTURE_ENV, GL.GL_TEXTURE_ENV_MODE, GL.GL_MODULATE)
    for mode in (GL.GL_PROJECTION, GL.GL_MODELVIEW):
        GL.glMatrixMode(mode)
        GL.glPushMatrix()
        GL.glLoadIdentity()
    GL.glMatrixMode(GL.GL_PROJECTION)
    GL.glOrtho(0.0, width, height, 0.0, 0.0, 1.0)
    try:
        yield
    finally:
        for mode in (GL.GL_PROJECTION, GL.GL_MODELVIEW):
            GL.glMatrixMode(mode)
            GL.glPopMatrix()
        GL.glPopAttrib()
