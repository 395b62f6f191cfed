"""Draws scenes with OpenGL into whatever framebuffer is bound, in whichever context is current."""

from __future__ import annotations

import ctypes
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from OpenGL import GL

from pydart2.gui import shaders
from pydart2.gui.background import Background
from pydart2.gui.buffers import INSTANCE_FLOATS, Pool, Textures
from pydart2.gui.context import ContextError, current_context, load_opengl
from pydart2.gui.draw_list import Item, Scene, Show
from pydart2.gui.geometry import Mesh
from pydart2.gui.shaders import Program
from pydart2.gui.shadow import Shadow, ShadowMap

Matrix = NDArray[np.float64]

_COMMAND_BYTES = 20
_BIAS = np.array([[0.5, 0, 0, 0.5], [0, 0.5, 0, 0.5], [0, 0, 0.5, 0.5], [0, 0, 0, 1.0]])


@dataclass
class Style:
    """How pictures look; colours are RGB, 0 to 1.

    Attributes
    ----------
    shadows : bool
    shadow_size : int
        Pixels of the shadow map along an edge.
    draft : bool
        Whether shadows have hard edges, half the pixels, and are those of one or two pictures before, for which
        OpenGL need not wait; and whether what lies behind is kept from picture to picture.
    wireframe : bool
    background_top, background_bottom : (3,)
    light : (3,)
        Direction towards the light: to the right, up, and to the front.
    """

    shadows: bool = True
    shadow_size: int = 1024
    draft: bool = False
    wireframe: bool = False
    background_top: tuple[float, float, float] = (0.80, 0.86, 0.93)
    background_bottom: tuple[float, float, float] = (0.97, 0.98, 0.99)
    light: tuple[float, float, float] = (0.45, 1.0, 0.6)


class _Bucket(NamedTuple):
    """What can be drawn with one program and one set of buffers."""

    pool: int
    casts: bool
    grid: bool
    closed: bool
    texture: str | None


class _Batch(NamedTuple):
    bucket: _Bucket
    first: int
    commands: int


