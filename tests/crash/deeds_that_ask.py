"""Deeds of fuzz_worlds.py with constraints and filters, that ask, measure, copy, save and step."""

from __future__ import annotations

import copy
import math
import pickle
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

import pydart2
from crash.fuzz_api import VALUES, bounded
from crash.world_hands import Hands, Wrong, deed
from pydart2 import constraints
from pydart2.collision_filter import CollisionFilter
from pydart2.frames import SimpleFrame
from pydart2.inverse_kinematics import Target
from pydart2.sensors import IMU, ForceTorque, JointEncoder, Lidar, Touch

# Constraints and filters


@deed
def constrain(h: Hands) -> None:
    one, other = h.body(), h.random.choice((h.body(), h.body(), None))
    made = h.random.choice(
        [
            lambda: constraints.BallJointConstraint(one, other, h.vector(3, 0.3)),
            lambda: constraints.WeldJointConstraint(one, other),
            lambda: constraints.RevoluteJointConstraint(one, other, h.vector(3, 0.3), h.vector()),
            lambda: constraints.DistanceConstraint(
                one, other, h.vector(3, 0.3), h.vector(3, 0.3), h.number(0.5), rope=h.flip()
            ),
        ]
    )()
    h.keep(made).add_to_world(h.world)


@deed
def change_constraint(h: Hands) -> None:
    made = h.random.choice(h.world.constraints or [h.world])
    target = h.pose() if isinstance(made, constraints.WeldJointConstraint) else h.vector(3, 0.3)
    h.random.choice(
        [
            lambda: made.set_target(target),
            lambda: setattr(made, "enabled", h.flip()),
            lambda: made.force(),
            lambda: made.moment(),
            lambda: made.remove(),
            lambda: h.world.remove_all_constraints() if h.random.random() < 0.2 else None,
        ]
    )()


@deed
def filter_pairs(h: Hands) -> None:
    world = h.world
    h.random.choice(
        [
            lambda: world.exclude_collisions(h.bodies(), h.bodies()),
            lambda: world.include_collisions(h.bodies(), h.bodies()),
            lambda: world.excluded_collisions,
            lambda: world.set_collision_group(h.bodies(), h.odd(1 << h.random.randrange(5)), h.odd(0xFFFF)),
            lambda: world.collision_group(h.body()),
            lambda: CollisionFilter(world).add_to_black_list(h.body(), h.body()),
            lambda: CollisionFilter(world).remove_from_black_list(h.body(), h.body()),
            lambda: CollisionFilter(world).remove_all_from_black_list(),
        ]
    )()


# Asking


@deed
def ask(h: Hands) -> None:
    world = h.world
    h.random.choice(
        [
            lambda: h.keep(world.distance(h.bodies(), h.bodies(), h.random.choice((math.inf, h.number())))),
            lambda: world.distances_within(h.bodies(), h.bodies(), h.number(0.5)),
            lambda: world.nearest(h.odd(np.zeros((4, 3))), h.number(), ignore=h.bodies()),
            lambda: h.keep(world.find_contacts(h.bodies(), h.bodies())).force,
            lambda: h.keep(world.raycast(h.vector(), h.vector(), ignore=h.bodies())),
            lambda: world.raycast(np.zeros((5, 3)), h.odd(np.eye(5, 3))).body(h.odd(0)),
            lambda: world.linearize(h.number(1e-6)) if sum(s.ndofs for s in world.skeletons) < 30 else None,
            lambda: h.body().contacts.support_polygon(),
            lambda: h.skel().contacts.centre_of_pressure(),
            lambda: world.contacts_between(h.body(), h.body()).moment(h.vector()),
            world.check_collision,
            lambda: [contact.bodynode1 for contact in world.collision_result.contacts],
        ]
    )()


@deed
def ask_dynamics(h: Hands) -> None:
    skel, body = h.skel(), h.body()
    n = skel.ndofs
    h.random.choice(
        [
            lambda: (skel.M, skel.c, skel.Minv),
            lambda: skel.inverse_dynamics(h.vector(n)),
            lambda: skel.forward_dynamics(h.vector(n)),
            lambda: skel.inverse_dynamics_derivatives(h.vector(n)),
            lambda: skel.forward_dynamics_derivatives(h.vector(n)),
            lambda: skel.impulse_response(h.body(), h.vector(), h.vector(3, 0.1)),
            lambda: skel.centroidal_momentum_matrix(),
            lambda: skel.integrate_positions(h.vector(n), h.vector(n)),
            lambda: skel.inverse_kinematics(
                {h.body(): h.odd(Target(position=h.vector(3, 0.5)), 0.2)}, iterations=20, restarts=2
            ),
            lambda: skel.get_spd(h.vector(n), 0.001, h.number(100), h.number(10)),
            lambda: (body.jacobian(h.vector()), body.world_jacobian_classic_deriv()),
            lambda: body.relative_velocity(h.body(), h.body()),
        ]
    )()


@deed
def sense(h: Hands) -> None:
    frame = h.random.choice((h.body(), SimpleFrame(h.body(), translation=h.vector(3, 0.1))))
    noise: dict[str, Any] = {"noise": h.number(0.01), "rate": h.odd(None, 0.3)} if h.flip() else {}
    h.keep(
        h.random.choice(
            [
                lambda: IMU(frame, **noise),
                lambda: Lidar(frame, Lidar.fan(h.number(), h.odd(5)), max_distance=h.number(5.0), **noise),
                lambda: ForceTorque(h.joint(), **noise),
                lambda: JointEncoder(h.skel().dofs, **noise),
                lambda: Touch(h.body(), **noise),
            ]
        )()
    ).read()


