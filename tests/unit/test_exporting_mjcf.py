"""Skeletons and worlds as MJCF: MuJoCo, which compiles the texts, is the judge."""

from __future__ import annotations

import logging
from pathlib import Path

import mujoco
import numpy as np
import pytest

import pydart2 as pydart
from oracle.mujoco_judge import full_mass_matrix
from pydart2.cameras import MountedCamera
from pydart2.poses import pose
from unit.test_exporting import JOINTS, assert_moves_as, robot

MODELS = ("chain.skel", "fullbody1.skel", "atlas_v3_no_head.sdf", "pr2.urdf")


def load(file: str) -> pydart.Skeleton:
    folder = {"skel": "skel", "sdf": "sdf/atlas", "urdf": "urdf/PR2"}[file.rpartition(".")[2]]
    world, path = pydart.World(0.001), pydart.data_path(f"{folder}/{file}")
    return world.add_skeletons(path)[-1] if file.endswith(".skel") else world.add_skeleton(path)


class Judge:
    """A text as MuJoCo compiles it."""

    def __init__(self, text: str) -> None:
        self.model = mujoco.MjModel.from_xml_string(text)
        self.data = mujoco.MjData(self.model)

    def hinges(self) -> dict[str, int]:
        """Names and indices of the joints of one dof; in qpos and in M."""
        kinds = (mujoco.mjtJoint.mjJNT_HINGE, mujoco.mjtJoint.mjJNT_SLIDE)
        return {self.model.joint(i).name: i for i in range(self.model.njnt) if self.model.jnt_type[i] in kinds}

    def look(self) -> np.ndarray:
        """The mass matrix without armature at the present positions, which move all bodies."""
        mujoco.mj_forward(self.model, self.data)
        return full_mass_matrix(self.model, self.data)

    def place(self, body: str, com: bool) -> np.ndarray:
        return np.array(self.data.body(body).xipos if com else self.data.body(body).xpos)


def assert_is(judge: Judge, skel: pydart.Skeleton, coms: bool = False) -> None:
    """Mass, M and the places of all bodies as they are and, where all joints have one dof each, at random positions."""
    assert judge.model.body_mass.sum() == pytest.approx(skel.m, rel=1e-12)
    assert judge.model.nv == skel.ndofs
    hinges = judge.hinges()
    random = np.random.default_rng(3)
    for turn in range(4):
        if turn > 0 and len(hinges) < skel.ndofs:
            break
        if turn > 0:
            skel.q = random.uniform(-1.0, 1.0, skel.ndofs)
        for name, joint in hinges.items() if turn > 0 else ():
            judge.data.qpos[judge.model.jnt_qposadr[joint]] = skel.q[name]
        M = judge.look()
        if len(hinges) == skel.ndofs:
            order = [skel.names.index(name) for name, _ in sorted(hinges.items(), key=lambda item: item[1])]
            np.testing.assert_allclose(M, skel.M[np.ix_(order, order)], atol=1e-9)
        else:
            np.testing.assert_allclose(np.linalg.eigvalsh(M), np.linalg.eigvalsh(skel.M), atol=1e-9)
        for body in (body for body in skel.bodynodes if body.m > 0 or not coms):
            where = body.C if coms else body.T[:3, 3]
            np.testing.assert_allclose(judge.place(body.name, coms), where, atol=1e-9, err_msg=body.name)


@pytest.mark.parametrize("joint", JOINTS)
def test_a_joint_of_each_kind(joint: str) -> None:
    skel = robot(joint)
    if joint in ("screw", "free"):  # a free joint is for roots
        with pytest.raises(pydart.ExportError, match=r"kind 'screw'|free and not that of a root"):
            skel.to_mjcf()
        return
    assert_is(Judge(skel.to_mjcf()), skel, coms=joint == "ball")  # the frame of its link is moved to a ball joint


@pytest.mark.parametrize("file", MODELS)
def test_models(file: str, tmp_path: Path) -> None:
    skel = load(file)
    skel.save(tmp_path / "model.xml")
    model = mujoco.MjModel.from_xml_path(str(tmp_path / "model.xml"))
    judge = Judge.__new__(Judge)
    judge.model, judge.data = model, mujoco.MjData(model)
    assert_is(judge, skel)


@pytest.mark.parametrize("file", MODELS)
def test_models_come_back(file: str, tmp_path: Path) -> None:
    """Read by ourselves: M, c and poses at random states; joints of several dofs are several."""
    skel = load(file)
    skel.save(tmp_path / "model.xml")
    world = pydart.World(0.001)
    world.g = skel.world.g
    twin = world.add_skeleton(tmp_path / "model.xml")
    assert twin.m == pytest.approx(skel.m, rel=1e-12)
    assert_moves_as(twin, skel, from_origin=True, fixed=False)


@pytest.mark.parametrize("joint", sorted({*JOINTS} - {"screw", "free"}))
def test_a_joint_of_each_kind_comes_back(joint: str) -> None:
    skel = robot(joint)
    world = pydart.World(0.001)
    world.g = skel.world.g
    twin = world.add_skeleton(skel.to_mjcf())
    assert_moves_as(twin, skel, poses=joint != "ball", fixed=False)  # whose link has its frame at the joint then


@pytest.mark.parametrize("file", ["cubes", "shapes"])
def test_free_bodies_come_back(file: str) -> None:
    for skel in pydart.World(0.001, f"skel/{file}.skel").skeletons:
        if skel.ndofs and skel.name not in ("cone skeleton", "multi sphere skeleton"):
            world = pydart.World(0.001)
            world.g = skel.world.g
            assert_moves_as(world.add_skeleton(skel.to_mjcf()), skel, from_origin=True)


