"""The same worlds here and in Debian's dartpy, on the same library: equal numbers, equal contacts in equal order."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest

import pydart2
from oracle.compare import assert_same_frame
from oracle.dartpy_oracle import DartpyOracle
from oracle.models import dart_model

REPORT = (0, 1, 1000)


@dataclass(frozen=True)
class Case:
    """A world by its files, and how its moving skeletons are thrown into it."""

    files: tuple[str, ...]
    robot: int  # index of the skeleton with the random pose
    speed: float  # of its dofs, rad/s or m/s
    angle: float  # range of its dofs, rad or m
    start: tuple[tuple[int, float], ...] = ()  # dofs that are set so that it starts upright on the ground
    gravity: tuple[float, float, float] | None = None


CASES = {
    "cubes": Case(("skel/cubes.skel",), robot=3, speed=0.5, angle=0.02),
    "atlas": Case(
        ("skel/ground.skel", "sdf/atlas/atlas_v3_no_head.sdf"),
        robot=1,
        speed=0.5,
        angle=0.1,
        start=((0, -np.pi / 2), (4, 0.1)),  # the model has z up, the ground is along x and z
        gravity=(0.0, -9.81, 0.0),
    ),
    "fullbody1": Case(("skel/fullbody1.skel",), robot=1, speed=0.5, angle=0.3),
}


def path_of(name: str, own: bool) -> Path:
    """A model of the package, or DART's own of the same name."""
    return Path(pydart2.data_path(name)) if own else dart_model(name)


def make_world(files: list[Path]) -> pydart2.World:
    """The world of the first file with the skeletons of the others."""
    world = pydart2.World(0.001, files[0])
    for file in files[1:]:
        world.add_skeleton(file)
    return world


def random_states(world: pydart2.World, case: Case, seed: int) -> list[tuple[np.ndarray, np.ndarray]]:
    """(q, dq) per skeleton: as loaded, but for the robot."""
    rng = np.random.default_rng(seed)
    states = [(np.array(skel.q), np.array(skel.dq)) for skel in world.skeletons]
    q, dq = states[case.robot]
    q += case.angle * rng.uniform(-1, 1, q.size)
    dq += case.speed * rng.uniform(-1, 1, dq.size)
    for index, value in case.start:
        q[index] = value
    return states


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("own", [True, False], ids=["own", "dart"])
@pytest.mark.parametrize("name", CASES)
def test_same_world(oracle: DartpyOracle, name: str, own: bool, seed: int) -> None:
    case = CASES[name]
    own_files = [file for file in case.files if file in pydart2.data_files()]
    if own and not own_files:
        own = False  # the package has no such model
    files = [path_of(file, own and file in own_files) for file in case.files]
    world = make_world(files)
    if case.gravity is not None:
        world.set_gravity(case.gravity)
    states = random_states(world, case, seed)
    for skel, (q, dq) in zip(world.skeletons, states, strict=True):
        skel.q, skel.dq = q, dq
    theirs = oracle.simulate(
        files, dt=0.001, gravity=case.gravity, skeleton_states=states, steps=REPORT[-1], report_at=REPORT
    )
    assert_same_frame(world, theirs[0])
    world.step()
    assert_same_frame(world, theirs[1])
    world.step(REPORT[-1] - 1)
    assert_same_frame(world, theirs[REPORT[-1]])
    contacts = world.collision_result.contacts
    assert len(contacts) > 5
    assert sum(np.linalg.norm(contact.force) > 1.0 for contact in contacts) >= 2


@pytest.mark.parametrize("detector", ["dart", "fcl", "bullet", "ode"])
def test_each_detector(oracle: DartpyOracle, detector: str) -> None:
    file = dart_model("skel/fullbody1.skel")
    world = pydart2.World(0.001, file)
    world.set_collision_detector(("dart", "fcl", "bullet", "ode").index(detector))
    theirs = oracle.simulate(file, dt=0.001, detector=detector, steps=1000, report_at=REPORT)
    for step in REPORT:
        world.step(step - world.frame)
        assert_same_frame(world, theirs[step])
    assert len(world.collision_result.contacts) > 2


def test_forces(oracle: DartpyOracle) -> None:
    """Constant generalized forces, set anew before each step."""
    file = dart_model("skel/fullbody1.skel")
    world = pydart2.World(0.001, file)
    tau = np.linspace(-2.0, 2.0, world.skeletons[1].ndofs)
    theirs = oracle.simulate(file, dt=0.001, forces=[None, tau], steps=200)
    for _ in range(200):
        world.skeletons[1].set_forces(tau)
        world.step()
    assert_same_frame(world, theirs[200])
