"""Steps per second with the fast constraint solver, and with what changes its results, next to the engine's own.

The worlds of a scene step in turn, twenty steps at a time, and the processor time of the thread counts, so that what
else runs on the machine hits all alike. Arguments name some of the scenes.
"""

from __future__ import annotations

import statistics
import sys
import threading
import time
from collections.abc import Callable
from dataclasses import asdict, replace

import numpy as np
from harness import PLAYERS, table
from scenes import Scene, atlas_with_meshes, scenes

import pydart2

sys.path.append(str(PLAYERS))
from ours import Model

PIECE = 20  # steps
BARS = {"cubes": 1.65, "fullbody1": 2.7, "Atlas": 2.1, "Atlas with meshes": 2.1}
STEPS = {"cubes": 10_000, "fullbody1": 1_000, "Atlas": 3_000}
HEAP = "fullbody1, 1,000 steps later"  # a heap of limbs
KINDS: dict[str, Callable[[pydart2.World], None]] = {
    "dart": lambda world: world.set_constraint_solver("dart"),
    "fast": lambda world: world.set_constraint_solver("fast"),
    "warm": lambda world: world.set_warm_start(True),
    "reduced": lambda world: world.set_contact_reduction(True),
}


def worlds(scene: Scene) -> dict[str, pydart2.World]:
    """One for each way to solve; the last two are the fast solver with an option."""
    made = {}
    for kind, choose in KINDS.items():
        made[kind] = Model(asdict(scene)).world
        made[kind].set_constraint_solver("fast")
        choose(made[kind])
    return made


def seconds(world: pydart2.World) -> float:
    """Processor time of a piece."""
    begin = time.thread_time()
    world.step(PIECE)
    return time.thread_time() - begin


def measure(scene: Scene) -> list[object]:
    """A line of the table."""
    steps = STEPS.get(scene.name, 600)
    made = worlds(scene)
    if scene.name == HEAP:
        for world in made.values():
            world.step(1_000)
    times: dict[str, list[float]] = {kind: [] for kind in KINDS}
    off = dict.fromkeys(KINDS, 0.0)
    contacts = []
    for piece in range(steps // PIECE):
        kinds = list(KINDS)[:: 1 if piece % 2 else -1]
        for kind in kinds:
            times[kind].append(seconds(made[kind]))
        for kind in kinds:
            off[kind] = max(off[kind], np.abs(made[kind].x - made["dart"].x).max())
        contacts.append(made["fast"].collision_result.num_contacts())
    assert off["fast"] == 0.0
    mean = {kind: sum(spent) / steps for kind, spent in times.items()}
    low, _, high = statistics.quantiles((a / b for a, b in zip(times["dart"], times["fast"])), n=4)
    bar = BARS.get(scene.name)
    ratio = mean["dart"] / mean["fast"]
    met = f"≥ {bar} {'met' if ratio >= bar else '**missed**'}" if bar else ""
    options = [
        f"{mean['fast'] / mean[kind]:.2f}, {off[kind]:.0e}" if off[kind] else f"{mean['fast'] / mean[kind]:.2f}, 0"
        for kind in ("warm", "reduced")
    ]
    fast = f"{ratio:.2f} ({low:.2f} to {high:.2f})"
    return [scene.name, f"{mean['dart'] * 1e6:.0f} µs", fast, met, f"{statistics.mean(contacts):.0f}", *options]


def main() -> None:
    """A line per scene."""
    found = [scene for scene in scenes().values() if scene.name not in ("chain", "PR2")] + atlas_with_meshes()
    found.insert(2, replace(scenes()["fullbody1"], name=HEAP))
    found = [scene for scene in found if not sys.argv[1:] or scene.name in sys.argv[1:]]
    rows = [measure(scene) for scene in found]
    thread = threading.Thread(target=int)
    thread.start()
    thread.join()
    for scene, row in zip(found, rows, strict=True):
        row[4:4] = measure(scene)[2:4]
    print(
        "## The fast constraint solver\n\n"
        "Steps per second with the fast solver, with DART's own as 1: over all steps (quartiles of the pieces). The\n"
        "states are the same to the bit. The options change them: steps per second with the fast solver as 1, and the\n"
        "largest difference of a coordinate or velocity from the engine's states. With threads: in a process that\n"
        "has, or has had, a second one, as programs that use NumPy have; the C++ library then counts references with\n"
        "locked instructions, and the fast solver touches fewer.\n"
    )
    ratios = ["fast", "bar", "with threads", "bar"]
    print(table(["scene", "a step of DART", *ratios, "contacts", "warm start", "contact reduction"], rows))


if __name__ == "__main__":
    main()
