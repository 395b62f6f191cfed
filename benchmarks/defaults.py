"""Models and scenes under the default detector and solver and under the new ones, as a page of the docs.

python benchmarks/defaults.py >docs/howto/defaults.md
"""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import heaps
import numpy as np
from harness import table

import pydart2

NEW = ("native", "iterative")
OLD = ("fcl", "fast")
SECONDS, COMPARED = 2.0, 0.2  # of each scene; after how many poses are compared
ROOT = Path(pydart2.data_path("."))
SAMPLES = Path("/usr/share/doc/dart/data")  # of Debian's dart-doc

HEAD = """# The default detector and solver beside the new ones

Each scene for {seconds:g} s: with FCL and `"fast"`, the defaults, and with `"native"` and `"iterative"`.
`python benchmarks/defaults.py` writes this page. Time is the median of a step's; "at rest" is the fastest dof at the
end, m/s or rad/s; "apart" how far centres of mass are from each other after {compared:g} s, in m.

"""
ADVICE = """
The default stays as it is: the engine's bits are promised under it. From some 30 contacts in one group on (a stack of
five boxes), and wherever many bodies lie about, take `"native"` with `"iterative"`.
"""


def from_file(path: Path) -> pydart2.World:
    """A world of a file, or its one model on a ground."""
    try:
        return pydart2.World(0.001, str(path))
    except pydart2.Error:
        world = pydart2.World(0.001)
        world.add_ground()
        world.add_skeleton(str(path))
        return world


def from_scene(scene: heaps.Scene) -> pydart2.World:
    """A scene of benchmarks/heaps.py, not yet stepped."""
    return heaps.Ours(scene, *OLD).world


def scenes() -> Iterator[tuple[str, Callable[[], pydart2.World]]]:
    """Names, and how each is made."""
    for path in sorted(ROOT.glob("skel/*.skel")):
        if path.stem != "ground":
            yield path.stem, lambda path=path: from_file(path)
    for path in (ROOT / "sdf/atlas/atlas_v3_no_head.sdf", ROOT / "urdf/PR2/pr2.urdf"):
        yield f"{path.stem} on a ground", lambda path=path: from_file(path)
    for path in sorted(SAMPLES.glob("skel/**/*.skel")):
        yield f"dart-doc: {path.stem}", lambda path=path: from_file(path)
    for name in (
        "10 boxes apart",
        "200 boxes apart",
        "stack of 5",
        "stack of 10",
        "stack of 20",
        "wall of 16",
        "wall of 36",
    ):
        yield name, lambda name=name: from_scene(heaps.SCENES[name]())


def run(world: pydart2.World, detector: str, solver: str) -> tuple[float, int, float, np.ndarray]:
    """Time of a step, s; contacts and speed at the end; centres on the way."""
    world.set_recording(False)
    world.set_collision_detector(detector)
    world.set_constraint_solver(solver)
    times = []
    centres = np.zeros(0)
    piece = max(1, round(0.02 / world.dt))
    for _ in range(round(SECONDS / (piece * world.dt))):
        begin = time.perf_counter()
        world.step(piece)
        times.append((time.perf_counter() - begin) / piece)
        if world.t <= COMPARED + 1e-9:
            centres = np.concatenate([skeleton.C for skeleton in world.skeletons])
    speed = max((float(np.abs(skeleton.dq).max(initial=0.0)) for skeleton in world.skeletons), default=0.0)
    return statistics.median(times), len(world.contacts), speed, centres


def line(name: str, make: Callable[[], pydart2.World]) -> list[object]:
    """Of a scene."""
    results = []
    for detector, solver in (OLD, NEW):
        try:
            results.append(run(make(), detector, solver))
        except pydart2.Error as error:
            return [name, *["–"] * 3, str(error).split(":")[0]]
    (old, new) = results
    return [
        name,
        f"{old[0] * 1e6:.0f} / {new[0] * 1e6:.0f}",
        f"{old[1]} / {new[1]}",
        f"{old[2]:.1g} / {new[2]:.1g}",
        f"{np.abs(old[3] - new[3]).max(initial=0.0):.1g}",
    ]


if __name__ == "__main__":
    print(HEAD.format(seconds=SECONDS, compared=COMPARED), end="")
    print(table(["scene", "µs a step", "contacts", "at rest", "apart"], [line(*scene) for scene in scenes()]))
    print(ADVICE, end="")
