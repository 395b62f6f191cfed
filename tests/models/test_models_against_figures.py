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
CUBES = "skel/cubes.skel"
GROUND = """<skel version="1.0"><world name="ground"><physics>
<time_step>0.001</time_step><gravity>0 0 -9.81</gravity>
<collision_detector>dart</collision_detector></physics>
<skeleton name="ground"><body name="ground"><transformation>0 0 -0.5 0 0 0</transformation>
<collision_shape><geometry><box><size>8 8 1</size></box></geometry></collision_shape></body>
<joint name="fixed" type="weld"><parent>world</parent><child>ground</child></joint></skeleton></world></skel>
"""
SOLE = 0.927  # from the pelvis down to the sole in the zero pose (m)


def figures(name: str) -> dict[str, Any]:
    return json.loads((HERE / "figures" / f"{name}.json").read_text(encoding="ascii"))


def limit(value: float | None) -> float:
    return np.inf if value is None else value


def check_skeleton(skeleton: Any, expected: dict[str, Any]) -> None:
    """Names, order, masses, inertias and frames."""
    assert skeleton.name == expected["name"]
    assert [b.name for b in skeleton.bodynodes] == [b["name"] for b in expected["bodies"]]
    assert [j.name for j in skeleton.joints] == [j["name"] for j in expected["joints"]]
    assert [d.name for d in skeleton.dofs] == [d["name"] for d in expected["dofs"]]
    for body, e in zip(skeleton.bodynodes, expected["bodies"], strict=True):
        assert body.mass() == pytest.approx(e["mass"], abs=1e-9), body.name
        np.testing.assert_allclose(body.local_com(), e["com"], rtol=0, atol=1e-9, err_msg=body.name)
        np.testing.assert_allclose(body.inertia(), e["inertia"], rtol=1e-6, atol=1e-12, err_msg=body.name)
    for joint, e in zip(skeleton.joints, expected["joints"], strict=True):
        assert joint.type() == e["type"], joint.name
        np.testing.assert_allclose(joint.transform_from_parent_body_node(), e["from_parent"], atol=1e-9)
        np.testing.assert_allclose(joint.transform_from_child_body_node(), e["from_child"], atol=1e-9)


def check_poses(skeleton: Any, expected: dict[str, Any]) -> None:
    """The mass matrix and the bias forces, which hold all of the tree."""
    for pose in expected["poses"]:
        skeleton.q, skeleton.dq = np.array(pose["q"]), np.array(pose["dq"])
        lower = np.asarray(skeleton.M)[np.tril_indices(len(pose["q"]))]
        for got, want in ((lower, np.array(pose["M"])), (np.asarray(skeleton.c), np.array(pose["c"]))):
            np.testing.assert_allclose(got, want, rtol=1e-6, atol=1e-9 * np.abs(want).max())


@pytest.fixture
def atlas() -> Iterator[Any]:
    world = pydart2.World(0.001)
    world.set_gravity(figures("atlas_v3_no_head")["gravity"])
    yield world.add_skeleton(pydart2.data_path(ATLAS))


def test_atlas_tree(atlas: Any) -> None:
    expected = figures("atlas_v3_no_head")
    check_skeleton(atlas, expected)
    assert (len(atlas.bodynodes), len(atlas.joints), len(atlas.dofs)) == (28, 28, 33)
    assert sum(b.mass() for b in atlas.bodynodes) == pytest.approx(146.554, abs=1e-9)
    for joint, e in zip(atlas.joints, expected["joints"], strict=True):
        if "axis" in e:
            np.testing.assert_allclose(joint.axis(), e["axis"], atol=1e-9, err_msg=joint.name)


def test_atlas_limits(atlas: Any) -> None:
    expected = figures("atlas_v3_no_head")["dofs"]
    for dof, force, e in zip(atlas.dofs, atlas.tau_upper, expected, strict=True):
        assert dof.position_lower_limit() == pytest.approx(-np.inf if e["lower"] is None else e["lower"])
        assert dof.position_upper_limit() == pytest.approx(limit(e["upper"]))
        assert dof.velocity_upper_limit() == pytest.approx(limit(e["velocity"]))
        assert dof.damping_coefficient() == pytest.approx(e["damping"])
        assert force == pytest.approx(limit(e["force"])), dof.name


