"""Movies of simulations, without a display."""

from __future__ import annotations

import math
import os
from collections.abc import Callable
from types import TracebackType
from typing import TYPE_CHECKING, Any

from pydart2.errors import SimulationError
from pydart2.gui.capture import MovieWriter
from pydart2.gui.first_look import floor_of, look, mounted
from pydart2.gui.runtime import Runtime
from pydart2.utils.progress import progress

if TYPE_CHECKING:
    from pydart2.gui.moving_cameras import MovingCamera
    from pydart2.gui.offscreen import CameraLike


def record(
    sim: Any,
    path: str | os.PathLike[str],
    seconds: float,
    fps: float = 30.0,
    camera: CameraLike | MovingCamera = None,
    size: tuple[int, int] = (640, 480),
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
    fps
        Pictures a second.
    camera
        As of `render`. None, "front" and so on: where that camera is at the start, it stays; those of ``world.cameras``
        go with what they are mounted on. Or one that moves (`pydart2.gui.follow`, `orbit`, `between`), a function of
        the time since the start in s.
    size
        Width and height, pixels.
    speed
        Simulated seconds per second of the movie.

    Raises
    ------
    ValueError
        If `seconds`, `fps` or `speed` is not positive.
    SimulationError
        If user code raises; the message is its traceback. The movie ends there.
    """
    if not 0.0 < seconds < math.inf:
        raise ValueError(f"seconds must be positive, got {seconds}")
    runtime = Runtime(sim)
    with Movie(sim, path, fps, camera, size, speed) as movie:
        movie.look()
        for i in progress(range(1, round(seconds * fps / speed) + 1), "recording", "picture"):
            if not _go_on(runtime, movie.start + i * movie.spacing):
                break
            movie.look()
    if runtime.errors:
        raise SimulationError(runtime.errors[-1])


def _go_on(runtime: Runtime, until: float) -> bool:
    """Step until a time; False if it does not get there."""
    half_step = 0.5 * (runtime.time_step or 0.0)
    while (runtime.time or 0.0) + half_step < until:
        before = runtime.time
        if not runtime.step() or runtime.time == before:
            return False
    return True


class Movie:
    """A movie of a loop of one's own: look() after each step takes a picture when it is time for one.

    >>> with pydart2.gui.Movie(world, "run.mp4") as movie:
    ...     for _ in range(1000):
    ...         world.step()
    ...         movie.look()

    The parameters are those of `record`. Without a look the file is not made; after an error in the loop it ends there.

    Attributes
    ----------
    start : float
        Simulated time of the first picture, s.
    spacing : float
        Simulated time from picture to picture, s.
    """

    def __init__(
        self,
        sim: Any,
        path: str | os.PathLike[str],
        fps: float = 30.0,
        camera: CameraLike | MovingCamera = None,
        size: tuple[int, int] = (640, 480),
        speed: float = 1.0,
    ) -> None:
        from pydart2.gui.offscreen import OffscreenRenderer

        if Runtime(sim).time is None:
            raise ValueError(f"{type(sim).__name__} has no time `t`, in s, to be recorded by")
        for name, value in (("fps", fps), ("speed", speed)):
            if not value > 0.0:
                raise ValueError(f"{name} must be positive, got {value}")
        width, height = _pair(size)
        self.sim = sim
        self.start, self.spacing = float(sim.t), speed / fps
        self._pictures = 0
        self._renderer = OffscreenRenderer(width, height)
        self._writer = MovieWriter(path, fps)
        self._camera: Callable[[float], Any]
        camera = mounted(sim, camera) or camera
        if callable(camera):
            self._camera = camera
        else:
            self._camera = lambda t: camera
        if camera is None or isinstance(camera, str):
            still = look(sim, width / height, camera or "auto")
            self._camera = lambda t: still
        if camera is None or isinstance(camera, str) or callable(camera):
            self._renderer.scene.show.floor = floor_of(sim)

    def look(self) -> None:
        """Take a picture, if the simulated time has come to the next one."""
        half_step = 0.5 * float(getattr(self.sim, "dt", 0.0))
        if self.sim.t + half_step >= self.start + self._pictures * self.spacing:
            camera = self._camera(self.sim.t - self.start)
            self._writer.add(self._renderer.render(self.sim, camera=camera))
            self._pictures += 1

    def close(self) -> None:
        """Write what is left of the file."""
        self._renderer.close()
        self._writer.close()

    def __enter__(self) -> Movie:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        self.close()


def _pair(size: Any) -> tuple[int, int]:
    try:
        width, height = size
    except (TypeError, ValueError):
        raise TypeError(f"size is a width and a height in pixels, as (640, 480), not {size!r}") from None
    return width, height
