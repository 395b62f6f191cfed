"""Writes figures/*.json, the figures of the published models that ours are compared with.

    /usr/bin/python3 tests/models/make_figures.py [data folder of Debian's dart-doc]

Needs Debian's python3-dartpy and dart-doc.  A file holds numbers and names only.
"""

from __future__ import annotations

import json
import math
import sys
import xml.etree.ElementTree as ET
from pathlib import Path
from typing import Any

import dartpy as dart
import numpy as np

FIGURES = Path(__file__).parent / "figures"
POSES = 10
GRAVITY = [0.0, 0.0, -9.81]  # of the bias forces of Atlas


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
        "from_parent": numbers(joint.getTransformFromParentBodyNode().matrix()),
        "from_child": numbers(joint.getTransformFromChildBodyNode().matrix()),
    }
    if figures["type"] == "RevoluteJoint":
        figures["axis"] = numbers(joint.getAxis())
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
        entry = {
            "type": node.getShape().getType(),
            "size": numbers(node.getShape().getSize()),
            "place": numbers(node.getRelativeTranslation()),
            "collides": bool(node.hasCollisionAspect()),
        }
        if node.hasVisualAspect():
            entry["rgba"] = numbers(node.getVisualAspect().getRGBA())
        figures.append(entry)
    return figures


def write(name: str, figures: dict[str, Any]) -> None:
    FIGURES.mkdir(exist_ok=True)
    lines = json.dumps(figures, allow_nan=False)
    for key in (
        '{"name"',
        '{"q"',
        '"bodies"',
        '"joints"',
        '"dofs"',
        '"poses"',
        '"M"',
        '"c"',
        '"skeletons"',
        '"shapes"',
        '"stated_limits"',
    ):
        lines = lines.replace(f" {key}", f"\n{key}").replace(f"[{key}", f"[\n{key}")
    (FIGURES / f"{name}.json").write_text(lines + "\n", encoding="ascii")


def main(data: Path) -> None:
    model = data / "sdf/atlas/atlas_v3_no_head.sdf"
    atlas = dart.utils.SdfParser.readSkeleton(dart.common.Uri(str(model)))
    atlas.setGravity(GRAVITY)
    write(
        "atlas_v3_no_head",
        {"gravity": GRAVITY, **skeleton_figures(atlas, POSES), "stated_limits": stated_limits(model)},
    )
    world = dart.utils.SkelParser.readWorld(dart.common.Uri(str(data / "skel/cubes.skel")))
    skeletons = [world.getSkeleton(i) for i in range(world.getNumSkeletons())]
    entries = [{**skeleton_figures(s, 1), "shapes": shape_figures(s.getBodyNode(0))} for s in skeletons]
    detector = world.getConstraintSolver().getCollisionDetector().getType()
    write(
        "cubes",
        {
            "time_step": numbers(world.getTimeStep()),
            "gravity": numbers(world.getGravity()),
            "detector": detector,
            "skeletons": entries,
        },
    )


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else Path("/usr/share/doc/dart/data"))
