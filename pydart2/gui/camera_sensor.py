"""A camera that sits on a body."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from pydart2.frames import SimpleFrame
from pydart2.gui.offscreen import Mode, render
from pydart2.sensors import Sampled

if TYPE_CHECKING:
    from pydart2.bodynode import BodyNode


class CameraSensor(Sampled):
    """Pictures from a frame in a body, as of `render`: a camera on a robot.

    >>> eye = CameraSensor(SimpleFrame(head, translation=[0.1, 0.0, 0.0]), 64, 48, mode="depth", rate=30.0)
    >>> world.step()
    >>> depth = eye.read()

    Parameters
    ----------
    frame
        A body, or a SimpleFrame in one. It looks along the frame's -z, with y upwards.
    width, height
        Pixels.
    fov
        Vertical field of view, rad.
    mode
        "rgb", "depth" or "segmentation", as of `render`.
    rate
        Pictures in a second of the world's time; between two it gives the last one. None: one each time step.
    """

    def __init__(
        self,
        frame: BodyNode | SimpleFrame,
        width: int = 64,
        height: int = 48,
        *,
        fov: float = np.pi / 3.0,
        mode: Mode = "rgb",
        rate: float | None = None,
    ) -> None:
        body = frame.parent if isinstance(frame, SimpleFrame) else frame
        if body is None:
            raise ValueError(
                "a sensor sits on a body; this frame is fixed in the world: render(world, camera=(pose, fov))"
            )
        if not 0.0 < fov < np.pi:
            raise ValueError(f"the field of view of a camera is between 0 and pi rad, got {fov}")
        super().__init__(body.skeleton.world, rate)
        self.frame, self.size, self.fov, self.mode = frame, (width, height), fov, mode
        self._picture: NDArray[Any] = np.empty((0, 0))

    def read(self) -> NDArray[Any]:
        """The picture, of the shape, type and unit that `render` gives for the mode. A copy."""
        if self._is_due():
            self._picture = render(self.world, *self.size, camera=(self.frame.T, self.fov), mode=self.mode)
        return self._picture.copy()
