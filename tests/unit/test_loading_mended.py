"""What other readers take: flat boxes, points, capsules, limits the wrong way round; and in which line errors are."""

from __future__ import annotations

import math
import pickle
from typing import Any

import numpy as np
import pytest

from pydart2 import LoadError, World

INERTIAL = "<inertial><mass value='2'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial>"
DETECTORS = ("dart", "fcl", "bullet", "ode")


def urdf(shape: str, kind: str = "collision", origin: str = "") -> str:
    owner = f"<{kind}>{origin}<geometry>\n{shape}\n</geometry></{kind}>"
    return f"<robot name='r'>\n<link name='plate'>{INERTIAL}\n{owner}</link></robot>"


def sdf(shape: str) -> str:
    collision = f"<collision name='flat'><geometry>\n{shape}\n</geometry></collision>"
    return f"<sdf version='1.5'><model name='m'><link name='plate'>\n{collision}</link></model></sdf>"


def skel(shape: str) -> str:
    collision = f"<collision_shape><geometry>\n{shape}\n</geometry></collision_shape>"
    body = f"<body name='plate'><inertia><mass>1</mass></inertia>{collision}</body>"
    joint = "<joint type='free' name='j'><parent>world</parent><child>plate</child></joint>"
    return f"<skel version='1.0'><skeleton name='s'>\n\n{body}{joint}</skeleton></skel>"


TEXTS = {
    "urdf": urdf("<box size='1 1 0'/>"),
    "sdf": sdf("<box><size>1 1 0</size></box>"),
    "skel": skel("<box><size>1 1 0</size></box>"),
}


@pytest.mark.parametrize("kind", TEXTS)
def test_a_flat_box_is_a_millimetre_thick(kind: str, caplog: Any) -> None:
    """One warning names link, shape and line; strict refuses."""
    skeleton = World(0.001).add_skeleton(TEXTS[kind])
    np.testing.assert_array_equal(skeleton.bodynodes[0].shapenodes[0].shape.size(), [1.0, 1.0, 1e-3])
    (record,) = caplog.records
    line = 1 + TEXTS[kind][: TEXTS[kind].index("<box")].count("\n")
    assert f"line {line}: <collision" in record.getMessage() and "'plate' has no thickness" in record.getMessage()
    with pytest.raises(LoadError, match=f"line {line}: .* has no thickness"):
        World(0.001).add_skeleton(TEXTS[kind], strict=True)


@pytest.mark.parametrize("detector", DETECTORS)
@pytest.mark.parametrize("flat_below", [True, False], ids=["dropped upon", "dropped"])
def test_flat_boxes_hold_and_rest(detector: str, flat_below: bool) -> None:
    world = World(0.001)
    world.set_gravity([0.0, 0.0, -9.81])
    world.set_collision_detector(detector)
    for flat, z in ((flat_below, 0.0), (not flat_below, 0.08)):
        skeleton = world.add_skeleton(urdf(f"<box size='{'1 1 0' if flat else '.1 .1 .1'}'/>"))
        skeleton.q = [0.0, 0.0, 0.0, 0.0, 0.0, z]
        skeleton.set_mobile(z > 0.0)
    world.step(600)
    assert world.skeletons[1].q[5] == pytest.approx(0.0505, abs=2e-3)


@pytest.mark.parametrize(
    ("shape", "drawn"), [("<box size='1 1 0'/>", (1, 1, 0)), ("<sphere radius='0'/>", 0.0)], ids=["box", "sphere"]
)
def test_drawn_as_written(shape: str, drawn: Any, caplog: Any) -> None:
    (node,) = World(0.001).add_skeleton(urdf(shape, "visual")).bodynodes[0].shapenodes
    size = node.shape.size() if "box" in shape else node.shape.radius()
    np.testing.assert_allclose(size, drawn, atol=1e-9)
    assert caplog.records == []


def test_a_point_does_not_collide(caplog: Any) -> None:
    skeleton = World(0.001).add_skeleton(urdf("<sphere radius='0'/>"))
    assert list(skeleton.bodynodes[0].shapenodes) == []
    assert "line 4: <collision> of <link> 'plate' is a point" in caplog.text


def test_a_cylinder_without_length_or_radius() -> None:
    for size, expected in (("radius='1' length='0'", (1.0, 1e-3)), ("radius='0' length='1'", (5e-4, 1.0))):
        shape = World(0.001).add_skeleton(urdf(f"<cylinder {size}/>")).bodynodes[0].shapenodes[0].shape
        assert (shape.radius(), shape.height()) == expected


