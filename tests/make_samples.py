"""Writes tests/samples: what a release saved, for later ones to read and go on with.

    PYTHONPATH=tests python tests/make_samples.py

A pickle for each class that pickles, a snapshot and a recording as files, and what each gave when it was loaded and
went on, in `told.npz`. tests/unit/test_samples.py reads them. Samples of a release stay as they are: run this for a
class that has none yet, which is added, and with ``--anew`` only where the format changes on purpose.
"""

from __future__ import annotations

import hashlib
import lzma
import math
import pickle
import platform
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

import pydart2
from physics.models import body, creature, floor, joint, skel_text, skeleton
from pydart2 import constraints, sensors
from pydart2.targets import Targets

FOLDER = Path(__file__).parent / "samples"
TOLD = FOLDER / "told.npz"
STEPS = 20
Numbers = NDArray[np.float64]

ROBOT = """<robot name="crane">
 <link name="mast"/>
 <link name="beam"><inertial><origin xyz="0.5 0 0"/><mass value="2"/>
  <inertia ixx="0.1" iyy="0.2" izz="0.2" ixy="0" ixz="0" iyz="0"/></inertial>
  <collision><geometry><cylinder radius="0.05" length="0.3"/></geometry></collision></link>
 <link name="hook"><inertial><mass value="1"/>
  <inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial>
  <collision><geometry><sphere radius="0.1"/></geometry></collision></link>
 <joint name="swing" type="revolute"><parent link="mast"/><child link="beam"/><origin xyz="0 2 0"/>
  <axis xyz="0 1 0"/><limit lower="-1" upper="1" effort="10" velocity="10"/></joint>
 <joint name="rail" type="prismatic"><parent link="beam"/><child link="hook"/><origin xyz="1 0 0"/>
  <axis xyz="1 0 0"/><limit lower="-1" upper="1" effort="10" velocity="10"/></joint>
</robot>"""

MESH = (
    [[0.0, 0.0, 0.0], [0.2, 0.0, 0.0], [0.0, 0.2, 0.0], [0.0, 0.0, 0.2]],
    [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]],
)


def fall(skel: pydart2.Skeleton, time: float) -> Numbers:
    """Forces of the sample with a controller; found again by its name, as pickle does."""
    return 0.1 * np.sin(time + np.arange(skel.ndofs))


class Shaking:
    """A controller that holds its skeleton."""

    def __init__(self, skel: pydart2.Skeleton) -> None:
        self.skel = skel

    def compute(self) -> Numbers:
        return fall(self.skel, self.skel.world.t)


def marked() -> str:
    """A rod on a ball with two markers, as SKEL files have them."""
    rod = body("rod", com=(0.0, -0.5, 0.0), at=(3.0, 3.0, 0.0, 0.0, 0.0, 0.0)).replace(
        "</body>", '<marker name="tip" offset="0 -1 0"/><marker name="side" offset="0.1 0 0"/></body>'
    )
    return skeleton(rod, joint("ball", "rod", name="ball"), name="marked")


def make_world() -> pydart2.World:
    """A floor, a creature that has fallen on it, a crane with motors, markers, soft and built bodies, constraints."""
    world = pydart2.World(0.002, skel_text(floor(), creature(), marked()).replace(">dart<", ">fcl_mesh<"), xmlstr=True)
    world.constraint_error_reduction = 0.01  # the default of what wrote the snapshot
    crane = world.add_skeleton(ROBOT, massless=True, base="fixed")
    crane.set_targets({"swing": 0.5}, kp=20.0, kd=2.0)
    crane.dof("rail").set_damping_coefficient(3.0)
    box = world.add_box([0.2, 0.3, 0.4], 1.5, [4.0, 0.2, 0.0], name="box")
    ball = world.add_sphere(0.2, 1.0, [4.0, 0.8, 0.1], name="ball")
    world.add_mesh(*MESH, 0.5, [5.0, 0.2, 0.0], name="wedge")
    world.add_soft_box([0.3, 0.3, 0.3], 1.0, [6.0, 0.2, 0.0], name="cushion")
    constraints.BallJointConstraint(box.bodynodes[0], ball.bodynodes[0], [4.0, 0.6, 0.1]).add_to_world(world)
    world.exclude_collisions("ball", "box")
    creature_ = world.skeletons[1]
    creature_.q = 0.1 * np.arange(creature_.ndofs)
    creature_.controller = Shaking(creature_)
    world.note = {"of": "the user"}  # type: ignore[attr-defined]
    world.set_recording(True)
    world.step(60)
    return world


