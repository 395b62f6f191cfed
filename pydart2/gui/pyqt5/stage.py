"""What the window gives its scene to draw."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pydart2.gui import drawing
from pydart2.gui.draw_list import Scene
from pydart2.gui.overlays import Overlays
from pydart2.gui.runtime import Runtime
from pydart2.simulation.up import unit, up_of
from pydart2.world import World


class Stage:
    """A simulation as OpenGLScene.render() takes it, with the runtime's callbacks in place of the simulation's own.

    A World is drawn with the overlays, unless its class has a `render` of its own. What user code raises is noted by
    the runtime; until that is dismissed, user code is not asked to draw again.
    """

    def __init__(self, runtime: Runtime, overlays: Overlays) -> None:
        self.runtime = runtime
        self.overlays = overlays

    @property
    def draws_background(self) -> bool:
        """Whether render() draws the background too: user code may draw before a world."""
        sim = self.runtime.sim
        return isinstance(sim, World) and type(sim).render is World.render

    def _up_in_pictures(self) -> NDArray[np.float64]:
        sim = self.runtime.sim
        with self.runtime.guarded():
            if isinstance(sim, World):
                return up_of(sim)
        return unit("y")

    def render(self) -> None:
        """Draw the simulation."""
        sim = self.runtime.sim
        if self.draws_background:
            scene = Scene()
            with self.runtime.guarded():
                scene = self.overlays.scene(sim)
            with self.runtime.simulating_beside():
                drawing.draw(scene, background=True)
        elif hasattr(sim, "render"):
            self._ask(sim.render)

    @property
    def render_with_ri(self) -> Callable[[Any], None] | None:
        """Lets user code draw in the world; None if there is none."""
        return self._asking("render_with_ri")

    @property
    def draw_with_ri(self) -> Callable[[Any], None] | None:
        """Lets user code draw over the picture; None if there is none."""
        return self._asking("draw_with_ri")

    def _asking(self, event: str) -> Callable[[Any], None] | None:
        function = self.runtime.callbacks[event]
        return None if function is None else lambda ri: self._ask(function, ri)

    def _ask(self, function: Callable[..., object], *args: Any) -> None:
        if self.runtime.error is None:
            with self.runtime.guarded():
                function(*args)
