"""Small models: a skeleton with a joint of each type and a shape of each kind that SKEL files have, and a screw."""

from __future__ import annotations

from pathlib import Path

import pydart2

JOINTS = {
    "weld": "",
    "revolute": "<axis><xyz>0 0 2</xyz></axis>",
    "prismatic": "<axis><xyz>0 2 0</xyz></axis>",
    "universal": "<axis><xyz>1 0 0</xyz></axis><axis2><xyz>0 1 0</xyz></axis2>",
    "planar": '<plane type="xy"/>',
    "ball": "",
    "euler": "<axis_order>xyz</axis_order>",
    "translational": "",
    "free": "",
}
SHAPES = {
    "sphere": "<radius>0.1</radius>",
    "box": "<size>0.1 0.2 0.3</size>",
    "ellipsoid": "<size>0.1 0.2 0.3</size>",
    "cylinder": "<radius>0.1</radius><height>0.3</height>",
    "capsule": "<radius>0.1</radius><height>0.3</height>",
    "cone": "<radius>0.1</radius><height>0.3</height>",
    "plane": "<normal>0 0 1</normal><offset>0.25</offset>",
    "multi_sphere": "<sphere><radius>0.1</radius><position>0 0 0.5</position></sphere>"
    "<sphere><radius>0.2</radius><position>0 0 -0.5</position></sphere>",
    "mesh": "<file_name>mesh.obj</file_name><scale>1 2 3</scale>",
}
MESH = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
INERTIA = "<ixx>1</ixx><iyy>1</iyy><izz>1</izz><ixy>0</ixy><ixz>0</ixz><iyz>0</iyz>"
SCREW = f"""<sdf version="1.5"><model name="screw">
<link name="nut"><inertial><mass>1</mass><inertia>{INERTIA}</inertia></inertial></link>
<joint name="thread" type="screw"><parent>world</parent><child>nut</child><axis><xyz>0 0 1</xyz></axis>
<thread_pitch>-0.5</thread_pitch></joint></model></sdf>"""


def _shape(kind: str) -> str:
    purpose = "collision_shape" if kind == "box" else "visualization_shape"
    return (
        f"<{purpose}><transformation>0 0.5 0 0 0 0</transformation>"
        f"<geometry><{kind}>{SHAPES[kind]}</{kind}></geometry></{purpose}>"
    )


def _body(i: int, shape: str) -> str:
    marker = f'<marker name="tip {i}"><offset>0 0 {i}</offset></marker>'
    return (
        f'<body name="body {i}"><transformation>{i} 0 0 0 0 0</transformation>'
        f"<inertia><mass>{i + 1}</mass><offset>0 0.1 0</offset>"
        f"<moment_of_inertia>{INERTIA}</moment_of_inertia></inertia>{_shape(shape)}{marker}</body>"
    )


def _joint(i: int, kind: str) -> str:
    parent = f"body {i - 1}" if i else "world"
    ends = f"<parent>{parent}</parent><child>body {i}</child>"
    offset = "<transformation>0 0 0.25 0 0 0</transformation>"
    return f'<joint name="{kind} joint" type="{kind}">{ends}{offset}{JOINTS[kind]}</joint>'


def write_zoo(folder: Path) -> Path:
    """Write the world and its mesh; body i hangs at a joint of the i-th type and has the i-th shape."""
    parts = "".join(_body(i, kind) for i, kind in enumerate(SHAPES))
    parts += "".join(_joint(i, kind) for i, kind in enumerate(JOINTS))
    (folder / "mesh.obj").write_text(MESH, encoding="ascii")
    path = folder / "zoo.skel"
    path.write_text(
        '<skel version="1.0"><world name="zoo"><physics><time_step>0.001</time_step><gravity>0 0 0</gravity>'
        "<collision_detector>dart</collision_detector></physics>"
        f'<skeleton name="zoo">{parts}</skeleton></world></skel>',
        encoding="ascii",
    )
    return path


def load_zoo(folder: Path) -> pydart2.Skeleton:
    """The skeleton, alone in its world without gravity."""
    return pydart2.World(0.001, write_zoo(folder)).skeletons[0]


def load_screw(folder: Path) -> pydart2.Skeleton:
    """A nut on a screw along z."""
    path = folder / "screw.sdf"
    path.write_text(SCREW, encoding="ascii")
    return pydart2.World(0.001).add_skeleton(path)
