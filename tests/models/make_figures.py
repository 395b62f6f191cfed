"""Writes figures/*.json, the figures of the published models that ours are compared with.

    /usr/bin/python3 tests/models/make_figures.py ORIGINAL [DART]

ORIGINAL is the data folder of the original pydart2's examples, DART that of Debian's dart-doc.  Needs
Debian's python3-dartpy.  A file holds numbers and names only.
"""

from __future__ import annotations

import json
import math
import sys
import tempfile
import xml.etree.ElementTree as ET
from pathlib import Path
from typing import Any

import dartpy as dart
import numpy as np

FIGURES = Path(__file__).parent / "figures"
POSES = 10
GRAVITY = [0.0, 0.0, -9.81]  # of the bias forces of Atlas and PR2
AXES = {  # per joint type, what says where its axes are
    "RevoluteJoint": ("getAxis",),
    "PrismaticJoint": ("getAxis",),
    "UniversalJoint": ("getAxis1", "getAxis2"),
}
SIZES = ("getSize", "getDiameters", "getRadius", "getHeight", "getScale")
KEYS = ("name", "q", "bodies", "joints", "dofs", "poses", "M", "c", "skeletons", "shapes", "stated_limits")


def numbers(values: Any) -> Any:
    """Nested lists with twelve significant digits; None stands for an infinite limit."""
    if np.ndim(values):
        return [numbers(v) for v in values]
    value = float(f"{float(values):.12g}") + 0.0
    return value if math.isfinite(value) else None


def body_figures(body: Any) -> dict[str, Any]:
    parent = body.getParentBodyNode()
    inertia = body.getInertia()
    return {
        "name": body.getName(),
        "parent": parent.getName() if parent else None,
        "mass": numbers(inertia.getMass()),
        "com": numbers(inertia.getLocalCOM()),
        "inertia": numbers(inertia.getMoment()),
    }


def joint_figures(joint: Any) -> dict[str, Any]:
    figures = {
        "name": joint.getName(),
        "type": joint.getType(),
        "actuator": str(joint.getActuatorType()).split(".")[-1],
        "from_parent": numbers(joint.getTransformFromParentBodyNode().matrix()),
        "from_child": numbers(joint.getTransformFromChildBodyNode().matrix()),
    }
    if figures["type"] in AXES:
        figures["axes"] = [numbers(getattr(joint, read)()) for read in AXES[figures["type"]]]
    return figures


def dof_figures(dof: Any) -> dict[str, Any]:
    return {
        "name": dof.getName(),
        "damping": numbers(dof.getDampingCoefficient()),
        "lower": numbers(dof.getPositionLowerLimit()),
        "upper": numbers(dof.getPositionUpperLimit()),
        "velocity": numbers(dof.getVelocityUpperLimit()),
        "force": numbers(dof.getForceUpperLimit()),
    }


def pose_figures(skeleton: Any, rng: np.random.Generator) -> dict[str, Any]:
    """The mass matrix (its lower triangle, row by row) and the bias forces at a random state."""
    n = skeleton.getNumDofs()
    q, dq = numbers(rng.uniform(-0.6, 0.6, n).round(6)), numbers(rng.uniform(-1.0, 1.0, n).round(6))
    skeleton.setPositions(q)
    skeleton.setVelocities(dq)
    return {
        "q": q,
        "dq": dq,
        "M": numbers(skeleton.getMassMatrix()[np.tril_indices(n)]),
        "c": numbers(skeleton.getCoriolisAndGravityForces()),
    }


def skeleton_figures(skeleton: Any, poses: int) -> dict[str, Any]:
    bodies = [skeleton.getBodyNode(i) for i in range(skeleton.getNumBodyNodes())]
    joints = [skeleton.getJoint(i) for i in range(skeleton.getNumJoints())]
    dofs = [skeleton.getDof(i) for i in range(skeleton.getNumDofs())]
    rng = np.random.default_rng(1)
    return {
        "name": skeleton.getName(),
        "mass": numbers(skeleton.getMass()),
        "q": numbers(skeleton.getPositions()) if dofs else [],
        "bodies": [body_figures(b) for b in bodies],
        "joints": [joint_figures(j) for j in joints],
        "dofs": [dof_figures(d) for d in dofs],
        "poses": [pose_figures(skeleton, rng) for _ in range(poses)] if dofs else [],
    }


def stated_limits(model: Path) -> dict[str, dict[str, float]]:
    """Per joint what the file states: DART's SDF reader leaves out effort and velocity."""
    return {
        joint.get("name", ""): {v.tag: float(v.text or "") for v in joint.findall("axis/limit/*")}
        for joint in ET.parse(model).iter("joint")
    }


