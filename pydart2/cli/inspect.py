"""``pydart2 inspect``: the bodies, joints, limits, masses and shapes of a file."""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from typing import Any

import numpy as np

from pydart2.bodynode import BodyNode
from pydart2.cli.models import add_file
from pydart2.cli.report import Report, table
from pydart2.gui.first_look import open_world
from pydart2.skeleton import Skeleton
from pydart2.telling import count


def add(commands: Any) -> None:
    """Add the command."""
    parser = commands.add_parser("inspect", help="the tree, dofs, limits, masses and shapes of a file")
    add_file(parser)
    parser.add_argument("--json", action="store_true", help="as JSON")
    parser.set_defaults(run=run)


def run(args: argparse.Namespace) -> Report:
    """Describe each skeleton."""
    world = open_world(args.file)
    data = [_skeleton(skel) for skel in world.skeletons]
    return Report("\n\n".join(_text(skeleton) for skeleton in data), data)


def _skeleton(skel: Skeleton) -> dict[str, Any]:
    return {
        "name": skel.name,
        "mass": skel.m,
        "bodies": [_body(body) for root in skel.bodynodes if root.parent_bodynode is None for body in tree(root)],
        "dofs": [
            {
                "name": dof.name,
                "joint": dof.joint.name,
                "start": dof.position(),
                "limits": _bounds(dof.position_lower_limit(), dof.position_upper_limit()),
                "velocity_limits": _bounds(dof.velocity_lower_limit(), dof.velocity_upper_limit()),
                "force_limits": _bounds(dof.force_lower_limit(), dof.force_upper_limit()),
            }
            for dof in skel.dofs
        ],
    }


def tree(body: BodyNode) -> Iterator[BodyNode]:
    """A body, then each child with all below it."""
    waiting = [body]
    while waiting:
        body = waiting.pop()
        yield body
        waiting += reversed(body.child_bodynodes)


def _body(body: BodyNode) -> dict[str, Any]:
    parent = body.parent_bodynode
    return {
        "name": body.name,
        "parent": None if parent is None else parent.name,
        "joint": {"name": body.parent_joint.name, "type": body.parent_joint.type()},
        "mass": body.m,
        "shapes": [
            {
                "type": node.shape.type(),
                "size": [round(x, 6) for x in np.ptp(node.shape.bounding_box(), axis=0).tolist()],
                "visual": node.has_visual_aspect(),
                "collision": node.has_collision_aspect(),
            }
            for node in body.shapenodes
            if node.shape is not None
        ],
    }


def _bounds(lower: float, upper: float) -> list[float | None]:
    """Without a number where there is no bound."""
    return [bound if np.isfinite(bound) else None for bound in (lower, upper)]


def _text(skeleton: dict[str, Any]) -> str:
    bodies, dofs = len(skeleton["bodies"]), len(skeleton["dofs"])
    title = f"{skeleton['name']}: {skeleton['mass']:.4g} kg, {count(bodies, 'body', 'bodies')}, {count(dofs, 'dof')}"
    depth: dict[str | None, int] = {None: -1}
    rows = []
    for body in skeleton["bodies"]:
        depth[body["name"]] = depth[body["parent"]] + 1
        shapes = (shape["type"] for shape in body["shapes"] if shape["collision"])
        name = "  " * depth[body["name"]] + body["name"]
        rows.append((name, body["joint"]["name"], body["joint"]["type"], body["mass"], " ".join(shapes)))
    tree = table(rows, ("body", "joint", "type", "kg", "collides as"))
    if not dofs:
        return f"{title}\n\n{tree}"
    limits = [(dof["name"], dof["start"], *dof["limits"], dof["force_limits"][1]) for dof in skeleton["dofs"]]
    return f"{title}\n\n{tree}\n\n{table(limits, ('dof', 'start', 'lower', 'upper', 'effort'))}"