@pytest.mark.parametrize(
    "shape", ["<box size='1 1 -1'/>", "<sphere radius='-1'/>", "<cylinder radius='1' length='-2'/>"]
)
def test_negative_sizes_are_refused_at_their_line(shape: str) -> None:
    with pytest.raises(LoadError, match=r"line 4: <collision> of <link> 'plate': .* must not be negative"):
        World(0.001).add_skeleton(urdf(shape))


def test_capsules_of_urdf(caplog: Any, capfd: Any) -> None:
    """A cylinder and two spheres at its ends, where rpy takes them: the extent of a capsule."""
    origin = "<origin xyz='1 2 3' rpy='0 1.5707963267948966 0'/>"
    skeleton = World(0.001).add_skeleton(urdf("<capsule radius='.1' length='1'/>", origin=origin))
    nodes = skeleton.bodynodes[0].shapenodes
    found = {(node.shape.type(), *node.relative_transform()[:3, 3].round(9)) for node in nodes}
    assert found == {("CylinderShape", 1.0, 2.0, 3.0), ("SphereShape", 1.5, 2.0, 3.0), ("SphereShape", 0.5, 2.0, 3.0)}
    assert caplog.records == [] and capfd.readouterr() == ("", "")


@pytest.mark.parametrize("text", [urdf("<bix size='1 1 1'/>"), sdf("<bix><size>1 1 1</size></bix>")])
def test_an_unknown_shape_is_refused(text: str) -> None:
    line = 1 + text[: text.index("<bix")].count("\n")
    with pytest.raises(LoadError, match=f"line {line}: .*<bix> is no shape of this format; known are"):
        World(0.001).add_skeleton(text)


def test_an_unknown_shape_is_not_drawn(caplog: Any, capfd: Any) -> None:
    skeleton = World(0.001).add_skeleton(urdf("<bix size='1 1 1'/>", "visual"))
    assert list(skeleton.bodynodes[0].shapenodes) == []
    assert "line 4: <visual> of <link> 'plate': <bix> is no shape" in caplog.text
    assert capfd.readouterr() == ("", "")


def arm(limit: str, kind: str = "revolute") -> str:
    ends = "<parent link='base'/><child link='arm'/>"
    joint = f"<joint name='arm' type='{kind}'>{ends}\n<axis xyz='1 0 0'/>\n{limit}</joint>"
    links = f"<link name='base'>{INERTIAL}</link>\n<link name='arm'>{INERTIAL}</link>"
    return f"<robot name='r'>\n{links}\n{joint}</robot>"


def sdf_arm(limit: str) -> str:
    joint = "<joint name='arm' type='revolute'><parent>base</parent><child>arm</child>\n<axis><xyz>1 0 0</xyz>"
    links = "<link name='base'/><link name='arm'/>"
    return f"<sdf version='1.5'><model name='m'>{links}{joint}\n{limit}</axis></joint></model></sdf>"


INVERTED = "<limit lower='1' upper='-1' effort='7' velocity='8'/>"
UNSTATED = "<limit effort='7' velocity='8'/>"


def test_a_limit_without_effort_and_velocity_bounds_neither(caplog: Any) -> None:
    dof = World(0.001).add_skeleton(arm("<limit lower='-1' upper='2'/>")).dofs[-1]
    assert (dof.position_lower_limit(), dof.position_upper_limit()) == (-1.0, 2.0)
    assert dof.velocity_upper_limit() == dof.force_upper_limit() == math.inf
    assert dof.velocity_lower_limit() == dof.force_lower_limit() == -math.inf
    (record,) = caplog.records
    assert "<joint> 'arm': its <limit> has no effort and no velocity" in record.getMessage()
    with pytest.raises(LoadError, match="no effort and no velocity"):
        World(0.001).add_skeleton(arm("<limit lower='-1' upper='2'/>"), strict=True)


def test_an_inertial_without_mass_is_none(caplog: Any) -> None:
    cup = "<link name='cup'><inertial><origin xyz='0 0 1'/></inertial></link>"
    held = "<joint name='held' type='fixed'><parent link='arm'/><child link='cup'/></joint>"
    skel = World(0.001).add_skeleton(arm(UNSTATED).replace("</robot>", f"{cup}{held}</robot>"))
    assert skel.body("cup").m == 0.0
    (record,) = caplog.records
    assert "<link> 'cup': its <inertial> has no <mass>; left out" in record.getMessage()


