"""Worlds and skeletons that are built in code."""

from __future__ import annotations

import copy
import gc
import pickle
import time
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import pydart2 as pydart
from pydart2.building import solids
from pydart2.poses import between, pose, rotation

QUARTER = (np.sqrt(0.5), 0.0, 0.0, np.sqrt(0.5))  # about z


def arm(world: pydart.World) -> pydart.Skeleton:
    """A chain of every joint type, with limits, springs, shapes and a marker."""
    skel = world.add_empty_skeleton("arm")
    body = None
    for i, joint in enumerate(
        [
            "revolute",
            "prismatic",
            "screw",
            "ball",
            "euler",
            "universal",
            "planar",
            "translational",
            "translational2d",
            "weld",
            "free",
        ]
    ):
        body = skel.add_body(f"b{i}", body, joint, position=(0.1, 0.2, 0.3), orientation=(1.0, 0.1 * i, 0.2, 0.0))
        body.add_box((0.1, 0.2, 0.3), position=(0.0, 0.05, 0.0), orientation=QUARTER, density=500.0)
        body.add_capsule(0.05, 0.2, mass=0.3, color=(1, 0, 0), friction=0.4, restitution=0.1, collides=True)
    skel.body("b3").add_marker("tip", (0.1, 0.0, 0.0))
    skel.body("b0").add_marker("foot", (0.0, 0.0, -0.1))
    return skel


def test_boxes_on_the_ground_come_to_rest() -> None:
    world = pydart.World(0.001)
    world.add_ground()
    boxes = [world.add_box((0.2, 0.2, 0.2), mass=1.0, position=(0.5 * i, 0.12, 0.0)) for i in range(3)]
    world.step(2000)
    for box in boxes:
        assert 0.1 - 1e-3 < box.C[1] <= 0.1 + 1e-3
        assert np.abs(box.dq).max() < 1e-3


@pytest.mark.parametrize("up", [(0.0, 0.0, 1.0), (0.0, 1.0, 0.0), (1.0, 0.0, 0.0), (0.0, 0.6, 0.8), (0.0, -1.0, 0.0)])
def test_the_ground_lies_across_gravity(up: tuple[float, float, float]) -> None:
    world = pydart.World(0.001)
    world.g = -9.81 * np.array(up)
    world.add_ground(height=0.3)
    box = world.add_box((0.2, 0.2, 0.2), position=0.45 * np.array(up), orientation=between(up))
    world.step(500)
    assert box.C @ up == pytest.approx(0.4, abs=1e-3)


def test_a_box_is_where_it_was_put_and_goes_back_there() -> None:
    world = pydart.World(0.001)
    box = world.add_box((0.1, 0.2, 0.3), mass=2.0, position=(1, 2, 3), orientation=QUARTER, color=(1, 0, 0, 0.5))
    assert pytest.approx(pose((1, 2, 3), QUARTER), abs=1e-12) == box.body(0).T
    inertia = 2.0 / 12 * np.diag([0.13, 0.10, 0.05])
    assert pytest.approx(inertia) == box.body(0).I
    assert box.body(0).shapenodes[0].visual_aspect_rgba() == pytest.approx([1, 0, 0, 0.5])
    world.step(10)
    world.reset()
    assert pytest.approx(pose((1, 2, 3), QUARTER), abs=1e-12) == box.body(0).T


def test_what_is_fixed_stays() -> None:
    world = pydart.World(0.001)
    box = world.add_box((1, 1, 1), position=(0, 5, 0), fixed=True)
    world.step(10)
    assert box.ndofs == 0
    assert pytest.approx([0, 5, 0]) == box.C


def test_names_are_made_distinct() -> None:
    world = pydart.World(0.001)
    names = [world.add_box((1, 1, 1)).name for _ in range(3)] + [world.add_box((1, 1, 1), name="crate").name]
    assert names == ["box", "box (1)", "box (2)", "crate"]


def test_three_thousand_boxes_take_ten_times_as_long_as_three_hundred() -> None:
    def seconds(count: int) -> float:
        world = pydart.World(0.001)
        start = time.process_time()
        for i in range(count):
            world.add_box((0.1, 0.1, 0.1), 1.0, (i, 0, 0))
        return time.process_time() - start

    gc.disable()
    try:
        few = min(seconds(300) for _ in range(3))
        assert seconds(3000) < 30 * few  # a hundred times if each looks at all the others
    finally:
        gc.enable()


