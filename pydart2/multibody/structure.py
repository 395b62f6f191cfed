"""The tree of a skeleton: its dofs, joints, bodies and markers, by name and by index."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, cast

import numpy as np
from numpy.typing import NDArray

from pydart2.alias import Alias, also
from pydart2.bodynode import BodyNode
from pydart2.dof import Dof
from pydart2.errors import NameNotFound
from pydart2.indexing import Names
from pydart2.joint import Joint, create_joint
from pydart2.marker import Marker
from pydart2.multibody.part import P, kept
from pydart2.skel_vector import SkelVector
from pydart2.softbody import SoftBodyNode

if TYPE_CHECKING:
    from pydart2._native import SkeletonHandle
    from pydart2.skeleton import Skeleton
    from pydart2.world import World


#: The attributes that a skeleton has when it has looked at its tree.
PARTS: tuple[str, ...] = ("dofs", "joints", "bodynodes", "markers", "name_to_dof", "name_to_joint", "name_to_body")


class Structure:
    """The part of Skeleton that knows its parts."""

    world: World
    id: int
    dofs: list[Dof]
    joints: list[Joint]
    bodynodes: list[BodyNode]
    markers: list[Marker]
    _handle: SkeletonHandle

    if TYPE_CHECKING:

        @property
        def name(self) -> str: ...

    def build(self) -> None:
        """Look at the tree again: what is still there stays the same object, with its new index; the rest is made."""
        self._handle = self.world._handle.skeleton(self.id)
        self._look()

    def _look(self) -> None:
        skel, handle = cast("Skeleton", self), self._handle
        joints: dict[str, Joint] = self.__dict__.get("name_to_joint", {})
        bodies: dict[str, BodyNode] = self.__dict__.get("name_to_body", {})
        dofs = {dof.name: dof for joint in joints.values() for dof in joint.dofs if dof.joint is joint}
        self.joints = [kept(joints, create_joint(skel, i)) for i in range(handle.num_joints())]
        still = set(map(id, self.joints))
        dofs = {name: dof for name, dof in dofs.items() if id(dof.joint) in still}
        self.dofs = [kept(dofs, Dof(skel, i)) for i in range(handle.num_dofs())]
        self.bodynodes = [kept(bodies, self._make_body(i)) for i in range(handle.num_bodynodes())]
        self.markers = [Marker(skel, i) for i in range(handle.num_markers())]
        self._refresh_names()
        for parts in (self.joints, self.bodynodes, self.markers):
            for part in parts:
                part.build()

    def _new_marker(self, index: int) -> Marker:
        marker = Marker(cast("Skeleton", self), index)
        self.markers.append(marker)
        marker.build()
        return marker

    def _make_body(self, index: int) -> BodyNode:
        return (SoftBodyNode if self._handle.bodynode(index).is_soft() else BodyNode)(cast("Skeleton", self), index)

    def _refresh_names(self) -> None:
        """Read the names of all joints and dofs again: renaming one may change others."""
        for dof in self.dofs:
            dof.name = dof._handle.name()
        for joint in self.joints:
            joint.name = joint._handle.name()
        self.name_to_dof = {dof.name: dof for dof in self.dofs}
        self.name_to_joint = {joint.name: joint for joint in self.joints}
        self.name_to_body = {body.name: body for body in self.bodynodes}
        self._name_dofs(dof.name for dof in self.dofs)

    def _name_dofs(self, names: Iterable[str]) -> None:
        skel = cast("Skeleton", self)
        self.names = Names(names, skel)
        self._pattern = SkelVector(np.zeros(len(self.names)), skel)
        self._pattern.flags.writeable = False  # what says to the C++ layer: a new vector like this one

    def num_dofs(self) -> int:
        """How many dofs there are."""
        return len(self.names)

    ndofs = Alias(num_dofs)

    def num_joints(self) -> int:
        """How many joints there are."""
        return len(self.joints)

    njoints = Alias(num_joints)

    def num_bodynodes(self) -> int:
        """How many bodies there are."""
        return len(self.bodynodes)

    nbodies = Alias(num_bodynodes)

    def bodynode(self, query: str | int) -> BodyNode:
        """A body by name or index; NameNotFound or IndexError if there is none."""
        return self._find("body", query, self.bodynodes, self.name_to_body)

    body = also(bodynode)

    def joint(self, query: str | int) -> Joint:
        """A joint by name or index; NameNotFound or IndexError if there is none."""
        return self._find("joint", query, self.joints, self.name_to_joint)

    def dof(self, query: str | int) -> Dof:
        """A dof by name or index; NameNotFound or IndexError if there is none."""
        return self._find("dof", query, self.dofs, self.name_to_dof)

    def _find(self, kind: str, query: str | int, parts: list[P], by_name: dict[str, P]) -> P:
        if isinstance(query, str):
            if query not in by_name:
                raise NameNotFound(kind, query, f"skeleton {self.name!r}", by_name)
            return by_name[query]
        if not isinstance(query, (int, np.integer)):
            raise TypeError(f"a {kind} is found by name or index, not by {query!r}")
        if not -len(parts) <= query < len(parts):
            raise IndexError(f"no {kind} {query} in skeleton {self.name!r}: there are {len(parts)}")
        return parts[query]

    def _own_body(self, body: BodyNode | str | int) -> BodyNode:
        """One of the skeleton's bodies, given as itself, by name or by index."""
        found = self.body(body) if isinstance(body, (str, int, np.integer)) else body
        if not any(found is own for own in self.bodynodes):
            raise ValueError(f"{found!r} is not a body of {self!r}")
        return found

    def root_bodynodes(self) -> list[BodyNode]:
        """The bodies without a parent."""
        return [body for body in self.bodynodes if body.parent_bodynode is None]

    def root_bodynode(self, index: int = 0) -> BodyNode:
        """A body without a parent."""
        return self.root_bodynodes()[index]

    def bodynode_index(self, name: str) -> int:
        """Index of a body; NameNotFound if there is none of this name."""
        return self.bodynode(name).id

    def dof_index(self, name: str) -> int:
        """Index of a dof; NameNotFound if there is none of this name."""
        return self.names.index(name)

    def dof_indices(self, names: Iterable[str]) -> NDArray[np.intp]:
        """Indices of dofs, shape (n,), for indexing arrays; NameNotFound if there is none of a name."""
        return np.array([self.names.index(name) for name in names], dtype=np.intp)

    def set_root_joint_to_trans_and_euler(self) -> None:
        """Put the root under a TranslationalJoint ``root_t`` and an EulerJoint ``root_r`` (XYZ), by a massless body.

        Positions are not converted. Dofs 0 to 2 are the translation, 3 to 5 the Euler angles of a root that was free.
        """
        self._handle.set_root_joint_to_trans_and_euler()
        self.build()

    def set_root_joint_to_weld(self) -> None:
        """Weld the root to the world, where it is."""
        roots = self.root_bodynodes()  # none, or several, the engine's layer refuses
        moved = any(dof.position() != 0.0 for root in roots for dof in root.parent_joint.dofs)
        where = [root.world_transform() for root in roots]
        self._handle.set_root_joint_to_weld()
        self.build()
        if moved:  # at q = 0 the engine's own numbers stay, bit for bit
            self._place(where[0])

    def set_root_joint_to_free(self) -> None:
        """Let a root that is fixed float, from where it is; after a reset it is there again.

        ValueError if it is on a joint of another kind.
        """
        self._handle.set_root_joint_to_free()
        self.build()

    def _place(self, where: NDArray[np.float64]) -> None:
        """Put the root link there, shape (4, 4), m; a root that floats is there after a reset, too."""
        self.root_bodynode().parent_joint._handle.place(where)
