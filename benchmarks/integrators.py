"""What a minute does to the energy, and what a step takes: python benchmarks/integrators.py.

Without damping or contact: the package's chain of ten links on ball joints from q = 0.3, a double pendulum of rods, and
a body that tumbles about its middle axis. Beside each integrator of ours stand MuJoCo's, where it is installed
(pip install mujoco), on the same bodies.
"""

from __future__ import annotations

import time
import warnings
from collections.abc import Callable, Iterator
from importlib.util import find_spec

import numpy as np
from harness import ROUNDS, Ratio, microseconds, table

import pydart2

SECONDS, SAMPLE = 60.0, 0.02
STEPS = (1e-3, 5e-4)
TIMED = 400
OURS = ("engine", "implicit", "rk4", "variational")
THEIRS = ("Euler", "implicit", "RK4")
TURNS = np.diag([0.1, 0.2, 0.25])


def free_chain(dt: float) -> tuple[pydart2.World, float]:
    """And the energy that errors are relative to: above hanging."""
    world = pydart2.World(dt, "data/skel/chain.skel")
    skel = world.skeletons[0]
    for dof in skel.dofs:
        dof.set_damping_coefficient(0.0)
    skel.q = np.zeros(skel.ndofs)
    low = skel.potential_energy()
    skel.q = np.full(skel.ndofs, 0.3)
    return world, skel.potential_energy() - low


def double_pendulum(dt: float) -> tuple[pydart2.World, float]:
    """Two rods of 1 m and 1 kg that begin level."""
    world = pydart2.World(dt)
    skel, body = world.add_empty_skeleton("pendulum"), None
    for name in ("upper", "lower"):
        place = (0, 0, 0) if body is None else (0, -1, 0)
        moments = np.diag([1 / 12, 1e-3, 1 / 12])
        body = skel.add_body(name, body, "revolute", position=place, mass=1, com=(0, -0.5, 0), inertia=moments)
    low = skel.potential_energy()
    skel.q = [np.pi / 2, 0]
    return world, skel.potential_energy() - low


def tumbling_body(dt: float) -> tuple[pydart2.World, float]:
    """Errors are relative to its kinetic energy."""
    world = pydart2.World(dt)
    world.set_gravity([0, 0, 0])
    skel = world.add_empty_skeleton("body")
    skel.add_body("body", mass=2, inertia=TURNS)
    skel.dq = [0.1, 6.0, 0.2, 0.3, -0.2, 0.1]
    return world, skel.kinetic_energy()


def result(energies: Iterator[float], scale: float) -> str:
    """The largest error, or when there are no numbers any more or the energy is a hundred times too much."""
    start, worst = next(energies), 0.0
    for i, energy in enumerate(energies, 1):
        worst = max(worst, abs(energy - start))
        if not worst < 100 * scale:
            return f"blows up at {i * SAMPLE:.2f} s"
    return f"{worst / scale:.1e}"


def our_energies(world: pydart2.World, integrator: str) -> Iterator[float]:
    """Of the first skeleton."""
    world.set_dynamics("fast")
    world.set_integrator(integrator)
    world.disable_recording()
    skel = world.skeletons[0]
    try:
        for _ in range(round(SECONDS / SAMPLE)):
            yield skel.kinetic_energy() + skel.potential_energy()
            world.step(round(SAMPLE / world.dt))
    except pydart2.SimulationError:
        yield np.inf