@pytest.mark.parametrize("copied", [pydart.World.clone, copy.deepcopy, lambda w: pickle.loads(pickle.dumps(w))])
def test_copies_are_equal_bit_for_bit(copied) -> None:
    world = pydart.World(0.001)
    world.add_ground()
    skel = arm(world)
    world.add_sphere(0.1, position=(2, 1, 0))
    world.add_mesh(*tetrahedron(), position=(0, 3, 0))
    for dof in skel.dofs:
        dof.set_damping_coefficient(0.5)
    world.step(5)
    other = copied(world)
    assert [s.name for s in other.skeletons] == [s.name for s in world.skeletons]
    assert [m.label for m in other.skeletons[1].markers] == ["tip", "foot"]
    assert other.snapshot() == world.snapshot()
    world.snapshot()
    world.step(20)
    other.step(20)
    assert np.array_equal(other.x, world.x)
    assert np.array_equal(other.skeletons[1].M, world.skeletons[1].M)


def test_batches_and_snapshots_and_recordings_have_them() -> None:
    world = pydart.World(0.001)
    world.add_ground()
    world.add_box((0.1, 0.1, 0.1), position=(0, 1, 0))
    before = world.snapshot()
    batch = pydart.Batch(world, 2)
    batch.step(20)
    world.step(20)
    assert np.array_equal(batch.x[1], world.x)
    assert world.set_frame(1)
    assert world.skeletons[1].q[4] == 1.0 - 9.81e-6
    world.restore(before)
    assert world.t == 0.0


def test_what_was_before_a_new_body_is_refused() -> None:
    world = pydart.World(0.001)
    skel = world.add_empty_skeleton("two")
    skel.add_body("first", mass=1.0, inertia=np.eye(3))
    world.step()
    before, q = world.snapshot(), skel.q
    skel.add_body("second", "first", "revolute", mass=1.0, inertia=np.eye(3))
    with pytest.raises(ValueError, match="model"):
        world.restore(before)
    with pytest.raises(ValueError, match="7"):
        skel.q = q
    assert not world.set_frame(0)
    world.step()
    assert world.clone().x.shape == (14,)


def test_a_world_file_keeps_its_order_when_a_skeleton_of_it_is_changed() -> None:
    world = pydart.World(0.001, "./data/skel/cubes.skel")
    world.skeletons[1].add_body("tail", 0, "ball", position=(0, 0.2, 0)).add_sphere(0.05)
    other = world.clone()
    assert [s.name for s in other.skeletons] == [s.name for s in world.skeletons]
    world.step(50)
    other.step(50)
    assert np.array_equal(other.x, world.x)


URDF = """<robot name="two">
  <link name="base"><inertial><mass value="1"/>
    <inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="upper"><inertial><origin xyz="0 0 0.2"/><mass value="2"/>
    <inertia ixx="0.02" iyy="0.03" izz="0.01" ixy="0.001" ixz="0" iyz="0.002"/></inertial></link>
  <link name="lower"><inertial><origin xyz="0.1 0 0"/><mass value="0.5"/>
    <inertia ixx="0.01" iyy="0.01" izz="0.015" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="shoulder" type="revolute"><parent link="base"/><child link="upper"/><origin xyz="0 0 0.5"/>
    <axis xyz="0 1 0"/><limit lower="-1" upper="2" effort="5" velocity="3"/>
    <dynamics damping="0.3" friction="0.1"/></joint>
  <joint name="slide" type="prismatic"><parent link="upper"/><child link="lower"/><origin xyz="0 0.1 0.4"/>
    <axis xyz="1 0 0"/><limit lower="-0.1" upper="0.1" effort="5" velocity="3"/></joint>
</robot>"""


