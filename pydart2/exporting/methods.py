"""How skeletons and worlds are saved."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, cast

if TYPE_CHECKING:
    from pydart2.skeleton import Skeleton
    from pydart2.world import World


class SavedSkeleton:
    """The part of Skeleton that writes it to files.

    What a format cannot hold is an ExportError if it would move or collide otherwise, and else left out with one
    warning, or with `strict` an ExportError, too. Meshes stay the files that they are.
    """

    def to_urdf(self, *, strict: bool = False) -> str:
        """The text of a URDF file, which loads as this skeleton. ExportError if it cannot."""
        return self._text("URDF", strict)

    def to_skel(self, *, strict: bool = False) -> str:
        """The text of a SKEL file, which loads as this skeleton. ExportError if it cannot."""
        return self._text("SKEL", strict)

    def to_sdf(self, *, strict: bool = False) -> str:
        """The text of an SDF file, which loads as this skeleton. ExportError if it cannot."""
        return self._text("SDF", strict)

    def to_mjcf(self, *, strict: bool = False) -> str:
        """The text of an MJCF file, which MuJoCo compiles to this skeleton. ExportError if it cannot."""
        return self._text("MJCF", strict)

    def save(self, path: str | os.PathLike[str], *, strict: bool = False) -> None:
        """Write a model file of the format that the suffix names: .urdf, .skel, .sdf or .xml, which is MJCF.

        Meshes in the folder of the file, or below, are named by the way from there, others by their whole path.

        Raises
        ------
        ExportError
            If the format cannot hold the skeleton; nothing is written then.
        OSError
            If the file cannot be written.
        """
        from pydart2.exporting.saving import save

        save([cast("Skeleton", self)], None, path, strict)

    def _text(self, title: str, strict: bool) -> str:
        from pydart2.exporting.saving import text_of

        skel = cast("Skeleton", self)
        return text_of([skel], None, title, strict, repr(skel.name))


class SavedWorld:
    """The part of World that writes it to files."""

    def save(self, path: str | os.PathLike[str], *, strict: bool = False) -> None:
        """Write a model file with the skeletons, gravity and time step; as `Skeleton.save`."""
        from pydart2.exporting.saving import save

        world = cast("World", self)
        save(world.skeletons, world, path, strict)
