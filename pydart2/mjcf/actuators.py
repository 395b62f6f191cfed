"""The actuators of a compiled model: motors as limits of forces, position and velocity servos as targets with gains."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from pydart2._native import WorldHandle
from pydart2.mjcf.compile import Compiled
from pydart2.mjcf.trees import Built

_Vector = NDArray[np.float64]
_JOINTS = (0, 1)  # mjtTrn: joint, joint in its parent
_ONE_DOF = (2, 3)  # mjtJoint: slide, hinge
_UNKNOWN = "actuators but motors, position and velocity servos of hinges and slides (set forces instead)"


def add_actuators(model: Compiled, world: WorldHandle, built: Built, unknown: set[str]) -> None:
    """Give the dofs of actuators the forces that these can have, and servos their gains; notes the rest in `unknown`.

    Controls are 0 at first, as MuJoCo's: a position servo holds its joint at 0 until set_targets() says otherwise.
    """
    gains: dict[int, _Vector] = {}
    ranges: dict[tuple[int, int], _Vector] = {}
    for i in range(model.nu):
        if not _known(model, i):
            unknown.add(_UNKNOWN)
            continue
        joint = int(model.actuator_trnid[i][0])
        index = built.places[int(model.jnt_bodyid[joint])][0]
        number = next(p.dof for p in built.coordinates[index].joints if p.qvel == int(model.jnt_dofadr[joint]))
        gear, (_, p, d) = float(model.actuator_gear[i][0]), map(float, model.actuator_biasprm[i][:3])
        ranges[index, number] = ranges.get((index, number), 0.0) + _force_range(model, i, gear)
        if p or d:
            both = gains.setdefault(index, np.zeros((2, world.skeleton(index).num_dofs())))
            both[:, number] += gear**2 * np.array([-p, -d])
    for (index, number), (low, high) in ranges.items():
        dof = world.skeleton(index).dof(number)
        dof.set_force_lower_limit(float(low))
        dof.set_force_upper_limit(float(high))
    for index, (kp, kd) in gains.items():
        world.skeleton(index).targets().set(np.zeros(len(kp)), np.zeros(len(kp)), kp, kd, 0)


def _known(model: Compiled, i: int) -> bool:
    """Whether a force is gain times control, less a spring and a damper that hold position or speed at the control."""
    gain, (constant, p, d) = float(model.actuator_gainprm[i][0]), map(float, model.actuator_biasprm[i][:3])
    if (
        int(model.actuator_trntype[i]) not in _JOINTS
        or int(model.actuator_dyntype[i])
        or int(model.actuator_gaintype[i])
    ):
        return False
    if int(model.jnt_type[int(model.actuator_trnid[i][0])]) not in _ONE_DOF:
        return False
    servo = int(model.actuator_biastype[i]) == 1 and not constant and p <= 0.0 and d <= 0.0
    return int(model.actuator_biastype[i]) == 0 or (servo and gain == (-p or -d))


def _force_range(model: Compiled, i: int, gear: float) -> _Vector:
    """What the actuator can do to its joint, N m or N."""
    low, high = -math.inf, math.inf
    if model.actuator_forcelimited[i]:
        low, high = map(float, model.actuator_forcerange[i])
    if model.actuator_ctrllimited[i] and int(model.actuator_biastype[i]) == 0:
        ends = sorted(float(model.actuator_gainprm[i][0]) * float(end) for end in model.actuator_ctrlrange[i])
        low, high = max(low, ends[0]), min(high, ends[1])
    return np.array(sorted((gear * low, gear * high)) if gear else (0.0, 0.0))
