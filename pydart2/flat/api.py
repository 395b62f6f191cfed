"""The original's flat functions: a world, skeleton, body and so on by their ids.

>>> import pydart2.pydart2_api as papi
>>> wid = papi.createWorld(0.001)       # lives until destroyWorld(wid), destroy() or init()
>>> papi.world__getTime(wid)
0.0

`table` lists them. A result of variable length takes its length as the last argument; `out` is filled in place.
What cannot be done raises. Drawing (`*__render*`) is in `drawing`.
"""

from __future__ import annotations

import inspect
import re
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pydart2 import bodynode, collision_result, dof, joint, manager, marker, shape, shapenode, skeleton, world
from pydart2._native import (
    BodyNodeHandle,
    DofHandle,
    JointHandle,
    MarkerHandle,
    ShapeHandle,
    ShapeNodeHandle,
    SkeletonHandle,
    WorldHandle,
    restart,
)
from pydart2.flat.drawing import FUNCTIONS as DRAWING
from pydart2.flat.table import ROWS, Row
from pydart2.loading import read_model
from pydart2.manager import set_verbose as _set_verbose  # noqa: F401 (named in the table)
from pydart2.manager import verbose as _verbose  # noqa: F401
from pydart2.simulation.step_options import DETECTORS, detector_number

# The worlds that the flat functions made; those of World objects are kept alive by whoever made them.
_owned: dict[int, WorldHandle] = {}


class IntVector(list[int]):
    """A list of integers."""


# What the table calls by a name with a leading underscore


def _init(verbose: bool) -> None:
    """Start over: destroy all worlds made so far and count world ids from 0 again."""
    manager.init(verbose)
    _owned.clear()


def _destroy_all() -> None:
    """Destroy all worlds made so far and count world ids from 0 again."""
    restart()
    _owned.clear()


def _create_world(timestep: float) -> int:
    """Make an empty world with gravity (0, -9.81, 0); returns its id. The time step is in s."""
    handle = WorldHandle(timestep)
    handle.set_gravity([0.0, -9.81, 0.0])
    return _own(handle)


def _create_world_from_skel(path: str) -> int:
    """Make the world of a SKEL file; returns its id. LoadError if the file is missing or cannot be read."""
    return _own(read_model(path).load_world())


def _destroy_world(handle: WorldHandle) -> None:
    """Free a world; any later use of it raises."""
    handle.destroy()
    _owned.pop(handle.id(), None)


def _own(handle: WorldHandle) -> int:
    _owned[handle.id()] = handle
    return handle.id()


def _add_skeleton(handle: WorldHandle, path: str) -> int:
    """Load a URDF, SDF, SKEL, MJCF or VSK file; returns its id. A World object needs add_skeleton_from_id()."""
    return read_model(path).add_to(handle)


def _step(handle: WorldHandle) -> None:
    """Simulate one time step, without controllers."""
    handle.step(1)


def _index_of_first_dof(handle: WorldHandle, i: int) -> int:
    """How many dofs the skeletons before skeleton `i` have."""
    count = handle.num_skeletons()
    if not 0 <= i <= count:
        raise IndexError(f"no skeleton {i}: there are {count}")
    return sum(handle.skeleton(before).num_dofs() for before in range(i))


def _set_collision_detector(handle: WorldHandle, detector_type: int) -> None:
    """Set the detector: 0 (DART) 1 (FCL) 2 (Bullet) 3 (ODE) 10 (native); ValueError for any other."""
    if detector_type not in DETECTORS:
        raise ValueError(f"no collision detector {detector_type!r}; they are {', '.join(map(str, DETECTORS))}")
    handle.set_collision_detector(DETECTORS[detector_type])


def _collision_detector(handle: WorldHandle) -> int:
    """The detector: 0 (DART) 1 (FCL) 2 (Bullet) 3 (ODE) 10 (native), -1 for another."""
    return detector_number(handle.collision_detector())


def _contacts(handle: WorldHandle) -> NDArray[np.float64]:
    """Point (3, m), force (3, N), skeleton and body id of the first body, of the second; 10 numbers a contact."""
    return handle.contacts()[:, :10]


