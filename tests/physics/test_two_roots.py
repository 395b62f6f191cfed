"""A skeleton of several roots: what the engine's own sums get wrong, and that its parts do not feel each other."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from pydart2 import Skeleton, World

from .models import G

MASSES = (1.0, 3.0)


@pytest.fixture
def boxes() -> Skeleton:
    """Two boxes of one skeleton: one lies on a ground, the other one hangs in the stop of its slider."""
    world = World(0.001, up="z")
    world.add_ground()
    skel = world.add_box((0.2, 0.2, 0.2), MASSES[0], (0.0, 0.0, 0.1))
    slider = skel.add_body("other", joint="prismatic", axis=(0, 0, 1), limits=(0, 1), position=(2.0, 0.0, 1.0))
    slider.add_box((0.2, 0.2, 0.2), mass=MASSES[1])
    world.step(200)
    return skel


def test_each_is_carried_by_what_holds_it(boxes: Skeleton) -> None:
    for _ in range(2):  # asking changes nothing
        assert_allclose(boxes.constraint_forces()[[3, 4, 5, 6]], [0, 0, MASSES[0] * G, MASSES[1] * G], atol=1e-3 * G)


def test_motors_know_what_carries(boxes: Skeleton) -> None:
    """So they have nothing to do where the boxes lie."""
    start = boxes.q.copy()
    boxes.set_targets(start, kp=1e4, kd=1e2)
    boxes.world.step(100)
    assert_allclose(boxes.q, start, atol=1e-6)
    assert np.abs(boxes.motor_forces()).max() < 1e-2 * G
