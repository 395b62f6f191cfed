"""MuJoCo as the judge of what we build of its files."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

mujoco = pytest.importorskip("mujoco", reason="MuJoCo is not installed: pip install 'pydart2[mjcf]'")


def full_mass_matrix(model: Any, data: Any) -> np.ndarray:
    M = np.zeros((model.nv, model.nv))
    try:
        mujoco.mj_fullM(model, data, M)
    except TypeError:  # before 3.4
        mujoco.mj_fullM(model, M, data.qM)
    return M


def worst_errors(model: Any, built: Any, world: Any, seed: int = 0) -> tuple[float, float, float]:
    """Of M and bias, to their largest entry, and of the bodies' positions, m, at five random states."""
    rng, data, errors = np.random.default_rng(seed), mujoco.MjData(model), np.zeros(3)
    for _ in range(5):
        data.qpos[:] = model.qpos0 + 0.3 * rng.normal(size=model.nq)
        data.qvel[:] = rng.normal(size=model.nv)
        mujoco.mj_normalizeQuat(model, data.qpos)
        mujoco.mj_forward(model, data)
        M = full_mass_matrix(model, data)
        for index, coordinates in built.coordinates.items():
            skel = world.skeleton(index)
            S = coordinates.to_ours(data.qpos)
            n = S.shape[1]
            v = data.qvel[:n]
            skel.set_positions(coordinates.q(data.qpos))
            skel.set_velocities(S @ v)
            mine = np.flatnonzero(S.any(axis=0))
            ours = skel.mass_matrix(None)
            bias = S.T @ (skel.coriolis_and_gravity_forces(None) + ours @ rate_of_map(coordinates, S, data.qvel) @ v)
            errors[0] = max(errors[0], np.abs(S.T @ ours @ S - M[:n, :n])[np.ix_(mine, mine)].max() / np.abs(M).max())
            errors[1] = max(
                errors[1], np.abs(bias - data.qfrc_bias[:n])[mine].max() / (np.abs(data.qfrc_bias).max() or 1.0)
            )
            for body, (where, node) in built.places.items():
                if where == index:
                    error = np.abs(skel.bodynode(node).to_world(None) - data.xpos[body]).max()
                    errors[2] = max(errors[2], error)
    return float(errors[0]), float(errors[1]), float(errors[2])


def rate_of_map(coordinates: Any, s: np.ndarray, qvel: np.ndarray) -> np.ndarray:
    """dS/dt: the world's axes turn in the frame of a free body."""
    rate = np.zeros_like(s)
    for joint in coordinates.joints:
        if joint.kind == "free":
            x, y, z = qvel[joint.qvel + 3 : joint.qvel + 6]
            rows, columns = slice(joint.dof + 3, joint.dof + 6), slice(joint.qvel, joint.qvel + 3)
            rate[rows, columns] = -np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]]) @ s[rows, columns]
    return rate
