"""Keeps what lies behind moving things, the sky and floors, from picture to picture."""

from __future__ import annotations

from OpenGL import GL

from pydart2.gui.targets import Framebuffer


class Background:
    """A copy of a picture, colours and depth, that can be put back while all that it shows stays the same.

    Of use with framebuffers that have the formats of ColorTarget, in the context that was current when it was made.
    """

    def __init__(self) -> None:
        self._framebuffer: Framebuffer | None = None
        self._size = (0, 0, 0)
        self._key: object = None

    def keep(self, key: object) -> None:
        """Copy what the framebuffer that is bound shows now; `key` tells what it depends on."""
        now, size = int(GL.glGetIntegerv(GL.GL_DRAW_FRAMEBUFFER_BINDING)), _size()
        if self._framebuffer is None or size != self._size:
            if self._framebuffer is not None:
                self._framebuffer.free()
            self._framebuffer, self._size = Framebuffer(*size, GL.GL_RGBA8), size
        self._key = key
        _copy(now, self._framebuffer.name, size)
        GL.glBindFramebuffer(GL.GL_FRAMEBUFFER, now)

    def put_back(self, key: object) -> bool:
        """Copy it into the framebuffer that is bound if it was kept with an equal key, in the same size."""
        if self._framebuffer is None or key != self._key or _size() != self._size:
            return False
        now = int(GL.glGetIntegerv(GL.GL_DRAW_FRAMEBUFFER_BINDING))
        _copy(self._framebuffer.name, now, self._size)
        GL.glBindFramebuffer(GL.GL_FRAMEBUFFER, now)
        return True


def _size() -> tuple[int, int, int]:
    """Width and height of the viewport in pixels, and the samples of each."""
    _, _, width, height = map(int, GL.glGetIntegerv(GL.GL_VIEWPORT))
    return width, height, int(GL.glGetIntegerv(GL.GL_SAMPLES))


def _copy(source: int, target: int, size: tuple[int, int, int]) -> None:
    """From one framebuffer to another; with all that they hold, which takes no more than to copy memory."""
    corners = (0, 0, *size[:2])
    GL.glBindFramebuffer(GL.GL_READ_FRAMEBUFFER, source)
    GL.glBindFramebuffer(GL.GL_DRAW_FRAMEBUFFER, target)
    buffers = GL.GL_COLOR_BUFFER_BIT | GL.GL_DEPTH_BUFFER_BIT | GL.GL_STENCIL_BUFFER_BIT
    GL.glBlitFramebuffer(*corners, *corners, buffers, GL.GL_NEAREST)
