"""Writes fullbody1.skel, a humanoid on a floor, and the meshes of its bodies below the data folder.

    python3 tools/make_fullbody1.py [data folder]

The humanoid has DART's published figures: each body is a uniform box, for its inertia as for
collisions.  Left and right limbs are mirror images, so a limb is stated once, for the left side.
Joints are damped about half as much as keeps their limb from swinging: without any the limp humanoid
never comes to rest, and in one of four falls a forearm spins until a step of 1 ms is too long.  Damping
alone lets what gravity hardly turns go on slowly for minutes, so joints have dry friction, too.
What is drawn comes from mesh_human.py.  y points up, x forward and z to the right.  Equal input gives
equal bytes.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import mesh_human
from make_skel import (
    Lines,
    alone,
    block,
    body,
    box_moment,
    drawn,
    inertia,
    joint,
    leaf,
    mesh_file,
    shape,
    sized,
    skeleton,
    solid,
    text,
    world,
)
from mesh import Mesh, Point, obj_text
from mesh_rounded import library_text

FLOOR = 10.0  # m, side of the floor
FOLDER = "obj/fullbody1"


@dataclass(frozen=True)
class Part:
    """A body of the humanoid and the joint to its parent.

    The place is that of the joint in the world at zero pose.  The box is around the COM, and the
    body leans about the x axis, from the vertical to the left.
    """

    name: str
    parent: str
    kind: str
    axes: str  # of the joint, as letters, first to last
    place: Point
    mass: float
    com: Point
    box: Point
    start: float = 0.0  # initial position of the joint's first dof, rad
    lean: float = 0.0
    hinge: float = 0.0  # angle of the joint's frame in the body about x


ABDOMEN, SPINE = (0.0, 0.0562, 0.0), (0.0, 0.3069, 0.0)
TRUNK = (
    Part("pelvis", "", "free", "", (0.0, 0.0, 0.0), 5.6154, (0.0, 0.0, 0.0), (0.1088, 0.1088, 0.23936)),
    Part("abdomen", "pelvis", "universal", "xz", ABDOMEN, 4.1846, (0.0, 0.12535, 0.0), (0.12535, 0.2507, 0.17549)),
    Part("spine", "abdomen", "revolute", "y", SPINE, 4.8608, (0.0, 0.0908, 0.0), (0.0908, 0.1816, 0.0908)),
    Part("head", "spine", "universal", "zx", (0.0, 0.4885, 0.0), 3.92, (0.0, 0.07825, 0.0), (0.101725, 0.1565, 0.1252)),
)

HIP_X, HIP_Z, ARM_Z = 0.01649408, -0.09072832, -0.169809


def leg(name: str, parent: str, kind: str, axes: str, y: float, mass: float, length: float, width: float) -> Part:
    """A segment that hangs from its joint."""
    start = -0.17 if name == "shin" else 0.0
    return Part(
        name, parent, kind, axes, (HIP_X, y, HIP_Z), mass, (0.0, -length / 2, 0.0), (width, length, width), start
    )


def arm(
    name: str, parent: str, kind: str, axes: str, y: float, mass: float, length: float, width: float, hinge: float = 0.0
) -> Part:
    box = (width, length, width)
    return Part(name, parent, kind, axes, (0.0, y, ARM_Z), mass, (0.0, -length / 2, 0.0), box, hinge=hinge)


LEG = (
    leg("thigh", "pelvis", "euler", "zyx", -0.05774016, 6.5709, 0.3721, 0.093025),
    leg("shin", "thigh", "revolute", "z", -0.42984016, 1.7738, 0.3737, 0.07474),
    Part(
        "heel",
        "shin",
        "universal",
        "zy",
        (HIP_X, -0.80354016, HIP_Z),
        0.5831,
        (0.0216, -0.0216, 0.0),
        (0.108, 0.054, 0.108),
    ),
    Part(
        "toe",
        "heel",
        "revolute",
        "z",
        (HIP_X + 0.11, -0.80354016, HIP_Z),
        0.5,
        (0.02, -0.02, 0.0),
        (0.1, 0.05, 0.08),
    ),
)
ARM = (
    Part(
        "scapula",
        "spine",
        "revolute",
        "x",
        SPINE,
        2.6264,
        (0.0, 0.09615, 0.0),
        (0.09615, 0.1923, 0.09615),
        lean=-0.9423,
    ),
    arm("bicep", "scapula", "euler", "zyx", 0.397146, 1.6219, 0.2616, 0.07848, hinge=-1.2423),
    arm("forearm", "bicep", "revolute", "z", 0.135546, 0.6909, 0.2024, 0.0506),
    arm("hand", "forearm", "revolute", "x", -0.066854, 0.294, 0.1319, 0.032975),
)
# N m s/rad, of each axis
DAMPING = {
    "abdomen": 3.0,
    "spine": 2.0,
    "head": 0.4,
    "thigh": 3.0,
    "shin": 1.0,
    "heel": 0.1,
    "toe": 0.02,
    "scapula": 1.0,
    "bicep": 0.6,
    "forearm": 0.15,
    "hand": 0.02,
}
LEAST_FRICTION, KNEE_FRICTION = 1.0, 0.3  # N m; of other joints as much as their damping at 1 rad/s
DOFS = {"free": 6, "euler": 3, "universal": 2, "revolute": 1}
AXES = {"x": (1, 0, 0), "y": (0, 1, 0), "z": (0, 0, 1)}


def full_name(prefix: str, part: str, side: str) -> str:
    """As h_spine or j_thigh_left."""
    limb = part not in mesh_human.TRUNK
    return f"{prefix}_{part}_{side}" if limb else f"{prefix}_{part}"


def frame_text(part: Part) -> list[Lines]:
    """What a joint says about its axes and where it starts."""
    if part.kind == "free":
        return []
    damping = DAMPING[part.name]
    friction = KNEE_FRICTION if part.name == "shin" else max(damping, LEAST_FRICTION)
    dynamics = block("dynamics", leaf("damping", damping), leaf("friction", friction))
    names = ("axis", "axis2", "axis3")
    if part.kind == "euler":
        axes = [leaf("axis_order", part.axes), *(block(name, dynamics) for name in names)]
    else:
        axes = [block(name, leaf("xyz", text(AXES[axis])), dynamics) for name, axis in zip(names, part.axes)]
    start = [part.start] + [0.0] * (DOFS[part.kind] - 1)
    return [*axes, leaf("init_pos", text(start))] if part.start else axes


def mirror(sign: float, values: Sequence[float]) -> tuple[float, ...]:
    return (values[0], values[1], sign * values[2] + 0.0)


def part_text(part: Part, side: str) -> tuple[Lines, Lines]:
    """The joint and the body of a part on one side, or of the trunk."""
    sign = -1.0 if side == "right" else 1.0
    name = full_name("h", part.name, side)
    parent = full_name("h", part.parent, side) if part.parent else "world"
    hinge = [leaf("transformation", text([0, 0, 0, sign * part.hinge, 0, 0]))] if part.hinge else []
    moment = box_moment(part.mass, part.box)
    content = (
        inertia(part.mass, part.com, moment),
        drawn(mesh_file(f"../{FOLDER}/{name}.obj")),
        solid(sized("box", *part.box), part.com),
    )
    place = (*mirror(sign, part.place), sign * part.lean + 0.0, 0, 0)
    return (
        joint(full_name("j", part.name, side), part.kind, parent, name, *hinge, *frame_text(part)),
        body(name, place, *content),
    )


def parts() -> list[tuple[Part, str]]:
    """All parts with their sides; DART keeps this order: pelvis, legs, trunk, arms."""
    legs = [(part, side) for side in ("left", "right") for part in LEG]
    arms = [(part, side) for side in ("left", "right") for part in ARM]
    trunk = [(part, "") for part in TRUNK]
    return [trunk[0], *legs, *trunk[1:], *arms]


def floor() -> Lines:
    """A box with tiles on it, whose joint is free as published; it does not move."""
    size = sized("box", FLOOR, 0.05, FLOOR)
    tiles = shape("visualization_shape", mesh_file("../obj/fullbody1/ground.obj"), (0, 0.025, 0))
    parts = alone("ground", (0, -0.92, 0, 0, 0, 0), "free", tiles, solid(size))
    return skeleton("ground skeleton", leaf("mobile", "false"), *parts)


def skel_text() -> str:
    humanoid = skeleton("fullbody1", *(lines for part, side in parts() for lines in part_text(part, side)))
    return world("A humanoid above a floor.", "fcl_mesh", floor(), humanoid, tool="make_fullbody1.py")


def meshes(part: str, side: str) -> list[Mesh]:
    """What is drawn of a part, in the frame of its body."""
    left = mesh_human.TRUNK[part]() if part in mesh_human.TRUNK else mesh_human.LIMB[part]()
    return [mesh_human.y_up(m.mirrored() if side == "right" else m) for m in left]


def main(data: Path) -> None:
    tool = "Written by tools/make_fullbody1.py."
    colours = mesh_human.MATERIALS | mesh_human.GROUND
    files = {
        "skel/fullbody1.skel": skel_text(),
        f"{FOLDER}/fullbody1.mtl": library_text(f"Colours of the humanoid and its floor. {tool}", colours.items()),
    }
    solids = {full_name("h", part.name, side): meshes(part.name, side) for part, side in parts()}
    solids["ground"] = [mesh_human.y_up(m) for m in mesh_human.ground(FLOOR / 2)]
    for name, solid_parts in solids.items():
        files[f"{FOLDER}/{name}.obj"] = obj_text(f"Visual shape of {name}. {tool}", "fullbody1.mtl", solid_parts)
    for name, content in files.items():
        (data / name).parent.mkdir(parents=True, exist_ok=True)
        (data / name).write_text(content, encoding="ascii", newline="\n")
    print(f"{len(files)} files, {sum(map(len, files.values()))} bytes")


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).parents[1] / "data")