def test_numbers_of_joints() -> None:
    skel = pydart.World(0.001).add_empty_skeleton("arm")
    base = skel.add_body("base", joint="weld")
    link = skel.add_body("link", base, "revolute", axis=(0, 1, 0), limits=(-0.5, 1.0), damping=0.3)
    link.add_box((0.1, 0.1, 0.4), mass=2.0)
    dof = skel.dofs[0]
    dof.set_spring_stiffness(4.0)
    dof.set_rest_position(0.25)
    dof.set_coulomb_friction(0.2)
    dof.set_armature(0.05)
    dof.joint.set_position_limit_enforced()
    model = Judge(skel.to_mjcf()).model
    joint = model.joint(0)
    np.testing.assert_array_equal(joint.range, [-0.5, 1.0])
    assert (joint.limited[0], joint.damping[0], joint.frictionloss[0], joint.armature[0]) == (1, 0.3, 0.2, 0.05)
    assert (joint.stiffness[0], model.qpos_spring[0]) == (4.0, 0.25)


def test_worlds(tmp_path: Path) -> None:
    world = pydart.World(0.002, up="z")
    world.add_ground()
    for i in range(3):
        world.add_box((0.2, 0.2, 0.2), 1.0 + i, (0.5 * i, 0.0, 0.3))
    world.save(tmp_path / "scene.xml")
    model = mujoco.MjModel.from_xml_path(str(tmp_path / "scene.xml"))
    assert model.opt.timestep == 0.002
    np.testing.assert_array_equal(model.opt.gravity, world.g)
    assert model.nv == 18 and model.body_mass.sum() == pytest.approx(6.0)
    data = mujoco.MjData(model)
    mujoco.mj_step(model, data, 1000)
    np.testing.assert_allclose(data.qpos[2::7], 0.1, atol=2e-3)  # they have fallen on the ground


def test_what_cannot_be_held_is_refused() -> None:
    world = pydart.World(0.001, "skel/softBodies.skel")
    with pytest.raises(pydart.ExportError, match="is soft"):
        world.skeletons[1].to_mjcf()
    shapes = pydart.World(0.001, "skel/shapes.skel")
    with pytest.raises(pydart.ExportError, match="kind 'cone'"):
        shapes.skeleton("cone skeleton").to_mjcf()


def test_moments_of_what_has_no_mass_are_refused_too() -> None:
    """Two bodies that are welded together, neither of which has a mass."""
    body = (
        '<link name="{}"><inertial><mass value="0"/><inertia ixx="1" iyy="1" izz="5" ixy="0" ixz="0" iyz="0"/>'
        "</inertial></link>"
    )
    weld = '<joint name="weld" type="fixed"><parent link="a"/><child link="b"/></joint>'
    skel = pydart.World(0.001).add_skeleton(f'<robot name="r">{body.format("a")}{body.format("b")}{weld}</robot>')
    with pytest.raises(pydart.ExportError, match="principal moments of inertia 2, 2, 10"):
        skel.to_mjcf()


def test_what_is_lost_is_said_once(caplog: pytest.LogCaptureFixture) -> None:
    skel = robot("revolute")
    skel.dofs[0].set_position_lower_limit(-1.0)
    skel.dofs[0].set_position_upper_limit(1.0)
    with caplog.at_level(logging.WARNING, "pydart2"):
        skel.to_mjcf()
    [line] = [record.getMessage() for record in caplog.records if "not in MJCF" in record.getMessage()]
    assert "position limits that are not enforced" in line
    with pytest.raises(pydart.ExportError, match="position limits that are not enforced"):
        skel.to_mjcf(strict=True)


def test_names_that_others_have_are_said_once(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    world = pydart.World(0.001)
    for _ in range(4):
        world.add_skeletons(pydart.data_path("skel/chain.skel"))
    with caplog.at_level(logging.WARNING, "pydart2"):
        world.save(tmp_path / "chains.xml")
    assert caplog.text.count("names of bodies and joints that others have") == 1
    assert len(caplog.text) < 1000 and "more)" in caplog.text


def test_cameras_see_the_same(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    """In all modes, on bodies and on none, in states of motion; a format without cameras says which are left out."""
    world = pydart.World(0.001, up="z")
    skel = world.add_skeleton(pydart.data_path("sdf/atlas/atlas_v3_no_head.sdf"))
    hand, head = skel.body("l_hand"), skel.body("utorso")
    random = np.random.default_rng(1)
    where = [pose(random.normal(size=3), random.normal(size=4)) for _ in range(7)]
    for i, mode in enumerate(("fixed", "track", "trackcom", "targetbody", "targetbodycom")):
        target = head if mode.startswith("target") else None
        world.cameras[mode] = MountedCamera(hand, where[i], 0.5 + 0.1 * i, mode, target)
    world.cameras["standing"] = MountedCamera(None, where[5], 1.0)
    world.cameras["turning"] = MountedCamera(None, where[6], 1.0, "targetbody", hand)
    world.save(tmp_path / "world.xml")
    loaded = pydart.World(0.001, str(tmp_path / "world.xml"))
    assert set(loaded.cameras) == set(world.cameras)
    other = loaded.skeletons[-1]
    for _ in range(3):
        skel.q = random.uniform(-0.5, 0.5, skel.ndofs)
        other.q = [*skel.q[:6], *(skel.q[dof.name] for dof in other.dofs[6:])]
        for name, camera in world.cameras.items():
            assert np.allclose(loaded.cameras[name].eye(), camera.eye(), atol=1e-12), name
            assert loaded.cameras[name].fov == pytest.approx(camera.fov, rel=1e-15)
    assert "cameras (" not in caplog.text
    world.save(tmp_path / "world.sdf")
    assert "cameras ('standing', 'turning', 'fixed', 'track', 'trackcom' and 2 more)" in caplog.text
