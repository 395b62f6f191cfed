"""Files that hold several skeletons, added to a world that is there."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, ClassVar

from numpy.typing import ArrayLike

from pydart2.building.poses import pose

if TYPE_CHECKING:
    from pydart2._native import WorldHandle
    from pydart2.loading import Missing, Source
    from pydart2.skeleton import Skeleton


class Scenes:
    """The part of World that takes all skeletons of a file."""

    _handle: WorldHandle

    if TYPE_CHECKING:  # what World has
        CLASS_SKELETON: ClassVar[type[Skeleton]]

        def _go_back(self, num_skeletons: int) -> None: ...

    def add_skeletons(
        self,
        filename: Source,
        *,
        only: str | Iterable[str] | None = None,
        position: ArrayLike = (0.0, 0.0, 0.0),
        orientation: ArrayLike | None = None,
        CLASS: type[Skeleton] | None = None,
        packages: Mapping[str, str | os.PathLike[str]] | None = None,
        missing_meshes: Missing = "error",
        safe: bool | None = None,
        engine_defaults: bool = False,
        strict: bool = False,
        enforce_limits: bool = False,
    ) -> list[Skeleton]:
        """Add the skeletons of a SKEL or SDF file, a world or not, without its gravity and time step.

        Parameters
        ----------
        filename
            As for `add_skeleton`.
        only
            The name of one, or names, in the order in which they are added; None for all, in that of the file.
        position, orientation
            Where the origin of the file is in the world: shape (3,), m; a quaternion [w, x, y, z] or a (3, 3) matrix.
        CLASS, packages, missing_meshes, safe, engine_defaults, strict, enforce_limits
            As for `add_skeleton`.

        Raises
        ------
        LoadError
            If the file is missing, cannot be read or is of another format. No skeleton is added then.
        NameNotFound
            If the file has no skeleton of a name.
        """
        before = self._handle.num_skeletons()
        from pydart2.loading import Options, read_models

        where = pose(position, orientation)
        options = Options(packages, missing_meshes, safe, engine_defaults=engine_defaults, strict=strict)
        made: list[Skeleton] = []
        try:
            for model in read_models(filename, options, only):
                skel = (CLASS or self.CLASS_SKELETON)(self, _filename=model)  # type: ignore[arg-type]
                made.append(skel)
                for root in skel.root_bodynodes() if (where != pose((0.0, 0.0, 0.0))).any() else ():
                    root.parent_joint._handle.place(where @ root.world_transform())
                if enforce_limits:
                    skel.set_position_limits_enforced()
        except BaseException:
            self._go_back(before)
            raise
        return made
