"""Writes the URDF model of PR2 and the meshes of its links below the data folder.

    python3 tools/make_pr2.py [data folder]

The model has Willow Garage's published figures.  The right arm is the left one on the other side:
parts, masses and frames are equal, so an arm is stated once; right_arm() says what differs.  Meshes
come from mesh_pr2.py.  Equal input gives equal bytes.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import pi
from pathlib import Path

import mesh_pr2
from mesh import Point, obj_text
from mesh_rounded import library_text

FOLDER = "obj/pr2"
LIBRARY = "pr2.mtl"
ORIGIN: Point = (0.0, 0.0, 0.0)
X, Y, Z, MINUS_Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0), (0.0, 0.0, -1.0)
QUARTER = 1.57079632679  # the published figures have these digits
HALF = 3.14159265359
OPTICAL = (-QUARTER, 0.0, -QUARTER)  # from a camera's x forward to z forward
ALONG_X, ALONG_Y = (0.0, pi / 2, 0.0), (pi / 2, 0.0, 0.0)  # turn a cylinder's axis


@dataclass(frozen=True)
class Joint:
    """A joint to a parent link; its frame is that of the link."""

    name: str
    kind: str
    parent: str
    xyz: Point = ORIGIN
    rpy: Point = ORIGIN
    axis: Point | None = None
    limits: tuple[float, float] | None = None  # rad or m
    effort: float | None = None  # N m or N
    velocity: float | None = None  # rad/s or m/s
    damping: float | None = None  # N m s/rad or N s/m
    mimic: str = ""


@dataclass(frozen=True)
class Inertial:
    mass: float
    com: Point
    moment: tuple[float, ...]  # xx, xy, xz, yy, yz, zz about the COM


@dataclass(frozen=True)
class Solid:
    """A box by its extents or a cylinder by radius and length, for collisions."""

    size: tuple[float, ...]
    xyz: Point = ORIGIN
    rpy: Point = ORIGIN


@dataclass(frozen=True)
class Link:
    """Without an inertial it weighs nothing."""

    name: str
    joint: Joint | None
    inertial: Inertial | None
    shape: str = ""
    solids: tuple[Solid, ...] = ()


def point_mass(mass: float, moment: float, last: float | None = None) -> Inertial:
    """Round figures: moment about x and y, and about z if it differs."""
    return Inertial(mass, ORIGIN, (moment, 0.0, 0.0, moment, 0.0, moment if last is None else last))


def fixed(name: str, parent: str, xyz: Point = ORIGIN, rpy: Point = ORIGIN) -> Joint:
    return Joint(name, "fixed", parent, xyz, rpy)


SENSOR = Inertial(0.001, ORIGIN, (0.0001, 0.0, 0.0, 0.000001, 0.0, 0.0001))
FRAME = point_mass(0.01, 0.001)
CASTER = (0.012411765597, -0.000711733678, 0.00050272983, 0.015218160428, -0.000004273467, 0.011763977943)

BASE = (
    Link("base_footprint", None, point_mass(1.0, 0.01)),
    Link(
        "base_link",
        fixed("base_footprint_joint", "base_footprint", (0.0, 0.0, 0.051)),
        Inertial(
            116.0,
            (-0.061, 0.0, 0.1465),
            (5.652232699207, -0.009719934438, 1.293988226423, 5.669473158652, -0.007379583694, 3.683196351726),
        ),
        "base",
        (Solid((0.66, 0.66, 0.27), (0.0, 0.0, 0.18)), Solid((0.235, 0.39, 0.38), (-0.2075, 0.0, 0.505))),
    ),
    Link(
        "base_bellow_link",
        fixed("base_bellow_joint", "base_link", (-0.29, 0.0, 0.8)),
        point_mass(1.0, 0.01),
        "bellow",
        (Solid((0.05, 0.37, 0.3)),),
    ),
    Link("base_laser_link", fixed("base_laser_joint", "base_link", (0.275, 0.0, 0.252)), SENSOR, "laser"),
)


def caster(end: str, side: str) -> list[Link]:
    """A caster of one corner with its two wheels; f and b are front and back."""
    name, sign = f"{end}{side}_caster", {"f": 1.0, "b": -1.0, "l": 1.0, "r": -1.0}
    corner = (sign[end] * 0.2246, sign[side] * 0.2246, 0.0282)
    turn = Joint(
        f"{name}_rotation_joint", "continuous", "base_link", corner, axis=Z, effort=6.5, velocity=10.0, damping=1.0
    )
    block = Solid((0.09, 0.054, 0.075), (0.0, 0.0, 0.0075))
    links = [Link(f"{name}_rotation_link", turn, Inertial(3.473082, (0.0, 0.0, 0.07), CASTER), "caster", (block,))]
    for wheel in "lr":
        roll = Joint(
            f"{name}_{wheel}_wheel_joint",
            "continuous",
            f"{name}_rotation_link",
            (0.0, sign[wheel] * 0.049, 0.0),
            axis=Y,
            effort=7.0,
            velocity=15.0,
            damping=1.0,
        )
        tyre = Solid((mesh_pr2.WHEEL, 0.034), rpy=ALONG_Y)
        links.append(Link(f"{name}_{wheel}_wheel_link", roll, Inertial(0.44036, ORIGIN, CASTER), "wheel", (tyre,)))
    return links


TORSO = (
    Link(
        "torso_lift_link",
        Joint(
            "torso_lift_joint",
            "prismatic",
            "base_link",
            (-0.05, 0.0, 0.739675),
            axis=Z,
            limits=(0.0, 0.33),
            effort=10000.0,
            velocity=0.013,
            damping=20000.0,
        ),
        Inertial(
            36.248046,
            (-0.1, 0.0, -0.0885),
            (2.771653750257, 0.004284522609, -0.160418504506, 2.510019507959, 0.029664468704, 0.526432355569),
        ),
        "torso",
        (
            Solid((0.14, 0.41, 0.68), (-0.145, 0.0, -0.06)),
            Solid((0.22, 0.41, 0.15), (-0.05, 0.0, 0.215)),
            Solid((0.19, 0.14, 0.49), (-0.035, 0.0, -0.085)),
        ),
    ),
    *(
        Link(
            f"{side}_torso_lift_side_plate_link",
            fixed(f"{side}_torso_lift_side_plate_joint", "torso_lift_link", (0.0535, sign * 0.209285, 0.176625)),
            Inertial(0.1, (-0.0625, 0.0, 0.05), (0.001, 0.0, 0.0, 0.001, 0.0, 0.001)),
            "side_plate",
        )
        for side, sign in (("l", 1.0), ("r", -1.0))
    ),
    Link(
        "torso_lift_motor_screw_link",
        Joint("torso_lift_motor_screw_joint", "continuous", "base_link", (-0.15, 0.0, 0.7), axis=Z, damping=0.0001),
        point_mass(1.0, 0.001),
        "screw",
    ),
    Link("imu_link", fixed("imu_joint", "torso_lift_link", (-0.02977, -0.1497, 0.164), (0.0, HALF, 0.0)), SENSOR),
    Link(
        "laser_tilt_mount_link",
        Joint(
            "laser_tilt_mount_joint",
            "revolute",
            "torso_lift_link",
            (0.09893, 0.0, 0.227),
            axis=Y,
            limits=(-0.7854, 1.48353),
            effort=0.65,
            velocity=10.0,
            damping=0.008,
        ),
        Inertial(
            0.591,
            (-0.001136, 0.00167, -0.00713),
            (0.001195273, 0.000023087, 0.000037467, 0.001083956, 0.000034906, 0.000795014),
        ),
        "tilt_mount",
        (Solid((0.06, 0.11, 0.08), (0.0, 0.0, 0.02)),),
    ),
    Link("laser_tilt_link", fixed("laser_tilt_joint", "laser_tilt_mount_link", (0.0, 0.0, 0.03)), SENSOR, "laser"),
)


def stereo(name: str, y: float) -> list[Link]:
    """A pair of cameras 9 cm apart; y is that of the left one."""
    base = f"{name}_stereo"
    camera = f"{base}_{{}}_stereo_camera"
    links = [
        Link(
            f"{base}_link",
            fixed(f"{base}_frame_joint", "double_stereo_link", (0.045, y, 0.0501)),
            point_mass(0.1, 0.01),
        ),
        Link(f"{base}_optical_frame", fixed(f"{base}_optical_frame_joint", f"{base}_link", rpy=OPTICAL), None),
    ]
    for side, parent, shift in (("l", f"{base}_link", 0.0), ("r", camera.format("l") + "_frame", -0.09)):
        frame = camera.format(side) + "_frame"
        optical = camera.format(side) + "_optical_frame"
        links += [
            Link(frame, fixed(f"{frame}_joint", parent, (0.0, shift, 0.0)), FRAME, "small_eye"),
            Link(optical, fixed(f"{optical}_joint", frame, rpy=OPTICAL), None),
        ]
    return links


def frame(name: str, parent: str, xyz: Point = ORIGIN, rpy: Point = ORIGIN, shape: str = "") -> Link:
    """A link that marks a place, of 10 g."""
    return Link(name, fixed(f"{name}_joint", parent, xyz, rpy), FRAME, shape)


HEAD = (
    Link(
        "head_pan_link",
        Joint(
            "head_pan_joint",
            "revolute",
            "torso_lift_link",
            (-0.01707, 0.0, 0.38145),
            axis=Z,
            limits=(-3.007, 3.007),
            effort=2.645,
            velocity=6.0,
            damping=0.5,
        ),
        Inertial(
            6.339,
            (0.010907, 0.031693, 0.090507),
            (0.032497592, 0.00063604088, 0.0025851534, 0.046545627, -0.0024534295, 0.057652724),
        ),
        "head_pan",
        (Solid((0.19, 0.25, 0.04), (0.0, 0.0, -0.02)),),
    ),
    Link(
        "head_tilt_link",
        Joint(
            "head_tilt_joint",
            "revolute",
            "head_pan_link",
            (0.068, 0.0, 0.0),
            axis=Y,
            limits=(-0.471238, 1.39626),
            effort=18.0,
            velocity=5.0,
            damping=10.0,
        ),
        Inertial(
            4.479,
            (0.001716, -0.019556, 0.055002),
            (0.024223222, 0.00062063507, -0.000096909696, 0.054723086, 0.002797024, 0.067306377),
        ),
        "head_tilt",
        (Solid((0.19, 0.2, 0.07), (-0.02, 0.0, 0.023)), Solid((0.12, 0.33, 0.09), (0.01, 0.0, 0.11))),
    ),
    frame("head_plate_frame", "head_tilt_link", (0.0232, 0.0, 0.0645), shape="head_plate"),
    Link(
        "sensor_mount_link",
        fixed("sensor_mount_frame_joint", "head_plate_frame"),
        point_mass(0.05, 0.001, 0.01),
        "sensor_mount",
    ),
    Link(
        "double_stereo_link",
        fixed("double_stereo_frame_joint", "sensor_mount_link"),
        point_mass(0.1, 0.001, 0.01),
        "double_stereo",
    ),
    *stereo("wide", 0.03),
    *stereo("narrow", 0.06),
    frame("high_def_frame", "sensor_mount_link", (0.046457, -0.11, 0.0546), shape="large_eye"),
    frame("high_def_optical_frame", "high_def_frame", rpy=OPTICAL),
    frame("projector_wg6802418_frame", "head_plate_frame", (0.0, 0.11, 0.0546)),
    frame("projector_wg6802418_child_frame", "projector_wg6802418_frame", rpy=(0.0, -QUARTER, 0.0)),
)


def hinge(
    name: str,
    parent: str,
    xyz: Point,
    axis: Point,
    limits: tuple[float, float] | None,
    effort: float,
    velocity: float,
    damping: float,
) -> Joint:
    """A joint of the arm; without limits it turns freely."""
    kind = "revolute" if limits else "continuous"
    return Joint(name, kind, parent, xyz, ORIGIN, axis, limits, effort, velocity, damping)


TURNTABLE = Inertial(0.1, ORIGIN, (0.01, 0.0, 0.0, 0.01, 0.0, 0.01))
ARM = (  # names and figures of the left one, without the prefix l_
    Link(
        "shoulder_pan_link",
        hinge(
            "shoulder_pan_joint",
            "torso_lift_link",
            (0.0, 0.188, 0.0),
            Z,
            (-0.714601836603, 2.2853981634),
            30.0,
            2.088,
            10.0,
        ),
        Inertial(
            25.799322,
            (-0.001201, 0.024513, -0.098231),
            (0.86617914248, -0.06086507933, -0.12118061183, 0.87421714893, -0.05886609911, 0.27353821674),
        ),
        "shoulder_pan",
        (Solid((0.108, 0.43), (0.0, 0.0, -0.09)),),
    ),
    Link(
        "shoulder_lift_link",
        hinge("shoulder_lift_joint", "shoulder_pan_link", (0.1, 0.0, 0.0), Y, (-0.5236, 1.3963), 30.0, 2.082, 10.0),
        Inertial(
            2.74988,
            (0.02195, -0.02664, -0.03127),
            (0.02105584615, 0.00496704022, -0.00194808955, 0.02127223737, 0.0011042549, 0.01975753814),
        ),
        "shoulder_lift",
        (Solid((0.083, 0.15), rpy=ALONG_Y),),
    ),
    Link(
        "upper_arm_roll_link",
        hinge("upper_arm_roll_joint", "shoulder_lift_link", ORIGIN, X, (-0.8, 3.9), 30.0, 3.27, 0.1),
        TURNTABLE,
        "upper_arm_roll",
    ),
    Link(
        "upper_arm_link",
        fixed("upper_arm_joint", "upper_arm_roll_link"),
        Inertial(
            6.01769,
            (0.21405, 0.01658, -0.00057),
            (0.01530603856, -0.00339324862, 0.00060765455, 0.07473694455, -0.00019953729, 0.07601594191),
        ),
        "upper_arm",
        (Solid((0.235, 0.16, 0.16), (0.2175, 0.0, 0.0)), Solid((0.11, 0.15, 0.1), (0.39, 0.0, 0.0))),
    ),
    Link(
        "elbow_flex_link",
        hinge("elbow_flex_joint", "upper_arm_link", (0.4, 0.0, 0.0), Y, (-2.3213, 0.0), 30.0, 3.3, 1.0),
        Inertial(
            1.90327,
            (0.01014, 0.00032, -0.01211),
            (0.00346541989, 0.00004066825, 0.00043171614, 0.00441606455, -0.00003968914, 0.00359156824),
        ),
        "elbow_flex",
        (Solid((0.05, 0.08), (0.04, 0.0, 0.0), ALONG_X),),
    ),
    Link(
        "forearm_roll_link",
        hinge("forearm_roll_joint", "elbow_flex_link", ORIGIN, X, None, 30.0, 3.6, 0.1),
        TURNTABLE,
        "forearm_roll",
    ),
    frame("forearm_cam_frame", "forearm_roll_link", (0.135, 0.0, 0.044), (-QUARTER, -0.562868683768, 0.0), "camera"),
    Link(
        "forearm_cam_optical_frame",
        fixed("forearm_cam_optical_frame_joint", "forearm_cam_frame", rpy=OPTICAL),
        None,
    ),
    Link(
        "forearm_link",
        fixed("forearm_joint", "forearm_roll_link"),
        Inertial(
            2.57968,
            (0.18791, -0.00017, -0.00912),
            (0.00364857222, 0.00005215877, 0.00071534842, 0.01507736897, -0.0000131077, 0.01659310749),
        ),
        "forearm",
        (Solid((0.055, 0.23), (0.205, 0.0, 0.0), ALONG_X),),
    ),
    Link(
        "wrist_flex_link",
        hinge("wrist_flex_joint", "forearm_link", (0.321, 0.0, 0.0), Y, (-2.18, 0.0), 10.0, 3.078, 0.1),
        Inertial(
            0.61402,
            (-0.00157, 0.0, -0.00075),
            (0.00065165722, 0.00000028864, 0.00000303477, 0.00019824443, -0.00000022645, 0.00064450498),
        ),
        "wrist_flex",
        (Solid((0.029, 0.064), rpy=ALONG_Y),),
    ),
    Link(
        "wrist_roll_link",
        hinge("wrist_roll_joint", "wrist_flex_link", ORIGIN, X, None, 10.0, 3.6, 0.1),
        TURNTABLE,
        "wrist_roll",
    ),
    Link(
        "gripper_palm_link",
        fixed("gripper_palm_joint", "wrist_roll_link"),
        Inertial(
            0.58007,
            (0.06623, 0.00053, -0.00119),
            (0.00035223921, -0.00001580476, -0.0000009175, 0.00067741312, -0.00000059554, 0.00086563316),
        ),
        "palm",
        (Solid((0.066, 0.12, 0.07), (0.079, 0.0, 0.0)),),
    ),
)


def finger_joint(name: str, parent: str, xyz: Point, axis: Point, damping: float) -> Joint:
    """The fingers and their tips follow the left finger."""
    leader = "gripper_l_finger_joint"
    return Joint(
        name,
        "revolute",
        parent,
        xyz,
        axis=axis,
        limits=(0.0, 0.548),
        effort=1000.0,
        velocity=0.5,
        damping=damping,
        mimic=leader if name != leader else "",
    )


def finger(side: str, inertial: Inertial) -> list[Link]:
    """A finger and its tip; the left one opens to the left."""
    sign = 1.0 if side == "l" else -1.0
    opening, closing = (Z, MINUS_Z) if side == "l" else (MINUS_Z, Z)
    name = f"gripper_{side}_finger"
    tip = Inertial(
        0.04419,
        (0.00423, sign * 0.00284, 0.0),
        (0.00000837047, sign * 0.00000583632, 0.0, 0.00000987067, 0.0, 0.00001541768),
    )
    base = finger_joint(f"{name}_joint", "gripper_palm_link", (0.07691, sign * 0.01, 0.0), opening, 0.02)
    end = finger_joint(f"{name}_tip_joint", f"{name}_link", (0.09137, sign * 0.00495, 0.0), closing, 0.001)
    rod = Solid((0.1, 0.02, 0.024), (0.045, sign * 0.017, 0.0))
    pad = Solid((0.03, 0.014, 0.022), (0.009, sign * 0.002, 0.0))
    return [
        Link(f"{name}_link", base, inertial, f"{side}_finger", (rod,)),
        Link(f"{name}_tip_link", end, tip, f"{side}_finger_tip", (pad,)),
    ]


GRIPPER = (
    *finger(
        "l",
        Inertial(
            0.17126,
            (0.03598, 0.0173, -0.00164),
            (0.00007756198, 0.00000149095, -0.00000983385, 0.00019708305, -0.00000306125, 0.00018105446),
        ),
    ),
    *finger(
        "r",
        Inertial(
            0.17389,
            (0.03576, -0.01736, -0.00095),
            (0.0000773841, -0.00000209309, -0.00000836228, 0.00019847383, 0.0000024611, 0.00018106988),
        ),
    ),
    Link("gripper_led_frame", fixed("gripper_led_joint", "gripper_palm_link", (0.0513, 0.0, 0.0244)), None),
    Link("gripper_tool_frame", fixed("gripper_tool_joint", "gripper_palm_link", (0.18, 0.0, 0.0)), None),
    Link(
        "gripper_motor_accelerometer_link",
        fixed("gripper_motor_accelerometer_joint", "gripper_palm_link"),
        point_mass(0.001, 0.001),
    ),
    Link(
        "gripper_motor_slider_link",
        Joint(
            "gripper_motor_slider_joint",
            "prismatic",
            "gripper_palm_link",
            (0.16828, 0.0, 0.0),
            axis=X,
            limits=(-0.1, 0.1),
            effort=1000.0,
            velocity=0.2,
        ),
        FRAME,
    ),
    Link(
        "gripper_motor_screw_link",
        Joint("gripper_motor_screw_joint", "continuous", "gripper_motor_slider_link", axis=Y, damping=0.0001),
        point_mass(0.01, 0.0001),
    ),
    Link(
        "gripper_l_finger_tip_frame",
        Joint(
            "gripper_joint",
            "prismatic",
            "gripper_r_finger_tip_link",
            axis=Y,
            limits=(0.0, 0.09),
            effort=1000.0,
            velocity=0.2,
            damping=10.0,
        ),
        point_mass(1.0, 1.0),  # as the engine has it, where none is published
    ),
)
RIGHT_UPPER_ARM = Inertial(
    6.01769,
    (0.21398, -0.01621, -0.0002),
    (0.01537748957, 0.00375711247, -0.00070852914, 0.0747367044, -0.0001793645, 0.07608763307),
)


def with_prefix(link: Link, side: str) -> Link:
    """The link of an arm with the names of its side."""
    assert link.joint is not None
    parent = link.joint.parent if link.joint.parent == "torso_lift_link" else f"{side}_{link.joint.parent}"
    mimic = f"{side}_{link.joint.mimic}" if link.joint.mimic else ""
    joint = replace(link.joint, name=f"{side}_{link.joint.name}", parent=parent, mimic=mimic)
    return replace(link, name=f"{side}_{link.name}", joint=joint)


def right_arm(link: Link) -> Link:
    """What differs on the right: the place, the ranges of pan and roll, the camera's side, the upper arm."""
    assert link.joint is not None
    joint = link.joint
    if link.name == "shoulder_pan_link":
        joint = replace(joint, xyz=(joint.xyz[0], -joint.xyz[1], joint.xyz[2]))
    if link.name in ("shoulder_pan_link", "upper_arm_roll_link") and joint.limits:
        joint = replace(joint, limits=(-joint.limits[1], -joint.limits[0]))
    if link.name == "forearm_cam_frame":
        joint = replace(joint, rpy=(-joint.rpy[0], *joint.rpy[1:]))
    inertial = RIGHT_UPPER_ARM if link.name == "upper_arm_link" else link.inertial
    return replace(link, joint=joint, inertial=inertial)


