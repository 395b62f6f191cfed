"""``pydart2 bench``: how fast a file's world steps, where the time goes, and what would be faster."""

from __future__ import annotations

import argparse
import time
from typing import Any

import pydart2
from pydart2.cli.models import add_file, add_standing
from pydart2.cli.report import Report, table
from pydart2.gui.first_look import open_world
from pydart2.simulation.step_options import DETECTORS
from pydart2.utils.progress import progress

_SECONDS = 0.5  # of each measurement
_AT_ONCE = 20  # steps
_SOLVERS = ("fast", "dart", "iterative")


def add(commands: Any) -> None:
    """Add the command."""
    parser = commands.add_parser("bench", help="steps a second, where the time goes, what would be faster")
    add_file(parser)
    add_standing(parser)
    parser.add_argument("--json", action="store_true", help="as JSON")
    parser.set_defaults(run=run)


def run(args: argparse.Namespace) -> Report:
    """Measure the world as it is, and with each other detector and solver."""
    world = open_world(args.file, not args.no_ground, fixed=args.fixed)
    world.disable_recording()
    own = world.collision_detector(), world.constraint_solver()
    others = [(d, s) for d in DETECTORS for s in _SOLVERS if (d, s) != own]
    rows = [_measure(world.clone(), *choice) for choice in progress([own, *others], "measuring", "world")]
    if "error" in rows[0]:
        raise pydart2.SimulationError(rows[0]["error"])
    free = world.clone()
    for skel in free.skeletons:
        for body in skel.bodynodes:
            body.set_collidable(False)
    dynamics = _measure(free, *own)["us_per_step"] or 0.0
    data = {
        "dofs": sum(skel.ndofs for skel in world.skeletons),
        "dt": world.dt,
        "dynamics_us": dynamics,
        "contacts_us": max(rows[0]["us_per_step"] - dynamics, 0.0),
        "choices": rows,
    }
    return Report(_text(data), data)


def _measure(world: pydart2.World, detector: int, solver: str) -> dict[str, Any]:
    """What a step takes and how many contacts it has, from the start of the world on."""
    world.set_collision_detector(detector)
    world.set_constraint_solver(solver)
    row: dict[str, Any] = {"detector": DETECTORS[detector], "solver": solver, "us_per_step": None, "contacts": None}
    steps = contacts = 0
    seconds = 0.0
    try:
        while seconds < _SECONDS:
            start = time.perf_counter()
            world.step(_AT_ONCE)
            seconds += time.perf_counter() - start
            steps += _AT_ONCE
            contacts = max(contacts, world.collision_result.num_contacts())
    except pydart2.SimulationError as error:
        return {**row, "error": str(error)}
    return {**row, "us_per_step": 1e6 * seconds / steps, "contacts": contacts}


def _text(data: dict[str, Any]) -> str:
    own = data["choices"][0]
    lines = [
        f"{data['dofs']} dofs, steps of {data['dt']:g} s: {1e6 / own['us_per_step']:,.0f} steps/s, "
        f"{_speed(own, data):.2g} times real time",
        f"dynamics {data['dynamics_us']:.3g} µs a step, collision and contact forces {data['contacts_us']:.3g} µs",
        "",
        table(
            [_cells(row, data) for row in data["choices"]], ("detector", "solver", "µs/step", "× real time", "contacts")
        ),
    ]
    fastest = max(data["choices"], key=lambda row: _speed(row, data))
    if _speed(fastest, data) > 1.1 * _speed(own, data):
        lines += [
            "",
            f"the first row is what the file has; {own['us_per_step'] / fastest['us_per_step']:.2g} times as fast is",
            f'  world.set_collision_detector("{fastest["detector"]}"); '
            f'world.set_constraint_solver("{fastest["solver"]}")',
            "Other detectors find other contacts.",
        ]
    return "\n".join(lines)


def _speed(row: dict[str, Any], data: dict[str, Any]) -> float:
    """Simulated seconds a second; 0 where the simulation failed."""
    return 1e6 * float(data["dt"]) / row["us_per_step"] if row["us_per_step"] else 0.0


def _cells(row: dict[str, Any], data: dict[str, Any]) -> tuple[object, ...]:
    choice = row["detector"], row["solver"]
    return (*choice, "failed") if "error" in row else (*choice, row["us_per_step"], _speed(row, data), row["contacts"])