def test_a_built_robot_equals_that_of_a_file() -> None:
    world = pydart.World(0.001)
    loaded = world.add_skeleton(URDF)
    built = world.add_empty_skeleton("built")
    built.add_body("base", mass=1.0, inertia=np.eye(3))
    upper = [[0.02, 0.001, 0], [0.001, 0.03, 0.002], [0, 0.002, 0.01]]
    built.add_body(
        "upper", "base", "revolute", joint_name="shoulder", position=(0, 0, 0.5), axis=(0, 1, 0), limits=(-1, 2),
        damping=0.3, friction=0.1, mass=2.0, com=(0, 0, 0.2), inertia=upper,
    )  # fmt: skip
    built.add_body(
        "lower", "upper", "prismatic", joint_name="slide", position=(0, 0.1, 0.4), axis=(1, 0, 0), limits=(-0.1, 0.1),
        mass=0.5, com=(0.1, 0, 0), inertia=np.diag([0.01, 0.01, 0.015]),
    )  # fmt: skip
    rng = np.random.default_rng(1)
    for _ in range(5):
        built.q = loaded.q = rng.normal(size=8)
        built.dq = loaded.dq = rng.normal(size=8)
        assert np.array_equal(built.M, loaded.M)
        assert np.array_equal(built.c, loaded.c)
    assert np.array_equal(built.q_lower, loaded.q_lower)
    assert built.dof("shoulder").damping_coefficient() == loaded.dof("shoulder").damping_coefficient() == 0.3
    assert built.dof("shoulder").coulomb_friction() == 0.1
    assert built.joint("shoulder").is_position_limit_enforced()


def tetrahedron() -> tuple[list[list[float]], list[list[int]]]:
    return [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]


def sampled(solid: solids.Solid, inside, corner: tuple[float, float, float]) -> tuple[float, np.ndarray, np.ndarray]:
    """Volume, centre and inertia of 1 kg by a grid of a box around it."""
    axes = [(np.arange(120) + 0.5) / 60 - 1 for _ in range(3)]
    points = np.stack(np.meshgrid(*axes), -1).reshape(-1, 3) * corner
    points = points[inside(*points.T)]
    com = points.mean(axis=0)
    spread = (points - com).T @ (points - com) / len(points)
    return len(points) / 120**3 * 8 * np.prod(corner), com, np.trace(spread) * np.eye(3) - spread


SOLIDS = {
    "box": (solids.box((0.2, 0.4, 0.6)), lambda x, y, z: np.abs(x) < 9, (0.1, 0.2, 0.3)),
    "ellipsoid": (
        solids.ellipsoid((0.2, 0.4, 0.6)),
        lambda x, y, z: (x / 0.1) ** 2 + (y / 0.2) ** 2 + (z / 0.3) ** 2 < 1,
        (0.1, 0.2, 0.3),
    ),
    "sphere": (solids.sphere(0.3), lambda x, y, z: x * x + y * y + z * z < 0.09, (0.3, 0.3, 0.3)),
    "cylinder": (solids.cylinder(0.2, 0.8), lambda x, y, z: x * x + y * y < 0.04, (0.2, 0.2, 0.4)),
    "capsule": (
        solids.capsule(0.2, 0.6),
        lambda x, y, z: x * x + y * y + np.maximum(np.abs(z) - 0.3, 0) ** 2 < 0.04,
        (0.2, 0.2, 0.5),
    ),
    "cone": (solids.cone(0.3, 0.8), lambda x, y, z: np.hypot(x, y) < 0.3 * (0.5 - z / 0.8), (0.3, 0.3, 0.4)),
}


@pytest.mark.parametrize("name", SOLIDS)
def test_volumes_and_inertias(name: str) -> None:
    solid, inside, corner = SOLIDS[name]
    volume, com, inertia = sampled(solid, inside, corner)
    assert solid.volume == pytest.approx(volume, rel=5e-3)
    assert solid.com == pytest.approx(com, abs=1e-3)
    assert solid.inertia == pytest.approx(inertia, abs=5e-3 * np.trace(inertia))


def test_the_mass_of_a_mesh() -> None:
    corners = np.array(np.meshgrid([1, 1.2], [2, 2.4], [3, 3.6], indexing="ij")).reshape(3, 8).T
    faces = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    triangles = [t for a, b, c, d in faces for t in ((a, b, c), (a, c, d))]
    mesh, box = solids.mesh(corners, triangles), solids.box((0.2, 0.4, 0.6))
    assert mesh.volume == pytest.approx(box.volume)
    assert mesh.com == pytest.approx([1.1, 2.2, 3.3])
    assert mesh.inertia == pytest.approx(box.inertia)


