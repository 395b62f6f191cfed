"""Runs the competitors in turn, several rounds, and turns their times into ratios with their spread."""

from __future__ import annotations

import json
import os
import statistics
import subprocess
import sys
import venv
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from scenes import Scene

ROOT = Path(__file__).resolve().parent.parent
PLAYERS = ROOT / "benchmarks" / "players"
BUILD = ROOT / "build" / "bench"
ENVIRONMENT = {**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "PYTHONPATH": str(ROOT)}
ROUNDS = int(os.environ.get("BENCH_ROUNDS", "7"))
TURNS = 5 * ROUNDS

Figures = dict[str, float]
Player = Callable[[str, Scene], Figures]  # answers a question
OURS, DEBIAN, PYPI, LOOP = "pydart2", "dartpy 6.12 (Debian)", "dartpy (PyPI)", "C++ loop"


def output(*command: str | Path, **environment: str) -> str:
    """What a child process prints; if it fails, its errors end this program."""
    env = {**ENVIRONMENT, **environment}
    done = subprocess.run([str(c) for c in command], env=env, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command[:3]))} failed:\n{done.stderr[-2000:]}")
    return done.stdout


class Talk:
    """A competitor that has loaded a scene, and is asked for one figure after the other."""

    def __init__(self, command: list[str], environment: dict[str, str]) -> None:
        self._process = subprocess.Popen(
            command,
            env=environment,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            text=True,
        )
        self.names: list[str] = json.loads(self._line())

    def ask(self, name: str) -> float:
        """Seconds, once more."""
        assert self._process.stdin
        print(name, file=self._process.stdin, flush=True)
        return float(self._line())

    def end(self) -> None:
        """No more questions."""
        self._process.communicate()

    def _line(self) -> str:
        assert self._process.stdout
        while line := self._process.stdout.readline():
            if line.startswith("answer "):
                return line.partition(" ")[2]
        sys.exit(f"{self._process.args} failed")


@dataclass(frozen=True)
class PythonPlayer:
    """A competitor in Python."""

    python: str | Path
    program: str
    environment: dict[str, str] = field(default_factory=dict)

    def __call__(self, question: str, scene: Scene) -> Figures:
        answer = output(*self._command(question, scene), **self.environment)
        figures: Figures = json.loads(answer.splitlines()[-1])
        return figures

    def talk(self, question: str, scene: Scene) -> Talk:
        """A process that answers again and again."""
        return Talk(self._command(question, scene), {**ENVIRONMENT, **self.environment})

    def _command(self, question: str, scene: Scene) -> list[str]:
        return [str(self.python), str(PLAYERS / self.program), question, scene.dump()]


def pypi_dartpy() -> Path:
    """The Python of a virtual environment of its own with PyPI's dartpy."""
    folder = BUILD / "dartpy"
    python = folder / "bin" / "python"
    if not (folder / ".ready").exists():
        venv.create(folder, with_pip=True, clear=True)
        output(python, "-m", "pip", "install", "--quiet", "dartpy", "numpy")
        (folder / ".ready").touch()
    return python


def competitors() -> dict[str, PythonPlayer]:
    """The bindings, by name."""
    return {
        OURS: PythonPlayer(sys.executable, "ours.py"),
        DEBIAN: PythonPlayer("/usr/bin/python3", "dartpy_player.py"),
        PYPI: PythonPlayer(pypi_dartpy(), "dartpy_player.py"),
    }


def rounds(players: Mapping[str, Player], question: str, scene: Scene) -> list[dict[str, Figures]]:
    """The figures of each player in each round; the players take turns, in a process of their own each time."""
    return [{name: play(question, scene) for name, play in players.items()} for _ in range(ROUNDS)]


def turns(players: Mapping[str, PythonPlayer], question: str, scene: Scene) -> list[dict[str, Figures]]:
    """The same, in processes that live as long as all rounds, with a turn for every figure: what is compared is
    measured within a fraction of a second."""
    talks = {name: player.talk(question, scene) for name, player in players.items()}
    found: list[dict[str, Figures]] = []
    for _ in range(TURNS):
        found.append({player: {} for player in talks})
        for name in talks[OURS].names:
            for player, talk in talks.items():
                found[-1][player][name] = talk.ask(name)
    for talk in talks.values():
        talk.end()
    return found


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
