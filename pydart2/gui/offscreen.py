"""Pictures without a display, as arrays."""

from __future__ import annotations

import threading
from collections import OrderedDict
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from functools import lru_cache
from typing import TYPE_CHECKING, Any, Literal, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pydart2.cameras import MountedCamera
from pydart2.gui import context as contexts
from pydart2.gui import draw_list
from pydart2.gui.camera import Camera, as_camera
from pydart2.gui.first_look import floor_of, look, mounted
from pydart2.gui.trackball import Trackball

if TYPE_CHECKING:
    from pydart2.gui.draw_list import Item
    from pydart2.gui.targets import BodiesTarget, ColorTarget

CameraLike = int | str | Trackball | Camera | MountedCamera | tuple[ArrayLike, float] | None
Mode = Literal["rgb", "depth", "segmentation"]

_MODES = ("rgb", "depth", "segmentation")
_KEPT_TARGETS = 8  # picture sizes whose memory is kept


class OffscreenRenderer:
    """Draws worlds into arrays; one renderer serves many worlds, sizes and threads, one after another.

    >>> renderer = OffscreenRenderer(640, 480)
    >>> picture = renderer.render(world)
    >>> depth = renderer.render(world, mode="depth")

    Parameters
    ----------
    width, height
        Pixels of the pictures, if `render` is not told others.
    samples
        Per pixel of "rgb" pictures, for smooth edges: 0, 2 or 4; some graphics cards have more.

    Attributes
    ----------
    scene : OpenGLScene
        With `style` and `show` to change how and what is drawn.

    Raises
    ------
    ContextError
        If no OpenGL context can be made; it tells what to install.
    """

    def __init__(self, width: int = 640, height: int = 480, samples: int = 4) -> None:
        _check_size(width, height)
        self.width, self.height, self.samples = width, height, samples
        self._lock = threading.RLock()
        self._context = contexts.create_context()
        self._free = contexts.free_with(self, self._context)
        self._targets: OrderedDict[tuple[int, ...], ColorTarget | BodiesTarget] = OrderedDict()
        with self._current():
            from pydart2.gui.opengl.scene import OpenGLScene

            self.scene = OpenGLScene(width, height)
            self.scene.init()

    @overload
    def render(
        self,
        world: Any,
        width: int | None = None,
        height: int | None = None,
        camera: CameraLike = None,
        mode: Literal["rgb"] = "rgb",
    ) -> NDArray[np.uint8]: ...
    @overload
    def render(
        self, world: Any, width: int | None = None, height: int | None = None, camera: CameraLike = None, *, mode: Mode
    ) -> NDArray[Any]: ...
    def render(
        self,
        world: Any,
        width: int | None = None,
        height: int | None = None,
        camera: CameraLike = None,
        mode: Mode = "rgb",
    ) -> NDArray[Any]:
        """A picture of a world, or of anything that has `render()`, `render_with_ri(ri)` or `draw_with_ri(ri)`.

        Parameters
        ----------
        world
            "depth" and "segmentation" show the bodies of a World only.
        width, height
            Pixels, if they are not to be those of the renderer.
        camera
            None: one that sees all that is there, with the world's up upwards; a floor is drawn where the world has
            none. The same by name, from "front", "back", "left", "right" or "top". Or, without such a floor, one of
            ``world.cameras`` by its name, 0 (Y up) and 1 (Z up) as in windows, a Trackball, a Camera, or (pose, fov):
            the eye's pose in the world, shape (4, 4), which looks along its -z with y upwards, and the vertical field
            of view in rad.
        mode
            "rgb": (height, width, 3) uint8. "depth": (height, width) float32, m along the optical axis, inf for the
            background. "segmentation": (height, width, 2) int32, skeleton and body id, -1 for none. Row 0 is on top.

        Raises
        ------
        ValueError
            For an unknown mode or camera (NameNotFound for a name), or a size that is not positive.
        """
        size = self.width if width is None else width, self.height if height is None else height
        _check_size(*size)
        if mode not in _MODES:
            raise ValueError(f"no mode {mode!r}; there are {', '.join(_MODES)}")
        camera = mounted(world, camera) or camera
        if camera is None or isinstance(camera, str):
            eye, floor = look(world, size[0] / size[1], camera or "auto", still=True), floor_of(world)
        else:
            eye, floor = as_camera(camera), None
        with self._current():
            if mode != "rgb":
                return self._render_bodies(world, size, eye, mode)
            with self._with_floor(floor):
                return self._render_rgb(world, size, eye)

    def close(self) -> None:
        """Free the context; the renderer can no longer be used."""
        with self._lock:
            self._free()

    @contextmanager
    def _with_floor(self, floor: Item | None) -> Iterator[None]:
        show = self.scene.show
        self.scene.show = replace(show, floor=floor or show.floor)
        try:
            yield
        finally:
            self.scene.show = show

    def _render_rgb(self, world: Any, size: tuple[int, int], camera: Camera) -> NDArray[np.uint8]:
        from pydart2.gui.targets import ColorTarget

        target: ColorTarget = self._target(ColorTarget, *size, self.samples)
        target.begin()
        self.scene.width, self.scene.height = size
        self.scene.render(world, camera)
        return target.read()

    def _render_bodies(self, world: Any, size: tuple[int, int], camera: Camera, mode: str) -> NDArray[Any]:
        from pydart2.gui import drawing
        from pydart2.gui.targets import BodiesTarget

        if not hasattr(world, "skeletons"):
            raise TypeError(f"mode {mode!r} shows the bodies of a World, not of {world!r}")
        target: BodiesTarget = self._target(BodiesTarget, *size)
        target.begin()
        collision_shapes = self.scene.show.collision_shapes
        show = draw_list.Show(markers=False, contacts=False, forces=False, collision_shapes=collision_shapes)
        scene = draw_list.from_world(world, show)
        drawing.renderer().draw_bodies(scene, camera.view, camera.projection(size[0] / size[1]))
        return target.read_depth() if mode == "depth" else target.read_ids()

    def _target(self, kind: Any, *arguments: int) -> Any:
        key = (kind, *arguments)
        if key not in self._targets:
            self._targets[key] = kind(*arguments)
            while len(self._targets) > _KEPT_TARGETS:
                self._targets.popitem(last=False)[1].free()
        self._targets.move_to_end(key)
        return self._targets[key]

    @contextmanager
    def _current(self) -> Iterator[None]:
        if not self._free.alive:
            raise contexts.ContextError("this OffscreenRenderer is closed")
        with contexts.current(self._context, self._lock):
            yield


def render(
    world: Any, width: int = 640, height: int = 480, camera: CameraLike = None, mode: Mode = "rgb"
) -> NDArray[Any]:
    """A picture of a world without a display; the arguments are those of `OffscreenRenderer.render`.

    >>> picture = pydart2.gui.render(world, 640, 480, camera=1)
    >>> PIL.Image.fromarray(picture).save("world.png")
    """
    return _shared_renderer().render(world, width, height, camera, mode=mode)


@lru_cache(maxsize=1)
def _shared_renderer() -> OffscreenRenderer:
    return OffscreenRenderer()


def _check_size(width: int, height: int) -> None:
    if not (isinstance(width, (int, np.integer)) and isinstance(height, (int, np.integer))):
        raise TypeError(f"a picture's width and height are two whole numbers, as 640, 480, not {width!r}, {height!r}")
    if not (0 < width <= 16384 and 0 < height <= 16384):
        raise ValueError(f"a picture is 1 to 16384 pixels wide and high, not {width} by {height}")
