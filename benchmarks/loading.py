"""Loading, memory per world, import time, and memory over a million steps."""

from __future__ import annotations

import resource
import statistics
import sys

from harness import DEBIAN, OURS, PYPI, competitors, output, rounds, table
from scenes import atlas_with_meshes, scenes

import pydart2

IMPORT = "import time; t = time.thread_time(); import {}; print(time.thread_time() - t)"


def loading() -> None:
    """Milliseconds and megabytes of each scene."""
    rows: list[list[object]] = []
    for scene in [*scenes().values(), *atlas_with_meshes()]:
        found = rounds(competitors(), "load", scene)
        cells: list[object] = [scene.name]
        for player in (OURS, DEBIAN, PYPI):
            seconds, memory = (statistics.median(r[player][key] for r in found) for key in ("seconds", "bytes"))
            cells.append(f"{seconds * 1e3:.3g} ms, {memory / 2**20:.2g} MB")
        rows.append(cells)
    print("## Loading\n\nTime to load once more, and memory of each further world.\n")
    print(table(["scene", OURS, DEBIAN, PYPI], rows))


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
