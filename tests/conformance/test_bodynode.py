"""Bodies."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.spatial.transform import Rotation

from oracle.dartpy_oracle import Simulation
from pydart2 import BodyNode, Skeleton, World

from .table import row, rows

OFFSET = [0.1, -0.2, 0.3]


def moved(body: BodyNode, value: Callable[[], Any]) -> Any:
    """The time derivative of `value` along the present velocity, by central differences."""
    skel, step = body.skeleton, 1e-6
    q, dq = skel.q, skel.dq
    values = []
    for sign in (1, -1):
        skel.q = _moved_positions(skel, q, sign * step * dq)
        skel.dq = dq
        values.append(value())
    skel.q, skel.dq = q, dq
    return (values[0] - values[1]) / (2 * step)


def _moved_positions(skel: Skeleton, q: Any, difference: Any) -> Any:
    """q moved by a small difference in body velocities, on the configuration manifold."""
    moved = np.array(q) + difference
    for joint in skel.joints:
        if joint.type() in ("BallJoint", "FreeJoint"):
            ids = [dof.id for dof in joint.dofs]
            turned = Rotation.from_rotvec(np.array(q)[ids[:3]]) * Rotation.from_rotvec(difference[ids[:3]])
            moved[ids[:3]] = turned.as_rotvec()
            if joint.type() == "FreeJoint":
                rotation = Rotation.from_rotvec(np.array(q)[ids[:3]]).as_matrix()
                moved[ids[3:]] = np.array(q)[ids[3:]] + rotation @ difference[ids[3:]]
    return moved


@pytest.fixture
def body(zoo: Skeleton) -> BodyNode:
    """The third last body of the zoo, which has dofs before and behind it."""
    return zoo.bodynodes[6]


@row("bodynode.BodyNode", "bodynode.BodyNode.build")
def test_constructor(zoo: Skeleton) -> None:
    body = BodyNode(zoo, 6)
    body.build()
    old = zoo.bodynodes[6]
    assert (body.name, body.id, body.mass()) == (old.name, old.id, old.mass())
    assert body.dependent_dofs == old.dependent_dofs and body.parent_joint is old.parent_joint


@rows(
    "bodynode.BodyNode.",
    {
        "skeleton": lambda body: body.skeleton is body.skel is body.dependent_dofs[0].skeleton,
        "skel": lambda body: body.skel.bodynodes[6] is body,
        "name": lambda body: body.name == "body 6",
        "parent_bodynode": lambda body: (
            body.parent_bodynode is body.skel.bodynodes[5] and body.skel.bodynodes[0].parent_bodynode is None
        ),
        "child_bodynodes": lambda body: body.child_bodynodes == [body.skel.bodynodes[7]],
        "parent_joint": lambda body: body.parent_joint is body.skel.joint("euler joint"),
        "child_joints": lambda body: body.child_joints == [body.skel.joint("translational joint")],
        "dependent_dofs": lambda body: body.dependent_dofs == body.skel.dofs[:13],
        "markers": lambda body: body.markers == [body.skel.markers[6]],
        "shapenodes": lambda body: [node.shape.type() for node in body.shapenodes] == ["PlaneShape"],
        "id": lambda body: body.id == 6,
        "wid": lambda body: body.wid == body.skel.world.id,
        "skid": lambda body: body.skid == body.skel.id,
    },
)
def test_attribute(body: BodyNode, case: Callable[[BodyNode], bool]) -> None:
    assert case(body)


COUNTS = {
    "num_child_bodynodes": 1,
    "num_dependent_dofs": 13,
    "num_child_joints": 1,
    "num_markers": 1,
    "num_shapenodes": 1,
    "index_in_skeleton": 6,
    "index_in_tree": 6,
    "tree_index": 0,
}


@rows("bodynode.BodyNode.", {name: (name, count) for name, count in COUNTS.items()})
def test_count(body: BodyNode, case: tuple[str, int]) -> None:
    name, count = case
    assert getattr(body, name)() == count


@row("bodynode.BodyNode.gravity_mode", "bodynode.BodyNode.set_gravity_mode")
def test_gravity_mode(cubes: World) -> None:
    body = cubes.skeletons[3].bodynodes[0]
    assert body.gravity_mode() is True
    body.set_gravity_mode(False)
    cubes.step()
    assert body.gravity_mode() is False
    assert_allclose(body.dC, 0, atol=1e-12)


@row("bodynode.BodyNode.is_collidable", "bodynode.BodyNode.set_collidable")
def test_collidable(cubes: World) -> None:
    body = cubes.skeletons[2].bodynodes[0]
    assert body.is_collidable() is True
    body.set_collidable(False)
    cubes.step(5)
    assert body.is_collidable() is False
    assert body not in cubes.collision_result.contacted_bodies
    assert body.dC[1] == pytest.approx(-9.81 * 0.005)


@row("bodynode.BodyNode.mass", "bodynode.BodyNode.m", "bodynode.BodyNode.set_mass")
def test_mass(body: BodyNode) -> None:
    assert body.mass() == body.m == 7.0
    inertia = body.inertia()
    body.set_mass(2)
    assert (body.m, body.skel.m) == (2.0, 40.0)
    assert_allclose(body.inertia(), inertia)
    with pytest.raises(ValueError):
        body.set_mass(-1.0)


@row("bodynode.BodyNode.inertia", "bodynode.BodyNode.I", "bodynode.BodyNode.set_inertia")
def test_inertia(body: BodyNode) -> None:
    inertia = [[3.0, 0.1, 0.2], [0.1, 4.0, 0.3], [0.2, 0.3, 5.0]]
    body.set_inertia(inertia)
    assert_allclose(body.inertia(), inertia)
    assert_allclose(body.I, inertia)


@row("bodynode.BodyNode.set_inertia_entries")
def test_inertia_entries(body: BodyNode) -> None:
    body.set_inertia_entries(3, 4, 5, Ixz=0.2)
    assert_allclose(body.I, [[3, 0, 0.2], [0, 4, 0], [0.2, 0, 5]])


@row("bodynode.BodyNode.local_com", "bodynode.BodyNode.set_local_com")
def test_local_com(body: BodyNode) -> None:
    assert_allclose(body.local_com(), [0, 0.1, 0])
    body.set_local_com(OFFSET)
    assert_allclose(body.local_com(), OFFSET)
    assert_allclose(body.com(), body.to_world(OFFSET))


@row("bodynode.BodyNode.com", "bodynode.BodyNode.C")
def test_com(body: BodyNode) -> None:
    expected = (body.T @ [0, 0.1, 0, 1])[:3]
    assert_allclose(body.com(), expected)
    assert_allclose(body.C, expected)


@row("bodynode.BodyNode.com_linear_velocity", "bodynode.BodyNode.dC")
def test_com_velocity(body: BodyNode) -> None:
    expected = moved(body, body.com)
    assert_allclose(body.com_linear_velocity(), expected, rtol=1e-6, atol=1e-7)
    assert_allclose(body.dC, expected, rtol=1e-6, atol=1e-7)


@row("bodynode.BodyNode.com_linear_acceleration")
def test_com_acceleration(body: BodyNode) -> None:
    skel = body.skel
    skel.world.step()  # the accelerations belong to the state before it
    assert_allclose(body.com_linear_acceleration(), _acceleration(body), rtol=1e-6, atol=1e-7)


def _acceleration(body: BodyNode) -> np.ndarray:
    """J ddq + dJ dq of the centre of mass."""
    com, skel = body.local_com(), body.skel
    return np.asarray(body.linear_jacobian(com) @ skel.ddq + body.linear_jacobian_deriv(com) @ skel.dq)


@row("bodynode.BodyNode.com_spatial_velocity")
def test_spatial_velocity(body: BodyNode) -> None:
    back = body.T[:3, :3].T
    expected = np.concatenate([back @ body.angular_jacobian() @ body.skel.dq, back @ body.dC])
    assert_allclose(body.com_spatial_velocity(), expected, atol=1e-12)


@row("bodynode.BodyNode.com_spatial_acceleration")
def test_spatial_acceleration(body: BodyNode) -> None:
    # The time derivative of the spatial velocity in body coordinates: without the velocity product of the classic one.
    skel = body.skel
    skel.world.step()
    back, v = body.T[:3, :3].T, body.com_spatial_velocity()
    angular = back @ (body.angular_jacobian() @ skel.ddq + body.angular_jacobian_deriv() @ skel.dq)
    linear = back @ _acceleration(body) - np.cross(v[:3], v[3:])
    assert_allclose(body.com_spatial_acceleration(), np.concatenate([angular, linear]), rtol=1e-6, atol=1e-9)


@row("bodynode.BodyNode.friction_coeff", "bodynode.BodyNode.set_friction_coeff")
def test_friction(cubes: World) -> None:
    def slide(friction: float) -> float:
        cubes.reset()
        box = cubes.skeletons[1]
        box.bodynodes[0].set_friction_coeff(friction)
        assert box.bodynodes[0].friction_coeff() == friction
        box.dq = [0, 0, 0, 0.3, 0, 0]
        cubes.step(20)
        return float(box.dq[3])

    assert cubes.skeletons[1].bodynodes[0].friction_coeff() == 1.0
    assert slide(0.0) > slide(1.0) + 0.1


@row("bodynode.BodyNode.restitution_coeff", "bodynode.BodyNode.set_restitution_coeff")
def test_restitution(cubes: World) -> None:
    body = cubes.skeletons[3].bodynodes[0]
    assert body.restitution_coeff() == 0.0
    body.set_restitution_coeff(0.5)
    assert body.restitution_coeff() == 0.5
    with pytest.raises(ValueError):
        body.set_restitution_coeff(-1)


@rows("bodynode.BodyNode.", {name: name for name in ("transform", "T", "world_transform")})
def test_transform(robot: Skeleton, told: Simulation, case: str) -> None:
    for body, expected in zip(robot.bodynodes, told[0].skeletons[1]["T"], strict=True):
        value: Any = getattr(body, case)
        assert_allclose(value() if callable(value) else value, expected, atol=1e-9)


@row("bodynode.BodyNode.relative_transform")
def test_relative_transform(body: BodyNode) -> None:
    assert body.parent_bodynode is not None
    assert_allclose(body.parent_bodynode.T @ body.relative_transform(), body.T, atol=1e-12)
    root = body.skel.bodynodes[0]
    assert_allclose(root.relative_transform(), root.T)


@row("bodynode.BodyNode.to_world", "bodynode.BodyNode.to_local")
def test_points(body: BodyNode) -> None:
    expected = (body.T @ [*OFFSET, 1])[:3]
    assert_allclose(body.to_world(OFFSET), expected)
    assert_allclose(body.to_world(), body.T[:3, 3])
    assert_allclose(body.to_local(expected), OFFSET, atol=1e-12)


QUARTER = [0, 0, np.pi / 2, 0, 1, 0]  # a quarter turn about z, away from the floor


def pushed(cubes: World, method: str, *args: Any) -> tuple[np.ndarray, np.ndarray]:
    """Force and torque about the body's origin, in the world, that a call has on a turned cube without gravity.

    Before a call that sets, another force is there, (9, 9, 9).
    """
    cubes.reset()
    cubes.g = [0, 0, 0]
    cube = cubes.skeletons[3]
    cube.q = np.array(QUARTER)
    body = cube.bodynodes[0]
    if method.startswith("set"):
        body.add_ext_force([9.0, 9.0, 9.0])
    getattr(body, method)(*args)
    cubes.step()
    v = body.com_spatial_velocity() / 0.001
    force = body.m * body.T[:3, :3] @ v[3:]
    torque = body.T[:3, :3] @ body.I @ v[:3]
    cubes.step()  # the call was for one step
    assert_allclose(body.m * body.dC / 0.001, force, atol=1e-5)
    return force, torque


@rows("bodynode.BodyNode.", {name: name for name in ("add_ext_force", "set_ext_force")})
def test_ext_force(cubes: World, case: str) -> None:
    cubes.skeletons[3].q = np.array(QUARTER)
    above = np.add(cubes.skeletons[3].bodynodes[0].to_world(), [0, 0.01, 0])
    for args, force, torque in (
        (([2.0, 0, 0],), [2, 0, 0], [0, 0, 0]),
        (([2.0, 0, 0], None, True), [0, 2, 0], [0, 0, 0]),
        (([2.0, 0, 0], [0.01, 0, 0]), [2, 0, 0], [0, 0, -0.02]),
        (([2.0, 0, 0], above, False, False), [2, 0, 0], [0, 0, -0.02]),
        (([2.0, 0, 0], [0, 0.01, 0], True, True), [0, 2, 0], [0, 0, -0.02]),
    ):
        got_force, got_torque = pushed(cubes, case, *args)
        assert_allclose(got_force, force, atol=1e-6)
        assert_allclose(got_torque, torque, atol=1e-6)


@rows("bodynode.BodyNode.", {name: name for name in ("add_ext_torque", "set_ext_torque")})
def test_ext_torque(cubes: World, case: str) -> None:
    others = [9, 9, 9] if case.startswith("set") else [0, 0, 0]  # set_ext_torque leaves the force
    for args, torque in ((([1e-3, 0, 0],), [1e-3, 0, 0]), (([1e-3, 0, 0], True), [0, 1e-3, 0])):
        got_force, got_torque = pushed(cubes, case, *args)
        assert_allclose(got_force, others, atol=1e-4)
        assert_allclose(got_torque, torque, atol=1e-6)


@rows(
    "bodynode.BodyNode.",
    {name: (name, n) for name, n in (("jacobian", 6), ("world_jacobian", 6), ("linear_jacobian", 3))},
)
def test_jacobian(body: BodyNode, case: tuple[str, int]) -> None:
    name, size = case
    point = moved(body, lambda: body.to_world(OFFSET))
    angular = body.angular_jacobian() @ body.skel.dq
    turn = body.T[:3, :3].T if name == "jacobian" else np.eye(3)
    expected = np.concatenate([turn @ angular, turn @ point])[-size:]
    full, dependent = getattr(body, name)(OFFSET), getattr(body, name)(OFFSET, full=False)
    assert (full.shape, dependent.shape) == ((size, body.skel.ndofs), (size, 13))
    assert_allclose(full @ body.skel.dq, expected, rtol=1e-6, atol=1e-7)
    assert_allclose(full, body.expand_jacobian(dependent))
    assert_allclose(getattr(body, name)(), getattr(body, name)([0, 0, 0]))
    weld = body.skel.bodynodes[0]
    assert_allclose(getattr(weld, name)(), np.zeros((size, body.skel.ndofs)))


@row("bodynode.BodyNode.J", "bodynode.BodyNode.angular_jacobian")
def test_jacobians_of_the_oracle(robot: Skeleton, told: Simulation) -> None:
    for i, body in enumerate(robot.bodynodes):
        assert_allclose(body.J, told[0].skeletons[1]["J"][i], atol=1e-9)
        assert_allclose(body.angular_jacobian(), told[0].skeletons[1]["Jang"][i], atol=1e-9)
        assert body.angular_jacobian(full=False).shape == (3, len(body.dependent_dofs))


@row(
    "bodynode.BodyNode.linear_jacobian_deriv",
    "bodynode.BodyNode.dJ",
    "bodynode.BodyNode.angular_jacobian_deriv",
)
def test_jacobian_derivs(body: BodyNode) -> None:
    for deriv, jacobian in (
        (lambda: body.linear_jacobian_deriv(OFFSET), lambda: body.linear_jacobian(OFFSET)),
        (lambda: body.dJ, lambda: body.J),
        (body.angular_jacobian_deriv, body.angular_jacobian),
    ):
        assert_allclose(deriv(), moved(body, jacobian), rtol=1e-5, atol=1e-6)
    assert body.linear_jacobian_deriv(full=False).shape == (3, 13)
    assert body.angular_jacobian_deriv(full=False).shape == (3, 13)


@row("bodynode.BodyNode.expand_jacobian")
def test_expand(robot: Skeleton) -> None:
    body = next(body for body in robot.bodynodes if body.name == "h_hand_left")
    dependent = np.arange(2.0 * len(body.dependent_dofs)).reshape(2, -1)
    full = body.expand_jacobian(dependent)
    ids = [dof.id for dof in body.dependent_dofs]
    assert_allclose(full[:, ids], dependent)
    assert_allclose(np.delete(full, ids, axis=1), 0)


@row("bodynode.BodyNode.__repr__")
def test_repr(body: BodyNode) -> None:
    assert repr(body) == "[BodyNode(6): body 6]"
