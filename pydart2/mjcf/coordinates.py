"""Which positions and velocities of ours are which of MuJoCo's."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pydart2.poses import rotation

_Array = NDArray[np.float64]


@dataclass(frozen=True)
class JointPlace:
    """Where a joint's numbers are: its kind, the first of its qpos and qvel, our first dof in the skeleton."""

    kind: str
    qpos: int
    qvel: int
    dof: int


@dataclass(frozen=True)
class Coordinates:
    """The map of one skeleton.

    Hinge and slide: the same numbers. Ball: q is the rotation vector of the quaternion; dq is qvel, the angular
    velocity in the body's frame. Free: q is rotation vector and position, dq angular and linear velocity, both in
    the body's frame, where MuJoCo has position and quaternion, linear velocity in the world's frame and angular in the
    body's.
    """

    joints: tuple[JointPlace, ...]
    num_dofs: int

    def q(self, qpos: ArrayLike) -> _Array:
        """Our positions, shape (ndofs,), rad and m, of MuJoCo's, shape (nq,)."""
        theirs, q = np.asarray(qpos, dtype=float), np.zeros(self.num_dofs)
        for joint in self.joints:
            if joint.kind == "ball":
                q[joint.dof : joint.dof + 3] = rotation_vector(theirs[joint.qpos : joint.qpos + 4])
            elif joint.kind == "free":
                q[joint.dof : joint.dof + 3] = rotation_vector(theirs[joint.qpos + 3 : joint.qpos + 7])
                q[joint.dof + 3 : joint.dof + 6] = theirs[joint.qpos : joint.qpos + 3]
            else:
                q[joint.dof] = theirs[joint.qpos]
        return q

    def dq(self, qpos: ArrayLike, qvel: ArrayLike) -> _Array:
        """Our velocities, shape (ndofs,), rad/s and m/s, of MuJoCo's positions, (nq,), and velocities, (nv,)."""
        S = self.to_ours(qpos)
        dq: _Array = S @ np.asarray(qvel, dtype=float)[: S.shape[1]]
        return dq

    def to_ours(self, qpos: ArrayLike) -> _Array:
        """The matrix S, shape (ndofs, n), 1, of dq = S qvel[:n]; S' takes our forces to MuJoCo's. n is at most nv."""
        where = np.asarray(qpos, dtype=float)
        size = max((joint.qvel + _SIZES.get(joint.kind, 1) for joint in self.joints), default=0)
        S = np.zeros((self.num_dofs, size))
        for joint in self.joints:
            n, dof, theirs = _SIZES.get(joint.kind, 1), joint.dof, joint.qvel
            if joint.kind == "free":
                S[dof : dof + 3, theirs + 3 : theirs + 6] = np.eye(3)
                S[dof + 3 : dof + 6, theirs : theirs + 3] = rotation(where[joint.qpos + 3 : joint.qpos + 7]).T
            else:
                S[dof : dof + n, theirs : theirs + n] = np.eye(n)
        return S


_SIZES = {"ball": 3, "free": 6}


def rotation_vector(quaternion: ArrayLike) -> _Array:
    """Axis times angle, at most pi, shape (3,), rad, of a quaternion [w, x, y, z] of any length."""
    w, *rest = np.asarray(quaternion, dtype=float)
    vector = np.array(rest) * (1.0 if w >= 0.0 else -1.0)
    sine, cosine = float(np.linalg.norm(vector)), abs(float(w))
    return vector * (2.0 * np.arctan2(sine, cosine) / sine) if sine > 0.0 else np.zeros(3)
