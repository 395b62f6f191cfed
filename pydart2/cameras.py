"""Cameras that a world has by name: they stand in it, ride on a body, follow one, or look at one.

>>> world.cameras["wrist"] = MountedCamera(hand, pose([0.0, 0.0, 0.1]), fov=1.0)
>>> pydart2.gui.render(world, camera="wrist")
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, get_args

import numpy as np
from numpy.typing import NDArray

from pydart2.poses import looking

if TYPE_CHECKING:
    from pydart2.bodynode import BodyNode

Mode = Literal["fixed", "track", "trackcom", "targetbody", "targetbodycom"]


@dataclass(frozen=True, eq=False)
class MountedCamera:
    """A camera of a world, with MuJoCo's modes.

    Attributes
    ----------
    body : BodyNode or None
        What it is mounted on; None: the world.
    pose : (4, 4)
        Of the eye, which looks along its -z with y upwards, in the body; in the "track" modes in axes parallel to the
        world's, from the body's origin or centre of mass. m.
    fov : float
        Vertical field of view, rad.
    mode : str
        "fixed" in the body; "track", "trackcom": it keeps its distance and direction from the body's origin, or from
        the centre of mass of the body and all after it; "targetbody", "targetbodycom": fixed, but turned to `target`,
        its origin or that centre of mass, with the world's up upwards.
    target : BodyNode or None
        What it looks at.

    Raises
    ------
    ValueError
        For an unknown mode, one without the body or target that it needs, a pose that is no (4, 4) matrix, or a field
        of view that is not between 0 and pi.
    """

    body: BodyNode | None
    pose: NDArray[np.float64]
    fov: float = np.pi / 4.0
    mode: Mode = "fixed"
    target: BodyNode | None = None

    def __post_init__(self) -> None:
        if self.mode not in get_args(Mode):
            raise ValueError(f"no mode {self.mode!r} of cameras; there are {', '.join(get_args(Mode))}")
        if self.mode.startswith("track") and self.body is None:
            raise ValueError(f"a camera of the mode {self.mode!r} needs a body to keep its distance from")
        if self.mode.startswith("target") and self.target is None:
            raise ValueError(f"a camera of the mode {self.mode!r} needs a target to look at")
        if np.shape(self.pose) != (4, 4) or not np.isfinite(self.pose).all():
            raise ValueError(f"a camera's pose is a (4, 4) matrix of numbers, not one of shape {np.shape(self.pose)}")
        if not 0.0 < self.fov < np.pi:
            raise ValueError(f"a camera's field of view is an angle between 0 and pi rad, not {self.fov}")

    def eye(self) -> NDArray[np.float64]:
        """The pose of the eye in the world now, shape (4, 4), m; DestroyedError if its body or target is gone."""
        eye = np.array(self.pose, dtype=float)
        if self.body is not None and self.mode.startswith("track"):
            eye[:3, 3] += _point(self.body, self.mode == "trackcom")
        elif self.body is not None:
            eye = self.body.T @ eye
        if self.target is not None and self.mode.startswith("target"):
            target = _point(self.target, self.mode == "targetbodycom")
            eye[:3, :3] = _turned_to(eye, target, self.target.skeleton.world.up)
        return eye


def _point(body: BodyNode, com: bool) -> NDArray[np.float64]:
    """The origin of a body, or the centre of mass of it and all after it."""
    if not com:
        return np.asarray(body.T[:3, 3])
    bodies = [body]
    for one in bodies:
        bodies += one.child_bodynodes
    masses = [one.m for one in bodies]
    return np.average([one.C for one in bodies], axis=0, weights=masses) if sum(masses) > 0.0 else _point(body, False)


def _turned_to(eye: NDArray[np.float64], target: NDArray[np.float64], up: NDArray[np.float64]) -> NDArray[np.float64]:
    """How the eye is turned that sees the target; as it was where there is no such turn."""
    try:
        return looking(eye[:3, 3], target, up)
    except ValueError:
        return eye[:3, :3]
