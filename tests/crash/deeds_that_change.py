"""Deeds of fuzz_worlds.py that build worlds and change what they are made of: each is a call or two, as in scripts."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

import pydart2
from crash.world_hands import MODELS, Hands, deed
from pydart2.building.skins import Skin

BOX = """<robot name="box"><link name="box"><inertial><mass value="1"/>
<inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/></inertial>
<collision><geometry><box size="0.2 0.2 0.2"/></geometry></collision></link></robot>"""
JOINTS = ["free", "weld", "revolute", "prismatic", "screw", "ball", "euler", "universal", "planar"]
JOINTS += ["translational", "translational2d"]
TETRAHEDRON = ([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])


class Half(pydart2.Skeleton):
    """Its constructor raises when the engine's part is made."""

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        raise ValueError("half made")


# Building


@deed
def add_single(h: Hands) -> None:
    if not h.has_room():
        h.world.remove_skeleton(h.skel())
        return
    at = h.vector(3, 0.5)
    mass = h.number() if h.flip() else None
    h.random.choice(
        [
            lambda: h.world.add_box(h.vector(3, 0.2, False), mass, at, **h.options()),
            lambda: h.world.add_sphere(h.number(0.1), mass, at, **h.options()),
            lambda: h.world.add_capsule(h.number(0.1), h.number(0.3), mass, at),
            lambda: h.world.add_cylinder(h.number(0.1), h.number(0.3), mass, at, **h.options()),
            lambda: h.world.add_mesh(*mesh(h), mass, at, **h.options()),
            lambda: h.world.add_ground(h.number(0.5, True), friction=h.number()),
            lambda: h.world.add_empty_skeleton("empty"),
            lambda: h.world.add_skeleton(BOX, safe=False),
            lambda: h.world.add_skeleton(f"skel/{h.random.choice(MODELS[:2])}.skel", safe=False),
            lambda: h.world.add_skeleton(BOX, Half, safe=False),
        ]
    )()


def mesh(h: Hands) -> tuple[Any, Any]:
    vertices, triangles = TETRAHEDRON
    scaled = np.array(vertices) * h.random.uniform(0.1, 0.5)
    if h.random.random() < 0.1:
        scaled[h.random.randrange(4)] = h.vector(3)[:3]
    return h.odd(scaled), h.odd(triangles)


@deed
def add_soft(h: Hands) -> None:
    if not h.has_room():
        return
    springs = {"stiffness": h.number(500.0), "edge_stiffness": h.number(10.0), "damping": h.number(5.0)}
    springs |= h.options() if h.flip() else {}
    at, mass = h.vector(3, 0.5), h.number()
    h.random.choice(
        [
            lambda: h.world.add_soft_box(h.vector(3, 0.3, False), mass, at, cells=h.odd(2), **springs),
            lambda: h.world.add_soft_sphere(h.number(0.2), mass, at, cells=h.odd(2), **springs),
            lambda: h.world.add_soft_ellipsoid(h.vector(3, 0.3, False), mass, at, cells=h.odd(2), **springs),
            lambda: h.world.add_soft_mesh(*mesh(h), mass, at, **springs),
        ]
    )()


@deed
def add_body(h: Hands) -> None:
    skel = h.skel()
    if skel.num_bodynodes() > 12:
        skel.remove_body(h.random.choice(skel.bodynodes))
        return
    given: dict[str, Any] = {"mass": h.number(), "inertia": np.eye(3), "position": h.vector(3, 0.3)}
    joint = h.odd(h.random.choice(JOINTS))
    if h.flip():
        given |= {"limits": sorted([h.random.gauss(0, 1), h.random.gauss(0, 1)]), "damping": h.number(0.1)}
    if h.random.random() < 0.2:
        given |= {"axis": h.vector(), "stiffness": h.number(), "armature": h.number(0.01), "friction": h.number(0.1)}
    if h.random.random() < 0.1:
        given["skin"] = Skin.box(h.vector(3, 0.3, False), h.number(), 2)
    parent = h.random.choice([*skel.bodynodes, None])
    skel.add_body(h.odd(f"body{h.random.randrange(40)}"), parent, joint, **given).add_box([0.1, 0.1, 0.1], mass=0.1)


@deed
def move_branch(h: Hands) -> None:
    skel, body = h.skel(), h.keep(h.body())
    parent = h.random.choice([*skel.bodynodes, None])
    given = {"position": h.vector(3, 0.3)} if h.flip() else {}
    h.random.choice(
        [
            lambda: skel.attach(body, parent, h.odd(h.random.choice(JOINTS)), joint_name=h.odd("j"), **given),
            lambda: skel.attach(body, parent),
            lambda: h.has_room() and body.skel.detach(body),
            lambda: skel.num_bodynodes() < 12 and skel.copy_branch(body, parent),
        ]
    )()


