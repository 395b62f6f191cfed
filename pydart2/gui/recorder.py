"""Movies of simulations, without a display."""

from __future__ import annotations

import os
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from pydart2.errors import SimulationError
from pydart2.gui.capture import write_movie
from pydart2.gui.first_look import floor_of, look
from pydart2.gui.runtime import Runtime
from pydart2.utils.progress import progress

if TYPE_CHECKING:
    from pydart2.gui.offscreen import CameraLike


def record(
    sim: Any,
    path: str | os.PathLike[str],
    seconds: float,
    rate: float = 30.0,
    width: int = 640,
    height: int = 480,
    camera: CameraLike = None,
    speed: float = 1.0,
) -> None:
    """Simulate, and write a movie of it; `on_step_event` is called before each step, as in a window.

    Parameters
    ----------
    sim
        A World, or any object with `step`, `t` and something to draw.
    path
        The ending says the kind: .mp4 (with PyAV), .gif, .webp, .png (animated).
    seconds
        How long to simulate, s.
    rate
        Pictures a second.
    width, height
        Pixels.
    camera
        As of `render`. None or a name: where that camera is at the start, it stays.
    speed
        Simulated seconds per second of the movie.

    Raises
    ------
    SimulationError
        If user code raises; the message is its traceback. The movie ends there.
    """
    from pydart2.gui.offscreen import OffscreenRenderer

    runtime = Runtime(sim)
    renderer = OffscreenRenderer(width, height)
    if camera is None or isinstance(camera, str):
        renderer.scene.show.floor = floor_of(sim)
        camera = look(sim, width / height, camera or "auto")
    try:
        pictures = _pictures(runtime, seconds, speed / rate, lambda: renderer.render(sim, camera=camera))
        write_movie(path, pictures, rate)
    finally:
        renderer.close()
    if runtime.errors:
        raise SimulationError(runtime.errors[-1])


def _pictures(runtime: Runtime, seconds: float, spacing: float, draw: Any) -> Iterator[NDArray[np.uint8]]:
    start = runtime.time
    if start is None:
        raise ValueError(f"{type(runtime.sim).__name__} has no time `t`, in s, to be recorded by")
    yield draw()
    for i in progress(range(1, round(seconds / spacing) + 1), "recording", "picture"):
        half_step = 0.5 * (runtime.time_step or 0.0)
        while (runtime.time or 0.0) + half_step < start + i * spacing:
            before = runtime.time
            if not runtime.step() or runtime.time == before:
                return
        yield draw()
