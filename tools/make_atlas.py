"""Writes the SDF model of Atlas and the meshes of its links below the data folder.

    python3 tools/make_atlas.py [data folder]

The model has the published figures of the Atlas v3 of the DRC simulator without its head.  Left
and right limbs are mirror images, so a limb is stated once, for the left side.  Meshes come from
mesh_atlas.py.  Equal input gives equal bytes.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import mesh_atlas
from mesh import Mesh, Point, obj_text

VELOCITY = 12.0  # rad/s, the limit of every joint
DAMPING = 0.1  # N m s/rad, of every joint
SHOULDER = 0.866025  # cos 30 deg as published, so that the loaded axis is the published one
LIBRARY = "atlas.mtl"


@dataclass(frozen=True)
class Box:
    """A box for collisions by its extents in the frame of its link."""

    x: tuple[float, float]
    y: tuple[float, float]
    z: tuple[float, float]


@dataclass(frozen=True)
class Link:
    """A link with the revolute joint to its parent.  All frames are parallel in the zero pose."""

    name: str
    parent: str
    joint: str
    axis: Point
    limits: tuple[float, float]  # rad
    effort: float  # N m
    origin: Point  # in the model frame
    mass: float  # kg
    com: Point
    inertia: tuple[float, float, float, float, float, float]  # xx, xy, xz, yy, yz, zz about the COM
    boxes: tuple[Box, ...]


X, Y, Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)
TWIST = (0.00656, 0.0, 0.0, 0.00358, 0.0, 0.00656)  # upper arm and forearm
ELBOW = (0.00265, 0.0, 0.0, 0.00446, 0.0, 0.00446)  # elbow and hand

# The boxes of links that are not neighbours stay apart in the zero pose; so the pelvis has its box above
# the hips and the hip yaw bracket ends above the thigh.
TRUNK = (
    Link(
        "pelvis",
        "",
        "",
        Z,
        (0.0, 0.0),
        0.0,
        (0.0, 0.0, 0.0),
        17.882,
        (0.0111, 0.0, 0.0271),
        (0.1244, 0.0008, -0.0007, 0.0958, -0.0005, 0.1167),
        (Box((-0.156, 0.173), (-0.11, 0.11), (0.026, 0.12)),),
    ),
    Link(
        "ltorso",
        "pelvis",
        "back_bkz",
        Z,
        (-0.663225, 0.663225),
        124.016,
        (-0.0125, 0.0, 0.0),
        2.409,
        (-0.0112984, -3.15366e-06, 0.0746835),
        (0.0039092, -5.04491e-08, -0.000342157, 0.00341694, 4.87119e-07, 0.00174492),
        (Box((-0.04, 0.038), (-0.054, 0.018), (-0.01, 0.074)),),
    ),
    Link(
        "mtorso",
        "ltorso",
        "back_bky",
        Y,
        (-0.610691, 0.438427),
        206.843,
        (-0.0125, 0.0, 0.16197),
        0.69,
        (-0.00816266, -0.0131245, 0.0305974),
        (0.000454181, -6.10764e-05, 3.94009e-05, 0.000483282, 5.27463e-05, 0.000444215),
        (Box((-0.017, 0.02), (-0.018, 0.014), (-0.014, 0.062)),),
    ),
    Link(
        "utorso",
        "mtorso",
        "back_bkx",
        X,
        (-0.698132, 0.698132),
        200.0,
        (-0.0125, 0.0, 0.21197),
        52.307,
        (-0.0909481, 5.04713e-05, 0.301106),
        (1.4846, 0.00338676, 0.326214, 1.54533, 3.95833e-05, 1.32284),
        (
            Box((-0.13, 0.22), (-0.135, 0.135), (0.032, 0.4)),
            Box((-0.34, -0.13), (-0.195, 0.195), (0.1, 0.626)),
            Box((-0.13, 0.24), (-0.15, 0.15), (0.4, 0.732)),
        ),
    ),
)

LIMBS = (  # an arm, then a leg; names and figures of the left one
    Link(
        "clav",
        "utorso",
        "arm_shy",
        (0.0, 0.5, SHOULDER),
        (-1.5708, 0.785398),
        212.0,
        (0.05191, 0.13866, 0.31915),
        3.45,
        (0.0, 0.048, 0.084),
        (0.011, 0.0, 0.0, 0.009, -0.004, 0.004),
        (Box((-0.066, 0.05), (0.035, 0.189), (0.1, 0.24)),),
    ),
    Link(
        "scap",
        "clav",
        "arm_shx",
        X,
        (-1.5708, 1.5708),
        170.0,
        (0.05191, 0.27901, 0.51524),
        3.012,
        (0.0, 0.0, 0.0),
        (0.00319, 0.0, 0.0, 0.00583, 0.0, 0.00583),
        (Box((-0.068, 0.07), (-0.034, 0.187), (-0.024, 0.054)),),
    ),
    Link(
        "uarm",
        "scap",
        "arm_ely",
        Y,
        (0.0, 3.14159),
        114.0,
        (0.05191, 0.46601, 0.53124),
        3.388,
        (0.0, -0.065, 0.0),
        TWIST,
        (Box((-0.055, 0.052), (-0.01, 0.157), (-0.044, 0.044)),),
    ),
    Link(
        "larm",
        "uarm",
        "arm_elx",
        X,
        (0.0, 2.35619),
        114.0,
        (0.05191, 0.58501, 0.54045),
        2.509,
        (0.0, 0.0, 0.0),
        ELBOW,
        (Box((-0.064, 0.064), (-0.034, 0.188), (-0.04, 0.04)),),
    ),
    Link(
        "farm",
        "larm",
        "arm_wry",
        Y,
        (0.0, 3.14159),
        114.0,
        (0.05191, 0.77201, 0.53124),
        3.388,
        (0.0, -0.065, 0.0),
        TWIST,
        (Box((-0.051, 0.056), (0.0, 0.168), (-0.037, 0.049)),),
    ),
    Link(
        "hand",
        "farm",
        "arm_wrx",
        X,
        (-1.1781, 1.1781),
        60.0,
        (0.05191, 0.89101, 0.54045),
        2.509,
        (0.0, 0.0, 0.0),
        ELBOW,
        (Box((-0.068, 0.066), (-0.035, 0.125), (-0.03, 0.038)),),
    ),
    Link(
        "uglut",
        "pelvis",
        "leg_hpz",
        Z,
        (-0.174533, 1.22173),
        110.0,
        (0.0, 0.089, 0.0),
        0.648,
        (0.00529262, -0.00344732, 0.00313046),
        (0.00074276, -3.79607e-08, -2.79549e-05, 0.000688179, -3.2735e-08, 0.00041242),
        (Box((-0.022, 0.024), (-0.025, 0.018), (-0.028, 0.057)),),
    ),
    Link(
        "lglut",
        "uglut",
        "leg_hpx",
        X,
        (-0.523599, 0.523599),
        180.0,
        (0.0, 0.089, 0.0),
        0.866,
        (0.0133341, 0.0170484, -0.0312052),
        (0.000691326, -2.24344e-05, 2.50508e-06, 0.00126856, 0.000137862, 0.00106487),
        (Box((-0.055, 0.075), (-0.016, 0.052), (-0.08, 0.024)),),
    ),
    Link(
        "uleg",
        "lglut",
        "leg_hpy",
        Y,
        (-1.72072, 0.524821),
        260.0,
        (0.05, 0.089, -0.05),
        9.209,
        (0.0, 0.0, -0.21),
        (0.09, 0.0, 0.0, 0.09, 0.0, 0.02),
        (Box((-0.09, 0.075), (-0.07, 0.11), (-0.36, 0.02)),),
    ),
    Link(
        "lleg",
        "uleg",
        "leg_kny",
        Y,
        (0.0, 2.38569),
        220.0,
        (0.0, 0.089, -0.424),
        5.479,
        (0.001, 0.0, -0.187),
        (0.077, 0.0, -0.003, 0.076, 0.0, 0.01),
        (Box((-0.042, 0.085), (-0.052, 0.052), (-0.4, 0.024)),),
    ),
    Link(
        "talus",
        "lleg",
        "leg_aky",
        Y,
        (-1.0, 0.7),
        700.0,
        (0.0, 0.089, -0.846),
        0.125,
        (0.0, 0.0, 0.0),
        (1.01674e-05, 0.0, 0.0, 8.42775e-06, 0.0, 1.30101e-05),
        (Box((-0.041, 0.012), (-0.023, 0.023), (-0.026, 0.013)),),
    ),
    Link(
        "foot",
        "talus",
        "leg_akx",
        X,
        (-0.8, 0.8),
        90.0,
        (0.0, 0.089, -0.846),
        2.05,
        (0.027, 0.0, -0.067),
        (0.002, 0.0, 0.0, 0.007, 0.0, 0.008),
        (Box((-0.084, 0.179), (-0.065, 0.065), (-0.081, -0.027)),),
    ),
)


def flip(v: float) -> float:
    """The negative, without a negative zero."""
    return -v if v else 0.0


def mirror_point(p: Point) -> Point:
    return p[0], flip(p[1]), p[2]


def mirror_axis(axis: Point, limits: tuple[float, float]) -> tuple[Point, tuple[float, float]]:
    """A turn mirrors as a pseudovector; axes x and z keep their sign, so their limits change sign."""
    if axis in (X, Z):
        return axis, (flip(limits[1]), flip(limits[0]))
    return (flip(axis[0]), axis[1], flip(axis[2])), limits


def limb(link: Link, side: str) -> Link:
    """The left (l) or right (r) link of a limb."""
    parent = link.parent if link.parent in {t.name for t in TRUNK} else f"{side}_{link.parent}"
    named = replace(link, name=f"{side}_{link.name}", parent=parent, joint=f"{side}_{link.joint}")
    if side == "l":
        return named
    xx, xy, xz, yy, yz, zz = link.inertia
    axis, limits = mirror_axis(link.axis, link.limits)
    boxes = tuple(replace(b, y=(-b.y[1], -b.y[0])) for b in link.boxes)
    return replace(
        named,
        axis=axis,
        limits=limits,
        origin=mirror_point(link.origin),
        com=mirror_point(link.com),
        inertia=(xx, flip(xy), xz, yy, flip(yz), zz),
        boxes=boxes,
    )


def links() -> list[Link]:
    """All links, parents first: trunk, left arm, right arm, left leg, right leg."""
    arm, leg = LIMBS[:6], LIMBS[6:]
    return [*TRUNK, *(limb(link, side) for part in (arm, leg) for side in "lr" for link in part)]


def meshes(name: str) -> list[Mesh]:
    """The visual parts of a link."""
    if name in mesh_atlas.TRUNK:
        return mesh_atlas.TRUNK[name]()
    side, _, part = name.partition("_")
    left = mesh_atlas.LIMB[part]()
    return left if side == "l" else [mesh.mirrored() for mesh in left]


def text(values: Sequence[float]) -> str:
    return " ".join(f"{v:.12g}" for v in values)


def collision(link: Link, number: int, box: Box) -> list[str]:
    """A collision element.  A box is the one shape that all of DART's collision detectors know."""
    suffix = f"_{number}" if number else ""
    centre = [(low + high) / 2.0 for low, high in (box.x, box.y, box.z)]
    size = [high - low for low, high in (box.x, box.y, box.z)]
    return [
        f'      <collision name="{link.name}_collision{suffix}">',
        f"        <pose>{text(centre)} 0 0 0</pose>",
        f"        <geometry><box><size>{text(size)}</size></box></geometry>",
        "      </collision>",
    ]