class SceneRenderer:
    """Draws scenes; of use only in the context that was current when it was made, or one that shares with it.

    Raises
    ------
    ContextError
        If no context is current, or it is older than OpenGL 4.3 or a core profile.
    """

    def __init__(self, style: Style | None = None) -> None:
        load_opengl()
        check_context()
        self.style = style or Style()
        self.show = Show()
        self.letters: dict[int, int] = {}  # textures of the letters by their size
        self.frame_matrices = np.eye(4), np.eye(4)
        self._uniforms: dict[str, Any] = {}
        self._programs: dict[tuple[str, ...], Program] = {}
        self._sky, self._bodies = shaders.sky(), shaders.bodies()
        self._instances, self._commands = (int(name) for name in GL.glGenBuffers(2))
        self._pools = [Pool(self._instances, rich) for rich in (False, True)] + [Pool(self._instances, False)]
        self._textures = Textures()
        self._shadow: ShadowMap | None = None  # the one drawn last
        self._shadows: dict[int, ShadowMap] = {}  # by their size
        self._late: Shadow | None = None
        self._background = Background()
        self._draws = 0
        self._frame = 0

    def is_alive(self) -> bool:
        """Whether its programs are there in the context that is current."""
        return bool(GL.glIsProgram(self._sky.id))

    def begin_frame(self, view: Matrix, projection: Matrix, up: NDArray[np.float64]) -> None:
        """Note a picture's matrices, shape (4, 4), for what is drawn with the fixed pipeline in m."""
        self.frame_matrices = view, projection
        if not self.style.draft or self._draws > 1:  # what is drawn in parts has a shadow map for each
            self._late = None
        self._draws = 0
        self._uniforms = self._light_uniforms(up, view)

    def clear(self) -> None:
        """Fill the picture with the background."""
        GL.glDepthMask(True)
        GL.glColorMask(True, True, True, True)
        GL.glDisable(GL.GL_SCISSOR_TEST)
        GL.glClear(GL.GL_DEPTH_BUFFER_BIT | GL.GL_COLOR_BUFFER_BIT)
        GL.glDisable(GL.GL_DEPTH_TEST)
        GL.glDisable(GL.GL_CULL_FACE)
        GL.glDisable(GL.GL_BLEND)
        self._sky.use()
        self._sky.set(top=self.style.background_top, bottom=self.style.background_bottom)
        GL.glBindVertexArray(self._pools[0].vao)
        GL.glDrawArrays(GL.GL_TRIANGLE_STRIP, 0, 4)
        _leave()

    def draw(self, scene: Scene, view: Matrix, projection: Matrix, background: bool = False) -> None:
        """Draw a scene, with the background if it is not there yet, into the framebuffer and viewport that are set.

        The matrices (4, 4) are those of points in m.
        """
        if not scene.items:
            if background:
                self.clear()
            return
        floors = [item for item in scene.items if item.grid > 0.0]
        keeps, looks = background and self.style.draft, self._looks(floors, scene.up, projection @ view)
        is_kept = keeps and self._background.put_back(looks)
        if background and not is_kept:
            self.clear()
        batches, blended = self._prepare(scene, _eye(view))
        GL.glEnable(GL.GL_DEPTH_TEST)
        GL.glDepthFunc(GL.GL_LESS)
        GL.glDisable(GL.GL_BLEND)
        light = self._light(scene.up)
        self._draws += 1
        late, self._late = self._late, None
        shadow = late or self._draw_shadow(scene, batches, light)
        self._bind_shadow()
        uniforms = self._uniforms = self._light_uniforms(scene.up, view) | {
            "view_projection": projection @ view,
            "shadow": _BIAS @ shadow.matrix,
            "shadow_push": 1.5 * shadow.texel,
            "shadow_size": 1.0 / self._shadow_size,
        }
        is_shaded = shadow.texel > 0.0
        if not is_kept:
            self._draw_lit([batch for batch in batches if batch.bucket.grid], False, uniforms)
        if keeps and not is_kept:
            self._background.keep(looks)
        self._draw_lit([batch for batch in batches if not batch.bucket.grid], is_shaded, uniforms)
        if is_shaded and floors:  # which are there, once more where shadows may be
            viewport = GL.glGetIntegerv(GL.GL_VIEWPORT)
            GL.glScissor(*shadow.part_of_picture(floors, scene.up, projection @ view, viewport))
            GL.glEnable(GL.GL_SCISSOR_TEST)
            GL.glDepthFunc(GL.GL_LEQUAL)
            self._draw_lit([batch for batch in batches if batch.bucket.grid], True, uniforms)
            GL.glDepthFunc(GL.GL_LESS)
            GL.glDisable(GL.GL_SCISSOR_TEST)
        blend()
        GL.glDepthMask(False)
        self._draw_lit(blended, is_shaded, uniforms, "BLEND")
        GL.glDepthMask(True)
        if self.style.draft:
            GL.glDisable(GL.GL_BLEND)
            GL.glPolygonMode(GL.GL_FRONT_AND_BACK, GL.GL_FILL)
            self._late = late if late and self._frame % 2 else self._draw_shadow(scene, batches, light)
        _leave()

    def draw_bodies(self, scene: Scene, view: Matrix, projection: Matrix) -> None:
        """Draw skeleton and body ids into colour attachment 0 (two integers), depth in m into attachment 1 (float).

        Both matrices have shape (4, 4).
        """
        if not scene.items:
            return
        batches, blended = self._prepare(scene, np.zeros(3))
        GL.glEnable(GL.GL_DEPTH_TEST)
        GL.glDisable(GL.GL_BLEND)
        self._bodies.use()
        self._bodies.set(view_projection=projection @ view, depth_row=-view[2])
        for batch in batches + blended:
            _cull(batch.bucket)
            self._draw_batch(batch)
        _leave()

    def draw_fixed(self, mesh: Mesh) -> None:
        """Draw a mesh with OpenGL's own matrices and colour, in the light and the shadows of the scene drawn last."""
        self._pools[0].require({mesh}, self._frame)
        part = self._pools[0].part(mesh)
        shadows = self._shadow is not None and "shadow" in self._uniforms
        program = self._program("FIXED", "BLEND", *(["SHADOW", "SOFT"] if shadows else []))
        program.use()
        program.set(eye_to_world=np.linalg.inv(self.frame_matrices[0]), **self._uniforms)
        self._bind_shadow()
        if mesh.is_closed:
            GL.glEnable(GL.GL_CULL_FACE)
        GL.glBindVertexArray(self._pools[0].vao)
        start = ctypes.c_void_p(4 * part.first_index)
        GL.glDrawElementsBaseVertex(GL.GL_TRIANGLES, part.indices, GL.GL_UNSIGNED_INT, start, part.base_vertex)
        _leave()

    def _light(self, up: NDArray[np.float64]) -> NDArray[np.float64]:
        """Direction towards the light, in the world."""
        return _towards_light(tuple(self.style.light), tuple(up.tolist()))

    def _light_uniforms(self, up: NDArray[np.float64], view: Matrix) -> dict[str, Any]:
        return {
            "eye": _eye(view),
            "up": up,
            "light": self._light(up),
            "key": (0.62, 0.6, 0.57),
            "sky": (0.30, 0.32, 0.35),
            "floor": (0.17, 0.16, 0.15),
            "fill": (0.17, 0.17, 0.17),
            "shadow_map": 1,
        }

    @property
    def _shadow_size(self) -> int:
        return self.style.shadow_size // 2 if self.style.draft else self.style.shadow_size

    def _draw_shadow(self, scene: Scene, batches: list[_Batch], light: NDArray[np.float64]) -> Shadow:
        casters = [item for item in scene.items if item.casts and item.rgba[3] > 0.5]
        if not self.style.shadows or not casters:
            return Shadow(np.eye(4), 0.0, np.zeros((4, 3)), light)
        size = self._shadow_size
        self._shadow = self._shadows[size] = self._shadows.get(size) or ShadowMap(size)
        shadow = self._shadow.fit(casters, light)
        before = self._shadow.begin(shadow.matrix)
        for batch in batches:
            if batch.bucket.casts:
                _cull(batch.bucket)
                self._draw_batch(batch)
        self._shadow.end(before)
        return shadow

    def _bind_shadow(self) -> None:
        if self._shadow is not None:
            GL.glActiveTexture(GL.GL_TEXTURE1)
            GL.glBindTexture(GL.GL_TEXTURE_2D, self._shadow.texture)

    def _begin_lit(self, bucket: _Bucket, shadows: bool, uniforms: dict[str, Any], *more: str) -> None:
        features = [*more]
        if self._pools[bucket.pool].rich:
            features.append("RICH")
            GL.glActiveTexture(GL.GL_TEXTURE0)
            GL.glBindTexture(GL.GL_TEXTURE_2D, self._textures[bucket.texture])
        if bucket.grid:
            features.append("GRID")
        if bucket.closed:
            features.append("CLOSED")
        if shadows:
            features += ["SHADOW"] if self.style.draft else ["SHADOW", "SOFT"]
        program = self._program(*features)
        program.use()
        program.set(texture=0, **uniforms)
        _cull(bucket)
        GL.glPolygonMode(GL.GL_FRONT_AND_BACK, GL.GL_LINE if self.style.wireframe else GL.GL_FILL)

    def _draw_lit(self, batches: list[_Batch], shadows: bool, uniforms: dict[str, Any], *more: str) -> None:
        for batch in batches:
            self._begin_lit(batch.bucket, shadows, uniforms, *more)
            self._draw_batch(batch)

    def _looks(self, floors: list[Item], up: NDArray[np.float64], view_projection: Matrix) -> object:
        """All that the background and these floors without shadows depend on."""
        items = [(item.mesh, item.transform.tobytes(), tuple(item.rgba), item.specular, item.grid) for item in floors]
        return items, repr(self.style), tuple(up), view_projection.tobytes()

    def _program(self, *features: str) -> Program:
        if features not in self._programs:
            self._programs[features] = shaders.lit(*features)
        return self._programs[features]

    def _draw_batch(self, batch: _Batch) -> None:
        GL.glBindVertexArray(self._pools[batch.bucket.pool].vao)
        start = ctypes.c_void_p(_COMMAND_BYTES * batch.first)
        GL.glMultiDrawElementsIndirect(GL.GL_TRIANGLES, GL.GL_UNSIGNED_INT, start, batch.commands, 0)

    def _prepare(self, scene: Scene, eye: NDArray[np.float64]) -> tuple[list[_Batch], list[_Batch]]:
        """Put the scene into the buffers; the batches of what is opaque and, from far to near, of what is not."""
        self._frame += 1
        buckets: dict[_Bucket, dict[Mesh, list[Item]]] = {}
        see_through: list[tuple[float, _Bucket, Item]] = []
        matrices = np.array([item.transform for item in scene.items])
        mirrored = np.linalg.det(matrices[:, :3, :3]) < 0.0
        for item, turned in zip(scene.items, mirrored):
            bucket = _bucket(item, bool(turned))
            if item.rgba[3] < 1.0:
                see_through.append((float(np.sum((item.transform[:3, 3] - eye) ** 2)), bucket, item))
            else:
                buckets.setdefault(bucket, {}).setdefault(item.mesh, []).append(item)
        see_through.sort(key=lambda entry: -entry[0])
        self._load(scene)

        commands: list[tuple[int, ...]] = []
        ordered: list[Item] = []
        opaque, blended = [], []
        for bucket, groups in buckets.items():
            opaque.append(_Batch(bucket, len(commands), len(groups)))
            for mesh, items in groups.items():
                commands.append(self._command(bucket, mesh, len(items), len(ordered)))
                ordered += items
        for _, bucket, item in see_through:
            blended.append(_Batch(bucket, len(commands), 1))
            commands.append(self._command(bucket, item.mesh, 1, len(ordered)))
            ordered.append(item)
        self._upload(np.array(commands, np.uint32), ordered)
        return opaque, blended

    def _load(self, scene: Scene) -> None:
        wanted: list[set[Mesh]] = [set(), set(), set()]
        for item in scene.items:
            wanted[_pool(item.mesh)].add(item.mesh)
        for pool, meshes in zip(self._pools[:2], wanted):
            pool.require(meshes, self._frame)
        if wanted[2]:
            self._pools[2].set(wanted[2])

    def _command(self, bucket: _Bucket, mesh: Mesh, count: int, first: int) -> tuple[int, ...]:
        part = self._pools[bucket.pool].part(mesh)
        return part.indices, count, part.first_index, part.base_vertex, first

    def _upload(self, commands: NDArray[np.uint32], items: list[Item]) -> None:
        rows = np.empty((len(items), INSTANCE_FLOATS), np.float32)
        rows[:, :12] = np.array([item.transform for item in items])[:, :3].reshape(-1, 12)
        rows[:, 12:16] = np.array([item.rgba for item in items])
        rows[:, 16] = [item.specular for item in items]
        rows[:, 17:19] = [item.ids for item in items]
        rows[:, 19] = [item.grid for item in items]
        GL.glBindBuffer(GL.GL_ARRAY_BUFFER, self._instances)
        GL.glBufferData(GL.GL_ARRAY_BUFFER, rows.nbytes, rows, GL.GL_STREAM_DRAW)
        GL.glBindBuffer(GL.GL_ARRAY_BUFFER, 0)
        GL.glBindBuffer(GL.GL_DRAW_INDIRECT_BUFFER, self._commands)
        GL.glBufferData(GL.GL_DRAW_INDIRECT_BUFFER, commands.nbytes, commands, GL.GL_STREAM_DRAW)


