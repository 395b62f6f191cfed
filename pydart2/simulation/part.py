"""What the parts of World know of the whole."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pydart2._native import WorldHandle
    from pydart2.cameras import MountedCamera
    from pydart2.collision_result import CollisionResult
    from pydart2.skeleton import Skeleton


class WorldPart:
    """The base of the parts of World."""

    skeletons: list[Skeleton]
    _cameras: dict[str, MountedCamera]
    collision_result: CollisionResult
    _handle: WorldHandle
    _step: Callable[[int], None]

    if TYPE_CHECKING:

        def _first_step(self, n: int) -> None: ...
        def _find_controllers(self) -> None: ...
