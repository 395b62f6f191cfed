"""A batch of 64 fullbody1 on two threads, two Python threads with a world each, and two C++ processes."""

from __future__ import annotations

import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy as np
from harness import ROUNDS, Ratio, met, output
from loop import loop_arguments, loop_folder
from scenes import scenes

import pydart2

FOLDER = Path(__file__).resolve().parent
WORLDS, STEPS, THREADS = 64, 60, 2
SCENE = scenes()["fullbody1"]


# Steps per second in a process that has had a second thread, to those before.
ONE_WORLD = """
import threading, time
from batch import SCENE, warm_world
world = warm_world()
start = world.x
def steps_per_second():
    world.x = start
    begin = time.perf_counter()
    world.step(SCENE.steps)
    return SCENE.steps / (time.perf_counter() - begin)
alone = [steps_per_second() for _ in range(5)]
thread = threading.Thread(target=int)
thread.start()
thread.join()
print(sorted(steps_per_second() for _ in range(5))[2] / sorted(alone)[2])
"""


def warm_world(solver: str = "dart") -> pydart2.World:
    """fullbody1 on the ground."""
    world = pydart2.World(SCENE.dt, SCENE.world)
    world.set_recording(False)
    world.set_constraint_solver(solver)
    world.step(SCENE.warm)
    return world


def loops(processes: int, threads: int) -> float:
    """Steps per second that C++ processes with so many threads each reach together, in as many steps as the batch."""
    repeats = WORLDS // (processes * threads)
    command = [str(loop_folder() / "loop"), str(STEPS), str(repeats), str(threads), *loop_arguments(SCENE)]
    running = [subprocess.Popen(command, stdout=subprocess.PIPE, text=True) for _ in range(processes)]
    return sum(threads / float(process.communicate()[0].split()[1]) for process in running)


def batch(pool: pydart2.Batch) -> float:
    """Steps per second of a batch."""
    pool.reset()
    begin = time.perf_counter()
    pool.step(STEPS)
    return WORLDS * STEPS / (time.perf_counter() - begin)


def python_threads(worlds: list[pydart2.World], start: np.ndarray) -> float:
    """Steps per second of Python threads with a world each."""
    for world in worlds:
        world.x = start
    threads = [threading.Thread(target=world.step, args=(SCENE.steps,)) for world in worlds]
    begin = time.perf_counter()
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    return len(worlds) * SCENE.steps / (time.perf_counter() - begin)


def main() -> None:
    """Ratios of steps per second, by the clock on the wall: nothing else should run on the machine."""
    model = warm_world()
    start = model.x
    pool = pydart2.Batch(model, WORLDS, threads=THREADS)
    fast = pydart2.Batch(warm_world("fast"), WORLDS, threads=THREADS)
    worlds = [warm_world() for _ in range(THREADS)]
    to_processes, fast_to_processes, to_one, threaded, limit, to_limit = [], [], [], [], [], []
    for _ in range(ROUNDS):
        both, one = loops(THREADS, 1), loops(1, THREADS)
        limit.append(one / both)
        ours = batch(pool)
        to_processes.append(ours / both)
        to_limit.append(ours / one)
        fast_to_processes.append(batch(fast) / both)
        threaded.append(
            float(output(sys.executable, "-c", ONE_WORLD, PYTHONPATH=str(FOLDER), OPENBLAS_NUM_THREADS="1"))
        )
        to_one.append(python_threads(worlds, start) / python_threads(worlds[:1], start))
    ratio, two = Ratio(to_processes), Ratio(to_one)
    print("## Many worlds\n\nfullbody1, steps per second by the clock on the wall.\n")
    bars = met(ratio, 0.95, at_least=True), met(two, 1.6, at_least=True)
    print(f"Batch of {WORLDS} on {THREADS} threads to {THREADS} C++ processes: {ratio}; {bars[0]}.\n")
    print(
        f"What sets the limit: a C++ program with {THREADS} threads reaches {Ratio(limit)} of {THREADS} processes, the "
        f"batch {Ratio(to_limit)} of that program. In a process that has, or has had, a second thread the C++ library "
        "counts the references to the engine's objects with locked instructions; one world alone then does "
        f"{Ratio(threaded)} of the steps per second.\n"
    )
    print(f"With the fast constraint solver, to the same C++ processes: {Ratio(fast_to_processes)}.\n")
    print(f"Two Python threads with two worlds to one: {two}; {bars[1]}.")


if __name__ == "__main__":
    main()