def links() -> list[Link]:
    """All links.  DART orders the children of a link by the names of their joints, not as in the file."""
    casters = [link for end in "fb" for side in "lr" for link in caster(end, side)]
    left = [with_prefix(link, "l") for link in (*ARM, *GRIPPER)]
    right = [with_prefix(right_arm(link), "r") for link in (*ARM, *GRIPPER)]
    return [*BASE, *casters, *TORSO, *HEAD, *left, *right]


def text(values: Sequence[float]) -> str:
    return " ".join(f"{v + 0.0:.12g}" for v in values)


def attributes(values: dict[str, float]) -> str:
    return " ".join(f'{name}="{text([v])}"' for name, v in values.items())


def origin(xyz: Point, rpy: Point) -> list[str]:
    turned = f' rpy="{text(rpy)}"' if any(rpy) else ""
    return [f'<origin xyz="{text(xyz)}"{turned}/>'] if any(xyz) or turned else []


def solid_text(solid: Solid) -> list[str]:
    if len(solid.size) == 3:
        geometry = f'<box size="{text(solid.size)}"/>'
    else:
        geometry = f'<cylinder radius="{solid.size[0]:.12g}" length="{solid.size[1]:.12g}"/>'
    return ["<collision>", *origin(solid.xyz, solid.rpy), f"<geometry>{geometry}</geometry>", "</collision>"]


