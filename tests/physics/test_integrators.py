"""Integrators other than the engine's: their order, what they conserve, and where they step aside."""

from __future__ import annotations

import pickle

import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

import pydart2

G = 9.81
OTHERS = ("implicit", "rk4", "variational")
TREE = ("free", "ball", "euler", "universal", "planar", "screw", "prismatic", "translational", "revolute")


def empty(dt: float, integrator: str) -> pydart2.World:
    world = pydart2.World(dt)
    world.set_dynamics("fast")
    world.set_integrator(integrator)
    return world


def tree(dt: float, integrator: str, joints: tuple[str, ...] = TREE) -> pydart2.World:
    """A chain of one joint of each kind with damping, springs, armature, commands and an external force, in motion."""
    world = empty(dt, integrator)
    skel = world.add_empty_skeleton("tree")
    body = None
    for i, joint in enumerate(joints):
        some = {} if i == 0 else {"damping": 0.02, "stiffness": 0.5, "rest": 0.1, "armature": 0.01 * (i % 2)}
        body = skel.add_body(
            f"b{i}",
            body,
            joint,
            position=(0.1, 0.3, 0.05),
            mass=1.0 + 0.3 * i,
            com=(0.05, 0.1, -0.02),
            inertia=np.diag([0.1, 0.2, 0.15]),
            **some,
        )
    rng = np.random.default_rng(2)
    skel.q, skel.dq = 0.3 * rng.normal(size=skel.ndofs), rng.normal(size=skel.ndofs)
    return world


def run(world: pydart2.World, seconds: float) -> NDArray[np.float64]:
    """The state at the end, with commands and an external force held."""
    skel = world.skeletons[0]
    for _ in range(round(seconds / world.dt)):
        skel.tau = np.sin(np.arange(skel.ndofs))
        skel.bodynodes[2].add_ext_force([0.3, 0.2, -0.4], [0.1, 0.0, 0.0], True)
        world.step()
    assert skel.integrator_fallbacks == 0
    return skel.x


@pytest.mark.parametrize(("integrator", "order"), [("implicit", 1), ("variational", 2), ("rk4", 4)])
def test_order(integrator: str, order: int) -> None:
    """All converge to one motion, which is the engine's too, and halving the step makes the error 2^order smaller."""
    exact = run(tree(2e-4, "rk4"), 0.08)
    engine = abs(run(tree(2e-4, "engine"), 0.08) - exact).max()
    assert engine < 2e-3
    coarse, fine = (abs(run(tree(dt, integrator), 0.08) - exact).max() for dt in (4e-3, 2e-3))
    assert fine < 0.05
    assert np.log2(coarse / fine) == pytest.approx(order, abs=0.25)


def test_rk4_is_scipys_motion() -> None:
    """Of M (which has the armature) and c, damping and springs, by another integrator of another step."""
    world = tree(1e-3, "rk4", ("planar", "universal", "revolute", "screw"))
    skel, twin = world.skeletons[0], tree(1e-3, "rk4", ("planar", "universal", "revolute", "screw")).skeletons[0]
    n = skel.ndofs
    damping, stiffness, rest = (
        np.array([getattr(dof, name)() for dof in skel.dofs])
        for name in ("damping_coefficient", "spring_stiffness", "rest_position")
    )

    def rate(_: float, x: NDArray[np.float64]) -> NDArray[np.float64]:
        twin.x = x
        f = -twin.c - damping * x[n:] - stiffness * (x[:n] - rest)
        return np.concatenate([x[n:], np.linalg.solve(twin.M, f)])

    exact = solve_ivp(rate, (0.0, 0.3), skel.x, rtol=1e-11, atol=1e-12).y[:, -1]
    world.step(300)
    assert_allclose(skel.x, exact, atol=3e-9)


def tumbling(dt: float, integrator: str) -> pydart2.World:
    world = empty(dt, integrator)
    world.set_gravity([0.0, 0.0, 0.0])
    body = world.add_empty_skeleton("body").add_body("body", mass=2.0, inertia=np.diag([0.1, 0.2, 0.25]))
    body.skel.dq = [0.1, 6.0, 0.2, 0.3, -0.2, 0.1]
    return world


def angular_momentum(skel: pydart2.Skeleton) -> NDArray[np.float64]:
    return Rotation.from_rotvec(skel.q[:3]).apply(np.diag([0.1, 0.2, 0.25]) @ skel.dq[:3])


