"""Skeletons and worlds as texts of model files, which load as what they were."""

from __future__ import annotations

import logging
import math
import xml.etree.ElementTree as ElementTree
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import pydart2 as pydart

JOINTS = (
    *("revolute", "prismatic", "screw", "ball", "euler", "universal"),
    *("planar", "translational", "translational2d", "weld", "free"),
)
#: Kinds of joints that a format has, those that become chains in it, and those that it cannot hold.
HELD = {
    "SKEL": {"weld", "prismatic", "revolute", "universal", "ball", "euler", "translational", "planar", "free"},
    "URDF": {"weld", "prismatic", "revolute", "free", "planar"},
    "SDF": {"weld", "prismatic", "revolute", "universal", "ball", "screw"},
}
CHAINS = {
    "SKEL": {"translational2d"},
    "URDF": {"universal", "euler", "translational", "translational2d"},
    "SDF": {"euler", "translational", "translational2d", "planar"},
}
TURN = (0.9, 0.3, -0.2, 0.1)
QUARTER = (math.sqrt(0.5), 0.0, math.sqrt(0.5), 0.0)  # about y, where Euler angles have no answer

FORMATS = pytest.mark.parametrize("title", list(HELD))


def text_of(skel: pydart.Skeleton, title: str) -> str:
    text: str = getattr(skel, f"to_{title.lower()}")()
    return text


def again(skel: pydart.Skeleton, title: str) -> pydart.Skeleton:
    """What its text loads as."""
    world = pydart.World(0.001)
    world.g = skel.world.g
    return world.add_skeleton(text_of(skel, title))


def robot(joint: str, **options: Any) -> pydart.Skeleton:
    """A joint of a kind between two bodies, apart from their frames, and two more bodies below."""
    skel = pydart.World(0.001).add_empty_skeleton("robot")
    base = skel.add_body("base", joint="weld", position=(0.1, 0.2, 0.3), orientation=TURN)
    base.add_box((0.1, 0.2, 0.3), mass=1.0, color=(0.25, 0.5, 0.75, 0.5))
    where: dict[str, Any] = {"position": (0.3, 0.1, -0.2), "orientation": QUARTER}
    where |= {"joint_position": (0.05, -0.1, 0.02), "joint_orientation": TURN}
    link = skel.add_body("link", base, joint, **where, **options)
    link.add_cylinder(0.05, 0.4, position=(0.1, 0.0, 0.05), orientation=TURN)
    link.add_sphere(0.1, position=(0.0, 0.2, 0.0), mass=0.5, collides=False, color=(1, 0, 0))
    tip = skel.add_body("tip", link, "revolute", position=(0.0, 0.0, 0.4), axis=(0.6, 0.0, 0.8))
    tip.add_box((0.1, 0.1, 0.2), mass=0.7, visible=False, position=(0.0, 0.1, 0.0))
    skel.add_body("frame", tip, "weld", position=(0.1, 0.0, 0.0), orientation=TURN)
    return skel


def states(skel: pydart.Skeleton) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    random = np.random.default_rng(5)
    for _ in range(5):
        yield random.uniform(-1, 1, skel.ndofs), random.uniform(-1, 1, skel.ndofs)


def assert_near(found: np.ndarray, expected: np.ndarray) -> None:
    """To 1e-12 of the largest entry, or of 1."""
    assert np.abs(found - expected).max(initial=0.0) <= 1e-12 * max(1.0, np.abs(expected).max(initial=0.0))


def order_of(other: pydart.Skeleton, skel: pydart.Skeleton) -> list[int]:
    """Which dofs of `skel` those of `other` are, by their names; those of free and planar joints by their bodies."""
    order = []
    for dof in other.dofs:
        if dof.joint.type() in ("FreeJoint", "PlanarJoint"):
            twin = skel.body(dof.joint.child_bodynode.name).parent_joint
            order.append(twin.dofs[dof.index_in_joint()].id)
        else:
            order.append(skel.names.index(dof.name))
    assert sorted(order) == list(range(skel.ndofs))
    return order


def root_from_origin(other: pydart.Skeleton, skel: pydart.Skeleton, q: np.ndarray) -> np.ndarray:
    """Positions with those of the free root, counted from the origin, where the other's root is."""
    root = other.joints[0]
    if root.type() == "FreeJoint":
        T = skel.body(other.bodynodes[0].name).T
        q[[dof.id for dof in root.dofs]] = [*Rotation.from_matrix(T[:3, :3]).as_rotvec(), *T[:3, 3]]
    return q