def test_atlas_stated_limits() -> None:
    """DART's SDF reader leaves out effort and velocity, so the file itself is compared."""
    joints = ET.parse(pydart2.data_path(ATLAS)).iter("joint")
    stated = {j.get("name"): {v.tag: float(v.text or "") for v in j.findall("axis/limit/*")} for j in joints}
    assert stated == figures("atlas_v3_no_head")["stated_limits"]


def test_atlas_dynamics(atlas: Any) -> None:
    check_poses(atlas, figures("atlas_v3_no_head"))


def test_atlas_shapes(atlas: Any) -> None:
    for body in atlas.bodynodes:
        kinds = [(n.has_visual_aspect(), n.has_collision_aspect()) for n in body.shapenodes]
        assert kinds.count((True, False)) == 1, body.name
        assert kinds.count((False, True)) == (3 if body.name == "utorso" else 1), body.name


def test_atlas_meshes_are_complete() -> None:
    """Each mesh the model names is there and uses only colours of its library."""
    model = Path(pydart2.data_path(ATLAS))
    for uri in ET.parse(model).iter("uri"):
        mesh = model.parent / str(uri.text)
        lines = [line.split() for line in mesh.read_text(encoding="ascii").splitlines()]
        library = mesh.parent / next(words[1] for words in lines if words[0] == "mtllib")
        stated = library.read_text(encoding="ascii").splitlines()
        colours = {line.split()[1] for line in stated if line.startswith("newmtl")}
        assert {words[1] for words in lines if words[0] == "usemtl"} <= colours
        points = sum(words[0] == "v" for words in lines)
        corners = [int(c.split("//")[0]) for words in lines if words[0] == "f" for c in words[1:]]
        assert set(corners) == set(range(1, points + 1)), mesh.name


def test_atlas_on_the_ground(tmp_path: Path) -> None:
    """Atlas lands on both feet and then falls; nothing becomes infinite."""
    ground = tmp_path / "ground.skel"
    ground.write_text(GROUND, encoding="ascii")
    world = pydart2.World(0.001, str(ground))
    skeleton = world.add_skeleton(pydart2.data_path(ATLAS))
    q = np.array(skeleton.q)
    q[5] = SOLE + 0.002
    skeleton.q = q
    most = 0
    for _ in range(500):
        world.step()
        most = max(most, len(world.collision_result.contacts))
    assert most > 5
    assert np.isfinite(skeleton.q).all()
    assert np.isfinite(skeleton.dq).all()


def test_cubes() -> None:
    expected = figures("cubes")
    world = pydart2.World(expected["time_step"], pydart2.data_path(CUBES))
    assert len(world.skeletons) == len(expected["skeletons"])
    for skeleton, e in zip(world.skeletons, expected["skeletons"], strict=True):
        check_skeleton(skeleton, e)
        np.testing.assert_allclose(np.asarray(skeleton.q).reshape(-1), e["q"], atol=1e-9)
        check_poses(skeleton, e)


def test_cubes_file() -> None:
    """The settings and shapes, as the file states them."""
    expected = figures("cubes")
    root = ET.parse(pydart2.data_path(CUBES)).getroot()

    def values(element: ET.Element, path: str) -> list[float]:
        return [float(v) for v in element.findtext(path, "").split()]

    assert values(root, "world/physics/time_step") == [expected["time_step"]]
    assert values(root, "world/physics/gravity") == expected["gravity"]
    assert root.findtext("world/physics/collision_detector") == expected["detector"]
    for skeleton, e in zip(root.iter("skeleton"), expected["skeletons"], strict=True):
        visual, solid = e["shapes"]
        assert (visual["type"], solid["type"], solid["collides"]) == ("BoxShape", "BoxShape", True)
        assert values(skeleton, "body/visualization_shape/geometry/box/size") == visual["size"]
        assert values(skeleton, "body/visualization_shape/color") == visual["rgba"][:3]
        assert values(skeleton, "body/collision_shape/geometry/box/size") == solid["size"]
