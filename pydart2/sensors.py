"""Sensors that read as real ones do: rate, noise and bias; the numbers are the engine's."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pydart2.bodynode import BodyNode
from pydart2.dof import Dof
from pydart2.frames import Frame, SimpleFrame
from pydart2.given import number, numbers
from pydart2.joint import Joint
from pydart2.skeleton import Skeleton

if TYPE_CHECKING:
    from pydart2.batch import Batch
    from pydart2.collision_filter import Bodies
    from pydart2.world import World

Array = NDArray[np.float64]

MOST_RAYS = 10_000_000


class Sampled:
    """Something that is looked at some times in a second of a world's time.

    Parameters
    ----------
    world
        Whose time it is.
    rate
        Times in a second, > 0; between two there is the last reading. None: each time step.
    """

    def __init__(self, world: World, rate: float | None = None) -> None:
        self._world = world
        self.rate = rate
        self._read_at: float | None = None

    @property
    def world(self) -> World:
        """The world that it reads in."""
        return self._world

    @property
    def rate(self) -> float | None:
        """Readings in a second of the world's time, > 0; None for a new one each time step."""
        return self._rate

    @rate.setter
    def rate(self, rate: float | None) -> None:
        if rate is not None and not 0.0 < number(rate, "rate") < float("inf"):
            raise ValueError(f"the rate of a sensor is > 0 readings in a second, or None for each step; got {rate!r}")
        self._rate = rate

    def _is_due(self) -> bool:
        """Whether it is time for another reading; if so, that has been made."""
        period = 0.0 if self._rate is None else 1.0 / self._rate
        now, last = self._world.t, self._read_at
        due = last is None or now < last or now > last + period * (1.0 - 1e-9)
        if due:
            self._read_at = now
        return due


