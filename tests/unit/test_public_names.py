"""No public name or signature changes without a word: they are as tests/public_names.txt has them."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def test_public_names() -> None:
    """In a process of its own: every module is imported. `python tools/public_names.py` writes the file anew."""
    command = [sys.executable, "-c", "import public_names; print('\\n'.join(public_names.lines()))"]
    done = subprocess.run(command, cwd=ROOT / "tools", capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr
    assert done.stdout.splitlines() == (ROOT / "tests/public_names.txt").read_text(encoding="utf-8").splitlines()