def _colliding_bodies(handle: WorldHandle) -> tuple[int, ...]:
    """Skeleton id, body id of each body that touches another, one after another, each body once."""
    sides = handle.contacts()[:, 6:10].astype(int).reshape(-1, 2).tolist()
    return tuple(i for pair in dict.fromkeys((skid, bid) for skid, bid in sides if skid >= 0) for i in pair)


def _add_ball_joint_constraint(
    handle: WorldHandle, skid1: int, bid1: int, skid2: int, bid2: int, position: ArrayLike
) -> int:
    """Keep the point `position` of the world, shape (3,), m, of two bodies together; returns 0."""
    bodies = handle.skeleton(skid1).bodynode(bid1), handle.skeleton(skid2).bodynode(bid2)
    handle.add_ball_joint_constraint(*bodies, position)
    return 0


def _positions(handle: SkeletonHandle) -> NDArray[np.float64]:
    """Generalized positions, rad or m."""
    return handle.states(None)[: handle.num_dofs()]


def _velocities(handle: SkeletonHandle) -> NDArray[np.float64]:
    """Generalized velocities, rad/s or m/s."""
    return handle.states(None)[handle.num_dofs() :]


def _accelerations(handle: SkeletonHandle) -> NDArray[np.float64]:
    """Generalized accelerations of the last step, rad/s² or m/s²."""
    return np.array([handle.dof(i).acceleration() for i in range(handle.num_dofs())])


def _set_actuator_type(handle: JointHandle, actuator_type: int) -> None:
    """Set one of FORCE = 0, PASSIVE, SERVO, ACCELERATION, VELOCITY, LOCKED = 5; ValueError for any other."""
    handle.set_actuator_type(_named(joint._ACTUATORS, actuator_type, "actuator type"))


def _actuator_type(handle: JointHandle) -> int:
    """One of FORCE = 0, PASSIVE, SERVO, ACCELERATION, VELOCITY, LOCKED = 5, MIMIC."""
    return joint._ACTUATORS.index(handle.actuator_type())


def _shape_type_id(handle: ShapeHandle) -> int:
    """The number of the kind, -1 if it is not known."""
    return shape._classes.get(handle.type().split(" ")[0], shape.Shape).TYPE_ID


def _add_sphere(handle: ShapeHandle, sphere: ArrayLike) -> None:
    """Add a sphere: radius and centre, shape (4,), m."""
    numbers = np.asarray(sphere, dtype=float)
    if numbers.shape != (4,):
        raise ValueError(f"sphere needs shape (4,), got {numbers.shape}")
    handle.add_sphere(float(numbers[0]), numbers[1:])


def _named(names: tuple[str, ...], index: int, kind: str) -> str:
    if index not in range(len(names)):
        raise ValueError(f"no {kind} {index!r}; they are 0 to {len(names) - 1}: {', '.join(names)}")
    return names[index]


# From a row of the table to a function

_Step = Callable[[list[Any], int], Any]

#: A parameter that is an id: what it finds from the objects found before it, and of which class that is.
_STEPS: dict[str, tuple[type, _Step]] = {
    "wid": (WorldHandle, lambda found, i: WorldHandle.find(i)),
    "skid": (SkeletonHandle, lambda found, i: found[0].skeleton(i)),
    "mid": (MarkerHandle, lambda found, i: found[1].marker(i)),
    "bid": (BodyNodeHandle, lambda found, i: found[1].bodynode(i)),
    "dofid": (DofHandle, lambda found, i: found[1].dof(i)),
    "jid": (JointHandle, lambda found, i: found[1].joint(i)),
    "index": (DofHandle, lambda found, i: found[1].dof(found[2].dof(i))),
    "sid": (ShapeNodeHandle, lambda found, i: found[2].shapenode(i)),
}
_SHAPE: tuple[type, _Step] = (ShapeHandle, lambda found, i: found[2].shapenode(i).shape())


