"""Meshes, instances and textures in the memory of the graphics card."""

from __future__ import annotations

import ctypes
import logging
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from OpenGL import GL

from pydart2.gui import shaders
from pydart2.gui.geometry import Mesh

_log = logging.getLogger("pydart2")

INSTANCE_FLOATS = 20  # rows of the transform 12, colour 4, extra 4
_KEEP_FRAMES = 200  # a mesh that was not drawn for so long may go


class Part(NamedTuple):
    """Where a mesh is in the buffers of its pool."""

    indices: int
    first_index: int
    base_vertex: int


class Pool:
    """Meshes of one vertex format, one after another in the same buffers, so that one call draws many.

    Parameters
    ----------
    instances
        Name of the buffer that the rows of the instances will be in.
    rich
        Whether vertices have texture coordinates and colours.
    """

    def __init__(self, instances: int, rich: bool) -> None:
        self.rich = rich
        self.vao: int = GL.glGenVertexArrays(1)
        self._vertices, self._indices = (int(name) for name in GL.glGenBuffers(2))
        self._parts: dict[Mesh, Part] = {}
        self._used: dict[Mesh, int] = {}
        GL.glBindVertexArray(self.vao)
        GL.glBindBuffer(GL.GL_ELEMENT_ARRAY_BUFFER, self._indices)
        GL.glBindBuffer(GL.GL_ARRAY_BUFFER, self._vertices)
        attributes = [(shaders.POSITION, 3), (shaders.NORMAL, 3)]
        attributes += [(shaders.COORDINATES, 2), (shaders.COLOR, 4)] if rich else []
        _declare(attributes, 0)
        GL.glBindBuffer(GL.GL_ARRAY_BUFFER, instances)
        _declare([(shaders.INSTANCE + i, 4) for i in range(5)], 1)
        GL.glBindVertexArray(0)
        GL.glBindBuffer(GL.GL_ARRAY_BUFFER, 0)

    def require(self, meshes: set[Mesh], frame: int) -> None:
        """Have these meshes in the buffers from now on; those not used for long are dropped when others come."""
        self._used.update(dict.fromkeys(meshes, frame))
        if meshes <= self._parts.keys():
            return
        self._used = {mesh: last for mesh, last in self._used.items() if last > frame - _KEEP_FRAMES}
        self._parts = {}
        first_index = base_vertex = 0
        for mesh in self._used:
            self._parts[mesh] = Part(mesh.triangles.size, first_index, base_vertex)
            first_index += mesh.triangles.size
            base_vertex += len(mesh.vertices)
        self._upload()

    def set(self, meshes: set[Mesh]) -> None:
        """Have only these meshes in the buffers."""
        self._parts, self._used = {}, {}
        self.require(meshes, 0)

    def part(self, mesh: Mesh) -> Part:
        """Where a mesh is."""
        return self._parts[mesh]

    def _upload(self) -> None:
        vertices = np.concatenate([self._rows(mesh) for mesh in self._parts])
        indices = np.concatenate([mesh.triangles.reshape(-1) for mesh in self._parts])
        GL.glBindVertexArray(0)
        for target, name, data in (
            (GL.GL_ARRAY_BUFFER, self._vertices, vertices),
            (GL.GL_ELEMENT_ARRAY_BUFFER, self._indices, indices),
        ):
            GL.glBindBuffer(target, name)
            GL.glBufferData(target, data.nbytes, data, GL.GL_STATIC_DRAW)
            GL.glBindBuffer(target, 0)

    def _rows(self, mesh: Mesh) -> NDArray[np.float32]:
        columns = [mesh.vertices, mesh.normals]
        if self.rich:
            count, coordinates, colors = len(mesh.vertices), mesh.texture_coordinates, mesh.colors
            columns.append(np.zeros((count, 2), np.float32) if coordinates is None else coordinates)
            columns.append(np.ones((count, 4), np.float32) if colors is None else colors)
        return np.hstack(columns)


def _declare(attributes: list[tuple[int, int]], divisor: int) -> None:
    """Interleaved float attributes (location, numbers) of the buffer that is bound."""
    stride = 4 * sum(numbers for _, numbers in attributes)
    offset = 0
    for location, numbers in attributes:
        GL.glEnableVertexAttribArray(location)
        GL.glVertexAttribPointer(location, numbers, GL.GL_FLOAT, GL.GL_FALSE, stride, ctypes.c_void_p(offset))
        GL.glVertexAttribDivisor(location, divisor)
        offset += 4 * numbers


class Textures:
    """Pictures by their paths, read once."""

    def __init__(self) -> None:
        self._names: dict[str | None, int] = {None: upload_texture(np.full((1, 1, 4), 255, np.uint8))}

    def __getitem__(self, path: str | None) -> int:
        """Name of the texture of a path; white for None and, with a warning, for what cannot be read."""
        if path not in self._names:
            self._names[path] = self._read(path) if path else self._names[None]
        return self._names[path]

    def _read(self, path: str) -> int:
        from PIL import Image

        try:
            with Image.open(path) as picture:
                pixels = np.asarray(picture.convert("RGBA"))
        except OSError as error:
            _log.warning("the texture %s is drawn white: %s", path, error)
            return self._names[None]
        return upload_texture(pixels[::-1])


def upload_texture(pixels: NDArray[np.uint8], name: int | None = None) -> int:
    """A texture with these pixels (h, w, 4), row 0 at the bottom; in place of that in `name` if it is given."""
    name = int(GL.glGenTextures(1)) if name is None else name
    height, width = pixels.shape[:2]
    GL.glBindTexture(GL.GL_TEXTURE_2D, name)
    GL.glPixelStorei(GL.GL_UNPACK_ALIGNMENT, 1)
    data = np.ascontiguousarray(pixels)
    GL.glTexImage2D(GL.GL_TEXTURE_2D, 0, GL.GL_RGBA8, width, height, 0, GL.GL_RGBA, GL.GL_UNSIGNED_BYTE, data)
    GL.glGenerateMipmap(GL.GL_TEXTURE_2D)
    GL.glTexParameteri(GL.GL_TEXTURE_2D, GL.GL_TEXTURE_MIN_FILTER, GL.GL_LINEAR_MIPMAP_LINEAR)
    GL.glTexParameteri(GL.GL_TEXTURE_2D, GL.GL_TEXTURE_MAG_FILTER, GL.GL_LINEAR)
    GL.glBindTexture(GL.GL_TEXTURE_2D, 0)
    return name
