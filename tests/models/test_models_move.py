"""Our models move as they should."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import pydart2

Array = NDArray[np.float64]
H = 1.0 / 2000.0  # s, the time step of the documented examples
FLOOR = -0.895  # m, the top of the humanoid's floor


def load(name: str, step: float) -> Any:
    world = pydart2.World(step, pydart2.data_path(f"skel/{name}.skel"))
    world.disable_recording()
    return world


def test_cubes_come_to_rest() -> None:
    """The second cube falls beside the first, off the plate, and lies on the floor."""
    world = load("cubes", 0.001)
    plate, first, second = (world.skeletons[i] for i in (1, 2, 3))
    start = second.C[1]
    most = 0
    for _ in range(2000):
        world.step()
        most = max(most, len(world.collision_result.contacts))
    assert most >= 12
    for skeleton in (plate, first, second):
        assert np.abs(skeleton.dq).max() < 1e-6
    np.testing.assert_allclose((plate.C[1], first.C[1], second.C[1]), (-0.325, -0.275, -0.325), atol=1e-3)
    assert start - second.C[1] == pytest.approx(0.13, abs=1e-3)


def energy(skeleton: Any) -> float:
    potential = sum(9.81 * body.m * body.C[1] for body in skeleton.bodynodes)
    return float(0.5 * skeleton.dq @ skeleton.M @ skeleton.dq + potential)


def test_chain_swings() -> None:
    """From the side it swings through to the other side and keeps its energy."""
    world = load("chain", 1.0 / 5000.0)
    chain = world.skeletons[0]
    q = np.zeros(chain.ndofs)
    q[2] = 0.9
    chain.q = q
    before, tip = energy(chain), []
    for _ in range(100):
        world.step(50)
        tip.append(chain.bodynodes[-1].C)
    x, y, z = np.array(tip).T
    assert x.max() > 0.2
    assert x.min() < -0.2
    assert y.min() < -0.4
    assert np.abs(z).max() < 1e-9
    assert energy(chain) == pytest.approx(before, abs=0.02 * 9.81 * chain.m * 0.25)


def test_soft_bodies_deform_and_rest() -> None:
    world = load("softBodies", 0.001)
    bodies = [skeleton.bodynodes[0] for skeleton in world.skeletons[1:]]
    most = np.zeros(len(bodies))
    for _ in range(300):
        world.step(10)
        most = np.maximum(most, [np.abs(b.point_displacements()).max() for b in bodies])
    assert (most > 0.01).all()
    for body in bodies:
        assert body.point_world_positions()[:, 1].min() > -0.352, body.skeleton.name  # the floor is at -0.35
        assert body.C[1] < 0.0
        assert np.abs(body.skeleton.dq).max() < 0.6


def test_shapes_fall_onto_the_floor() -> None:
    """Nothing sinks in and nothing stays in the air.  Round shapes may roll."""
    world = load("shapes", 0.001)
    world.step(2000)
    height = {s.bodynodes[0].name: s.C[1] + 0.375 for s in world.skeletons[1:]}  # above the floor
    for name, half in {"sphere": 0.05, "box": 0.025, "cylinder": 0.05, "capsule": 0.05}.items():
        assert height[name] == pytest.approx(half, abs=0.004), name
    assert all(0.02 < h < 0.12 for h in height.values()), height
    assert np.isfinite(world.states()).all()


class GravityCompensation:
    """Holds a robot by J^T (-m g) of each body."""

    def __init__(self, robot: Any) -> None:
        self.robot = robot

    def compute(self) -> Array:
        weights = [(body, -body.m * self.robot.world.g) for body in self.robot.bodynodes]
        return sum((b.linear_jacobian(b.local_com()).T @ f for b, f in weights), np.zeros(self.robot.ndofs))


def moved(compensate: bool) -> float:
    """How far a body's COM of PR2 gets at most within two seconds."""
    world = pydart2.World(0.001)
    world.disable_recording()
    world.set_gravity([0.0, 0.0, -9.81])
    robot = world.add_skeleton(pydart2.data_path("urdf/PR2/pr2.urdf"))
    robot.joints[0].set_actuator_type(pydart2.joint.Joint.LOCKED)
    robot.set_positions({"rootJoint_pos_z": -0.6})
    if compensate:
        robot.set_controller(GravityCompensation(robot))
    start = [body.C for body in robot.bodynodes]
    most = 0.0
    for _ in range(20):
        world.step(100)
        most = max(most, *(float(np.linalg.norm(b.C - c)) for b, c in zip(robot.bodynodes, start)))
    return most


def test_pr2_with_and_without_gravity_compensation() -> None:
    assert moved(True) < 1e-3
    assert moved(False) > 0.1


def test_atlas_stands() -> None:
    """Springs hold the pose; the feet rest on the floor for half a second and longer."""
    scene = json.loads(Path(pydart2.data_path("sdf/atlas/standing.json")).read_text(encoding="ascii"))
    world = pydart2.World(scene["time_step"], pydart2.data_path(scene["world"]))
    robot = world.add_skeleton(pydart2.data_path(scene["robot"]))
    robot.set_positions(scene["q"])
    for dof in robot.dofs[6:]:
        dof.set_spring_stiffness(scene["stiffness"])
        dof.set_rest_position(dof.position())
        dof.set_damping_coefficient(scene["damping"])
    start, fewest = robot.C, 100
    for _ in range(1000):
        world.step()
        fewest = min(fewest, len(world.collision_result.contacts))
    assert fewest >= 8
    np.testing.assert_allclose(robot.C, start, atol=0.03)


