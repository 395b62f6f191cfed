"""Branches of skeletons that are attached, detached, welded and copied."""

from __future__ import annotations

import copy
import pickle

import numpy as np
import pytest

import pydart2 as pydart
from pydart2.cameras import MountedCamera

INERTIA = np.diag([0.1, 0.2, 0.25])


def add(skel: pydart.Skeleton, name: str, parent: str | None, joint: str = "ball", **options) -> pydart.BodyNode:
    where = {"position": (0.1, 0.2, 0.3), "orientation": (1.0, 0.2, 0.1, 0.0), "mass": 1.5, "inertia": INERTIA}
    body = skel.add_body(name, parent, joint, **{**where, **options})
    body.add_box((0.1, 0.1, 0.2), mass=0.3, position=(0.0, 0.1, 0.0), friction=0.4)
    return body


def tree(world: pydart.World, name: str = "tree") -> pydart.Skeleton:
    """A root with two branches, one of three bodies."""
    skel = world.add_empty_skeleton(name)
    add(skel, "root", None, "free")
    add(skel, "upper", "root", "revolute", armature=0.3)
    add(skel, "hand", "upper", "universal", damping=0.2, armature=0.7)
    add(skel, "finger", "hand", "prismatic", limits=(-1.0, 1.0))
    add(skel, "other", "root", "ball")
    skel.body("finger").add_marker("tip", (0.1, 0.0, 0.0))
    return skel


def stir(*skeletons: pydart.Skeleton) -> None:
    rng = np.random.default_rng(5)
    q, dq = rng.normal(size=(2, skeletons[0].ndofs)) * 0.5
    for skel in skeletons:
        skel.q, skel.dq = q, dq


def assert_equal(skel: pydart.Skeleton, other: pydart.Skeleton) -> None:
    """Bit for bit at a random state."""
    stir(skel, other)
    assert [body.name for body in skel.bodynodes] == [body.name for body in other.bodynodes]
    assert [dof.name for dof in skel.dofs] == [dof.name for dof in other.dofs]
    for now, then in zip(skel.bodynodes, other.bodynodes):
        assert np.array_equal(now.T, then.T)
    assert np.array_equal(skel.M, other.M)
    assert np.array_equal(skel.c, other.c)
    assert [m.label for m in skel.markers] == [m.label for m in other.markers]


def momentum(*bodies: pydart.BodyNode) -> np.ndarray:
    """Linear, and angular about the origin, world frame, shape (6,)."""
    total = np.zeros(6)
    for body in bodies:
        p = body.m * body.com_linear_velocity()
        turn = body.T[:3, :3]
        total[:3] += p
        total[3:] += np.cross(body.C, p) + turn @ body.I @ turn.T @ body.world_angular_velocity()
    return total


def pairs(world: pydart.World) -> list[tuple[pydart.BodyNode, pydart.BodyNode]]:
    """Those that pass through each other, in both orders."""
    excluded = world.excluded_collisions
    return excluded + [(b, a) for a, b in excluded]


def assert_copies_are_equal(world: pydart.World) -> None:
    for other in (world.clone(), copy.deepcopy(world), pickle.loads(pickle.dumps(world))):
        assert other.snapshot() == world.snapshot()
        for skel, its in zip(world.skeletons, other.skeletons):
            assert np.array_equal(skel.M, its.M)
        before = world.snapshot()
        world.step(5)
        other.step(5)
        assert np.array_equal(other.x, world.x)
        world.restore(before)


def test_an_attached_branch_equals_one_that_was_built_there() -> None:
    world = pydart.World(0.001)
    skel, plain = tree(world), world.add_empty_skeleton("plain")
    options = {"position": (0.0, 0.3, 0.0), "orientation": (1.0, 0.0, 0.3, 0.0), "damping": 0.1, "limits": (-2, 2)}
    skel.attach("hand", "other", "revolute", axis=(1, 1, 0), joint_position=(0, 0.1, 0), armature=0.2, **options)
    add(plain, "root", None, "free")
    add(plain, "upper", "root", "revolute", armature=0.3)
    add(plain, "other", "root", "ball")
    add(plain, "hand", "other", "revolute", axis=(1, 1, 0), joint_position=(0, 0.1, 0), armature=0.2, **options)
    add(plain, "finger", "hand", "prismatic", limits=(-1.0, 1.0))
    plain.body("finger").add_marker("tip", (0.1, 0.0, 0.0))
    assert_equal(skel, plain)
    assert [d.armature() for d in skel.dofs] == [d.armature() for d in plain.dofs]
    assert np.array_equal(skel.q_lower, plain.q_lower)
    assert_copies_are_equal(world)