def link_text(link: Link) -> list[str]:
    lines = []
    if link.inertial:
        moment = dict(zip(("ixx", "ixy", "ixz", "iyy", "iyz", "izz"), link.inertial.moment))
        lines += ["<inertial>", *origin(link.inertial.com, ORIGIN), f'<mass value="{link.inertial.mass:.12g}"/>']
        lines += [f"<inertia {attributes(moment)}/>", "</inertial>"]
    if link.shape:
        mesh = f'<mesh filename="../../{FOLDER}/{link.shape}.obj"/>'
        lines += ["<visual>", f"<geometry>{mesh}</geometry>", "</visual>"]
    for solid in link.solids:
        lines += solid_text(solid)
    return [f'<link name="{link.name}">', *lines, "</link>"] if lines else [f'<link name="{link.name}"/>']


def joint_text(link: Link) -> list[str]:
    joint = link.joint
    if joint is None:
        return []
    lines = [f'<parent link="{joint.parent}"/>', f'<child link="{link.name}"/>', *origin(joint.xyz, joint.rpy)]
    if joint.axis:
        lines.append(f'<axis xyz="{text(joint.axis)}"/>')
    if joint.effort is not None:
        limits = dict(zip(("lower", "upper"), joint.limits or ()))
        lines.append(f"<limit {attributes({'effort': joint.effort, 'velocity': joint.velocity or 0.0, **limits})}/>")
    if joint.damping is not None:
        lines.append(f'<dynamics damping="{joint.damping:.12g}"/>')
    if joint.mimic:
        lines.append(f'<mimic joint="{joint.mimic}" multiplier="1" offset="0"/>')
    return [f'<joint name="{joint.name}" type="{joint.kind}">', *lines, "</joint>"]


