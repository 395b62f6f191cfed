"""A trackball on a camera of a world: it goes where that goes, and the mouse moves it from there."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from pydart2.cameras import MountedCamera
from pydart2.errors import DestroyedError
from pydart2.gui.trackball import Trackball


class RidingTrackball(Trackball):
    """A trackball that keeps its place beside a camera of a world, at first that of the camera itself.

    It stays where it is when what the camera is mounted on is gone, or is nowhere.

    Attributes
    ----------
    mount : MountedCamera
    """

    def __init__(self, camera: MountedCamera) -> None:
        self.mount, self._at = camera, camera.eye()
        super().__init__(rot=[0.0, 0.0, 0.0, 1.0], trans=[0.0, 0.0, 0.0])
        self.fov = camera.fov
        self._stand(self._at)

    @property
    def trans(self) -> list[float]:
        """Where the world's origin is in the eye's axes, 3 numbers, m; may be changed in place."""
        self._ride()
        return super().trans

    @property
    def matrix(self) -> NDArray[np.float32]:
        """Rotation from the world's to the eye's axes, 16 numbers as glMultMatrix takes them (column by column)."""
        self._ride()
        return super().matrix

    @property
    def view(self) -> NDArray[np.float64]:
        """From the world's to the eye's coordinates, shape (4, 4)."""
        self._ride()
        return super().view

    def _ride(self) -> None:
        try:
            at = self.mount.eye()
        except DestroyedError:
            return
        if np.isfinite(at).all() and (at != self._at).any():
            self._stand(at @ np.linalg.inv(self._at) @ np.linalg.inv(super().view))
            self._at = at

    def _stand(self, eye: NDArray[np.float64]) -> None:
        """Put the eye at a pose in the world, shape (4, 4), m."""
        self._set_rotation(Rotation.from_matrix(eye[:3, :3]).as_quat())
        super().trans[:] = (-eye[:3, :3].T @ eye[:3, 3]).tolist()