def assert_moves_as(
    other: pydart.Skeleton, skel: pydart.Skeleton, poses: bool = True, from_origin: bool = False, fixed: bool = True
) -> None:
    """M, c and the poses of all bodies, at five random states; dofs and bodies by their names.

    `from_origin`: a free root's positions count from there; not `fixed`: without bodies that are fixed to the world.
    """
    order = order_of(other, skel)
    bodies = {body.name for body in skel.bodynodes if fixed or body.num_dependent_dofs() > 0}
    assert {body.name for body in other.bodynodes} >= bodies
    for q, dq in states(skel):
        skel.q, skel.dq = q, dq
        other.q, other.dq = root_from_origin(other, skel, q[order]) if from_origin else q[order], dq[order]
        assert_near(other.M, skel.M[np.ix_(order, order)])
        assert_near(other.c, skel.c[order])
        for name in bodies if poses else ():
            assert pytest.approx(skel.body(name).T, abs=1e-12) == other.body(name).T, name


def drawn_and_colliding(body: pydart.BodyNode) -> list[list[Any]]:
    """The shapes of a body for each of their purposes: kind, sizes, pose, colour."""
    from pydart2.exporting.parts import skeleton_part

    part = next(link for link in skeleton_part(body.skel).links if link.name == body.name)
    found: list[list[Any]] = []
    for shape in part.shapes:
        sizes = [np.ravel(size) if not isinstance(size, str) else size for size in shape.sizes.values()]
        if shape.rgba is not None:
            found.append(["drawn", shape.kind, *sizes, shape.pose.ravel(), shape.rgba])
        if shape.collides:
            found.append(["collides", shape.kind, *sizes, shape.pose.ravel()])
    return sorted(found, key=lambda shape: (shape[0], shape[1], *map(str, shape[2:4])))


def assert_is(other: pydart.Skeleton, skel: pydart.Skeleton, title: str, shapes: bool = True) -> None:
    """Masses, numbers of the dofs and shapes, by the names of bodies and dofs."""
    for body in skel.bodynodes:
        twin = other.body(body.name)
        assert (twin.m, twin.parent_joint.type()) == (body.m, body.parent_joint.type())
        assert pytest.approx(body.I, abs=1e-14) == twin.I
        assert twin.local_com() == pytest.approx(body.local_com(), abs=1e-14)
        for a, b in zip(drawn_and_colliding(twin), drawn_and_colliding(body), strict=True) if shapes else ():
            for x, y in zip(a, b, strict=True):  # URDF's colours are in single precision
                assert x == (y if isinstance(y, str) else pytest.approx(y, rel=1e-7, abs=1e-12))
    for dof, index in zip(other.dofs, order_of(other, skel), strict=True):
        for number in NUMBERS[title]:
            assert getattr(dof, number)() == getattr(skel.dofs[index], number)(), (dof, number)


_LIMITS = ("position_lower_limit", "position_upper_limit", "velocity_lower_limit", "velocity_upper_limit")
_RESISTANCE = ("force_lower_limit", "force_upper_limit", "damping_coefficient", "coulomb_friction")
_SPRING = ("spring_stiffness", "rest_position", "initial_position", "initial_velocity")
NUMBERS = {
    "URDF": (*_LIMITS, *_RESISTANCE),
    "SKEL": (*_LIMITS, *_RESISTANCE, *_SPRING),
    "SDF": (*_LIMITS[:2], *_RESISTANCE[2:], *_SPRING[:2]),
}


@FORMATS
@pytest.mark.parametrize("joint", JOINTS)
def test_a_joint_of_each_kind_comes_back(joint: str, title: str) -> None:
    skel = robot(joint)
    if joint not in HELD[title] | CHAINS[title]:
        with pytest.raises(pydart.ExportError, match=rf"not in {title}: joint 'link_joint' of 'robot' is .*{joint}"):
            text_of(skel, title)
        return
    other = again(skel, title)
    moved = title == "URDF" and joint in ("revolute", "ball", "euler", "universal", "planar", "free")
    assert_moves_as(other, skel, poses=not moved)
    if joint in HELD[title] and not moved:
        assert_is(other, skel, title)
        assert [body.name for body in other.bodynodes] == [body.name for body in skel.bodynodes]


