"""Debian's DART binding as a server: one JSON request a line on stdin, one JSON answer a line on stdout.

Run by Debian's Python, whose ``dartpy`` needs NumPy < 2; `dartpy_oracle.DartpyOracle` is the parent. A
request is the keyword arguments of `simulate` and "patience", whole seconds after which it is given up; an
answer is ``{"result": ...}`` or ``{"error": "..."}``. `wire` describes the JSON; it is not imported here,
because this file runs alone.
"""

import importlib
import json
import os
import re
import signal
import sys
import traceback
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

# Any: the binding carries no types, and is not installed where the parent is type-checked.
dart: Any = importlib.import_module("dartpy")

DETECTORS = {
    "fcl": dart.collision.FCLCollisionDetector,
    "dart": dart.collision.DARTCollisionDetector,
    "bullet": dart.collision.BulletCollisionDetector,
    "ode": dart.collision.OdeCollisionDetector,
}
EMPTY_WORLD_GRAVITY = [0.0, -9.81, 0.0]
# The world, until the process ends: wrappers of its bodies and shapes touch freed memory if they outlive it.
KEPT: list[Any] = []


def over_bodies(skeleton: Any, shape: tuple[int, ...], value: Callable[[Any], Any]) -> Any:
    """Return value(body) of every body stacked: (bodies, *shape)."""
    values = [value(body) for body in skeleton.getBodyNodes()]
    return np.array(values, dtype=float).reshape(len(values), *shape)


def transforms(skeleton: Any) -> Any:
    return over_bodies(skeleton, (4, 4), lambda body: body.getWorldTransform().matrix())


def linear_jacobians(skeleton: Any) -> Any:
    world = dart.dynamics.Frame.World()
    shape = (3, skeleton.getNumDofs())
    return over_bodies(skeleton, shape, lambda body: skeleton.getLinearJacobian(body, world))


def angular_jacobians(skeleton: Any) -> Any:
    world = dart.dynamics.Frame.World()
    shape = (3, skeleton.getNumDofs())
    return over_bodies(skeleton, shape, lambda body: skeleton.getAngularJacobian(body, world))


# What a frame says of each skeleton; shapes, units and frames are in the docstring of DartpyOracle.simulate.
FIELDS: dict[str, Callable[[Any], Any]] = {
    "q": lambda skeleton: skeleton.getPositions(),
    "dq": lambda skeleton: skeleton.getVelocities(),
    "ddq": lambda skeleton: skeleton.getAccelerations(),
    # Of a copy: reading it changes what the engine's next step does where a joint's motion is prescribed.
    "M": lambda skeleton: skeleton.clone().getMassMatrix(),
    "c": lambda skeleton: skeleton.getCoriolisAndGravityForces(),
    "g": lambda skeleton: skeleton.getGravityForces(),
    "C": lambda skeleton: skeleton.getCOM(),
    "dC": lambda skeleton: skeleton.getCOMLinearVelocity(),
    "T": transforms,
    "J": linear_jacobians,
    "Jang": angular_jacobians,
    "constraint_forces": lambda skeleton: skeleton.getConstraintForces(),
    "kinetic": lambda skeleton: skeleton.computeKineticEnergy(),
    "potential": lambda skeleton: skeleton.computePotentialEnergy(),
}


def local_retriever() -> Any:
    """Return a retriever of files and of DART's own ``dart://`` data."""
    retriever = dart.utils.CompositeResourceRetriever()
    retriever.addSchemaRetriever("file", dart.common.LocalResourceRetriever())
    retriever.addSchemaRetriever("dart", dart.utils.DartResourceRetriever())
    return retriever