@deed
def use_kept(h: Hands) -> None:
    """Handles of what may be gone."""
    thing = h.random.choice(h.kept or [h.world])
    name = h.random.choice([name for name in dir(type(thing)) if not name.startswith("_")])
    if name not in ("render", "render_with_ri", "build"):
        member = getattr(thing, name)
        if callable(member):
            member(*bounded(name, [h.random.choice(VALUES) for _ in range(h.random.randrange(3))]))


# Copies, files, batches, time


@deed
def copies_go_on_alike(h: Hands) -> None:
    """A copy has the numbers of its original, and steps bit for bit as it does, or both fail."""
    world = h.world
    manner = h.random.randrange(4)
    makers: list[Callable[[], pydart2.World]] = [
        world.clone,
        lambda: pickle.loads(pickle.dumps(world)),
        lambda: copy.deepcopy(world),
        world.clone,
    ]
    try:
        other = makers[manner]()
    except pickle.PicklingError:  # of a controller that has no name
        return
    n, copied = h.random.randrange(1, 12), f"a copy (manner {manner})"
    compare(world, f"what is read of {copied}", numbers_of(world), numbers_of(other))
    compare(world, copied, end_of(world, n), end_of(other, n))
    if h.flip():
        h.keep(world)
        h.world = other


def compare(world: pydart2.World, what: str, one: Any, other: Any) -> None:
    if np.array_equal(one, other, equal_nan=True):
        return
    far = np.abs(one - other).max() if one.shape == other.shape else math.nan
    how = [world.collision_detector_string(), world.constraint_solver(), world.dynamics(), world.integrator()]
    how += [f"{name}={getattr(world, name)()}" for name in ("warm_start", "contact_reduction", "is_deterministic")]
    how += [f"sleeping {len(world.sleepers())}"] if world.sleeping_options() else []
    soft = sum(isinstance(body, pydart2.SoftBodyNode) for skel in world.skeletons for body in skel.bodynodes)
    raise Wrong(f"{what} differs, by {far:.3g}: {how}, soft {soft}, {[type(c).__name__ for c in world.constraints]}")


@deed
def engine_goes_on_alike(h: Hands) -> None:
    """Our dynamics step bit for bit as the engine's, where the solver and the integrator are not our own.

    It may refuse a branch without inertia where we go on.
    """
    world = h.world
    ours = world.constraint_solver() == "iterative" or world.integrator() != "engine"
    if ours or world.dynamics() != "fast" or world.sleepers():  # who would wake
        return
    other, n = world.clone(), h.random.randrange(1, 6)
    other.set_dynamics("engine")
    try:
        other.step(n)
        theirs = other.x
    except pydart2.SimulationError as error:
        if "moves nothing that has inertia" in str(error):
            return
        theirs = np.array([other.frame])
    compare(world, "the engine", end_of(world, n), theirs)


def numbers_of(world: pydart2.World) -> Any:
    """Of all skeletons, what the engine or we keep until something changes."""
    return np.concatenate([np.ravel(numbers) for skel in world.skeletons for numbers in (skel.M, skel.c, skel.C)])


def end_of(world: pydart2.World, n: int) -> Any:
    try:
        world.step(n)
    except pydart2.SimulationError:
        return np.array([world.frame])
    return world.x


@deed
def go_back(h: Hands) -> None:
    """What is restored goes on bit for bit as before."""
    world, n = h.world, h.random.randrange(1, 8)
    snapshot = world.snapshot()
    once = end_of(world, n)
    world.restore(snapshot)
    compare(world, "what was restored", once, end_of(world, n))


@deed
def batch(h: Hands) -> None:
    if sum(skel.ndofs for skel in h.world.skeletons) > 60:
        return
    made = h.keep(pydart2.Batch(h.world, h.odd(3, 0.02), threads=2))
    n = made.skeleton.ndofs
    h.random.choice(
        [
            lambda: made.step(h.count(3)),
            lambda: made.rollout(None, h.odd(np.zeros((3, 3, n)), 0.2), hold=h.count(2)),
            lambda: made.set_mass(h.body().name, h.vector(3, 1.0, False)),
            lambda: setattr(made, "q", h.odd(np.zeros((3, n)))),
            lambda: made.contacts,
            made.reset,
        ]
    )()


@deed
def save(h: Hands) -> None:
    world, skel = h.world, h.skel()
    with tempfile.TemporaryDirectory() as folder:
        kind = h.random.choice(("skel", "sdf", "urdf", "xml"))
        text = h.random.choice(
            [
                lambda: world.save(Path(folder) / f"world.{kind}"),
                lambda: skel.save(Path(folder) / f"skeleton.{kind}"),
                lambda: skel.to_mjcf(),
                lambda: skel.to_skel(),
                lambda: skel.to_urdf(),
                lambda: skel.to_sdf(),
                lambda: world.snapshot().save(Path(folder) / "state.npz"),
            ]
        )()
        if text is not None and h.has_room() and h.flip():
            world.add_skeleton(text, safe=False)


@deed
def ask_recording(h: Hands) -> None:
    recording: Any = h.world.recording
    frame = h.odd(h.random.randrange(0, h.world.num_frames() + 2))
    h.random.choice(
        [
            lambda: h.keep(recording.run),
            lambda: recording.q(h.random.choice((None, h.skel()))),
            lambda: recording.dq(),
            lambda: recording.contacts(frame),
            lambda: recording.states(frame),
            lambda: h.world.set_frame(frame),
            lambda: setattr(recording, "limit_bytes", h.odd(100_000, 0.3)),
            recording.clear,
            recording.bake,
        ]
    )()


@deed
def reset(h: Hands) -> None:
    h.world.reset()


@deed
def step(h: Hands) -> None:
    h.world.step(h.random.randrange(1, 8))
