"""What forks of the original added."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

import pydart2
from pydart2 import BodyNode, Skeleton, World
from pydart2.collision_filter import CollisionFilter

from .table import row, rows

OFFSET = [0.1, -0.2, 0.3]


@pytest.fixture
def body(zoo: Skeleton) -> BodyNode:
    """A body in motion that has been accelerated, with its accelerations those of the present state."""
    zoo.set_accelerations(np.cos(3.0 * np.arange(zoo.ndofs)))
    return zoo.bodynodes[6]


# Worlds


@row(
    "world.World.create_collision_filter",
    "world.World.collision_filter",
    "collision_filter.CollisionFilter",
    "collision_filter.CollisionFilter.add_to_black_list",
    "collision_filter.CollisionFilter.remove_from_black_list",
    "collision_filter.CollisionFilter.remove_all_from_black_list",
)
def test_collision_filter(cubes: World) -> None:
    ground, box, cube = (skel.bodynodes[0] for skel in cubes.skeletons[:3])
    collision_filter = cubes.create_collision_filter()
    assert isinstance(collision_filter, CollisionFilter) and cubes.collision_filter is collision_filter

    def touching() -> set[frozenset[BodyNode | None]]:
        cubes.check_collision()
        return {frozenset(pair) for pair in cubes.collision_result.contact_sets}

    pairs = [frozenset({ground, box}), frozenset({box, cube})]
    assert touching() >= set(pairs)
    collision_filter.add_to_black_list(ground, box)
    assert pairs[0] not in touching() and pairs[1] in touching()
    collision_filter.add_to_black_list(cube, box)
    assert not touching() & set(pairs)
    collision_filter.remove_from_black_list(box, ground)
    assert pairs[0] in touching() and pairs[1] not in touching()
    collision_filter.remove_all_from_black_list()
    assert touching() >= set(pairs)


@row("world.World(step, skel_path, xmlstr=False)")
def test_world_from_text(cubes: World) -> None:
    text = Path(pydart2.data_path("skel/cubes.skel")).read_text(encoding="utf-8")
    world = World(0.002, text, xmlstr=True)
    assert (world.dt, world.num_skeletons()) == (0.002, 4)
    assert_allclose(world.x, cubes.x)


@row("world.World.set_time", "world.World.t=")
def test_set_time(cubes: World) -> None:
    cubes.set_time(1.5)
    assert cubes.t == 1.5
    cubes.t = 2.5
    cubes.step()
    assert cubes.time() == pytest.approx(2.501)


# Bodies


@row("bodynode.BodyNode.linear_momentum", "bodynode.BodyNode.angular_momentum")
def test_momentum(body: BodyNode) -> None:
    rotation = body.T[:3, :3]
    linear = body.m * body.dC
    omega = body.angular_jacobian() @ body.skel.dq
    angular = rotation @ body.I @ rotation.T @ omega + np.cross(body.C - body.to_world(), linear)
    assert_allclose(rotation @ body.linear_momentum(), linear, atol=1e-12)  # they are in body coordinates
    assert_allclose(rotation @ body.angular_momentum(), angular, atol=1e-12)


@rows("bodynode.BodyNode.", {f"world_{kind}_velocity": kind for kind in ("linear", "angular", "spatial")})
def test_velocity(body: BodyNode, case: str) -> None:
    expected = body.world_jacobian(OFFSET) @ body.skel.dq
    part = {"linear": slice(3, 6), "angular": slice(3), "spatial": slice(6)}[case]
    velocity: Any = getattr(body, f"world_{case}_velocity")
    assert_allclose(velocity(OFFSET) if case != "angular" else velocity(), expected[part], atol=1e-12)
    if case != "angular":
        assert_allclose(velocity(), velocity([0, 0, 0]))


@rows("bodynode.BodyNode.", {f"world_{kind}_acceleration": kind for kind in ("linear", "angular", "spatial")})
def test_acceleration(body: BodyNode, case: str) -> None:
    skel = body.skel
    angular = body.angular_jacobian() @ skel.ddq + body.angular_jacobian_deriv() @ skel.dq
    linear = body.linear_jacobian(OFFSET) @ skel.ddq + body.linear_jacobian_deriv(OFFSET) @ skel.dq
    spatial = linear - np.cross(body.world_angular_velocity(), body.world_linear_velocity(OFFSET))
    if case == "angular":
        assert_allclose(body.world_angular_acceleration(), angular, atol=1e-12)
    elif case == "linear":
        assert_allclose(body.world_linear_acceleration(OFFSET), linear, atol=1e-12)
    else:
        assert_allclose(body.world_spatial_acceleration(OFFSET), np.concatenate([angular, spatial]), atol=1e-12)


@row("bodynode.BodyNode.world_jacobian_classic_deriv")
def test_classic_deriv(body: BodyNode) -> None:
    expected = np.concatenate([body.angular_jacobian_deriv(), body.linear_jacobian_deriv(OFFSET)])
    assert_allclose(body.world_jacobian_classic_deriv(OFFSET), expected, atol=1e-12)
    assert body.world_jacobian_classic_deriv(OFFSET, full=False).shape == (6, 13)


@rows("bodynode.BodyNode.", {f"{how}_ext_force_with_arrow": how for how in ("add", "set")})
def test_force_with_arrow(cubes: World, case: str) -> None:
    cube = cubes.skeletons[3]
    for _ in range(2):
        getattr(cube.bodynodes[0], f"{case}_ext_force_with_arrow")([0.5, 0, 0], [0, 0.01, 0])
    arrows = cube.bodynodes[0].force_arrows
    assert len(arrows) == (2 if case == "add" else 1)
    assert_allclose(arrows[0][0], cube.bodynodes[0].to_world([0, 0.01, 0]))
    assert_allclose(arrows[0][1], [0.5, 0, 0])
    cubes.step()
    assert len(cube.bodynodes[0].force_arrows) == len(arrows)  # to be seen with what they did
    assert cube.dq[3] == pytest.approx(len(arrows) * 0.0005 / cube.m, rel=1e-3)
    cubes.step()
    assert cube.bodynodes[0].force_arrows == []


# Joints


@row("joint.Joint.get_local_transform")
def test_local_transform(body: BodyNode) -> None:
    assert body.parent_bodynode is not None
    expected = np.linalg.inv(body.parent_bodynode.T) @ body.T
    assert_allclose(body.parent_joint.get_local_transform(), expected, atol=1e-12)


@row("joint.Joint.get_world_frame_before_transform")
def test_frame_before(body: BodyNode) -> None:
    joint = body.parent_joint
    assert body.parent_bodynode is not None
    expected = body.parent_bodynode.T @ joint.transform_from_parent_body_node()
    assert_allclose(joint.get_world_frame_before_transform(), expected, atol=1e-12)


@row("joint.Joint.get_world_frame_after_transform", "joint.Joint.orientation_in_world_frame")
def test_frame_after(body: BodyNode) -> None:
    joint = body.parent_joint
    expected = body.T @ joint.transform_from_child_body_node()
    assert_allclose(joint.get_world_frame_after_transform(), expected, atol=1e-12)
    assert_allclose(joint.orientation_in_world_frame(), expected[:3, :3], atol=1e-12)


STATES = {"position": "q", "velocity": "dq", "acceleration": "ddq"}


@rows(
    "joint.",
    {
        f"{kind}Joint.{how}{state}": (kind, state)
        for kind in ("Ball", "Free")
        for state in STATES
        for how in ("", "set_")
    },
)
def test_state_of_joint(zoo: Skeleton, case: tuple[str, str]) -> None:
    kind, state = case
    joint: Any = zoo.joint(f"{kind.lower()} joint")
    ids = [dof.id for dof in joint.dofs]
    values = 0.1 * np.arange(1, len(ids) + 1)
    assert_allclose(getattr(joint, state)(), getattr(zoo, STATES[state])[ids])
    getattr(joint, f"set_{state}")(values)
    assert_allclose(getattr(joint, state)(), values)
    assert_allclose(getattr(zoo, STATES[state])[ids], values)


# Skeletons


@row("skeleton.Skeleton.set_accelerations")
def test_set_accelerations(zoo: Skeleton) -> None:
    zoo.set_accelerations(np.arange(zoo.ndofs))
    assert_allclose(zoo.ddq, np.arange(zoo.ndofs))


@row("skeleton.Skeleton.inv_mass_matrix", "skeleton.Skeleton.invM")
def test_inverse_mass_matrix(zoo: Skeleton) -> None:
    assert_allclose(zoo.inv_mass_matrix() @ zoo.M, np.eye(zoo.ndofs), atol=1e-9)
    assert_allclose(zoo.invM, zoo.inv_mass_matrix())


@row("skeleton.Skeleton.com_spatial_velocity")
def test_com_spatial_velocity(cubes: World, zoo: Skeleton) -> None:
    assert zoo.com_spatial_velocity().shape == (6,)
    assert_allclose(zoo.com_spatial_velocity()[3:], zoo.dC, atol=1e-12)
    cube = cubes.skeletons[3]
    cube.q, cube.dq = np.full(6, 0.3), np.arange(6.0)
    assert_allclose(cube.com_spatial_velocity()[:3], cube.bodynodes[0].angular_jacobian() @ cube.dq)


def fixed(atlas: Skeleton) -> tuple[Skeleton, float, np.ndarray, np.ndarray]:
    """Atlas welded to the world, in motion; a time step and gains."""
    atlas.set_root_joint_to_weld()
    n = atlas.ndofs
    atlas.q, atlas.dq = 0.1 * np.sin(np.arange(n)), np.cos(np.arange(n))
    return atlas, 0.002, np.linspace(100, 400, n), np.linspace(10, 20, n)


@row("skeleton.Skeleton.get_spd", "skeleton.Skeleton.get_spd_forces", "skeleton.Skeleton.get_spd_extended")
def test_spd(atlas: Skeleton) -> None:
    skel, h, kp, kd = fixed(atlas)
    target, speed, push = np.full(skel.ndofs, 0.2), np.full(skel.ndofs, 0.3), np.full(skel.ndofs, 0.4)
    still = np.zeros(skel.ndofs)
    for tau, dq_des, ddq_des in (
        (skel.get_spd(target, h, kp, kd), still, still),
        (skel.get_spd_forces(target, h, kp, kd), still, still),
        (skel.get_spd_extended(target, speed, push, h, kp, kd), speed, push),
    ):
        # A PD controller on the state after the step, whose acceleration is the one that these forces give.
        ddq = np.linalg.solve(skel.M, tau - skel.c)
        next_q, next_dq = skel.q + h * skel.dq, skel.dq + h * ddq
        assert_allclose(tau, -kp * (next_q - target) - kd * (next_dq - dq_des - h * ddq_des), rtol=1e-6, atol=1e-6)


@row("skeleton.Skeleton.clear_impulse")
def test_clear_impulse(zoo: Skeleton) -> None:
    for dof in zoo.dofs:
        dof.set_constraint_impulse(1.0)
    zoo.clear_impulse()
    assert_allclose([dof.constraint_impulse() for dof in zoo.dofs], 0)


@row("skeleton.Skeleton.update_fk")
def test_update_fk(cubes: World) -> None:
    cube = cubes.skeletons[3]
    before = cube.bodynodes[0].to_world()
    cube.dofs[3].set_position(cube.dofs[3].position() + 0.5)
    cube.update_fk()
    assert_allclose(cube.bodynodes[0].to_world() - before, [0.5, 0, 0], atol=1e-12)


@row("skeleton.Skeleton.commands", "skeleton.Skeleton.comms", "skeleton.Skeleton.set_commands")
def test_commands(cubes: World) -> None:
    cube = cubes.skeletons[3]
    cube.joints[0].set_actuator_type(pydart2.Joint.VELOCITY)
    cube.set_commands([0, 0, 0, 0.5, 0, 0])
    assert_allclose(cube.commands(), [0, 0, 0, 0.5, 0, 0])
    assert_allclose(cube.comms, cube.commands())
    cubes.step()
    assert_allclose(cube.dq, [0, 0, 0, 0.5, 0, 0], atol=1e-9)


# Contacts


@row("contact.Contact.shape_id1", "contact.Contact.shape_id2")
def test_shape_ids(touching: World) -> None:
    for contact in touching.collision_result.contacts:
        for body, i in ((contact.bodynode1, contact.shape_id1), (contact.bodynode2, contact.shape_id2)):
            assert body is not None and body.shapenodes[i].has_collision_aspect()


@row("collision_result.CollisionResult.clear")
def test_clear_result(touching: World) -> None:
    touching.collision_result.clear()
    assert touching.collision_result.num_contacts() == 0
    assert touching.collision_result.contacts == touching.collision_result.contacted_bodies == []


@row("collision_result.CollisionResult.contact_sets")
def test_contact_sets(touching: World) -> None:
    result = touching.collision_result
    pairs = {(contact.bodynode1, contact.bodynode2) for contact in result.contacts}
    assert len(pairs) == len(result.contact_sets) == 2
    assert set(result.contact_sets) == pairs
