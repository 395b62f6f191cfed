"""The recorded frames of a world."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import pydart2
from physics.models import arm, make_world, pendulum, save_skeleton, slider


@pytest.fixture
def world(tmp_path: Path) -> pydart2.World:
    return make_world(tmp_path, pendulum(), recording=True)


def test_frames_are_steps_and_one(world: pydart2.World) -> None:
    assert (world.num_frames(), world.nframes, world.frame, world.is_recording()) == (1, 1, 0, True)
    world.step()
    world.step(4)
    assert (world.num_frames(), world.nframes, world.frame) == (6, 6, 5)
    assert world.recording is not None and world.recording.num_frames() == 6


def test_a_new_world_records(cubes: pydart2.World) -> None:
    assert cubes.is_recording() and cubes.num_frames() == 1


def test_set_frame_returns_to_the_state(world: pydart2.World) -> None:
    world.skeletons[0].q = [1.0]
    world.reset()
    world.skeletons[0].dq = [2.0]
    states = [np.zeros(2)]
    for _ in range(20):
        world.step()
        states.append(world.x)
    for i in (20, 0, 7, 13):
        assert world.set_frame(i) is True
        np.testing.assert_array_equal(world.x, states[i])
        np.testing.assert_array_equal(world.recording.states(i), states[i])
    # The state goes back; time and the counter do not.
    assert world.frame == 20 and world.t == pytest.approx(0.02)
    assert world.num_frames() == 21


@pytest.mark.parametrize("index", [-1, 6, 10**9])
def test_set_frame_out_of_range(world: pydart2.World, index: int) -> None:
    world.step(5)
    state = world.x
    assert world.set_frame(index) is False
    np.testing.assert_array_equal(world.x, state)
    with pytest.raises(IndexError, match=rf"frame {index} is not kept; the recording has frames 0 to 5"):
        world.recording.states(index)
    with pytest.raises(IndexError):
        world.recording.contacts(index)


def test_recording_off(world: pydart2.World) -> None:
    world.step(3)
    world.disable_recording()
    assert (world.num_frames(), world.is_recording(), world.recording) == (0, False, None)
    assert world.set_frame(0) is False
    world.step(3)
    assert (world.num_frames(), world.frame) == (0, 6)
    state = world.x
    world.enable_recording()
    assert world.num_frames() == 1
    np.testing.assert_array_equal(world.recording.states(0), state)
    world.step(2)
    assert world.num_frames() == 3


def test_enabling_twice_keeps_the_frames(world: pydart2.World) -> None:
    world.step(3)
    recording = world.recording
    world.set_recording(True)
    assert world.num_frames() == 4 and world.recording is recording


def test_reset_starts_over(world: pydart2.World) -> None:
    world.skeletons[0].dofs[0].set_initial_position(0.3)
    world.step(3)
    world.reset()
    assert (world.num_frames(), world.frame, world.recording.first_frame) == (1, 0, 0)
    np.testing.assert_array_equal(world.recording.states(0), [0.3, 0])


def test_the_limit_drops_the_oldest(world: pydart2.World) -> None:
    recording = world.recording
    world.step(100)
    per_frame = recording.num_bytes / 101
    states = [recording.states(i) for i in range(101)]
    recording.limit_bytes = round(20 * per_frame)
    assert recording.limit_bytes == round(20 * per_frame)
    assert recording.num_bytes <= recording.limit_bytes
    assert world.num_frames() == 101
    first = recording.first_frame
    assert 80 <= first <= 83
    assert world.set_frame(first - 1) is False
    assert world.set_frame(first) is True
    np.testing.assert_array_equal(world.x, states[first])
    assert len(recording.history) == 101 - first

    world.step(50)
    assert world.num_frames() == 151
    assert recording.first_frame == first + 50
    assert recording.num_bytes <= recording.limit_bytes


def test_the_newest_frame_is_always_kept(world: pydart2.World) -> None:
    world.recording.limit_bytes = 0
    world.step(10)
    assert (world.num_frames(), world.recording.first_frame) == (11, 10)
    assert world.set_frame(10) and not world.set_frame(9)


def test_default_limit_and_bad_limits(world: pydart2.World) -> None:
    assert world.recording.limit_bytes == 64 * 2**20
    with pytest.raises(ValueError, match="zero or more bytes, got -1"):
        world.recording.limit_bytes = -1
    with pytest.raises(TypeError):
        world.recording.limit_bytes = "64 MB"  # type: ignore[assignment]


def test_set_frame_after_adding_a_skeleton(world: pydart2.World, tmp_path: Path) -> None:
    """The original passed the engine a vector that was too short, which it ignored."""
    world.skeletons[0].q = [0.5]
    world.step(5)
    early = world.recording.states(5)
    added = world.add_skeleton(save_skeleton(tmp_path, arm()))
    added.q = [0.1, 0.2]
    world.step()
    late = world.x
    added.q = [0.7, 0.8]
    assert world.set_frame(5) is True
    np.testing.assert_array_equal(world.skeletons[0].x, early)
    np.testing.assert_array_equal(added.q, [0.7, 0.8])
    assert world.set_frame(6) is True
    np.testing.assert_array_equal(world.x, late)


def test_set_frame_after_removing_a_skeleton(tmp_path: Path) -> None:
    """A frame of other skeletons is either put back by skeleton or refused; it never lands in the wrong one."""
    world = make_world(tmp_path, pendulum(), pendulum().replace("pendulum", "second"), recording=True)
    first, second = world.skeletons
    first.q, second.q = [1.0], [2.0]
    world.step()
    expected = world.recording.states(1)[2:]
    world.remove_skeleton(first)
    second.q = [0.5]
    if world.set_frame(1):
        np.testing.assert_array_equal(second.x, expected)
    else:
        np.testing.assert_array_equal(second.q, [0.5])


def test_set_frame_after_swapping_skeletons(tmp_path: Path) -> None:
    """As many numbers as the frame has do not make it a frame of these skeletons."""
    world = make_world(tmp_path, pendulum(), recording=True)
    world.skeletons[0].q = [1.0]
    world.step()
    world.remove_skeleton(world.skeletons[0])
    other = world.add_skeleton(save_skeleton(tmp_path, slider()))
    world.set_frame(1)
    np.testing.assert_array_equal(other.x, [0, 0])


def test_bake_and_clear(world: pydart2.World) -> None:
    world.recording.bake()
    assert world.num_frames() == 2
    world.step()
    state = world.x
    world.recording.clear()
    assert world.num_frames() == 1
    np.testing.assert_array_equal(world.recording.states(0), state)


def test_contacts_of_a_recorded_frame(cubes: pydart2.World) -> None:
    live = [0]
    forces = [np.zeros((0, 3))]
    for _ in range(60):
        cubes.step()
        result = cubes.collision_result
        live.append(result.num_contacts())
        forces.append(np.array([c.f for c in result.contacts]).reshape(-1, 3))
    assert max(live) > 0
    for i in (60, 0, 1, 30):
        assert cubes.set_frame(i)
        assert cubes.collision_result.num_contacts() == live[i]
        assert cubes.recording.contacts(i).num_contacts() == live[i]
        np.testing.assert_array_equal(
            np.array([c.f for c in cubes.collision_result.contacts]).reshape(-1, 3), forces[i]
        )
    history = cubes.recording.history
    assert [result.num_contacts() for _, result in history] == live
    np.testing.assert_array_equal(history[60][0], cubes.recording.states(60))


def test_frames_are_copies(world: pydart2.World) -> None:
    world.step()
    world.recording.states(1)[:] = 9.0
    np.testing.assert_array_equal(world.recording.states(1), world.x)