def test_two_shapes_weigh_as_one() -> None:
    world = pydart.World(0.001)
    halves, whole = world.add_empty_skeleton("halves"), world.add_empty_skeleton("whole")
    body = halves.add_body("body")
    body.add_box((0.2, 0.4, 0.3), position=(0, 0, 0.15))
    body.add_box((0.2, 0.4, 0.3), position=(0, 0, -0.15))
    whole.add_body("body").add_box((0.2, 0.4, 0.6))
    assert pytest.approx(whole.body(0).I) == body.I
    assert body.m == pytest.approx(whole.m)


@pytest.mark.parametrize("detector", ["fcl", "bullet", "ode", "dart", "native"])
def test_a_field_of_heights_carries_balls(detector: str) -> None:
    """High where y is great, low elsewhere, however often a detector meets it."""
    world = pydart.World(0.001, up="z")
    world.set_collision_detector(detector)
    ground = world.add_empty_skeleton("terrain").add_body("ground", joint="weld")
    ground.add_heightfield(np.repeat([[0.25], [0.25], [0.25], [0.05], [0.05], [0.05]], 5, axis=1), (0.5, 0.5, 2.0))
    high, low = (world.add_sphere(0.1, position=(0.1, y, height)) for y, height in ((0.8, 0.65), (-0.8, 0.25)))
    for _ in range(3):
        world.restore(world.snapshot())
        world.clone().step()
        world.step(100)
    assert high.C[2] == pytest.approx(0.6, abs=0.01) and low.C[2] == pytest.approx(0.2, abs=0.01)
    down = world.raycast([[0.1, 0.4, 3.0], [0.1, -0.4, 3.0]], [[0, 0, -1]] * 2, ignore=[high, low])
    assert down.distances == pytest.approx([2.5, 2.9])


def test_orientations() -> None:
    assert rotation(QUARTER) == pytest.approx(np.array([[0, -1, 0], [1, 0, 0], [0, 0, 1]]), abs=1e-15)
    assert rotation([2, 0, 0, 0]) == pytest.approx(np.eye(3))
    for wrong in ([0, 0, 0, 0], [1, 2, 3], np.eye(4)):
        with pytest.raises(ValueError, match="quaternion"):
            rotation(wrong)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda w: w.add_box((1, 1)), "three numbers"),
        (lambda w: w.add_box((1, -1, 1)), "positive"),
        (lambda w: w.add_box((1, 1, 1), mass=-1), "positive"),
        (lambda w: w.add_box((1, 1, 1), mass=0), "needs a mass"),
        (lambda w: w.add_box((1, 1, 1), mass=float("nan")), "positive"),
        (lambda w: w.add_sphere(float("nan")), "finite|positive"),
        (lambda w: w.add_box((1, 1, 1), orientation=np.ones((3, 3))), "rotation|orthonormal|rigid"),
        (lambda w: w.add_ground(size=(1,)), "two edges"),
        (lambda w: w.add_empty_skeleton(""), "name"),
        (lambda w: w.add_mesh([[0, 0, 0]] * 3, [[0, 1, 2]]), "mass"),
        (lambda w: w.add_empty_skeleton().add_body("a", joint="hinge"), "no joint 'hinge'"),
        (lambda w: w.add_empty_skeleton().add_body("a", joint="revolute", axis=(0, 0, 0)), "axis"),
        (lambda w: w.add_empty_skeleton().add_body("a", joint="universal", axis=(0, 0, 1)), "2 axes"),
        (lambda w: w.add_empty_skeleton().add_body("a", joint="revolute", limits=(1, -1)), "lower limit"),
    ],
)
def test_what_cannot_be_is_refused(call, message: str) -> None:
    world = pydart.World(0.001)
    with pytest.raises(ValueError, match=message):
        call(world)
    world.step()
    world.clone()


@pytest.mark.parametrize(
    ("what", "message"),
    [
        ({"mass": 1.0}, "needs its inertia"),
        ({"mass": 1.0, "inertia": -np.eye(3)}, "inertia"),
        ({"damping": (1, 2)}, "damping is one number, or one for each of 1 dofs"),
        ({"position": (0, 0, float("inf"))}, "finite"),
        ({"limits": (0, float("nan"))}, "NaN"),
    ],
)
def test_no_body_is_half_made(what: dict[str, Any], message: str) -> None:
    skel = arm(pydart.World(0.001))
    before = [body.name for body in skel.bodynodes]
    with pytest.raises(ValueError, match=message):
        skel.add_body("new", "b0", "revolute", **what)
    assert [body.name for body in skel.bodynodes] == before
    skel.add_body("new", "b0", "revolute", mass=1.0, inertia=np.eye(3))


