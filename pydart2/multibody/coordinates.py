"""The generalized coordinates of a skeleton: q, dq, ddq, their limits, forces and commands."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy import ndarray
from numpy.typing import ArrayLike, NDArray

from pydart2.alias import Alias, Settable, also, forwards
from pydart2.multibody.structure import Structure
from pydart2.skel_vector import SkelVector


class Coordinates(Structure):
    """The part of Skeleton that reads and sets its state."""

    @forwards("_pattern")
    def positions(self, out: SkelVector | None = None) -> SkelVector:
        """Generalized positions, shape (ndofs,), rad or m. A copy."""
        return self._handle.positions(self._pattern if out is None else out)

    @forwards()
    def set_positions(self, _q: ArrayLike | Mapping[str, float] | None = None, **by_name: float) -> None:
        """Set the generalized positions, shape (ndofs,), rad or m.

        Or some of them by name: ``set_positions({"j_knee": 0.4}, j_hip=0.1)``.
        """
        if isinstance(_q, ndarray) and not by_name:  # the usual case, told without a call
            self._handle.set_positions(_q)
        else:
            self._handle.set_positions(self._vector(_q, by_name, "q"))

    q = Settable(positions, set_positions)

    set_q = also(set_positions)

    @forwards("_pattern")
    def velocities(self, out: SkelVector | None = None) -> SkelVector:
        """Generalized velocities, shape (ndofs,), rad/s or m/s. A copy."""
        return self._handle.velocities(self._pattern if out is None else out)

    @forwards()
    def set_velocities(self, _qdot: ArrayLike | Mapping[str, float] | None = None, **by_name: float) -> None:
        """Set the generalized velocities, shape (ndofs,), rad/s or m/s, or some of them by name."""
        if isinstance(_qdot, ndarray) and not by_name:
            self._handle.set_velocities(_qdot)
        else:
            self._handle.set_velocities(self._vector(_qdot, by_name, "dq"))

    dq = Settable(velocities, set_velocities)

    set_dq = also(set_velocities)

    @forwards("_pattern")
    def accelerations(self, out: SkelVector | None = None) -> SkelVector:
        """Generalized accelerations of the last step, shape (ndofs,), rad/s² or m/s². A copy."""
        return self._handle.accelerations(self._pattern if out is None else out)

    @forwards()
    def set_accelerations(self, _ddq: ArrayLike) -> None:
        """Set the generalized accelerations, shape (ndofs,), rad/s² or m/s²."""
        self._handle.set_accelerations(_ddq)

    ddq = Settable(accelerations, set_accelerations)

    @forwards(None)
    def states(self, out: NDArray[np.float64] | None = None) -> NDArray[np.float64]:
        """[q, dq], shape (2 * ndofs,), rad, m, rad/s and m/s."""
        return self._handle.states(out)

    @forwards()
    def set_states(self, _x: ArrayLike) -> None:
        """Set [q, dq], shape (2 * ndofs,), rad, m, rad/s and m/s."""
        self._handle.set_states(_x)

    x = Settable(states, set_states)

    def position_differences(self, _q1: ArrayLike, _q2: ArrayLike) -> NDArray[np.float64]:
        """``q1 - q2`` on the configuration manifold (log map for ball and free joints), shape (ndofs,), rad or m."""
        return self._handle.position_differences(_q1, _q2)

    def integrate_positions(self, q: ArrayLike, change: ArrayLike) -> NDArray[np.float64]:
        """`q` moved along `change`, shape (ndofs,), rad or m: the opposite of position_differences().

        ``q + change`` for most joints; free and ball joints turn on from where they are (exponential map).
        """
        return self._handle.integrate_positions(q, change)

    def velocity_differences(self, _dq1: ArrayLike, _dq2: ArrayLike) -> NDArray[np.float64]:
        """``dq1 - dq2``, shape (ndofs,), rad/s or m/s."""
        return self._handle.velocity_differences(_dq1, _dq2)

    # Limits

    @forwards()
    def position_lower_limits(self) -> NDArray[np.float64]:
        """Lower limits of q, shape (ndofs,), rad or m; -inf for none."""
        return self._handle.position_lower_limits()

    q_lower = Alias(position_lower_limits)

    @forwards()
    def position_upper_limits(self) -> NDArray[np.float64]:
        """Upper limits of q, shape (ndofs,), rad or m; inf for none."""
        return self._handle.position_upper_limits()

    q_upper = Alias(position_upper_limits)

    @forwards()
    def force_lower_limits(self) -> NDArray[np.float64]:
        """Lower limits of tau, shape (ndofs,), N m or N; -inf for none."""
        return self._handle.force_lower_limits()

    tau_lower = Alias(force_lower_limits)

    @forwards()
    def force_upper_limits(self) -> NDArray[np.float64]:
        """Upper limits of tau, shape (ndofs,), N m or N; inf for none."""
        return self._handle.force_upper_limits()

    tau_upper = Alias(force_upper_limits)

    # Forces and commands

    def forces(self) -> SkelVector:
        """The generalized forces last set, shape (ndofs,), N m or N; zeros before. A copy.

        They stay after the step that used them, in which the engine clears its own.
        """
        return self._handle.last_forces(self._pattern)

    @forwards()
    def set_forces(self, _tau: ArrayLike | Mapping[str, float] | None = None, **by_name: float) -> None:
        """Set the generalized forces of the next step, shape (ndofs,), N m or N; or some by name, the others zero."""
        if isinstance(_tau, ndarray) and not by_name:
            self._handle.set_forces(_tau)
        else:
            self._handle.set_forces(self._vector(_tau, by_name, ""))

    tau = Settable(forces, set_forces)

    set_tau = also(set_forces)

    @forwards("_pattern")
    def commands(self, out: SkelVector | None = None) -> SkelVector:
        """Commands to the actuators, shape (ndofs,), in the unit of each joint's actuator type. A copy."""
        return self._handle.commands(self._pattern if out is None else out)

    @forwards()
    def set_commands(self, _commands: ArrayLike | Mapping[str, float] | None = None, **by_name: float) -> None:
        """Set the commands of the next step, shape (ndofs,), or some by name.

        A command is a force for FORCE joints (N m or N), a velocity for SERVO and VELOCITY (rad/s or m/s), an
        acceleration for ACCELERATION (rad/s² or m/s²).
        """
        if isinstance(_commands, ndarray) and not by_name:
            self._handle.set_commands(_commands)
        else:
            self._handle.set_commands(self._vector(_commands, by_name, "comms"))

    comms = Settable(commands, set_commands)

    def _vector(self, values: ArrayLike | Mapping[str, float] | None, by_name: dict[str, float], rest: str) -> Any:
        """A whole vector as it is; entries by name in the vector of the name `rest`, or in zeros if that is empty."""
        if values is not None and not isinstance(values, Mapping):
            if by_name:
                raise TypeError("give a whole vector or entries by name, not both")
            return values
        vector = getattr(self, rest) if rest else self._pattern.copy()
        for name, value in {**(values or {}), **by_name}.items():
            vector[name] = value
        return vector
