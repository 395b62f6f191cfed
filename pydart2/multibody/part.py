"""What dofs, joints, bodies, markers and shapes have in common."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar, Self, TypeVar

from pydart2.assignment import Assignable
from pydart2.state import part_of

if TYPE_CHECKING:
    from pydart2.bodynode import BodyNode
    from pydart2.skeleton import Skeleton
    from pydart2.world import World


P = TypeVar("P", bound="Part")


class Part(Assignable):
    """A part of a skeleton: it knows its place there, by which it is found again in a copy.

    Attributes
    ----------
    skeleton : Skeleton
    """

    #: The skeleton's list of such parts.
    _LIST: ClassVar[str]

    skeleton: Skeleton
    name: str
    _handle: Any
    _id: int

    @property
    def id(self) -> int:
        """Index in the skeleton."""
        return self._id

    @property
    def skel(self) -> Skeleton:
        """The skeleton."""
        return self.skeleton

    @property
    def world(self) -> World:
        """The world."""
        return self.skeleton.world

    @property
    def wid(self) -> int:
        """Id of the world."""
        return self.skeleton.world.id

    @property
    def skid(self) -> int:
        """Id of the skeleton."""
        return self.skeleton.id

    def _take(self, other: Self) -> None:
        """Be the part that a new object is for: the tree has changed, and the old handle is refused."""
        self._id, self._handle = other._id, other._handle

    def _reduced(self, owner: Assignable) -> tuple[object, ...]:
        """For pickle and copy: the part of an owner that is in the copy, too. DestroyedError if it is gone."""
        self._handle.name()
        return part_of, (owner, self._LIST, self._id)

    def __reduce__(self) -> tuple[object, ...]:
        return self._reduced(self.skeleton)


def kept(before: dict[str, P], now: P) -> P:
    """The object that there was for this part of the engine's, taken again; `now` itself if there was none."""
    old = before.get(now.name)
    if old is None or type(old) is not type(now):
        return now
    old._take(now)
    return old


class BodyPart(Part):
    """A part of a body.

    Attributes
    ----------
    bodynode : BodyNode
    """

    bodynode: BodyNode

    @property
    def id(self) -> int:
        """Index in the body."""
        return self._id

    @property
    def bid(self) -> int:
        """Id of the body."""
        return self.bodynode.id

    def build(self) -> None:
        """Nothing to do; kept for callers of the original."""

    def __reduce__(self) -> tuple[object, ...]:
        return self._reduced(self.bodynode)
