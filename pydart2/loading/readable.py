"""What a reader makes of a file: a model that a world takes."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from pydart2._native import WorldHandle
from pydart2.loading.xml import Document

if TYPE_CHECKING:
    from pydart2.cameras import MountedCamera
    from pydart2.world import World


class Readable:
    """A model that was read. As a path, it is that of its file.

    Attributes
    ----------
    document : Document
    time_step : float or None
        That of the file, s, where it is worth a word that the world's is another one.
    keyframes : dict
        Name → [q, dq] of all skeletons of the world that it was loaded as.
    """

    document: Document
    time_step: float | None = None

    @property
    def keyframes(self) -> dict[str, NDArray[np.float64]]:
        """Name → [q, dq] of all skeletons, shape (2 * sum of ndofs,), rad, m, rad/s and m/s."""
        return {}

    def cameras(self, world: World, still: bool) -> Mapping[str, MountedCamera]:
        """Name → camera, of the world that it was loaded as or added to; without `still` only those that can move."""
        return {}

    def __fspath__(self) -> str:
        return self.document.path or ""

    @property
    def has_world(self) -> bool:
        """Whether it is a world; a world can hold several skeletons, and has a gravity."""
        raise NotImplementedError

    def load_world(self) -> WorldHandle:
        """A new world with the content of the file."""
        raise NotImplementedError

    def add_to(self, world: WorldHandle) -> int:
        """Add the skeleton to a world; returns its index there."""
        raise NotImplementedError