def shape_figures(body: Any) -> list[dict[str, Any]]:
    figures = []
    for node in body.getShapeNodes():
        shape = node.getShape()
        entry = {
            "type": shape.getType(),
            "size": [numbers(getattr(shape, read)()) for read in SIZES if hasattr(shape, read)],
            "place": numbers(node.getRelativeTransform().matrix()),
            "collides": bool(node.hasCollisionAspect()),
        }
        if node.hasVisualAspect():
            entry["rgba"] = numbers(node.getVisualAspect().getRGBA())
        figures.append(entry)
    return figures


def stated_shapes(model: Path) -> list[dict[str, list[list[float]]]]:
    """What the file states of soft skins and of multiple spheres, which dartpy does not give."""
    shapes = [e for tag in ("soft_shape", "multi_sphere") for e in ET.parse(model).iter(tag)]
    out: list[dict[str, list[list[float]]]] = []
    for shape in shapes:
        figures: dict[str, list[list[float]]] = {}
        for leaf in (e for e in shape.iter() if len(e) == 0):
            figures.setdefault(leaf.tag, []).append([float(v) for v in (leaf.text or "").split()])
        out.append(figures)
    return out


def world_figures(model: Path, poses: int) -> dict[str, Any]:
    """All of a SKEL world."""
    world = dart.utils.SkelParser.readWorld(dart.common.Uri(str(model)))
    entries = []
    for k in range(world.getNumSkeletons()):
        skeleton = world.getSkeleton(k)
        bodies = [skeleton.getBodyNode(i) for i in range(skeleton.getNumBodyNodes())]
        shapes = {"shapes": [shape_figures(b) for b in bodies], "mobile": skeleton.isMobile()}
        entries.append({**skeleton_figures(skeleton, poses), **shapes})
    return {
        "time_step": numbers(world.getTimeStep()),
        "gravity": numbers(world.getGravity()),
        "detector": world.getConstraintSolver().getCollisionDetector().getType(),
        "stated_detector": ET.parse(model).findtext("world/physics/collision_detector"),
        "stated_shapes": stated_shapes(model),
        "skeletons": entries,
    }


def without_meshes(model: Path, folder: Path) -> Path:
    """A copy of a URDF model without visual and collision elements, whose meshes may be missing."""
    tree = ET.parse(model)
    for link in tree.iter("link"):
        for element in [e for e in link if e.tag in ("visual", "collision")]:
            link.remove(element)
    tree.write(folder / model.name)
    return folder / model.name


def beside(model: Path, mesh: Path, folder: Path) -> Path:
    """A copy of a SKEL model with the mesh that it looks for in ../obj."""
    for source, place in ((model, "skel"), (mesh, "obj")):
        (folder / place).mkdir()
        (folder / place / source.name).write_bytes(source.read_bytes())
    return folder / "skel" / model.name


def write(name: str, figures: dict[str, Any]) -> None:
    FIGURES.mkdir(exist_ok=True)
    lines = json.dumps(figures, allow_nan=False)
    for key in KEYS:
        head = f'{{"{key}"' if key in ("name", "q") else f'"{key}"'
        lines = lines.replace(f" {head}", f"\n{head}").replace(f"[{head}", f"[\n{head}")
    (FIGURES / f"{name}.json").write_text(lines + "\n", encoding="ascii")


def write_robots(original: Path, dart_data: Path, folder: Path) -> None:
    model = dart_data / "sdf/atlas/atlas_v3_no_head.sdf"
    atlas = dart.utils.SdfParser.readSkeleton(dart.common.Uri(str(model)))
    atlas.setGravity(GRAVITY)
    limits = {"stated_limits": stated_limits(model)}
    write("atlas_v3_no_head", {"gravity": GRAVITY, **skeleton_figures(atlas, POSES), **limits})
    pr2 = dart.utils.DartLoader().parseSkeleton(str(without_meshes(original / "urdf/PR2/pr2.urdf", folder)))
    pr2.setGravity(GRAVITY)
    write("pr2", {"gravity": GRAVITY, **skeleton_figures(pr2, POSES)})


def main(original: Path, dart_data: Path) -> None:
    with tempfile.TemporaryDirectory() as folder:
        write_robots(original, dart_data, Path(folder))
        shapes = beside(original / "skel/shapes.skel", dart_data / "obj/foot.obj", Path(folder))
        write("shapes", world_figures(shapes, POSES))
    for name in ("cubes", "chain", "fullbody1", "softBodies", "ground"):
        write(name, world_figures(dart_data / f"skel/{name}.skel", POSES))


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    main(Path(sys.argv[1]), Path(sys.argv[2] if len(sys.argv) > 2 else "/usr/share/doc/dart/data"))
