"""What worlds, skeletons and vectors say of themselves where people look: printed, and in notebooks."""

from __future__ import annotations

import html
from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING

import numpy as np

from pydart2 import screen
from pydart2.errors import DestroyedError

if TYPE_CHECKING:
    from pydart2.skel_vector import SkelVector
    from pydart2.skeleton import Skeleton
    from pydart2.world import World

_MOST_ROWS = 20
_SPACED = "border-collapse: separate; border-spacing: 0.8em 0"  # where a page's own style has no gaps
_PICTURE = (480, 360)  # pixels


def about_world(world: World) -> str:
    """What is in a world and how it steps, a line for each skeleton."""
    return "\n".join(_lines(world))


def picture_of_world(world: World) -> bytes | None:
    """A picture as a PNG file; None where there is no OpenGL."""
    return screen.picture(world, *_PICTURE)


def _lines(world: World) -> Iterator[str]:
    try:
        handle, skeletons = world._handle, world.skeletons
        gravity, up = _numbers(handle.gravity()), _numbers(world._upwards())
        yield f"World {world.id}: t = {handle.time():g} s, dt = {handle.time_step():g} s, gravity {gravity}, up {up}"
    except DestroyedError:
        yield repr(world)
        return
    yield (
        f"{count(len(skeletons), 'skeleton')}, {count(sum(s.num_bodynodes() for s in skeletons), 'body', 'bodies')}, "
        f"{count(sum(s.num_dofs() for s in skeletons), 'dof')}, {count(handle.num_contacts(), 'contact')}, "
        f"{count(handle.num_frames(), 'frame')}; detector {handle.collision_detector()!r}, "
        f"solver {handle.constraint_solver()!r}"
    )
    width = max((len(skel.name) for skel in skeletons[:_MOST_ROWS]), default=0)
    for skel in skeletons[:_MOST_ROWS]:
        parts = f"{count(skel.num_bodynodes(), 'body', 'bodies')}, {count(skel.num_dofs(), 'dof')}"
        yield f"  {skel.id:>2} {skel.name:<{width}}  {parts}, {skel._handle.mass():g} kg"
    if len(skeletons) > _MOST_ROWS:
        yield f"  … and {len(skeletons) - _MOST_ROWS} more"


def _numbers(values: Iterable[float]) -> str:
    return "[" + ", ".join(f"{value + 0.0:.4g}" for value in values) + "]"


def count(n: int, one: str, many: str = "") -> str:
    """`1 body`, `2 bodies`; without `many` its s is put behind."""
    return f"{n} {one if n == 1 else many or one + 's'}"


def table_of_vector(vector: SkelVector) -> str | None:
    """A table of names and numbers in HTML, in the vector's units, that stays small; None without names."""
    keys = vector.keys
    if not keys or vector.ndim != 1:
        return None
    rows = [(i, name, f"{value:.6g}") for i, (name, value) in enumerate(zip(keys, vector.tolist(), strict=True))]
    return _table(("", "name", "value"), rows)


def table_of_skeleton(skel: Skeleton) -> str:
    """The dofs of a skeleton with their positions, limits and velocities as a table in HTML, that stays small."""
    handle = skel._handle
    numbers = zip(*map(np.ndarray.tolist, (skel.q_lower, skel.q, skel.q_upper, skel.dq)), strict=True)
    rows = [
        (i, skel.dofs[i].name, *(f"{n:.4g}" if np.isfinite(n) else "" for n in row)) for i, row in enumerate(numbers)
    ]
    kinds = f"{count(skel.num_bodynodes(), 'body', 'bodies')}, {count(skel.num_dofs(), 'dof')}"
    title = f"<b>{html.escape(skel.name)}</b>: {kinds}, {handle.mass():g} kg"
    return title + _table(("", "dof", "lower", "q", "upper", "dq"), rows)


def _table(head: Sequence[str], rows: Sequence[Sequence[object]]) -> str:
    """The first and the last rows, if there are many."""
    half = _MOST_ROWS // 2
    shown = [*rows[:half], ("…",) * len(head), *rows[-half:]] if len(rows) > _MOST_ROWS else rows
    lines = "".join("<tr>" + "".join(f"<td>{html.escape(str(c))}</td>" for c in row) + "</tr>" for row in shown)
    titles = "".join(f"<th>{name}</th>" for name in head)
    return f'<table style="{_SPACED}"><tr>{titles}</tr>{lines}</table>'
