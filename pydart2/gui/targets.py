"""Framebuffers to draw pictures into, and to read them from."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from OpenGL import GL

from pydart2.gui.context import ContextError


class Framebuffer:
    """A framebuffer object with renderbuffers of these formats, and depth.

    Attributes
    ----------
    name : int
        OpenGL's.
    """

    def __init__(self, width: int, height: int, samples: int, *formats: int) -> None:
        if samples > (most := int(GL.glGetIntegerv(GL.GL_MAX_SAMPLES))):
            raise ContextError(f"this OpenGL draws at most {most} samples a pixel, not {samples}")
        self.name = int(GL.glGenFramebuffers(1))
        self._buffers: list[int] = []
        self.bind()
        places = [GL.GL_COLOR_ATTACHMENT0 + i for i in range(len(formats))]
        for place, kind in (*zip(places, formats), (GL.GL_DEPTH_STENCIL_ATTACHMENT, GL.GL_DEPTH24_STENCIL8)):
            buffer = int(GL.glGenRenderbuffers(1))
            self._buffers.append(buffer)
            GL.glBindRenderbuffer(GL.GL_RENDERBUFFER, buffer)
            GL.glRenderbufferStorageMultisample(GL.GL_RENDERBUFFER, samples, kind, width, height)
            GL.glFramebufferRenderbuffer(GL.GL_FRAMEBUFFER, place, GL.GL_RENDERBUFFER, buffer)
        GL.glDrawBuffers(len(places), places)
        if GL.glCheckFramebufferStatus(GL.GL_FRAMEBUFFER) != GL.GL_FRAMEBUFFER_COMPLETE:
            self.free()
            raise ContextError(f"this OpenGL cannot draw {width} by {height} pixels with {samples} samples")

    def bind(self) -> None:
        """Draw into it, and read from it, from now on."""
        GL.glBindFramebuffer(GL.GL_FRAMEBUFFER, self.name)

    def free(self) -> None:
        """Give its memory back."""
        GL.glBindFramebuffer(GL.GL_FRAMEBUFFER, 0)
        GL.glDeleteFramebuffers(1, [self.name])
        GL.glDeleteRenderbuffers(len(self._buffers), self._buffers)


class ColorTarget:
    """A colour picture with depth, with several samples a pixel if wanted."""

    def __init__(self, width: int, height: int, samples: int) -> None:
        self.width, self.height, self.samples = width, height, samples
        self._drawn = self._read = Framebuffer(width, height, samples, GL.GL_RGBA8)
        if samples:
            self._read = Framebuffer(width, height, 0, GL.GL_RGBA8)
        self._pixels = np.empty((height, width, 4), np.uint8)

    def begin(self) -> None:
        """Draw into it from now on."""
        self._drawn.bind()
        GL.glViewport(0, 0, self.width, self.height)

    def copy_to(self, framebuffer: int) -> None:
        """Copy the picture into another framebuffer, by its name."""
        size = (0, 0, self.width, self.height)
        GL.glBindFramebuffer(GL.GL_READ_FRAMEBUFFER, self._drawn.name)
        GL.glBindFramebuffer(GL.GL_DRAW_FRAMEBUFFER, framebuffer)
        GL.glBlitFramebuffer(*size, *size, GL.GL_COLOR_BUFFER_BIT, GL.GL_NEAREST)

    def read(self) -> NDArray[np.uint8]:
        """The picture, (height, width, 3), uint8, row 0 on top."""
        return np.ascontiguousarray(self.read_rows()[::-1, :, :3])

    def read_rows(self) -> NDArray[np.uint8]:
        """The picture as OpenGL has it, (height, width, 4), uint8, row 0 below; the next call fills the same memory."""
        if self._read is not self._drawn:
            self.copy_to(self._read.name)
        self._read.bind()
        # All four channels, which is ten times faster than three.
        _read_pixels(self._pixels, GL.GL_RGBA, GL.GL_UNSIGNED_BYTE)
        return self._pixels

    def free(self) -> None:
        """Give its memory back."""
        for framebuffer in {self._drawn, self._read}:
            framebuffer.free()


class BodiesTarget:
    """Skeleton and body ids, and depth, of each pixel's middle."""

    def __init__(self, width: int, height: int) -> None:
        self.width, self.height = width, height
        self._framebuffer = Framebuffer(width, height, 0, GL.GL_RG32I, GL.GL_R32F)

    def begin(self) -> None:
        """Draw into it from now on; all is background."""
        self._framebuffer.bind()
        GL.glViewport(0, 0, self.width, self.height)
        GL.glClearBufferiv(GL.GL_COLOR, 0, np.full(4, -1, np.int32))
        GL.glClearBufferfv(GL.GL_COLOR, 1, np.full(4, np.inf, np.float32))
        GL.glClearBufferfv(GL.GL_DEPTH, 0, np.ones(1, np.float32))

    def read_ids(self) -> NDArray[np.int32]:
        """Skeleton and body id, (height, width, 2), row 0 on top, -1 where there is no body."""
        ids = np.empty((self.height, self.width, 2), np.int32)
        GL.glReadBuffer(GL.GL_COLOR_ATTACHMENT0)
        _read_pixels(ids, GL.GL_RG_INTEGER, GL.GL_INT)
        return ids[::-1].copy()

    def read_depth(self) -> NDArray[np.float32]:
        """Distance along the optical axis, m, (height, width), row 0 on top, inf where there is nothing."""
        depth = np.empty((self.height, self.width), np.float32)
        GL.glReadBuffer(GL.GL_COLOR_ATTACHMENT1)
        _read_pixels(depth, GL.GL_RED, GL.GL_FLOAT)
        return depth[::-1].copy()

    def free(self) -> None:
        """Give its memory back."""
        self._framebuffer.free()


def draws_in_software() -> bool:
    """Whether the context that is current has no graphics card."""
    name = GL.glGetString(GL.GL_RENDERER).decode().lower()
    return any(word in name for word in ("llvmpipe", "softpipe", "swrast", "software"))


def _read_pixels(into: NDArray[np.generic], layout: int, kind: int) -> None:
    height, width = into.shape[:2]
    GL.glPixelStorei(GL.GL_PACK_ALIGNMENT, 1)
    GL.glReadPixels(0, 0, width, height, layout, kind, into)
