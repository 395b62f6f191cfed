"""The recorded frames of a world."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from pydart2.collision_result import CollisionResult
from pydart2.run import Run
from pydart2.skel_vector import DofArray

if TYPE_CHECKING:
    import os

    from matplotlib.axes import Axes
    from pandas import DataFrame
    from xarray import Dataset

    from pydart2.skeleton import Skeleton
    from pydart2.world import World


class Recording:
    """What a world did since its last reset: a frame per step with the states and the contacts.

    >>> recording = world.recording
    >>> recording.t, recording["j_knee"], recording.q(robot), recording.contacts(100).forces

    Frames are kept up to `limit_bytes`; the oldest go first. Arrays have a row for each kept frame, that is, they start
    at `first_frame`; they are NaN where a skeleton was not there yet, or its number has changed since.

    Attributes
    ----------
    world : World
    """

    def __init__(self, world: World) -> None:
        self.world = world

    @property
    def history(self) -> list[tuple[NDArray[np.float64], CollisionResult]]:
        """The kept frames, oldest first: states, shape (2 * sum of ndofs,), rad, m, rad/s and m/s, and contacts."""
        return [(self.states(i), self.contacts(i)) for i in range(self.first_frame, self.num_frames())]

    @property
    def limit_bytes(self) -> int:
        """Memory that the frames may take, 64 MB unless set."""
        return self.world._handle.recording_limit()

    @limit_bytes.setter
    def limit_bytes(self, limit: int) -> None:
        self.world._handle.set_recording_limit(limit)

    @property
    def num_bytes(self) -> int:
        """Memory that the frames take."""
        return self.world._handle.recording_bytes()

    @property
    def first_frame(self) -> int:
        """Index of the oldest frame that is kept."""
        return self.world._handle.first_frame()

    def num_frames(self) -> int:
        """How many frames there were, those that are gone included."""
        return self.world._handle.num_frames()

    def states(self, frame_index: int) -> NDArray[np.float64]:
        """[q, dq] of each skeleton at a kept frame, shape (2 * sum of ndofs,), rad, m, rad/s, m/s; or IndexError."""
        return self.world._handle.frame_states(frame_index)

    def contacts(self, frame_index: int) -> CollisionResult:
        """The contacts at a kept frame; IndexError if it is gone."""
        return CollisionResult.from_rows(self.world, self.world._handle.frame_contacts(frame_index))

    def sleepers(self, frame_index: int) -> list[Skeleton]:
        """The skeletons that slept at a kept frame, without those that have gone since; IndexError if it is gone."""
        indices = self.world._handle.frame_sleepers(frame_index).astype(int)
        skeletons = self.world.skeletons
        return [skeletons[i] for i in indices if i >= 0]

    # As arrays

    @property
    def run(self) -> Run:
        """All that is kept now, as arrays that need no world."""
        handle = self.world._handle
        rows = [handle.frame_contacts(i) for i in range(self.first_frame, self.num_frames())]
        return replace(self._run(), contact_rows=rows)

    @property
    def t(self) -> NDArray[np.float64]:
        """Simulated time of each kept frame, shape (n,), s."""
        return self.world._handle.recorded_times()

    def q(self, skeleton: Skeleton | str | int | None = None) -> DofArray:
        """Positions of a skeleton over time, shape (n, ndofs), rad or m; by name, index or object, or the only one.

        ``recording.q(robot)["j_knee"]`` has shape (n,).
        """
        return self._run().q(skeleton)

    def dq(self, skeleton: Skeleton | str | int | None = None) -> DofArray:
        """Velocities of a skeleton over time, shape (n, ndofs), rad/s or m/s; as q()."""
        return self._run().dq(skeleton)

    def __getitem__(self, dof: str) -> NDArray[np.float64]:
        """Position of a dof over time, shape (n,), rad or m; by its name, or as ``"skeleton.dof"``."""
        return self._run()[dof]

    def to_pandas(self) -> DataFrame:
        """As Run.to_pandas()."""
        return self._run().to_pandas()

    def to_xarray(self) -> Dataset:
        """As Run.to_xarray()."""
        return self._run().to_xarray()

    def to_csv(self, path: str | os.PathLike[str]) -> None:
        """As Run.to_csv()."""
        self._run().to_csv(path)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write all that is kept to an ``.npz`` file, contacts too, for load()."""
        self.run.save(path)

    @staticmethod
    def load(path: str | os.PathLike[str]) -> Run:
        """What save() wrote, as arrays that need no world; ValueError if it is another file."""
        return Run.load(path)

    def plot(self, *dofs: str, axes: Axes | None = None) -> Axes:
        """Plot positions of dofs over time, as Run.plot()."""
        return self._run().plot(*dofs, axes=axes)

    def _run(self) -> Run:
        handle, skeletons = self.world._handle, self.world.skeletons
        dofs = {skel.name: [dof.name for dof in skel.dofs] for skel in skeletons}
        return Run(handle.recorded_times(), handle.recorded_states(), dofs, handle.first_frame())

    def _ipython_key_completions_(self) -> list[str]:
        return self._run()._ipython_key_completions_()

    def __repr__(self) -> str:
        kept = self.num_frames() - self.first_frame
        return f"[Recording: {kept} frames from {self.first_frame}, {self.num_bytes / 1e6:.3g} MB]"

    def clear(self) -> None:
        """Forget all frames and record the present state as frame 0."""
        self.world._handle.clear_recording()

    def bake(self) -> None:
        """Record the present state as one frame more."""
        self.world._handle.record_frame()

    def set_frame(self, frame_index: int) -> bool:
        """Put the states and contacts of a frame back; False if it is not kept."""
        return self.world.set_frame(frame_index)