def blend() -> None:
    """Let what is behind show through; the picture itself stays opaque, so that a window is not seen through."""
    GL.glEnable(GL.GL_BLEND)
    factors = GL.GL_SRC_ALPHA, GL.GL_ONE_MINUS_SRC_ALPHA
    GL.glBlendFuncSeparate(*factors, GL.GL_ONE, GL.GL_ONE_MINUS_SRC_ALPHA)


def check_context() -> None:
    """ContextError unless a context is current that this renderer can use."""
    if not current_context() and not GL.glGetString(GL.GL_VERSION):
        raise ContextError("no OpenGL context is current in this thread")
    version = GL.glGetIntegerv(GL.GL_MAJOR_VERSION), GL.glGetIntegerv(GL.GL_MINOR_VERSION)
    if (int(version[0]), int(version[1])) < (4, 3):
        raise ContextError(f"OpenGL 4.3 is needed, this is {GL.glGetString(GL.GL_VERSION).decode()}")
    if not GL.glGetIntegerv(GL.GL_CONTEXT_PROFILE_MASK) & GL.GL_CONTEXT_COMPATIBILITY_PROFILE_BIT:
        raise ContextError("an OpenGL context in the compatibility profile is needed, this is a core profile")


@lru_cache
def _towards_light(light: tuple[float, float, float], up: tuple[float, float, float]) -> NDArray[np.float64]:
    """Direction in the world towards a light that is so far to the right, above and in front."""
    x = np.array([1.0, 0.0, 0.0]) if abs(up[0]) < 0.7 else np.array([0.0, 1.0, 0.0])
    z = np.cross(x, up)
    towards = light[0] * x + light[1] * np.array(up) + light[2] * z / np.linalg.norm(z)
    return np.asarray(towards / np.linalg.norm(towards))