class Sensor(Sampled):
    """Something to read after a step; what a step's contacts and constraints did is in it.

    Parameters
    ----------
    world
        Whose time it reads by.
    labels
        A name for each of its numbers.
    noise
        Standard deviation of each number, in its unit; a number or shape (n,).
    bias
        Added to each number, in its unit; a number or shape (n,).
    rate
        Readings in a second of the world's time; between two it gives the last one. None: a new one each time step.
    seed
        Of the noise.
    """

    def __init__(
        self,
        world: World,
        labels: Iterable[str],
        *,
        noise: ArrayLike = 0.0,
        bias: ArrayLike = 0.0,
        rate: float | None = None,
        seed: int = 0,
    ) -> None:
        super().__init__(world, rate)
        self._labels = tuple(labels)
        self.noise = noise
        self.bias = bias
        self._random = np.random.default_rng(seed)
        self._reading: Array = np.empty(0)

    @property
    def labels(self) -> list[str]:
        """A name for each of its numbers."""
        return list(self._labels)

    @property
    def noise(self) -> Array:
        """Standard deviation of each number, shape (n,), in its unit; set by a number or shape (n,), >= 0."""
        return self._noise.copy()

    @noise.setter
    def noise(self, noise: ArrayLike) -> None:
        values = self._each(noise, "noise")
        if (values < 0.0).any():
            raise ValueError(f"the noise of a sensor is a standard deviation >= 0, got {noise!r}")
        self._noise = values

    @property
    def bias(self) -> Array:
        """What is added to each number, shape (n,), in its unit; set by a number or shape (n,)."""
        return self._bias.copy()

    @bias.setter
    def bias(self, bias: ArrayLike) -> None:
        self._bias = self._each(bias, "bias")

    def _each(self, values: ArrayLike, what: str) -> Array:
        """A number for each of the sensor's."""
        given = numbers(values, f"the {what} of a sensor")
        n = len(self._labels)
        if given.shape not in ((), (n,)) or not np.isfinite(given).all():
            raise ValueError(
                f"the {what} of this sensor is a finite number, or one for each of its {n}; got {values!r}"
            )
        return np.array(np.broadcast_to(given, n))

    def measure(self) -> Array:
        """What there is, without rate, noise and bias, shape (n,), in the units of read()."""
        raise NotImplementedError

    def read(self) -> Array:
        """What the sensor says, shape (n,), in the units of its class. A copy."""
        if self._is_due():
            value = self.measure() + self._bias
            self._reading = value + self._noise * self._random.standard_normal(len(value))
        return self._reading.copy()


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
        self._body, self._offset = _place(frame)
        self._frame: Frame = frame
        labels = [f"{self._body.name}.{kind}_{axis}" for kind in ("acceleration", "rate") for axis in "xyz"]
        super().__init__(self._body.skeleton.world, labels, noise=noise, bias=bias, rate=rate, seed=seed)

    @property
    def frame(self) -> Frame:
        """Where it sits."""
        return self._frame

    def measure(self) -> Array:
        """What there is, without rate, noise and bias, shape (6,), m/s² and rad/s."""
        a = self._body.world_linear_acceleration(self._offset) - self.world.gravity()
        both = np.array([a, self._body.world_angular_velocity()])
        turned: Array = np.einsum("ij,kj->ki", self._frame.T[:3, :3].T, both)  # not by BLAS: the same bits everywhere
        return turned.ravel()


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
        if not isinstance(dofs, Iterable) or not all(isinstance(dof, Dof) for dof in dofs):
            raise TypeError(f"a JointEncoder is of a list of dofs, as robot.dofs, got {dofs!r}")
        if not dofs:
            raise ValueError("a JointEncoder needs a dof")
        self._skeleton = dofs[0].skeleton
        for dof in dofs:
            if dof.skeleton is not self._skeleton:
                raise ValueError(
                    f"the dofs of a JointEncoder are of one skeleton; {dof!r} is not of {self._skeleton!r}"
                )
        self._dofs = tuple(dofs)
        labels = [f"{dof.name}.position" for dof in dofs]
        super().__init__(self._skeleton.world, labels, noise=noise, bias=bias, rate=rate, seed=seed)

    @property
    def dofs(self) -> list[Dof]:
        """What it reads."""
        return list(self._dofs)

    def measure(self) -> Array:
        """What there is, without rate, noise and bias, shape (n,), rad or m."""
        q = self._skeleton.q
        return np.array([q[dof.id] for dof in self._dofs])


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
        if not isinstance(joint, Joint):
            raise TypeError(f"a ForceTorque sits in a joint, as robot.joint(0), got {joint!r}")
        self._joint = joint
        labels = [f"{joint.name}.{kind}_{axis}" for kind in ("moment", "force") for axis in "xyz"]
        super().__init__(joint.skeleton.world, labels, noise=noise, bias=bias, rate=rate, seed=seed)

    @property
    def joint(self) -> Joint:
        """What it sits in."""
        return self._joint

    def measure(self) -> Array:
        """What there is, without rate, noise and bias, shape (6,), N m and N."""
        return self._joint.wrench()


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
        if not isinstance(body, BodyNode):
            raise TypeError(f"a Touch is of a body, as robot.body(0), got {body!r}")
        self._body = body
        world, labels = body.skeleton.world, [f"{body.name}.pressure"]
        super().__init__(world, labels, noise=noise, bias=bias, rate=rate, seed=seed)

    @property
    def body(self) -> BodyNode:
        """What is pressed."""
        return self._body

    def measure(self) -> Array:
        """What there is, without rate, noise and bias, shape (1,), N."""
        contacts = self._body.contacts
        return np.array([np.einsum("ij,ij->", contacts.forces, contacts.normals)])


