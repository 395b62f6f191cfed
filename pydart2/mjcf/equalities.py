"""The equality constraints of a compiled model: points and bodies that stay together, joints that follow others."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pydart2._native import WorldHandle
from pydart2.constraints import BallJointConstraint, WeldJointConstraint
from pydart2.mjcf.compile import Compiled
from pydart2.mjcf.trees import Built, world_poses
from pydart2.poses import pose

_CONNECT, _WELD, _JOINT = 0, 1, 2  # mjtEq
_BODY = 1  # mjtObj


def add_equalities(model: Compiled, world: WorldHandle, built: Built, unknown: set[str]) -> None:
    """Add what constrains bodies or joints and has a counterpart; notes the rest in `unknown`."""
    for i in map(int, np.flatnonzero(model.eq_active0)):
        kind, joints = int(model.eq_type[i]), int(model.eq_obj2id[i]) >= 0
        if kind in (_CONNECT, _WELD) and int(model.eq_objtype[i]) == _BODY:
            _hold(model, world, built, i, unknown)
        elif kind == _JOINT and joints and not np.any(model.eq_data[i][2:5]):
            _mimic(model, world, built, i, unknown)
        else:
            unknown.add("equality constraints but connect and weld of bodies, and joint with a linear polynomial")


def _hold(model: Compiled, world: WorldHandle, built: Built, i: int, unknown: set[str]) -> None:
    """A point or a whole body that stays where it is, as the model stands at first."""
    bodies = int(model.eq_obj1id[i]), int(model.eq_obj2id[i])
    poses, numbers, weld = world_poses(model), np.zeros(11), int(model.eq_type[i]) == _WELD
    if weld:
        apart = np.linalg.inv(poses[bodies[0]]) @ poses[bodies[1]]
        if not np.allclose(apart, _wanted(model.eq_data[i]), atol=1e-6):
            unknown.add("welds to another place than the first")
            return
    else:
        numbers[:3] = (poses[bodies[0]] @ [*model.eq_data[i][:3], 1.0])[:3]
    held = [world.skeleton(s).bodynode(b) for s, b in (built.places[body] for body in bodies if body in built.places)]
    type_ = WeldJointConstraint if weld else BallJointConstraint
    if len(held) == 2:
        world.add_constraint_between(type_._KIND, held[0], held[1], numbers)
    elif held:  # the other is the world itself
        world.add_constraint_to_world(type_._KIND, held[0], numbers)


def _wanted(data: NDArray[np.float64]) -> NDArray[np.float64]:
    """The pose of the second body of a weld in the first; its anchor is in the second."""
    apart = pose(data[3:6], data[6:10])
    apart[:3, 3] -= apart[:3, :3] @ data[:3]
    return apart


def _mimic(model: Compiled, world: WorldHandle, built: Built, i: int, unknown: set[str]) -> None:
    first, second = int(model.eq_obj1id[i]), int(model.eq_obj2id[i])
    offset, factor = (float(number) for number in model.eq_data[i][:2])
    start = [float(model.qpos0[model.jnt_qposadr[joint]]) for joint in (first, second)]
    places = []
    for joint in (first, second):
        skeleton = built.places[int(model.jnt_bodyid[joint])][0]
        coordinates = built.coordinates[skeleton]
        dof = next(p.dof for p in coordinates.joints if p.qvel == int(model.jnt_dofadr[joint]))
        places.append((skeleton, dof))
    if places[0][0] != places[1][0]:
        unknown.add("equality constraints of joints of two trees")
        return
    skel = world.skeleton(places[0][0])
    joints = {skel.joint(j).dof(0): skel.joint(j) for j in range(skel.num_joints()) if skel.joint(j).num_dofs() == 1}
    follower, leader = joints[places[0][1]], joints[places[1][1]]
    follower.set_mimic(leader, factor, start[0] + offset - factor * start[1])
    follower.set_actuator_type("MIMIC")