@deed
def add_shape(h: Hands) -> None:
    body = h.body()
    options: dict[str, Any] = {"position": h.vector(3, 0.2), "mass": h.random.choice((0, 0.1, h.number()))}
    heights = h.odd(np.array([[h.random.gauss(0, 0.1) for _ in range(3)] for _ in range(3)]))
    h.random.choice(
        [
            lambda: body.add_box(h.vector(3, 0.2, False), **options),
            lambda: body.add_sphere(h.number(0.1), **options),
            lambda: body.add_capsule(h.number(0.1), h.number(0.2), **options),
            lambda: body.add_cylinder(h.number(0.1), h.number(0.2), **options),
            lambda: body.add_cone(h.number(0.1), h.number(0.2), **options),
            lambda: body.add_ellipsoid(h.vector(3, 0.2, False), **options),
            lambda: body.add_mesh(*mesh(h), **options),
            lambda: body.add_plane(h.vector(), h.number(0.5, True)),
            lambda: body.add_heightfield(heights, h.vector(3, 0.3, False)),
            lambda: body.add_marker("marker", h.vector()),
            lambda: body.add_mass(h.number(), h.vector(3, 0.1)),
        ]
    )()


@deed
def remove(h: Hands) -> None:
    """The handles are used later."""
    h.random.choice(
        [
            lambda: h.world.remove_skeleton(h.keep(h.skel())),
            lambda: h.keep(h.body()).skel.remove_body(h.body()),
            lambda: h.body().remove_shape(h.keep(h.shape())),
            lambda: h.keep(h.joint()).skel.set_root_joint_to_weld(),
            lambda: h.skel().set_root_joint_to_free(),
        ]
    )()


# Changing


@deed
def resize(h: Hands) -> None:
    shape = h.shape().shape
    setters = [name for name in dir(shape) if name.startswith("set_")]
    name = h.random.choice(setters)
    getattr(shape, name)(h.vector(3, 0.3) if name in ("set_size", "set_normal") else h.number(0.3))


@deed
def move_shape(h: Hands) -> None:
    node = h.shape()
    h.random.choice([lambda: node.set_offset(h.vector(3, 0.3)), lambda: node.set_relative_transform(h.pose())])()


@deed
def change_body(h: Hands) -> None:
    body = h.body()
    entries = h.vector(3, 0.1, False)
    h.random.choice(
        [
            lambda: body.set_mass(h.number()),
            lambda: body.set_inertia(np.diag(entries)),
            lambda: body.set_local_com(h.vector(3, 0.1)),
            lambda: body.set_friction_coeff(h.number()),
            lambda: body.set_restitution_coeff(h.number(0.5)),
            lambda: body.set_gravity_mode(h.flip()),
            lambda: body.set_collidable(h.flip()),
            lambda: body.add_ext_force(h.vector(3, 10.0), h.vector(3, 0.1)),
            lambda: body.add_ext_torque(h.vector(3, 1.0)),
            lambda: body.skel.set_mobile(h.random.random() < 0.8),
            lambda: body.skel.set_self_collision_check(h.flip()),
            lambda: body.skel.set_adjacent_body_check(h.flip()),
            lambda: soft_points(h, body),
        ]
    )()


def soft_points(h: Hands, body: Any) -> None:
    if isinstance(body, pydart2.SoftBodyNode):
        random = np.random.default_rng(h.random.randrange(1000))
        points = h.odd(random.normal(0.0, 0.02, (body.num_points(), 3)))
        h.random.choice([body.set_point_displacements, body.set_point_velocities, body.add_point_forces])(points)
        h.random.choice([body.set_vertex_stiffness, body.set_edge_stiffness, body.set_damping_coefficient])(h.number(9))


@deed
def limit(h: Hands) -> None:
    dof, joint = h.dof(), h.joint()
    what = h.random.choice(("position", "velocity", "force"))
    which = h.random.choice(("lower", "upper"))
    getattr(dof, f"set_{what}_{which}_limit")(h.number(1.0, True))
    if h.flip():
        joint.set_position_limit_enforced(h.flip())
    else:
        h.skel().set_position_limits_enforced(h.flip())