def load(path: str, packages: dict[str, str]) -> Any:
    """Return the world or the skeleton in the file, told apart by extension (SDF: by a <world> element)."""
    uri = dart.common.Uri.createFromPath(path)
    kind = Path(path).suffix.lower()
    if kind == ".skel":
        loaded = dart.utils.SkelParser.readWorld(uri)
    elif kind == ".urdf":
        loader = dart.utils.DartLoader()
        for name, folder in packages.items():
            loader.addPackageDirectory(name, folder)
        loaded = loader.parseSkeleton(uri)
    elif kind in (".sdf", ".world", ".model"):
        is_world = re.search(r"<world\b", Path(path).read_text(errors="replace"))
        # Without a retriever of the caller's the SDF parser can crash on meshes.
        read = dart.utils.SdfParser.readWorld if is_world else dart.utils.SdfParser.readSkeleton
        loaded = read(uri, local_retriever())
    else:
        raise ValueError(f"no loader for {path}: expected .skel, .urdf, .sdf, .world or .model")
    if loaded is None:
        raise ValueError(f"the engine could not load {path}")
    return loaded


def build_world(
    models: list[str],
    dt: float | None,
    gravity: list[float] | None,
    detector: str | None,
    packages: dict[str, str],
) -> Any:
    """Return the world of the first model, or an empty one, with the skeletons of the other models added."""
    loaded = [load(path, packages) for path in models]
    if isinstance(loaded[0], dart.simulation.World):
        world = loaded.pop(0)
    else:
        world = dart.simulation.World()
        world.setGravity(EMPTY_WORLD_GRAVITY)
    for skeleton in loaded:
        if isinstance(skeleton, dart.simulation.World):
            raise ValueError("only the first model may be a world")
        world.addSkeleton(skeleton)
    if dt is not None:
        world.setTimeStep(dt)
    if gravity is not None:
        world.setGravity(gravity)
    if detector is not None:
        world.getConstraintSolver().setCollisionDetector(DETECTORS[detector]())
    return world


def per_skeleton(skeletons: list[Any], values: list[Any] | None, what: str) -> list[tuple[Any, Any]]:
    """Return pairs of a skeleton and its entry in `values`, without the entries that are None."""
    if values is None:
        return []
    if len(values) != len(skeletons):
        raise ValueError(f"{what}: expected {len(skeletons)} entries, one per skeleton, got {len(values)}")
    return [pair for pair in zip(skeletons, values, strict=True) if pair[1] is not None]


def of_all_dofs(skeleton: Any, values: list[float], what: str) -> Any:
    """Return `values` as a vector; the engine aborts the process on a wrong length."""
    vector = np.array(values, dtype=float)
    if vector.shape != (skeleton.getNumDofs(),):
        expected = (skeleton.getNumDofs(),)
        raise ValueError(f"{what} of {skeleton.getName()}: expected shape {expected}, got {vector.shape}")
    return vector


def describe(skeleton: Any) -> dict[str, Any]:
    """Return the names, masses and limits that do not change while stepping."""
    bodies = skeleton.getBodyNodes()
    # One by one: the lists of this binding's getJoints() and getDofs() delete the engine's objects with them.
    joints = [skeleton.getJoint(i) for i in range(skeleton.getNumJoints())]
    dofs = [skeleton.getDof(i) for i in range(skeleton.getNumDofs())]
    return {
        "name": skeleton.getName(),
        "mobile": skeleton.isMobile(),
        "mass": skeleton.getMass(),
        "bodies": [body.getName() for body in bodies],
        "body_masses": np.array([body.getMass() for body in bodies]),
        "joints": [joint.getName() for joint in joints],
        "joint_types": [joint.getType() for joint in joints],
        "dofs": [dof.getName() for dof in dofs],
        "q_lower": skeleton.getPositionLowerLimits(),
        "q_upper": skeleton.getPositionUpperLimits(),
        "dq_lower": skeleton.getVelocityLowerLimits(),
        "dq_upper": skeleton.getVelocityUpperLimits(),
        "tau_lower": skeleton.getForceLowerLimits(),
        "tau_upper": skeleton.getForceUpperLimits(),
    }


def contact_body(contact_object: Any, skeleton_ids: dict[str, int]) -> tuple[int, int]:
    """Return the index of the skeleton in the world and of the body in it; -1, -1 for a free frame."""
    node = contact_object.getShapeFrame().asShapeNode()
    if node is None:
        return -1, -1
    body = node.getBodyNode()
    return skeleton_ids[body.getSkeleton().getName()], body.getIndexInSkeleton()


