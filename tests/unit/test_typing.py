"""A user's script is clean under mypy --strict and pyright; the examples are such scripts."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pydart2
from pydart2.resources import examples_folder

PACKAGE = Path(pydart2.__file__).resolve().parent

SCRIPT = """
import numpy as np

import pydart2
from pydart2 import BodyNode, Skeleton, World

world: World = pydart2.World(0.001, "./data/skel/fullbody1.skel")
skel: Skeleton = world.skeletons[1]
foot: BodyNode = skel.body("h_heel_left")
q = skel.q
q["j_shin_left", "j_shin_right"] = 0.3, 0.3
skel.q = q
skel.tau = [0.0] * skel.ndofs
world.step(3)
height: float = float(foot.C[1])
J = foot.linear_jacobian()
force = J.T @ np.array([0.0, 1.0, 0.0])
names: list[str] = [dof.name for dof in skel.dofs]
reveal_type(skel.M)
"""

WRONG = """
import pydart2

world = pydart2.World("a step")
world.skeletons[0].mass() + "kg"
world.stepp()
"""


def run(*command: str | Path, cwd: Path) -> str:
    """What a checker prints; it may find something."""
    env = {**os.environ, "PYTHONPATH": str(PACKAGE.parent), "MYPYPATH": str(PACKAGE.parent)}
    done = subprocess.run([str(c) for c in command], cwd=cwd, env=env, capture_output=True, text=True, timeout=300)
    assert done.returncode in (0, 1), done.stdout + done.stderr
    return done.stdout


def user_folder(folder: Path) -> Path:
    """The examples and a script, away from the checkout."""
    for path in examples_folder().glob("*.py"):
        (folder / path.name).write_text(path.read_text())
    (folder / "script.py").write_text(SCRIPT)
    (folder / "wrong.py").write_text(WRONG)
    return folder


def test_mypy(tmp_path: Path) -> None:
    folder = user_folder(tmp_path)
    scripts = sorted(folder.glob("*.py"))
    output = run(sys.executable, "-m", "mypy", "--strict", "--cache-dir", ".cache", *scripts, cwd=folder)
    errors = [line for line in output.splitlines() if ": error: " in line and not line.startswith("/")]  # the user's
    assert [line for line in errors if not line.startswith("wrong.py")] == []
    assert [line.split(":")[1] for line in errors] == ["4", "5", "6"]  # of wrong.py
    assert 'Revealed type is "numpy.ndarray[' in output


def test_pyright(tmp_path: Path) -> None:
    folder = user_folder(tmp_path)
    report = json.loads(
        run(sys.executable, "-m", "pyright", "--outputjson", "--pythonpath", sys.executable, cwd=folder)
    )
    found = [(Path(d["file"]).name, d["range"]["start"]["line"] + 1) for d in report["generalDiagnostics"]
             if d["severity"] == "error"]  # fmt: skip
    assert found == [("wrong.py", 4), ("wrong.py", 5), ("wrong.py", 6)]
    assert report["summary"]["filesAnalyzed"] == len(list(folder.glob("*.py")))


def test_the_extension_has_a_typed_stub() -> None:
    """Made at build time, beside the extension."""
    assert (PACKAGE / "py.typed").is_file()
    stub = (PACKAGE / "pydart2_api.pyi").read_text()
    for line in ("class WorldHandle:", "def step(self, ", "-> NDArray[np.float64]"):
        assert line in stub
