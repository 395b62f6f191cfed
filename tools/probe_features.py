"""Writes docs/features.md: calls what each library is said to have, in whichever interpreter has it.

python tools/probe_features.py [PYTHON ...] >docs/features.md
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from datetime import date
from typing import Any

from probed_features import FEATURES, LIBRARIES, URDF

# Runs the calls of one library, each in a fresh copy of what its first lines made.
CHILD = """
import json, sys, tempfile, importlib.metadata
asked = json.load(sys.stdin)
file = tempfile.NamedTemporaryFile("w", suffix=".urdf")
file.write(asked["urdf"])
file.flush()
space = {"importlib": importlib, "URDF": asked["urdf"], "PATH": file.name}
answers = {}
try:
    exec(asked["first"], space)
    version = str(eval(asked["version"], space))
except ImportError:
    print(); print(json.dumps(None)); sys.exit()
for feature, call in asked["calls"].items():
    own = dict(space)
    try:
        exec(asked["first"] + chr(10) + call, own)
        answers[feature] = "yes"
    except Exception as error:
        answers[feature] = f"{type(error).__name__}: {error}".splitlines()[0]
print(); print(json.dumps({"version": version, "answers": answers}))
"""


def probe(library: str, pythons: list[str]) -> dict[str, Any] | None:
    """What the first interpreter that has the library answers; None if none has it."""
    first, version = LIBRARIES[library]
    calls = {feature: calls[library] for feature, calls in FEATURES.items() if library in calls}
    asked = json.dumps({"urdf": URDF, "first": first, "version": version, "calls": calls})
    for python in pythons if first else []:
        done = subprocess.run(
            [python, "-c", CHILD], input=asked, capture_output=True, text=True, env={**os.environ, "MUJOCO_GL": "egl"}
        )
        if done.returncode != 0:
            raise RuntimeError(f"{library} in {python}: {done.stderr}")
        if found := json.loads(done.stdout.splitlines()[-1]):
            return dict(found)
    return None


def page(found: dict[str, dict[str, Any] | None]) -> str:
    """The table, and under it what did not work."""
    names = [f"{library} {answer['version']}" if answer else library for library, answer in found.items()]
    rows = [f"| | {' | '.join(names)} |", "|---" * (len(names) + 1) + "|"]
    failed = []
    for feature in FEATURES:
        cells = []
        for library, answer in found.items():
            said = answer["answers"].get(feature) if answer else None
            cells.append("not probed" if said is None else "yes" if said == "yes" else "failed")
            if cells[-1] == "failed":
                failed.append(f"- {library}, {feature}: `{said}`")
        rows.append(f"| {feature} | {' | '.join(cells)} |")
    missing = [library for library, answer in found.items() if answer is None]
    return "\n".join([
        "# Features", "",
        "Who can do what, found by calling it or asking for its name: *yes* ran on a small arm, *failed* raised, and",
        "*not probed* says nothing about the library: it was not installed, or no call was written.",
        f"The calls are in `tools/probed_features.py`; `make features` wrote this page on {date.today()}.", "",
        *([f"Not installed there: {', '.join(missing)}.", ""] if missing else []),
        *rows, *(["", "What failed:", "", *failed] if failed else []),
    ])  # fmt: skip


if __name__ == "__main__":
    pythons = [sys.executable, *sys.argv[1:]]
    print(page({library: probe(library, pythons) for library in LIBRARIES}))
