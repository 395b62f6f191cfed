"""The skeletons of a world: how they come, go and are found."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from typing import TYPE_CHECKING, ClassVar, Literal, cast

import numpy as np
from numpy.typing import ArrayLike

from pydart2.errors import NameNotFound
from pydart2.poses import pose
from pydart2.simulation.part import WorldPart

if TYPE_CHECKING:
    from pydart2.cameras import MountedCamera
    from pydart2.loading import Missing, Reader, Source
    from pydart2.loading.readable import Readable
    from pydart2.skeleton import Skeleton
    from pydart2.world import World


class Members(WorldPart):
    """The part of World that takes skeletons in and lets them go, all or nothing."""

    CLASS_SKELETON: ClassVar[type[Skeleton]]

    def add_skeleton(
        self,
        filename: Source,
        CLASS: type[Skeleton] | None = None,
        *,
        packages: Mapping[str, str | os.PathLike[str]] | None = None,
        missing_meshes: Missing = "error",
        safe: bool | None = None,
        reader: Reader = "mujoco",
        massless: bool = False,
        engine_defaults: bool = False,
        strict: bool = False,
        enforce_limits: bool = False,
        position: ArrayLike | None = None,
        orientation: ArrayLike | None = None,
        base: Literal["auto", "fixed", "free"] = "auto",
        name: str | None = None,
        load_seconds: float | None = None,
    ) -> Skeleton:
        """Load a URDF, SDF, SKEL, MJCF or VSK file and add its skeleton.

        Parameters
        ----------
        filename
            From the current folder, else among the package's models; or a URI (``file://``, ``package://``,
            ``dart://sample/``), or the XML itself (a str that begins with ``<``, or bytes).
        CLASS
            Class of the skeleton; default `CLASS_SKELETON`.
        packages
            Package name → folder, for the ``package://`` URIs in the file. Others are looked for in ROS_PACKAGE_PATH,
            then in the folders above the file.
        missing_meshes
            ``"error"``: a missing mesh of a collision shape is a LoadError; ``"warn"``: the shape is left out, with a
            warning, as visual shapes always are.
        safe
            Whether to try the file in a helper process first, so that what crashes the engine's parsers is a
            LoadError and does not end Python. None: unless the file is one of the package's own.
        reader
            Who reads MJCF: ``"mujoco"``, its own compiler (``pip install pydart2[mjcf]``), whose numbers the skeletons
            then have, or ``"engine"``, whose numbers differ.
        massless
            A URDF link without ``<inertial>`` weighs nothing, but where a joint would then move too little mass, 1 kg
            as in the engine, with a warning. True: nothing there either, for kinematics and comparisons; a step says
            what it lacks.
        engine_defaults
            Whether each of them weighs 1 kg, and has 1 kg m² about each axis, as the engine alone loads it; URDF joints
            that state no bounds then have 0 and 0.
        strict
            Whether what is a warning about the file is a LoadError.
        enforce_limits
            Whether its joints stop at their limits (`Skeleton.set_position_limits_enforced`); in the engine, and by
            default, they do not.
        position, orientation
            Where the root link is in the world: shape (3,), m; a quaternion [w, x, y, z] or a (3, 3) matrix. What is
            not given is the file's. A base that floats is there after a reset, too.
        base
            ``"fixed"`` welds the root link to the world, ``"free"`` lets one that is fixed float; ``"auto"`` leaves it
            as the file has it.
        name
            In place of the file's (URDF, SDF, SKEL). The second skeleton of a name gets `` (1)`` behind it.
        load_seconds
            How long the trial may take, and reading again, s of the processor's time; None: five, and one more for each
            megabyte of its files. Ctrl-C ends either.

        Raises
        ------
        LoadError
            If the file is missing or cannot be read: says file, line and reason.
        """
        self._handle.time()  # a world that is gone says so before the file is read
        from pydart2.loading import Options, read_model

        if base not in ("auto", "fixed", "free"):
            raise ValueError(f"base must be 'auto', 'fixed' or 'free', got {base!r}")
        where = pose((0.0, 0.0, 0.0) if position is None else position, orientation)
        options = Options(
            packages, missing_meshes, safe, False, reader, massless, engine_defaults, strict, name, load_seconds
        )
        model = read_model(filename, options)
        with self._all_or_nothing():
            skel = self._load(model, CLASS)
            if base == "fixed":
                skel.set_root_joint_to_weld()
            elif base == "free":
                skel.set_root_joint_to_free()
            if position is not None or orientation is not None:
                stands = skel.root_bodynode().world_transform()
                where[:3, 3] = stands[:3, 3] if position is None else where[:3, 3]
                where[:3, :3] = stands[:3, :3] if orientation is None else where[:3, :3]
                skel._place(where)
            if enforce_limits:
                skel.set_position_limits_enforced()
        self._take_cameras(model, skel)
        return skel

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
        load_seconds: float | None = None,
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
        CLASS, packages, missing_meshes, safe, engine_defaults, strict, enforce_limits, load_seconds
            As for `add_skeleton`.

        Raises
        ------
        LoadError
            If the file is missing, cannot be read or is of another format. No skeleton is added then.
        NameNotFound
            If the file has no skeleton of a name.
        """
        self._handle.time()  # a world that is gone says so before the file is read
        from pydart2.loading import Options, read_models

        where = pose(position, orientation)
        options = Options(
            packages, missing_meshes, safe, engine_defaults=engine_defaults, strict=strict, load_seconds=load_seconds
        )
        made: list[Skeleton] = []
        with self._all_or_nothing():
            for model in read_models(filename, options, only):
                skel = self._load(model, CLASS)
                made.append(skel)
                for root in skel.root_bodynodes() if (where != pose((0.0, 0.0, 0.0))).any() else ():
                    root.parent_joint._handle.place(where @ root.world_transform())
                if enforce_limits:
                    skel.set_position_limits_enforced()
        return made

    def add_skeleton_from_id(self, _skel_id: int) -> Skeleton:
        """Make an object for a skeleton that the engine's world has already."""
        with self._all_or_nothing(_skel_id if _skel_id == len(self.skeletons) else None):
            skel = self.CLASS_SKELETON(cast("World", self), _id=_skel_id)
        self._take_in(skel)
        return skel

    def remove_skeleton(self, skel: Skeleton | str | int) -> None:
        """Take a skeleton, or that of a name or index, out of the world, with the constraints that hold it.

        Contacts that it had stay in `collision_result` and in the recording, without a body on its side.
        """
        if isinstance(skel, (str, int, np.integer)):
            skel = self.skeleton(skel)
        index = next((i for i, own in enumerate(self.skeletons) if own is skel), None)
        if index is None:
            raise ValueError(f"{skel!r} is not in {self!r}")
        self.collision_result._look()  # the engine forgets them
        self._handle.remove_skeleton(index)
        del self.skeletons[index]
        for i, other in enumerate(self.skeletons[index:], index):
            other.id = i
        self.collision_result._forget_skeleton(index)
        if skel.controller is not None:
            self._find_controllers()
        for title, camera in list(self._cameras.items()):
            if any(body is not None and body.skeleton is skel for body in (camera.body, camera.target)):
                del self._cameras[title]

    def _load(self, model: Readable, cls: type[Skeleton] | None) -> Skeleton:
        return (cls or self.CLASS_SKELETON)(cast("World", self), _filename=model)

    def _take_cameras(self, model: Readable, skel: Skeleton) -> None:
        """Have the cameras of a model that was added; names that are taken get the skeleton's before them."""
        for name, camera in model.cameras(cast("World", self), still=False).items():
            self._cameras[f"{skel.name}/{name}" if name in self._cameras else name] = camera

    @property
    def cameras(self) -> dict[str, MountedCamera]:
        """Name → camera, those of MJCF files and those that you put in: ``gui.render(world, camera="name")``."""
        return self._cameras

    def _take_in(self, skel: Skeleton) -> None:
        """Have a skeleton that the engine's world has."""
        self.skeletons.append(skel)
        self._step = self._first_step
        if skel.controller is not None:
            self._find_controllers()

    @contextmanager
    def _all_or_nothing(self, keep: int | None = None) -> Iterator[None]:
        """What comes inside stays unless something fails there: then only the skeletons before, or the first `keep`."""
        before = self._handle.num_skeletons() if keep is None else keep
        try:
            yield
        except BaseException:
            del self.skeletons[before:]
            while self._handle.num_skeletons() > before:
                self._handle.remove_skeleton(self._handle.num_skeletons() - 1)
            self._find_controllers()
            raise

    def num_skeletons(self) -> int:
        """How many skeletons there are."""
        return self._handle.num_skeletons()

    def skeleton(self, query: str | int) -> Skeleton:
        """A skeleton by name or index; NameNotFound or IndexError if there is none."""
        if isinstance(query, str):
            for skel in self.skeletons:
                if skel.name == query:
                    return skel
            raise NameNotFound("skeleton", query, repr(self), [skel.name for skel in self.skeletons])
        if not isinstance(query, (int, np.integer)):
            raise TypeError(f"a skeleton is found by name or index, not by {query!r}")
        if not -len(self.skeletons) <= query < len(self.skeletons):
            raise IndexError(f"no skeleton {query} in {self!r}: there are {len(self.skeletons)}")
        return self.skeletons[query]

    def __getitem__(self, query: str | int) -> Skeleton:
        return Members.skeleton(self, query)

    def __iter__(self) -> Iterator[Skeleton]:
        return iter(self.skeletons)

    def _ipython_key_completions_(self) -> list[str]:
        return [skel.name for skel in self.skeletons]
