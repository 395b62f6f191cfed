"""Steps per second with the fast constraint solver against the engine's own, in one run.

Both worlds step in turn, a hundred steps at a time through the same states, and the processor time of the thread
counts, so that what else runs on the machine hits both alike and little. Prints for each scene the ratio over all
steps and the quartiles of the pieces, and the mean times of a step.
"""

from __future__ import annotations

import json
import statistics
import sys
import time
from pathlib import Path

import pydart2

PIECE = 100  # steps


def skel(name: str, step: float) -> pydart2.World:
    """One of the package's worlds."""
    return pydart2.World(step, pydart2.data_path(f"skel/{name}.skel"))


def atlas() -> pydart2.World:
    """Atlas held by springs, standing on the ground."""
    scene = json.loads(Path(pydart2.data_path("sdf/atlas/standing.json")).read_text(encoding="ascii"))
    world = pydart2.World(scene["time_step"], pydart2.data_path(scene["world"]))
    robot = world.add_skeleton(pydart2.data_path(scene["robot"]))
    robot.set_positions(scene["q"])
    for dof in robot.dofs[6:]:
        dof.set_spring_stiffness(scene["stiffness"])
        dof.set_rest_position(dof.position())
        dof.set_damping_coefficient(scene["damping"])
    return world


# World, steps, and the ratio to reach.
SCENES = {
    "cubes": (lambda: skel("cubes", 0.001), 20_000, 1.65),
    "fullbody1": (lambda: skel("fullbody1", 1.0 / 2000.0), 2_000, 2.7),
    "Atlas on the ground": (atlas, 3_000, 2.1),
    "shapes": (lambda: skel("shapes", 0.001), 3_000, None),
    "softBodies": (lambda: skel("softBodies", 0.001), 500, None),
}


def seconds(world: pydart2.World) -> float:
    """Processor time of a piece."""
    begin = time.thread_time()
    world.step(PIECE)
    return time.thread_time() - begin


def main() -> None:
    """Print a line per scene; arguments name some of them."""
    for name, (make, steps, bar) in SCENES.items():
        if sys.argv[1:] and name.split()[0] not in sys.argv[1:]:
            continue
        worlds = {kind: make() for kind in ("dart", "fast")}
        for kind, world in worlds.items():
            world.disable_recording()
            world.set_constraint_solver(kind)
        times: dict[str, list[float]] = {"dart": [], "fast": []}
        contacts = []
        for piece in range(steps // PIECE):
            for kind in ("dart", "fast") if piece % 2 else ("fast", "dart"):
                times[kind].append(seconds(worlds[kind]))
            contacts.append(len(worlds["fast"].collision_result.contacts))
        low, _, high = statistics.quantiles((a / b for a, b in zip(times["dart"], times["fast"])), n=4)
        dart, fast = (sum(times[kind]) / steps * 1e6 for kind in ("dart", "fast"))
        wanted = f", wanted {bar}" if bar else ""
        print(
            f"{name}: {dart / fast:.2f} ({low:.2f} to {high:.2f}){wanted}; "
            f"{dart:.0f} and {fast:.0f} µs a step, {statistics.mean(contacts):.0f} contacts"
        )


if __name__ == "__main__":
    main()
