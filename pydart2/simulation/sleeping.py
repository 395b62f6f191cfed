"""Groups of bodies that lie still and take no time."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from pydart2.simulation.part import WorldPart

if TYPE_CHECKING:
    from pydart2.skeleton import Skeleton


class WorldSleeping(WorldPart):
    """What puts the skeletons of a `World` to sleep."""

    def set_sleeping(
        self, enable: bool = True, *, linear_speed: float = 5e-3, angular_speed: float = 1e-2, seconds: float = 0.5
    ) -> None:
        """Let groups of skeletons that lie still sleep: they cost nothing until something wakes them. Off at first.

        Contacts and constraints connect skeletons to a group. It falls asleep when all its bodies have been slower than
        `linear_speed` (m/s for a body of 1 m, growing with the root of its size) and `angular_speed` (rad/s) for so
        many `seconds`, and what carries it is fixed. Sleepers have `dq` and `ddq` 0; their last contacts with their
        forces stay in `collision_result`. So that rolling ends, a free body that touches something and is at most 20
        times as fast as these speeds loses a fifth of its velocity every 0.05 s.

        A group wakes when a body that is awake touches it; when one of it is changed, by a state, a force or command
        other than zero, a parameter, a shape or a constraint; when anything fixed is changed, moved or removed; and
        when a setting of the world is. Skeletons with a controller, targets, soft bodies, or actuators other than
        force, passive and locked never sleep. Clones, pickles, snapshots and batches have who sleeps. ValueError for
        what is not positive.
        """
        options = [linear_speed, angular_speed, seconds] if enable else []
        self._handle.set_sleeping_options(np.array(options, dtype=float))

    def sleeping_options(self) -> dict[str, float]:
        """What set_sleeping() was told, by name; nothing if none may sleep."""
        numbers = self._handle.sleeping_options().tolist()
        return dict(zip(("linear_speed", "angular_speed", "seconds"), numbers, strict=False))

    def sleepers(self) -> list[Skeleton]:
        """The skeletons that sleep."""
        return [skel for skel in self.skeletons if skel.is_asleep()]
