"""Constraints between bodies that a user adds to a world."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

if TYPE_CHECKING:
    from pydart2.bodynode import BodyNode
    from pydart2.world import World


class BallJointConstraint:
    """Keeps a point of two bodies together.

    >>> constraint = BallJointConstraint(hand, handle, hand.to_world([0, 0, 0.1]))
    >>> constraint.add_to_world(world)

    Parameters
    ----------
    body1, body2
        Two bodies of one world.
    jointPos
        The point, world frame, shape (3,), m, at the time of add_to_world().
    """

    def __init__(self, body1: BodyNode, body2: BodyNode, jointPos: ArrayLike) -> None:
        self.body1 = body1
        self.body2 = body2
        self.jointPos: NDArray[np.float64] = np.array(jointPos, dtype=float)

    def add_to_world(self, world: World) -> None:
        """Add it; world.remove_all_constraints() takes it away again. ValueError if a body is not in the world."""
        world._handle.add_ball_joint_constraint(self.body1._handle, self.body2._handle, self.jointPos)
