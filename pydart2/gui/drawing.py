"""Draws worlds and their parts where the current OpenGL context and its matrices say: what `World.render` does."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray
from OpenGL import GL

from pydart2 import screen
from pydart2.gui.context import ContextError, before_free, current_context
from pydart2.gui.draw_list import Scene
from pydart2.gui.scene_renderer import SceneRenderer
from pydart2.gui.shapes import add_shapenode
from pydart2.simulation.up import up_of

if TYPE_CHECKING:
    from pydart2.contact import Contact
    from pydart2.marker import Marker
    from pydart2.shape import Shape
    from pydart2.skeleton import Skeleton
    from pydart2.world import World

_renderers: dict[int, SceneRenderer] = {}
before_free.append(lambda number: _renderers.pop(number, None))


def renderer() -> SceneRenderer:
    """The renderer of the context that is current; made when it is first asked for.

    Raises
    ------
    ContextError
        If no context is current in this thread.
    """
    context = current_context()
    if not context:
        raise ContextError(
            "no OpenGL context is current in this thread; render() draws inside a window's callback, "
            "pydart2.gui.render(world) without one"
        )
    found = _renderers.get(context)
    if found is None or not found.is_alive():  # another context may have got the number of one that is gone
        found = _renderers[context] = SceneRenderer()
    return found


def matrices() -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """OpenGL's model-view and projection matrices, (4, 4) each."""
    kinds = (GL.GL_MODELVIEW_MATRIX, GL.GL_PROJECTION_MATRIX)
    view, projection = (np.array(GL.glGetDoublev(kind), dtype=float).reshape(4, 4).T for kind in kinds)
    return view, projection


def draw(scene: Scene, background: bool = False) -> None:
    """Draw a scene with OpenGL's own matrices, with the background if it is not there yet."""
    renderer().draw(scene, *matrices(), background)


def draw_world(world: World, markers: bool, contacts: bool, contact_size: float, force_scale: float) -> None:
    """Draw a world: what the renderer is told to show, and of markers and contacts only what is wanted here too."""
    show = renderer().show
    scene = Scene()
    scene.add_world(world, replace(show, markers=markers and show.markers, contacts=False))
    if contacts and show.contacts:
        scene.add_contacts(world.collision_result.rows, contact_size, force_scale)
    draw(scene)


def draw_markers(world: World) -> None:
    """Draw the markers of a world."""
    scene = Scene(up_of(world))
    for skel in world.skeletons:
        scene.add_markers(skel)
    draw(scene)


def draw_contacts(world: World, size: float, force_scale: float) -> None:
    """Draw the contacts of a world."""
    scene = Scene(up_of(world))
    scene.add_contacts(world.collision_result.rows, size, force_scale)
    draw(scene)


def draw_contact(contact: Contact, size: float, force_scale: float) -> None:
    """Draw one contact."""
    scene = Scene(up_of(contact.world))
    scene.add_contacts(contact.state[None], size, force_scale)
    draw(scene)


def draw_contact_row(row: NDArray[np.float64], size: float, force_scale: float) -> None:
    """Draw a contact of no world, a row of `CollisionResult.rows`."""
    scene = Scene()
    scene.add_contacts(row[None], size, force_scale)
    draw(scene)


def png_of(world: object, width: int, height: int) -> bytes | None:
    """A picture of a world as a PNG file; None where no OpenGL context can be made."""
    import io

    from PIL import Image

    from pydart2 import gui  # whose renderer draws by this module

    file = io.BytesIO()
    try:
        Image.fromarray(gui.render(world, width, height)).save(file, "png")
    except ContextError:
        return None
    return file.getvalue()


def draw_skeleton(skel: Skeleton, rgba: ArrayLike | None = None) -> None:
    """Draw a skeleton, all in one colour of 3 or 4 numbers, 0 to 1, if it is given."""
    scene = Scene(up_of(skel.world))
    scene.add_skeleton(skel, rgba)
    draw(scene)


def draw_marker(marker: Marker) -> None:
    """Draw a marker."""
    scene = Scene(up_of(marker.skeleton.world))
    scene.add_marker(marker.p)
    draw(scene)


def draw_shape(shape: Shape) -> None:
    """Draw a shape in grey in the axes of OpenGL's model-view matrix."""
    scene = Scene(up_of(shape.skeleton.world))
    add_shapenode(scene, shape.shapenode, (0.8, 0.8, 0.8, 1.0), pose=np.eye(4))
    draw(scene)


screen.drawers.update(
    {"contact row": draw_contact_row},
    world=draw_world,
    markers=draw_markers,
    contacts=draw_contacts,
    contact=draw_contact,
    skeleton=draw_skeleton,
    marker=draw_marker,
    shape=draw_shape,
)
