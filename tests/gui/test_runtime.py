"""The state machine that drives simulations, with a clock that the tests turn."""

from __future__ import annotations

import math
import subprocess
import sys
import threading
import time

import pytest

import pydart2
from pydart2.gui.pacing import Pacer
from pydart2.gui.runtime import Mode, Runtime


class Clock:
    """Seconds that pass when told; each look costs `look`."""

    def __init__(self, look: float = 0.0) -> None:
        self.now = 100.0
        self.look = look

    def __call__(self) -> float:
        self.now += self.look
        return self.now


class Counter:
    """A simulation without time or recording."""

    def __init__(self) -> None:
        self.steps = 0
        self.answer: bool | None = None

    def step(self) -> bool | None:
        self.steps += 1
        return self.answer


def run(runtime: Runtime, clock: Clock, seconds: float, rate: int = 50) -> None:
    for _ in range(round(seconds * rate) + 1):
        runtime.advance(budget=1.0)
        clock.now += 1.0 / rate


@pytest.mark.parametrize("speed", [0.1, 1.0, 4.0])
def test_playing_keeps_pace_with_the_clock(cubes: pydart2.World, speed: float) -> None:
    clock = Clock()
    runtime = Runtime(cubes, clock)
    runtime.pacer.speed = speed
    runtime.play()
    run(runtime, clock, 0.5)
    assert cubes.t == pytest.approx(0.5 * speed, abs=cubes.dt)
    assert runtime.pacer.real_time_factor == pytest.approx(speed, rel=0.05)


def test_as_fast_as_possible_uses_the_whole_budget(cubes: pydart2.World) -> None:
    clock = Clock(look=0.001)
    runtime = Runtime(cubes, clock)
    runtime.pacer.speed = math.inf
    runtime.play()
    runtime.advance(budget=0.1)
    assert cubes.frame == pytest.approx(100, abs=2)


def test_a_slow_simulation_does_not_hang_the_window_nor_catch_up_for_ever(cubes: pydart2.World) -> None:
    clock = Clock(look=0.01)  # ten times slower than real time
    runtime = Runtime(cubes, clock)
    runtime.play()
    runtime.advance(budget=0.05)
    clock.now += 1000.0
    before = clock.now
    runtime.advance(budget=0.05)
    assert clock.now - before < 0.1
    clock.look = 0.0
    clock.now += 0.001
    frame = cubes.frame
    runtime.advance(budget=1.0)
    assert cubes.frame - frame <= 252


def test_a_simulation_without_time_steps_once_per_call() -> None:
    sim = Counter()
    runtime = Runtime(sim)
    runtime.advance(0.1)
    assert sim.steps == 0
    runtime.play()
    for _ in range(5):
        runtime.advance(0.1)
    assert sim.steps == 5


def test_false_from_step_pauses_but_none_does_not(capsys: pytest.CaptureFixture[str]) -> None:
    sim = Counter()
    runtime = Runtime(sim)
    runtime.play()
    runtime.advance(0.1)
    assert runtime.playing
    sim.answer = False
    runtime.advance(0.1)
    assert runtime.mode is Mode.PAUSED
    assert "step() returned a false value" in capsys.readouterr().out


def test_on_step_event_comes_before_each_step_and_not_from_world_step() -> None:
    calls: list[str] = []

    class World(pydart2.World):
        def on_step_event(self) -> None:
            calls.append("event")

        def step(self, n: int = 1) -> None:
            calls.append("step")
            super().step(n)

    world = World(0.001, "./data/skel/cubes.skel")
    world.step()
    assert calls == ["step"]
    runtime = Runtime(world)
    runtime.before_step.append(lambda: calls.append("before"))
    runtime.after_step.append(lambda: calls.append("after"))
    runtime.step()
    assert calls == ["step", "event", "before", "step", "after"]


def test_steps_go_on_beside_a_picture(cubes: pydart2.World) -> None:
    runtime, threads = Runtime(cubes), set()
    runtime.after_step.append(lambda: threads.add(threading.current_thread()))
    runtime.play()
    with runtime.simulating_beside():
        time.sleep(0.3)
    assert 0.05 < cubes.t < 0.4
    assert threads
    assert threading.main_thread() not in threads
    assert runtime.frame == cubes.frame == len(cubes.recording.t) - 1
    stopped = cubes.frame
    time.sleep(0.05)
    assert cubes.frame == stopped


