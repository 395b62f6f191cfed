"""What an earlier version saved loads, says the same and goes on to the same states (tests/make_samples.py)."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import pydart2
from make_samples import FOLDER, TOLD, make_world, processor, read, samples, tell

NAMES = sorted(path.name.partition(".")[0] for path in FOLDER.glob("*.pickle.xz"))


@pytest.fixture(scope="module")
def told() -> dict[str, Any]:
    return dict(np.load(TOLD))


def compare(name: str, sample: Any, told: dict[str, Any]) -> None:
    """Bit for bit where engine and processor are of the kind that wrote the numbers; nearly on other processors."""
    expected = [told[f"{name}.{i}"] for i in range(sum(key.rpartition(".")[0] == name for key in told))]
    got = tell(sample)
    assert len(got) == len(expected) > 0
    written, here = str(told["processor"]), processor()
    same_engine = written.partition(",")[0] == here.partition(",")[0]
    if written != here:
        print(f"{name}: written by {written}, read by {here}: compared {'to 1e-9' if same_engine else 'in shape only'}")
    for mine, theirs in zip(got, expected, strict=True):
        assert mine.shape == theirs.shape
        if written == here:
            assert mine.tobytes() == theirs.tobytes()
        elif same_engine:
            np.testing.assert_allclose(mine, theirs, rtol=1e-9, atol=1e-9)


@pytest.mark.parametrize("name", NAMES)
def test_a_pickle_goes_on(name: str, told: dict[str, Any]) -> None:
    compare(name, read(name), told)


def test_a_recording_is_read(told: dict[str, Any]) -> None:
    compare("recording.npz", pydart2.Run.load(FOLDER / "recording.npz"), told)


def test_a_snapshot_goes_on(told: dict[str, Any]) -> None:
    """In a world that is made anew: the model is still the same, by its digest."""
    world = make_world()
    world.restore(pydart2.Snapshot.load(FOLDER / "snapshot.npz"))
    compare("snapshot.npz", world, told)


def test_each_class_has_a_sample() -> None:
    """A class that is new: `python tests/make_samples.py` adds it."""
    assert sorted(name for name, _ in samples()) == NAMES
