"""Loading, memory per world, import time, and memory over a million steps."""

from __future__ import annotations

import resource
import statistics
import sys

from harness import DEBIAN, OURS, PLAYERS, PYPI, ROOT, ROUNDS, competitors, output, rounds, table
from scenes import atlas_with_meshes, scenes

import pydart2

IMPORT = "import time; t = time.thread_time(); import {}; print(time.thread_time() - t)"
CLONES = """
import json, sys, time
from ours import Model
from questions import resident
world = Model(json.loads(sys.argv[1])).world
kept = [world.clone()]
before, start = resident(), time.thread_time()
kept += [world.clone() for _ in range(40)]
print((time.thread_time() - start) / 40, (resident() - before) / 40)
"""


def cell(seconds: float, memory: float) -> str:
    return f"{seconds * 1e3:.3g} ms, {memory / 2**20:.2g} MB"


def loading() -> None:
    """Milliseconds and megabytes of each scene."""
    paths = f"{ROOT}:{PLAYERS}"
    rows: list[list[object]] = []
    for scene in [*scenes().values(), *atlas_with_meshes()]:
        found = rounds(competitors(), "load", scene)
        cells: list[object] = [scene.name]
        for player in (OURS, DEBIAN, PYPI):
            seconds, memory = (statistics.median(r[player][key] for r in found) for key in ("seconds", "bytes"))
            cells.append(cell(seconds, memory))
        clones = [output(sys.executable, "-c", CLONES, scene.dump(), PYTHONPATH=paths).split() for _ in range(ROUNDS)]
        cells.append(cell(*(statistics.median(map(float, figures)) for figures in zip(*clones, strict=True))))
        rows.append(cells)
    print("## Loading\n\nTime to load once more, and memory of each further world; the same of clones.\n")
    print(table(["scene", OURS, DEBIAN, PYPI, f"{OURS}, clone"], rows))


def importing() -> None:
    """CPU time of the import statement, after NumPy and alone; with compiled Python files, as after an installation."""
    more = []
    output(sys.executable, "-c", "import pydart2", PYTHONDONTWRITEBYTECODE="")
    for _ in range(9):
        seconds = [float(output(sys.executable, "-c", IMPORT.format(m))) for m in ("numpy", "pydart2")]
        more.append((seconds[1] - seconds[0]) * 1e3)
    middle = statistics.median(more)
    verdict = "met" if middle <= 60 else "**missed**"
    print(
        f"\n`import pydart2` takes {middle:.0f} ms more than `import numpy` ({min(more):.0f} to {max(more):.0f}); ",
        end="",
    )
    print(f"≤ 60 ms {verdict}.")


def million_steps() -> None:
    """The process's largest size after the recording has filled its limit, and at the end."""
    world = pydart2.World(0.001, pydart2.data_path("skel/chain.skel"))
    sizes = []
    for _ in range(10):
        world.step(100_000)
        sizes.append(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss // 1024)
    frames = world.num_frames()
    print(f"\nLargest size in memory over 1,000,000 steps of chain: {', '.join(map(str, sizes))} MB (every 100,000);")
    print(f"{frames:,} frames made, {frames - world.recording.first_frame:,} kept.")


if __name__ == "__main__":
    loading()
    importing()
    million_steps()