@pytest.mark.parametrize(("integrator", "drift"), [("rk4", 1e-7), ("variational", 1e-9)])
def test_a_tumbling_body_keeps_its_momentum(integrator: str, drift: float) -> None:
    """About the axis in the middle, where it turns over again and again; and its centre goes straight on."""
    world = tumbling(1e-3, integrator)
    skel = world.skeletons[0]
    before, energy = angular_momentum(skel), skel.kinetic_energy()
    turned = 0
    for _ in range(200):
        world.step(25)
        turned += bool(skel.dq[1] < -5.0)
    assert turned > 20
    assert_allclose(angular_momentum(skel), before, atol=drift * np.linalg.norm(before))
    assert skel.kinetic_energy() == pytest.approx(energy, rel=1e-5)
    assert_allclose(skel.com_velocity(), [0.3, -0.2, 0.1], atol=1e-9)
    assert_allclose(skel.com(), [1.5, -1.0, 0.5], atol=1e-8)


def test_a_symmetric_top_precesses() -> None:
    """Torque-free: the axis of symmetry turns about the angular momentum L at |L| / I, I across the axis."""
    world = empty(1e-3, "rk4")
    world.set_gravity([0.0, 0.0, 0.0])
    inertia = np.diag([0.2, 0.2, 0.1])
    skel = world.add_empty_skeleton("top")
    skel.add_body("top", mass=1.0, inertia=inertia)
    skel.dq = [1.0, 0.0, 5.0, 0.0, 0.0, 0.0]
    L = inertia @ [1.0, 0.0, 5.0]
    world.step(2000)
    axis = Rotation.from_rotvec(skel.q[:3]).apply([0.0, 0.0, 1.0])
    assert_allclose(axis, Rotation.from_rotvec(L / 0.2 * 2.0).apply([0.0, 0.0, 1.0]), atol=1e-8)


def chain(dt: float, integrator: str) -> pydart2.World:
    world = pydart2.World(dt, "data/skel/chain.skel")
    world.set_dynamics("fast")
    world.set_integrator(integrator)
    for dof in world.skeletons[0].dofs:
        dof.set_damping_coefficient(0.0)
    return world


def energy_error(world: pydart2.World, seconds: float) -> float:
    """The largest, relative to the energy above hanging."""
    skel = world.skeletons[0]

    def energy() -> float:
        return skel.kinetic_energy() + skel.potential_energy()

    skel.q = np.zeros(skel.ndofs)
    low = energy()
    skel.q = np.full(skel.ndofs, 0.3)
    start, worst = energy(), 0.0
    for _ in range(round(seconds / 0.02)):
        world.step(round(0.02 / world.dt))
        worst = max(worst, abs(energy() - start))
    return worst / (start - low)


def test_a_limp_chain_keeps_its_energy() -> None:
    """The engine's rule blows up at 1.45 s; `make bench` has a minute of it."""
    with pytest.raises(pydart2.SimulationError, match="blew up"):
        energy_error(chain(1e-3, "engine"), 2.0)
    assert energy_error(chain(1e-3, "rk4"), 2.0) < 1e-3
    assert energy_error(chain(5e-4, "rk4"), 2.0) < 1e-3 / 12
    assert energy_error(chain(1e-3, "variational"), 2.0) < 5e-3
    assert energy_error(chain(1e-3, "implicit"), 4.0) < 0.5


def test_a_double_pendulum_keeps_its_energy() -> None:
    """Its centres of mass are beside the joints."""
    for integrator, error in (("rk4", 1e-7), ("variational", 1e-4)):
        world = empty(1e-3, integrator)
        skel = world.add_empty_skeleton("rods")
        rod = {"mass": 1.0, "com": (0, -0.5, 0), "inertia": np.diag([1 / 12, 1e-3, 1 / 12])}
        upper = skel.add_body("upper", None, "revolute", **rod)
        skel.add_body("lower", upper, "revolute", position=(0, -1, 0), **rod)
        skel.q = [np.pi / 2, 0.0]
        for _ in range(20):
            world.step(100)
            assert abs(skel.kinetic_energy() + skel.potential_energy()) < error * 2 * G


def test_variational_goes_back_where_it_came_from() -> None:
    """It is symmetric in time."""
    world = chain(1e-3, "variational")
    skel = world.skeletons[0]
    skel.q = np.full(skel.ndofs, 0.3)
    before = skel.x
    world.step(300)
    assert abs(skel.q - before[: skel.ndofs]).max() > 0.3
    skel.dq = -skel.dq
    world.step(300)
    assert_allclose(skel.q, before[: skel.ndofs], atol=1e-8)