def test_a_branch_of_another_skeleton_belongs_to_its_new_one() -> None:
    world = pydart.World(0.001)
    skel, arm = tree(world), world.add_empty_skeleton("arm")
    add(arm, "finger", None, "revolute")
    hand, finger, dof = skel.body("hand"), skel.body("finger"), skel.joint("finger_joint").dofs[0]
    replaced, camera = skel.joint("hand_joint"), MountedCamera(finger, np.eye(4))
    world.cameras["eye"] = camera
    world.collision_filter.add_to_black_list(finger, skel.body("other"))
    world.step()
    before, q = world.snapshot(), arm.q
    assert arm.attach(hand, "finger", "revolute") is hand
    assert [body.name for body in skel.bodynodes] == ["root", "upper", "other"]
    assert [body.name for body in arm.bodynodes] == ["finger", "hand", "finger(1)"]
    assert hand.skeleton is finger.skeleton is dof.skeleton is arm
    assert arm.bodynodes[1:] == [hand, finger] and arm.dofs[2] is dof and finger.parent_joint.dofs == [dof]
    assert dof.has_position_limit() and finger.markers[0].label == arm.markers[0].label == "tip"
    assert world.clone().cameras["eye"].body.name == "finger(1)"
    assert (skel.body("other"), finger) in pairs(world)
    assert camera.body is finger
    with pytest.raises(pydart.errors.DestroyedError):
        replaced.position_in_world_frame()
    with pytest.raises(ValueError, match="model"):
        world.restore(before)
    with pytest.raises(ValueError, match="3"):
        arm.q = q
    assert not world.set_frame(0)
    assert_copies_are_equal(world)


def test_one_of_several_that_gets_another_joint_is_the_last() -> None:
    world = pydart.World(0.001)
    skel, plain = world.add_empty_skeleton("skel"), world.add_empty_skeleton("plain")
    for name, parent in (("root", None), ("a", "root"), ("b", "root"), ("c", "root"), ("d", "root")):
        add(skel, name, parent)
    skel.attach("b", "root", "euler", position=(0.0, 0.3, 0.0))
    for name, parent in (("root", None), ("a", "root"), ("c", "root"), ("d", "root")):
        add(plain, name, parent)
    add(plain, "b", "root", "euler", position=(0.0, 0.3, 0.0), orientation=None)
    assert [body.name for body in skel.body("root").child_bodynodes] == ["a", "c", "d", "b"]
    assert_equal(skel, plain)
    assert_copies_are_equal(world)


def test_what_is_attached_without_a_place_stays_where_it_is() -> None:
    world = pydart.World(0.001)
    skel, target = tree(world), tree(world, "target")
    stir(skel, target)
    poses = [skel.body(name).T for name in ("hand", "finger")]
    hand, finger = skel.body("hand"), skel.body("finger")
    target.attach(hand, "other")
    assert (hand.parent_joint.type(), hand.parent_joint.name) == ("WeldJoint", "hand_joint(1)")
    assert np.allclose([hand.T, finger.T], poses, rtol=0, atol=1e-14)
    hand.skeleton.attach(hand, "upper", "ball")
    assert np.allclose([hand.T, finger.T], poses, rtol=0, atol=1e-14)


@pytest.mark.parametrize("name", ["root", "upper", "finger"])
def test_what_is_detached_keeps_pose_velocity_and_momentum(name: str) -> None:
    world = pydart.World(0.001)
    skel = tree(world)
    skel.set_self_collision_check(True)
    stir(skel)
    bodies = skel.bodynodes
    poses, moved = [body.T for body in bodies], momentum(*bodies)
    velocities = [body.world_spatial_velocity() for body in bodies]
    armature = sum(d.armature() for body in bodies for d in body.parent_joint.dofs)
    lost = sum(d.armature() for d in skel.body(name).parent_joint.dofs)
    own = skel.detach(name)
    assert own.name == name and own.body(0).name == name and own.self_collision_check()
    assert np.allclose([body.T for body in bodies], poses, rtol=0, atol=1e-13)
    assert np.allclose([body.world_spatial_velocity() for body in bodies], velocities, rtol=0, atol=1e-13)
    assert np.allclose(momentum(*bodies), moved, rtol=0, atol=1e-12)
    assert sum(d.armature() for s in world.skeletons for d in s.dofs) == pytest.approx(armature - lost)
    assert {body.skeleton for body in bodies} == {skel, own} - ({skel} if name == "root" else set())
    assert_copies_are_equal(world)
    where = own.body(0).T
    world.step(3)
    world.reset()
    assert np.allclose(own.body(0).T, where, rtol=0, atol=1e-13)