@pytest.mark.parametrize("joint", ["revolute", "euler", "universal", "planar", "free"])
def test_urdf_has_frames_at_joints(joint: str) -> None:
    """A link that the joint is apart from gets another frame: the old one is at the same place in it all the time."""
    skel = robot(joint)
    other = again(skel, "URDF")
    order = order_of(other, skel)
    fixed = []
    for q, _ in states(skel):
        skel.q, other.q = q, q[order]
        fixed.append(np.linalg.inv(skel.body("link").T) @ other.body("link").T)
        for name in ("base", "tip", "frame"):
            assert pytest.approx(skel.body(name).T, abs=1e-12) == other.body(name).T
        assert pytest.approx(skel.body("link").C, abs=1e-12) == other.body("link").C
        for a, b in zip(other.body("link").shapenodes, [0, 1, 0], strict=True):
            theirs = skel.body("link").shapenodes[b].world_transform()
            assert a.world_transform() == pytest.approx(theirs, abs=1e-12)
    assert np.ptp(fixed, axis=0).max() < 1e-12


MODELS = [
    *("skel/cubes.skel", "skel/chain.skel", "skel/fullbody1.skel", "skel/shapes.skel", "skel/ground.skel"),
    *("sdf/atlas/atlas_v3_no_head.sdf", "urdf/PR2/pr2.urdf"),
]
#: What of them a format cannot hold: skeleton → the end of the sentence.
REFUSED: dict[str, dict[str, str]] = {
    "SKEL": {},
    "URDF": {
        "skeleton 1": "joint 'joint 1' of 'skeleton 1' is of the kind 'ball'",
        **{f"{kind} skeleton": f"of the kind '{kind}'" for kind in ("ellipsoid", "cone")},
        "multi sphere skeleton": "of the kind 'multi_sphere'",
    },
    "SDF": {
        **{f"{kind} skeleton": f"of the kind '{kind}'" for kind in ("ellipsoid", "capsule", "cone")},
        "multi sphere skeleton": "of the kind 'multi_sphere'",
    },
}


@FORMATS
@pytest.mark.parametrize("file", MODELS)
def test_models_come_back(file: str, title: str) -> None:
    for skel in pydart.World(0.001, f"./data/{file}").skeletons:
        if skel.name in REFUSED[title]:
            with pytest.raises(pydart.ExportError, match=f"not in {title}: .*{REFUSED[title][skel.name]}"):
                text_of(skel, title)
            continue
        other = again(skel, title)
        assert_moves_as(other, skel, from_origin=title == "URDF")
        if other.nbodies == skel.nbodies:
            capsule_of_urdf = (skel.name, title) == ("capsule skeleton", "URDF")
            assert_is(other, skel, title, shapes=not capsule_of_urdf)


def numbered() -> pydart.Skeleton:
    """A robot all of whose numbers are other than those that a file need not say."""
    skel = pydart.World(0.001).add_empty_skeleton("numbered")
    links = [skel.add_body("base", joint="weld")]
    for i, joint in enumerate(("revolute", "prismatic", "revolute", "revolute")):
        body = skel.add_body(f"link{i}", links[-1], joint, axis=(0.0, 0.6, 0.8), position=(0.0, 0.0, 0.25))
        body.add_box((0.1, 0.1, 0.2), mass=1.0 / 3.0 + i)
        links.append(body)
    ranges = [(-1.5, 0.7), (-math.inf, 0.3), (-0.2, math.inf), (0.5, 1.0)]
    for i, (dof, (low, high)) in enumerate(zip(skel.dofs, ranges, strict=True)):
        dof.set_position_lower_limit(low)
        dof.set_position_upper_limit(high)
        dof.set_damping_coefficient(0.1 + i / 7.0)
        dof.set_coulomb_friction(0.3 / (i + 1))
        dof.set_velocity_lower_limit(-2.0 / (i + 3))
        dof.set_velocity_upper_limit(2.0 / (i + 3))
    skel.dofs[1].set_force_lower_limit(-math.pi)
    skel.dofs[1].set_force_upper_limit(math.pi)
    return skel


