"""How many simulated seconds are due, and how many there were."""

from __future__ import annotations

import math
from collections import deque

#: A simulation that is further behind than this, in seconds of the clock, is too slow to catch up.
MAX_LAG = 0.25

#: Length of the window that the real-time factor is measured over, s.
WINDOW = 1.0


class Pacer:
    """Couples simulated time to the clock.

    >>> pacer = Pacer(speed=2.0)
    >>> pacer.due(clock=10.0, simulated=0.0)  # the first call only notes the time
    0.0
    >>> round(pacer.due(clock=10.1, simulated=0.0), 3)
    0.2

    Attributes
    ----------
    speed : float
        Simulated seconds per second; `inf` for as fast as possible.
    """

    def __init__(self, speed: float = 1.0) -> None:
        self._samples: deque[tuple[float, float]] = deque()
        self.speed = speed

    @property
    def speed(self) -> float:
        """Simulated seconds per second that are asked for, > 0."""
        return self._speed

    @speed.setter
    def speed(self, speed: float) -> None:
        if not speed > 0.0:
            raise ValueError(f"speed must be > 0, not {speed}")
        self._speed = speed
        self.restart()

    def restart(self) -> None:
        """Count from the next call of due(): after a pause, a reset, a jump in time."""
        self._anchor: tuple[float, float] | None = None
        self._samples.clear()

    def due(self, clock: float, simulated: float) -> float:
        """Simulated seconds that are due now; what could not be done in time is forgotten."""
        if math.isinf(self._speed):
            return math.inf
        if self._anchor is None:
            self._anchor = (clock, simulated)
        due = (clock - self._anchor[0]) * self._speed + self._anchor[1] - simulated
        if abs(due) > MAX_LAG * self._speed:
            due = min(due, MAX_LAG * self._speed) if due > 0.0 else 0.0
            self._anchor = (clock, simulated + due)
        return due

    def note(self, clock: float, simulated: float) -> None:
        """Take a sample for the real-time factor."""
        if self._samples and simulated < self._samples[-1][1]:
            self._samples.clear()
        self._samples.append((clock, simulated))
        while clock - self._samples[0][0] > WINDOW:
            self._samples.popleft()

    @property
    def real_time_factor(self) -> float | None:
        """Simulated seconds per second over the last second; None before there are two samples."""
        if len(self._samples) < 2:
            return None
        (clock0, simulated0), (clock1, simulated1) = self._samples[0], self._samples[-1]
        return (simulated1 - simulated0) / (clock1 - clock0) if clock1 > clock0 else None
