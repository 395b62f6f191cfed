"""Our models have the published figures.

figures/*.json holds the figures; make_figures.py says where they come from.
"""

from __future__ import annotations

import json
import xml.etree.ElementTree as ET
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import pydart2

HERE = Path(__file__).parent
ATLAS = "sdf/atlas/atlas_v3_no_head.sdf"
PR2 = "urdf/PR2/pr2.urdf"
WORLDS = ("cubes", "chain", "fullbody1", "softBodies", "shapes", "ground")
FOOT = (0.26102, 0.14124, 0.15311)  # m, extents of DART's foot.obj


def figures(name: str) -> dict[str, Any]:
    return json.loads((HERE / "figures" / f"{name}.json").read_text(encoding="ascii"))


def limit(value: float | None, sign: float = 1.0) -> float:
    return sign * np.inf if value is None else value


def axes(joint: Any) -> list[Any]:
    return [getattr(joint, read)() for read in ("axis", "axis1", "axis2") if hasattr(joint, read)]


def check_bodies(skeleton: Any, expected: dict[str, Any]) -> None:
    """Names, order, tree, masses and inertias."""
    assert skeleton.name == expected["name"]
    assert [b.name for b in skeleton.bodynodes] == [b["name"] for b in expected["bodies"]]
    assert skeleton.m == pytest.approx(expected["mass"], abs=1e-9)
    for body, e in zip(skeleton.bodynodes, expected["bodies"], strict=True):
        assert (body.parent_bodynode.name if body.parent_bodynode else None) == e["parent"], body.name
        assert body.mass() == pytest.approx(e["mass"], abs=1e-9), body.name
        np.testing.assert_allclose(body.local_com(), e["com"], rtol=0, atol=1e-9, err_msg=body.name)
        np.testing.assert_allclose(body.inertia(), e["inertia"], rtol=1e-6, atol=1e-12, err_msg=body.name)


def check_joints(skeleton: Any, expected: dict[str, Any]) -> None:
    """Names, order, types, frames, axes and how they are driven."""
    assert [j.name for j in skeleton.joints] == [j["name"] for j in expected["joints"]]
    for joint, e in zip(skeleton.joints, expected["joints"], strict=True):
        assert joint.type() == e["type"], joint.name
        assert joint.actuator_type() == getattr(pydart2.joint.Joint, e["actuator"]), joint.name
        np.testing.assert_allclose(joint.transform_from_parent_body_node(), e["from_parent"], atol=1e-9)
        np.testing.assert_allclose(joint.transform_from_child_body_node(), e["from_child"], atol=1e-9)
        if "axes" in e:
            np.testing.assert_allclose(axes(joint), e["axes"], atol=1e-9, err_msg=joint.name)


def check_dofs(skeleton: Any, expected: dict[str, Any]) -> None:
    """Names, order, limits, damping and the initial pose."""
    assert [d.name for d in skeleton.dofs] == [d["name"] for d in expected["dofs"]]
    np.testing.assert_allclose(np.asarray(skeleton.q).reshape(-1), expected["q"], atol=1e-9)
    for dof, e in zip(skeleton.dofs, expected["dofs"], strict=True):
        assert dof.position_lower_limit() == pytest.approx(limit(e["lower"], -1.0)), dof.name
        assert dof.position_upper_limit() == pytest.approx(limit(e["upper"])), dof.name
        assert dof.velocity_upper_limit() == pytest.approx(limit(e["velocity"])), dof.name
        assert dof.force_upper_limit() == pytest.approx(limit(e["force"])), dof.name
        if skeleton.name == "fullbody1":  # our human is damped, so that it comes to rest; the published one is not
            assert e["damping"] == 0.0
            assert (dof.damping_coefficient() > 0.0) == (not dof.name.startswith("j_pelvis")), dof.name
        else:
            assert dof.damping_coefficient() == pytest.approx(e["damping"]), dof.name


def check_poses(skeleton: Any, expected: dict[str, Any]) -> None:
    """The mass matrix and the bias forces, which hold all of the tree."""
    assert len(expected["poses"]) == (10 if expected["dofs"] else 0)
    for pose in expected["poses"]:
        skeleton.q, skeleton.dq = np.array(pose["q"]), np.array(pose["dq"])
        lower = np.asarray(skeleton.M)[np.tril_indices(len(pose["q"]))]
        for got, want in ((lower, np.array(pose["M"])), (np.asarray(skeleton.c), np.array(pose["c"]))):
            np.testing.assert_allclose(got, want, rtol=1e-6, atol=1e-9 * np.abs(want).max())


