"""Writes the small SKEL worlds below the data folder: chain, softBodies, shapes and ground.

    python3 tools/make_skel.py [data folder]

The worlds have DART's published figures; make_fullbody1.py writes the humanoid's.  Equal input
gives equal bytes.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from mesh import Mesh, Point, obj_text
from mesh_rounded import library_text, limb

FOOT_LOW, FOOT_HIGH = (-0.1702, -0.09548, -0.08095), (0.09082, 0.04576, 0.07216)  # the extents of DART's foot.obj
PALE, RED, GREEN, YELLOW, BLUE = (0.95, 0.95, 0.95), (0.8, 0.3, 0.3), (0.3, 0.8, 0.3), (0.8, 0.8, 0.4), (0.6, 0.6, 0.8)

Lines = list[str]


def text(values: Sequence[float]) -> str:
    return " ".join(f"{v:.12g}" for v in values)


def leaf(name: str, value: str | float) -> Lines:
    """An element with a value, on one line."""
    return [f"<{name}>{value if isinstance(value, str) else text([value])}</{name}>"]


def block(head: str, *parts: Lines) -> Lines:
    """An element with others inside; the head is its name and attributes."""
    return [f"<{head}>", *(f"  {line}" for part in parts for line in part), f"</{head.split()[0]}>"]


def sized(kind: str, *size: float) -> str:
    """A box or an ellipsoid by its extents along x, y and z."""
    return f"<{kind}><size>{text(size)}</size></{kind}>"


def round_solid(kind: str, radius: float, height: float) -> str:
    """A cylinder, capsule or cone along z."""
    return f"<{kind}><radius>{text([radius])}</radius><height>{text([height])}</height></{kind}>"


def mesh_file(path: str) -> str:
    return f"<mesh><file_name>{path}</file_name><scale>1 1 1</scale></mesh>"


def shape(use: str, geometry: str, place: Sequence[float] = (), colour: Sequence[float] = ()) -> Lines:
    """A visualization_shape or a collision_shape; its place in the body is x, y, z."""
    return block(
        use,
        leaf("transformation", text([*place, 0, 0, 0])) if place else [],
        leaf("geometry", geometry),
        leaf("color", text(colour)) if colour else [],
    )


def drawn(geometry: str, place: Sequence[float] = (), colour: Sequence[float] = ()) -> Lines:
    return shape("visualization_shape", geometry, place, colour)


def solid(geometry: str, place: Sequence[float] = ()) -> Lines:
    return shape("collision_shape", geometry, place)


def inertia(mass: float, com: Sequence[float] = (0, 0, 0), moment: Sequence[float] = ()) -> Lines:
    """Without a moment (xx, yy, zz about the COM) DART takes that of the first shape."""
    axes = "".join(f"<{k}>{text([v])}</{k}>" for k, v in zip(("ixx", "iyy", "izz"), moment))
    return block(
        "inertia",
        leaf("mass", mass),
        leaf("offset", text(com)),
        leaf("moment_of_inertia", axes + "<ixy>0</ixy><ixz>0</ixz><iyz>0</iyz>") if moment else [],
    )


def body(name: str, place: Sequence[float], *parts: Lines) -> Lines:
    """A body; its place in the world is x, y, z and the angles about x, y, z."""
    return block(f'body name="{name}"', leaf("transformation", text(place)), *parts)


def joint(name: str, kind: str, parent: str, child: str, *parts: Lines) -> Lines:
    return block(f'joint name="{name}" type="{kind}"', leaf("parent", parent), leaf("child", child), *parts)


def alone(name: str, place: Sequence[float], kind: str, *parts: Lines) -> tuple[Lines, Lines]:
    """A body and the joint that connects it with the world."""
    return joint("joint 1", kind, "world", name), body(name, place, *parts)


def skeleton(name: str, *parts: Lines) -> Lines:
    return block(f'skeleton name="{name}"', *parts)


def floor(height: float, size: Sequence[float], offset: Sequence[float] = ()) -> Lines:
    """A pale box that is welded to the world."""
    box = sized("box", *size)
    parts = drawn(box, offset, PALE), solid(box, offset)
    return skeleton("ground skeleton", *alone("ground", (0, height, 0, 0, 0, 0), "weld", *parts))


def world(comment: str, detector: str, *skeletons: Lines, tool: str = "make_skel.py") -> str:
    """The text of a SKEL file; the time step is 1 ms."""
    comment += f" y points up. Written by tools/{tool}; change the figures there."
    detection = leaf("collision_detector", detector)
    settings = block("physics", leaf("time_step", 0.001), leaf("gravity", "0 -9.81 0"), detection)
    lines = block('skel version="1.0"', block('world name="world 1"', settings, *skeletons))
    return "\n".join(['<?xml version="1.0"?>', f"<!-- {comment} -->", *lines]) + "\n"


def chain() -> str:
    """Ten links in a row, held at the upper end of the first."""
    length, links = 0.05, range(1, 11)
    parts = []
    for k in links:
        hinge = leaf("transformation", text([0, length / 2, 0, 0, 0, 0]))
        parts.append(joint(f"joint {k}", "ball", "world" if k == 1 else f"link {k - 1}", f"link {k}", hinge))
        place = (0, -length * (k - 1), 0, 0, 0, 0)
        parts.append(body(f"link {k}", place, inertia(0.1), drawn(sized("box", 0.01, length, 0.01))))
    comment = "A chain of ten links on ball joints."
    return world(comment, "fcl_mesh", skeleton("skeleton 1", *parts))


def skin(geometry: str, stiffness: tuple[float, float, float], place: Sequence[float] = ()) -> Lines:
    """A soft skin of 0.5 kg.

    Springs hold its points to the body (kv, N/m) and to each other (ke, N/m); damp is in N s/m.
    """
    kv, ke, damp = stiffness
    return block(
        "soft_shape",
        leaf("total_mass", 0.5),
        leaf("transformation", text(place)) if place else [],
        leaf("geometry", geometry),
        leaf("kv", kv),
        leaf("ke", ke),
        leaf("damp", damp),
    )


def soft_box(*size: float) -> str:
    return f"<box><size>{text(size)}</size><frags>3 3 3</frags></box>"


def soft_ellipsoid(*size: float) -> str:
    return f"<ellipsoid><size>{text(size)}</size><num_slices>8</num_slices><num_stacks>8</num_stacks></ellipsoid>"


def soft_bodies() -> str:
    """Five rigid cores in soft skins; the first core does not collide."""
    soft_cylinder = (
        "<cylinder><radius>0.15</radius><height>0.25</height>"
        "<num_slices>8</num_slices><num_stacks>8</num_stacks><num_rings>4</num_rings></cylinder>"
    )
    pillow, firm, loose = (500.0, 0.0, 5.0), (10000.0, 100.0, 50.0), (100.0, 10.0, 1.0)
    tilt = (1, 2, 3)
    table = (  # place, mass of the core, core, skin
        ((0, -0.1, 0, 0, 0, 0), 0.5, sized("box", 0.4, 0.2, 0.4), skin(soft_box(0.5, 0.25, 0.5), pillow)),
        ((0, 0.25, 0, 0, 0, 0), 1.0, sized("ellipsoid", 0.2, 0.2, 0.2), skin(soft_ellipsoid(0.25, 0.25, 0.25), firm)),
        (
            (0.25, 0.15, -0.5, *tilt),
            1.0,
            sized("ellipsoid", 0.1, 0.2, 0.3),
            skin(soft_ellipsoid(0.15, 0.25, 0.35), firm),
        ),
        ((-0.25, 0.15, -0.5, *tilt), 1.0, round_solid("cylinder", 0.1, 0.2), skin(soft_cylinder, firm)),
        (
            (0.3, 0.4, 0, *tilt),
            0.5,
            sized("box", 0.2, 0.2, 0.2),
            skin(soft_box(0.25, 0.25, 0.25), loose, (0.1, 0.1, 0, *tilt)),
        ),
    )
    skeletons = []
    for k, (place, mass, core, cover) in enumerate(table, 1):
        parts = [inertia(mass), cover, drawn(core), solid(core) if k > 1 else []]
        skeletons.append(skeleton(f"skeleton {k}", *alone("link 1", place, "free", *parts)))
    comment = "Five soft bodies fall on a floor."
    return world(comment, "fcl_mesh", floor(-0.375, (2.5, 0.05, 2.5)), *skeletons)


def box_moment(mass: float, size: Sequence[float]) -> tuple[float, float, float]:
    """The moment of a uniform box about its centre."""
    xx, yy, zz = (v * v for v in size)
    return mass * (yy + zz) / 12, mass * (zz + xx) / 12, mass * (xx + yy) / 12


def shapes() -> str:
    """One body of each shape in a row."""

    def ball(radius: float, x: float) -> str:
        return f"<sphere><radius>{text([radius])}</radius><position>{text([x, 0, 0])}</position></sphere>"

    table = (
        ("box", sized("box", 0.1, 0.05, 0.1), RED),
        ("sphere", "<sphere><radius>0.05</radius></sphere>", GREEN),
        ("ellipsoid", sized("ellipsoid", 0.05, 0.1, 0.15), YELLOW),
        ("cylinder", round_solid("cylinder", 0.05, 0.1), BLUE),
        ("capsule", round_solid("capsule", 0.05, 0.1), BLUE),
        ("cone", round_solid("cone", 0.05, 0.1), BLUE),
        ("multi sphere", f"<multi_sphere>{ball(0.05, -0.075)}{ball(0.075, 0.075)}</multi_sphere>", BLUE),
        ("mesh", mesh_file("../obj/foot.obj"), BLUE),
    )
    skeletons = []
    for k, (name, geometry, colour) in enumerate(table):
        # DART takes a mesh for a box; stated, the moment does not hang on the mesh.
        moment = box_moment(1.0, np.subtract(FOOT_HIGH, FOOT_LOW).tolist()) if name == "mesh" else ()
        parts = (inertia(1.0, moment=moment), drawn(geometry, (), colour), solid(geometry))
        place = (round(-0.4 + 0.2 * k, 1), 0, 0, 1, 2, 3)
        skeletons.append(skeleton(f"{name} skeleton", *alone(name, place, "free", *parts)))
    comment = "Each shape falls on a floor."
    return world(comment, "bullet", floor(-0.375, (10, 0.01, 10), (0, -0.005, 0)), *skeletons)


def ground() -> str:
    comment = "A floor; its top is at y = -0.95."
    return world(comment, "fcl_mesh", floor(-0.975, (2.5, 0.05, 2.5)))


def foot() -> list[Mesh]:
    """A bare foot, toes towards -x and y up."""
    sole = -0.09548
    instep = [  # x, then the centre and the half widths in y and z
        (0.08, 0.036, 0.0, 0.032, 0.045),
        (0.05, 0.045, 0.0, 0.0445, 0.056),
        (0.0, 0.042, 0.0, 0.0415, 0.058),
        (-0.05, 0.032, -0.002, 0.0315, 0.068),
        (-0.09, 0.0245, -0.0044, 0.024, 0.07656),
        (-0.12, 0.018, -0.004, 0.0175, 0.07),
    ]
    shank = [(y, 0.03, 0.0, 0.036, 0.038) for y in (sole + 0.06, 0.02, 0.04576)]
    toes = [  # z of the centre, the radius and the tip
        (-0.052, 0.018, -0.1702),
        (-0.019, 0.013, -0.166),
        (0.007, 0.0125, -0.158),
        (0.031, 0.0115, -0.149),
        (0.053, 0.011, -0.138),
    ]
    levels = [(x, sole + y, z, hy, hz) for x, y, z, hy, hz in instep]
    parts = [limb("foot", levels, (0.01082, 0.022), axis="x", power=2.6), limb("foot", shank, axis="y", power=2.0)]
    for z, r, tip in toes:
        ends = [(x, sole + r, z, r, r) for x in (-0.1, tip + r)]
        parts.append(limb("foot", ends, (0.0, r), axis="x", power=2.0, n=12))
    return fitted(parts, FOOT_LOW, FOOT_HIGH)


def fitted(parts: list[Mesh], low: Point, high: Point) -> list[Mesh]:
    """The parts stretched along the axes so that together they have given extents."""
    points = np.concatenate([part.points for part in parts])
    scale = np.subtract(high, low) / np.ptp(points, axis=0)
    return [replace(part, points=(part.points - points.min(axis=0)) * scale + low) for part in parts]


def main(data: Path) -> None:
    title = "A foot. Written by tools/make_skel.py."
    files = {
        "skel/chain.skel": chain(),
        "skel/softBodies.skel": soft_bodies(),
        "skel/shapes.skel": shapes(),
        "skel/ground.skel": ground(),
        "obj/foot.obj": obj_text(title, "foot.mtl", foot()),
        "obj/foot.mtl": library_text(title, [("foot", BLUE)]),
    }
    for name, content in files.items():
        (data / name).parent.mkdir(parents=True, exist_ok=True)
        (data / name).write_text(content, encoding="ascii", newline="\n")
    print(f"{len(files)} files, {sum(map(len, files.values()))} bytes")


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).parents[1] / "data")
