"""What the engine's own solver would end the process for: it steps, or says that it cannot."""

from __future__ import annotations

import random
from pathlib import Path

import numpy as np
import pytest

import pydart2

INERTIA = '<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>'


def two_mimic_joints(path: Path) -> Path:
    """Both errors are exactly 0 at rest: constraints without a row."""
    links = '<link name="base"/>'
    for i in range(3):
        mimic = '<mimic joint="j0"/>' * (i > 0)
        links += f"""<link name="l{i}">{INERTIA}</link>
            <joint name="j{i}" type="revolute"><parent link="base"/><child link="l{i}"/><axis xyz="0 0 1"/>
            <limit lower="-1" upper="1" effort="10000" velocity="10"/>{mimic}</joint>"""
    path.write_text(f'<robot name="mimics">{links}</robot>')
    return path


@pytest.mark.parametrize("solver", ["dart", "fast", "iterative"])
def test_mimic_joints_without_an_error(tmp_path: Path, solver: str) -> None:
    world = pydart2.World(0.001)
    world.set_constraint_solver(solver)
    world.set_gravity([0.0, 0.0, 0.0])
    robot = world.add_skeleton(str(two_mimic_joints(tmp_path / "mimics.urdf")))
    robot.joint("rootJoint").set_actuator_type(pydart2.Joint.LOCKED)
    world.step(5)
    assert not robot.q.any()
    robot.dof("j0").set_velocity(1.0)
    world.step(100)
    np.testing.assert_allclose(robot.q["j1"], robot.q["j0"], atol=2e-3)
    assert robot.q["j0"] > 0.02


def test_a_matrix_that_is_not_symmetric_is_refused() -> None:
    """Ill-conditioned scenes of accepted values: each call works or raises, whatever was refused before."""
    refused = 0
    for seed in range(12):
        draw = random.Random(seed)
        world = pydart2.World(1e-3, "skel/cubes.skel")
        world.set_constraint_solver("dart")
        bodies = [skeleton.bodynodes[0] for skeleton in world.skeletons]
        for body in bodies[1:]:
            body.set_mass(10.0 ** draw.uniform(-9, 6))
        pydart2.constraints.BallJointConstraint(bodies[1], bodies[2], [10.0 ** draw.uniform(3, 7)] * 3).add_to_world(
            world
        )
        for _ in range(8):
            try:
                world.step(2)
                world.check_collision()
            except pydart2.SimulationError as error:
                refused += "not symmetric" in str(error)
    assert refused > 0, "some of these scenes have such a matrix"
