"""A skeleton as plain numbers, which the writers of the formats take."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from pydart2.building.skeletons import JOINTS
from pydart2.shapenode import Surface

if TYPE_CHECKING:
    from pydart2._native import MeshHandle
    from pydart2.bodynode import BodyNode
    from pydart2.constraints import Constraint
    from pydart2.dof import Dof
    from pydart2.joint import Joint
    from pydart2.shapenode import ShapeNode
    from pydart2.skeleton import Skeleton
    from pydart2.world import World

Array = NDArray[np.float64]
_USUAL = (1, 0xFFFFFFFF)  # group and mask of a body that was put in none
_KINDS = {engine: kind for kind, engine in JOINTS.items()}


@dataclass
class DofPart:
    """A degree of freedom; rad or m, rad/s or m/s, N m or N."""

    name: str
    lower: float = -math.inf
    upper: float = math.inf
    initial: float = 0.0
    velocity_lower: float = -math.inf
    velocity_upper: float = math.inf
    initial_velocity: float = 0.0
    force_lower: float = -math.inf
    force_upper: float = math.inf
    stiffness: float = 0.0
    rest: float = 0.0
    damping: float = 0.0
    friction: float = 0.0
    armature: float = 0.0


@dataclass
class Follows:
    """``q = multiplier * q of the leader + offset``; the leader by its name, and by those of its dofs.

    `starts` are the initial positions of these.
    """

    leader: str
    dofs: list[str]
    multiplier: float
    offset: float
    starts: dict[str, float]


@dataclass
class JointPart:
    """A joint.

    Attributes
    ----------
    kind
        As `Skeleton.add_body` has it.
    axes
        Unit vectors in the joint's frame, shape (3,), 1: one of revolute, prismatic and screw joints, two of universal
        ones; the two directions of translation of planar and translational2d ones.
    pitch
        Of a screw, m per turn.
    order
        Of a euler joint.
    """

    name: str
    kind: str
    dofs: list[DofPart]
    axes: list[Array] = field(default_factory=list)
    pitch: float = 0.0
    order: str = ""
    actuator: str = "FORCE"
    follows: Follows | None = None
    enforced: bool = False


@dataclass
class ShapePart:
    """A shape: its kind, as ``"box"``, what the kind has, m, and its pose in the link, shape (4, 4), m.

    The colour, shape (4,), 0 to 1, is None for one that is not drawn, and empty if the mesh's own materials give it.
    `meshes` reads the corners, shape (n, 3), not scaled, and triangles, shape (m, 3), of those of a mesh.
    """

    name: str
    kind: str
    sizes: dict[str, Any]
    pose: Array
    rgba: Array | None
    collides: bool
    friction: float = 1.0
    restitution: float = 0.0
    is_isotropic: bool = True  # no slip, and the same friction in every direction
    meshes: Callable[[], list[tuple[Array, Array]]] = list

    @property
    def drawn(self) -> bool:
        """Whether it is drawn."""
        return self.rgba is not None


@dataclass
class CameraPart:
    """A camera of a world, as MountedCamera has it; what it looks at by the names of skeleton and body."""

    name: str
    pose: Array
    fov: float
    mode: str
    target: tuple[str, str] | None


@dataclass
class LinkPart:
    """A body with the joint to its parent: poses of the joint in the parent and in the link, shape (4, 4), m."""

    name: str
    parent: LinkPart | None
    joint: JointPart
    in_parent: Array
    in_link: Array
    mass: float
    com: Array
    inertia: Array
    shapes: list[ShapePart] = field(default_factory=list)
    markers: list[tuple[str, Array]] = field(default_factory=list)
    cameras: list[CameraPart] = field(default_factory=list)
    gravity: bool = True
    collidable: bool = True
    soft: bool = False


@dataclass
class SkeletonPart:
    """A skeleton; its links in their order, parents first.

    Attributes
    ----------
    pairs
        The names of bodies of it that pass through each other.
    constraints
        Those of the world that hold a body of it, in words.
    besides
        What no format has: what it is, then the name of each.
    """

    name: str
    links: list[LinkPart]
    mobile: bool
    self_collision: bool
    adjacent: bool
    pairs: list[tuple[str, str]] = field(default_factory=list)
    constraints: list[str] = field(default_factory=list)
    besides: dict[str, list[str]] = field(default_factory=dict)


@dataclass
class WorldPart:
    """What a world has besides its skeletons: m/s², s, the detector's name, and pairs that pass through each other.

    A pair are bodies of two skeletons, each by the names of skeleton and body. The cameras are those on no body.
    """

    gravity: Array
    time_step: float
    detector: str
    pairs: list[tuple[tuple[str, str], tuple[str, str]]]
    cameras: list[CameraPart]


def world_part(world: World) -> WorldPart:
    """The numbers of a world."""
    pairs = [pair for pair in _pairs(world) if pair[0][0] != pair[1][0]]
    return WorldPart(world.gravity(), world.dt, world._handle.collision_detector(), pairs, _cameras(world, None))


def _pairs(world: World) -> list[tuple[tuple[str, str], tuple[str, str]]]:
    """Those that pass through each other, each by the names of skeleton and body."""

    rows = world._handle.ignored_pairs().astype(int).tolist()
    found = []
    for pair in sorted(sorted((row[:2], row[2:])) for row in rows):
        one, two = (world.skeletons[skel].bodynodes[body] for skel, body in pair)
        found.append(((one.skeleton.name, one.name), (two.skeleton.name, two.name)))
    return found


def _cameras(world: World, body: BodyNode | None) -> list[CameraPart]:
    """Those that are mounted on a body, or on none."""
    found = []
    for name, camera in world.cameras.items():
        if camera.body is body:
            target = None if camera.target is None else (camera.target.skeleton.name, camera.target.name)
            found.append(CameraPart(name, np.array(camera.pose, dtype=float), camera.fov, camera.mode, target))
    return found


def skeleton_part(skel: Skeleton) -> SkeletonPart:
    """The numbers of a skeleton."""
    links: dict[BodyNode, LinkPart] = {}
    for body in skel.bodynodes:
        parent = links[body.parent_bodynode] if body.parent_bodynode is not None else None
        links[body] = _link_part(body, parent)
    return SkeletonPart(
        name=skel.name,
        links=list(links.values()),
        mobile=skel.is_mobile(),
        self_collision=skel.self_collision_check(),
        adjacent=skel.adjacent_body_check(),
        pairs=[(one[1], two[1]) for one, two in _pairs(skel.world) if one[0] == two[0] == skel.name],
        constraints=[_words(held) for held in skel.world.constraints if _holds(held, skel)],
        besides=_besides(skel),
    )


def _besides(skel: Skeleton) -> dict[str, list[str]]:
    targets = skel.targets
    return {
        "targets (set_targets)": [
            dof.name for dof in skel.dofs if targets is not None and (targets.kp[dof.id] or targets.kd[dof.id])
        ],
        "collision groups (set_collision_group)": [
            body.name for body in skel.bodynodes if skel.world.collision_group(body) != _USUAL
        ],
        "muscles": [
            str(mtu.name) for mtu, _ in getattr(skel, "muscles", ())
        ],  # a skeleton does not know its subclasses
    }


def _holds(constraint: Constraint, skel: Skeleton) -> bool:
    second = constraint.body2
    return constraint.body1.skeleton is skel or (second is not None and second.skeleton is skel)


def _words(constraint: Constraint) -> str:
    second = constraint.body2
    return f"{constraint.body1.name} and {'the world' if second is None else second.name}"


def _link_part(body: BodyNode, parent: LinkPart | None) -> LinkPart:
    joint = body.parent_joint
    return LinkPart(
        name=body.name,
        parent=parent,
        joint=_joint_part(joint),
        in_parent=joint.transform_from_parent_body_node(),
        in_link=joint.transform_from_child_body_node(),
        mass=body.m,
        com=body.local_com(),
        inertia=body.I,
        shapes=[_shape_part(node) for node in body.shapenodes if node.shape is not None],
        markers=[(marker.label, marker.local_position()) for marker in body.markers],
        cameras=_cameras(body.skeleton.world, body),
        gravity=body.gravity_mode(),
        collidable=body.is_collidable(),
        soft=body._handle.is_soft(),
    )


def _joint_part(joint: Joint) -> JointPart:
    handle, kind = joint._handle, _KINDS.get(joint.type(), joint.type())
    part = JointPart(joint.name, kind, [_dof_part(dof) for dof in joint.dofs])
    if kind in ("revolute", "prismatic", "screw"):
        part.axes = [handle.axis()]
    elif kind in ("universal", "planar", "translational2d"):
        part.axes = [handle.axis1(), handle.axis2()]
    if kind == "screw":
        part.pitch = handle.pitch()
    if kind == "euler":
        part.order = handle.axis_order()
    part.actuator = handle.actuator_type()
    part.enforced = joint.is_position_limit_enforced()
    if part.actuator == "MIMIC":
        leader, multiplier, offset = handle.mimic_joint(), handle.mimic_multiplier(), handle.mimic_offset()
        starts = {dof.name: dof.initial_position() for dof in joint.skeleton.joints[leader].dofs}
        part.follows = Follows(joint.skeleton.joints[leader].name, list(starts), multiplier, offset, starts)
    return part


def _dof_part(dof: Dof) -> DofPart:
    return DofPart(
        name=dof.name,
        lower=dof.position_lower_limit(),
        upper=dof.position_upper_limit(),
        initial=dof.initial_position(),
        velocity_lower=dof.velocity_lower_limit(),
        velocity_upper=dof.velocity_upper_limit(),
        initial_velocity=dof.initial_velocity(),
        force_lower=dof.force_lower_limit(),
        force_upper=dof.force_upper_limit(),
        stiffness=dof.spring_stiffness(),
        rest=dof.rest_position(),
        damping=dof.damping_coefficient(),
        friction=dof.coulomb_friction(),
        armature=dof.armature(),
    )


_SIZES = {
    "BoxShape": ("box", "size"),
    "SphereShape": ("sphere", "radius"),
    "EllipsoidShape": ("ellipsoid", "size"),
    "CylinderShape": ("cylinder", "radius", "height"),
    "CapsuleShape": ("capsule", "radius", "height"),
    "ConeShape": ("cone", "radius", "height"),
    "PyramidShape": ("pyramid", "base_width", "base_depth", "height"),
    "PlaneShape": ("plane", "normal", "offset"),
    "MeshShape": ("mesh", "path", "mirrored", "scale"),
}
_HULL = "MultiSphereConvexHullShape"


def _shape_part(node: ShapeNode) -> ShapePart:
    handle = node._handle
    shape = handle.shape()
    kind, *names = _SIZES.get(shape.type(), (shape.type(),))
    sizes = {name: getattr(shape, name)() for name in names}
    if shape.type() == _HULL:
        kind, sizes = "multi_sphere", {"spheres": shape.spheres()}
    rgba = handle.rgba() if handle.has_visual_aspect() and not handle.is_hidden() else None
    if rgba is not None and kind == "mesh" and shape.uses_materials():
        rgba = np.zeros(0)
    part = ShapePart(node.name, kind, sizes, handle.relative_transform(), rgba, handle.has_collision_aspect())
    if kind == "mesh":
        part.meshes = lambda: [_corners(shape.mesh(i)) for i in range(shape.num_meshes())]
    if handle.has_dynamics_aspect():
        surface = node.surface()
        part.friction, part.restitution = surface.friction, surface.restitution
        part.is_isotropic = surface == Surface(part.friction, part.friction, restitution=part.restitution)
    return part


def _corners(mesh: MeshHandle) -> tuple[Array, Array]:
    return mesh.vertices(), mesh.triangles()
