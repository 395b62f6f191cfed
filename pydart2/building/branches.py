"""Branches of skeletons, a body with all that hangs from it: they get another parent, come off, or are copied."""

from __future__ import annotations

import itertools
from typing import TYPE_CHECKING, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pydart2.building.skeletons import SkeletonBuilding, axes_of, check_joint, engine_name, set_joint
from pydart2.poses import pose

if TYPE_CHECKING:
    from pydart2.bodynode import BodyNode
    from pydart2.joint import Joint
    from pydart2.skeleton import Skeleton


class Branches(SkeletonBuilding):
    """The part of Skeleton that attaches, detaches and copies branches."""

    def attach(
        self,
        body: BodyNode | str | int,
        parent: BodyNode | str | int | None = None,
        joint: str = "weld",
        *,
        joint_name: str | None = None,
        position: ArrayLike | None = None,
        orientation: ArrayLike | None = None,
        joint_position: ArrayLike = (0.0, 0.0, 0.0),
        joint_orientation: ArrayLike | None = None,
        axis: ArrayLike | None = None,
        pitch: float = 0.0,
        order: str = "XYZ",
        limits: ArrayLike | None = None,
        damping: ArrayLike | None = None,
        stiffness: ArrayLike | None = None,
        rest: ArrayLike | None = None,
        friction: ArrayLike | None = None,
        armature: ArrayLike | None = None,
    ) -> BodyNode:
        """Hang a body, with all that hangs from it, from another parent by a new joint.

        The bodies, their joints, shapes and markers, what collides with what, and cameras on them stay as they are, but
        come last in this skeleton. Those of another skeleton of the world belong to this one from then on, with a
        number after names that are taken; what they leave may have no body any more.

        Parameters
        ----------
        body
            Of any skeleton of the world; a name or index is of this one.
        parent
            A body of this skeleton, its name or index; None for the world.
        position, orientation
            Pose of the body in its parent at q = 0, as in `add_body`; with neither it stays where it is now. A free
            joint then keeps the velocity, too; other joints begin at rest.
        joint, joint_name, joint_position, joint_orientation, axis, pitch, order
            As in `add_body`; the joint's name gets a number if none is given and another joint has it.
        limits, damping, stiffness, rest, friction, armature
            As in `add_body`.

        Returns
        -------
        BodyNode
            The body, the same object.

        Raises
        ------
        ValueError
            If the parent hangs from the body, the body is of another world, the joint's name is taken, an argument does
            not fit the joint, a joint follows one that it would be parted from, a muscle pulls at what leaves its
            skeleton, or dofs have targets or a constraint holds either skeleton.
        """
        branch = self._branch(body)
        above = None if parent is None else self._own_body(parent)
        stays = position is None and orientation is None
        here = (
            branch.world_transform()
            if above is None
            else np.linalg.inv(above.world_transform()) @ branch.world_transform()
        )
        where = here if stays else pose((0.0, 0.0, 0.0) if position is None else position, orientation)
        in_body, velocity = pose(joint_position, joint_orientation), branch.world_spatial_velocity()
        numbers = {"damping": damping, "stiffness": stiffness, "rest": rest, "friction": friction, "armature": armature}
        check_joint(branch.name, joint, pitch, order, limits, numbers)
        name = joint_name or self._free_name(f"{branch.name}_joint", branch.parent_joint)
        self._hang(branch, above, engine_name(joint), name, axes_of(joint, axis))
        set_joint(branch.parent_joint, where, in_body, pitch, order, limits, numbers)
        if joint == "free" and stays:
            _set_velocity(branch, velocity)
        return branch

    def detach(self, body: BodyNode | str | int, name: str | None = None) -> Skeleton:
        """Make a branch a skeleton of its own, free to move, at the pose and with the velocity that it has.

        Parameters
        ----------
        body
            Of this skeleton, or its name or index; it goes with all that hangs from it.
        name
            Of the new skeleton, by default the body's; a number is added if it is taken.

        Raises
        ------
        ValueError
            As `attach`.
        """
        branch = self._own_body(body)
        skel, world = cast("Skeleton", self), self.world
        with world._all_or_nothing():
            own = world.add_skeleton_from_id(world._handle.add_empty_skeleton(branch.name if name is None else name))
            own.set_self_collision_check(skel.self_collision_check())
            own.set_adjacent_body_check(skel.adjacent_body_check())
            own.set_mobile(skel.is_mobile())
            own._z_up = skel._z_up
            own.attach(branch, None, "free")
        return own

    def copy_branch(self, body: BodyNode | str | int, parent: BodyNode | str | int | None = None) -> BodyNode:
        """Add a copy of a body with all that hangs from it: joints and their state, shapes, markers, what collides.

        The joint to the parent is a copy, too; `attach` changes it. Names that are taken get a number; points of soft
        bodies begin at rest. Targets, constraints and cameras are not copied.

        Parameters
        ----------
        body
            Of any skeleton of the world; a name or index is of this one.
        parent
            A body of this skeleton, its name or index; None for the world.

        Raises
        ------
        ValueError
            If the body is of another world, a joint of the branch follows one outside it, or dofs of this skeleton have
            targets or a constraint holds it.
        """
        branch = self._branch(body)
        above = -1 if parent is None else self._parent_index(parent)
        index = self._handle.copy_branch(branch.skeleton.id, branch.id, above)
        self.build()
        return self.bodynodes[index]

    def _hang(self, branch: BodyNode, parent: BodyNode | None, joint: str, name: str, axes: ArrayLike) -> None:
        """Hang a branch from a parent; the objects for its bodies, joints and dofs go with it."""
        source = branch.skeleton
        moved = [body for body in source.bodynodes if body is branch or _hangs_from(body, branch)]
        if source is not self:
            source._check_may_leave(moved)
        above = -1 if parent is None else parent.id
        names = self._handle.move_branch(source.id, branch.id, above, joint, name, axes)
        del source.name_to_joint[branch.parent_joint.name]
        if source is not self:
            self._take_over(moved, names)
        self.build()
        if source is not self:
            source.build()

    def _check_may_leave(self, bodies: list[BodyNode]) -> None:
        """ValueError if a subclass holds a body that is about to go to another skeleton."""

    def _take_over(self, bodies: list[BodyNode], names: list[str]) -> None:
        """Have the objects for bodies that came from another skeleton, with their joints but for the first one's."""
        skel = cast("Skeleton", self)
        handle = self.world._handle.skeleton(self.id)
        index = {handle.bodynode(i).name(): i for i in range(handle.num_bodynodes())}
        for body, name in zip(bodies, names):
            joint, now = body.parent_joint, handle.joint(handle.bodynode(index[name]).parent_joint())
            del body.skeleton.name_to_body[body.name]
            body.skeleton, body.name = skel, name
            self.name_to_body[name] = body
            if body is bodies[0]:
                continue
            del joint.skeleton.name_to_joint[joint.name]
            joint.skeleton, joint.name = skel, now.name()
            self.name_to_joint[joint.name] = joint
            for i, dof in enumerate(joint.dofs):
                dof.skeleton, dof.name = skel, handle.dof(now.dof(i)).name()

    def _free_name(self, name: str, replaced: Joint) -> str:
        """A joint's name, or if another one has it the first with a number that none has."""
        names = itertools.chain([name], (f"{name}({i})" for i in itertools.count(1)))
        return next(n for n in names if self.name_to_joint.get(n, replaced) is replaced)

    def _branch(self, body: BodyNode | str | int) -> BodyNode:
        """A body of any skeleton of the world."""
        found = self.body(body) if isinstance(body, (str, int, np.integer)) else body
        if not any(found is one for skel in self.world.skeletons for one in skel.bodynodes):
            raise ValueError(f"{found!r} is not a body of {self.world!r}; bodies move within one world")
        return found


def _hangs_from(body: BodyNode, other: BodyNode) -> bool:
    parent = body.parent_bodynode
    return parent is not None and (parent is other or _hangs_from(parent, other))


def _set_velocity(body: BodyNode, velocity: NDArray[np.float64]) -> None:
    """Give a body on a free joint a spatial velocity, world frame, shape (6,), by the joint's dofs."""
    own = [dof.id for dof in body.parent_joint.dofs]
    lacks = velocity - body.world_spatial_velocity()
    dq = body.skeleton.dq
    dq[own] += np.linalg.solve(body.world_jacobian()[:, own], lacks)
    body.skeleton.dq = dq
