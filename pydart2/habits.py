"""What names of other libraries are here, for the sentence that answers them.

>>> robot.qpos
AttributeError: Skeleton has no 'qpos'; here that is robot.q
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from functools import lru_cache

#: Class → name elsewhere, in snake case → what does it here. Of MuJoCo, PyBullet, dartpy, and Gymnasium.
ELSEWHERE: Mapping[str, Mapping[str, str]] = {
    "World": {
        "load_urdf": "world.add_skeleton(path)",
        "load_sdf": "world.add_skeleton(path)",
        "load_mjcf": "World(dt, path)",
        "load": "world.add_skeleton(path)",
        "add_robot": "world.add_skeleton(path)",
        "add_plane": "world.add_ground()",
        "create_multi_body": "world.add_box() or world.add_skeleton(path)",
        "step_simulation": "world.step()",
        "reset_simulation": "world.reset()",
        "save_state": "world.snapshot()",
        "restore_state": "world.restore(snapshot)",
        "get_contact_points": "body.contacts",
        "last_collision_result": "world.collision_result",
        "ray_test": "world.raycast(origins, directions)",
        "get_camera_image": "pydart2.gui.render(world)",
        "view": "pydart2.gui.viewer.launch(world)",
        "launch": "pydart2.gui.viewer.launch(world)",
        "show": "pydart2.gui.viewer.launch(world)",
        "record": "pydart2.gui.record(world, path, seconds=5)",
        "bodies": "world.skeletons",
        "robots": "world.skeletons",
        "num_bodies": "world.num_skeletons()",
        "qpos": "skel.q; world.x is the state of all",
        "qvel": "skel.dq; world.x is the state of all",
        "ctrl": "skel.tau, or skel.set_targets()",
    },
    "Skeleton": {
        "qpos": "skel.q",
        "qvel": "skel.dq",
        "qacc": "skel.ddq",
        "ctrl": "skel.tau, or skel.set_targets()",
        "torque": "skel.tau",
        "torques": "skel.tau",
        "set_torques": "skel.tau = ..., or skel.set_forces()",
        "qfrc_applied": "skel.tau",
        "qfrc_bias": "skel.c",
        "joint_positions": "skel.q",
        "joint_velocities": "skel.dq",
        "joint_states": "skel.q and skel.dq",
        "nq": "skel.ndofs",
        "nv": "skel.ndofs",
        "nbody": "skel.num_bodynodes()",
        "bodies": "skel.bodynodes",
        "links": "skel.bodynodes",
        "num_dofs": "skel.ndofs",
        "num_body_nodes": "skel.num_bodynodes()",
        "body_node": "skel.body(name)",
        "position": "skel.q, skel.body(name).T or skel.C",
        "pos": "skel.q, skel.body(name).T or skel.C",
        "step": "skel.world.step()",
        "set_joint_motor_control": "skel.set_targets()",
        "calculate_inverse_kinematics": "skel.inverse_kinematics()",
        "calculate_inverse_dynamics": "skel.inverse_dynamics()",
        "calculate_mass_matrix": "skel.M",
    },
    "BodyNode": {
        "pos": "body.T[:3, 3]",
        "xpos": "body.T[:3, 3]",
        "position": "body.T[:3, 3], or body.C of its centre of mass",
        "xmat": "body.T[:3, :3]",
        "rotation": "body.T[:3, :3]",
        "orientation": "body.T[:3, :3]",
        "quat": "body.T[:3, :3], by pydart2.utils.transformations.quaternion_from_matrix(body.T)",
        "xquat": "body.T[:3, :3], by pydart2.utils.transformations.quaternion_from_matrix(body.T)",
        "xipos": "body.C",
        "velocity": "body.world_linear_velocity()",
        "cvel": "body.world_linear_velocity() and world_angular_velocity()",
        "xfrc_applied": "body.add_ext_force()",
        "apply_external_force": "body.add_ext_force()",
        "apply_force": "body.add_ext_force()",
    },
    "Joint": {
        "position": "joint.dofs[0].position()",
        "set_position": "joint.dofs[0].set_position()",
        "qpos": "joint.dofs[0].position()",
        "limits": "joint.dofs[0].position_lower_limit() and position_upper_limit()",
    },
    "Dof": {
        "qpos": "dof.position()",
        "qvel": "dof.velocity()",
        "limits": "dof.position_lower_limit() and position_upper_limit()",
    },
    "pydart2": {
        "connect": "pydart2.World(dt); there is no server",
        "load": "pydart2.World(dt, path), or world.add_skeleton(path)",
        "load_urdf": "world.add_skeleton(path)",
        "mj_model": "pydart2.World(dt, path)",
        "render": "pydart2.gui.render(world)",
        "record": "pydart2.gui.record(world, path, seconds=5)",
        "view": "pydart2.gui.viewer.launch(world)",
        "viewer": "pydart2.gui.viewer",
        "launch": "pydart2.gui.viewer.launch(world)",
        "set_gravity": "world.set_gravity()",
        "step_simulation": "world.step()",
        "mj_step": "world.step()",
    },
}


def here(cls: type, name: str) -> str | None:
    """What a name of another library is in a class: from the table, or the same words in the style of this package."""
    words = snake(name)
    for base in cls.__mro__:
        found = ELSEWHERE.get(base.__name__, {}).get(words)
        if found is not None:
            return found
    same = next((known for known in _without_get(words) if known != name and hasattr(cls, known)), None)
    return None if same is None else f"{_owner(cls)}.{same}{'' if isinstance(getattr(cls, same), property) else '()'}"


def in_package(name: str) -> str | None:
    """What a name of another library's module is."""
    return ELSEWHERE["pydart2"].get(snake(name))


@lru_cache
def answer(cls: type, name: str) -> str:
    """The sentence for an attribute that a class does not have."""
    from pydart2.errors import nearest

    found = here(cls, name)
    if found is not None:
        return f"{cls.__name__} has no {name!r}; here that is {found}"
    near = nearest(name, [known for known in dir(cls) if not known.startswith("_")], cutoff=0.7)
    return f"{cls.__name__} has no {name!r}" + ("" if near is None else f"; did you mean {near!r}?")


def snake(name: str) -> str:
    """`getNumDofs` as `get_num_dofs`, `loadURDF` as `load_urdf`."""
    return re.sub(r"(?<=[a-z0-9])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])", "_", name).lower()


def _without_get(words: str) -> Iterable[str]:
    """A name, and without the verb that is none here."""
    yield words
    yield words.removeprefix("get_")


def _owner(cls: type) -> str:
    names = {
        "World": "world",
        "Skeleton": "skel",
        "BodyNode": "body",
        "Joint": "joint",
        "Dof": "dof",
        "Marker": "marker",
    }
    return next((names[base.__name__] for base in cls.__mro__ if base.__name__ in names), cls.__name__.lower())