def test_user_code_never_runs_beside_a_picture(cubes: pydart2.World) -> None:
    class Own(pydart2.World):
        def step(self, n: int = 1) -> None:
            super().step(n)

    class Listening(pydart2.World):
        def on_step_event(self) -> None: ...

    driven = pydart2.World(0.001, "./data/skel/cubes.skel")
    driven.skeletons[-1].set_controller(lambda: [0.0] * 6)
    own, listening = (kind(0.001, "./data/skel/cubes.skel") for kind in (Own, Listening))
    captured = Runtime(pydart2.World(0.001, "./data/skel/cubes.skel"))
    captured.steps_beside = False
    for runtime in (Runtime(own), Runtime(listening), Runtime(driven), captured, Runtime(Counter())):
        runtime.play()
        with runtime.simulating_beside():
            time.sleep(0.02)
        assert getattr(runtime.sim, "frame", 0) == 0
    paused = Runtime(cubes)
    with paused.simulating_beside():
        time.sleep(0.02)
    assert cubes.frame == 0


def test_a_step_that_fails_beside_a_picture_pauses_and_is_noted(cubes: pydart2.World) -> None:
    runtime, threads = Runtime(cubes), set()
    runtime.on_error.append(lambda _text: threads.add(threading.current_thread()))
    cubes.skeletons[-1].dq = [1e29] * 6
    runtime.play()
    with runtime.simulating_beside():
        time.sleep(0.1)
    assert not runtime.playing
    assert "SimulationError" in runtime.errors[0]
    assert threads == {threading.main_thread()}


def test_replay_shows_the_recording_at_its_own_speed(cubes: pydart2.World) -> None:
    cubes.step(300)
    end = cubes.x.copy()
    clock = Clock()
    runtime = Runtime(cubes, clock)
    assert runtime.frame == 300
    runtime.replay()
    assert runtime.frame == 0
    run(runtime, clock, 0.1)
    assert runtime.frame == pytest.approx(100, abs=1)
    assert cubes.frame == 300  # no simulation
    run(runtime, clock, 0.3)
    assert runtime.mode is Mode.PAUSED
    assert runtime.frame == 300
    assert (cubes.x == end).all()


def test_scrubbing_stops_and_stays_within_what_is_kept(cubes: pydart2.World) -> None:
    runtime = Runtime(cubes)
    assert cubes.recording is not None
    cubes.recording.limit_bytes = 20000
    cubes.step(500)
    first = runtime.first_frame
    assert first > 0
    runtime.play()
    runtime.scrub(0)
    assert (runtime.frame, runtime.mode) == (first, Mode.PAUSED)
    runtime.scrub(10**6)
    assert runtime.frame == 500
    assert not runtime.set_frame(first - 1)


def test_reset_goes_back_to_frame_0(cubes: pydart2.World) -> None:
    runtime = Runtime(cubes)
    runtime.step()
    assert (runtime.frame, cubes.t) == (1, cubes.dt)
    runtime.reset()
    assert (runtime.frame, cubes.t) == (0, 0.0)


def test_user_code_that_raises_pauses_and_is_noted(capsys: pytest.CaptureFixture[str]) -> None:
    class Broken(Counter):
        def step(self) -> bool | None:
            super().step()
            raise ZeroDivisionError("in the controller")

    heard: list[str] = []
    runtime = Runtime(Broken())
    runtime.on_error.append(heard.append)
    runtime.play()
    runtime.advance(0.1)
    runtime.advance(0.1)
    assert runtime.sim.steps == 1
    assert runtime.mode is Mode.PAUSED
    assert runtime.error is not None
    assert "ZeroDivisionError: in the controller" in runtime.error
    assert heard == runtime.errors == [runtime.error]
    assert "in the controller" in capsys.readouterr().err
    runtime.play()
    assert runtime.error is None


def test_callbacks_can_be_replaced_and_wrong_names_are_named() -> None:
    runtime = Runtime(Counter())
    calls: list[int] = []
    runtime.callbacks.set("step", lambda: calls.append(1))
    runtime.step()
    assert calls == [1]
    assert str(runtime.callbacks) == "step"
    with pytest.raises(KeyError, match="no event 'steps'"):
        runtime.callbacks.set("steps", None)


def test_no_simulation_at_all() -> None:
    runtime = Runtime()
    runtime.play()
    runtime.advance(0.1)
    runtime.step()
    runtime.reset()
    runtime.scrub(3)
    assert (runtime.frame, runtime.num_frames, runtime.errors) == (0, 0, [])


def test_pacer_refuses_a_speed_that_is_not_positive() -> None:
    for speed in (0.0, -1.0, math.nan):
        with pytest.raises(ValueError, match="speed must be > 0"):
            Pacer(speed)


def test_neither_package_nor_runtime_imports_qt_or_opengl() -> None:
    code = "import sys, pydart2, pydart2.gui.runtime; print([m for m in sys.modules if 'Qt' in m or 'OpenGL' in m])"
    result = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert result.stdout.strip() == "[]"
