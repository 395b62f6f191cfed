"""Builds the bodies and joints of a compiled model."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from pydart2._native import BodyNodeHandle, JointHandle, WorldHandle
from pydart2.mjcf.compile import Compiled
from pydart2.mjcf.coordinates import Coordinates, JointPlace
from pydart2.mjcf.geoms import add_geoms, add_sites
from pydart2.poses import pose, rotation

_Array = NDArray[np.float64]
KINDS = ("free", "ball", "slide", "hinge")  # mjtJoint
_TYPES = {"ball": "BallJoint", "slide": "PrismaticJoint", "hinge": "RevoluteJoint"}
_NO_AXES = np.zeros((0, 3))
_POINT = 1e-6  # m, how large a mass without a moment of inertia is here


@dataclass
class Built:
    """The skeletons of a model: where each of its bodies is.

    Attributes
    ----------
    places
        MuJoCo's body → index of the skeleton in the world, index of the body in that.
    coordinates
        Index of the skeleton → its map.
    """

    places: dict[int, tuple[int, int]] = field(default_factory=dict)
    coordinates: dict[int, Coordinates] = field(default_factory=dict)


def name_of(model: Compiled, kind: str, index: int) -> str:
    """The name of an element, or one made of its kind and number."""
    return str(getattr(model, kind)(index).name) or f"{kind}{index}"


def trees_of(model: Compiled) -> dict[int, list[int]]:
    """The bodies of each tree, parents first."""
    trees: dict[int, list[int]] = {}
    for body in range(1, model.nbody):
        if model.body_treeid[body] >= 0:
            trees.setdefault(int(model.body_treeid[body]), []).append(body)
    return trees


def world_poses(model: Compiled) -> list[_Array]:
    """The pose of each body where all joints are at qpos0."""
    poses = [np.eye(4)]
    for body in range(1, model.nbody):
        poses.append(poses[model.body_parentid[body]] @ pose(model.body_pos[body], model.body_quat[body]))
    return poses


def add_static(model: Compiled, world: WorldHandle, built: Built) -> None:
    """One skeleton of one body for all geoms that cannot move, if there are any."""
    still = [body for body in range(model.nbody) if model.body_treeid[body] < 0]
    if not any(model.body_geomnum[body] for body in still):
        return
    index = world.add_empty_skeleton("static")
    world.skeleton(index).add_body(-1, "static", "WeldJoint", "static_joint", _NO_AXES)
    handle, poses = world.skeleton(index).bodynode(0), world_poses(model)
    for body in still:
        built.places[body] = (index, 0)
        add_geoms(model, handle, body, poses[body], mass=False)
        add_sites(model, handle, body, poses[body])


def add_tree(model: Compiled, world: WorldHandle, bodies: list[int], built: Built) -> int:
    """A skeleton of the bodies of a tree; returns its index."""
    tree = _Tree(model, world, bodies, built)
    for body in bodies:
        tree.add(body)
    built.coordinates[tree.index] = Coordinates(tuple(tree.joints), world.skeleton(tree.index).num_dofs())
    return tree.index


class _Tree:
    def __init__(self, model: Compiled, world: WorldHandle, bodies: list[int], built: Built) -> None:
        self.model, self.world, self.built = model, world, built
        self.index = world.add_empty_skeleton(name_of(model, "body", bodies[0]))
        self.outside = world_poses(model)[model.body_parentid[bodies[0]]]
        self.joints: list[JointPlace] = []

    def add(self, body: int) -> None:
        """A body with the chain of its joints."""
        model = self.model
        parent = self.built.places.get(model.body_parentid[body], (-1, -1))
        above = parent[1] if parent[0] == self.index else -1
        where = pose(model.body_pos[body], model.body_quat[body])
        if above < 0:
            where = self.outside @ where
        name, first = name_of(model, "body", body), int(model.body_jntadr[body])
        joints = range(first, first + model.body_jntnum[body])
        if not joints:
            above = self._link(above, name, "WeldJoint", f"{name}_weld", _NO_AXES)
            self._joint(above).place(where)
        for joint in joints:
            title = name_of(model, "joint", joint)
            link = name if joint == joints[-1] else f"{name}/{title}"
            above = self._add_joint(above, link, title, joint, where)
            where = np.eye(4)
        self.built.places[body] = (self.index, above)
        handle = self.world.skeleton(self.index).bodynode(above)
        self._weigh(handle, body)
        add_geoms(model, handle, body, np.eye(4), mass=True)
        add_sites(model, handle, body, np.eye(4))

    def _link(self, parent: int, name: str, kind: str, joint: str, axes: _Array) -> int:
        return self.world.skeleton(self.index).add_body(parent, name, kind, joint, axes)

    def _joint(self, body: int) -> JointHandle:
        skeleton = self.world.skeleton(self.index)
        return skeleton.joint(skeleton.bodynode(body).parent_joint())

    def _add_joint(self, parent: int, name: str, title: str, joint: int, where: _Array) -> int:
        model, kind = self.model, KINDS[int(self.model.jnt_type[joint])]
        dofs = self.world.skeleton(self.index).num_dofs()
        place = JointPlace(kind, int(model.jnt_qposadr[joint]), int(model.jnt_dofadr[joint]), dofs)
        self.joints.append(place)
        start = model.qpos0[place.qpos :]
        if kind == "free":
            index = self._link(parent, name, "FreeJoint", title, _NO_AXES)
            self._joint(index).place(pose(start[:3], start[3:7]))
            return index
        axis, anchor = np.array(model.jnt_axis[joint]), pose(model.jnt_pos[joint])
        index = self._link(parent, name, _TYPES[kind], title, axis[None] if kind != "ball" else _NO_AXES)
        handle = self._joint(index)
        handle.set_transform_from_child_body_node(anchor)
        # q is qpos, so the joint's frame is turned or moved back by the position where the body is as the file says.
        handle.set_transform_from_parent_body_node(where @ anchor @ _displacement(kind, axis, -float(start[0])))
        self._set_dofs(place, joint)
        return index

    def _set_dofs(self, place: JointPlace, joint: int) -> None:
        model, skeleton = self.model, self.world.skeleton(self.index)
        one = place.kind != "ball"
        for i in range(1 if one else 3):
            dof, theirs = skeleton.dof(place.dof + i), place.qvel + i
            dof.set_damping_coefficient(max(0.0, float(np.ravel(model.dof_damping)[theirs])))
            dof.set_armature(float(model.dof_armature[theirs]))
            dof.set_coulomb_friction(float(model.dof_frictionloss[theirs]))
            if not one:
                continue
            dof.set_spring_stiffness(max(0.0, float(np.ravel(model.jnt_stiffness)[joint])))
            dof.set_rest_position(float(model.qpos_spring[place.qpos]))
            dof.set_initial_position(float(model.qpos0[place.qpos]))
            dof.set_position(float(model.qpos0[place.qpos]))
            if model.jnt_limited[joint]:
                dof.set_position_lower_limit(float(model.jnt_range[joint][0]))
                dof.set_position_upper_limit(float(model.jnt_range[joint][1]))
                skeleton.joint(skeleton.num_joints() - 1).set_position_limit_enforced(True)  # the newest

    def _weigh(self, handle: BodyNodeHandle, body: int) -> None:
        model, mass = self.model, float(self.model.body_mass[body])
        if mass > 0.0:
            turn = rotation(model.body_iquat[body])
            moments = np.maximum(model.body_inertia[body], _POINT**2 * mass)
            handle.add_mass(mass, model.body_ipos[body], turn @ np.diag(moments) @ turn.T)
        if float(model.body_gravcomp[body]) == 1.0:
            handle.set_gravity_mode(False)


def _displacement(kind: str, axis: _Array, amount: float) -> _Array:
    if kind == "slide":
        return pose(axis * amount)
    if kind == "hinge" and amount != 0.0:
        return pose(np.zeros(3), [np.cos(amount / 2), *(np.sin(amount / 2) * axis)])
    return np.eye(4)