def _function(row: Row) -> Callable[..., Any]:
    """The function of a row: find the object of the ids, call its method with the other arguments."""
    signature = inspect.Signature([_parameter(text) for text in row.parameters.split(", ") if text])
    names = list(signature.parameters)
    owner, _, tail = row.name.rpartition("__")
    steps = [_SHAPE if name == "sid" and owner != "shapenode" else _STEPS[name] for name in names if name in _STEPS]
    method = row.method or _snake(tail)
    call: Callable[..., Any] = globals()[method] if method.startswith("_") else getattr(steps[-1][0], method)
    doc = row.doc or (call.__doc__ if method.startswith("_") else _doc(owner, method))
    if names[-1:] == ["out"]:
        call = _filling(row.name, call, *([False] if owner == "bodynode" else []))  # Jacobians over the dependent dofs
    elif steps and (steps[-1][0], method) in _FRESH:
        call = _fresh(call)
    if names[-1:] in (["nout"], ["ndofs"]):
        call = _sized(row.name, call)

    def function(*args: Any, **kwargs: Any) -> Any:
        if kwargs or len(args) != len(names):
            bound = signature.bind(*args, **kwargs)
            bound.apply_defaults()
            args = bound.args
        found: list[Any] = []
        for (_, step), i in zip(steps, args):
            found.append(step(found, i))
        value = call(*found[-1:], *args[len(steps) :])
        return None if row.result == "None" else value

    function.__name__ = function.__qualname__ = row.name
    function.__signature__ = signature  # type: ignore[attr-defined]
    function.__doc__ = f"{row.name}{signature} -> {row.result}: {doc}"
    return function


def _parameter(text: str) -> inspect.Parameter:
    name, _, default = text.partition("=")
    return inspect.Parameter(
        name, inspect.Parameter.POSITIONAL_OR_KEYWORD, default=default == "True" if default else inspect.Parameter.empty
    )


def _snake(tail: str) -> str:
    return re.sub(r"(?<=[a-z0-9])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])", "_", tail).lower().removeprefix("get_")


_CLASSES: dict[str, Any] = {
    name.lower(): cls
    for module in (world, collision_result, skeleton, bodynode, dof, joint, marker, shapenode, shape)
    for name, cls in vars(module).items()
    if inspect.isclass(cls)
}


def _doc(owner: str, method: str) -> str | None:
    """The summary of the method of this name of `World`, `Skeleton` and so on; its parameters have other names."""
    text = inspect.getdoc(getattr(_CLASSES[owner.replace("_", "")], method, None))
    return text and text.split("\n\n")[0]


def _filling(name: str, call: Callable[..., NDArray[np.float64]], *more: Any) -> Callable[..., None]:
    """Write the result into the last argument."""

    def fill(*args: Any) -> None:
        if not isinstance(args[-1], np.ndarray):  # None would be a fresh array
            raise TypeError(f"{name}() fills an array of float64, got {args[-1]!r}")
        call(*args[:-1], *more, args[-1])

    return fill


#: The other methods that are told by their last argument what to fill; None stands for a fresh array.
_FRESH = {
    (SkeletonHandle, "com"),
    (SkeletonHandle, "coriolis_and_gravity_forces"),
    (SkeletonHandle, "constraint_forces"),
    (BodyNodeHandle, "transform"),
}


def _fresh(call: Callable[..., NDArray[np.float64]]) -> Callable[..., NDArray[np.float64]]:
    return lambda *args: call(*args, None)


def _sized(name: str, call: Callable[..., NDArray[np.float64]]) -> Callable[..., NDArray[np.float64]]:
    """Take the length of the result as the last argument."""

    def flat(*args: Any) -> NDArray[np.float64]:
        values = call(*args[:-1]).flatten()
        if len(values) != args[-1]:
            raise ValueError(f"{name}() gives {len(values)} numbers, got length {args[-1]!r}")
        return values

    return flat


#: What `pydart2_api` offers besides its handle classes.
MEMBERS: dict[str, Any] = {
    "IntVector": IntVector,
    **{row.name: _function(row) for row in ROWS},
    **{function.__name__: function for function in DRAWING},
}
