"""Runs the competitors in turn, several rounds, and turns their times into ratios with their spread."""

from __future__ import annotations

import json
import os
import statistics
import subprocess
import sys
import venv
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from scenes import Scene

ROOT = Path(__file__).resolve().parent.parent
PLAYERS = ROOT / "benchmarks" / "players"
BUILD = ROOT / "build" / "bench"
ENVIRONMENT = {**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "PYTHONPATH": str(ROOT)}
ROUNDS = int(os.environ.get("BENCH_ROUNDS", "7"))

Figures = dict[str, float]
Player = Callable[[str, Scene], Figures]
OURS, DEBIAN, PYPI, LOOP = "pydart2", "dartpy 6.12 (Debian)", "dartpy (PyPI)", "C++ loop"


def output(*command: str | Path, **environment: str) -> str:
    """What a child process prints; if it fails, its errors end this program."""
    env = {**ENVIRONMENT, **environment}
    done = subprocess.run([str(c) for c in command], env=env, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command[:3]))} failed:\n{done.stderr[-2000:]}")
    return done.stdout


def python_player(python: str | Path, program: str, **environment: str) -> Player:
    """A competitor in Python."""

    def play(question: str, scene: Scene) -> Figures:
        answer = output(python, PLAYERS / program, question, scene.dump(), **environment)
        figures: Figures = json.loads(answer.splitlines()[-1])
        return figures

    return play


def pypi_dartpy() -> Path:
    """The Python of a virtual environment of its own with PyPI's dartpy."""
    folder = BUILD / "dartpy"
    python = folder / "bin" / "python"
    if not (folder / ".ready").exists():
        venv.create(folder, with_pip=True, clear=True)
        output(python, "-m", "pip", "install", "--quiet", "dartpy", "numpy")
        (folder / ".ready").touch()
    return python


def competitors() -> dict[str, Player]:
    """The bindings, by name."""
    return {
        OURS: python_player(sys.executable, "ours.py"),
        DEBIAN: python_player("/usr/bin/python3", "dartpy_player.py"),
        PYPI: python_player(pypi_dartpy(), "dartpy_player.py"),
    }


def rounds(players: dict[str, Player], question: str, scene: Scene) -> list[dict[str, Figures]]:
    """The figures of each player in each round; the players take turns."""
    return [{name: play(question, scene) for name, play in players.items()} for _ in range(ROUNDS)]


@dataclass(frozen=True)
class Ratio:
    """A ratio in each round."""

    values: list[float]

    @property
    def median(self) -> float:
        return statistics.median(self.values)

    def __str__(self) -> str:
        return f"{self.median:.2f} ({min(self.values):.2f} to {max(self.values):.2f})"


def table(head: list[str], rows: list[list[object]]) -> str:
    """A Markdown table."""
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join("| " + " | ".join(str(cell) for cell in line) + " |" for line in lines)


def microseconds(values: list[float]) -> str:
    """The median of some times."""
    return f"{statistics.median(values) * 1e6:.3g} µs"


def met(ratio: Ratio, bar: float, at_least: bool = False) -> str:
    """The bar, and whether the median meets it."""
    reached = ratio.median >= bar if at_least else ratio.median <= bar
    return f"{'≥' if at_least else '≤'} {bar:g} {'met' if reached else '**missed**'}"
