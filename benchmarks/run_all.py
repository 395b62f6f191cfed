"""Runs every benchmark and writes RESULTS.md beside this file."""

from __future__ import annotations

import os
import platform
import sys
from pathlib import Path

from harness import ROUNDS, output

import pydart2

FOLDER = Path(__file__).resolve().parent
QUESTIONS = (
    "step",
    "dynamics",
    "integrators",
    "robots",
    "access",
    "control",
    "engine",
    "solver",
    "newer_engine",
    "profiles",
    "batch",
    "rollouts",
    "loading",
)
HEAD = """# Measured

`make bench` writes this file. Every competitor runs in the same session, in turn, {rounds} rounds; times are CPU time,
and what counts are the ratios. DART's own constraint solver unless said otherwise; sleeping off in PyPI's dartpy, whose
engine is another one (its states differ).

{machine}, {cpus} processors, Python {python}, pydart2 {version}.
"""


def main() -> None:
    """Run all, or those named on the command line."""
    parts = [
        HEAD.format(
            rounds=ROUNDS,
            machine=platform.machine(),
            cpus=os.cpu_count(),
            python=platform.python_version(),
            version=pydart2.__version__,
        )
    ]
    for question in sys.argv[1:] or QUESTIONS:
        print(f"{question} ...", flush=True)
        parts.append(output(sys.executable, FOLDER / f"{question}.py"))
    (FOLDER / "RESULTS.md").write_text("\n".join(parts), encoding="utf-8")
    print(f"written: {FOLDER / 'RESULTS.md'}")


if __name__ == "__main__":
    main()