@pytest.mark.parametrize(
    ("text", "line"),
    [
        (arm(INVERTED), 6),
        (arm(INVERTED, "prismatic"), 6),
        (sdf_arm("<limit><lower>1</lower><upper>-1</upper></limit>"), 3),
    ],
    ids=["hinge", "slide", "SDF"],
)
def test_limits_the_wrong_way_round_are_none(text: str, line: int, caplog: Any) -> None:
    world = World(0.001)
    dof = world.add_skeleton(text).dofs[-1]
    assert (dof.position_lower_limit(), dof.position_upper_limit()) == (-math.inf, math.inf)
    (record,) = caplog.records
    assert f"line {line}: <joint> 'arm': its lower limit, 1, is above its upper, -1" in record.getMessage()
    with pytest.raises(LoadError, match=f"line {line}: "):
        World(0.001).add_skeleton(text, strict=True)
    if "robot" in text:
        assert (dof.force_upper_limit(), dof.velocity_upper_limit()) == (7.0, 8.0)


@pytest.mark.parametrize("kind", ["revolute", "prismatic"])
def test_bounds_that_are_not_stated_do_not_lock(kind: str, caplog: Any) -> None:
    """The engine takes them as 0, and enforced they lock."""
    world = World(0.001)
    world.set_gravity([0.0, 0.0, 0.0])
    skeleton = world.add_skeleton(arm(UNSTATED, kind), enforce_limits=True)
    assert "no position limits to enforce for joints 'arm'" in caplog.text
    skeleton.dq = [0.0] * 6 + [1.0]
    world.step(100)
    assert skeleton.q[6] == pytest.approx(0.1, abs=0.01)
    engine = World(0.001).add_skeleton(arm(UNSTATED, kind), engine_defaults=True)
    assert (engine.q_lower[6], engine.q_upper[6]) == (0.0, 0.0)


@pytest.mark.parametrize("kind", ["revolute", "prismatic"])
@pytest.mark.parametrize(
    ("bounds", "low", "high"),
    [
        ("lower='-inf' upper='-0.5'", -math.inf, -0.5),
        ("lower='0.5' upper='1.7976931348623157e308'", 0.5, math.inf),
        ("lower='-1e300' upper='-0.5'", -math.inf, -0.5),
    ],
)
def test_a_number_that_stands_for_no_bound(kind: str, bounds: str, low: float, high: float) -> None:
    """The engine starts in the middle between two bounds: at -9e307, where a turn has no sine."""
    world = World(0.001)
    dof = world.add_skeleton(arm(f"<limit {bounds} effort='inf' velocity='8'/>", kind)).dofs[-1]
    assert (dof.position_lower_limit(), dof.position_upper_limit()) == (low, high)
    assert (dof.force_upper_limit(), dof.velocity_upper_limit()) == (math.inf, 8.0)
    nearest_to_zero = min(low, high, key=abs)
    assert dof.position() == dof.rest_position() == nearest_to_zero
    world.reset()
    assert dof.position() == nearest_to_zero


@pytest.mark.parametrize("copied", [lambda w: w, lambda w: w.clone(), lambda w: pickle.loads(pickle.dumps(w))])
def test_enforced_limits_hold_in_copies(copied: Any) -> None:
    world = World(0.001)
    world.add_skeleton(arm("<limit lower='-.5' upper='.5' effort='7' velocity='8'/>"), enforce_limits=True)
    world = copied(world)
    (skeleton,) = world.skeletons
    assert [joint.is_position_limit_enforced() for joint in skeleton.joints] == [False, True]
    skeleton.dq = [0.0] * 6 + [10.0]
    world.step(500)
    assert skeleton.q[6] < 0.52
    skeleton.set_position_limits_enforced(False)
    assert not any(joint.is_position_limit_enforced() for joint in skeleton.joints)


def test_the_line_of_the_joint_not_of_the_link() -> None:
    """A link and a joint of one name."""
    text = arm("").replace("</joint>", "<limit lower='x' upper='1' effort='1' velocity='1'/></joint>")
    with pytest.raises(LoadError, match="line 6"):
        World(0.001).add_skeleton(text)
    with pytest.raises(LoadError, match=r"line 4: the engine says: Joint \[arm\]"):
        World(0.001).add_skeleton(arm(""))


