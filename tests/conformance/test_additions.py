"""Names that the original had not: writing by name, forces and commands of single dofs, soft bodies."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

import pydart2
from oracle.models import dart_model
from pydart2 import Joint, Skeleton, SoftBodyNode, World

GETTERS = {
    "set_q": "q",
    "set_positions": "q",
    "set_dq": "dq",
    "set_velocities": "dq",
    "set_tau": "tau",
    "set_forces": "tau",
    "set_commands": "comms",
}


@pytest.mark.parametrize("setter", GETTERS)
def test_writing_by_name(atlas: Skeleton, setter: str) -> None:
    write: Any = getattr(atlas, setter)
    write(np.full(33, 0.125))
    write({"back_bkz": 0.5}, l_arm_ely=0.25)
    expected = np.full(33, 0.0 if GETTERS[setter] == "tau" else 0.125)  # forces that are not named are zero
    expected[[6, 11]] = 0.5, 0.25
    assert_allclose(getattr(atlas, GETTERS[setter]), expected)
    for wrong in ({"back_bkzz": 0.5}, {"nothing": 0.5}):
        with pytest.raises(pydart2.NameNotFound, match=next(iter(wrong))):
            write(wrong)
        with pytest.raises(pydart2.NameNotFound):
            write(**wrong)
    assert_allclose(getattr(atlas, GETTERS[setter]), expected)


def test_force_of_a_dof(cubes: World) -> None:
    cube = cubes.skeletons[3]
    cube.dofs[3].set_force(2.0)
    assert cube.dofs[3].force() == 2.0
    cubes.step()
    assert cube.dofs[3].velocity() == pytest.approx(0.001 * 2.0 / cube.m)
    assert cube.dofs[3].acceleration() == pytest.approx(2.0 / cube.m)
    assert cube.dofs[3].force() == 0.0


def test_acceleration_of_a_dof(zoo: Skeleton) -> None:
    zoo.dofs[8].set_acceleration(0.125)
    assert zoo.dofs[8].acceleration() == zoo.ddq[8] == 0.125


@pytest.mark.parametrize("by", ["dof", "joint"])
@pytest.mark.parametrize(("kind", "speed"), [(Joint.VELOCITY, 0.5), (Joint.SERVO, 0.5), (Joint.ACCELERATION, 0.0005)])
def test_commands_drive_a_joint(cubes: World, by: str, kind: int, speed: float) -> None:
    cube = cubes.skeletons[3]
    joint = cube.joints[0]
    joint.set_actuator_type(kind)
    if by == "dof":
        cube.dofs[3].set_command(0.5)
    else:
        joint.set_command(3, 0.5)
    assert cube.dofs[3].command() == joint.command(3) == cube.comms[3] == 0.5
    cubes.step()
    assert cube.dq[3] == pytest.approx(speed, abs=1e-9)


@pytest.fixture
def soft() -> SoftBodyNode:
    """The first soft body of a world of soft cubes."""
    world = World(0.001, dart_model("skel/soft_cubes.skel"))
    bodies = [body for skel in world.skeletons for body in skel.bodynodes]
    return next(body for body in bodies if isinstance(body, SoftBodyNode))


def test_points_of_a_soft_body(soft: SoftBodyNode) -> None:
    n = soft.num_points()
    assert soft.point_masses().shape == (n,) and (soft.point_masses() > 0).all()
    moved = np.linspace(0, 0.01, 3 * n).reshape(n, 3)
    soft.set_point_displacements(moved)
    soft.set_point_velocities(10 * moved)
    assert_allclose(soft.point_displacements(), moved)
    assert_allclose(soft.point_velocities(), 10 * moved)
    assert_allclose(soft.point_local_positions(), soft.point_rest_positions() + moved, atol=1e-12)
    homogeneous = np.column_stack([soft.point_local_positions(), np.ones(n)])
    assert_allclose(soft.point_world_positions(), (homogeneous @ soft.T.T)[:, :3], atol=1e-12)


def test_skin_of_a_soft_body_is_closed(soft: SoftBodyNode) -> None:
    faces = soft.faces()
    assert faces.shape[1] == 3 and set(faces.ravel()) == set(range(soft.num_points()))
    edges = np.sort(np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)
    assert set(np.unique(edges, axis=0, return_counts=True)[1]) == {2}  # each edge belongs to two triangles


def test_springs_of_a_soft_body(soft: SoftBodyNode) -> None:
    for name in ("vertex_stiffness", "edge_stiffness", "damping_coefficient"):
        getattr(soft, f"set_{name}")(12.5)
        assert getattr(soft, name)() == 12.5
        with pytest.raises(ValueError):
            getattr(soft, f"set_{name}")(-1.0)
