"""Sensors that read as real ones do: rate, noise and bias; the numbers are the engine's."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pydart2.frames import Frame, SimpleFrame

if TYPE_CHECKING:
    from pydart2.bodynode import BodyNode
    from pydart2.dof import Dof
    from pydart2.joint import Joint
    from pydart2.world import World

Array = NDArray[np.float64]


class Sensor:
    """Something to read after a step; what a step's contacts and constraints did is in it.

    Parameters
    ----------
    noise
        Standard deviation of each number, in its unit; a number or shape (n,).
    bias
        Added to each number, in its unit; a number or shape (n,).
    rate
        Readings in a second of the world's time; between two it gives the last one. None: a new one each time step.
    seed
        Of the noise.

    Attributes
    ----------
    world : World
    labels : list of str
        A name for each of its numbers.
    """

    world: World
    labels: list[str]

    def __init__(
        self, *, noise: ArrayLike = 0.0, bias: ArrayLike = 0.0, rate: float | None = None, seed: int = 0
    ) -> None:
        if rate is not None and rate <= 0.0:
            raise ValueError(f"the rate of a sensor is > 0 readings in a second, got {rate}")
        self.noise = np.asarray(noise, dtype=float)
        self.bias = np.asarray(bias, dtype=float)
        self.rate = rate
        self._random = np.random.default_rng(seed)
        self._reading: tuple[float, Array] | None = None

    def measure(self) -> Array:
        """What there is, without rate, noise and bias, shape (n,), in the units of read()."""
        raise NotImplementedError

    def read(self) -> Array:
        """What the sensor says, shape (n,), in the units of its class. A copy."""
        period = 0.0 if self.rate is None else 1.0 / self.rate
        now = self.world.t
        if self._reading is None or now < self._reading[0] or now > self._reading[0] + period * (1.0 - 1e-9):
            value = self.measure() + self.bias
            self._reading = now, value + self.noise * self._random.standard_normal(len(value))
        return self._reading[1].copy()


class IMU(Sensor):
    """Accelerometer (m/s²), then gyroscope (rad/s), in the axes of a frame: shape (6,).

    The accelerometer reads ``R.T (a - g)``: 9.81 upwards at rest, zero in free fall.

    Parameters
    ----------
    frame
        A body, or a SimpleFrame in one.
    """

    def __init__(
        self,
        frame: BodyNode | SimpleFrame,
        *,
        noise: ArrayLike = 0.0,
        bias: ArrayLike = 0.0,
        rate: float | None = None,
        seed: int = 0,
    ) -> None:
        super().__init__(noise=noise, bias=bias, rate=rate, seed=seed)
        self.frame: Frame = frame
        self._body, self._offset = _place(frame)
        self.world = self._body.skeleton.world
        self.labels = [f"{self._body.name}.{kind}_{axis}" for kind in ("acceleration", "rate") for axis in "xyz"]

    def measure(self) -> Array:
        """What there is, without rate, noise and bias, shape (6,), m/s² and rad/s."""
        back = self.frame.T[:3, :3].T
        a = self._body.world_linear_acceleration(self._offset) - self.world.gravity()
        return np.concatenate([back @ a, back @ self._body.world_angular_velocity()])


class JointEncoder(Sensor):
    """Positions of dofs, shape (n,), rad or m.

    Parameters
    ----------
    dofs
        One or more, of one skeleton.
    """

    def __init__(
        self,
        dofs: Sequence[Dof],
        *,
        noise: ArrayLike = 0.0,
        bias: ArrayLike = 0.0,
        rate: float | None = None,
        seed: int = 0,
    ) -> None:
        super().__init__(noise=noise, bias=bias, rate=rate, seed=seed)
        if not dofs:
            raise ValueError("a JointEncoder needs a dof")
        self.dofs = list(dofs)
        self.world = self.dofs[0].skeleton.world
        self.labels = [f"{dof.name}.position" for dof in self.dofs]

    def measure(self) -> Array:
        """What there is, without rate, noise and bias, shape (n,), rad or m."""
        q = self.dofs[0].skeleton.q
        return np.array([q[dof.id] for dof in self.dofs])


class ForceTorque(Sensor):
    """Moment (N m), then force (N), through a joint on its child, in the joint's axes there: shape (6,).

    Parameters
    ----------
    joint
        The joint that it sits in; a weld between two links of a hand, for one. See Joint.wrench().
    """

    def __init__(
        self,
        joint: Joint,
        *,
        noise: ArrayLike = 0.0,
        bias: ArrayLike = 0.0,
        rate: float | None = None,
        seed: int = 0,
    ) -> None:
        super().__init__(noise=noise, bias=bias, rate=rate, seed=seed)
        self.joint = joint
        self.world = joint.skeleton.world
        self.labels = [f"{joint.name}.{kind}_{axis}" for kind in ("moment", "force") for axis in "xyz"]

    def measure(self) -> Array:
        """What there is, without rate, noise and bias, shape (6,), N m and N."""
        return self.joint.wrench()


class Touch(Sensor):
    """How hard a body is pressed: the sum of its contact forces along their normals, shape (1,), N.

    Parameters
    ----------
    body
        The body.
    """

    def __init__(
        self,
        body: BodyNode,
        *,
        noise: ArrayLike = 0.0,
        bias: ArrayLike = 0.0,
        rate: float | None = None,
        seed: int = 0,
    ) -> None:
        super().__init__(noise=noise, bias=bias, rate=rate, seed=seed)
        self.body = body
        self.world = body.skeleton.world
        self.labels = [f"{body.name}.pressure"]

    def measure(self) -> Array:
        """What there is, without rate, noise and bias, shape (1,), N."""
        contacts = self.body.contacts
        return np.array([np.einsum("ij,ij->", contacts.forces, contacts.normals)])


class Sensors:
    """Several sensors as one array.

    >>> sensors = Sensors([IMU(robot.body("pelvis")), JointEncoder(robot.dofs)])
    >>> world.step()
    >>> observation = sensors.read()

    Attributes
    ----------
    sensors : list of Sensor
    labels : list of str
        A name for each number.
    """

    def __init__(self, sensors: Iterable[Sensor]) -> None:
        self.sensors = list(sensors)
        self.labels = [label for sensor in self.sensors for label in sensor.labels]

    def read(self) -> Array:
        """The readings one after another, shape (n,), in the units of each sensor."""
        return np.concatenate([sensor.read() for sensor in self.sensors]) if self.sensors else np.empty(0)


def _place(frame: BodyNode | SimpleFrame) -> tuple[BodyNode, Array | None]:
    """The body that carries a frame, and where the frame is in it."""
    if not isinstance(frame, SimpleFrame):
        return frame, None
    if frame.parent is None:
        raise ValueError("an IMU sits on a body; this frame is fixed in the world")
    return frame.parent, frame.relative[:3, 3]