def mjcf(world: pydart2.World) -> str:
    """The bodies of the first skeleton; their positions are relative and they do not turn at q = 0."""
    skel = world.skeletons[0]
    q, skel.q = skel.q, np.zeros(skel.ndofs)
    texts = []
    for body in skel.bodynodes:
        place = body.T[:3, 3] - (body.parent_bodynode.T[:3, 3] if body.parent_bodynode else 0)
        joint, at = body.parent_joint, body.parent_joint.transform_from_child_body_node()[:3, 3]
        kind = {"BallJoint": "ball", "RevoluteJoint": "hinge", "FreeJoint": "free"}[type(joint).__name__]
        where = "" if kind == "free" else f'pos="{" ".join(map(str, at))}" axis="0 0 1"'
        I = body.I  # noqa: E741
        texts.append(
            f'<body pos="{" ".join(map(str, place))}"><joint type="{kind}" {where}/>'
            f'<inertial pos="{" ".join(map(str, body.local_com()))}" mass="{body.m}"'
            f' diaginertia="{I[0, 0]} {I[1, 1]} {I[2, 2]}"/>'
        )
    skel.q = q
    gravity = " ".join(map(str, world.gravity()))
    return (
        f'<mujoco><option gravity="{gravity}"><flag contact="disable" energy="enable"/></option>'
        f"<worldbody>{''.join(texts)}{'</body>' * len(texts)}</worldbody></mujoco>"
    )


def their_energies(world: pydart2.World, integrator: str) -> Iterator[float]:
    """Of MuJoCo with the same bodies, positions and velocities."""
    import mujoco
    from scipy.spatial.transform import Rotation

    model = mujoco.MjModel.from_xml_string(mjcf(world))
    model.opt.timestep = world.dt
    model.opt.integrator = getattr(mujoco.mjtIntegrator, f"mjINT_{integrator.upper()}")
    data = mujoco.MjData(model)
    skel = world.skeletons[0]
    if skel.ndofs == 30:
        data.qpos[:] = Rotation.from_rotvec(np.asarray(skel.q).reshape(-1, 3)).as_quat(scalar_first=True).ravel()
    elif skel.ndofs == 2:
        data.qpos[:] = skel.q
    else:
        data.qvel[:] = np.concatenate([skel.dq[3:], skel.dq[:3]])
    for _ in range(round(SECONDS / SAMPLE)):
        mujoco.mj_forward(model, data)
        yield float(data.energy.sum())
        for _ in range(round(SAMPLE / world.dt)):
            mujoco.mj_step(model, data)
        if data.warning.number.any():  # it has set all back
            yield np.inf


def costs() -> str:
    """CPU time of a step of the free chain, in turn, to one by the engine's rule."""
    taken: dict[str, list[float]] = {name: [] for name in OURS}
    for _ in range(ROUNDS):
        for name in OURS:
            world, _ = free_chain(STEPS[0])
            world.set_dynamics("fast")
            world.set_integrator(name)
            world.disable_recording()
            world.step()
            start = time.process_time()
            world.step(TIMED)
            taken[name].append((time.process_time() - start) / TIMED)
    engine = taken["engine"]
    ratios = [f"`{name}` {Ratio([t / e for t, e in zip(taken[name], engine, strict=True)])}" for name in OURS[1:]]
    took = microseconds(engine)
    return f"A step of the free chain takes {took} by the engine's rule; times as long by {', '.join(ratios)}."


SYSTEMS: dict[str, Callable[[float], tuple[pydart2.World, float]]] = {
    "free chain": free_chain,
    "double pendulum": double_pendulum,
    "tumbling body": tumbling_body,
}


def main() -> None:
    """A table."""
    warnings.simplefilter("ignore")
    players: list[tuple[str, str, Callable[[pydart2.World, str], Iterator[float]]]] = [
        (f'`set_integrator("{name}")`', name, our_energies) for name in OURS
    ]
    if find_spec("mujoco"):
        players += [(f"MuJoCo, {name}", name, their_energies) for name in THEIRS]
    rows: list[list[object]] = []
    for dt in STEPS:
        for title, name, energies in players:
            made = [make(dt) for make in SYSTEMS.values()]
            rows.append([f"{1e3 * dt:g} ms", title, *(result(energies(world, name), scale) for world, scale in made)])
    print(
        "## Integrators\n\n"
        "The largest error of the energy in a minute without damping or contact, relative to that above hanging,\n"
        "of the body to its kinetic energy; or when it is a hundred times that.\n"
    )
    print(table(["step", "integrator", *SYSTEMS], rows))
    print(f"\n{costs()}")


if __name__ == "__main__":
    main()
