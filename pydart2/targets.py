"""Motors that take joints to positions and velocities by name."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pydart2.given import numbers
from pydart2.multibody.coordinates import Coordinates
from pydart2.skel_vector import SkelVector

Compensation = Literal["none", "gravity", "bias"]
Mask = NDArray[np.bool_]
ByName = ArrayLike | Mapping[str, float]

_COMPENSATIONS = ("none", "gravity", "bias")


@dataclass(frozen=True)
class Targets:
    """What the motors of a skeleton follow; a dof whose gains are zero has none.

    Attributes
    ----------
    q, dq : SkelVector
        Positions (rad or m) and velocities (rad/s or m/s), shape (ndofs,).
    kp, kd : SkelVector
        Gains, shape (ndofs,): N m/rad and N m s/rad, or N/m and N s/m.
    compensate : str
        What the motors hold besides: ``"none"``, ``"gravity"`` or ``"bias"``, gravity and Coriolis forces.
    """

    q: SkelVector
    dq: SkelVector
    kp: SkelVector
    kd: SkelVector
    compensate: Compensation


class TargetControl(Coordinates):
    """A Skeleton's motors."""

    def set_targets(
        self,
        q: ByName | None = None,
        dq: ByName | None = None,
        *,
        kp: ByName | float | None = None,
        kd: ByName | float | None = None,
        compensate: Compensation | None = None,
    ) -> None:
        """Let motors take dofs to positions and velocities, from the next step until clear_targets().

        >>> robot.set_targets({"elbow": 1.2}, kp=500.0, kd=50.0, compensate="gravity")

        Each step has stable PD control inside, implicit in both gains, so that high ones need no small steps: Tan, Liu,
        Turk, IEEE CG&A 31(4), 2011. The forces are added to `tau`, to those of a controller and to the springs of the
        model; those of the motors stay within `tau_lower` and `tau_upper`. What contacts did in the last step is known
        to them.

        Parameters
        ----------
        q, dq
            Dof name → target, a part of a vector as ``q[6:]``, or all of them, shape (ndofs,): rad or m, and rad/s or
            m/s. With a position alone a dof comes to rest there.
        kp, kd
            Gains of these dofs: a number for all, dof name → number, or shape (ndofs,): N m/rad and N m s/rad, or N/m
            and N s/m. Default: those that they have, zero at first.
        compensate
            What the motors hold besides: ``"gravity"``, ``"bias"`` (Coriolis forces too) or ``"none"``; default: as set
            before, ``"none"`` at first.

        Raises ValueError where no gain would make a dof move, and if a joint's actuator takes no forces.
        """
        if q is None and dq is None and kp is None and kd is None:
            raise TypeError("set_targets() needs positions, velocities or gains")
        now = self.targets
        zeros = self._pattern.copy()
        new = {
            "q": zeros if now is None else now.q,
            "dq": zeros.copy() if now is None else now.dq,
            "kp": zeros.copy() if now is None else now.kp,
            "kd": zeros.copy() if now is None else now.kd,
        }
        chosen = np.zeros(len(self.dofs), dtype=bool)
        for key, values in (("q", q), ("dq", dq)):
            chosen |= self._fill(new[key], values)
        if q is not None and dq is None:
            new["dq"][chosen] = 0.0
        if not chosen.any():  # gains alone
            chosen = (new["kp"] != 0.0) | (new["kd"] != 0.0)
        for key, gain in (("kp", kp), ("kd", kd)):
            if isinstance(gain, (int, float)):
                new[key][chosen] = gain
            else:
                chosen |= self._fill(new[key], gain)
        self._check(chosen, new["kp"], new["kd"])
        kind = compensate if compensate is not None else "none" if now is None else now.compensate
        if kind not in _COMPENSATIONS:
            raise ValueError(f"compensate must be one of {', '.join(_COMPENSATIONS)}; got {kind!r}")
        self._handle.targets().set(new["q"], new["dq"], new["kp"], new["kd"], _COMPENSATIONS.index(kind))

    def _check(self, chosen: Mask, kp: SkelVector, kd: SkelVector) -> None:
        for i in np.flatnonzero(chosen):
            dof = self.dofs[i]
            if kp[i] == 0.0 and kd[i] == 0.0:
                raise ValueError(f"dof {dof.name!r} has a target and no gains; give kp, kd or both")
            if dof.joint.actuator_type() != dof.joint.FORCE:
                raise ValueError(f"dof {dof.name!r} has a target; its actuator takes no forces: set it to FORCE")

    def clear_targets(self) -> None:
        """Take all motors away."""
        self._handle.targets().clear()

    @property
    def targets(self) -> Targets | None:
        """What the motors follow, copies; None without any."""
        handle, like = self._handle.targets(), self._pattern
        if not handle.any():
            return None
        vectors = handle.q(like), handle.dq(like), handle.kp(like), handle.kd(like)
        return Targets(*vectors, _COMPENSATIONS[handle.compensation()])  # type: ignore[arg-type]

    def motor_forces(self) -> SkelVector:
        """What the motors did in the last step, shape (ndofs,), N m or N; zeros without targets."""
        return self._handle.targets().forces(self._pattern)

    def _fill(self, vector: SkelVector, values: ByName | None) -> Mask:
        """Writes values by name, or all; where it wrote."""
        written = np.zeros(len(vector), dtype=bool)
        if isinstance(values, SkelVector) and len(values) != len(vector) and values.keys:
            values = dict(zip(values.keys, values.tolist(), strict=True))
        if isinstance(values, Mapping):
            for name, value in values.items():
                vector[name] = value
                written[self.names.index(name)] = True
        elif isinstance(values, str):
            raise TypeError(f"targets by name are a dict, as {{{values!r}: 0.5}}")
        elif values is not None:
            whole = numbers(values, "targets")
            if whole.shape != vector.shape:
                raise ValueError(f"expected one number per dof, shape {vector.shape}, got {whole.shape}")
            vector[:] = whole
            written[:] = True
        return written
