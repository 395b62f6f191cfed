"""Numbers of a pickle that are no longer what was saved: taken, or refused with a sentence; no process ends."""

from __future__ import annotations

import random
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import pydart2

WRONG = (float("nan"), float("inf"), -float("inf"), -1.0, 0.0, 0.5, 2.0**31, -(2.0**63), 1e300, 7.0)
SCENES = ("chain", "cubes", "shapes", "softBodies", "constrained", "motors")


def scene(name: str) -> pydart2.World:
    """Each with parts of its own in what is saved."""
    world = pydart2.World(0.001, f"skel/{name if name in SCENES[:4] else 'cubes'}.skel")
    world.disable_recording()
    if name == "constrained":
        bodies = [skel.bodynodes[0] for skel in world.skeletons]
        pydart2.constraints.BallJointConstraint(bodies[1], bodies[2], [0.0, 0.0, 0.0]).add_to_world(world)
        pydart2.constraints.WeldJointConstraint(bodies[2], bodies[3]).add_to_world(world)
        world.collision_filter.add_to_black_list(bodies[1], bodies[2])
        world.set_constraint_solver("iterative")
        world.max_contacts = 100
        world.set_blow_up("nan")
    if name == "motors":
        robot = world.add_skeleton(
            """<robot name="r"><link name="a"/><link name="b"><inertial><mass value="1"/>
            <inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
            <link name="c"><inertial><mass value="1"/>
            <inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
            <joint name="j" type="revolute"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/>
            <limit lower="-1" upper="1" effort="10" velocity="10"/></joint>
            <joint name="k" type="revolute"><parent link="b"/><child link="c"/><axis xyz="0 0 1"/>
            <limit lower="-1" upper="1" effort="10" velocity="10"/><mimic joint="j"/></joint></robot>"""
        )
        robot.dof("j").set_armature(0.1)
        robot.set_targets({"j": 0.5}, kp=10.0, kd=1.0)
    return world


def attack(name: str, seed: int, tries: int) -> None:
    """Wrong numbers in random places; all that may come of it are the documented exceptions."""
    draw = random.Random(seed)
    make, arguments, *_ = scene(name).__reduce__()  # type: ignore[misc]
    kind, (plan, texts, numbers, state), *rest = arguments  # type: ignore[misc]
    taken = 0
    for _ in range(tries):
        damaged = [np.array(numbers), np.array(state)]
        values = damaged[draw.random() < 0.3]
        for _ in range(draw.choice((1, 1, 1, 5))):
            values[draw.randrange(len(values))] = draw.choice(WRONG)
        try:
            world = make(kind, (plan, texts, *damaged), *rest)  # type: ignore[operator]
            world.step(2)
            world.check_collision()
            taken += 1
        except (ValueError, MemoryError, pydart2.PydartError):
            pass
    print(taken)


@pytest.mark.parametrize("name", SCENES)
def test_damaged_numbers(name: str) -> None:
    code = (
        f"import logging; logging.disable(50); from unit import test_damaged_pickles as t; t.attack({name!r}, 0, 150)"
    )
    done = subprocess.run(
        [sys.executable, "-W", "ignore", "-c", code],
        cwd=Path(__file__).parents[1],
        capture_output=True,
        text=True,
        timeout=120,
    )
    assert done.returncode == 0, done.stderr[-2000:]
    assert 0 < int(done.stdout) < 150, "some are taken, some are refused"
