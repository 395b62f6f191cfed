"""What drives a simulation in a window, in a recording and without either: play, pause, step, scrub.

No Qt and no OpenGL; whoever owns a Runtime calls `advance` now and then and draws.
"""

from __future__ import annotations

import enum
import math
import os
import sys
import threading
import time
import traceback
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from typing import Any

from pydart2.gui.callbacks import Callbacks
from pydart2.gui.pacing import Pacer
from pydart2.recording import Recording
from pydart2.world import World

_WAIT = 0.001  # s, for the next step to fall due


class Mode(enum.Enum):
    """What a Runtime is doing."""

    PAUSED = "paused"
    PLAYING = "playing"
    REPLAYING = "replaying"


class Runtime:
    """Drives a simulation.

    >>> runtime = Runtime(world)
    >>> runtime.play()
    >>> while window_is_open:
    ...     runtime.advance(budget=0.02)

    Parameters
    ----------
    sim
        A World, or any object with some of the functions of `callbacks.EVENTS`.
    clock
        Returns seconds; another one in tests.

    Attributes
    ----------
    callbacks : Callbacks
    pacer : Pacer
        Speed and real-time factor.
    before_step, after_step : list of functions
        Called around each step, after `on_step_event` and before the next one.
    steps_beside : bool
        Whether `simulating_beside` may do steps; `before_step` and `after_step` are then called in another thread too.
    on_error : list of functions
        Called with the traceback's text when user code has raised.
    errors : list of str
        All tracebacks so far.
    error : str or None
        The one that is not dismissed yet.
    """

    def __init__(self, sim: Any = None, clock: Callable[[], float] = time.monotonic) -> None:
        self._clock = clock
        self.pacer = Pacer()
        self.callbacks = Callbacks()
        self.before_step: list[Callable[[], object]] = []
        self.after_step: list[Callable[[], object]] = []
        self.on_error: list[Callable[[str], object]] = []
        self.errors: list[str] = []
        self.steps_beside = True
        self._beside = ThreadPoolExecutor(max_workers=1)
        self.set_simulation(sim)

    def set_simulation(self, sim: Any) -> None:
        """Drive another simulation from now on; paused, at its last frame."""
        self.sim = sim
        self.callbacks.read(sim)
        self.mode = Mode.PAUSED
        self.error: str | None = None
        self.pacer.restart()
        self.frame = max(self.num_frames - 1, 0)

    # What it does

    @property
    def playing(self) -> bool:
        """Whether it simulates."""
        return self.mode is Mode.PLAYING

    @property
    def replaying(self) -> bool:
        """Whether it shows the recording."""
        return self.mode is Mode.REPLAYING

    def play(self) -> None:
        """Simulate from the state that is shown; an error is dismissed."""
        self._go(Mode.PLAYING)

    def replay(self) -> None:
        """Show the recording from the present frame on, from the start if it is the last one."""
        if self.frame >= self.num_frames - 1:
            self.set_frame(self.first_frame)
        self._go(Mode.REPLAYING)

    def pause(self) -> None:
        """Do nothing from now on."""
        self._go(Mode.PAUSED, dismiss=False)

    def _go(self, mode: Mode, dismiss: bool = True) -> None:
        if dismiss:
            self.error = None
        if mode is not self.mode:
            self.mode = mode
            self.pacer.restart()
            self._replay_start = self.frame

    def step(self) -> bool:
        """Do one step, whatever the mode; False if the simulation wants to stop or has failed."""
        self.error = None
        return self._step()

    def _step(self) -> bool:
        go_on = False
        with self.guarded():
            go_on = self._do_step()
        self.frame = max(self.num_frames - 1, 0)
        return go_on

    def _do_step(self) -> bool:
        self.callbacks.call("on_step_event")
        for hook in self.before_step:
            hook()
        result = self.callbacks.call("step")
        for hook in self.after_step:
            hook()
        return result is None or bool(result)

    def reset(self) -> None:
        """Reset the simulation; go on playing if it was."""
        self.error = None
        with self.guarded():
            self.callbacks.call("reset")
        self.pacer.restart()
        self._replay_start = self.frame = max(self.num_frames - 1, 0)

    # Recording

    @property
    def num_frames(self) -> int:
        """Frames of the recording, those that are gone included; 0 if there is none."""
        with self.guarded():
            return int(self.callbacks.call("num_frames") or 0)
        return 0

    @property
    def first_frame(self) -> int:
        """Index of the oldest frame that is kept."""
        with self.guarded():
            return int(getattr(getattr(self.sim, "recording", None), "first_frame", 0))
        return 0

    @property
    def frame_time(self) -> float | None:
        """Simulated time of the frame that is shown, s; None if there is no recording of it."""
        with self.guarded():
            recording = getattr(self.sim, "recording", None)
            if isinstance(recording, Recording) and self.first_frame <= self.frame < self.num_frames:
                return float(recording.t[self.frame - self.first_frame])
        return None

    def set_frame(self, frame: int) -> bool:
        """Show a recorded frame; False if it is not kept."""
        if not self.first_frame <= frame < self.num_frames:
            return False
        found = False
        with self.guarded():
            found = self.callbacks.call("set_frame", frame) is not False
        if found:
            self.frame = frame
        return found

    def scrub(self, frame: int) -> None:
        """Show the kept frame next to `frame`, and stop there."""
        self.pause()
        self.set_frame(min(max(frame, self.first_frame), self.num_frames - 1))

    # Time

    @property
    def time(self) -> float | None:
        """Simulated time, s; None if the simulation has none."""
        return self._number("t")

    @property
    def time_step(self) -> float | None:
        """Time step, s; None if the simulation has none."""
        return self._number("dt")

    def _number(self, name: str) -> float | None:
        with self.guarded():
            value = getattr(self.sim, name, None)
            return float(value) if isinstance(value, (int, float)) else None
        return None

    def advance(self, budget: float) -> None:
        """Do the steps, or show the frame, that are due now, in at most about `budget` seconds of the clock."""
        if self.mode is Mode.PLAYING:
            self._advance_simulation(budget)
        elif self.mode is Mode.REPLAYING:
            self._advance_replay()

    def _advance_simulation(self, budget: float) -> None:
        start, simulated = self._clock(), self.time
        if simulated is None:  # nothing to pace by
            self._play_step()
            return
        due = self.pacer.due(start, simulated)
        self.pacer.note(start, simulated)
        target = simulated + due
        step = self.time_step or 0.0
        while self.playing and simulated + 0.5 * step < target and self._clock() - start < budget:
            self._play_step()
            now = self.time
            if now is None or now <= simulated:  # reset by user code, or no step at all
                self.pacer.restart()
                break
            simulated = now

    @contextmanager
    def simulating_beside(self) -> Iterator[None]:
        """Within it, while it plays, another thread does the steps that fall due; nobody may ask the world anything.

        Only where the engine alone acts in a step: user code has its turns in `advance`, in the thread of the window.
        """
        if not (self.playing and self.steps_beside and self._is_the_engine_alone()):
            yield
            return
        stop = threading.Event()
        steps = self._beside.submit(self._simulate_until, stop)
        try:
            yield
        finally:
            stop.set()
            with self.guarded():
                steps.result()
            self.frame = max(self.num_frames - 1, 0)

    def _is_the_engine_alone(self) -> bool:
        sim, step = self.sim, self.callbacks["step"]
        ours = isinstance(sim, World) and getattr(step, "__func__", None) is World.step and not sim._controlled
        return ours and self.callbacks["on_step_event"] is None

    def _simulate_until(self, stop: threading.Event) -> None:
        world, pacer = self.sim, self.pacer
        while not stop.is_set():
            if pacer.due(self._clock(), world.t) > 0.5 * world.dt:
                self._do_step()
            else:
                stop.wait(_WAIT)

    def _play_step(self) -> None:
        if not self._step() and self.playing:
            print("pause: step() returned a false value")
            self.pause()

    def _advance_replay(self) -> None:
        step = self.time_step
        if step is None or math.isinf(self.pacer.speed):
            frame = self.frame + 1
        else:
            shown = (self.frame - self._replay_start) * step
            frame = self.frame + int(self.pacer.due(self._clock(), shown) / step)
        frame = min(frame, self.num_frames - 1)
        if frame > self.frame:
            self.set_frame(frame)
        if self.frame >= self.num_frames - 1:
            self.pause()

    # User code that raises

    @contextmanager
    def guarded(self) -> Iterator[None]:
        """Within it an exception pauses and is noted; it goes no further."""
        try:
            yield
        except Exception as error:
            self.fail(_text_of(error))

    def fail(self, text: str) -> None:
        """Pause, and note and print a traceback."""
        self.pause()
        if text not in self.errors:
            print(text, file=sys.stderr, end="")
            self.errors.append(text)
        self.error = text
        for hook in self.on_error:
            hook(text)

    def dismiss_error(self) -> None:
        """Forget the present error; `errors` keeps it."""
        self.error = None


def _text_of(error: Exception) -> str:
    """The traceback from where user code begins, if it does."""
    told = traceback.TracebackException.from_exception(error)
    ours = os.path.dirname(__file__)
    begin = next((i for i, frame in enumerate(told.stack) if not frame.filename.startswith(ours)), 0)
    del told.stack[:begin]
    return "".join(told.format())