def check_skeleton(skeleton: Any, expected: dict[str, Any]) -> None:
    check_bodies(skeleton, expected)
    check_joints(skeleton, expected)
    check_dofs(skeleton, expected)
    check_poses(skeleton, expected)


def robot(path: str, **options: Any) -> Iterator[Any]:
    world = pydart2.World(0.001)
    world.set_gravity([0.0, 0.0, -9.81])
    yield world.add_skeleton(pydart2.data_path(path), **options)


@pytest.fixture
def atlas() -> Iterator[Any]:
    yield from robot(ATLAS)


@pytest.fixture
def pr2() -> Iterator[Any]:
    yield from robot(PR2)


def test_atlas(atlas: Any) -> None:
    check_skeleton(atlas, figures("atlas_v3_no_head"))
    assert (len(atlas.bodynodes), len(atlas.joints), len(atlas.dofs)) == (28, 28, 33)
    assert atlas.m == pytest.approx(146.554, abs=1e-9)


def test_atlas_stated_limits() -> None:
    """DART's SDF reader leaves out effort and velocity, so the file itself is compared."""
    joints = ET.parse(pydart2.data_path(ATLAS)).iter("joint")
    stated = {j.get("name"): {v.tag: float(v.text or "") for v in j.findall("axis/limit/*")} for j in joints}
    assert stated == figures("atlas_v3_no_head")["stated_limits"]


def test_atlas_shapes(atlas: Any) -> None:
    for body in atlas.bodynodes:
        kinds = [(n.has_visual_aspect(), n.has_collision_aspect()) for n in body.shapenodes]
        assert kinds.count((True, False)) == 1, body.name
        assert kinds.count((False, True)) == (3 if body.name == "utorso" else 1), body.name


def test_pr2(pr2: Any) -> None:
    """The engine gives 1 kg to twelve fixed frames that state no mass; here they have none."""
    published = next(robot(PR2, engine_defaults=True))
    check_skeleton(published, figures("pr2"))
    assert (len(pr2.bodynodes), len(pr2.dofs)) == (88, 51)
    assert published.m == pytest.approx(280.732178, abs=1e-6)
    assert pr2.m == pytest.approx(268.732178, abs=1e-6)
    changed = {a.name: (a.m, b.m) for a, b in zip(pr2.bodynodes, published.bodynodes) if a.m != b.m}
    assert set(changed.values()) == {(0.0, 1.0)} and len(changed) == 12
    assert all(pr2.body(name).parent_joint.type() == "WeldJoint" for name in changed)
    assert pr2.dofs[5].name == "rootJoint_pos_z"


def test_pr2_fingers_follow() -> None:
    """A gripper's three other finger joints mimic the left one."""
    joints = ET.parse(pydart2.data_path(PR2)).iter("joint")
    leaders = {str(j.get("name")): m.attrib for j in joints for m in j.findall("mimic")}
    for side in "lr":
        followers = [f"{side}_gripper_{name}_joint" for name in ("r_finger", "l_finger_tip", "r_finger_tip")]
        for name in followers:
            assert leaders[name] == {"joint": f"{side}_gripper_l_finger_joint", "multiplier": "1", "offset": "0"}
    assert len(leaders) == 6


def test_pr2_shapes(pr2: Any) -> None:
    """What is drawn is a mesh; what collides is a box or a cylinder."""
    nodes = [(body.name, node) for body in pr2.bodynodes for node in body.shapenodes]
    drawn = [name for name, node in nodes if node.has_visual_aspect()]
    assert len(drawn) == len(set(drawn)) >= 40
    for name, node in nodes:
        assert node.has_visual_aspect() != node.has_collision_aspect(), name
        assert node.shape.type() in (("MeshShape",) if node.has_visual_aspect() else ("BoxShape", "CylinderShape"))