def test_a_name_that_is_taken_is_refused() -> None:
    skel = pydart.World(0.001).add_empty_skeleton()
    skel.add_body("a", mass=1.0, inertia=np.eye(3))
    with pytest.raises(ValueError, match="'a' already"):
        skel.add_body("a")
    with pytest.raises(pydart.errors.NameNotFound):
        skel.add_body("b", "c")


# Changing what there is


def test_parts_that_stay_are_the_same_objects() -> None:
    world = pydart.World(0.001)
    skel = arm(world)
    kept = {name: (skel.body(name), skel.body(name).parent_joint) for name in ("b0", "b9", "b10")}
    dof, gone = skel.joint("b0_joint").dofs[0], skel.body("b5")
    side = skel.add_body("side", "b0", "revolute", mass=1.0, inertia=np.eye(3))
    skel.remove_body("b4")
    assert [body.name for body in skel.bodynodes] == ["b0", "b1", "b2", "b3", "side"]
    assert skel.body("b0") is kept["b0"][0]
    assert skel.body("b0").parent_joint is kept["b0"][1]
    assert skel.dofs[0] is dof
    assert side.id == 4
    assert side.parent_bodynode is skel.body("b0")
    assert dof.position() == 0.0
    for part in (gone, kept["b9"][0], kept["b9"][1]):
        with pytest.raises(pydart.errors.DestroyedError):
            part._handle.name()
    world.step()
    assert world.clone().skeletons[0].ndofs == skel.ndofs == 7


def test_what_is_left_equals_what_was_built_so() -> None:
    """M and c, bit for bit, after bodies have come and gone."""
    world = pydart.World(0.001)
    changed, plain = world.add_empty_skeleton("changed"), world.add_empty_skeleton("plain")

    def add(skel: pydart.Skeleton, name: str, parent: str | None) -> None:
        inertia = np.diag([0.1, 0.2, 0.25])
        skel.add_body(name, parent, "ball" if parent else "free", position=(0.1, 0.2, 0.3), mass=1.5, inertia=inertia)

    for name, parent in (("a", None), ("b", "a"), ("x", "a"), ("y", "x"), ("c", "b")):
        add(changed, name, parent)
    changed.remove_body("x")
    for name, parent in (("a", None), ("b", "a"), ("c", "b")):
        add(plain, name, parent)
    rng = np.random.default_rng(3)
    changed.q = plain.q = rng.normal(size=12)
    changed.dq = plain.dq = rng.normal(size=12)
    assert np.array_equal(changed.M, plain.M)
    assert np.array_equal(changed.c, plain.c)


def test_a_body_that_others_need_stays() -> None:
    world = pydart.World(0.001)
    skel = world.add_empty_skeleton()
    for name in ("a", "b"):
        skel.add_body(name, joint="revolute", mass=1.0, inertia=np.eye(3))
    skel.joint("b_joint").set_mimic(skel.joint("a_joint"))
    with pytest.raises(ValueError, match="follows"):
        skel.remove_body("a")
    skel.remove_body("b")
    skel.remove_body("a")
    assert skel.ndofs == 0
    world.step()


@pytest.mark.parametrize(
    ("joint", "change"),
    [
        ("weld", "set_root_joint_to_free"),
        ("free", "set_root_joint_to_weld"),
        ("free", "set_root_joint_to_trans_and_euler"),
    ],
)
def test_a_root_joint_that_others_follow_stays(joint: str, change: str) -> None:
    """They would follow what is gone."""
    world = pydart.World(0.001)
    skel = world.add_empty_skeleton()
    for name in ("a", "b"):
        skel.add_body(name, joint=joint, mass=1.0, inertia=np.eye(3))
    skel.joint("b_joint").set_mimic(skel.joint("a_joint"))
    with pytest.raises(ValueError, match=rf"'b_joint' follows joint 'a_joint', in whose place {change}\(\) would put"):
        getattr(skel, change)()
    assert skel.joint("b_joint").mimic() == (skel.joint("a_joint"), 1.0, 0.0)
    world.clone().step()


