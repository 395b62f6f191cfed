"""Whether the tests notice when the code is wrong: applies each small change of tests/mutations.txt, one at a time.

    python tools/mutate.py [part of a file's name ...]

Builds anew where the change is in C++, runs the tests beside it, puts the file back, and prints what survived. Files
that are changed already are left alone. Ends with 1 where fewer than nine in ten were noticed.
"""

from __future__ import annotations

import subprocess
import sys
import time
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).resolve().parents[1]
BUILD = next(iter((ROOT / "build").glob("cmake-*")), None)
WANTED = 0.9


class Mutation(NamedTuple):
    """A change that tests should notice.

    Attributes
    ----------
    file
        From the top of the repository.
    old, new
        Text that stands there once, and what takes its place.
    tests
        What is run, from tests/.
    """

    file: str
    old: str
    new: str
    tests: list[str]


def read(text: str) -> list[Mutation]:
    """What the file lists; its first paragraph is for readers."""
    found = []
    for paragraph in text.strip().split("\n\n")[1:]:
        head, *lines = paragraph.split("\n")
        file, _, tests = head.partition(": ")
        old, new = ("\n".join(line[1:] for line in lines if line[0] == sign) for sign in "-+")
        found.append(Mutation(file, old, new, tests.split()))
    return found


def outcome(mutation: Mutation) -> str:
    """ "killed", "survived" or why it could not be tried; the file is as before."""
    path = ROOT / mutation.file
    text = path.read_text(encoding="utf-8")
    if text.count(mutation.old) != 1:
        return f"stands there {text.count(mutation.old)} times"
    is_python = path.suffix == ".py"
    try:
        path.write_text(text.replace(mutation.old, mutation.new), encoding="utf-8")
        if not is_python and not build():
            return "does not compile"
        return "survived" if tests_pass(mutation.tests) else "killed"
    finally:
        path.write_text(text, encoding="utf-8")
        if not is_python:
            build()


def build() -> bool:
    """Whether the extension could be built."""
    return subprocess.run(["cmake", "--build", str(BUILD), "-j2"], cwd=ROOT, capture_output=True).returncode == 0


def tests_pass(tests: list[str]) -> bool:
    """Whether they all do; a process that ends or hangs does not."""
    command = [
        sys.executable,
        "-m",
        "pytest",
        "-x",
        "-q",
        "-p",
        "no:cacheprovider",
        *(f"tests/{test}" for test in tests),
    ]
    try:
        return subprocess.run(command, cwd=ROOT, capture_output=True, timeout=900).returncode == 0
    except subprocess.TimeoutExpired:
        return False


def main() -> int:
    """Try all, or those in files that are named."""
    listed = read((ROOT / "tests" / "mutations.txt").read_text(encoding="utf-8"))
    chosen = [one for one in listed if not sys.argv[1:] or any(part in one.file for part in sys.argv[1:])]
    found = dict.fromkeys(("killed", "survived"), 0)
    for mutation in chosen:
        start = time.monotonic()
        said = outcome(mutation)
        found[said] = found.get(said, 0) + 1
        place = mutation.old.strip().splitlines()[0]
        print(f"{said:9} {time.monotonic() - start:5.0f} s  {mutation.file}: {place}", flush=True)
    tried = found["killed"] + found["survived"]
    print(f"{found['killed']} of {tried} noticed, {len(chosen) - tried} not tried")
    return 0 if tried == len(chosen) and found["killed"] >= WANTED * tried else 1


if __name__ == "__main__":
    sys.exit(main())