def link_text(link: Link) -> list[str]:
    keys = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
    inertia = "".join(f"<{k}>{v:.12g}</{k}>" for k, v in zip(keys, link.inertia))
    lines = [
        f'    <link name="{link.name}">',
        f"      <pose>{text(link.origin)} 0 0 0</pose>",
        "      <inertial>",
        f"        <pose>{text(link.com)} 0 0 0</pose>",
        f"        <mass>{link.mass:.12g}</mass>",
        f"        <inertia>{inertia}</inertia>",
        "      </inertial>",
        f'      <visual name="{link.name}_visual">',
        f"        <geometry><mesh><uri>../../obj/atlas/{link.name}.obj</uri></mesh></geometry>",
        "      </visual>",
    ]
    for number, box in enumerate(link.boxes):
        lines += collision(link, number, box)
    return [*lines, "    </link>"]


def joint_text(link: Link) -> list[str]:
    values = (*link.limits, link.effort, VELOCITY)
    limit = "".join(
        f"<{k}>{v:.12g}</{k}>" for k, v in zip(("lower", "upper", "effort", "velocity"), values, strict=True)
    )
    return [
        f'    <joint name="{link.joint}" type="revolute">',
        f"      <parent>{link.parent}</parent>",
        f"      <child>{link.name}</child>",
        "      <axis>",
        f"        <xyz>{text(link.axis)}</xyz>",
        f"        <limit>{limit}</limit>",
        f"        <dynamics><damping>{DAMPING:.12g}</damping></dynamics>",
        "      </axis>",
        "    </joint>",
    ]