class Lidar(Sensor):
    """Distances to what rays hit first, shape (n,), m; infinite where there is nothing.

    >>> lidar = Lidar(robot.body("head"), Lidar.fan(np.pi, 181), max_distance=30.0)

    Rays pass through the body that it sits on, and through soft bodies; see World.raycast().

    Parameters
    ----------
    frame
        A body, or a SimpleFrame in one; the rays begin at its origin.
    directions
        Shape (n, 3), of any length, in the frame.
    max_distance
        What is farther away is not seen, m.
    ignore
        Other bodies, skeletons or their names that rays pass through, as of World.exclude_collisions().
    """

    def __init__(
        self,
        frame: BodyNode | SimpleFrame,
        directions: ArrayLike,
        *,
        max_distance: float = np.inf,
        ignore: Bodies = (),
        noise: ArrayLike = 0.0,
        bias: ArrayLike = 0.0,
        rate: float | None = None,
        seed: int = 0,
    ) -> None:
        self._body, _ = _place(frame)
        self._frame: Frame = frame
        self._directions = np.array(numbers(directions, "directions"))
        if self._directions.ndim != 2 or self._directions.shape[1] != 3 or not np.any(self._directions, axis=1).all():
            raise ValueError(f"the directions of a lidar have the shape (n, 3), none of them 0; got {directions!r}")
        self._max_distance = max_distance
        self._ignore = [self._body, *([ignore] if isinstance(ignore, str | BodyNode | Skeleton) else ignore)]
        labels = [f"{self._body.name}.range_{i}" for i in range(len(self._directions))]
        super().__init__(self._body.skeleton.world, labels, noise=noise, bias=bias, rate=rate, seed=seed)

    @staticmethod
    def fan(angle: float, n: int) -> Array:
        """Directions in the x-y plane from -angle / 2 to angle / 2 (rad) about x, shape (n, 3), of length 1."""
        if not 0 < n <= MOST_RAYS:
            raise ValueError(f"a fan has 1 to {MOST_RAYS:,} rays, got {n}")
        angles = np.linspace(-angle / 2.0, angle / 2.0, n)
        return np.stack([np.cos(angles), np.sin(angles), np.zeros(n)], axis=1)

    @property
    def frame(self) -> Frame:
        """Where it sits."""
        return self._frame

    @property
    def directions(self) -> Array:
        """Of the rays, in the frame, shape (n, 3), without unit."""
        return self._directions.copy()

    def measure(self) -> Array:
        """What there is, without rate, noise and bias, shape (n,), m."""
        pose = self._frame.T
        along = self._directions @ pose[:3, :3].T
        return self.world.raycast(pose[:3, 3], along, self._max_distance, ignore=self._ignore).distances


class Sensors:
    """Several sensors as one array.

    >>> sensors = Sensors([IMU(robot.body("pelvis")), JointEncoder(robot.dofs)])
    >>> world.step()
    >>> observation = sensors.read()

    Attributes
    ----------
    sensors : list of Sensor
        May be changed.
    """

    def __init__(self, sensors: Iterable[Sensor]) -> None:
        self.sensors = list(sensors)

    @property
    def labels(self) -> list[str]:
        """A name for each number."""
        return [label for sensor in self.sensors for label in sensor.labels]

    def read(self) -> Array:
        """The readings one after another, shape (n,), in the units of each sensor."""
        return np.concatenate([sensor.read() for sensor in self.sensors]) if self.sensors else np.empty(0)


class BatchSensors:
    """The same sensors in each world of a batch, as one array.

    >>> sensors = BatchSensors(batch, lambda world: JointEncoder(world.skeletons[1].dofs))
    >>> batch.step()
    >>> observations = sensors.read()

    Parameters
    ----------
    batch
        Whose worlds they read in.
    make
        Gives the sensor or Sensors of a world.
    """

    def __init__(self, batch: Batch, make: Callable[[World], Sensor | Sensors]) -> None:
        self._of_worlds = [make(world) for world in batch.worlds]

    @property
    def labels(self) -> list[str]:
        """A name for each number of a world."""
        return self._of_worlds[0].labels if self._of_worlds else []

    def read(self) -> Array:
        """The readings, a row for each of the N worlds, shape (N, n), in the units of each sensor."""
        return np.array([sensors.read() for sensors in self._of_worlds]).reshape(len(self._of_worlds), -1)


def _place(frame: BodyNode | SimpleFrame) -> tuple[BodyNode, Array | None]:
    """The body that carries a frame, and where the frame is in it."""
    if isinstance(frame, BodyNode):
        return frame, None
    if not isinstance(frame, SimpleFrame):
        raise TypeError(f"a sensor sits on a body or a SimpleFrame in one, got {frame!r}")
    if frame.parent is None:
        raise ValueError("a sensor sits on a body; this frame is fixed in the world")
    return frame.parent, frame.relative[:3, 3]
