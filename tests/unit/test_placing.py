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


@pytest.mark.parametrize("text", [ARM, SDF, PR2], ids=["welded", "SDF", "PR2"])
def test_a_free_base_floats_from_where_the_file_has_it(text: str) -> None:
    """It is there again after a reset, and in copies; the dynamics are those of a file that has it so."""
    world = World(0.001)
    as_written = world.add_skeleton(text).root_bodynode().T
    fixed = world.add_skeleton(text, base="fixed")
    free = world.add_skeleton(text, base="free")
    assert free.ndofs == fixed.ndofs + 6
    np.testing.assert_allclose(free.root_bodynode().T, as_written, atol=1e-12)
    fixed.set_root_joint_to_free()
    np.testing.assert_allclose(fixed.M, free.M, rtol=1e-12, atol=1e-12)
    for other in world.skeletons[:2]:
        world.remove_skeleton(other)
    world.step(10)
    assert np.abs(free.root_bodynode().T - as_written).max() > 1e-5
    for copy in (world.clone(), pickle.loads(pickle.dumps(world))):
        np.testing.assert_array_equal(copy.skeletons[0].root_bodynode().T, free.root_bodynode().T)
        copy.reset()
        np.testing.assert_allclose(copy.skeletons[0].root_bodynode().T, as_written, atol=1e-12)


def test_only_a_fixed_root_is_made_free() -> None:
    world = World(0.001)
    skel = world.add_skeleton(PR2)
    skel.set_root_joint_to_trans_and_euler()
    with pytest.raises(ValueError, match="'root_t'; only a root that is fixed"):
        skel.set_root_joint_to_free()


def test_names_can_be_set() -> None:
    """To what no other has; even exchanged ones survive in copies."""
    world = World(0.001)
    first, second = world.add_skeleton(BOX), world.add_skeleton(BOX)
    with pytest.raises(ValueError, match="a skeleton 'box' already"):
        second.name = "box"
    with pytest.raises(ValueError, match="needs a name"):
        second.name = " "
    first.name = "else"
    second.name = "box"
    first.name = "box (1)"
    first.name = "box (1)"
    for one in (world, world.clone(), pickle.loads(pickle.dumps(world))):
        assert [skel.name for skel in one.skeletons] == ["box (1)", "box"]
        assert one.skeleton("box").id == 1
    with pytest.raises(KeyError, match="in skeleton 'box'"):
        second.dof("none")


def sdf_model(name: str, x: float) -> str:
    return f"<model name='{name}'><pose>{x} 0 0 0 0 0</pose>{LINK}</model>"


SDF_WORLD = f"""<sdf version='1.5'><world name='w'><!-- two -->
{sdf_model("a", 1)}<physics type='ode'><gravity>0 0 -1</gravity></physics>
{sdf_model("b", 2)}</world></sdf>"""


def test_skeletons_of_a_world_come_to_another() -> None:
    """Each as the engine has it in the world itself; moved all at once; without its gravity."""
    whole = World(0.001, SDF_WORLD)
    world = World(0.001)
    made = world.add_skeletons(SDF_WORLD)
    assert world.skeletons == made and world.gravity()[1] == -9.81
    for ours, theirs in zip(made, whole.skeletons, strict=True):
        assert ours.name == theirs.name
        np.testing.assert_array_equal(ours.root_bodynode().T, theirs.root_bodynode().T)
    (b,) = world.add_skeletons(SDF_WORLD, only="b", position=[0.0, 0.0, 5.0], orientation=MATRIX)
    assert b.name == "b (1)"
    place = np.eye(4)
    place[:3, :3], place[2, 3] = MATRIX, 5.0
    np.testing.assert_allclose(b.root_bodynode().T, place @ made[1].root_bodynode().T, atol=1e-12)
    world.reset()
    np.testing.assert_allclose(b.root_bodynode().T, place @ made[1].root_bodynode().T, atol=1e-12)
    assert [skel.name for skel in pickle.loads(pickle.dumps(world)).skeletons] == ["a", "b", "b (1)"]


def test_skeletons_of_a_skel_file_come_to_another_world() -> None:
    """The second body of a file, which add_skeleton() could not give; joints that are no free ones move as well."""
    path = "./data/skel/cubes.skel"
    whole, world = World(0.001, path), World(0.001)
    names = [skel.name for skel in whole.skeletons]
    (last,) = world.add_skeletons(path, only=[names[-1]])
    np.testing.assert_array_equal(last.root_bodynode().T, whole.skeletons[-1].root_bodynode().T)
    np.testing.assert_array_equal(last.M, whole.skeletons[-1].M)
    moved = world.add_skeletons("./data/skel/chain.skel", position=[0.0, 1.0, 0.0])
    still = world.add_skeletons("./data/skel/chain.skel")
    for ours, theirs in zip(moved, still, strict=True):
        up = [body.C - np.array([0.0, 1.0, 0.0]) for body in ours.bodynodes]
        np.testing.assert_allclose(up, [body.C for body in theirs.bodynodes], atol=1e-12)


def test_what_holds_several_says_so(caplog: Any) -> None:
    world = World(0.001)
    with pytest.raises(LoadError, match=r"world\.add_skeletons\(file\) adds what is in it: 'a', 'b'"):
        world.add_skeleton(SDF_WORLD)
    text = f"<sdf version='1.5'>{sdf_model('a', 1)}\n{sdf_model('b', 2)}</sdf>"
    assert world.add_skeleton(text).name == "a"
    assert "line 2: of 'a', 'b' the first is taken" in caplog.text
    with pytest.raises(KeyError, match="no skeleton 'c' in the XML text with 'a', 'b'"):
        world.add_skeletons(text, only=["a", "c"])
    with pytest.raises(LoadError, match="use add_skeleton"):
        world.add_skeletons(BOX)
    broken = SDF_WORLD.replace("0 0 1 0 0 0</pose></link></model></world>", "0 0 1</pose></link></model></world>")
    with pytest.raises(LoadError, match="line 3"):
        world.add_skeletons(broken)
    assert len(world.skeletons) == 1
