"""What runs underneath."""

from __future__ import annotations

from typing import NamedTuple

from pydart2 import _native


class EngineInfo(NamedTuple):
    """The DART library in use and what new worlds start with.

    Attributes
    ----------
    dart
        Version of DART, as ``"6.12.1"``.
    assertions
        Whether the library was built with its assertions, as Debian's is. They cost speed, and one that fails ends the
        process.
    prefix
        Folder that it is installed under, as ``"/usr"``.
    solver
        Constraint solver of new worlds, "fast", "dart" or "iterative" (`World.set_constraint_solver`).
    dynamics
        Dynamics of new worlds, "fast" or "engine" (`World.set_dynamics`).
    """

    dart: str
    assertions: bool
    prefix: str
    solver: str
    dynamics: str


def engine_info() -> EngineInfo:
    """Describe the engine; ValueError if ``PYDART2_SOLVER`` names no solver or ``PYDART2_DYNAMICS`` no dynamics.

    >>> pydart2.engine_info().dart
    '6.12.1'
    """
    return EngineInfo(
        _native.engine_version(),
        _native.engine_has_assertions(),
        _native.engine_prefix(),
        _native.default_solver_name(),
        _native.default_dynamics_name(),
    )