@FORMATS
def test_numbers_come_back_to_the_last_bit(title: str) -> None:
    skel = numbered()
    if "spring_stiffness" in NUMBERS[title]:
        for i, dof in enumerate(skel.dofs):
            dof.set_spring_stiffness(10.0 / 3.0 + i)
            dof.set_rest_position(0.1 * i if i < 3 else 0.75)  # SDF has none but the start outside of 0
            dof.set_initial_position(0.7 / (i + 1))
            dof.set_initial_velocity(-0.1 / (i + 3))
    assert_is(again(skel, title), skel, title)


@FORMATS
def test_names_with_signs_come_back(title: str) -> None:
    skel = pydart.World(0.001).add_empty_skeleton("<a> & 'b' \"ü\"")
    body = skel.add_body("x & <y>", joint="revolute", joint_name="'j' > \"k\"")
    body.add_box((1, 1, 1), name="s & t")
    skel.add_body("child", body, "weld").add_sphere(0.1)
    other = again(skel, title)
    assert other.name == skel.name
    assert [b.name for b in other.bodynodes] == [b.name for b in skel.bodynodes]
    assert [j.name for j in other.joints] == [j.name for j in skel.joints]


@pytest.mark.parametrize("name", ["", "two  spaces", " first", "a\nb", "bell\a"])
@FORMATS
def test_other_names_are_refused(name: str, title: str) -> None:
    skel = pydart.World(0.001).add_empty_skeleton("s")
    skel.add_body("body", joint="weld").add_box((1, 1, 1))
    skel.add_body(name or " ", 0, "weld")
    with pytest.raises(pydart.ExportError, match="signs that do not come back"):
        text_of(skel, title)


def losses_of(skel: pydart.Skeleton, title: str, caplog: pytest.LogCaptureFixture) -> str:
    """The one warning about a text, which is the error where there must be none."""
    caplog.clear()
    with caplog.at_level(logging.WARNING, "pydart2"):
        text_of(skel, title)
    assert len(caplog.messages) <= 1
    said = caplog.messages[0] if caplog.messages else ""
    if said:
        with pytest.raises(pydart.ExportError) as error:
            getattr(skel, f"to_{title.lower()}")(strict=True)
        assert str(error.value) == said.removeprefix(f"{skel.name!r}: ")
    return said


@FORMATS
def test_what_is_lost_is_said_once(title: str, caplog: pytest.LogCaptureFixture) -> None:
    skel = numbered()
    dofs = [dof.name for dof in skel.dofs]
    assert (
        losses_of(skel, title, caplog)
        == {
            "SKEL": "",
            "URDF": "'numbered': not in URDF: initial positions ('link3_joint')",
            "SDF": f"'numbered': not in SDF: velocity limits ({', '.join(map(repr, dofs))}); "
            "force limits ('link1_joint'); initial positions ('link3_joint')",
        }[title]
    )
    skel.dofs[0].set_armature(0.1)
    skel.dofs[0].joint.set_position_limit_enforced()
    skel.set_self_collision_check(True)
    skel.body("link1").set_collidable(False)
    skel.body("link2").set_friction_coeff(0.5)
    skel.body("link2").set_restitution_coeff(0.5)
    skel.joint("link3_joint").set_actuator_type(pydart.Joint.SERVO)
    said = losses_of(skel, title, caplog)
    for what in (
        "self-collision ('numbered')",
        "that they do not collide (set_collidable) ('link1')",
        "that position limits are enforced ('link0_joint')",
        "friction coefficients ('link2')",
        "restitution coefficients ('link2')",
        "armature ('link0_joint')",
    ):
        assert what in said
    assert ("actuators that are no forces ('link3_joint')" in said) == (title != "SKEL")


@FORMATS
def test_what_is_between_bodies_is_said(title: str, caplog: pytest.LogCaptureFixture) -> None:
    skel = numbered()
    box = skel.world.add_box((1, 1, 1))
    before = losses_of(skel, title, caplog)
    filtered = skel.world.create_collision_filter()
    filtered.add_to_black_list(skel.body("link1"), skel.body("link3"))
    filtered.add_to_black_list(skel.body("link1"), box.body(0))
    pydart.constraints.WeldJointConstraint(skel.body("link2"), None).add_to_world(skel.world)
    skel.set_targets({"link1_joint": 0.5}, kp=10.0)
    skel.world.set_collision_group(skel.body("link2"), 2)
    said = losses_of(skel, title, caplog)
    assert "targets (set_targets) ('link1_joint')" in said
    assert "collision groups (set_collision_group) ('link2')" in said
    assert "constraints ('link2 and the world')" in said
    assert "bodies that pass through each other (create_collision_filter) ('link1 and link3')" in said
    assert before.removeprefix(f"'numbered': not in {title}: ") in said


