"""The idioms of learning environments that were written for the original."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import pydart2 as pydart
from oracle.models import dart_model


class Hopper:
    """An environment as they were written: frame skip, forces by action, contacts, reset with noise."""

    frame_skip = 4

    def __init__(self) -> None:
        pydart.init(verbose=False)
        self.world = pydart.World(0.002, dart_model("skel/fullbody1.skel"))
        try:
            self.world.set_collision_detector(7)
        except Exception:
            self.world.set_collision_detector(pydart.World.BULLET_COLLISION_DETECTOR)
        self.ground, self.robot = self.world.skeletons[0], self.world.skeletons[-1]
        for joint in self.robot.joints:
            joint.set_position_limit_enforced(True)
        for joint in self.robot.joints:
            for i in range(len(joint.dofs)):
                if joint.has_position_limit(i):
                    assert joint.position_lower_limit(i) < joint.position_upper_limit(i)
        self.rng = np.random.default_rng(3)

    def reset(self) -> np.ndarray:
        self.world.reset()
        self.robot.set_positions(self.robot.q + self.rng.uniform(-0.005, 0.005, self.robot.ndofs))
        self.robot.set_velocities(self.robot.dq + self.rng.uniform(-0.005, 0.005, self.robot.ndofs))
        return self.observe()

    def observe(self) -> np.ndarray:
        return np.concatenate([self.robot.q[1:], np.clip(self.robot.dq, -10, 10)])

    def step(self, action: np.ndarray) -> tuple[np.ndarray, float, bool, dict[str, Any]]:
        before = self.robot.q[3]
        tau = np.zeros(self.robot.ndofs)
        tau[6:] = np.clip(action, -1, 1) * 0.5
        for _ in range(self.frame_skip):
            self.robot.set_forces(tau)
            self.world.step()
        after, height = self.robot.q[3, 4]
        force = sum(
            abs(contact.force[1])
            for contact in self.world.collision_result.contacts
            if "h_heel" in contact.bodynode1.name or "h_heel" in contact.bodynode2.name
        )
        state = np.concatenate([self.robot.q, self.robot.dq])
        done = not (np.isfinite(state).all() and height > -2.0)
        return self.observe(), (after - before) / self.world.dt, done, {"force": force}


@pytest.fixture
def env() -> Hopper:
    return Hopper()


def test_an_episode(env: Hopper) -> None:
    first = env.reset()
    assert first.shape == (2 * env.robot.ndofs - 1,)
    assert type(first) is np.ndarray
    done, forces = False, []
    for _ in range(60):
        observation, _reward, done, info = env.step(env.rng.uniform(-1, 1, env.robot.ndofs - 6))
        forces.append(info["force"])
    assert env.world.t == pytest.approx(60 * 4 * 0.002)
    assert env.world.nframes == 60 * 4 + 1
    assert not np.array_equal(observation, first)
    assert not done


def test_forces_last_one_step_only(env: Hopper) -> None:
    env.world.set_gravity([0, 0, 0])
    env.reset()
    env.robot.dq = np.zeros(env.robot.ndofs)
    tau = np.zeros(env.robot.ndofs)
    tau[env.robot.dof_index("j_pelvis_pos_y")] = 100.0
    env.robot.set_forces(tau)
    env.world.step()
    momentum = env.robot.P
    assert np.linalg.norm(momentum) == pytest.approx(100.0 * env.world.dt, rel=1e-4)  # along the pelvis' y axis
    env.world.step()
    assert pytest.approx(momentum, rel=1e-4) == env.robot.P
    assert env.robot.tau is tau  # what was set last, although it is spent


def test_reset_repeats_an_episode(env: Hopper) -> None:
    def episode() -> np.ndarray:
        env.rng = np.random.default_rng(5)
        env.reset()
        return np.array([env.step(env.rng.uniform(-1, 1, env.robot.ndofs - 6))[0] for _ in range(10)])

    assert episode()[0] == pytest.approx(episode()[0], abs=1e-6)


def test_the_robot_is_the_last_and_the_ground_the_first(env: Hopper) -> None:
    assert env.world.skeletons[0].name == "ground skeleton"
    assert env.world.skeletons[-1].name == "fullbody1"
    assert [skel.id for skel in env.world.skeletons] == list(range(len(env.world.skeletons)))
    body = env.robot.body("h_heel_left")
    assert (body.skid, env.robot.bodynodes[body.id]) == (env.robot.id, body)
