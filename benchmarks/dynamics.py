"""What a step takes with the engine's dynamics, with ours, and in others: python benchmarks/dynamics.py.

Chains of revolute joints without contact, swinging from q = 3 / n; the scenes of the other benchmarks. The worlds
step in turn in this process, many steps in one call; the chains go back to their first state after each. Beside them
stand MuJoCo's step and Pinocchio's forward dynamics alone, called from Python, each where it is installed
(pip install mujoco pin).
"""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable
from functools import partial
from importlib.util import find_spec

import numpy as np
from harness import ROUNDS, Ratio, table
from scenes import scenes
from step import ours

import pydart2

LENGTH, MASS, SIDE = 0.1, 0.1, 0.05  # of a link: m, kg, m
STEPS = {10: 400, 30: 200, 100: 50}

Call = Callable[[], float]


def swing(count: int) -> np.ndarray:
    """The first positions."""
    return np.full(count, 3.0 / count)


def moments() -> tuple[float, float, float]:
    """Of a box about its centre: Ixx, Iyy, Izz."""
    across, along = MASS * 2 * SIDE**2 / 12, MASS * (SIDE**2 + LENGTH**2) / 12
    return along, across, along


def chain(count: int) -> pydart2.World:
    """A chain of ours."""
    world = pydart2.World(1e-4)
    skeleton, parent = world.add_empty_skeleton("chain"), None
    for i in range(count):
        axis = (0, 0, 1) if i % 2 else (1, 0, 0)
        place = (0, -LENGTH, 0) if i else (0, 0, 0)
        options = {
            "axis": axis,
            "position": place,
            "mass": MASS,
            "com": (0, -LENGTH / 2, 0),
            "inertia": np.diag(moments()),
        }
        parent = skeleton.add_body(f"link{i}", parent, "revolute", **options)
    world.set_recording(False)
    return world


def our_call(world: pydart2.World, steps: int, q: np.ndarray) -> Call:
    """CPU time of so many steps of the first skeleton's swing."""
    skeleton, still = world.skeletons[0], np.zeros(len(q))

    def call() -> float:
        skeleton.set_positions(q)
        skeleton.set_velocities(still)
        begin = time.thread_time()
        world.step(steps)
        return (time.thread_time() - begin) / steps

    return call


def mujoco_call(count: int, steps: int) -> Call:
    """The same in MuJoCo."""
    import mujoco

    inertia = " ".join(map(str, moments()))
    bodies = ""
    for i in range(count):
        place, axis = (f"0 {-LENGTH} 0" if i else "0 0 0"), ("0 0 1" if i % 2 else "1 0 0")
        bodies += f'<body pos="{place}"><joint axis="{axis}"/><inertial pos="0 {-LENGTH / 2} 0" mass="{MASS}" '
        bodies += f'diaginertia="{inertia}"/>'
    option = '<option timestep="1e-4" gravity="0 -9.81 0"/>'
    xml = f"<mujoco>{option}<worldbody>{bodies}{'</body>' * count}</worldbody></mujoco>"
    model = mujoco.MjModel.from_xml_string(xml)
    data = mujoco.MjData(model)

    def call() -> float:
        mujoco.mj_resetData(model, data)
        data.qpos[:] = swing(count)
        begin = time.thread_time()
        mujoco.mj_step(model, data, steps)
        return (time.thread_time() - begin) / steps

    return call


def pinocchio_call(count: int, calls: int) -> Call:
    """Pinocchio's accelerations of the chain at its first positions, where our own agree with them."""
    import pinocchio

    model, parent = pinocchio.Model(), 0
    model.gravity.linear = np.array([0.0, -9.81, 0.0])
    inertia = pinocchio.Inertia(MASS, np.array([0.0, -LENGTH / 2, 0.0]), np.diag(moments()))
    for i in range(count):
        joint = pinocchio.JointModelRZ() if i % 2 else pinocchio.JointModelRX()
        place = pinocchio.SE3(np.eye(3), np.array([0.0, -LENGTH if i else 0.0, 0.0]))
        parent = model.addJoint(parent, joint, place, f"link{i}")
        model.appendBodyToJoint(parent, inertia, pinocchio.SE3.Identity())
    data, q, still = model.createData(), swing(count), np.zeros(count)

    ours = chain(count)
    ours.skeletons[0].set_positions(q)
    ours.step()
    np.testing.assert_allclose(ours.skeletons[0].ddq, pinocchio.aba(model, data, q, still, still), rtol=1e-8, atol=1e-8)

    def call() -> float:
        begin = time.thread_time()
        for _ in range(calls):
            pinocchio.aba(model, data, q, still, still)
        return (time.thread_time() - begin) / calls

    return call


def in_turn(calls: list[Call]) -> list[list[float]]:
    """The times of each."""
    for call in calls:
        call()
    times: list[list[float]] = [[] for _ in calls]
    for _ in range(5 * ROUNDS):
        for mine, call in zip(times, calls):
            mine.append(call())
    return times


def ratio(times: list[float], others: list[float]) -> Ratio:
    """Of each turn."""
    return Ratio([a / b for a, b in zip(times, others)])


def chains() -> list[list[object]]:
    """A row for each length."""
    rows: list[list[object]] = []
    for count, steps in STEPS.items():
        worlds = [chain(count) for _ in range(2)]
        for world, name in zip(worlds, ("engine", "fast")):
            world.set_dynamics(name)
        calls = [our_call(world, steps, swing(count)) for world in worlds]
        competitors = {"mujoco": mujoco_call, "pinocchio": pinocchio_call}
        found = [name for name in competitors if find_spec(name)]
        engine, fast, *others = in_turn(calls + [competitors[name](count, steps) for name in found])
        assert worlds[0].x.tobytes() == worlds[1].x.tobytes()
        theirs = dict(zip(found, others))
        beside = [ratio(fast, theirs[name]) if name in theirs else "not installed" for name in competitors]
        rows.append([f"chain of {count}", f"{statistics.median(engine) * 1e6:.3g} µs", ratio(engine, fast), *beside])
    return rows


def twenty_steps(world: pydart2.World) -> float:
    """CPU time of one of them."""
    begin = time.thread_time()
    world.step(20)
    return (time.thread_time() - begin) / 20


def models() -> list[list[object]]:
    """A row for each scene."""
    rows: list[list[object]] = []
    for scene in scenes().values():
        worlds = [ours(scene, False) for _ in range(2)]
        for world, name in zip(worlds, ("engine", "fast")):
            world.set_dynamics(name)

        engine, fast = in_turn([partial(twenty_steps, world) for world in worlds])
        assert worlds[0].x.tobytes() == worlds[1].x.tobytes()
        rows.append([scene.name, f"{statistics.median(engine) * 1e6:.3g} µs", ratio(engine, fast), "", ""])
    return rows


def main() -> None:
    """A table."""
    print(
        "## Dynamics\n\n"
        '`set_dynamics("fast")` beside the engine\'s, which gives the same bits, beside MuJoCo (Euler, no contacts),\n'
        "and beside Pinocchio's `aba` alone, called from Python: how many times as fast as the engine, and its time\n"
        "as a ratio to MuJoCo's step and to `aba`; median (range).\n"
    )
    print(table(["scene", "engine", "engine / fast", "fast / MuJoCo", "fast / aba"], chains() + models()))


if __name__ == "__main__":
    main()
