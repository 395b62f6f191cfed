"""Writes docs/features.md: calls what each library is said to have, in whichever interpreter has it.

python tools/probe_features.py [PYTHON ...] >docs/features.md
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
from datetime import date
from typing import Any

from probed_features import FEATURES, LIBRARIES, PACKAGES, PLATFORMS, TEXTS, WORDS

# Runs the calls of one library, each in a fresh copy of what its first lines made; and searches names for words.
CHILD = """
import importlib.metadata, importlib.util, inspect, json, os, pathlib, re, sys, tempfile
asked = json.load(sys.stdin)
file = tempfile.NamedTemporaryFile("w", suffix=".urdf")
file.write(asked["texts"]["URDF"])
file.flush()

def has_types(module):
    folder = pathlib.Path(importlib.util.find_spec(module).origin).parent
    own = [*folder.glob("py.typed"), *folder.glob("*.pyi"), *folder.glob(module + "*-stubs/*.pyi")]
    if not own:
        raise LookupError("neither py.typed nor stubs beside it")

def names_in(thing, prefix, depth):
    for name in dir(thing):
        yield prefix + name
        value = getattr(thing, name, None)
        inner = inspect.ismodule(value) and value.__name__.startswith(asked["module"]) or inspect.isclass(value)
        if depth and inner and not name.startswith("__"):
            yield from names_in(value, prefix + name + ".", depth - 1)

space = {"importlib": importlib, "has_types": has_types, "PATH": file.name, **asked["texts"]}
answers, kept = {}, []
try:
    exec(asked["first"], space)
    version = str(eval(asked["version"], space))
except ImportError:
    print(); print(json.dumps(None)); sys.exit()
for feature, call in asked["calls"].items():
    try:
        kept.append(dict(space))  # to the end: some libraries do not survive that their parts go one by one
        exec(asked["first"] + chr(10) + call.removeprefix("#"), kept[-1])
        answers[feature] = "name" if call.startswith("#") else "yes"
    except Exception as error:
        answers[feature] = f"{type(error).__name__}: {error}".splitlines()[0]
public = sorted(set(names_in(importlib.import_module(asked["module"]), "", 2)))
found = {f: [n for n in public if re.search(words, n.split(".")[-1], re.I)][:3] for f, words in asked["words"].items()}
print(); print(json.dumps({"version": version, "answers": answers, "found": found}), flush=True)
os._exit(0)
"""


def probe(library: str, pythons: list[str]) -> dict[str, Any] | None:
    """What the first interpreter that has the library answers; None if none has it."""
    first, version, module = LIBRARIES[library]
    calls = {feature: call for feature, of in FEATURES.items() if (call := of.get(library)) is not None}
    words = {feature: WORDS[feature] for feature, of in FEATURES.items() if library not in of}
    asked = {"texts": TEXTS, "first": first, "version": version, "module": module, "calls": calls, "words": words}
    for python in pythons if first else []:
        done = subprocess.run(
            [python, "-c", CHILD],
            input=json.dumps(asked),
            capture_output=True,
            text=True,
            env={**os.environ, "MUJOCO_GL": "egl"},
        )
        if done.returncode != 0:
            raise RuntimeError(f"{library} in {python}: {done.stderr}")
        if found := json.loads(done.stdout.splitlines()[-1]):
            return dict(found)
    return None


def cell(feature: str, library: str, answer: dict[str, Any] | None) -> str:
    """What the table says of one."""
    if answer is None:
        return "not probed"
    if FEATURES[feature].get(library, "") is None:
        return "no"
    if feature in answer["answers"]:
        said = answer["answers"][feature]
        return said if said in ("yes", "name") else "failed"
    return "not probed" if answer["found"][feature] else "none found"


def wheel(library: str, platform: str) -> str:
    """What pip says to a package on a platform, for any Python that it may know; nothing is installed."""
    if library not in PACKAGES:
        return "not probed"
    if (package := PACKAGES[library]) is None:
        return "no"
    for python in ("3.13", "3.12", "3.11", "3.10"):
        with tempfile.TemporaryDirectory() as folder:
            where = ["--target", folder, "--platform", platform, "--python-version", python, "--only-binary", ":all:"]
            command = [sys.executable, "-m", "pip", "install", "--quiet", "--dry-run", "--no-deps", *where, package]
            if subprocess.run(command, capture_output=True).returncode == 0:
                return "yes"
    return "none found"


def page(found: dict[str, dict[str, Any] | None]) -> str:
    """The table, and under it what did not work and what was not tried."""
    names = [f"{library} {answer['version']}" if answer else library for library, answer in found.items()]
    rows = [f"| | {' | '.join(names)} |", "|---" * (len(names) + 1) + "|"]
    failed, untried = [], []
    for feature in FEATURES:
        cells = [cell(feature, library, answer) for library, answer in found.items()]
        for (library, answer), said in zip(found.items(), cells, strict=True):
            if answer and said == "failed":
                failed.append(f"- {library}, {feature}: `{answer['answers'][feature]}`")
            if answer and said == "not probed":
                untried.append(f"- {library}, {feature}: {', '.join(f'`{name}`' for name in answer['found'][feature])}")
        rows.append(f"| {feature} | {' | '.join(cells)} |")
    for title, platform in PLATFORMS.items():
        rows.append(f"| {title} | {' | '.join(wheel(library, platform) for library in found)} |")
    missing = [library for library, answer in found.items() if answer is None]
    return "\n".join([
        "# Features", "",
        "Who can do what, as found by asking the packages. Rows are what any of them offers, this one or not.", "",
        "- *yes*: a call ran on a small arm; *failed*: it raised. *name*: only its name was looked up.",
        "- *no*: not there, say its authors. *none found*: no public name of the package has a word for it.",
        "- *not probed*: some name has such a word, and no call was written; the names are below.", "",
        f"The calls are in `tools/probed_features.py`; `make features` wrote this page on {date.today()}.", "",
        *([f"Not installed there: {', '.join(missing)}.", ""] if missing else []),
        *rows,
        *(["", "What failed:", "", *failed] if failed else []),
        *(["", "What has a name like it, and was not tried:", "", *untried] if untried else []),
    ])  # fmt: skip


if __name__ == "__main__":
    pythons = [*sys.argv[1:], sys.executable]
    print(page({library: probe(library, pythons) for library in LIBRARIES}))