def stable_pd(skeleton: Any, kp: Array, kd: Array, target: Array) -> Array:
    """Tan, Liu, Turk: Stable Proportional-Derivative Controllers, IEEE CG&A 31(4), 2011."""
    h, q, dq = skeleton.world.dt, np.asarray(skeleton.q), np.asarray(skeleton.dq)
    p, d = -kp * (q + h * dq - target), -kd * dq
    acting = p + d - skeleton.c + skeleton.constraint_forces()
    return np.asarray(p + d - h * kd * np.linalg.solve(skeleton.M + h * np.diag(kd), acting))


def gains(skeleton: Any, stiffness: float, damping: float) -> tuple[Array, Array]:
    """Gains of all joints but the free one."""
    joints = np.r_[np.zeros(6), np.ones(skeleton.ndofs - 6)]
    return stiffness * joints, damping * joints


class StandController:
    """Holds a pose and shifts the weight with ankles and toes, as the documentation's biped_stand."""

    RULES = ((0.0, 0.1, 200.0, 10.0), (-0.2, -0.05, 2000.0, 100.0))  # from, to (m); ankle gain, damping

    def __init__(self, skeleton: Any) -> None:
        self.skeleton, self.target, self.before = skeleton, np.array(skeleton.q), 0.0
        self.gains = gains(skeleton, 400.0, 40.0)
        self.foot = skeleton.dof_indices(["j_heel_left_1", "j_toe_left", "j_heel_right_1", "j_toe_right"])

    def compute(self) -> Array:
        tau = stable_pd(self.skeleton, *self.gains, self.target)
        offset = float(self.skeleton.C[0] - self.skeleton.body("h_heel_left").to_world([0.05, 0.0, 0.0])[0])
        for low, high, ankle, damping in self.RULES:
            if low < offset < high:
                stiffness = np.array([-ankle, -100.0, -ankle, -100.0])
                tau[self.foot] += stiffness * offset + damping * (self.before - offset)
                self.before = offset
        tau[:6] = 0.0
        return tau


def test_fullbody_stands_and_recovers_from_both_pushes() -> None:
    world = load("fullbody1", H)
    human = world.skeletons[1]
    pose = {"j_pelvis_pos_y": -0.05, "j_pelvis_rot_y": -0.2, "j_abdomen_2": 0.0}
    for side in ("left", "right"):
        pose |= {f"j_thigh_{side}_z": 0.15, f"j_shin_{side}": -0.4, f"j_heel_{side}_1": 0.25}
    human.set_positions(pose)
    human.set_controller(StandController(human))
    pushes = {round(1.5 / H): 50.0, round(3.5 / H): -50.0}  # start and force along x (N), for 101 steps
    sway = {force: 0.0 for force in pushes.values()}
    for step in range(round(6.0 / H)):
        for start, force in pushes.items():
            if start <= step <= start + 100:
                human.body("h_spine").add_ext_force([force, 0.0, 0.0])
            if start <= step:
                sway[force] = max(sway[force], float(np.sign(force) * human.dC[0]))
        world.step()
        assert human.C[1] > -0.06, world.t
    assert min(sway.values()) > 0.03  # m/s: the pushes were felt
    assert np.linalg.norm(human.dC) < 0.01
    assert np.abs(human.C[[0, 2]]).max() < 0.03


def jump_targets(human: Any) -> list[tuple[float, Array]]:
    """Crouch, swing the arms, land: each pose with its end (s)."""
    crouch, swing, land = (human.positions() for _ in range(3))
    for side, sign in (("left", 1.0), ("right", -1.0)):
        crouch[f"j_thigh_{side}_z"], crouch[f"j_shin_{side}"], crouch[f"j_heel_{side}_1"] = 1.2, -2.0, 0.8
        crouch[f"j_bicep_{side}_y"] = 0.5 * sign
        swing[f"j_bicep_{side}_y"], swing[f"j_bicep_{side}_x"] = -2.0 * sign, 0.5 * sign
        land[f"j_thigh_{side}_z"] = 0.3
    return [(0.4, np.array(crouch)), (0.8, np.array(swing)), (np.inf, np.array(land))]


class JumpController:
    """Follows three poses and presses the heels down, as the documentation's biped_jump."""

    def __init__(self, skeleton: Any) -> None:
        self.skeleton, self.targets = skeleton, jump_targets(skeleton)
        self.gains = gains(skeleton, 600.0, 40.0)

    def compute(self) -> Array:
        t = self.skeleton.world.t
        tau = stable_pd(self.skeleton, *self.gains, next(pose for end, pose in self.targets if t < end))
        if 0.3 < t < 0.5:
            for name in ("h_heel_left", "h_heel_right"):
                tau += self.skeleton.body(name).linear_jacobian().T @ [0.0, -700.0, 0.0]
        tau[:6] = 0.0
        return tau


def sole(human: Any) -> float:
    """Height of the lowest corner of the feet above the floor."""
    corners = [(x, -0.02 - dy, z) for x in (-0.03, 0.07) for z in (-0.054, 0.054) for dy in (0.0, 0.025)]
    feet = [human.body(f"h_{part}_{side}") for part in ("heel", "toe") for side in ("left", "right")]
    return min(foot.to_world(corner)[1] for foot in feet for corner in corners) - FLOOR


def test_fullbody_jumps() -> None:
    world = load("fullbody1", H)
    human = world.skeletons[1]
    human.set_positions({human.dofs[2].name: 0.02 * np.pi, human.dofs[4].name: -0.02, human.dofs[5].name: 0.0})
    human.set_controller(JumpController(human))
    start, top, flight, lift = human.C[1], -1.0, 0, 0.0
    for _ in range(round(1.3 / H)):
        world.step()
        if world.t > 0.3 and not world.collision_result.contacts:
            flight += 1
            top, lift = max(top, human.C[1]), max(lift, sole(human))
    assert flight * H > 0.3
    assert lift > 0.2
    assert top > start + 0.2