def test_a_copy_equals_what_it_is_of() -> None:
    world = pydart.World(0.001)
    skel = tree(world)
    stir(skel)
    world.set_collision_group(skel.body("finger"), 2, 4)
    world.collision_filter.add_to_black_list(skel.body("finger"), skel.body("other"))
    twin = world.add_empty_skeleton("twin")
    root = twin.copy_branch(skel.body("root"))
    assert root.name == "root"
    assert np.array_equal(twin.q, skel.q) and np.array_equal(twin.dq, skel.dq)
    assert [d.armature() for d in twin.dofs] == [d.armature() for d in skel.dofs]
    assert world.collision_group(twin.body("finger")) == (2, 4)
    assert (twin.body("finger"), twin.body("other")) in pairs(world)
    assert_equal(skel, twin)
    twin.body("hand").shapenodes[0].shape.set_size((1, 1, 1))
    assert skel.body("hand").shapenodes[0].shape.size() == pytest.approx((0.1, 0.1, 0.2))
    assert_copies_are_equal(world)


def test_a_copy_within_a_skeleton_has_names_of_its_own() -> None:
    world = pydart.World(0.001)
    skel = tree(world)
    second = skel.copy_branch("hand", "other")
    names = ["root", "upper", "hand", "finger", "other", "hand(1)", "finger(1)"]
    assert [body.name for body in skel.bodynodes] == names
    assert second.parent_bodynode is skel.body("other")
    assert second.parent_joint.type() == "UniversalJoint" and second.m == skel.body("hand").m
    assert len({joint.name for joint in skel.joints}) == 7
    skel.attach(second, "root", position=(0, 1, 0))
    assert_copies_are_equal(world)


@pytest.mark.parametrize("detector", ["dart", "fcl", "bullet", "ode", "native"])
def test_what_moved_collides_where_it_is(detector: str) -> None:
    world = pydart.World(0.001)
    world.set_collision_detector(detector)
    world.add_ground()
    arm = world.add_empty_skeleton("arm")
    arm.add_body("base", joint="weld", position=(0, 5, 0)).add_box((0.2, 0.2, 0.2))
    ball = world.add_sphere(0.1, position=(0, 0.099, 0))
    world.step(3)
    assert len(world.collision_result.contacts) > 0
    arm.attach(ball.body(0), "base", position=(0, 1, 0))
    world.step(3)
    assert len(world.collision_result.contacts) == 0
    arm.detach("sphere").q = [0, 0, 0, 0, 0.099, 0]
    world.step(3)
    assert len(world.collision_result.contacts) > 0
    world.clone().step()


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda s, o: s.attach("upper", "finger"), "'upper' cannot hang from 'finger', which hangs from it"),
        (lambda s, o: s.attach("upper", "upper"), "is itself"),
        (lambda s, o: s.attach(tree(pydart.World(0.001)).body("hand"), "other"), "move within one world"),
        (lambda s, o: s.attach("hand", o.body("root")), "is not a body of"),
        (lambda s, o: s.attach("hand", "other", joint_name="upper_joint"), "'upper_joint' already"),
        (lambda s, o: o.attach(s.body("hand"), "other", joint_name="hand_joint"), "'hand_joint' already"),
        (lambda s, o: s.attach("hand", "other", "hinge"), "no joint 'hinge'"),
        (lambda s, o: s.attach("hand", "other", "universal", axis=(0, 0, 1)), "2 axes"),
        (lambda s, o: s.attach("hand", "other", "revolute", limits=(1, -1)), "lower limit"),
        (lambda s, o: s.attach("hand", "other", "ball", limits=np.zeros((2, 2))), "each of 3 dofs"),
        (lambda s, o: s.attach("hand", "other", "ball", damping=(1, 2)), "damping is one number, or one for each"),
        (
            lambda s, o: s.attach("hand", "other", "revolute", armature=-1),
            r"armature of .* must be finite and not neg",
        ),
        (lambda s, o: s.attach("hand", "other", "revolute", rest=float("nan")), "rest of the joint"),
        (lambda s, o: s.attach("hand", "other", "screw", pitch=float("inf")), "pitch"),
        (lambda s, o: s.attach("hand", "other", "euler", order="YXZ"), "axis order"),
        (lambda s, o: s.attach("hand", "other", position=(0, float("nan"), 0)), "finite"),
        (lambda s, o: s.attach("hand", "other", orientation=np.ones((3, 3))), "rotation"),
        (lambda s, o: s.detach(o.body("hand")), "is not a body of"),
        (lambda s, o: s.detach("hand", ""), "needs a name"),
    ],
)
def test_what_cannot_be_is_refused_and_changes_nothing(call, message: str) -> None:
    world = pydart.World(0.001)
    skel, other = tree(world), tree(world, "other")
    before = world.snapshot()
    with pytest.raises(ValueError, match=message):
        call(skel, other)
    assert len(world.skeletons) == 2
    world.restore(before)
    assert_equal(skel, other)