def test_implicit_solves_its_equation() -> None:
    """(M + h D + h^2 K + h C) a = tau - c - D dq - K (q + h dq - rest), with C = 1/2 dc/ddq by differences."""
    world = tree(1e-2, "implicit", ("universal", "euler", "revolute"))
    skel, h = world.skeletons[0], 1e-2
    damping, stiffness, rest = (
        np.array([getattr(dof, name)() for dof in skel.dofs])
        for name in ("damping_coefficient", "spring_stiffness", "rest_position")
    )
    q, dq, M, c = skel.q, skel.dq, skel.M, skel.c

    def bias(i: int, change: float) -> NDArray[np.float64]:
        skel.dq = dq + change * np.eye(len(dq))[i]
        return skel.c

    C = np.column_stack([(bias(i, 1e-4) - bias(i, -1e-4)) / 4e-4 for i in range(len(dq))])
    skel.dq = dq
    world.step()
    A = M + np.diag(h * damping + h * h * stiffness) + h * C
    a = np.linalg.solve(A, -c - damping * dq - stiffness * (q + h * dq - rest))
    assert_allclose(skel.dq, dq + h * a, atol=1e-9)
    assert_allclose(skel.ddq, a, atol=1e-7)


@pytest.mark.parametrize("solver", ["fast", "dart", "iterative"])
@pytest.mark.parametrize("integrator", ["rk4", "variational"])
def test_contacts_take_the_engines_rule(integrator: str, solver: str) -> None:
    """A box that falls: freely, as g says to the last digits; then at rest on the floor, each step counted."""
    world = empty(1e-3, integrator)
    world.set_constraint_solver(solver)
    world.add_ground()
    box = world.add_box((0.2, 0.2, 0.2), mass=1.0, position=(0.0, 0.5, 0.0))
    world.step(200)
    assert box.C[1] == pytest.approx(0.5 - 0.5 * 9.81 * 0.2**2, abs=1e-12)
    assert box.integrator_fallbacks == 0
    world.step(1500)
    assert box.C[1] == pytest.approx(0.1, abs=1e-3)
    assert 1400 < box.integrator_fallbacks < 1500
    world.set_integrator("engine")
    assert box.integrator_fallbacks == 0


def test_prescribed_motion_takes_the_engines_rule() -> None:
    world = chain(1e-3, "rk4")
    world.skeletons[0].joints[3].set_actuator_type(pydart2.joint.Joint.VELOCITY)
    twin = chain(1e-3, "engine")
    twin.skeletons[0].joints[3].set_actuator_type(pydart2.joint.Joint.VELOCITY)
    for each in (world, twin):
        each.skeletons[0].q = np.full(each.skeletons[0].ndofs, 0.3)
        each.step(100)
    assert world.x.tobytes() == twin.x.tobytes()
    assert world.skeletons[0].integrator_fallbacks == 100


def test_a_step_that_is_too_long_is_the_engines() -> None:
    """Where a body would turn by more than two radians: the engine's rule, counted."""
    worlds = [tree(0.5, integrator, ("ball", "ball")) for integrator in ("variational", "engine")]
    for world in worlds:
        world.skeletons[0].dq = np.full(6, 30.0)
        world.step()
    assert worlds[0].x.tobytes() == worlds[1].x.tobytes()
    assert worlds[0].skeletons[0].integrator_fallbacks == 1


def test_blow_up_goes_back() -> None:
    world = tree(0.5, "rk4", ("ball", "ball"))
    world.skeletons[0].dq = np.full(6, 1e10)
    before = world.x
    with pytest.raises(pydart2.SimulationError, match="blew up"):
        world.step()
    assert world.x.tobytes() == before.tobytes()


@pytest.mark.parametrize("integrator", OTHERS)
def test_copies_go_on_bit_for_bit(integrator: str) -> None:
    world = chain(1e-3, integrator)
    world.skeletons[0].q = np.full(world.skeletons[0].ndofs, 0.3)
    world.step(50)
    copies = [world.clone(), pickle.loads(pickle.dumps(world))]
    saved = world.snapshot()
    world.step(50)
    for copy in copies:
        assert copy.integrator() == integrator
        copy.step(50)
        assert copy.x.tobytes() == world.x.tobytes()
    after = world.x
    world.restore(saved)
    world.step(50)
    assert world.x.tobytes() == after.tobytes()
    batch = pydart2.Batch(copies[0], 2, threads=2)
    batch.step(20)
    copies[0].step(20)
    assert batch.x[0].tobytes() == batch.x[1].tobytes() == copies[0].x.tobytes()


def test_choosing() -> None:
    world = pydart2.World(1e-3)
    world.set_dynamics("engine")
    assert world.integrator() == "engine"
    with pytest.raises(ValueError, match="no integrator 'euler'; there are engine, implicit, rk4 and variational"):
        world.set_integrator("euler")
    with pytest.raises(ValueError, match=r"needs the fast dynamics; world.set_dynamics\(\"fast\"\) comes first"):
        world.set_integrator("rk4")
    world.set_dynamics("fast")
    world.set_integrator("rk4")
    with pytest.raises(ValueError, match=r"set_integrator\(\"engine\"\) comes first"):
        world.set_dynamics("engine")
    assert world.dynamics() == "fast"
