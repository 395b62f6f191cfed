"""A short play of random_events.py on each model; `make test-viewer` is the long one."""

from __future__ import annotations

import sys

import pytest

from gui.random_events import MODELS
from gui.test_environments import ROOT, run


@pytest.mark.parametrize("model", MODELS)
def test_random_events_do_no_harm(model: str) -> None:
    result = run(sys.executable, str(ROOT / "tests/gui/random_events.py"), "4", model, QT_QPA_PLATFORM="offscreen")
    assert result.returncode == 0, f"code {result.returncode}\n{result.stdout[-1000:]}\n{result.stderr[-6000:]}"
    assert f"{model}: 49 kinds, 196 events" in result.stdout