def test_links_of_chains_have_names_of_their_own() -> None:
    skel = pydart.World(0.001).add_empty_skeleton("s")
    body = skel.add_body("a", joint="universal", joint_name="j")
    skel.add_body(f"a/{skel.dofs[0].name}", body, "weld")
    with pytest.raises(pydart.ExportError, match="not in URDF: 'a/j_1' of 's' would be the name of two"):
        skel.to_urdf()


def test_what_only_urdf_loses_is_said(caplog: pytest.LogCaptureFixture) -> None:
    skel = numbered()
    skel.dofs[0].set_spring_stiffness(3.0)
    skel.dofs[1].set_force_upper_limit(1.0)
    skel.dofs[3].set_initial_position(0.75)  # where readers of URDF start
    skel.set_mobile(False)
    skel.body("link1").set_gravity_mode(False)
    skel.body("link1").add_marker("here", (0.0, 0.0, 0.1))
    assert losses_of(skel, "SKEL", caplog) == ""
    said = losses_of(skel, "URDF", caplog)
    assert said == (
        "'numbered': not in URDF: that they do not move (set_mobile) ('numbered'); that gravity does not act "
        "(set_gravity_mode) ('link1'); markers ('here'); springs ('link0_joint'); force limits that are not the same "
        "both ways ('link1_joint')"
    )


def test_skel_holds_markers_gravity_and_actuators() -> None:
    skel = numbered()
    skel.body("link1").add_marker("here", (0.0, 1.0 / 3.0, 0.1))
    skel.body("link1").set_gravity_mode(False)
    skel.set_mobile(False)
    for joint, kind in zip(skel.joints[1:], (1, 2, 3, 5), strict=True):
        joint.set_actuator_type(kind)
    other = again(skel, "SKEL")
    assert [joint.actuator_type() for joint in other.joints] == [0, 1, 2, 3, 5]
    assert [body.gravity_mode() for body in other.bodynodes] == [True, True, False, True, True]
    assert not other.is_mobile()
    marker = other.body("link1").markers[0]
    assert (marker.label, marker.local_position().tolist()) == ("here", [0.0, 1.0 / 3.0, 0.1])


def test_urdf_holds_joints_that_follow_others() -> None:
    skel = numbered()
    skel.joint("link2_joint").set_mimic(skel.joint("link0_joint"), -0.75, 0.125)
    leader = again(skel, "URDF").joint("link2_joint").mimic()
    assert leader is not None
    assert (leader[0].name, *leader[1:]) == ("link0_joint", -0.75, 0.125)
    assert skel.joint("link0_joint").mimic() is None


def test_roots_come_back() -> None:
    """Several of them, free ones apart from the origin, and the usual one, which URDF does not name."""
    skel = pydart.World(0.001).add_empty_skeleton("two")
    for name in ("left", "right"):
        skel.add_body(name, joint="free", joint_position=(0.1, 0, 0), orientation=TURN).add_box((1, 2, 3))
        skel.joint(f"{name}_joint").set_transform_from_parent_body_node(skel.body(name).T)
    assert_moves_as(again(skel, "SKEL"), skel)
    assert_moves_as(again(skel, "URDF"), skel, poses=False)
    usual = pydart.World(0.001).add_skeleton("./data/urdf/PR2/pr2.urdf")
    assert '"world"' not in usual.to_urdf()


def test_a_free_root_of_urdf_is_a_link_without_a_joint(caplog: pytest.LogCaptureFixture) -> None:
    """Other readers take a floating joint under a link `world` for a fixed one."""
    skel = pydart.World(0.001, up="z").add_empty_skeleton("drone")
    body = skel.add_body("hull", joint="free", position=(0.0, 0.0, 1.0))
    body.add_box((0.1, 0.2, 0.3))
    skel.add_body("arm", body, "revolute", axis=(0, 1, 0)).add_sphere(0.1, position=(0.0, 0.0, 0.2))
    root = ElementTree.fromstring(skel.to_urdf())
    assert [link.get("name") for link in root.iter("link")] == ["hull", "arm"]
    assert [joint.get("type") for joint in root.iter("joint")] == ["continuous"]
    said = losses_of(skel, "URDF", caplog)
    assert said.endswith("names of the joints of free roots ('hull_joint'); initial positions ('hull_joint_pos_z')")
    assert_moves_as(again(skel, "URDF"), skel)
    skel.joints[0].set_transform_from_parent_body_node(skel.body("hull").T)
    assert "where the positions of free roots count from, now the origin ('hull')" in losses_of(skel, "URDF", caplog)
    assert_moves_as(again(skel, "URDF"), skel, from_origin=True)


