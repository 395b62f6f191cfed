"""The README's code runs as printed."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]


def test_code_of_the_readme_runs(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)  # as anyone would, from any folder
    (code,) = re.findall(r"```python\n(.*?)```", (ROOT / "README.md").read_text(), re.DOTALL)
    exec(compile(code, "README.md", "exec"), {})
    fall, speed = re.findall(r"\[(.*?)\]", capsys.readouterr().out)
    # Half a second of free fall: the hand moves with the robot, at g t.
    assert float(speed.split()[2]) == pytest.approx(-9.81 * 0.5, rel=1e-9)
    assert float(fall.split()[2]) < -0.5