@pytest.mark.parametrize("name", WORLDS)
def test_world(name: str) -> None:
    """The bodies of a SKEL world, skeleton by skeleton."""
    expected = figures(name)
    world = pydart2.World(expected["time_step"], pydart2.data_path(f"skel/{name}.skel"))
    assert len(world.skeletons) == len(expected["skeletons"])
    np.testing.assert_allclose(world.gravity(), [0.0, -9.81, 0.0])
    for skeleton, e in zip(world.skeletons, expected["skeletons"], strict=True):
        assert skeleton.is_mobile() == e["mobile"]
        check_skeleton(skeleton, e)


def sizes(shape: Any) -> list[Any]:
    """The measures of a shape in the order of the figures."""
    return [getattr(shape, read)() for read in ("size", "radius", "height", "scale") if hasattr(shape, read)]


@pytest.mark.parametrize("name", WORLDS)
def test_world_shapes(name: str) -> None:
    """What collides is as published; what is drawn too, except for the humanoid and its floor."""
    expected = figures(name)
    world = pydart2.World(expected["time_step"], pydart2.data_path(f"skel/{name}.skel"))
    for skeleton, e in zip(world.skeletons, expected["skeletons"], strict=True):
        for body, shapes in zip(skeleton.bodynodes, e["shapes"], strict=True):
            assert len(body.shapenodes) == len(shapes), body.name
            for node, figure in zip(body.shapenodes, shapes, strict=True):
                assert node.has_collision_aspect() == figure["collides"], body.name
                if name == "fullbody1" and not figure["collides"]:
                    assert node.shape.type() == "MeshShape"
                else:
                    check_shape(node, figure)


def check_shape(node: Any, figure: dict[str, Any]) -> None:
    assert node.shape.type() == figure["type"]
    for got, want in zip(sizes(node.shape), figure["size"], strict=True):
        np.testing.assert_allclose(got, want, atol=1e-12)
    np.testing.assert_allclose(node.relative_transform(), figure["place"], atol=1e-9)
    if "rgba" in figure:
        np.testing.assert_allclose(node.visual_aspect_rgba(), figure["rgba"], atol=1e-9)


@pytest.mark.parametrize("name", WORLDS)
def test_world_file(name: str) -> None:
    """The settings, and what the loaded world does not tell of soft skins and multiple spheres."""
    expected = figures(name)
    root = ET.parse(pydart2.data_path(f"skel/{name}.skel")).getroot()
    stated = {key: root.findtext(f"world/physics/{key}", "") for key in ("time_step", "gravity", "collision_detector")}
    assert float(stated["time_step"]) == expected["time_step"]
    if name == "ground":  # DART's own file has no settings; ours says that y is up
        assert (stated["gravity"], stated["collision_detector"]) == ("0 -9.81 0", "fcl_mesh")
    else:
        assert [float(v) for v in stated["gravity"].split()] == expected["gravity"]
        assert stated["collision_detector"] == expected["stated_detector"]
    assert stated_shapes(root) == expected["stated_shapes"]


def stated_shapes(root: ET.Element) -> list[dict[str, list[list[float]]]]:
    shapes = [e for tag in ("soft_shape", "multi_sphere") for e in root.iter(tag)]
    out: list[dict[str, list[list[float]]]] = []
    for shape in shapes:
        values: dict[str, list[list[float]]] = {}
        for leaf in (e for e in shape.iter() if len(e) == 0):
            values.setdefault(leaf.tag, []).append([float(v) for v in (leaf.text or "").split()])
        out.append(values)
    return out


def test_fullbody_names() -> None:
    """The names that the documentation uses."""
    skeleton = pydart2.World(0.001, pydart2.data_path("skel/fullbody1.skel")).skeletons[1]
    for name in ("j_bicep_left_x", "j_thigh_left_z", "j_heel_left_1", "j_abdomen_2", "j_pelvis_pos_y", "j_toe_right"):
        assert skeleton.dof(name).name == name
    for name in ("h_spine", "h_heel_left", "h_heel_right"):
        assert skeleton.body(name).name == name


def test_foot_has_the_published_extents() -> None:
    lines = Path(pydart2.data_path("obj/foot.obj")).read_text(encoding="ascii").splitlines()
    points = np.array([[float(v) for v in line.split()[1:]] for line in lines if line.startswith("v ")])
    np.testing.assert_allclose(np.ptp(points, axis=0), FOOT, atol=2e-4)