def samples() -> Iterator[tuple[str, Any]]:
    """What is stored, by the name of its class."""
    world = make_world()
    skels = world.skeletons
    _, animal, marked_, crane, box, ball, wedge, cushion = skels
    yield "World", world
    yield "Skeleton", crane
    yield "BodyNode", box.bodynodes[0]
    yield "SoftBodyNode", cushion.bodynodes[0]
    yield "Dof", crane.dof("rail")
    yield "Marker", marked_.markers[1]
    yield from {type(j).__name__: j for s in skels for j in s.joints}.items()
    nodes = [node for s in skels for b in s.bodynodes for node in b.shapenodes]
    yield "ShapeNode", nodes[0]
    yield from {type(n.shape).__name__: n.shape for n in nodes if n.shape is not None}.items()
    yield "SkelVector", animal.q
    yield "CollisionResult", world.collision_result.copy()
    yield "Contact", world.collision_result.contacts[0]
    yield "Contacts", animal.contacts
    yield "Recording", world.recording
    yield "Run", world.recording.run if world.recording else None
    yield "Snapshot", world.snapshot()
    yield "CollisionFilter", world.collision_filter
    yield "Constraint", world.constraints[0]
    yield "SimpleFrame", pydart2.SimpleFrame(box.bodynodes[0], translation=[0.0, 0.1, 0.0])
    yield "Targets", crane.targets
    yield "Target", pydart2.Target(position=[0.1, 0.2, 0.3], weight=2.0)
    yield "IKResult", crane.inverse_kinematics({"hook": [1.5, 2.0, 0.3]})
    yield "InverseDynamicsDerivatives", crane.inverse_dynamics_derivatives(crane.ddq)
    yield "ForwardDynamicsDerivatives", crane.forward_dynamics_derivatives(crane.tau)
    yield "RayHits", world.raycast([4.0, 5.0, 0.0], [[0.0, -1.0, 0.0], [1.0, 0.0, 0.0]])
    yield "Distances", world.distance("ball", "wedge")
    yield "DofArray", world.recording.q(crane) if world.recording else None
    animal.controller = None
    batch = pydart2.Batch(world, 2, threads=1, skeleton=3)
    yield "Trajectories", batch.rollout(None, np.zeros((2, 3, crane.ndofs)))
    yield "Batch", batch
    imu = sensors.IMU(box.bodynodes[0], noise=0.1, seed=3)
    yield "IMU", imu
    yield "JointEncoder", sensors.JointEncoder(crane.dofs, bias=0.5)
    yield "ForceTorque", sensors.ForceTorque(crane.joint("rail"), rate=100.0)
    yield "Touch", sensors.Touch(box.bodynodes[0])
    yield "Lidar", sensors.Lidar(ball.bodynodes[0], sensors.Lidar.fan(1.0, 5), ignore=box)
    yield "Sensors", sensors.Sensors([imu, sensors.Touch(wedge.bodynodes[0])])
    for error in (pydart2.NameNotFound("dof", "kne", "skeleton 'x'", ["knee"]), pydart2.SimulationError("it blew up")):
        yield type(error).__name__, error


def tell(sample: Any) -> list[Numbers]:
    """What a sample says, and where its world goes on to, as arrays."""
    said = [np.asarray(value, dtype=float) for value in of_its_own(sample)]
    world = world_of(sample)
    if world is not None:
        world.step()
        soon = world.x
        world.step(STEPS - 1)
        said += [soon, world.x, world.collision_result.rows.sum(axis=0), np.array([world.t, world.frame])]
        said += [np.asarray(value, dtype=float) for value in of_its_own(sample)]
    return said


def world_of(sample: Any) -> pydart2.World | None:
    """The world that a sample has brought with it."""
    if isinstance(sample, pydart2.World):
        return sample
    if isinstance(sample, sensors.Sensors):
        return world_of(sample.sensors[0])
    if isinstance(sample, constraints.Constraint):
        return world_of(sample.body1)
    if isinstance(sample, pydart2.SimpleFrame):
        return world_of(sample.parent)
    owner = getattr(sample, "world", None) or getattr(getattr(sample, "skeleton", None), "world", None)
    return owner if isinstance(owner, pydart2.World) and not isinstance(sample, pydart2.Batch) else None


def error_numbers(error: BaseException) -> list[Any]:
    """The characters of its sentence."""
    return [np.frombuffer(str(error).encode(), dtype=np.uint8)]


def batch_numbers(batch: pydart2.Batch) -> list[Any]:
    """Where the worlds of a batch go on to, and are after a reset."""
    before = [batch.q, batch.dq, batch.t]
    batch.step(STEPS)
    after = [batch.q, batch.dq, batch.contacts]
    batch.reset()
    return [*before, *after, batch.q]


