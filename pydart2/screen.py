"""The one door from worlds and their parts to the screen, of which they know nothing else."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

drawers: dict[str, Callable[..., None]] = {}
"""What draws each kind of thing; `pydart2.gui.drawing` fills it when it is imported."""


def picture(world: object, width: int, height: int) -> bytes | None:
    """A picture as a PNG file, drawn without a display; None where there is no OpenGL."""
    from pydart2.gui.drawing import png_of  # as OpenGL is not imported before something is drawn

    return png_of(world, width, height)


def draw(kind: str, thing: object, *how: Any) -> None:
    """Draw a thing with the current OpenGL context and matrices.

    Raises
    ------
    ContextError
        If no context is current in this thread.
    """
    if not drawers:
        import pydart2.gui.drawing  # noqa: F401 (fills the table; OpenGL is not imported before something is drawn)
    drawers[kind](thing, *how)