def sdf_text() -> str:
    lines = [
        '<?xml version="1.0"?>',
        "<!-- Atlas v3 without its head. Written by tools/make_atlas.py; change the figures there. -->",
        '<sdf version="1.4">',
        '  <model name="drc_skeleton">',
    ]
    for link in links():
        lines += link_text(link)
        if link.parent:
            lines += joint_text(link)
    return "\n".join([*lines, "  </model>", "</sdf>"]) + "\n"


def library_text() -> str:
    lines = ["# Colours of Atlas. Written by tools/make_atlas.py."]
    for name, colour in mesh_atlas.MATERIALS.items():
        lines += ["", f"newmtl {name}", f"Ka {text(colour)}", f"Kd {text(colour)}", "Ks 0.15 0.15 0.15", "Ns 20"]
    return "\n".join(lines) + "\n"


def main(data: Path) -> None:
    model, shapes = data / "sdf" / "atlas" / "atlas_v3_no_head.sdf", data / "obj" / "atlas"
    files = {model: sdf_text(), shapes / LIBRARY: library_text()}
    for link in links():
        title = f"Visual shape of {link.name} of Atlas. Written by tools/make_atlas.py."
        files[shapes / f"{link.name}.obj"] = obj_text(title, LIBRARY, meshes(link.name))
    for path, content in files.items():
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(content, encoding="ascii", newline="\n")
    print(f"{len(files)} files, {sum(map(len, files.values()))} bytes")


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).parents[1] / "data")
