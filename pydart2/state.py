"""The state of a world, to go back to and to keep."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from pydart2._native import WorldHandle

VERSION = 1


def model_hash(handle: WorldHandle) -> str:
    """A digest of all that is not state: names, trees, masses, limits, shapes, gravity, detector and so on."""
    if known := handle.known_model_digest():
        return known
    import hashlib  # a twentieth of the package's import

    digest = hashlib.sha256(handle.model_numbers().tobytes())
    digest.update("\0".join(handle.model_texts()).encode("utf-8", "surrogateescape"))
    handle.remember_model_digest(digest.hexdigest())
    return digest.hexdigest()


def part_of(owner: object, parts: str, index: int) -> Any:
    """A part of a pickled or copied skeleton or body: it is looked up in the new one."""
    return getattr(owner, parts)[index]


class Snapshot:
    """All that a step changes and the next one depends on, as numbers.

    >>> start = world.snapshot()
    >>> world.step(100)
    >>> world.restore(start)

    Positions, velocities, accelerations, forces, commands, external forces, constraint impulses, the points of soft
    bodies, time, frame, contacts, and what a warm start remembers; from World.snapshot(). It holds no reference to its
    world, can be pickled, and can be saved. The recording is not in it.

    Attributes
    ----------
    values : array, shape (n,)
        The numbers, time and frame first; read-only.
    contacts : array, shape (m, 16)
        The contacts of the last step (`CollisionResult.rows`); read-only.
    model : str
        Digest of the model that it belongs to.
    """

    __slots__ = ("contacts", "model", "values")

    def __init__(self, values: NDArray[np.float64], contacts: NDArray[np.float64], model: str) -> None:
        self.values = values
        self.contacts = contacts
        self.model = model
        for array in (values, contacts):
            array.flags.writeable = False

    @property
    def time(self) -> float:
        """Simulated time, s."""
        return float(self.values[0])

    @property
    def frame(self) -> int:
        """Steps since the last reset."""
        return int(self.values[1])

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write it to an ``.npz`` file, without pickled objects."""
        with open(os.fspath(path), "wb") as file:  # a number would be a file descriptor
            np.savez(file, version=VERSION, model=self.model, values=self.values, contacts=self.contacts)

    @staticmethod
    def load(path: str | os.PathLike[str]) -> Snapshot:
        """Read a file that save() wrote; ValueError if it is another file or of another version."""
        try:
            with np.load(path, allow_pickle=False) as file:
                parts: dict[str, Any] = {name: file[name] for name in ("version", "model", "values", "contacts")}
        except (KeyError, ValueError, EOFError, np.exceptions.AxisError) as error:
            raise ValueError(f"{os.fspath(path)!r} is not a snapshot: {error}") from None
        if parts["version"] != VERSION:
            raise ValueError(f"{os.fspath(path)!r} is a snapshot of version {parts['version']}, not of {VERSION}")
        return Snapshot(parts["values"].astype(float), parts["contacts"].astype(float), str(parts["model"]))

    def __eq__(self, other: object) -> bool:
        """Whether all bits are equal."""
        return isinstance(other, Snapshot) and self.model == other.model and self._bits() == other._bits()

    def __hash__(self) -> int:
        return hash(self._bits())

    def _bits(self) -> bytes:
        return self.values.tobytes() + self.contacts.tobytes()

    def __reduce__(self) -> tuple[Any, ...]:
        return Snapshot, (np.array(self.values), np.array(self.contacts), self.model)

    def __repr__(self) -> str:
        return f"[Snapshot: time {self.time:.4f} frame {self.frame} of model {self.model[:8]}]"
