"""Tiny models in SKEL, and Atlas on its feet. Metres and kilograms; y points up unless gravity says otherwise."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path

import pydart2

G = 9.81
DOWN = (0.0, -G, 0.0)
ORIGIN = (0.0, 0.0, 0.0)
ROOT_EXTRA = {"planar": '<plane type="yz"/>', "euler": "<axis_order>zyx</axis_order>"}


def text(numbers: Sequence[float]) -> str:
    return " ".join(repr(float(x)) for x in numbers)


def box(size: Sequence[float]) -> str:
    return f"<box><size>{text(size)}</size></box>"


def sphere(radius: float) -> str:
    return f"<sphere><radius>{radius}</radius></sphere>"


def body(
    name: str = "body",
    *,
    mass: float = 1.0,
    com: Sequence[float] = ORIGIN,
    inertia: Sequence[float] = (0.1, 0.1, 0.1),
    at: Sequence[float] = (0.0,) * 6,
    shape: str = "",
) -> str:
    """A body: principal moments of inertia about the COM, pose `at` in the world (x y z and XYZ Euler angles), and
    one shape that both is drawn and collides."""
    moments = "".join(f"<{k}>{v!r}</{k}>" for k, v in zip(("ixx", "iyy", "izz"), inertia, strict=True))
    shapes = [f"<{kind}_shape><geometry>{shape}</geometry></{kind}_shape>" for kind in ("visualization", "collision")]
    return (
        f'<body name="{name}"><transformation>{text(at)}</transformation>'
        f"<inertia><mass>{mass!r}</mass><offset>{text(com)}</offset><moment_of_inertia>{moments}"
        f"<ixy>0</ixy><ixz>0</ixz><iyz>0</iyz></moment_of_inertia></inertia>{''.join(shapes) if shape else ''}</body>"
    )


def joint(
    kind: str = "free",
    child: str = "body",
    parent: str = "world",
    *,
    name: str = "joint",
    axis: Sequence[float] | None = None,
    axis2: Sequence[float] | None = None,
    at: Sequence[float] = (0.0,) * 6,
    extra: str = "",
) -> str:
    """A joint; `at` is its pose in the child body."""
    axes = "".join(
        f"<{tag}><xyz>{text(value)}</xyz></{tag}>" for tag, value in (("axis", axis), ("axis2", axis2)) if value
    )
    return (
        f'<joint name="{name}" type="{kind}"><transformation>{text(at)}</transformation>'
        f"<parent>{parent}</parent><child>{child}</child>{axes}{extra}</joint>"
    )


def skeleton(*parts: str, name: str = "skeleton") -> str:
    return f'<skeleton name="{name}">{"".join(parts)}</skeleton>'


def skel_text(*skeletons: str) -> str:
    """A SKEL file with a world."""
    return (
        '<?xml version="1.0"?><skel version="1.0"><world name="world"><physics><time_step>0.001</time_step>'
        f"<gravity>{text(DOWN)}</gravity><collision_detector>dart</collision_detector></physics>"
        f"{''.join(skeletons)}</world></skel>"
    )


def save_skeleton(folder: Path, text: str, name: str = "added") -> Path:
    """A SKEL file with a skeleton and no world, for World.add_skeleton()."""
    path = folder / f"{name}.skel"
    path.write_text(f'<?xml version="1.0"?><skel version="1.0">{text}</skel>', encoding="utf-8")
    return path


def make_world(
    folder: Path, *skeletons: str, dt: float = 0.001, gravity: Sequence[float] = DOWN, recording: bool = False
) -> pydart2.World:
    """A world with these skeletons."""
    path = folder / "model.skel"
    path.write_text(skel_text(*skeletons), encoding="utf-8")
    world = pydart2.World(dt, path)
    world.set_gravity(gravity)
    world.set_recording(recording)
    return world


def floor(size: Sequence[float] = (20.0, 1.0, 20.0)) -> str:
    """A box that cannot move, its top face at y = 0."""
    ground = body("floor", at=(0, -size[1] / 2, 0, 0, 0, 0), shape=box(size))
    return skeleton(ground, joint("weld", "floor", name="weld"), name="floor")


def free_body(name: str = "free", **of_body: object) -> str:
    """One body that moves freely."""
    return skeleton(body(**of_body), joint(), name=name)  # type: ignore[arg-type]


def pendulum(mass: float = 1.0, length: float = 1.0, moment: float = 0.1) -> str:
    """A body on a hinge along z; its COM hangs `length` below the hinge at q = 0."""
    rod = body("rod", mass=mass, com=(0, -length, 0), inertia=(0.1, 0.1, moment))
    return skeleton(rod, joint("revolute", "rod", axis=(0, 0, 1), name="hinge"), name="pendulum")


def slider(mass: float = 1.0, kind: str = "prismatic") -> str:
    """A body on a rail along x."""
    cart = body("cart", mass=mass, inertia=(0.1, 0.1, 0.1))
    return skeleton(cart, joint(kind, "cart", axis=(1, 0, 0), name="rail"), name="slider")


def arm(links: int = 2) -> str:
    """A chain of hinges along z whose links hang 1 m each below each other at q = 0."""
    parts = []
    for i in range(links):
        parts.append(body(f"link{i}", mass=1.0 + i, com=(0, -0.5, 0), at=(0, -float(i), 0, 0, 0, 0)))
        parent = f"link{i - 1}" if i else "world"
        parts.append(joint("revolute", f"link{i}", parent, axis=(0, 0, 1), name=f"hinge{i}"))
    return skeleton(*parts, name="arm")


def creature(root: str = "free") -> str:
    """A tree with every common joint type, tilted joint frames and COMs beside the origins; 6 + 1 + 3 + 1 + 2 + 3
    dofs for a free root."""
    plan = [
        ("pelvis", "world", root, {"extra": ROOT_EXTRA.get(root, "")}),
        ("thigh", "pelvis", "revolute", {"axis": (0.6, 0.8, 0.0)}),
        ("head", "pelvis", "ball", {}),
        ("foot", "thigh", "prismatic", {"axis": (0.0, 0.6, 0.8)}),
        ("hand", "head", "universal", {"axis": (1, 0, 0), "axis2": (0, 1, 0)}),
        ("tail", "pelvis", "euler", {"extra": "<axis_order>xyz</axis_order>"}),
    ]
    parts = []
    for i, (name, parent, kind, options) in enumerate(plan):
        pose = (0.3 * i, 0.2 * i * (-1) ** i, 0.1 * i, 0.3 * i, -0.2 * i, 0.1 * i)
        inertia = (0.1 + 0.02 * i, 0.12 + 0.01 * i, 0.15 + 0.01 * i)
        parts.append(body(name, mass=1.0 + 0.3 * i, com=(0.05 * i, -0.1, 0.02 * i), inertia=inertia, at=pose))
        frame = (-0.1, 0.05 * i, 0.0, 0.1 * i, 0.2, -0.1)
        parts.append(joint(kind, name, parent, name=f"{name}_joint", at=frame, **options))
    return skeleton(*parts, name="creature")


def standing_atlas() -> pydart2.World:
    """Atlas on the ground, held by springs, as data/SOURCES.md says."""
    scene = json.loads(Path(pydart2.data_path("sdf/atlas/standing.json")).read_text(encoding="ascii"))
    world = pydart2.World(scene["time_step"], pydart2.data_path(scene["world"]))
    robot = world.add_skeleton(pydart2.data_path(scene["robot"]))
    robot.set_positions(scene["q"])
    for dof in robot.dofs[6:]:
        dof.set_spring_stiffness(scene["stiffness"])
        dof.set_rest_position(dof.position())
        dof.set_damping_coefficient(scene["damping"])
    return world


def add_ragdoll(world: pydart2.World, name: str, height: float, turn: float) -> pydart2.Skeleton:
    """A limp human of capsules, 33 dofs: 6, waist 3, chest 1, neck 3, each arm 3 + 1, each leg 3 + 1 + 2."""
    doll = world.add_empty_skeleton(name)

    def add(
        part: str, parent: str | None, joint: str, at: tuple[float, float, float], radius: float, length: float
    ) -> None:
        half = 0.0 if parent is None else length / 2.0
        body = doll.add_body(
            part,
            parent,
            joint,
            position=(at[0], at[1], at[2] - half),
            joint_position=(0.0, 0.0, half),
            axis=(0.0, 1.0, 0.0) if joint == "revolute" else None,
            damping=None if parent is None else 0.5,
        )
        body.add_capsule(radius, length)

    add("pelvis", None, "free", (0.0, 0.0, 0.0), 0.1, 0.1)
    add("belly", "pelvis", "ball", (0.0, 0.0, 0.32), 0.09, 0.1)
    add("chest", "belly", "revolute", (0.0, 0.0, 0.34), 0.11, 0.12)
    add("head", "chest", "ball", (0.0, 0.0, 0.36), 0.09, 0.08)
    for side, y in (("left", 1.0), ("right", -1.0)):
        add(f"{side} arm", "chest", "ball", (0.0, 0.19 * y, 0.02), 0.045, 0.2)
        add(f"{side} hand", f"{side} arm", "revolute", (0.0, 0.0, -0.22), 0.04, 0.18)
        add(f"{side} thigh", "pelvis", "ball", (0.0, 0.1 * y, -0.14), 0.065, 0.25)
        add(f"{side} shin", f"{side} thigh", "revolute", (0.0, 0.0, -0.3), 0.05, 0.25)
        add(f"{side} foot", f"{side} shin", "universal", (0.0, 0.0, -0.22), 0.04, 0.08)
    doll.set_self_collision_check(False)
    doll.q = [0.0, turn, 0.0, 0.05 * turn, 0.0, height, *doll.q[6:]]
    return doll
