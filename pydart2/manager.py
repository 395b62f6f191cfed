"""Starting over, and how much is said."""

from __future__ import annotations

from pydart2 import _native

_verbose = True


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
