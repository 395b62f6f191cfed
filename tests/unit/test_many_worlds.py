"""The programs of docs/howto/many-worlds.md, run as they stand."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import pydart2

PAGE = Path(__file__).resolve().parents[2] / "docs" / "howto" / "many-worlds.md"
PROGRAMS = re.findall(r"```python\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL)


def run(program: str, folder: Path) -> str:
    """What a program prints."""
    path = folder / "program.py"
    path.write_text(program, encoding="utf-8")
    env = {**os.environ, "PYTHONPATH": str(Path(pydart2.__file__).parents[1])}
    done = subprocess.run([sys.executable, path], cwd=folder, env=env, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr[-3000:]
    return done.stdout


def test_the_batch_prints_what_the_page_says(tmp_path: Path) -> None:
    printed = run(PROGRAMS[0], tmp_path).strip().splitlines()[-1]
    assert f"prints `{printed}`" in PAGE.read_text(encoding="utf-8")


@pytest.mark.parametrize("program", PROGRAMS[1:], ids=["joblib", "dask"])
def test_a_sweep_in_other_processes_gives_the_numbers_of_this_one(program: str, tmp_path: Path) -> None:
    found = np.array(json.loads(run(program, tmp_path).splitlines()[-1]))
    assert found.shape == (1000,)
    for i in (0, 499, 999):
        world = pydart2.World(0.001, "skel/chain.skel")
        world.skeletons[-1].q = np.full(world.skeletons[-1].ndofs, 0.3)
        world.skeletons[-1].body(0).set_mass(np.linspace(0.5, 5.0, 1000)[i])
        world.step(300)
        assert world.skeletons[-1].q[0] == found[i]
    assert len(np.unique(found)) == 1000
