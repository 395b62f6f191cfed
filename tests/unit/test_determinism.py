"""The same seed gives the same numbers, bit for bit: again, in other processes, and with other threads at work."""

from __future__ import annotations

import os
import subprocess
import sys

import pytest

RUN = """
import hashlib, sys, threading
import numpy as np
import pydart2

def run(detector, seed):
    world = pydart2.World(0.001, pydart2.data_path("skel/fullbody1.skel"))
    world.set_collision_detector(detector)
    rng = np.random.default_rng(seed)
    skel = world.skeletons[-1]
    digest = hashlib.sha256()
    for _ in range(100):
        skel.tau = rng.uniform(-0.1, 0.1, skel.ndofs)
        world.step(2)
        digest.update(world.x.tobytes())
        digest.update(world.collision_result.rows.tobytes())
    return digest.hexdigest()

detector, threads, padding = map(int, sys.argv[1:])
junk = [bytearray(1000 + i) for i in range(padding)]  # other addresses
others = [threading.Thread(target=run, args=(detector, seed)) for seed in range(1, threads)]
for thread in others:
    thread.start()
print("=", run(detector, 0), run(detector, 0))
for thread in others:
    thread.join()
"""


def digests(detector: int, threads: int, hash_seed: str, padding: int) -> list[str]:
    """Of two runs with one seed, in a process with so many threads at work."""
    environment = os.environ | {"PYTHONHASHSEED": hash_seed}
    command = [sys.executable, "-c", RUN, str(detector), str(threads), str(padding)]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr[-2000:]
    return next(line for line in done.stdout.splitlines() if line.startswith("= ")).split()[1:]


@pytest.mark.parametrize("detector", (0, 1, 2, 3, 10))
def test_same_seed_same_numbers(detector: int) -> None:
    seen = digests(detector, 1, "0", 0) + digests(detector, 1, "123", 5000) + digests(detector, 3, "7", 77)
    assert len(seen) == 6 and len(set(seen)) == 1
