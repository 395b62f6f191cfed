"""``pydart2 check``: whether a file loads, and what in it cannot be meant."""

from __future__ import annotations

import argparse
import logging
from collections import Counter
from collections.abc import Iterable, Iterator
from typing import Any

import numpy as np

from pydart2.bodynode import BodyNode
from pydart2.cli.inspect import tree
from pydart2.cli.models import add_file
from pydart2.cli.report import Report
from pydart2.errors import SimulationError
from pydart2.gui.first_look import open_world
from pydart2.skeleton import Skeleton
from pydart2.telling import count

_STEPS = 10


def add(commands: Any) -> None:
    """Add the command."""
    parser = commands.add_parser(
        "check",
        help="what of a file loads, and what in it cannot be",
        description="Status 1 if something is wrong.",
    )
    add_file(parser)
    parser.add_argument("--json", action="store_true", help="as JSON")
    parser.set_defaults(run=run)


def run(args: argparse.Namespace) -> Report:
    """Load it, look at all numbers, and simulate a few steps."""
    messages = _Messages()
    logger = logging.getLogger("pydart2")
    logger.addHandler(messages)
    logger.propagate = False
    try:
        world = open_world(args.file)
        found = [*messages.texts, *_names_twice("skeleton", (skel.name for skel in world.skeletons))]
        found += [complaint for skel in world.skeletons for complaint in _of_skeleton(skel)]
        messages.texts.clear()
        try:
            world.step(_STEPS)
        except SimulationError as error:
            found.append(str(error))
        found += messages.texts
    finally:
        logger.removeHandler(messages)
        logger.propagate = True
    loaded = [
        f"{skel.name}: {skel.m:.4g} kg, {count(len(skel.bodynodes), 'body', 'bodies')}, {count(skel.ndofs, 'dof')}"
        for skel in world.skeletons
    ]
    lines = [*(f"loads    {line}" for line in loaded), *(f"wrong?   {line}" for line in found)]
    text = "\n".join(lines if found else [*lines, "ok       nothing looks wrong"])
    return Report(text, {"loads": loaded, "wrong": found}, good=not found)


class _Messages(logging.Handler):
    """Keeps what is logged."""

    def __init__(self) -> None:
        super().__init__(logging.WARNING)
        self.texts: list[str] = []

    def emit(self, record: logging.LogRecord) -> None:
        self.texts.append(record.getMessage())


def _of_skeleton(skel: Skeleton) -> Iterator[str]:
    for body in skel.bodynodes:
        yield from _of_body(body)
    yield from _names_twice(f"body of {skel.name!r}", (body.name for body in skel.bodynodes))
    yield from _names_twice(f"dof of {skel.name!r}", (dof.name for dof in skel.dofs))
    for dof in skel.dofs:
        lower, upper, start = dof.position_lower_limit(), dof.position_upper_limit(), dof.position()
        if lower > upper:
            yield f"dof {dof.name!r} of {skel.name!r} has limits the wrong way round: {lower:g} to {upper:g}"
        elif not lower <= start <= upper:
            yield f"dof {dof.name!r} of {skel.name!r} starts at {start:g}, outside its limits {lower:g} to {upper:g}"


def _of_body(body: BodyNode) -> Iterator[str]:
    where = f"body {body.name!r} of {body.skel.name!r}"
    moments = np.linalg.eigvalsh(body.I)
    if not body.m > 0.0:  # frames, of tools and cameras, have none
        if body.parent_joint.num_dofs() and not any(below.m > 0.0 for below in tree(body)):
            yield f"{where} moves, and neither it nor what hangs on it has mass"
    elif moments[0] < 0.0 or (moments[0] == 0.0 and body.parent_joint.num_dofs()):
        yield f"{where} has moments of inertia that are not positive: {_list(moments)} kg m²"
    elif moments[2] > (moments[0] + moments[1]) * (1.0 + 1e-6):
        reason = "the largest is above the sum of the others"
        yield f"{where} has moments of inertia that no body has: {_list(moments)} kg m², {reason}"


def _names_twice(kind: str, names: Iterable[str]) -> Iterator[str]:
    yield from (f"{count} times a {kind} has the name {name!r}" for name, count in Counter(names).items() if count > 1)


def _list(numbers: Iterable[float]) -> str:
    return ", ".join(f"{number:.3g}" for number in numbers)
