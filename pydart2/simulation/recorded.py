"""Whether a world records what it does."""

from __future__ import annotations

from typing import TYPE_CHECKING, cast

import numpy as np

from pydart2.collision_result import CollisionResult
from pydart2.recording import Recording
from pydart2.simulation.part import WorldPart

if TYPE_CHECKING:
    from pydart2.skeleton import Skeleton
    from pydart2.world import World


class Recorded(WorldPart):
    """The part of World that records."""

    recording: Recording | None
    _put_back: int | None = None  # the recorded frame

    def is_recording(self) -> bool:
        """Whether steps are recorded; by default they are."""
        return self._handle.is_recording()

    def set_recording(self, enable: bool) -> None:
        """Record steps or not. Switching on records the present state; switching off forgets the frames."""
        self._handle.set_recording(enable)
        if not enable:
            self.recording = None
        elif self.recording is None:
            self.recording = Recording(cast("World", self))

    def enable_recording(self) -> None:
        """Record steps from now on."""
        self.set_recording(True)

    def disable_recording(self) -> None:
        """Record no steps, and forget the frames."""
        self.set_recording(False)

    def num_frames(self) -> int:
        """Frames since the last reset, that is, steps + 1; 0 if not recording."""
        return self._handle.num_frames()

    @property
    def nframes(self) -> int:
        """Frames since the last reset, that is, steps + 1; 0 if not recording."""
        return self._handle.num_frames()

    def set_frame(self, frame_index: int) -> bool:
        """Put the states and contacts of a recorded frame back; False if it is not kept. `t` and `frame` stay."""
        if not self._handle.set_frame(frame_index):
            return False
        self.collision_result = CollisionResult.from_rows(cast("World", self), self._handle.frame_contacts(frame_index))
        self._put_back = frame_index
        return True

    def _sleepers_shown(self) -> list[Skeleton]:
        """Who sleeps; or slept in the recorded frame that was put back, as long as the state is that frame's."""
        world, frame = cast("World", self), self._put_back
        if frame is not None and self._handle.first_frame() <= frame < self._handle.num_frames():
            recorded = Recording(world)
            if np.array_equal(recorded.states(frame), world.x):
                return recorded.sleepers(frame)
        return world.sleepers()
