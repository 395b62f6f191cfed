"""Which way is up: what a world says, and what pictures of it take.

`World.up` is what the world was made with, ``World(dt, up="z")``, else against gravity. Pictures take it too, but for
one case: where nobody chose, the gravity is the one that every world has at first, along -y, and all models come from
formats whose z axis is up (URDF, SDF, MJCF), they take z.
"""

from __future__ import annotations

import logging
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import NDArray

from pydart2.errors import NameNotFound
from pydart2.simulation.part import WorldPart

if TYPE_CHECKING:
    from pydart2.loading.readable import Readable

Axis = Literal["x", "y", "z"]
Array = NDArray[np.float64]

GRAVITY = 9.81  # m/s²
_AXES = "xyz"
#: Root elements of the formats whose z axis is up.
_Z_UP = ("robot", "sdf", "mujoco", "world")
_log = logging.getLogger("pydart2")


def is_z_up(model: Readable) -> bool:
    """Whether the z axis is up in a file's format."""
    return model.document.root.tag in _Z_UP


def check(axis: Axis | None) -> None:
    """NameNotFound for what is no axis, TypeError for what is no name."""
    if axis is None:
        return
    if not isinstance(axis, str):
        raise TypeError(f"up is 'x', 'y' or 'z', not {axis!r}; world.g = ... sets any other gravity")
    if axis not in tuple(_AXES):
        raise NameNotFound("axis", axis, "up: x, y or z", _AXES)


def unit(axis: Axis) -> Array:
    """The unit vector of an axis, shape (3,)."""
    vector = np.zeros(3)
    vector[_AXES.index(axis)] = 1.0
    return vector


class Upright(WorldPart):
    """The part of World that knows which way is up."""

    _up: Array | None = None
    _has_gravity: bool = False  # whether it is somebody's, not what every world has at first
    _said_up: bool = False

    @property
    def up(self) -> Array:
        """Which way is up, a unit vector of shape (3,).

        What the world was made with, ``World(dt, up="z")``, which stays when gravity changes; else against gravity.
        Without gravity it is y, and z if all models come from formats whose z axis is up: URDF, SDF, MJCF.
        """
        return self._upwards()

    def _upwards(self) -> Array:
        if self._up is not None:
            return self._up.copy()
        return _against(self._handle.gravity(), "z" if self._has_z_up_models() else "y")

    def _up_in_pictures(self) -> Array:
        return unit("z") if self._is_along_y_unasked() and self._has_z_up_models() else self._upwards()

    def _has_z_up_models(self) -> bool:
        return bool(self.skeletons) and all(skel._z_up for skel in self.skeletons)

    def _stand(self, axis: Axis | None, own_gravity: bool) -> None:
        """Take the axis that a new world is made with; ValueError if the gravity that a file brought is against it."""
        self._has_gravity = own_gravity
        if axis is not None:
            self._up = unit(axis)
        if not own_gravity:
            self._handle.set_gravity(_along(axis or "y"))
            return
        gravity = self._handle.gravity()
        if self._up is not None and -gravity @ self._up < 0.5 * float(np.linalg.norm(gravity)):
            self._handle.destroy()
            raise ValueError(f"up={axis!r} is against the file's gravity, {gravity}: leave it out")

    def _is_along_y_unasked(self) -> bool:
        """Whether nobody chose up or gravity, so that it is along -y."""
        return self._up is None and not self._has_gravity and np.array_equal(self._handle.gravity(), _along("y"))

    def _say_which_way_is_up(self) -> None:
        """Warn once where z-up models are about to fall along -y because nobody chose."""
        formats = {skel._z_up for skel in self.skeletons}
        if not self._said_up and True in formats and False not in formats and self._is_along_y_unasked():
            self._said_up = True
            _log.warning('the models are z-up, gravity is along -y: World(dt, up="z")')


def up_of(sim: Any) -> Array:
    """Which way is up in pictures of a simulation, by its gravity() if it is no world; a unit vector, shape (3,)."""
    if hasattr(sim, "_up_in_pictures"):
        return np.asarray(sim._up_in_pictures(), dtype=float)
    return _against(sim.gravity()) if hasattr(sim, "gravity") else unit("y")


def _along(up: Axis) -> Array:
    gravity = np.zeros(3)  # whose zeros have no sign, as those of -g * unit would
    gravity[_AXES.index(up)] = -GRAVITY
    return gravity


def _against(gravity: Array, otherwise: Axis = "y") -> Array:
    strength = float(np.linalg.norm(gravity))
    return -gravity / strength if strength > 0.0 else unit(otherwise)
