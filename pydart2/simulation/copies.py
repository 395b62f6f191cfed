"""Going back, and worlds that are equal to another one."""

from __future__ import annotations

import copy
from typing import TYPE_CHECKING, Any, cast

import numpy as np
from numpy.typing import NDArray

from pydart2._native import WorldHandle
from pydart2.collision_result import CollisionResult
from pydart2.simulation.part import WorldPart
from pydart2.state import Snapshot, model_hash

if TYPE_CHECKING:
    from pydart2.skeleton import Skeleton
    from pydart2.world import World


def rebuild(
    cls: type[World],
    blueprint: tuple[Any, ...],
    contacts: NDArray[np.float64],
    recording_limit: int | None,
    classes: list[type[Skeleton]],
) -> World:
    """The world of Copies.__reduce__, in its own or another process; contacts of shape (n, 16), m and N."""
    world = cls.__new__(cls)
    world._handle = WorldHandle.rebuild(blueprint)
    world._begin()
    world.skeletons = [skeleton_class._of_world(world, i) for i, skeleton_class in enumerate(classes)]
    world.collision_result = CollisionResult.from_rows(world, contacts)
    if recording_limit is not None:
        world.enable_recording()
        world._handle.set_recording_limit(recording_limit)
    return world


class Copies(WorldPart):
    """The part of World that keeps its state and copies the whole."""

    _copies_exactly = True  # clone(exact=False) takes it back for as long as it copies

    def snapshot(self, exact: bool = True) -> Snapshot:
        """All that a step changes and the next one depends on, for restore().

        The world's next steps are bit for bit those after restore(), with every detector. For that it forgets what
        detectors and constraints remember of earlier steps, which is in no snapshot: the order of its next contacts may
        differ from that of a world that was left alone, and with it their last bits. A fall of the humanoid in
        `skel/fullbody1.skel` is another one after a second or two. ``exact=False`` changes nothing here.

        Raises SimulationError if the world has blown up and reads NaN.
        """
        if exact:
            self._forget_history()
        values = self._handle.snapshot()
        return Snapshot(values, self.collision_result.rows, model_hash(self._handle))

    def _forget_history(self) -> None:
        """What the detector and the constraints remember of earlier steps, but not the contacts of the last one."""
        self.collision_result = self.collision_result.copy()
        self._handle.forget_history()

    def restore(self, snapshot: Snapshot, strict: bool = True) -> None:
        """Put the state of a snapshot back, of this world or of one with an equal model. The recording goes on.

        Raises ValueError if the model is another one or has changed since: skeletons, masses, limits, gravity, time
        step and so on. With ``strict=False`` only the number of states must fit.
        """
        if not isinstance(snapshot, Snapshot):
            raise TypeError(f"a world is restored from what its snapshot() gave, not from {snapshot!r}")
        if strict and snapshot.model != model_hash(self._handle):
            raise ValueError(
                f"{snapshot!r} is of another model than {self!r}, or the model has changed since; "
                "restore(snapshot, strict=False) takes it nevertheless"
            )
        self._handle.restore(snapshot.values)
        self.collision_result = CollisionResult.from_rows(cast("World", self), snapshot.contacts)

    def clone(self, exact: bool = True) -> World:
        """A world of its own that is equal in everything: model, all changes to it, state, and the user's attributes.

        It is made anew from the texts that were loaded, and then brought to where this one is; files of meshes must
        still be there.
        Controllers and attributes are deep copies that refer to the clone. The clone records if this world does, from
        now on. Both go on bit for bit alike; for `exact` see snapshot(). ``copy.deepcopy`` does the same, and
        ``pickle`` does it across processes.

        Raises LoadError if such a file is gone.
        """
        world = cast("World", self)
        if exact:
            return copy.deepcopy(world)
        self._copies_exactly = False
        try:
            return copy.deepcopy(world)
        finally:
            del self._copies_exactly

    def __copy__(self) -> World:
        return self.clone()

    def __reduce__(self) -> tuple[object, ...]:
        if self._copies_exactly:
            self._forget_history()
        blueprint = self._handle.blueprint()
        recording_limit = self._handle.recording_limit() if self._handle.is_recording() else None
        classes = [type(skel) for skel in self.skeletons]
        made_anew = (
            "_handle",
            "_step",
            "id",
            "recording",
            "collision_result",
            "collision_filter",
            "_under_construction",
            "_copies_exactly",
            "_queries",
        )
        state = {name: value for name, value in self.__dict__.items() if name not in made_anew}
        return rebuild, (type(self), blueprint, self.collision_result.rows, recording_limit, classes), state
