"""The recorded frames of a world."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from pydart2.collision_result import CollisionResult

if TYPE_CHECKING:
    from pydart2.world import World


class Recording:
    """What a world did since its last reset: a frame per step with the states and the contacts.

    Frames are kept up to `limit_bytes`; the oldest go first.

    Attributes
    ----------
    world : World
    """

    def __init__(self, world: World) -> None:
        self.world = world

    @property
    def history(self) -> list[tuple[NDArray[np.float64], CollisionResult]]:
        """The kept frames, oldest first: states, shape (2 * sum of ndofs,), rad, m, rad/s and m/s, and contacts."""
        return [(self.states(i), self.contacts(i)) for i in range(self.first_frame, self.num_frames())]

    @property
    def limit_bytes(self) -> int:
        """Memory that the frames may take, 64 MB unless set."""
        return self.world._handle.recording_limit()

    @limit_bytes.setter
    def limit_bytes(self, limit: int) -> None:
        self.world._handle.set_recording_limit(limit)

    @property
    def num_bytes(self) -> int:
        """Memory that the frames take."""
        return self.world._handle.recording_bytes()

    @property
    def first_frame(self) -> int:
        """Index of the oldest frame that is kept."""
        return self.world._handle.first_frame()

    def num_frames(self) -> int:
        """How many frames there were, those that are gone included."""
        return self.world._handle.num_frames()

    def states(self, frame_index: int) -> NDArray[np.float64]:
        """[q, dq] of each skeleton at a kept frame, shape (2 * sum of ndofs,), rad, m, rad/s, m/s; or IndexError."""
        return self.world._handle.frame_states(frame_index)

    def contacts(self, frame_index: int) -> CollisionResult:
        """The contacts at a kept frame; IndexError if it is gone."""
        return CollisionResult.from_rows(self.world, self.world._handle.frame_contacts(frame_index))

    def clear(self) -> None:
        """Forget all frames and record the present state as frame 0."""
        self.world._handle.clear_recording()

    def bake(self) -> None:
        """Record the present state as one frame more."""
        self.world._handle.record_frame()

    def set_frame(self, frame_index: int) -> bool:
        """Put the states and contacts of a frame back; False if it is not kept."""
        return self.world.set_frame(frame_index)
