"""The idioms of the learning environments that were written for the original."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

import pydart2 as pydart


class Lab(pydart.World):
    """A world whose reset() uses what its constructor has set before the base class calls it."""

    def __init__(self, step: float, path: str) -> None:
        self.episodes = 0
        super().__init__(step, path)

    def reset(self) -> None:
        super().reset()
        self.episodes += 1


class Walker:
    """A humanoid: the action is a torque for each joint, the reward its way along x."""

    frame_skip = 4

    def __init__(self, seed: int = 3) -> None:
        pydart.init(verbose=False)
        self.world = Lab(0.002, "./data/skel/fullbody1.skel")
        try:
            self.world.set_collision_detector(4)
        except Exception:
            self.world.set_collision_detector(pydart.World.BULLET_COLLISION_DETECTOR)
        self.robot = self.world.skeletons[-1]
        self.robot.joint("j_shin_left").set_position_lower_limit(0, -0.3)
        self.robot.joint("j_shin_right").set_position_upper_limit(0, 0.1)
        for joint in self.robot.joints:
            for i in range(len(joint.dofs)):
                if joint.has_position_limit(i):
                    joint.set_position_limit_enforced(True)
        self.rng = np.random.default_rng(seed)

    def reset(self) -> np.ndarray:
        self.world.reset()
        self.robot.set_positions(self.robot.q + self.rng.uniform(-0.005, 0.005, self.robot.ndofs))
        self.robot.set_velocities(self.robot.dq + self.rng.uniform(-0.005, 0.005, self.robot.ndofs))
        return self.observe()

    def observe(self) -> np.ndarray:
        return np.concatenate([self.robot.q[1:], np.clip(self.robot.dq, -10, 10)])

    def step(self, action: np.ndarray) -> tuple[np.ndarray, float, bool, dict[str, Any]]:
        before = self.robot.C[0]
        tau = np.zeros(self.robot.ndofs)
        tau[6:] = 0.5 * np.clip(action, -1, 1)
        for _ in range(self.frame_skip):
            self.robot.set_forces(tau)
            self.world.step()
        reward = (self.robot.C[0] - before) / (self.frame_skip * self.world.dt)
        touching = {contact.bodynode1.name for contact in self.world.collision_result.contacts}
        touching |= {contact.bodynode2.name for contact in self.world.collision_result.contacts}
        done = not np.isfinite(self.robot.x).all() or "h_head" in touching
        return self.observe(), reward, done, {"touching": touching}

    def episode(self, length: int) -> np.ndarray:
        self.reset()
        return np.array([self.step(self.rng.uniform(-1, 1, self.robot.ndofs - 6))[0] for _ in range(length)])


@pytest.fixture
def env() -> Walker:
    return Walker()


def test_an_episode(env: Walker) -> None:
    first = env.reset()
    assert type(first) is np.ndarray and first.shape == (2 * 37 - 1,)
    touched: set[str] = set()
    for _ in range(40):
        observation, reward, done, info = env.step(env.rng.uniform(-1, 1, 31))
        assert observation.shape == first.shape and abs(reward) < 2.0 and not done
        touched |= info["touching"]
    assert env.world.t == pytest.approx(40 * 4 * 0.002)
    assert (env.world.frame, env.world.nframes, env.world.episodes) == (160, 161, 2)
    assert {"h_heel_left", "h_heel_right"} & touched


def test_equal_seeds_give_equal_episodes() -> None:
    assert_allclose(Walker(5).episode(10), Walker(5).episode(10), rtol=0, atol=0)
    assert not np.allclose(Walker(5).episode(10), Walker(6).episode(10))


def test_limits_are_kept_once_they_are_enforced(env: Walker) -> None:
    env.world.set_gravity([0, 0, 0])
    left, right = (env.robot.dof(f"j_shin_{side}") for side in ("left", "right"))
    knees = -5.0 * (np.arange(37) == left.id) + 5.0 * (np.arange(37) == right.id)

    def reached() -> tuple[float, float]:
        env.world.reset()
        for _ in range(100):
            env.robot.set_forces(knees)
            env.world.step()
        return left.position(), right.position()

    assert_allclose(reached(), (-0.3, 0.1), atol=0.002)
    for dof in (left, right):
        dof.joint.set_position_limit_enforced(False)
    assert reached()[0] < -0.4 and reached()[1] > 0.2


def test_an_unavailable_detector_raises(env: Walker) -> None:
    assert env.world.collision_detector() == pydart.World.BULLET_COLLISION_DETECTOR


def test_states_are_arrays(env: Walker) -> None:
    q = env.robot.q
    noisy = q + np.full(37, 0.5)
    assert noisy["j_pelvis_rot_x"] == q[0] + 0.5
    x, height = q[3, 4]
    assert (x, height) == (q["j_pelvis_pos_x"], q["j_pelvis_pos_y"])
    assert_allclose(np.concatenate([q[1:], env.robot.dq]), env.robot.x[1:], atol=0)


@pytest.mark.parametrize("times", [1, 4])
def test_forces_last_one_step(env: Walker, times: int) -> None:
    env.world.set_gravity([0, 0, 0])
    env.robot.q += 10.0 * (np.arange(37) == 4)  # off the ground
    tau = 100.0 * (np.arange(37) == 4)
    for i in range(4):
        if i < times:
            env.robot.set_forces(tau)
        env.world.step()
    assert np.linalg.norm(env.robot.P) == pytest.approx(times * 100.0 * env.world.dt, rel=1e-3)
    assert (env.robot.tau == tau).all()  # what was set last, although it is spent


def test_order_of_skeletons(env: Walker) -> None:
    assert [skel.name for skel in env.world.skeletons] == ["ground skeleton", "fullbody1"]
    assert (env.world.skeletons[0].id, env.robot.id) == (0, 1)


def test_every_joint_can_be_asked_for_limits(zoo: pydart.Skeleton) -> None:
    zoo.joint("ball joint").set_position_upper_limit(1, 2.0)
    limits = [[joint.has_position_limit(i) for i in range(len(joint.dofs))] for joint in zoo.joints]
    assert [len(of_joint) for of_joint in limits] == [0, 1, 1, 2, 3, 3, 3, 3, 6]
    assert limits[5] == [False, True, False] and sum(map(sum, limits)) == 1


def test_contact_forces_stop_the_fall(env: Walker) -> None:
    """Momentum gained = (weight + contact forces) * time."""
    env.world.dt = 0.0005  # the balance holds to first order in it
    env.reset()
    impulse, before = np.zeros(3), env.robot.P
    for _ in range(400):
        env.world.step()
        impulse += env.robot.m * env.world.g * env.world.dt
        for contact in env.world.collision_result.contacts:
            assert (contact.skel_id1, contact.skel_id2) in ((0, 1), (1, 0))
            body = contact.bodynode1 if contact.skel_id1 == 1 else contact.bodynode2
            assert body is env.robot.bodynodes[contact.bodynode_id1 if contact.skel_id1 == 1 else contact.bodynode_id2]
            assert np.linalg.norm(body.to_world() - contact.point) < 0.5
            impulse += (1 if contact.skel_id1 == 1 else -1) * contact.force * env.world.dt
    assert impulse[1] > -0.9 * env.robot.m * 9.81 * 400 * env.world.dt  # the ground has held it up
    assert_allclose(env.robot.P - before, impulse, atol=0.02 * env.robot.m)