def contact_table(world: Any, skeletons: list[Any], stepped: bool) -> dict[str, Any]:
    """Return the contacts of the last step in the engine's order: numbers (n, 10) and bodies (n, 4)."""
    result = world.getLastCollisionResult()  # a copy that owns the contacts: they dangle once it is gone
    contacts = result.getContacts() if stepped else []
    ids = {skeleton.getName(): i for i, skeleton in enumerate(skeletons)}  # a world keeps names unique
    numbers = [[*c.point, *c.force, *c.normal, c.penetrationDepth] for c in contacts]
    bodies = [contact_body(c.collisionObject1, ids) + contact_body(c.collisionObject2, ids) for c in contacts]
    return {
        "numbers": np.array(numbers, dtype=float).reshape(len(contacts), 10),
        "bodies": np.array(bodies, dtype=int).reshape(len(contacts), 4),
    }


def report(world: Any, skeletons: list[Any], step: int, fields: list[str]) -> dict[str, Any]:
    """Return one frame: the state after `step` steps."""
    return {
        "step": step,
        "time": world.getTime(),
        "skeletons": [{name: FIELDS[name](skeleton) for name in fields} for skeleton in skeletons],
        "contacts": contact_table(world, skeletons, step > 0),
    }


def simulate(
    skeleton_states: list[Any] | None,
    forces: list[Any] | None,
    steps: int,
    report_at: list[int],
    fields: list[str] | None,
    **setting: Any,
) -> dict[str, Any]:
    """Build a world from `setting`, set its state, step it and return the frames asked for."""
    world = build_world(**setting)
    KEPT.append(world)
    skeletons = [world.getSkeleton(i) for i in range(world.getNumSkeletons())]
    for skeleton, (q, dq) in per_skeleton(skeletons, skeleton_states, "skeleton_states"):
        skeleton.setPositions(of_all_dofs(skeleton, q, "q"))
        skeleton.setVelocities(of_all_dofs(skeleton, dq, "dq"))
    pushed = [(s, of_all_dofs(s, tau, "forces")) for s, tau in per_skeleton(skeletons, forces, "forces")]
    fields = list(FIELDS) if fields is None else fields
    asked = set(report_at)
    frames = [report(world, skeletons, 0, fields)] if 0 in asked else []
    for step in range(1, steps + 1):
        for skeleton, tau in pushed:  # every time: a step clears the forces
            skeleton.setForces(tau)
        world.step()
        if step in asked:
            frames.append(report(world, skeletons, step, fields))
    return {
        "dt": world.getTimeStep(),
        "gravity": world.getGravity(),
        "skeletons": [describe(skeleton) for skeleton in skeletons],
        "frames": frames,
    }


def as_json(value: Any) -> dict[str, Any]:
    """Return what ``json`` cannot write by itself: an array in the form that `wire` describes."""
    array = np.asarray(value)
    return {"dtype": array.dtype.name, "shape": array.shape, "values": array.ravel().tolist()}


def answer(request: dict[str, Any]) -> str:
    """Return the answer to one request as JSON."""
    try:
        return json.dumps({"result": simulate(**request)}, default=as_json)
    except Exception:
        return json.dumps({"error": traceback.format_exc()})


def serve() -> None:
    """Answer requests until stdin ends, each in a fork of this process.

    A fork keeps the costly import and ends without tidying up, so nothing outlives its world (see `KEPT`) or
    reaches the next request. If the engine aborts, only the fork ends.
    """
    # The engine prints to file descriptor 1 as well: keep that stream for the answers alone.
    output = os.fdopen(os.dup(1), "w")
    os.dup2(2, 1)
    print(json.dumps({"result": "ready"}), file=output, flush=True)
    for line in sys.stdin:
        request = json.loads(line)
        patience = request.pop("patience")
        fork = os.fork()
        if fork == 0:
            signal.alarm(patience)  # its default action ends the fork, also inside the engine
            print(answer(request), file=output, flush=True)
            os._exit(0)
        status = os.waitstatus_to_exitcode(os.waitpid(fork, 0)[1])
        if status != 0:
            how = signal.Signals(-status).name if status < 0 else f"status {status}"
            reply = {"error": f"the engine ended the process: {how}"}
            print(json.dumps(reply), file=output, flush=True)


if __name__ == "__main__":
    serve()
