"""Fixtures of the conformance tests."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import pydart2
from oracle.dartpy_oracle import DartpyOracle, Simulation
from oracle.models import dart_model

from .models import load_screw, load_zoo


@pytest.fixture
def zoo(tmp_path: Path) -> pydart2.Skeleton:
    """A skeleton with a joint of each type and a shape of each kind, every body with a marker; posed and moving."""
    skel = load_zoo(tmp_path)
    skel.q, skel.dq = 0.3 * np.cos(np.arange(skel.ndofs)), 0.5 * np.sin(np.arange(skel.ndofs))
    return skel


@pytest.fixture
def screw(tmp_path: Path) -> pydart2.Skeleton:
    """A nut on a screw along z."""
    return load_screw(tmp_path)


@pytest.fixture
def touching(cubes: pydart2.World) -> pydart2.World:
    """The cubes after some steps, some of them in contact."""
    cubes.step(20)
    return cubes


@pytest.fixture
def robot(fullbody: pydart2.World) -> pydart2.Skeleton:
    """DART's humanoid, posed and moving."""
    skel = fullbody.skeletons[1]
    skel.q, skel.dq = _state(skel.ndofs)
    return skel


@pytest.fixture(scope="session")
def told(oracle: DartpyOracle) -> Simulation:
    """What the oracle says of `robot` in frame 0 and, after a step, in frame 1."""
    return oracle.simulate(
        dart_model("skel/fullbody1.skel"), dt=0.001, skeleton_states=[None, _state(37)], steps=1, report_at=[0, 1]
    )


def _state(n: int) -> tuple[np.ndarray, np.ndarray]:
    return 0.2 * np.cos(np.arange(n)), 0.3 * np.sin(np.arange(n))
