"""32 worlds with a limp human each, who collapses and then lies: 2 s on two threads, beside mujoco.rollout."""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable

import mujoco
import mujoco.rollout
import numpy as np
from harness import ROUNDS, Ratio, met, microseconds, table
from ragdolls import add_ragdoll, place, theirs

import pydart2

WORLDS, THREADS, DT, STEPS = 32, 2, 0.001, 2000
HEIGHT = 0.8  # m, of the pelvis: the feet are a hand's breadth above the ground
FALL = 300  # steps
TURNS = np.linspace(-0.4, 0.4, WORLDS)  # rad, to the side: no two fall alike


def human(detector: str, solver: str, turn: float, ground: bool = True) -> pydart2.World:
    """One of the worlds."""
    world = pydart2.World(DT, up="z")
    world.set_recording(False)
    world.set_collision_detector(detector)
    world.set_constraint_solver(solver)
    if ground:
        world.add_ground(size=(200.0, 200.0))
    add_ragdoll(world, "human", HEIGHT, turn)
    return world


def ours(detector: str, solver: str) -> Callable[[], float]:
    """Steps of a batch; how high the highest pelvis is after them."""
    batch = pydart2.Batch(human(detector, solver, 0.0), WORLDS, threads=THREADS)
    start = np.array([human(detector, solver, turn).x for turn in TURNS])

    def run() -> float:
        batch.reset()
        batch.x = start
        batch.step(STEPS)
        assert not batch.failed
        return float(batch.T("pelvis")[:, 2, 3].max())

    return run


def mujocos() -> Callable[[], float]:
    """The same in MuJoCo, from what we export."""
    model, data = theirs(human("native", "iterative", 0.0))
    full = mujoco.mjtState.mjSTATE_FULLPHYSICS
    states = np.empty((WORLDS, mujoco.mj_stateSize(model, full)))
    for state, turn in zip(states, TURNS, strict=True):
        place(model, data, human("native", "iterative", turn))
        mujoco.mj_getState(model, data, state, full)
    pool = mujoco.rollout.Rollout(nthread=THREADS)
    datas = [mujoco.MjData(model) for _ in range(THREADS)]

    def run() -> float:
        end, _ = pool.rollout(model, datas, states, nstep=STEPS)
        return float(end[:, -1, 3].max())  # time, then the root's place

    return run


def in_the_air() -> tuple[list[float], list[float]]:
    """CPU time of a step of one human that touches nothing, ours and MuJoCo's: the dynamics alone."""
    world = human("native", "iterative", 0.0, ground=False)
    start = world.states()
    model, data = theirs(human("native", "iterative", 0.0))
    model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONTACT
    poses = data.qpos.copy()

    def fall() -> None:
        world.set_states(start)
        world.step(FALL)

    def fall_in_mujoco() -> None:
        mujoco.mj_resetData(model, data)
        data.qpos[:] = poses
        mujoco.mj_step(model, data, FALL)

    calls, times = (fall, fall_in_mujoco), ([], [])
    for _ in range(5 * ROUNDS):
        for call, mine in zip(calls, times, strict=True):
            begin = time.thread_time()
            call()
            mine.append((time.thread_time() - begin) / FALL)
    return times


def main() -> None:
    """Steps per second by the clock on the wall, in turn: nothing else should run on the machine."""
    players = {
        "MuJoCo": (mujocos(), None),
        "Bullet, exact": (ours("bullet", "fast"), 0.8),
        "native, iterative": (ours("native", "iterative"), 1.0),
        "FCL, exact": (ours("fcl", "fast"), None),
    }
    times: dict[str, list[float]] = {name: [] for name in players}
    heights = dict.fromkeys(players, 0.0)
    for _ in range(ROUNDS):
        for name, (run, _) in players.items():
            begin = time.perf_counter()
            heights[name] = run()
            times[name].append(time.perf_counter() - begin)
    rows: list[list[object]] = []
    for name, (_, bar) in players.items():
        ratio = Ratio([their_s / our_s for their_s, our_s in zip(times["MuJoCo"], times[name], strict=True)])
        rate = WORLDS * STEPS / statistics.median(times[name])
        verdict = "" if bar is None else met(ratio, bar, at_least=True)
        rows.append([name, f"{rate:,.0f}", ratio, verdict, f"{heights[name]:.2f} m"])
    print("## A limp human of 33 dofs beside `mujoco.rollout`\n")
    print(f"{WORLDS} worlds on {THREADS} threads, {STEPS} steps of {DT * 1e3:g} ms: they collapse, then lie.\n")
    print(table(["", "steps/s", "to MuJoCo", "bar", "highest pelvis in the end"], rows))
    air, their_air = in_the_air()
    ratio = Ratio([a / b for a, b in zip(air, their_air, strict=True)])
    print(
        f"\nA step of one human that touches nothing, native, iterative: {microseconds(air)}, in MuJoCo"
        f" {microseconds(their_air)}; time to MuJoCo's {ratio}."
    )


if __name__ == "__main__":
    main()