def indented(lines: list[str], depth: int = 1) -> list[str]:
    """The lines of nested elements, each a step deeper than the one around it."""
    out = []
    for line in lines:
        if line.startswith("</"):
            depth -= 1
        out.append("  " * depth + line)
        if not line.startswith("</") and not line.endswith("/>") and "</" not in line:
            depth += 1
    return out


def urdf_text() -> str:
    content = [line for link in links() for line in (*link_text(link), *joint_text(link))]
    head = ['<?xml version="1.0"?>', "<!-- PR2. Written by tools/make_pr2.py; change the figures there. -->"]
    return "\n".join([*head, '<robot name="pr2">', *indented(content), "</robot>"]) + "\n"


def main(data: Path) -> None:
    tool = "Written by tools/make_pr2.py."
    files = {
        "urdf/PR2/pr2.urdf": urdf_text(),
        f"{FOLDER}/{LIBRARY}": library_text(f"Colours of PR2. {tool}", mesh_pr2.MATERIALS.items()),
    }
    for name, shape in mesh_pr2.SHAPES.items():
        files[f"{FOLDER}/{name}.obj"] = obj_text(f"Visual shape {name} of PR2. {tool}", LIBRARY, shape())
    for name, content in files.items():
        (data / name).parent.mkdir(parents=True, exist_ok=True)
        (data / name).write_text(content, encoding="ascii", newline="\n")
    print(f"{len(files)} files, {sum(map(len, files.values()))} bytes")


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).parents[1] / "data")
