"""The flat functions of bodies, dofs, joints, shape nodes and shapes."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

import pydart2
import pydart2.pydart2_api as papi
from pydart2 import Skeleton

from .table import row, rows

PREFIX = "pydart2_api."
TURN = np.array([[0.0, -1, 0, 0.1], [1, 0, 0, 0.2], [0, 0, 1, 0.3], [0, 0, 0, 1]])
OFFSET = [0.1, -0.2, 0.3]


def call(zoo: Skeleton, name: str, *args: Any) -> Any:
    return getattr(papi, name)(zoo.world.id, zoo.id, *args)


def camel(name: str) -> str:
    words = name.split("_")
    return "".join(word.upper() if word in ("com", "rgba") else word.capitalize() for word in words)


def same(value: Any, expected: Any) -> None:
    if isinstance(expected, np.ndarray):
        assert isinstance(value, np.ndarray) and value.shape == expected.shape
        assert_allclose(value, expected)
    else:
        assert value == expected and type(value) is type(expected)


# Bodies

BODY = 6
BODY_GETTERS: dict[str, Callable[[Any], Any]] = {
    "getName": lambda body: body.name,
    "getParentBodyNode": lambda body: body.parent_bodynode.id,
    "getNumChildBodyNodes": lambda body: len(body.child_bodynodes),
    "getParentJoint": lambda body: body.parent_joint.id,
    "getNumChildJoints": lambda body: len(body.child_joints),
    "getNumDependentDofs": lambda body: len(body.dependent_dofs),
    "getNumShapeNodes": lambda body: len(body.shapenodes),
    "isCollidable": lambda body: body.is_collidable(),
    **{
        f"get{camel(name)}": lambda body, name=name: getattr(body, name)()
        for name in [
            "index_in_skeleton",
            "index_in_tree",
            "tree_index",
            "gravity_mode",
            "mass",
            "inertia",
            "local_com",
            "com",
            "com_linear_velocity",
            "com_spatial_velocity",
            "com_linear_acceleration",
            "com_spatial_acceleration",
            "friction_coeff",
            "restitution_coeff",
            "transform",
            "world_transform",
            "relative_transform",
        ]
    },
}


@rows(PREFIX + "bodynode__", {name: (name, get) for name, get in BODY_GETTERS.items()})
def test_body_getter(zoo: Skeleton, case: tuple[str, Callable[[Any], Any]]) -> None:
    name, expected = case
    zoo.world.step()
    same(call(zoo, f"bodynode__{name}", BODY), expected(zoo.bodynodes[BODY]))


def test_no_parent(zoo: Skeleton) -> None:
    assert call(zoo, "bodynode__getParentBodyNode", 0) == -1
    assert call(zoo, "joint__getParentBodyNode", 0) == -1


@rows(
    PREFIX + "bodynode__",
    {
        "getChildBodyNode": ("getChildBodyNode", 0, 7),
        "getChildJoint": ("getChildJoint", 0, 7),
        "getDependentDof": ("getDependentDof", 12, 12),
    },
)
def test_body_part(zoo: Skeleton, case: tuple[str, int, int]) -> None:
    name, i, expected = case
    assert call(zoo, f"bodynode__{name}", BODY, i) == expected
    with pytest.raises(IndexError):
        call(zoo, f"bodynode__{name}", BODY, 13)


BODY_SETTERS = {
    "GravityMode": False,
    "Collidable": False,
    "Mass": 3.0,
    "Inertia": np.diag([3.0, 4.0, 5.0]),
    "FrictionCoeff": 0.5,
    "RestitutionCoeff": 0.25,
}


@rows(PREFIX + "bodynode__set", {name: (name, value) for name, value in BODY_SETTERS.items()})
def test_body_setter(zoo: Skeleton, case: tuple[str, Any]) -> None:
    name, value = case
    body = 1 if name.endswith("Coeff") else BODY  # they are properties of a colliding shape
    assert call(zoo, f"bodynode__set{name}", body, value) is None
    getter = "isCollidable" if name == "Collidable" else f"get{name}"
    same(call(zoo, f"bodynode__{getter}", body), value)


@rows(PREFIX + "bodynode__", {f"{how}Ext{what}": (how, what) for how in ("add", "set") for what in ("Force", "Torque")})
def test_external(cubes: pydart2.World, case: tuple[str, str]) -> None:
    how, what = case
    cube = cubes.skeletons[3]
    push = [0.5, 0.0, 0.0]
    args = (3, 0, push, [0, 0, 0], False, True) if what == "Force" else (3, 0, push, False)
    for _ in range(2):
        getattr(papi, f"bodynode__{how}Ext{what}")(cubes.id, *args)
    cubes.step()
    resistance = cube.m if what == "Force" else cube.bodynodes[0].I[0, 0]
    times = 2 if how == "add" else 1
    assert cube.dq[3 if what == "Force" else 0] == pytest.approx(times * 0.0005 / resistance, rel=1e-3)


JACOBIANS = {
    "Jacobian": 6,
    "WorldJacobian": 6,
    "LinearJacobian": 3,
    "AngularJacobian": 3,
    "LinearJacobianDeriv": 3,
    "AngularJacobianDeriv": 3,
}


@rows(PREFIX + "bodynode__get", {name: (name, size) for name, size in JACOBIANS.items()})
def test_jacobian(zoo: Skeleton, case: tuple[str, int]) -> None:
    name, size = case
    body = zoo.bodynodes[BODY]
    out = np.zeros((size, len(body.dependent_dofs)))
    offset = [] if name.startswith("Angular") else [OFFSET]
    assert call(zoo, f"bodynode__get{name}", BODY, *offset, out) is None
    method = "".join(f"_{c.lower()}" if c.isupper() else c for c in name)[1:]
    assert_allclose(out, getattr(body, method)(*offset, full=False))
    assert np.abs(out).max() > 0


# Dofs

DOF = 8
DOF_NUMBERS = [
    "position",
    "initial_position",
    "position_lower_limit",
    "position_upper_limit",
    "velocity",
    "initial_velocity",
    "velocity_lower_limit",
    "velocity_upper_limit",
    "spring_stiffness",
    "rest_position",
    "damping_coefficient",
    "coulomb_friction",
    "constraint_impulse",
]


@rows(PREFIX + "dof__", {f"{how}{camel(name)}": name for name in DOF_NUMBERS for how in ("get", "set")})
def test_dof_number(zoo: Skeleton, case: str) -> None:
    call(zoo, f"dof__set{camel(case)}", DOF, 0.125)
    assert call(zoo, f"dof__get{camel(case)}", DOF) == getattr(zoo.dofs[DOF], case)() == 0.125


@rows(
    PREFIX + "dof__get", {camel(n): n for n in ("index_in_skeleton", "index_in_tree", "index_in_joint", "tree_index")}
)
def test_dof_index(zoo: Skeleton, case: str) -> None:
    same(call(zoo, f"dof__get{camel(case)}", DOF), getattr(zoo.dofs[DOF], case)())


@row(PREFIX + "dof__getName", PREFIX + "dof__hasPositionLimit")
def test_dof(zoo: Skeleton) -> None:
    assert call(zoo, "dof__getName", DOF) == "ball joint_y"
    assert call(zoo, "dof__hasPositionLimit", DOF) is False
    zoo.dofs[DOF].set_position_lower_limit(-1.0)
    assert call(zoo, "dof__hasPositionLimit", DOF) is True


# Joints

JOINT = 5
JOINT_GETTERS: dict[str, Callable[[Any], Any]] = {
    "getName": lambda joint: joint.name,
    "getParentBodyNode": lambda joint: joint.parent_bodynode.id,
    "getChildBodyNode": lambda joint: joint.child_bodynode.id,
    "isKinematic": lambda joint: joint.is_kinematic(),
    "isDynamic": lambda joint: joint.is_dynamic(),
    "getType": lambda joint: joint.type(),
    "getNumDofs": lambda joint: len(joint.dofs),
    "getTransformFromParentBodyNode": lambda joint: joint.transform_from_parent_body_node(),
    "getTransformFromChildBodyNode": lambda joint: joint.transform_from_child_body_node(),
}


@rows(PREFIX + "joint__", {name: (name, get) for name, get in JOINT_GETTERS.items()})
def test_joint_getter(zoo: Skeleton, case: tuple[str, Callable[[Any], Any]]) -> None:
    name, expected = case
    same(call(zoo, f"joint__{name}", JOINT), expected(zoo.joints[JOINT]))


@row(PREFIX + "joint__setName")
def test_joint_name(zoo: Skeleton) -> None:
    assert call(zoo, "joint__setName", JOINT, "hip", True) == "hip"
    assert (call(zoo, "joint__getName", JOINT), call(zoo, "dof__getName", DOF)) == ("hip", "hip_y")


@row(PREFIX + "joint__setActuatorType", PREFIX + "joint__getActuatorType")
def test_actuator_type(zoo: Skeleton) -> None:
    for kind in range(6):
        call(zoo, "joint__setActuatorType", JOINT, kind)
        assert call(zoo, "joint__getActuatorType", JOINT) == zoo.joints[JOINT].actuator_type() == kind


@rows(PREFIX + "joint__setTransformFrom", {"ParentBodyNode": "Parent", "ChildBodyNode": "Child"})
def test_joint_transform(zoo: Skeleton, case: str) -> None:
    call(zoo, f"joint__setTransformFrom{case}BodyNode", JOINT, TURN)
    assert_allclose(call(zoo, f"joint__getTransformFrom{case}BodyNode", JOINT), TURN)


@row(PREFIX + "joint__setPositionLimitEnforced", PREFIX + "joint__isPositionLimitEnforced")
def test_limit_enforced(zoo: Skeleton) -> None:
    for enforced in (False, True):
        call(zoo, "joint__setPositionLimitEnforced", JOINT, enforced)
        assert call(zoo, "joint__isPositionLimitEnforced", JOINT) is enforced


@row(PREFIX + "joint__getDof", PREFIX + "joint__hasPositionLimit")
def test_joint_dof(zoo: Skeleton) -> None:
    assert [call(zoo, "joint__getDof", JOINT, i) for i in range(3)] == [7, 8, 9]
    zoo.dofs[8].set_position_upper_limit(1.0)
    assert [call(zoo, "joint__hasPositionLimit", JOINT, i) for i in range(3)] == [False, True, False]


JOINT_NUMBERS = [
    "position_lower_limit",
    "position_upper_limit",
    "spring_stiffness",
    "rest_position",
    "damping_coefficient",
    "coulomb_friction",
]


@rows(PREFIX + "joint__", {f"{how}{camel(name)}": name for name in JOINT_NUMBERS for how in ("get", "set")})
def test_joint_number(zoo: Skeleton, case: str) -> None:
    call(zoo, f"joint__set{camel(case)}", JOINT, 1, 0.125)
    assert call(zoo, f"joint__get{camel(case)}", JOINT, 1) == getattr(zoo.dofs[8], case)() == 0.125
    assert call(zoo, f"joint__get{camel(case)}", JOINT, 0) != 0.125


AXES = {"revolute_joint": ["Axis"], "prismatic_joint": ["Axis"], "universal_joint": ["Axis1", "Axis2"]}


@rows(PREFIX, {f"{kind}__{how}{axis}": (kind, axis) for kind in AXES for axis in AXES[kind] for how in ("get", "set")})
def test_axis(zoo: Skeleton, case: tuple[str, str]) -> None:
    kind, axis = case
    joint: Any = zoo.joint(kind.replace("_", " "))
    same(call(zoo, f"{kind}__get{axis}", joint.id), getattr(joint, axis.lower())())
    call(zoo, f"{kind}__set{axis}", joint.id, [0, 0.6, 0.8])
    assert_allclose(getattr(joint, axis.lower())(), [0, 0.6, 0.8])


@row(PREFIX + "euler_joint__getAxisOrder", PREFIX + "euler_joint__setAxisOrder")
def test_axis_order(zoo: Skeleton) -> None:
    euler = zoo.joint("euler joint").id
    assert call(zoo, "euler_joint__getAxisOrder", euler) == "XYZ"
    call(zoo, "euler_joint__setAxisOrder", euler, "ZYX")
    assert call(zoo, "euler_joint__getAxisOrder", euler) == "ZYX"


# Shape nodes and shapes

KINDS = ("sphere_shape", "box_shape", "ellipsoid_shape", "cylindershape", "capsuleshape", "coneshape", "planeshape")
KINDS += ("multisphereshape", "mesh_shape")


@rows(
    PREFIX + "shapenode__", {f"{how}{name}": name for name in ("Offset", "RelativeTransform") for how in ("get", "set")}
)
def test_shapenode_pose(zoo: Skeleton, case: str) -> None:
    value = TURN if case == "RelativeTransform" else TURN[:3, 3]
    call(zoo, f"shapenode__set{case}", 1, 0, value)
    assert_allclose(call(zoo, f"shapenode__get{case}", 1, 0), value)
    assert_allclose(zoo.bodynodes[1].shapenodes[0].offset(), TURN[:3, 3])


@row(PREFIX + "shapenode__hasVisualAspect", PREFIX + "shapenode__hasCollisionAspect")
def test_aspects(zoo: Skeleton) -> None:
    box, plane = 1, 6
    assert [call(zoo, "shapenode__hasVisualAspect", i, 0) for i in (box, plane)] == [False, True]
    assert [call(zoo, "shapenode__hasCollisionAspect", i, 0) for i in (box, plane)] == [True, False]


@row(PREFIX + "shapenode__getVisualAspectRGBA", PREFIX + "shapenode__setVisualAspectRGBA")
def test_rgba(zoo: Skeleton) -> None:
    call(zoo, "shapenode__setVisualAspectRGBA", 0, 0, [0.1, 0.2, 0.3, 0.4])
    assert_allclose(call(zoo, "shapenode__getVisualAspectRGBA", 0, 0), [0.1, 0.2, 0.3, 0.4])
    with pytest.raises((ValueError, TypeError)):
        call(zoo, "shapenode__setVisualAspectRGBA", 0, 0, [0.1, 0.2, 0.3])


@row(PREFIX + "shape__getVolume", PREFIX + "shape__getType", PREFIX + "shape__getTypeID")
def test_shape(zoo: Skeleton) -> None:
    for i, body in enumerate(zoo.bodynodes):
        shape: Any = body.shapenodes[0].shape
        assert call(zoo, "shape__getVolume", i, 0) == shape.volume()
        assert (call(zoo, "shape__getType", i, 0), call(zoo, "shape__getTypeID", i, 0)) == (shape.type(), i)


@row(PREFIX + "shape__getBoundingBoxMin", PREFIX + "shape__getBoundingBoxMax")
def test_bounding_box(zoo: Skeleton) -> None:
    assert_allclose(call(zoo, "shape__getBoundingBoxMin", 1, 0), [-0.05, -0.1, -0.15])
    assert_allclose(call(zoo, "shape__getBoundingBoxMax", 1, 0), [0.05, 0.1, 0.15])


SHAPE_VALUES: dict[str, list[tuple[str, Any, Any]]] = {
    "sphere_shape": [("Radius", 0.1, 0.5)],
    "box_shape": [("Size", np.array([0.1, 0.2, 0.3]), np.array([1.0, 2.0, 3.0]))],
    "ellipsoid_shape": [("Size", np.array([0.1, 0.2, 0.3]), np.array([1.0, 2.0, 3.0]))],
    **{key: [("Radius", 0.1, 0.5), ("Height", 0.3, 0.7)] for key in ("cylindershape", "capsuleshape", "coneshape")},
    "planeshape": [("Normal", np.array([0.0, 0, 1]), np.array([0, 0.6, 0.8])), ("Offset", 0.25, 0.75)],
}


@rows(
    PREFIX,
    {
        f"{kind}__{how}{value[0]}": (kind, *value)
        for kind, values in SHAPE_VALUES.items()
        for value in values
        for how in ("get", "set")
    },
)
def test_shape_value(zoo: Skeleton, case: tuple[str, str, Any, Any]) -> None:
    kind, name, before, after = case
    body = KINDS.index(kind)
    assert_allclose(call(zoo, f"{kind}__get{name}", body, 0), before)
    call(zoo, f"{kind}__set{name}", body, 0, after)
    same(call(zoo, f"{kind}__get{name}", body, 0), after)


@rows(PREFIX + "multisphereshape__", {name: name for name in ("addSphere", "getSpheres", "getNumSpheres")})
def test_spheres(zoo: Skeleton, case: str) -> None:
    call(zoo, "multisphereshape__addSphere", 7, 0, [0.3, 1, 2, 3])
    n = call(zoo, "multisphereshape__getNumSpheres", 7, 0)
    spheres = call(zoo, "multisphereshape__getSpheres", 7, 0, 4 * n)
    assert (n, spheres.shape) == (3, (12,))
    assert_allclose(spheres, [0.1, 0, 0, 0.5, 0.2, 0, 0, -0.5, 0.3, 1, 2, 3])


@row(PREFIX + "mesh_shape__getScale", PREFIX + "mesh_shape__getMeshPath")
def test_mesh(zoo: Skeleton) -> None:
    assert_allclose(call(zoo, "mesh_shape__getScale", 8, 0), [1, 2, 3])
    assert call(zoo, "mesh_shape__getMeshPath", 8, 0).endswith("mesh.obj")