def test_what_mimics_a_fixed_joint_moves_by_itself(caplog: Any) -> None:
    """Neither such a joint nor a fixed one that mimics ends the process, with either of the engine's solvers."""
    parts = [f"<link name='{name}'>{INERTIAL}</link>" for name in "abcd"]
    for child, kind, mimic in (("b", "fixed", ""), ("c", "continuous", "to_b"), ("d", "fixed", "to_c")):
        follows = f"<mimic joint='{mimic}'/>" if mimic else ""
        ends = f"<parent link='a'/><child link='{child}'/><axis xyz='1 0 0'/>"
        parts.append(f"<joint name='to_{child}' type='{kind}'>{ends}{follows}</joint>")
    for solver in ("fast", "dart"):
        world = World(0.001)
        world.set_constraint_solver(solver)
        skeleton = world.add_skeleton(f"<robot name='r'>{''.join(parts)}</robot>")
        skeleton.dq = [0.0] * 6 + [1.0]
        world.step(10)
        assert skeleton.q[6] == pytest.approx(0.01, rel=1e-6)
    assert "<joint> 'to_c' mimics <joint> 'to_b', which is fixed" in caplog.text


def test_a_continuous_joint_of_sdf() -> None:
    text = sdf_arm("<limit><lower>-1</lower><upper>1</upper></limit>").replace("revolute", "continuous")
    joint = World(0.001).add_skeleton(text).joints[-1]
    assert joint.type() == "RevoluteJoint" and not joint.has_position_limit(0)


def test_a_fourth_number_of_a_scale(tmp_path: Any, caplog: Any) -> None:
    (tmp_path / "t.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    text = urdf(f"<mesh filename='{tmp_path}/t.obj' scale='1 2 3 4'/>", "visual")
    (node,) = World(0.001).add_skeleton(text).bodynodes[0].shapenodes
    np.testing.assert_array_equal(node.shape.scale(), [1.0, 2.0, 3.0])
    assert "line 4: <mesh>: its scale has 4 numbers" in caplog.text


def test_zero_bytes_at_the_end() -> None:
    assert World(0.001).add_skeleton(urdf("<sphere radius='1'/>").encode() + b"\n\0\0").m == 2.0


def test_shapes_left_out_on_request(caplog: Any) -> None:
    skeleton = World(0.001).add_skeleton(urdf("<bix/>"), missing_meshes="warn")
    assert list(skeleton.bodynodes[0].shapenodes) == [] and "left out" in caplog.text


def gravity_world(outer: str, physics: str) -> str:
    model = "<model name='m'><link name='l'/></model>"
    return f"<sdf version='1.6'>\n<world name='w'>{outer}{physics}{model}</world></sdf>"


@pytest.mark.parametrize("physics", ["", "<physics type='ode'/>", "<physics type='ode'><real_time_factor/></physics>"])
def test_gravity_of_an_sdf_world_itself(physics: str, caplog: Any) -> None:
    """Where SDF has it since 1.5; the engine reads that of <physics>."""
    world = World(0.001, gravity_world("<gravity>0 1 -2</gravity>", physics))
    np.testing.assert_array_equal(world.gravity(), [0.0, 1.0, -2.0])
    assert not caplog.records


def test_two_gravities(caplog: Any) -> None:
    """That of <physics>, as the engine has it; a warning if they differ."""
    text = gravity_world("<gravity>0 1 -2</gravity>", "<physics type='ode'><gravity>0 0 {}</gravity></physics>")
    np.testing.assert_array_equal(World(0.001, text.format(-3)).gravity(), [0.0, 0.0, -3.0])
    assert "line 2: <world> 'w': its gravity is 0 1 -2, that of its <physics>, 0 0 -3, is taken" in caplog.text
    caplog.clear()
    World(0.001, text.replace("0 1 -2", "0 0 -2").format(-2.0))
    assert not caplog.records
    with pytest.raises(LoadError, match="<gravity> of <world> 'w' must be 3 numbers"):
        World(0.001, gravity_world("<gravity>1</gravity>", ""))


def test_gears_are_said_and_turn_freely(caplog: Any) -> None:
    joint = """<joint name='j' type='gearbox'><parent>a</parent><child>b</child><gearbox_ratio>0.04</gearbox_ratio>
<gearbox_reference_body>a</gearbox_reference_body><axis><xyz>0 0 1</xyz></axis></joint>"""
    text = f"<sdf version='1.5'><model name='m'><link name='a'/><link name='b'/>\n{joint}</model></sdf>"
    skeleton = World(0.001).add_skeleton(text)
    assert skeleton.joint("j").num_dofs() == 1
    assert "line 2: <joint> 'j': the engine has no gears" in caplog.text and "0.04 to 'a'" in caplog.text
    with pytest.raises(LoadError, match="no gears"):
        World(0.001).add_skeleton(text, strict=True)
