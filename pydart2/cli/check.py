"""``pydart2 check``: whether a file loads, and what in it cannot be meant."""

from __future__ import annotations

import argparse
import logging
from collections import Counter
from collections.abc import Iterable, Iterator
from typing import Any

import numpy as np

from pydart2.bodynode import BodyNode
from pydart2.cli.models import add_file
from pydart2.cli.report import Report
from pydart2.gui.first_look import open_world
from pydart2.skeleton import Skeleton

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
        world.step(_STEPS)
        found += messages.texts
    finally:
        logger.removeHandler(messages)
        logger.propagate = True
    loaded = [
        f"{skel.name}: {skel.m:.4g} kg, {len(skel.bodynodes)} bodies, {skel.ndofs} dofs" for skel in world.skeletons
    ]
    text = "\n".join([*(f"loads    {line}" for line in loaded), *(f"wrong?   {line}" for line in found)])
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
    if not body.m > 0.0:
        yield f"{where} has the mass {body.m:g} kg"
    if moments[0] <= 0.0:
        yield f"{where} has moments of inertia that are not positive: {_list(moments)} kg m²"
    elif moments[2] > (moments[0] + moments[1]) * (1.0 + 1e-6):
        reason = "the largest is above the sum of the others"
        yield f"{where} has moments of inertia that no body has: {_list(moments)} kg m², {reason}"


def _names_twice(kind: str, names: Iterable[str]) -> Iterator[str]:
    yield from (f"{count} times a {kind} has the name {name!r}" for name, count in Counter(names).items() if count > 1)


def _list(numbers: Iterable[float]) -> str:
    return ", ".join(f"{number:.3g}" for number in numbers)
