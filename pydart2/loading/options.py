"""How a model is loaded, as `World` and `World.add_skeleton` take it."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass
from numbers import Real
from typing import Literal

Missing = Literal["error", "warn"]
Reader = Literal["mujoco", "engine"]

MOST_SECONDS = 1e5  # more than a day


@dataclass
class Options:
    """How to load.

    Attributes
    ----------
    packages
        Package name → folder, for ``package://name/…`` and ``model://name/…``. Others are looked for in
        ROS_PACKAGE_PATH, then in the folders above the file.
    missing_meshes
        What to do when the mesh of a collision shape is missing: ``"error"`` raises LoadError, ``"warn"`` leaves the
        shape out. Visual shapes without their mesh are always left out, with a warning.
    safe
        Whether to try the file in a helper process first, so that a crash of the engine's parsers is a LoadError.
        None: unless it is one of the package's own models.
    text
        Whether the source is a text even if it does not begin with ``<``.
    reader
        Who reads MJCF: ``"mujoco"``, its own compiler (``pip install pydart2[mjcf]``), or ``"engine"``, whose numbers
        differ: it takes degrees for radians, loses masses and joints.
    massless
        Whether URDF links without ``<inertial>`` weigh nothing even where the motion then has no answer: for kinematics
        and comparisons.
    engine_defaults
        Whether they weigh 1 kg, and joints whose limits are not stated have 0 and 0, as the engine's own loader has it.
    strict
        Whether what else is a warning is a LoadError.
    name
        The skeleton's name, in place of the file's.
    load_seconds
        How long the trial may take, and reading again, s of processor time. None: five, and one more for each megabyte
        (MuJoCo's compiler: 60 s by the clock).
    """

    packages: Mapping[str, str | os.PathLike[str]] | None = None
    missing_meshes: Missing = "error"
    safe: bool | None = None
    text: bool = False
    reader: Reader = "mujoco"
    massless: bool = False
    engine_defaults: bool = False
    strict: bool = False
    name: str | None = None
    load_seconds: float | None = None

    def check(self) -> None:
        """ValueError if one is none that there is, or two exclude each other."""
        if self.massless and self.engine_defaults:
            raise ValueError("massless=True and engine_defaults=True exclude each other")
        if self.reader not in ("mujoco", "engine"):
            raise ValueError(f"reader must be 'mujoco' or 'engine', got {self.reader!r}")
        if self.missing_meshes not in ("error", "warn"):
            raise ValueError(f"missing_meshes must be 'error' or 'warn', got {self.missing_meshes!r}")
        if self.name is not None and not (isinstance(self.name, str) and self.name.strip()):
            raise ValueError(f"name must be a string that is not empty, got {self.name!r}")
        if self.packages is not None and not isinstance(self.packages, Mapping):
            raise TypeError(
                f'packages are folders by name, as {{"arm_description": "/opt/arm"}}, got {self.packages!r}'
            )
        if self.load_seconds is None:
            return
        if not isinstance(self.load_seconds, Real) or not 0.0 < self.load_seconds <= MOST_SECONDS:
            raise ValueError(f"load_seconds must be above 0 and at most {MOST_SECONDS:g}, got {self.load_seconds!r}")
