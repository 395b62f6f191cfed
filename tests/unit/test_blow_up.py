"""world.set_blow_up("nan"): what blows up reads NaN, alone, until it gets a state again."""

from __future__ import annotations

import pickle
from collections.abc import Callable

import numpy as np
import pytest

import pydart2
from pydart2.building.skins import Skin

FAST = 1e25  # rad/s: the next step's numbers are beyond all reason


@pytest.fixture
def world() -> pydart2.World:
    """A box at rest, and a chain that blows up in the first step."""
    world = pydart2.World(0.001, "skel/chain.skel")
    world.add_box([0.2, 0.2, 0.2], 1.0, [5.0, 0.0, 0.0])
    world.set_blow_up("nan")
    return world


def blow_up(world: pydart2.World) -> pydart2.World:
    world.skeletons[0].dq = np.full(world.skeletons[0].ndofs, FAST)
    world.step(5)
    return world


def chain_is_nan(world: pydart2.World) -> bool:
    chain = world.skeletons[0]
    values = np.concatenate(
        [chain.q, chain.dq, chain.ddq, chain.x, [chain.dofs[3].position(), chain.dofs[3].velocity()]]
    )
    assert np.isnan(values).all() or np.isfinite(values).all()
    return bool(np.isnan(values).all())


def test_only_what_blew_up(world: pydart2.World) -> None:
    assert world.blow_up() == "nan"
    box = world.skeletons[1]
    box_q = box.q
    blow_up(world)
    assert chain_is_nan(world)
    assert np.isnan(world.x).sum() == 2 * world.skeletons[0].ndofs
    assert (world.t, world.frame) == (pytest.approx(0.005), 5)
    np.testing.assert_allclose(box.q, box_q, atol=1e-3)
    box_q = box.q
    world.step(10)
    np.testing.assert_array_equal(box.q, box_q)
    assert world.frame == 15


def test_an_old_loop_goes_on_to_its_done(world: pydart2.World) -> None:
    chain = world.skeletons[0]
    blow_up(world)
    for _ in range(3):
        chain.tau = -10.0 * chain.q - chain.dq  # NaN
        world.step()
    assert not np.isfinite(chain.q).all()
    world.reset()
    world.step(3)
    assert np.isfinite(world.x).all()


BACK: dict[str, Callable[[pydart2.World, pydart2.state.Snapshot], object]] = {
    "reset": lambda world, start: world.reset(),
    "restore": lambda world, start: world.restore(start),
    "set_states": lambda world, start: world.set_states(np.zeros(len(world.x))),
    "x": lambda world, start: setattr(world, "x", np.zeros(len(world.x))),
    "q": lambda world, start: world.skeletons[0].set_positions(np.zeros(world.skeletons[0].ndofs)),
}


@pytest.mark.parametrize("way", BACK)
def test_the_ways_back(world: pydart2.World, way: str) -> None:
    start = world.snapshot()
    blow_up(world)
    BACK[way](world, start)
    world.skeletons[0].dq = np.zeros(world.skeletons[0].ndofs)
    world.step(5)
    assert np.isfinite(world.x).all()
    other = pydart2.World(0.001, "skel/chain.skel")
    other.step(5)
    np.testing.assert_allclose(world.skeletons[0].q, other.skeletons[0].q, atol=1e-9)


@pytest.mark.parametrize(
    "copy", [lambda w: w.clone(), lambda w: pickle.loads(pickle.dumps(w))], ids=["clone", "pickle"]
)
def test_copies_have_the_setting_and_what_is_nan_has_no_copy(
    world: pydart2.World, copy: Callable[[pydart2.World], pydart2.World]
) -> None:
    assert chain_is_nan(blow_up(copy(world)))
    blow_up(world)
    with pytest.raises(pydart2.SimulationError, match="has blown up and has no state to copy"):
        copy(world)


def test_other_worlds_of_a_batch_go_on(world: pydart2.World) -> None:
    batch = pydart2.Batch(world, 3, threads=2, skeleton=0)
    dq = batch.dq
    dq[1] = FAST
    batch.dq = dq
    x = np.empty_like(batch.x)
    batch.step(5, out=x)
    np.testing.assert_array_equal(x, batch.x)
    assert batch.failed == {}
    assert np.isnan(batch.q[1]).all()
    assert np.isfinite(batch.x[[0, 2]]).all()
    batch.reset([1])
    batch.step(5)
    assert np.isfinite(batch.x).all()


def test_recorded_frames_read_nan_too(world: pydart2.World) -> None:
    world.step(2)
    blow_up(world)
    world.set_frame(1)
    assert not chain_is_nan(world)
    world.set_frame(4)
    assert chain_is_nan(world)


def test_what_the_user_has_to_mend_is_raised_all_the_same(world: pydart2.World) -> None:
    dof = world.skeletons[0].dofs[0]
    dof.set_position_lower_limit(1.0)
    dof.set_position_upper_limit(-1.0)
    dof.joint.set_position_limit_enforced()
    with pytest.raises(pydart2.SimulationError, match="above the upper one"):
        world.step()


def test_by_default_it_raises_and_says_how_not_to() -> None:
    world = pydart2.World(0.001, "skel/chain.skel")
    assert world.blow_up() == "raise"
    with pytest.raises(pydart2.SimulationError, match=r'world.set_blow_up\("nan"\)'):
        blow_up(world)
    with pytest.raises(ValueError, match="got 'NaN'"):
        world.set_blow_up("NaN")


def test_a_robot_that_got_the_mass_it_lacked_steps() -> None:
    """The engine looks at the acceleration that a body had when it was last asked for, if there are soft bodies."""
    world = pydart2.World(0.001)
    skel = world.add_empty_skeleton("robot")
    wrist = skel.add_body("wrist", joint="ball")
    with pytest.raises(pydart2.SimulationError, match="moves nothing that has inertia"):
        world.step()
    skin = Skin.box([0.2, 0.2, 0.2], 1.0, 1)
    skel.add_body("hand", wrist, "translational", mass=1.0, inertia=np.eye(3), skin=skin)
    copy = world.clone()
    for each in (world, copy):
        each.step(3)
    np.testing.assert_array_equal(world.x, copy.x)
    assert abs(skel.dq).max() > 0.01


@pytest.mark.parametrize("dynamics", ["fast", "engine"])
def test_the_skeleton_without_inertia_is_the_one_that_reads_nan(dynamics: str) -> None:
    """The engine does not say which it is, and here another one is faster."""
    world = pydart2.World(0.001, "skel/chain.skel")
    world.skeletons[0].dq = np.full(world.skeletons[0].ndofs, 3.0)
    bare = world.add_empty_skeleton("bare")
    bare.add_body("link", joint="revolute")
    world.set_dynamics(dynamics)
    world.set_blow_up("nan")
    world.step()
    assert np.isnan(bare.q).all()
    assert np.isfinite(world.skeletons[0].q).all()
