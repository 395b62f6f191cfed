"""A short run of each fuzzer, and the files that once ended the process. `make fuzz` runs a million calls."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from crash import fuzz_api, fuzz_models, fuzz_threads, fuzz_worlds


def test_damaged_models() -> None:
    outcomes, troubles = fuzz_models.run(1_000_000, 120)
    assert troubles == [] and sum(outcomes.values()) == 120
    assert outcomes["loaded"] > 20 and outcomes["refused"] > 20


@pytest.mark.skipif("ASAN_OPTIONS" in os.environ, reason="AddressSanitizer takes the calls that count branches")
def test_loaders_under_libfuzzer(tmp_path: Path) -> None:
    pytest.importorskip("atheris", reason="PyPI has atheris for x86_64 alone")
    command = [sys.executable, Path(fuzz_models.__file__).with_name("fuzz_loaders.py"), "500", tmp_path]
    done = subprocess.run(command, capture_output=True, text=True, env=fuzz_models.ENVIRONMENT)
    assert done.returncode == 0, done.stderr[-3000:]
    assert "number_of_executed_units: 500" in done.stderr
    first, *_, last = (int(count) for count in re.findall(r"cov: (\d+)", done.stderr))
    assert last > first > 300, "damaged models reach branches that no model as it is reaches"
    assert list(tmp_path.iterdir())


@pytest.mark.parametrize("seed", sorted(fuzz_models.SEEDS.glob("*")), ids=lambda path: path.name)
def test_seeds_that_once_crashed(seed: Path) -> None:
    assert fuzz_models.load(fuzz_models.Damaged.seed(seed))[1] in ("loaded", "refused", "cannot be simulated")


def test_hostile_calls() -> None:
    report = fuzz_api.run(4000, first=0)
    assert report.troubles == [] and report.calls >= 4000
    assert report.accepted > 200 and report.refused > 200


def test_worlds_as_scripts_use_them() -> None:
    """With removals, switches and copies between steps; the copies go on bit for bit."""
    counts, troubles = fuzz_worlds.run(3000, first=0)
    assert troubles == [] and counts.total() >= 3000
    accepted = [name for name in fuzz_worlds.DEEDS if counts[name] > 0]
    assert set(accepted) == set(fuzz_worlds.DEEDS) and counts["refused"] < 0.4 * counts.total()


def test_threads() -> None:
    calls, troubles = fuzz_threads.run(10, first=0)
    assert troubles == []
    assert len(calls) > 15, "most of the twenty kinds of calls work now and then, also on a slow machine"