def test_meshes_are_named_from_the_folder_of_the_file(tmp_path: Path) -> None:
    (tmp_path / "my mäshes").mkdir()
    wedge = tmp_path / "my mäshes" / "wedge.obj"
    wedge.write_text("v 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 3\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n")
    text = f"""<robot name="mirrored"><link name="world"/><link name="body"><inertial><mass value="1"/>
    <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
    <collision><geometry><mesh filename="file://{wedge}" scale="1 -0.5 2"/></geometry></collision></link>
    <joint name="j" type="fixed"><parent link="world"/><child link="body"/></joint></robot>"""
    skel = pydart.World(0.001).add_skeleton(text)
    for suffix in ("urdf", "skel", "sdf"):
        file = tmp_path / f"out.{suffix}"
        skel.save(file)
        assert "my mäshes/wedge.obj" in file.read_text(encoding="utf-8")
        assert str(tmp_path) not in file.read_text(encoding="utf-8")
        for source in (file, text_of(skel, suffix.upper())):
            other = pydart.World(0.001).add_skeleton(source)
            assert_is(other, skel, suffix.upper())
            node = other.body("body").shapenodes[0]
            assert node.shape is not None
            assert np.array(node.shape.bounding_box()).tolist() == [[0.0, -1.0, 0.0], [1.0, 0.0, 6.0]]


@pytest.mark.parametrize("title", ["SKEL", "SDF"])
def test_worlds_are_saved(tmp_path: Path, title: str) -> None:
    world = pydart.World(0.002, up="z")
    world.add_ground()
    for i in range(3):
        world.add_box((0.2, 0.2, 0.2), mass=1.0 / 3.0, position=(0.5 * i, 0.1, 0.1), color=(0.1 * i, 0, 1))
    if title == "SDF":
        world.remove_skeleton(world.skeletons[0])  # its plane
        world.add_box((5, 5, 0.1), position=(0, 0, -0.05), fixed=True)
    file = tmp_path / f"world.{title.lower()}"
    world.save(file)
    again = pydart.World(0.002, file)
    assert again.gravity().tolist() == world.gravity().tolist()
    assert [skel.name for skel in again.skeletons] == [skel.name for skel in world.skeletons]
    for a, b in zip(again.skeletons, world.skeletons, strict=True):
        assert (a.q.tolist() == b.q.tolist()) == (title == "SKEL" or not a.ndofs)
        assert pytest.approx(b.body(0).T, abs=1e-15) == a.body(0).T
        assert_is(a, b, title)
    world.step(100)
    again.step(100)
    for a, b in zip(again.skeletons, world.skeletons, strict=True):
        assert pytest.approx(b.body(0).T, abs=1e-9) == a.body(0).T


def test_what_cannot_be_saved_leaves_no_file(tmp_path: Path) -> None:
    world = pydart.World(0.001, "./data/skel/softBodies.skel")
    for name in ("a.skel", "a.urdf"):
        with pytest.raises(pydart.ExportError, match=r"soft|a world"):
            world.save(tmp_path / name)
    with pytest.raises(pydart.ExportError, match=r"body '.*' of '.*' is soft"):
        world.skeletons[1].save(tmp_path / "b.skel")
    with pytest.raises(pydart.ExportError, match=r"no format for '.*c.stl'; its suffix is one of \.urdf"):
        world.skeletons[0].save(tmp_path / "c.stl")
    mesh = pydart.World(0.001).add_mesh(
        [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]
    )
    with pytest.raises(pydart.ExportError, match="the mesh 'mesh' is made of arrays and has no file"):
        mesh.save(tmp_path / "d.urdf")
    with pytest.raises(pydart.ExportError, match="has no body"):
        world.add_empty_skeleton("empty").save(tmp_path / "e.urdf")
    with pytest.raises(OSError, match="nowhere"):
        world.skeletons[0].save(tmp_path / "nowhere" / "f.skel")
    assert list(tmp_path.iterdir()) == []