@pytest.mark.parametrize("detector", ["dart", "fcl", "bullet", "ode", "native"])
def test_shapes_and_bodies_that_are_gone_do_not_collide(detector: str) -> None:
    world = pydart.World(0.001)
    world.set_collision_detector(detector)
    world.add_ground()
    skel = world.add_empty_skeleton()
    body = skel.add_body("a", position=(0, 0.45, 0))
    body.add_sphere(0.3)
    low = body.add_box((1, 1, 1))
    skel.add_body("b", "a", position=(0.9, 0, 0)).add_box((1, 1, 1))
    world.collision_filter.add_to_black_list(skel.body("b"), world.skeletons[0].body(0))
    world.step(3)
    assert len(world.collision_result.contacts) > 0
    skel.remove_body("b")
    world.step(3)
    assert len(world.collision_result.contacts) > 0
    body.remove_shape(low)
    world.step(3)
    assert len(world.collision_result.contacts) == 0
    world.clone().step()


@pytest.mark.parametrize("copied", [copy.copy, copy.deepcopy, lambda part: pickle.loads(pickle.dumps(part))])
def test_parts_that_are_gone_are_not_copied(copied: Callable[[Any], Any]) -> None:
    """Nor is what has their place now."""
    skel = pydart.World(0.001).add_empty_skeleton()
    body = skel.add_body("a")
    box, ball = body.add_box((1, 1, 1)), body.add_sphere(0.2)
    body.remove_shape(box)
    arm, other = skel.add_body("b", "a"), skel.add_body("c", "a")
    skel.remove_body("b")
    assert body.shapenodes[box.id] is ball
    assert skel.bodynodes[arm.id] is other
    for part in (box, arm):
        with pytest.raises(pydart.DestroyedError):
            copied(part)
    assert copied(ball).shape.radius() == 0.2
    assert copied(other).name == "c"


def test_short_forms_of_a_fork() -> None:
    world = pydart.World(0.001)
    world.add_empty_skeleton("man")
    world.add_capsule(parent=-1, radius=0.1, length=0.4, joint_loc=[0, 1, 0], joint_type="FREE", joint_name="root")
    world.add_capsule(
        parent=0, radius=0.05, length=0.3, cap_rot=[np.pi / 2, 0, 0], cap_offset=[0, 0, 0.2], joint_loc=[0, 0, 0.2],
        joint_type="REVOLUTE_Y", joint_name="neck",
    )  # fmt: skip
    world.add_weld_box(1.0, 2.0, 0.1, joint_loc=[0, -1, 0])
    man = world.add_built_skeleton(_skel_id=0, _skel_name="man")
    assert [joint.name for joint in man.joints] == ["root", "neck", "body2"]
    assert man.ndofs == 7
    assert man.joint("neck").axis() == pytest.approx([0, 1, 0])
    assert pytest.approx([0, 1, 0.4]) == man.body(1).C
    assert man.body(2).shapenodes[0].shape.size() == pytest.approx([1, 2, 0.1])
    assert isinstance(world.add_capsule(0.1, 0.2, position=(3, 0, 0)), pydart.Skeleton)
    with pytest.raises(ValueError, match="REVOLUTE_Q"):
        world.add_capsule(parent=0, radius=1, length=1, joint_type="REVOLUTE_Q")
    with pytest.raises(ValueError, match="add_empty_skeleton"):
        pydart.World(0.001).add_built_skeleton()


@pytest.mark.parametrize(("radius", "length"), [(0.0, 0.0), (3.0, -4.0)])
def test_a_capsule_without_volume_is_refused(radius: float, length: float) -> None:
    with pytest.raises(ValueError, match=r"sizes must be|needs a mass"):
        pydart.World(0.001).add_capsule(radius, length)


@pytest.mark.parametrize("scale", [(1.0, 0.0, 1.0), (1.0, -1.0, 1.0), (1.0, 1.0, 1e-46)])
def test_heights_need_scales(scale: tuple[float, float, float]) -> None:
    """The last is 0 in the precision in which the engine keeps it, which ended the process."""
    with pytest.raises(ValueError, match="must be positive in single precision"):
        pydart.World(0.001).add_heightfield(np.zeros((3, 3)), scale)
