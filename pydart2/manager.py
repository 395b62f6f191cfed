"""Starting over, how much is said, and worlds that nobody has any more."""

from __future__ import annotations

import gc
import weakref
from typing import TYPE_CHECKING

from pydart2 import _native

if TYPE_CHECKING:
    from pydart2.world import World

_verbose = True
_worlds: weakref.WeakValueDictionary[int, World] = weakref.WeakValueDictionary()
_many_worlds = 10


def init(verbose: bool = True) -> None:
    """Start over: destroy all worlds made so far and count world ids from 0 again.

    Optional before the first world. Any use of a world or skeleton made before raises DestroyedError.
    """
    _native.restart()
    set_verbose(verbose)
    if verbose:
        print("Msg [pydart2_api] Initialize pydart manager OK")


def verbose() -> bool:
    """Whether messages are printed."""
    return _verbose


def set_verbose(verbose: bool = True) -> None:
    """Print messages or not."""
    global _verbose
    _verbose = bool(verbose)


def count(world: World) -> None:
    """Note a new world; look for dropped ones when there are twice as many as after the last look.

    A world and its skeletons refer to each other. Such circles wait for Python's collector, which counts objects and
    does not know how much memory each holds here.
    """
    global _many_worlds
    _worlds[id(world)] = world
    if len(_worlds) > _many_worlds and gc.isenabled():
        gc.collect()
        _many_worlds = max(10, 2 * len(_worlds))