@deed
def change_joint(h: Hands) -> None:
    dof, joint = h.dof(), h.joint()
    h.random.choice(
        [
            lambda: dof.set_damping_coefficient(h.number(0.1)),
            lambda: dof.set_spring_stiffness(h.number()),
            lambda: dof.set_rest_position(h.number(1.0, True)),
            lambda: dof.set_coulomb_friction(h.number(0.1)),
            lambda: dof.set_armature(h.number(0.01)),
            lambda: dof.set_command(h.number(1.0, True)),
            lambda: dof.set_initial_position(h.number(1.0, True)),
            lambda: joint.set_actuator_type(h.odd(h.random.randrange(8))),
            lambda: joint.set_mimic(h.random.choice(joint.skel.joints), h.number(1.0, True), h.number(0.1, True)),
            lambda: joint.set_transform_from_parent_body_node(h.pose()),
            lambda: joint.set_transform_from_child_body_node(h.pose()),
            lambda: joint.set_name(h.odd("joint")),
        ]
    )()


@deed
def set_state(h: Hands) -> None:
    skel = h.skel()
    n = skel.ndofs
    h.random.choice(
        [
            lambda: setattr(skel, "q", h.vector(n, 0.5)),
            lambda: setattr(skel, "dq", h.vector(n, 1.0)),
            lambda: setattr(skel, "tau", h.vector(n, 1.0)),
            lambda: setattr(skel, "ddq", h.vector(n, 1.0)),
            lambda: setattr(skel, "x", h.vector(2 * n, 0.5)),
            lambda: setattr(skel, "comms", h.vector(n, 0.5)),
            lambda: skel.set_targets(h.vector(n, 0.5), kp=h.number(100.0), kd=h.number(10.0)),
            lambda: skel.set_targets(dq=h.vector(n, 0.5), kd=h.number(10.0), compensate=h.odd("gravity", 0.5)),
            skel.clear_targets,
            lambda: skel.set_controller(h.odd(lambda *_: np.zeros(n), 0.2)),
            lambda: skel.set_controller(None),
        ]
    )()


@deed
def change_in_place(h: Hands) -> None:
    """What was handed out is the caller's: the world does not see what is done to it."""
    thing = h.random.choice([h.world, h.skel(), h.body(), h.shape(), h.shape().shape, h.world.collision_result])
    names = [name for name in dir(type(thing)) if isinstance(getattr(type(thing), name, None), property)]
    value = getattr(thing, h.random.choice(names))
    if isinstance(value, np.ndarray) and value.flags.writeable and value.dtype == float:
        value[...] = h.random.choice((math.nan, 1e300, 0.0))
    elif isinstance(value, list):
        value.clear()


@deed
def change_world(h: Hands) -> None:
    world, choice = h.world, h.random.choice
    choice(
        [
            lambda: world.set_gravity(h.vector(3, 5.0)),
            lambda: world.set_time_step(h.number(0.001)),
            lambda: setattr(world, "constraint_error_reduction", h.number(0.1)),
            lambda: setattr(world, "max_contacts", h.odd(h.random.randrange(1, 50), 0.5)),
            lambda: setattr(world, "contact_memory_limit", h.number(1e8)),
            lambda: world.set_blow_up(h.odd(choice(("raise", "nan")))),
            lambda: world.set_deterministic(h.flip()),
            lambda: world.set_warm_start(h.flip()),
            lambda: world.set_contact_reduction(h.flip()),
            lambda: world.set_recording(h.flip()),
            lambda: setattr(world, "t", h.number()),
        ]
    )()


@deed
def choose(h: Hands) -> None:
    world, choice = h.world, h.random.choice
    options: dict[str, Any] = {"iterations": h.odd(h.random.randrange(1, 100)), "tolerance": h.number(1e-6)}
    options |= {"friction": h.odd(choice(("pyramid", "cone", "engine")))}
    options |= {"stabilisation": h.odd(choice(("split", "engine"))), "error_reduction": h.number(0.2)}
    choice(
        [
            lambda: world.set_collision_detector(h.odd(choice(("fcl", "bullet", "ode", "dart", "native")))),
            lambda: world.set_collision_detector(h.odd(h.random.randrange(5))),
            lambda: world.set_constraint_solver("iterative", **(options if h.flip() else {})),
            lambda: world.set_constraint_solver(choice(("fast", "dart"))),
            lambda: world.set_dynamics(h.odd(choice(("fast", "engine")))),
            lambda: world.set_integrator(h.odd(choice(("engine", "implicit", "rk4", "variational")))),
            lambda: world.set_sleeping(h.flip(), seconds=h.number(0.01), linear_speed=h.number(1.0)),
        ]
    )()
