"""Forces on the points of soft bodies."""

from __future__ import annotations

from pathlib import Path

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


def test_gravity_forces_are_what_bias_forces_have_at_rest() -> None:
    """The engine adds up numbers for them that it never set; motors that hold the weight took them over."""
    world = World(0.001)
    skel = world.skeletons[world.add_soft_sphere(0.2, 1.0, [0, 1, 0], cells=2).id]
    skel.q = [0.3, 0.2, 0.5, 0.1, 1.0, 0.2]
    at_rest = skel.c
    assert np.linalg.norm(at_rest[3:]) == pytest.approx(9.81 * skel.m)
    skel.dq = np.arange(6.0)
    np.testing.assert_allclose(skel.gravity_forces(), at_rest, rtol=1e-12, atol=1e-12)
    assert abs(skel.c - at_rest).max() > 1.0


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


@pytest.mark.parametrize("solver", ["fast", "dart", "iterative"])
@pytest.mark.parametrize("detector", ["fcl", "bullet"])
def test_fixed_bodies_touch(detector: str, solver: str) -> None:
    """A fixed body with a skin on a fixed body; beside them what moves goes on."""
    world = World(0.001)
    world.set_collision_detector(detector)
    world.set_constraint_solver(solver)
    world.add_box([1.0, 1.0, 1.0], fixed=True)
    soft = world.add_soft_box([0.3, 0.3, 0.3], 1.0, [0.0, 0.6, 0.0], fixed=True)
    ball = world.add_sphere(0.1, 1.0, [0.0, 5.0, 0.0])
    world.step(100)
    assert len(world.contacts_between(soft, world.skeletons[0]).points) > 0
    assert ball.dq[4] == pytest.approx(-9.81 * 0.1)


SOFT_ON_BOX = """
<skel version="1.0"><world name="world">
  <physics><time_step>0.001</time_step><gravity>0 -9.81 0</gravity>
    <collision_detector>{}</collision_detector></physics>
  <skeleton name="floor"><body name="floor"><transformation>0 -0.35 0 0 0 0</transformation>
    <collision_shape><geometry><box><size>4 0.5 4</size></box></geometry></collision_shape></body>
    <joint type="weld" name="floor joint"><parent>world</parent><child>floor</child></joint></skeleton>
  <skeleton name="soft"><body name="soft"><inertia><mass>0.5</mass></inertia>
    <soft_shape><total_mass>0.5</total_mass><geometry><box><size>0.2 0.2 0.2</size><frags>3 3 3</frags></box></geometry>
    <kv>100</kv><ke>10</ke><damp>1</damp></soft_shape></body>
    <joint type="free" name="soft joint"><parent>world</parent><child>soft</child></joint></skeleton>
</world></skel>"""


def test_skins_rest_on_what_fcl_takes_for_a_box(tmp_path: Path) -> None:
    """As on a box of triangles, though FCL turns that pair round, and the engine its face and normal with it."""
    heights = {}
    for detector in ("fcl", "fcl_mesh"):
        path = tmp_path / f"{detector}.skel"
        path.write_text(SOFT_ON_BOX.format(detector))
        world = World(0.001, path)
        world.step(1000)
        heights[detector] = world.skeletons[1].C[1]
    assert heights["fcl"] == pytest.approx(heights["fcl_mesh"], abs=0.02)
