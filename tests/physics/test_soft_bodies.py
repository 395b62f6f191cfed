"""Forces on the points of soft bodies."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray

from pydart2 import World
from pydart2.softbody import SoftBodyNode

Array = NDArray[np.float64]


def floating() -> tuple[World, SoftBodyNode]:
    """A soft body, turned, where nothing pulls."""
    world = World(0.001, "skel/softBodies.skel")
    world.set_gravity([0.0, 0.0, 0.0])
    body = world.skeletons[2].bodynodes[0]
    assert isinstance(body, SoftBodyNode)
    body.skel.q = [0.3, 0.2, 0.5, 0.0, 3.0, 0.0]
    return world, body


def centre(body: SoftBodyNode) -> Array:
    """Of core and skin."""
    skin = body.point_masses()
    return np.asarray((body.m * body.C + skin @ body.point_world_positions()) / (body.m + skin.sum()))


def test_a_force_on_a_point_moves_the_whole() -> None:
    """The centre of all masses, by Newton's second law; inside, the point goes first."""
    world, body = floating()
    forces = np.zeros((body.num_points(), 3))
    forces[3] = [1.0, 2.0, 3.0]
    centres = [centre(body)]
    for _ in range(60):
        body.add_point_forces(forces)
        world.step()
        centres.append(centre(body))
        if len(centres) == 2:
            assert np.linalg.norm(body.point_displacements(), axis=1).argmax() == 3
    accelerations = np.diff(centres, 2, axis=0) / world.dt**2
    assert_allclose(accelerations, np.tile(forces[3] / (body.m + body.point_masses().sum()), (59, 1)), atol=1e-5)
    world.step()  # a force is for one step
    assert_allclose((centre(body) - centres[-1]) / world.dt, (centres[-1] - centres[-2]) / world.dt, atol=2e-6)


def test_forces_add_up_and_are_kept_with_the_state() -> None:
    world, body = floating()
    forces = np.random.default_rng(0).uniform(-1.0, 1.0, (body.num_points(), 3))
    body.add_point_forces(forces)
    body.add_point_forces(forces)
    before, clone = world.snapshot(), world.clone()
    world.step(3)
    clone.step(3)
    after = np.array(body.point_world_positions())
    assert (after == clone.skeletons[2].bodynodes[0].point_world_positions()).all()  # type: ignore[attr-defined]
    world.restore(before)
    world.step(3)
    assert (after == body.point_world_positions()).all()
    other_world, other = floating()
    other.add_point_forces(2.0 * forces)
    other_world.step(3)
    assert_allclose(after, other.point_world_positions(), atol=1e-13)
    with pytest.raises(ValueError, match="forces"):
        body.add_point_forces(forces[1:])
