"""Ten limp humans of 33 dofs poured on each other for 3 s, beside MuJoCo with what we export, in turn.

Ours with the native detector and the iterative solver at their default settings; MuJoCo at its own, where bodies of one
human pass through each other as here.

    python benchmarks/ragdolls.py
"""

from __future__ import annotations

import sys
import tempfile
import time
from pathlib import Path

import mujoco
import numpy as np

import pydart2

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests"))

from physics.models import add_ragdoll

COUNT, DT, PIECES, STEPS = 10, 0.001, 60, 50


def ours() -> pydart2.World:
    """The humans above the ground, one over the other."""
    world = pydart2.World(DT, up="z")
    world.set_recording(False)
    world.set_collision_detector("native")
    world.set_constraint_solver("iterative")
    world.add_ground(size=(200.0, 200.0))
    for i in range(COUNT):
        add_ragdoll(world, f"doll {i}", 1.2 + 0.8 * i, float(np.sin(7.0 * i)))
    return world


def theirs(world: pydart2.World) -> tuple[mujoco.MjModel, mujoco.MjData]:
    """The same in MuJoCo, where they are now."""
    with tempfile.TemporaryDirectory() as folder:
        path = str(Path(folder) / "ragdolls.xml")
        world.save(path)
        model = mujoco.MjModel.from_xml_path(path)
    roots = [body for body in range(1, model.nbody) if model.body_rootid[body] == body]
    for geom in range(model.ngeom):
        bit = 1 << roots.index(model.body_rootid[model.geom_bodyid[geom]])
        model.geom_contype[geom], model.geom_conaffinity[geom] = bit, (1 << len(roots)) - 1 - bit
    data = mujoco.MjData(model)
    place(model, data, world)
    return model, data


def place(model: mujoco.MjModel, data: mujoco.MjData, world: pydart2.World) -> None:
    """Put the roots of theirs where ours are."""
    free = [joint for joint in range(model.njnt) if model.jnt_type[joint] == mujoco.mjtJoint.mjJNT_FREE]
    for joint, doll in zip(free, world.skeletons[1:], strict=True):
        pose, begin = doll.bodynodes[0].T, model.jnt_qposadr[joint]
        data.qpos[begin : begin + 3] = pose[:3, 3]
        mujoco.mju_mat2Quat(data.qpos[begin + 3 : begin + 7], pose[:3, :3].flatten())


def main() -> None:
    """Both in turn, in time of the processor."""
    world = ours()
    model, data = theirs(world)
    times, contacts = np.zeros(2), np.zeros(2, dtype=int)
    for _ in range(PIECES):
        begin = time.process_time()
        world.step(STEPS)
        middle = time.process_time()
        mujoco.mj_step(model, data, STEPS)
        times += (middle - begin, time.process_time() - middle)
        contacts = np.maximum(contacts, (len(world.collision_result.contacts), data.ncon))
    lowest = min(body.C[2] for doll in world.skeletons[1:] for body in doll.bodynodes)
    print(f"ours {times[0]:.2f} s, MuJoCo {times[1]:.2f} s, ratio {times[0] / times[1]:.2f}")
    print(f"contacts at most {contacts[0]} / {contacts[1]}, our lowest body at {lowest:.3f} m")


if __name__ == "__main__":
    main()
