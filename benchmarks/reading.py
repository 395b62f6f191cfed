"""Reading all after a step, beside another checkout that is built: python benchmarks/reading.py CHECKOUT.

Its models are taken for both, since a model may have changed. Both processes live through all turns, on one processor:
what is compared is measured within a tenth of a second, and neither has the better one.
"""

from __future__ import annotations

import os
import sys
import time
from pathlib import Path
from statistics import median, quantiles

from harness import ENVIRONMENT, PLAYERS, ROOT, ROUNDS, Talk, microseconds, table

MODELS = {"fullbody1": "skel/fullbody1.skel", "Atlas": "sdf/atlas/atlas_v3_no_head.sdf", "chain": "skel/chain.skel"}
TURNS = 50 * ROUNDS
STEPS = 60
WITH_J = 10  # bodies


def play(path: str) -> None:
    """Answer with seconds of reading, and of a step and reading."""
    sys.path.insert(0, str(PLAYERS))
    from questions import talk

    import pydart2

    world = pydart2.World(0.001, path if path.endswith(".skel") else None)
    if not path.endswith(".skel"):
        world.add_skeleton(path)
    world.set_recording(False)
    skel, start = world.skeletons[-1], world.snapshot()
    bodies = skel.bodynodes

    def read() -> None:
        skel.q, skel.dq, skel.ddq, skel.C, skel.dC  # noqa: B018
        for body in bodies:
            body.T, body.C, body.dC, body.com_spatial_velocity()
        for body in bodies[:WITH_J]:
            body.J  # noqa: B018

    def reading() -> float:
        world.restore(start)
        taken = 0.0
        for _ in range(STEPS):
            world.step()
            begin = time.thread_time()
            read()
            taken += time.thread_time() - begin
        return taken / STEPS

    def both() -> float:
        world.restore(start)
        begin = time.thread_time()
        for _ in range(STEPS):
            world.step()
            read()
        return (time.thread_time() - begin) / STEPS

    talk({"reading": reading, "step and reading": both})


def compared(here: list[float], there: list[float]) -> str:
    """The median of the ratios, and their quartiles."""
    ratios = [a / b for a, b in zip(here, there, strict=True)]
    low, _, high = quantiles(ratios)
    return f"{median(ratios):.3f} ({low:.2f} to {high:.2f})"


def main(other: Path) -> None:
    """A row for each model and question."""
    os.sched_setaffinity(0, {max(os.sched_getaffinity(0))})
    rows: list[list[object]] = []
    for name, path in MODELS.items():
        talks = {
            checkout: Talk(
                [str(checkout / ".venv/bin/python"), __file__, "--play", str(other / "data" / path)],
                {**ENVIRONMENT, "PYTHONPATH": str(checkout)},
            )
            for checkout in (ROOT, other)
        }
        for question in talks[ROOT].names:
            times: dict[Path, list[float]] = {checkout: [] for checkout in talks}
            for turn in range(TURNS):
                for checkout, talk in list(talks.items())[:: 1 if turn % 2 else -1]:
                    times[checkout].append(talk.ask(question))
            here, there = times.values()
            rows.append([name, question, microseconds(here), microseconds(there), compared(here, there)])
        for talk in talks.values():
            talk.end()
    print(
        f"## Reading beside another checkout\n\nq, dq, ddq, C and dC, `T C dC com_spatial_velocity()` of all bodies, "
        f"J of {WITH_J}; {TURNS} turns, quartiles.\n"
    )
    print(table(["model", "", "here", "there", "ratio"], rows))


if __name__ == "__main__":
    if sys.argv[1] == "--play":
        play(sys.argv[2])
    else:
        main(Path(sys.argv[1]).resolve())
