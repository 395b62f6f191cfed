"""Fixtures of all tests."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from hypothesis import settings

import pydart2
from oracle.fixtures import cpp_oracle, oracle  # noqa: F401 (fixtures)
from oracle.models import dart_model

# The same examples in every run; `pytest --hypothesis-profile=search` looks for new ones.
settings.register_profile("repeatable", derandomize=True, deadline=None)
settings.register_profile("search", max_examples=2000, deadline=None)
settings.load_profile("repeatable")


@pytest.fixture(autouse=True)
def verbosity() -> Iterator[None]:
    """What a test says of ``pydart2.verbose()`` ends with it: after ``init(verbose=False)`` no warning is told."""
    before = pydart2.verbose()
    yield
    if pydart2.verbose() != before:
        pydart2.set_verbose(before)


@pytest.fixture
def cubes() -> pydart2.World:
    """A world with a ground and three cubes."""
    return pydart2.World(0.001, pydart2.data_path("skel/cubes.skel"))


@pytest.fixture
def atlas() -> pydart2.Skeleton:
    """Atlas alone in a world with gravity along z."""
    world = pydart2.World(0.001)
    world.set_gravity([0.0, 0.0, -9.81])
    return world.add_skeleton(pydart2.data_path("sdf/atlas/atlas_v3_no_head.sdf"))


@pytest.fixture
def fullbody() -> pydart2.World:
    """DART's humanoid on a ground."""
    return pydart2.World(0.001, dart_model("skel/fullbody1.skel"))
