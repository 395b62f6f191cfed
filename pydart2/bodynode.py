"""Bodies (links) of a skeleton."""

from __future__ import annotations

import logging
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pydart2 import contact_forces
from pydart2.alias import Alias, forwards
from pydart2.building.bodies import BodyBuilding
from pydart2.multibody.motion import Motion
from pydart2.multibody.part import kept
from pydart2.shapenode import ShapeNode

if TYPE_CHECKING:
    from pydart2.dof import Dof
    from pydart2.joint import Joint
    from pydart2.marker import Marker
    from pydart2.skeleton import Skeleton

_log = logging.getLogger("pydart2")
_ORIGIN = (0.0, 0.0, 0.0)


class BodyNode(Motion, BodyBuilding):
    """A rigid or soft body of a skeleton.

    Jacobians have the angular rows before the linear ones. ``full=True`` gives a column to each dof of the skeleton,
    ``full=False`` to the dependent dofs only. An `offset` is a point in the body frame, shape (3,), m; None is the
    body's origin.

    Attributes
    ----------
    skeleton : Skeleton
    id : int
        Index in the skeleton.
    name : str
    parent_bodynode : BodyNode or None
    child_bodynodes : list of BodyNode
    parent_joint : Joint
    child_joints : list of Joint
    dependent_dofs : list of Dof
        The dofs that move it, from the root to the leaf.
    markers : list of Marker
    shapenodes : list of ShapeNode
    """

    _LIST = "bodynodes"

    parent_bodynode: BodyNode | None
    parent_joint: Joint

    def __init__(self, _skel: Skeleton, _id: int) -> None:
        self.skeleton = _skel
        self._id = _id
        self._handle = _skel._handle.bodynode(_id)
        self.name = self._handle.name()
        self.child_bodynodes: list[BodyNode] = []
        self.child_joints: list[Joint] = []
        self.dependent_dofs: list[Dof] = []
        self.markers: list[Marker] = []
        self.shapenodes: list[ShapeNode] = []
        self._arrows: list[tuple[int, NDArray[np.float64], NDArray[np.float64]]] = []

    def build(self) -> None:
        """Link to the other parts of the skeleton."""
        skel, handle = self.skeleton, self._handle
        parent = handle.parent_bodynode()
        self.parent_bodynode = skel.bodynodes[parent] if parent >= 0 else None
        self.child_bodynodes = [skel.bodynodes[handle.child_bodynode(i)] for i in range(self.num_child_bodynodes())]
        self.parent_joint = skel.joints[handle.parent_joint()]
        self.child_joints = [skel.joints[handle.child_joint(i)] for i in range(self.num_child_joints())]
        above = [] if self.parent_bodynode is None else self.parent_bodynode.dependent_dofs  # parents come first
        self.dependent_dofs = [*above, *self.parent_joint.dofs]
        before = {node.name: node for node in self.shapenodes}
        nodes = [ShapeNode(self, i) for i in range(self.num_shapenodes())]
        self.shapenodes = [kept(before, node) for node in nodes]
        self.markers = []  # each marker adds itself

    # Structure

    def num_child_bodynodes(self) -> int:
        """How many bodies hang from it."""
        return self._handle.num_child_bodynodes()

    def num_dependent_dofs(self) -> int:
        """How many dofs move it."""
        return self._handle.num_dependent_dofs()

    def num_child_joints(self) -> int:
        """How many joints hang from it."""
        return self._handle.num_child_joints()

    def num_markers(self) -> int:
        """How many markers it has."""
        return len(self.markers)

    def num_shapenodes(self) -> int:
        """How many shape nodes it has."""
        return self._handle.num_shapenodes()

    def index_in_skeleton(self) -> int:
        """Index in the skeleton."""
        return self._handle.index_in_skeleton()

    def index_in_tree(self) -> int:
        """Index in its tree; a skeleton may have several."""
        return self._handle.index_in_tree()

    def tree_index(self) -> int:
        """Index of its tree."""
        return self._handle.tree_index()

    # Properties

    def gravity_mode(self) -> bool:
        """Whether gravity acts on it."""
        return self._handle.gravity_mode()

    def set_gravity_mode(self, _gravityMode: bool) -> None:
        """Let gravity act on it or not."""
        self._handle.set_gravity_mode(_gravityMode)

    def is_collidable(self) -> bool:
        """Whether it collides."""
        return self._handle.is_collidable()

    def set_collidable(self, _isCollidable: bool) -> None:
        """Let it collide or not."""
        self._handle.set_collidable(_isCollidable)

    @forwards()
    def mass(self) -> float:
        """Mass, kg."""
        return self._handle.mass()

    def set_mass(self, mass: float) -> None:
        """Set the mass, kg, > 0. The moment of inertia stays as it is."""
        self._handle.set_mass(mass)

    m = Alias(mass)

    @forwards()
    def inertia(self) -> NDArray[np.float64]:
        """Moment of inertia about the COM, body axes, shape (3, 3), kg m²."""
        return self._handle.inertia()

    def set_inertia(self, I: ArrayLike) -> None:  # noqa: E741 (the original's)
        """Set the moment of inertia about the COM, body axes, shape (3, 3), kg m²; symmetric, positive definite."""
        self._handle.set_inertia(I)

    def set_inertia_entries(
        self,
        Ixx: float,
        Iyy: float,
        Izz: float,
        Ixy: float = 0.0,
        Ixz: float = 0.0,
        Iyz: float = 0.0,
    ) -> None:
        """Set the moment of inertia about the COM, body axes, kg m²."""
        self._handle.set_inertia([[Ixx, Ixy, Ixz], [Ixy, Iyy, Iyz], [Ixz, Iyz, Izz]])

    I = Alias(inertia)  # noqa: E741 (the field's name)

    def local_com(self) -> NDArray[np.float64]:
        """Centre of mass in the body frame, shape (3,), m."""
        return self._handle.local_com()

    def set_local_com(self, com: ArrayLike) -> None:
        """Set the centre of mass in the body frame, shape (3,), m."""
        self._handle.set_local_com(com)

    def friction_coeff(self) -> float:
        """Friction coefficient of its first colliding shape; 1 without any."""
        return self._handle.friction_coeff()

    def set_friction_coeff(self, coeff: float) -> None:
        """Set the friction coefficient of all its colliding shapes, >= 0."""
        if not self._handle.set_friction_coeff(coeff):
            _log.warning("%s has no colliding shape, so no friction to set", self)

    def restitution_coeff(self) -> float:
        """Restitution coefficient of its first colliding shape; 0 without any."""
        return self._handle.restitution_coeff()

    def set_restitution_coeff(self, coeff: float) -> None:
        """Set the restitution coefficient of all its colliding shapes, >= 0."""
        if not self._handle.set_restitution_coeff(coeff):
            _log.warning("%s has no colliding shape, so no restitution to set", self)

    # Contacts of the last step

    @property
    def contacts(self) -> contact_forces.Contacts:
        """Its contacts, with points, forces on it, normals and depths as arrays."""
        return contact_forces.of_body(self)

    def contact_force(self) -> NDArray[np.float64]:
        """The sum of the contact forces on it, world frame, shape (3,), N."""
        return self.contacts.force

    # External forces: they act in the next step only

    def add_ext_force(
        self,
        _force: ArrayLike,
        _offset: ArrayLike | None = None,
        _isForceLocal: bool = False,
        _isOffsetLocal: bool = True,
    ) -> None:
        """Add a force for the next step.

        Parameters
        ----------
        _force
            Shape (3,), N; in the world frame unless `_isForceLocal`.
        _offset
            Where it acts, shape (3,), m; in the body frame unless `_isOffsetLocal` is False. Default: its origin.
        """
        self._handle.add_ext_force(_force, _ORIGIN if _offset is None else _offset, _isForceLocal, _isOffsetLocal)

    def set_ext_force(
        self,
        _force: ArrayLike,
        _offset: ArrayLike | None = None,
        _isForceLocal: bool = False,
        _isOffsetLocal: bool = True,
    ) -> None:
        """Like add_ext_force(), in place of what was added before."""
        self._handle.set_ext_force(_force, _ORIGIN if _offset is None else _offset, _isForceLocal, _isOffsetLocal)

    def add_ext_torque(self, _torque: ArrayLike, _isLocal: bool = False) -> None:
        """Add a torque for the next step, shape (3,), N m; in the world frame unless `_isLocal`."""
        self._handle.add_ext_torque(_torque, _isLocal)

    def set_ext_torque(self, _torque: ArrayLike, _isLocal: bool = False) -> None:
        """Like add_ext_torque(), in place of what was added before."""
        self._handle.set_ext_torque(_torque, _isLocal)

    def add_ext_force_with_arrow(
        self,
        _force: ArrayLike,
        _offset: ArrayLike | None = None,
        _isForceLocal: bool = False,
        _isOffsetLocal: bool = True,
    ) -> None:
        """Like add_ext_force(), and noted in `force_arrows` to be drawn until the next step is over."""
        self.add_ext_force(_force, _offset, _isForceLocal, _isOffsetLocal)
        self._note_arrow(_force, _offset, _isForceLocal, _isOffsetLocal)

    def set_ext_force_with_arrow(
        self,
        _force: ArrayLike,
        _offset: ArrayLike | None = None,
        _isForceLocal: bool = False,
        _isOffsetLocal: bool = True,
    ) -> None:
        """Like set_ext_force(), and noted in `force_arrows` to be drawn until the next step is over."""
        self.set_ext_force(_force, _offset, _isForceLocal, _isOffsetLocal)
        self._arrows = []
        self._note_arrow(_force, _offset, _isForceLocal, _isOffsetLocal)

    @property
    def force_arrows(self) -> list[tuple[NDArray[np.float64], NDArray[np.float64]]]:
        """Where the noted forces act (3,), m, and the forces (3,), N, both in the world frame."""
        return [(p.copy(), f.copy()) for frame, p, f in self._arrows if self.world.frame <= frame + 1]

    def _note_arrow(self, force: ArrayLike, offset: ArrayLike | None, force_local: bool, offset_local: bool) -> None:
        point = self.to_world(offset) if offset_local or offset is None else np.array(offset, dtype=float)
        vector = self.T[:3, :3] @ np.asarray(force) if force_local else np.array(force, dtype=float)
        frame = self.world.frame
        self._arrows = [arrow for arrow in self._arrows if arrow[0] == frame] + [(frame, point, vector)]

    def __repr__(self) -> str:
        return f"[BodyNode({self.id}): {self.name}]"
