"""The heap of very many robots is in pages of 2 MB, where the kernel can do that."""

from __future__ import annotations

import mmap
import subprocess
import sys

import pytest

COLLAPSE = 25  # MADV_COLLAPSE, of Linux 6.1
PROGRAM = """
import pydart2

def of_heap(what):
    own, found = False, 0
    for line in open("/proc/self/smaps"):
        if "-" in line.split()[0]:
            own = line.rstrip().endswith("[heap]")
        elif own and line.startswith(what + ":"):
            found += int(line.split()[1])
    return found

world = pydart2.World(0.001, up="y")
pydart2.set_verbose(False)
for i in range(COUNT):
    robot = world.add_skeleton(pydart2.data_path("sdf/atlas/atlas_v3_no_head.sdf"))
    robot.set_positions({robot.dofs[3].name: 3.0 * i})
world.step()
print(of_heap("Size"), of_heap("AnonHugePages"))
"""


def in_large_pages(count: int) -> tuple[int, int]:
    """KB of the heap of a process that steps so many Atlas, and of these those in large pages."""
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM.replace("COUNT", str(count))], capture_output=True, text=True, timeout=300
    )
    assert done.returncode == 0, done.stderr
    size, large = map(int, done.stdout.split())
    return size, large


def test_many_robots() -> None:
    memory = mmap.mmap(-1, 8 << 20)
    memory.write(bytes(8 << 20))
    try:
        memory.madvise(COLLAPSE)
    except OSError as error:
        pytest.skip(f"this kernel does not make large pages when asked: {error}")
    size, large = in_large_pages(160)
    assert size > 100_000
    assert large > size - 10_000  # but for the ends, and what the step itself took
    assert in_large_pages(1)[1] == 0  # which would not be worth the time