def test_what_holds_a_branch_is_not_lost_in_silence() -> None:
    world = pydart.World(0.001)
    skel = tree(world)
    skel.joint("finger_joint").set_mimic(skel.joint("upper_joint"))
    with pytest.raises(ValueError, match="'finger_joint' follows joint 'upper_joint'"):
        skel.detach("hand")
    with pytest.raises(ValueError, match="'finger_joint' follows"):
        skel.attach("upper", "other")
    with pytest.raises(ValueError, match="'finger_joint' follows"):
        skel.copy_branch("hand", "other")
    skel.attach("hand", "other")  # within the skeleton it follows as before
    assert skel.joint("finger_joint").mimic()[0] is skel.joint("upper_joint")
    skel.copy_branch("root")
    assert skel.joint("finger_joint(1)").mimic()[0] is skel.joint("upper_joint(1)")
    assert len(world.skeletons) == 1
    assert_copies_are_equal(world)
    held, holder = tree(world, "held"), tree(world, "holder")
    held.set_targets(held.q, kp=1.0, kd=1.0)
    for call in (lambda: held.attach("hand", "other"), lambda: held.detach("hand")):
        with pytest.raises(ValueError, match="while its dofs have targets"):
            call()
    with pytest.raises(ValueError, match="while its dofs have targets"):
        holder.attach(held.body("hand"), "other", joint_name="new")
    held.clear_targets()
    constraint = pydart.constraints.BallJointConstraint(held.body("hand"), holder.body("hand"), (0, 0, 0))
    constraint.add_to_world(world)
    with pytest.raises(ValueError, match="while a constraint holds it"):
        skel.attach(held.body("other"), "root", joint_name="new")
    constraint.remove()
    skel.attach(held.body("other"), "root", joint_name="new")
    world.step()


def test_sleepers_wake_and_soft_bodies_come_along() -> None:
    world = pydart.World(0.001)
    world.add_ground()
    box, soft = (
        world.add_box((0.2, 0.2, 0.2), position=(0, 0.1, 0)),
        world.add_soft_box((0.2, 0.2, 0.2), 1.0, (1, 2, 0)),
    )
    world.set_sleeping(True)
    world.step(800)
    assert box.is_asleep()
    skin = soft.body(0)
    before = skin.point_world_positions()
    box.attach(skin, "box")
    assert not box.is_asleep() and box.body("soft_box") is skin
    assert np.allclose(skin.point_world_positions(), before, rtol=0, atol=1e-12)
    assert_copies_are_equal(world)


def test_what_blew_up_is_given_a_state_first() -> None:
    world = pydart.World(0.001)
    world.set_blow_up("nan")
    skel = tree(world)
    skel.dq = np.full(skel.ndofs, 1e25)
    world.step(5)
    for call in (lambda: skel.detach("hand"), lambda: skel.add_body("new"), lambda: skel.remove_body("hand")):
        with pytest.raises(ValueError, match="reads NaN since it blew up; set its state first"):
            call()
    assert len(world.skeletons) == 1
    skel.q, skel.dq = np.zeros((2, skel.ndofs))
    skel.detach("hand")
    world.step()
    assert np.isfinite(world.x).all()


@pytest.mark.parametrize("way", ["remove_body", "detach", "attach"])
@pytest.mark.parametrize(("stays", "gone"), [("cart", "arm"), ("arm", "cart")])
def test_what_stays_of_two_trees_has_its_numbers(way: str, stays: str, gone: str) -> None:
    """Which were read before, and whose state does not change."""
    joints = {"cart": "free", "arm": "ball"}
    alone = pydart.World(0.001).add_empty_skeleton("alone")
    add(alone, stays, None, joints[stays])
    world = pydart.World(0.001)
    both, other = world.add_empty_skeleton("both"), world.add_empty_skeleton("other")
    for name, joint in joints.items():
        add(both, name, None, joint)
    for skel in (alone, both):
        skel.body(stays).add_ext_torque((1.0, 2.0, 3.0))
        skel.dq = np.full(skel.ndofs, 0.3)
        assert skel.M.any() and skel.c.any() and skel.invM.any() and skel.external_forces().any()
    if way == "attach":
        other.attach(both.body(gone))
    else:
        getattr(both, way)(gone)
    for name in ("M", "invM", "c"):
        assert np.array_equal(getattr(both, name), getattr(alone, name)), name
    for name in ("external_forces", "gravity_forces", "coriolis_forces", "aug_mass_matrix"):
        assert np.array_equal(getattr(both, name)(), getattr(alone, name)()), name