def _pool(mesh: Mesh) -> int:
    if mesh.texture_coordinates is not None or mesh.colors is not None:
        return 1
    return 0 if mesh.is_lasting else 2


def _bucket(item: Item, mirrored: bool) -> _Bucket:
    mesh = item.mesh
    return _Bucket(_pool(mesh), item.casts, item.grid > 0.0, mesh.is_closed and not mirrored, mesh.texture)


def _cull(bucket: _Bucket) -> None:
    if bucket.closed:
        GL.glEnable(GL.GL_CULL_FACE)
    else:
        GL.glDisable(GL.GL_CULL_FACE)


def _eye(view: Matrix) -> NDArray[np.float64]:
    """Where the eye is in the world, (3,)."""
    return np.asarray(-np.linalg.solve(view[:3, :3], view[:3, 3]), dtype=float)


def _leave() -> None:
    """Leave nothing bound that could disturb OpenGL calls of others."""
    GL.glUseProgram(0)
    GL.glBindVertexArray(0)
    GL.glBindBuffer(GL.GL_DRAW_INDIRECT_BUFFER, 0)
    for unit in (GL.GL_TEXTURE1, GL.GL_TEXTURE0):
        GL.glActiveTexture(unit)
        GL.glBindTexture(GL.GL_TEXTURE_2D, 0)
    GL.glDisable(GL.GL_CULL_FACE)
    GL.glPolygonMode(GL.GL_FRONT_AND_BACK, GL.GL_FILL)
