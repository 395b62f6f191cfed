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
from numpy.typing import NDArray

import pydart2

Array = NDArray[np.float64]
NEW = ("native", "iterative")
OLD = ("fcl", "fast")
SECONDS, COMPARED = 2.0, 0.2  # of each scene; after how many poses are compared
PATIENCE = 20.0  # s of the processor for one scene with one of the two
ROOT = Path(pydart2.data_path("skel/cubes.skel")).parents[1]
SAMPLES = Path("/usr/share/doc/dart/data")  # of Debian's dart-doc

HEAD = """# The default detector and solver beside the new ones

Each scene for {seconds:g} s: with FCL and `"fast"`, the defaults, and with `"native"` and `"iterative"`.
`python benchmarks/defaults.py` writes this page. Time is the median of a step's, of the processor; contacts are the
most that there were; "at rest" is the fastest dof at the end, m/s or rad/s; "apart" how far centres of mass are from
each other after {compared:g} s, in m. Files that do not load, or in which nothing touches, are left out: {without}.

"""
ADVICE = """
The default stays as it is: the engine's bits are promised under it, and soft bodies touch with FCL alone (without it
they fall, as in `softBodies`). For rigid bodies the new ones take less time from the first contact on, but where meshes
meet other shapes; poses part by less than a centimetre, but for a mesh that falls on an edge, and rest is mostly
quieter. From five boxes on each other on, or some 30 contacts in one group, they take a tenth of the time and less:
name them there, and wherever many bodies lie about.
"""


def from_file(path: Path) -> pydart2.World:
    """A world of a file, or its one model, limp, a little above a ground."""
    if path.suffix == ".skel":
        return pydart2.World(0.001, str(path))
    world = pydart2.World(0.001, up="z")
    world.add_ground()
    robot = world.add_skeleton(str(path), base="free")
    lowest = min(body.C[2] for body in robot.bodynodes)
    robot.set_position_limits_enforced(True)
    robot.set_positions({robot.dofs[5].name: robot.q[5] - lowest + 0.2})
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


def run(world: pydart2.World, detector: str, solver: str) -> tuple[float, int, float, Array]:
    """Time of a step, s; contacts; speed at the end; centres on the way."""
    world.set_recording(False)
    world.set_collision_detector(detector)
    world.set_constraint_solver(solver)
    times, contacts = [], 0
    centres = np.zeros(0)
    piece = max(1, round(0.02 / world.dt))
    for _ in range(round(SECONDS / (piece * world.dt))):
        begin = time.process_time()
        world.step(piece)
        times.append((time.process_time() - begin) / piece)
        contacts = max(contacts, len(world.contacts))
        if world.t <= COMPARED + 1e-9:
            centres = np.array([skel.C for skel in world.skeletons if skel.ndofs]).ravel()
        elif sum(times) * piece > PATIENCE:
            break
    speed = max((float(np.abs(skeleton.dq).max(initial=0.0)) for skeleton in world.skeletons), default=0.0)
    return statistics.median(times), contacts, speed, centres


def line(name: str, make: Callable[[], pydart2.World]) -> list[object] | None:
    """Of a scene; None where nothing touches, or that does not load."""
    results = []
    for detector, solver in (OLD, NEW):
        try:
            results.append(run(make(), detector, solver))
        except pydart2.LoadError:
            return None
        except pydart2.SimulationError as error:
            return [name, *["–"] * 3, str(error).split(":")[0]]
    (old, new) = results
    if old[1] == new[1] == 0:
        return None
    return [
        name,
        f"{old[0] * 1e6:.0f} / {new[0] * 1e6:.0f}",
        f"{old[1]} / {new[1]}",
        f"{old[2]:.1g} / {new[2]:.1g}",
        f"{np.abs(old[3] - new[3]).max(initial=0.0):.1g}",
    ]


if __name__ == "__main__":
    lines = [line(*scene) for scene in scenes()]
    touching = [each for each in lines if each is not None]
    print(HEAD.format(seconds=SECONDS, compared=COMPARED, without=len(lines) - len(touching)), end="")
    print(table(["scene", "µs a step", "contacts", "at rest", "apart"], touching))
    print(ADVICE, end="")
