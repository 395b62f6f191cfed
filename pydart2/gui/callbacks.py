"""The functions of a simulation that a viewer calls."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

#: Names that are looked up on the simulation; a World has some, a subclass adds what it wants.
EVENTS = (
    "reset",
    "step",
    "on_step_event",
    "render_with_ri",
    "draw_with_ri",
    "name",
    "status",
    "num_frames",
    "set_frame",
    "on_key_press",
    "on_mouse_press",
    "on_mouse_move",
    "on_mouse_release",
    "on_close",
)


class Callbacks(dict[str, Callable[..., Any] | None]):
    """Event name → function, None where the simulation has none.

    >>> callbacks = Callbacks(world)
    >>> callbacks.call("step")
    """

    def __init__(self, sim: object | None = None) -> None:
        super().__init__(dict.fromkeys(EVENTS))
        self.read(sim)

    def read(self, sim: object | None) -> None:
        """Take the simulation's functions in place of the present ones."""
        for event in EVENTS:
            function = getattr(sim, event, None)
            self[event] = function if callable(function) else None

    def set(self, event: str, function: Callable[..., Any] | None) -> None:
        """Replace one; KeyError for an event that does not exist."""
        if event not in self:
            raise KeyError(f"no event {event!r}; there are {', '.join(self)}")
        self[event] = function

    def call(self, event: str, *args: Any) -> Any:
        """What the function returns; None if there is none."""
        function = self[event]
        return None if function is None else function(*args)

    def __str__(self) -> str:
        return ", ".join(event for event in self if self[event] is not None)
