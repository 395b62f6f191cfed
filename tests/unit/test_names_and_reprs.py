"""Skeletons by name, and what things say of themselves, printed and in notebooks."""

from __future__ import annotations

import io

import numpy as np
import pytest
from PIL import Image

import pydart2

ATLAS = "sdf/atlas/atlas_v3_no_head.sdf"


@pytest.fixture
def world() -> pydart2.World:
    world = pydart2.World(0.001, up="z")
    world.add_ground()
    world.add_skeleton(ATLAS)
    world.add_box((0.2, 0.2, 0.2), mass=3.0, position=(1.0, 0.0, 0.1), name="box")
    return world


def test_skeletons_by_name(world: pydart2.World) -> None:
    box = world.skeletons[2]
    for found in (world.skeleton("box"), world["box"], world.skeleton(2), world[-1], world[np.int64(2)]):
        assert found is box
    assert list(world) == world.skeletons
    with pytest.raises(pydart2.NameNotFound, match=r"no skeleton 'bx' in .*; did you mean 'box'\?"):
        world["bx"]
    with pytest.raises(IndexError, match=r"no skeleton 3 in .*: there are 3"):
        world[3]
    with pytest.raises(TypeError, match=r"by name or index, not by 0\.5"):
        world.skeleton(0.5)  # type: ignore[arg-type]


def test_a_world_tells_what_is_in_it(world: pydart2.World) -> None:
    world.step()
    assert str(world) == (
        f"World {world.id}: t = 0.001 s, dt = 0.001 s, gravity [0, 0, -9.81], up [0, 0, 1]\n"
        f"3 skeletons, 30 bodies, 39 dofs, {world.collision_result.num_contacts()} contacts, 2 frames; "
        "detector 'fcl', solver 'fast'\n"
        "   0 ground        1 body, 0 dofs, 0 kg\n"
        "   1 drc_skeleton  28 bodies, 33 dofs, 146.554 kg\n"
        "   2 box           1 body, 6 dofs, 3 kg"
    )
    assert repr(world) == f"[World ID:{world.id} time:0.0010 # frames: 2]"  # the original's
    world.destroy()
    assert str(world) == repr(world)


def test_many_skeletons_are_not_all_listed() -> None:
    world = pydart2.World(0.001)
    for i in range(25):
        world.add_box((0.1, 0.1, 0.1), position=(i, 0, 0))
    assert str(world).endswith("  … and 5 more") and len(str(world).splitlines()) == 23


def test_a_notebook_shows_a_picture(world: pydart2.World) -> None:
    png = world._repr_png_()
    assert png is not None
    picture = np.asarray(Image.open(io.BytesIO(png)))
    assert picture.shape == (360, 480, 3) and picture.std() > 10.0


def test_a_notebook_shows_small_tables(world: pydart2.World) -> None:
    robot = world["drc_skeleton"]
    for text in (robot._repr_html_(), robot.q._repr_html_()):
        assert text is not None
        assert text.count("<tr>") == 22 and "root_rot_x" in text and "r_arm_wrx" in text and "…" in text
    box = world["box"]._repr_html_()
    assert box.count("<tr>") == 7 and "<b>box</b>: 1 body, 6 dofs, 3 kg" in box
    assert np.zeros(3).view(pydart2.SkelVector)._repr_html_() is None


def test_keys_are_completed(world: pydart2.World) -> None:
    assert world._ipython_key_completions_() == ["ground", "drc_skeleton", "box"]
    assert world["box"].q._ipython_key_completions_() == world["box"].q.keys


def test_a_vector_becomes_a_dict(world: pydart2.World) -> None:
    q = world["box"].q
    assert dict(q) == dict(zip(q.keys, q.tolist(), strict=True)) and len(dict(q)) == 6


def test_short_reprs(world: pydart2.World) -> None:
    batch = pydart2.Batch(world, 3)
    assert repr(batch.rollout(None, np.zeros((3, 5, 6)))) == "[Trajectories: 3 worlds, 5 actions, 6 dofs, 0 failed]"
    result = world["drc_skeleton"].inverse_kinematics({"l_hand": [0.4, 0.3, 1.0]})
    assert repr(result).startswith("[IKResult: ") and "\n" not in repr(result)
