"""What the engine's parsers need to find in a file, format by format: without it they crash, or read garbage.

A field of an element is a child, by its tag (``a/b``: a child's child), or with a leading ``@`` an attribute. An
element is named by its tag, or by its parent's and its own, as ``"joint/parent"``.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

Fields = tuple[str, ...]
ANY = 0  # a list of numbers of any length


@dataclass(frozen=True)
class Rules:
    """The rules of one format."""

    kind: str
    title: str
    #: Element → fields that must be there.
    required: Mapping[str, Fields]
    #: Element → field → how many numbers it holds, if it is there. They must be finite.
    numbers: Mapping[str, Mapping[str, int]]
    #: Element → fields of which one must be there.
    one_of: Mapping[str, Fields] = field(default_factory=dict)
    #: Joint type → fields that such a joint must have.
    joint_types: Mapping[str, Fields] = field(default_factory=dict)
    #: Fields that may be infinite.
    limits: frozenset[str] = frozenset()
    #: Elements that the engine does not read, and what is in them.
    skipped: frozenset[str] = frozenset()


def ones(*fields: str) -> dict[str, int]:
    """Fields with one number each."""
    return dict.fromkeys(fields, 1)


_MOMENTS = ("ixx", "iyy", "izz", "ixy", "ixz", "iyz")
_SPHERE, _STACKS = ("radius",), ("num_slices", "num_stacks")
_DYNAMICS = ones("damping", "friction", "spring_rest_position", "spring_stiffness")
_LIMITS = ones("lower", "upper")

SOFT_SHAPES: Mapping[str, Fields] = {
    "sphere": (*_SPHERE, *_STACKS),
    "box": ("size", "frags"),
    "ellipsoid": ("size", *_STACKS),
    "cylinder": ("radius", "height", *_STACKS, "num_rings"),
}
_SOFT_NUMBERS = ones("total_mass", "kv", "ke", "damp")
_SOFT_COUNTS = {"frags": 3, **ones(*_STACKS, "num_rings")}

SKEL = Rules(
    kind="skel",
    title="SKEL",
    required={
        "skeleton": ("@name", "joint"),
        "body": ("@name",),
        "skeleton/joint": ("@name", "@type", "parent", "child"),
        "inertia": ("mass",),
        "moment_of_inertia": _MOMENTS,
        "visualization_shape": ("geometry",),
        "collision_shape": ("geometry",),
        "soft_shape": ("total_mass", "geometry"),
        "geometry/sphere": _SPHERE,
        "geometry/box": ("size",),
        "geometry/ellipsoid": ("size",),
        "geometry/cylinder": ("radius", "height"),
        "geometry/capsule": ("radius", "height"),
        "geometry/cone": ("radius", "height"),
        "geometry/pyramid": ("base_width", "base_depth", "height"),
        "geometry/plane": ("normal",),
        "geometry/mesh": ("file_name", "scale"),
        "multi_sphere/sphere": ("radius", "position"),
        "marker": ("@name",),
    },
    one_of={
        "geometry": (
            *("sphere", "box", "ellipsoid", "cylinder", "capsule", "cone", "pyramid"),
            *("plane", "multi_sphere", "mesh"),
        ),
        "geometry/plane": ("offset", "point"),
    },
    joint_types={
        **dict.fromkeys(("weld", "ball", "translational", "planar", "free"), ()),
        **dict.fromkeys(("revolute", "prismatic", "screw"), ("axis/xyz",)),
        "universal": ("axis/xyz", "axis2/xyz"),
        "euler": ("axis_order",),
    },
    numbers={
        "physics": {"time_step": 1, "gravity": 3},
        "skeleton": {"transformation": 6},
        "body": {"transformation": 6},
        "joint": {"transformation": 6, "init_pos": ANY, "init_vel": ANY},
        "visualization_shape": {"transformation": 6, "color": ANY},
        "collision_shape": {"transformation": 6},
        "soft_shape": {"transformation": 6, **_SOFT_NUMBERS},
        "inertia": {"mass": 1, "offset": 3},
        "moment_of_inertia": ones(*_MOMENTS),
        "sphere": {"radius": 1, "position": 3, **_SOFT_COUNTS},
        "box": {"size": 3, **_SOFT_COUNTS},
        "ellipsoid": {"size": 3, **_SOFT_COUNTS},
        "cylinder": {**ones("radius", "height"), **_SOFT_COUNTS},
        "capsule": ones("radius", "height"),
        "cone": ones("radius", "height"),
        "pyramid": ones("base_width", "base_depth", "height"),
        "geometry/plane": {"normal": 3, "offset": 1, "point": 3},
        "mesh": {"scale": 3},
        "marker": {"offset": 3},
        "axis": {"xyz": 3, "pitch": 1, "damping": 1},
        "axis2": {"xyz": 3, "damping": 1},
        "dynamics": _DYNAMICS,
        "limit": _LIMITS,
        "dof": _DYNAMICS,
    },
    limits=frozenset(_LIMITS),
)

SDF = Rules(
    kind="sdf",
    title="SDF",
    required={
        "link": ("@name",),
        "model/joint": ("@name", "@type", "parent", "child"),
        "inertial/inertia": _MOMENTS,
        "visual": ("geometry",),
        "collision": ("geometry",),
        "soft_shape": ("total_mass", "geometry"),
        "geometry/sphere": _SPHERE,
        "geometry/box": ("size",),
        "geometry/cylinder": ("radius", "length"),
        "geometry/plane": ("size",),
        "geometry/mesh": ("uri",),
    },
    joint_types={
        **dict.fromkeys(("prismatic", "revolute", "screw"), ("axis/xyz",)),
        **dict.fromkeys(("revolute2", "universal"), ("axis/xyz", "axis2/xyz")),
        "ball": (),
        "fixed": (),
    },
    numbers={
        "world": {"gravity": 3},
        "physics": {"max_step_size": 1, "gravity": 3},
        "model": {"pose": 6},
        "link": {"pose": 6},
        "visual": {"pose": 6},
        "collision": {"pose": 6},
        "joint": {"pose": 6},
        "inertial": {"mass": 1, "pose": 6},
        "inertia": ones(*_MOMENTS),
        "soft_shape": {"pose": 6, **_SOFT_NUMBERS},
        "sphere": {"radius": 1, **_SOFT_COUNTS},
        "box": {"size": 3, **_SOFT_COUNTS},
        "ellipsoid": {"size": 3, **_SOFT_COUNTS},
        "cylinder": {**ones("radius", "length", "height"), **_SOFT_COUNTS},
        "plane": {"size": 2},
        "mesh": {"scale": 3},
        "material": {"diffuse": ANY},
        "axis": {"xyz": 3},
        "axis2": {"xyz": 3},
        "dynamics": ones("damping", "friction"),
        "limit": _LIMITS,
        "model/joint": {"thread_pitch": 1},
    },
    limits=frozenset(_LIMITS),
    skipped=frozenset({"plugin", "sensor", "light", "gui", "scene", "state", "include"}),
)

_URDF_LIMITS = ones("@lower", "@upper", "@effort", "@velocity")

URDF = Rules(
    kind="urdf",
    title="URDF",
    required={
        "robot": ("link",),
        "link": ("@name",),
        "joint": ("@name", "@type", "parent", "child"),
        "joint/parent": ("@link",),
        "joint/child": ("@link",),
        "visual": ("geometry",),
        "collision": ("geometry",),
        "box": ("@size",),
        "sphere": ("@radius",),
        "cylinder": ("@radius", "@length"),
        "mesh": ("@filename",),
        "mimic": ("@joint",),
    },
    joint_types=dict.fromkeys(("revolute", "continuous", "prismatic", "fixed", "floating", "planar"), ()),
    numbers={
        "origin": {"@xyz": 3, "@rpy": 3},
        "mass": {"@value": 1},
        "inertia": ones(*(f"@{moment}" for moment in _MOMENTS)),
        "box": {"@size": 3},
        "sphere": {"@radius": 1},
        "cylinder": ones("@radius", "@length"),
        "mesh": {"@scale": 3},
        "axis": {"@xyz": 3},
        "limit": _URDF_LIMITS,
        "dynamics": ones("@damping", "@friction"),
        "mimic": ones("@multiplier", "@offset"),
        "color": {"@rgba": 4},
    },
    limits=frozenset(_URDF_LIMITS),
    skipped=frozenset({"gazebo", "transmission", "sensor", "plugin", "ros2_control"}),
)

URDF_WORLD = Rules(
    kind="urdf_world",
    title="URDF world",
    required={"world": ("@name",), "include": ("@filename", "@model_name"), "entity": ("@model",)},
    numbers={"origin": {"@xyz": 3, "@rpy": 3}},
)

_PLACED = {"@pos": 3, "@quat": 4, "@axisangle": 4, "@xyaxes": 6, "@zaxis": 3, "@euler": 3, "@fromto": 6}

MJCF = Rules(
    kind="mjcf",
    title="MJCF",
    required={"mujoco": ("worldbody",), "include": ("@file",)},
    numbers={
        "body": _PLACED,
        "geom": {**_PLACED, "@size": ANY, "@rgba": 4, **ones("@mass", "@density")},
        "site": {**_PLACED, "@size": ANY, "@rgba": 4},
        "joint": {"@pos": 3, "@axis": 3, "@range": 2, **ones("@damping", "@springref")},
        "inertial": {**_PLACED, "@mass": 1, "@diaginertia": 3, "@fullinertia": 6},
        "mesh": {"@scale": 3},
        "option": {"@timestep": 1, "@gravity": 3},
    },
    skipped=frozenset(
        {"actuator", "sensor", "tendon", "contact", "keyframe", "visual", "statistic", "custom", "texture", "material"}
    ),
)

VSK = Rules(
    kind="vsk",
    title="VSK",
    required={
        "KinematicModel": ("Skeleton",),
        "Skeleton": ("Segment",),
        "Segment": ("@NAME",),
        "Parameter": ("@NAME", "@VALUE"),
    },
    numbers={"Parameter": {"@VALUE": 1}, "Segment": {"@MASS": 1}, "Skeleton": {"@DENSITY": 1}},
)

#: Root element → rules.
ROOTS: Mapping[str, Rules] = {
    "skel": SKEL,
    "sdf": SDF,
    "robot": URDF,
    "world": URDF_WORLD,
    "mujoco": MJCF,
    "KinematicModel": VSK,
}
