"""A camera on a body sees what is before it, at its rate."""

from __future__ import annotations

import numpy as np
import pytest

from pydart2 import SimpleFrame, World
from pydart2.gui import CameraSensor


def test_depth_from_a_moving_body() -> None:
    world = World(0.001, up="z")
    world.set_gravity([0.0, 0.0, 0.0])
    world.add_box([1.0, 9.0, 9.0], 1.0, [3.5, 0.0, 0.0], fixed=True)
    robot = world.add_sphere(0.05, 1.0)
    ahead = SimpleFrame(robot.bodynodes[0], [[0, 0, -1], [-1, 0, 0], [0, 1, 0]], [0.06, 0.0, 0.0])  # looks along x
    eye = CameraSensor(ahead, 32, 24, mode="depth", rate=100.0)
    np.testing.assert_allclose(eye.read(), np.full((24, 32), 2.94), rtol=1e-4)
    robot.dq = [0, 0, 0, 100.0, 0, 0]
    world.step(5)
    np.testing.assert_allclose(eye.read(), np.full((24, 32), 2.94), rtol=1e-4)  # of before: 10 ms are not over
    world.step(5)
    np.testing.assert_allclose(eye.read(), np.full((24, 32), 1.94), rtol=1e-4)
    assert CameraSensor(ahead, 32, 24, mode="segmentation").read()[0, 0].tolist() == [0, 0]
    assert CameraSensor(ahead).read().shape == (48, 64, 3)


def test_what_is_no_camera() -> None:
    body = World(0.001).add_sphere(0.1).bodynodes[0]
    with pytest.raises(ValueError, match="between 0 and pi"):
        CameraSensor(body, fov=4.0)
    with pytest.raises(ValueError, match="sits on a body"):
        CameraSensor(SimpleFrame(None))