#: What is read of each class, the nearest base first that stands here.
READ: dict[type, Callable[[Any], list[Any]]] = {
    pydart2.World: lambda w: [
        w.x,
        w.g,
        w.dt,
        w.recording.t,
        w.note["of"] == "the user",
        [s.ndofs for s in w.skeletons],
    ],
    pydart2.Skeleton: lambda s: [s.q, s.dq, s.tau, s.M, s.c, s.C, s.id],
    pydart2.SoftBodyNode: lambda b: [b.T, b.point_displacements(), b.point_velocities(), b.id],
    pydart2.BodyNode: lambda b: [b.T, b.mass(), b.inertia(), b.J, b.contact_force(), b.id],
    pydart2.Joint: lambda j: [j.position_in_world_frame(), j.get_local_transform(), j.num_dofs(), j.wrench(), j.id],
    pydart2.Dof: lambda d: [d.position(), d.velocity(), d.damping_coefficient(), d.position_lower_limit(), d.id],
    pydart2.Marker: lambda m: [m.p, m.local_position(), m.id],
    pydart2.ShapeNode: lambda n: [n.world_transform(), n.has_collision_aspect(), n.id],
    pydart2.Shape: lambda s: [s.volume(), *s.bounding_box(), s.type_id()],
    pydart2.SkelVector: lambda v: [v, [len(key) for key in v.keys], v[v.keys[1]]],
    pydart2.CollisionResult: lambda r: [r.rows, r.num_contacted_bodies()],
    pydart2.Contact: lambda c: [c.point, c.force, c.normal, c.depth, c.state, c.bodynode1.T],
    pydart2.Contacts: lambda c: [c.points, c.forces, c.normals, c.depths, c.ids, c.force],
    pydart2.Recording: lambda r: [r.t, r.states(0), r.contacts(0).rows, r.q("crane")],
    pydart2.Run: lambda r: [r.t, r.states, r["crane.rail"], r.contacts(40).forces],
    pydart2.Snapshot: lambda s: [s.values, s.contacts, s.time, s.frame],
    pydart2.collision_filter.CollisionFilter: lambda f: [len(f.world.excluded_collisions)],
    constraints.Constraint: lambda c: [c.body1.T, c.body2.T, c.force()],
    pydart2.SimpleFrame: lambda f: [f.T, f.relative],
    Targets: lambda t: [t.q, t.dq, t.kp, t.kd, t.kp["swing"]],
    pydart2.Target: lambda t: [t.position, t.weight],
    pydart2.IKResult: lambda r: [r.q, r.residual, r.iterations],
    tuple: list,
    pydart2.queries.RayHits: lambda h: [h.distances, h.points, h.normals, h.skeletons],
    pydart2.queries.Distances: lambda d: [d.distances, d.points, d.skeletons],
    pydart2.batch.DofArray: lambda a: [a],
    pydart2.batch.Trajectories: lambda t: [t.states, t.q, t.dq],
    pydart2.Batch: batch_numbers,
    sensors.Sensor: lambda s: [s.read(), s.measure(), len(s.labels)],
    sensors.Sensors: lambda s: [s.read(), len(s.labels)],
    BaseException: error_numbers,
}


def of_its_own(sample: Any) -> list[Any]:
    """The numbers of a sample itself."""
    return next(READ[cls] for cls in type(sample).__mro__ if cls in READ)(sample)


def processor() -> str:
    """What bits depend on: the engine, the kind of processor, and what its library gives for sines and powers."""
    x = np.linspace(0.1, 20.0, 500)
    numbers = [math.sin(v) for v in x] + [math.exp(-v) for v in x] + [v**0.3 for v in x]
    digest = hashlib.sha256(np.array(numbers).tobytes() + np.outer(x, x).dot(x).tobytes()).hexdigest()
    return f"DART {pydart2.engine_info().dart}, {platform.machine()} {digest[:16]}"


def read(name: str) -> Any:
    """A pickle that is stored."""
    return pickle.loads(lzma.decompress((FOLDER / f"{name}.pickle.xz").read_bytes()))


def keys(name: str, told: list[Numbers]) -> dict[str, Numbers]:
    """Their places in the file."""
    return {f"{name}.{i}": value for i, value in enumerate(told)}


def main() -> None:
    """Store what is not there yet."""
    anew = "--anew" in sys.argv
    FOLDER.mkdir(exist_ok=True)
    stored: dict[str, Any] = {} if anew or not TOLD.exists() else dict(np.load(TOLD))
    for name, sample in samples():
        path = FOLDER / f"{name}.pickle.xz"
        if path.exists() and not anew:
            continue
        path.write_bytes(lzma.compress(pickle.dumps(sample, protocol=4)))
        stored |= keys(name, tell(read(name)))
    world = make_world()
    if anew or not (FOLDER / "snapshot.npz").exists():
        assert world.recording is not None
        world.recording.save(FOLDER / "recording.npz")
        world.snapshot().save(FOLDER / "snapshot.npz")
        stored |= keys("recording.npz", tell(pydart2.Run.load(FOLDER / "recording.npz")))
        world.restore(pydart2.Snapshot.load(FOLDER / "snapshot.npz"))
        stored |= keys("snapshot.npz", tell(world))
    stored["processor"] = np.array(processor())
    np.savez_compressed(TOLD, **stored)


if __name__ == "__main__":
    # Pickles name classes by their module: this one under the name by which the tests import it.
    import make_samples

    make_samples.main()
