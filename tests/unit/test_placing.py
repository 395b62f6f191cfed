"""Where a skeleton from a file stands, and what it is called."""

from __future__ import annotations

import pickle
from typing import Any

import numpy as np
import pytest

from pydart2 import LoadError, World

PR2 = "./data/urdf/PR2/pr2.urdf"
INERTIAL = "<inertial><mass value='2'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial>"
ARM = f"""<robot name='arm'><link name='world'/><link name='base'>{INERTIAL}</link>
<joint name='mount' type='fixed'><parent link='world'/><child link='base'/><origin xyz='0 0 1'/></joint></robot>"""
BOX = f"<robot name='box'><link name='base'><inertial><origin xyz='.1 0 0'/>{INERTIAL[10:]}</link></robot>"
LINK = "<link name='l'><pose>0 0 1 0 0 0</pose></link>"
SDF = f"<sdf version='1.5'><model name='m'><pose>1 2 3 0 0 1</pose>{LINK}</model></sdf>"
TURN = [np.cos(0.4), 0.0, 0.0, np.sin(0.4)]
MATRIX = [[np.cos(0.8), -np.sin(0.8), 0.0], [np.sin(0.8), np.cos(0.8), 0.0], [0.0, 0.0, 1.0]]


@pytest.mark.parametrize("base", ["auto", "fixed"])
@pytest.mark.parametrize("text", [BOX, ARM, SDF, PR2], ids=["floating", "welded", "SDF", "PR2"])
def test_the_pose_is_the_root_links(text: str, base: Any) -> None:
    """Both what floats and what is welded; a reset and a copy leave it there."""
    world = World(0.001)
    skel = world.add_skeleton(text, position=[1.0, 2.0, 3.0], orientation=TURN, base=base)
    for after in (lambda: None, world.reset, lambda: world.step() if base == "fixed" else None):
        after()
        np.testing.assert_allclose(skel.root_bodynode().T[:3, 3], [1.0, 2.0, 3.0], atol=1e-12)
        np.testing.assert_allclose(skel.root_bodynode().T[:3, :3], MATRIX, atol=1e-12)
    for copy in (world.clone(), pickle.loads(pickle.dumps(world))):
        np.testing.assert_array_equal(copy.skeletons[0].root_bodynode().T, skel.root_bodynode().T)


def test_what_is_not_given_is_the_files() -> None:
    world = World(0.001)
    as_written = world.add_skeleton(SDF).root_bodynode().T
    moved = world.add_skeleton(SDF, position=[7.0, 8.0, 9.0]).root_bodynode().T
    np.testing.assert_allclose(moved[:3, :3], as_written[:3, :3], atol=1e-12)
    np.testing.assert_allclose(moved[:3, 3], [7.0, 8.0, 9.0], atol=1e-12)
    turned = world.add_skeleton(SDF, orientation=MATRIX).root_bodynode().T
    np.testing.assert_allclose(turned[:3, :3], MATRIX, atol=1e-12)
    np.testing.assert_allclose(turned[:3, 3], as_written[:3, 3], atol=1e-12)


def test_a_fixed_base_has_no_dofs() -> None:
    world = World(0.001)
    assert world.add_skeleton(PR2, base="fixed").ndofs == world.add_skeleton(PR2).ndofs - 6


def test_bad_arguments_add_nothing() -> None:
    world = World(0.001)
    for options in ({"base": "loose"}, {"position": [1.0]}, {"orientation": [0.0] * 2}, {"name": " "}):
        with pytest.raises(ValueError, match=next(iter(options))):
            world.add_skeleton(BOX, **options)  # type: ignore[arg-type]
    assert world.skeletons == []


def test_names() -> None:
    """Several of one file, each with its own; characters that XML has for itself."""
    world = World(0.001)
    names = ["left", "right", 'a "b" <&>']
    skels = [world.add_skeleton(text, name=name) for text, name in zip((BOX, SDF, ARM), names, strict=True)]
    assert [skel.name for skel in skels] == names
    assert [skel.name for skel in world.clone().skeletons] == names
    assert [skel.name for skel in pickle.loads(pickle.dumps(world)).skeletons] == names
    mjcf = "<mujoco><worldbody><body><freejoint/><geom size='1'/></body></worldbody></mujoco>"
    with pytest.raises(ValueError, match="URDF, SDF and SKEL"):
        world.add_skeleton(mjcf, name="m")
    with pytest.raises(LoadError):
        world.add_skeleton("<robot name='r'/>", name="m")


def test_welding_keeps_the_robot_where_it_is() -> None:
    """At q = 0 bit for bit as the engine, elsewhere to rounding."""
    world = World(0.001)
    still, moved = world.add_skeleton(BOX), world.add_skeleton(BOX)
    moved.q = [0.3, -0.2, 0.5, 1.0, 2.0, 3.0]
    before = [skel.root_bodynode().T for skel in (still, moved)]
    joint = still.root_bodynode().parent_joint.transform_from_parent_body_node()
    for skel in (still, moved):
        skel.set_root_joint_to_weld()
    np.testing.assert_array_equal(still.root_bodynode().T, before[0])
    np.testing.assert_array_equal(still.root_bodynode().parent_joint.transform_from_parent_body_node(), joint)
    np.testing.assert_allclose(moved.root_bodynode().T, before[1], atol=1e-14)
    world.step(10)
    np.testing.assert_allclose(moved.root_bodynode().T, before[1], atol=1e-14)
    np.testing.assert_array_equal(world.clone().skeletons[1].root_bodynode().T, moved.root_bodynode().T)
