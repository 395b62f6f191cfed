"""Pictures without a display, as arrays."""

from __future__ import annotations

import threading
from typing import Any, Literal, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pydart2.gui import context as contexts
from pydart2.gui.camera import Camera, as_camera
from pydart2.gui.trackball import Trackball
from pydart2.world import World

Mode = Literal["rgb", "depth", "segmentation"]
Picture = NDArray[np.uint8] | NDArray[np.float32] | NDArray[np.int32]


class OffscreenRenderer:
    """Draws worlds into arrays; one serves many worlds, sizes and threads.

    >>> renderer = OffscreenRenderer(640, 480)
    >>> picture = renderer.render(world)

    Parameters
    ----------
    width, height
        Pixels of the pictures.
    samples
        Per pixel, for smooth edges: 0, 2, 4 or 8.

    Raises
    ------
    ContextError
        If no OpenGL context can be made; it tells what to install.
    """

    def __init__(self, width: int = 640, height: int = 480, samples: int = 4) -> None:
        
        self.width, self.height, self.samples = width, height, samples
        self._lock = threading.RLock()
        self._context = contexts.create_context()
        with contexts.current(self._context, self._lock):
            from pydart2.gui.renderer import SceneRenderer

            self._renderer = SceneRenderer()
        self._targets: dict[tuple[Any, ...], Any] = {}

    def render(
        self,
        world: World,
        width: int | None = None,
        height: int | None = None,
        camera: int | Trackball | Camera | tuple[ArrayLike, float] = 0,
        mode: Mode = "rgb",
    ) -> Any:
        from pydart2.gui import scene as scenes
        from pydart2.gui.targets import BodiesTarget, ColorTarget

        size = width or self.width, height or self.height
        eye = as_camera(camera)
        with contexts.current(self._context, self._lock):
            projection = eye.projection(size[0] / size[1])
            scene = scenes.from_world(world)
            target = ColorTarget(*size, self.samples)
            target.begin()
            self._renderer.clear()
            self._renderer.draw(scene, eye.view, projection)
            return target.read()
