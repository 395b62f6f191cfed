"""OpenGL contexts without a display: EGL, else OSMesa. The only place that decides how PyOpenGL is loaded.

`PYDART2_GL=egl` or `PYDART2_GL=osmesa` chooses one; otherwise the first that works is taken.
"""

from __future__ import annotations

import ctypes
import ctypes.util
import gc
import os
import sys
import threading
import weakref
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any, Protocol

from pydart2.errors import PydartError

_HELP = (
    "no OpenGL context without a display could be made; on Debian: apt-get install libegl1 libgl1 libgl1-mesa-dri "
    "(EGL), or libosmesa6 (OSMesa, with PYDART2_GL=osmesa)"
)


class ContextError(PydartError):
    """No OpenGL, or not the one that is needed."""


class Context(Protocol):
    """An OpenGL context that one thread at a time can make current."""

    name: str
    number: int  # that of current_context

    def make_current(self) -> None:
        """Make it current in this thread."""

    def release(self) -> None:
        """Make no context current in this thread."""

    def destroy(self) -> None:
        """Free it."""


def create_context() -> Context:
    """A context in the compatibility profile that needs no display.

    Raises
    ------
    ContextError
        If none works; the message tells what was tried and what to install.
    """
    _check_process()
    wanted = os.environ.get("PYDART2_GL", "").lower()
    if wanted not in ("", *_WAYS):
        raise ContextError(f"PYDART2_GL={wanted!r} is not known; it may be 'egl' or 'osmesa'")
    reasons = []
    for name in [wanted] if wanted else list(_WAYS):
        try:
            context = _WAYS[name]()
            _used_by.add(os.getpid())
            return context
        except (OSError, ContextError) as error:
            reasons.append(f"{name}: {error}")
    raise ContextError(f"{_HELP}. Tried {'; '.join(reasons)}")


before_free: list[Callable[[int], object]] = []
"""Called with the number of a context that is about to be freed, by those who keep something of it."""


def free_with(owner: object, context: Context) -> weakref.finalize[..., object]:
    """Have a context freed when its owner is, or by a call of what is returned, or at the end of the process."""
    return weakref.finalize(owner, _free, context, os.getpid())


def _free(context: Context, process: int) -> None:
    if process != os.getpid():
        return  # in a fork, where the driver would hang
    for forget in before_free:
        forget(context.number)
    context.destroy()


_used_by: set[int] = set()  # processes that made contexts: this one, and those it was forked from


def _check_process() -> None:
    """ContextError in a fork of a process that used OpenGL: the drivers' threads are missing there, and calls hang."""
    if _used_by - {os.getpid()}:
        raise ContextError(
            "this process was forked from one that had used OpenGL; start it with multiprocessing's 'spawn', or fork "
            "before the first picture"
        )


def load_opengl() -> None:
    """Import PyOpenGL so that it works with a context of any origin, in a window or without one."""
    if "OpenGL.platform" not in sys.modules and ctypes.util.find_library("GL") is None:
        os.environ.setdefault("PYOPENGL_PLATFORM", "egl")
    try:
        from OpenGL import platform
    except ImportError as error:
        raise ContextError(
            f"PyOpenGL cannot be loaded ({error}); pip install PyOpenGL, apt-get install libgl1"
        ) from None
    loaded = platform.PLATFORM
    if getattr(loaded, "GL", None) is None:
        raise ContextError("PyOpenGL finds no libGL; apt-get install libgl1")
    if loaded.GetCurrentContext is not current_context:
        # PyOpenGL asks the one window system that it was loaded with; the context may have come from the other.
        for owner in (loaded, platform):
            owner.GetCurrentContext = owner.CurrentContextIsValid = current_context


class _Library:
    """A shared library whose functions are declared on first use."""

    def __init__(self, *names: str) -> None:
        self._library = _load(*names)

    def __call__(self, name: str, result: Any, *arguments: Any) -> Any:
        function = getattr(self._library, name)
        function.restype = result
        return function(*arguments)


def _load(*names: str) -> ctypes.CDLL:
    for name in names:
        try:
            return ctypes.CDLL(name, mode=ctypes.RTLD_GLOBAL)
        except OSError as error:
            reason = error
    raise reason


_pointer = ctypes.c_void_p
_NOTHING = _pointer(0)


class EglContext:
    """A context on no surface at all, by EGL; on a graphics card or in software."""

    name = "egl"
    _PLATFORMS = (0x31DD, 0x313F)  # EGL_PLATFORM_SURFACELESS_MESA, EGL_PLATFORM_DEVICE_EXT
    _OPENGL_API, _NONE = 0x30A2, 0x3038
    # EGL_SURFACE_TYPE any, EGL_RENDERABLE_TYPE OpenGL
    _CONFIG = (0x3033, 0, 0x3040, 0x0008, _NONE)
    # EGL_CONTEXT_MAJOR_VERSION 3, MINOR 3, EGL_CONTEXT_OPENGL_PROFILE_MASK compatibility
    _ATTRIBUTES = (0x3098, 3, 0x30FB, 3, 0x30FD, 0x0002, _NONE)

    def __init__(self) -> None:
        self._egl = egl = _Library("libEGL.so.1", "libEGL.so")
        with _nothing_current():
            self._display = self._open_display()
            if not egl("eglBindAPI", ctypes.c_uint, self._OPENGL_API):
                raise ContextError("this EGL has no desktop OpenGL")
            config, count = _pointer(), ctypes.c_int()
            wanted = (ctypes.c_int * len(self._CONFIG))(*self._CONFIG)
            egl("eglChooseConfig", ctypes.c_uint, self._display, wanted, ctypes.byref(config), 1, ctypes.byref(count))
            attributes = (ctypes.c_int * len(self._ATTRIBUTES))(*self._ATTRIBUTES)
            context = egl("eglCreateContext", _pointer, self._display, config, _NOTHING, attributes)
            if not count.value or not context:
                raise ContextError(f"no OpenGL 3.3 compatibility context (EGL error {self._error()})")
            self._context, self.number = _pointer(context), int(context)
        load_opengl()

    def _open_display(self) -> ctypes.c_void_p:
        for platform in self._PLATFORMS:
            try:
                display = self._egl("eglGetPlatformDisplay", _pointer, platform, _NOTHING, _NOTHING)
            except AttributeError:
                raise ContextError("this EGL is older than 1.5") from None
            major, minor = ctypes.c_int(), ctypes.c_int()
            handle = _pointer(display)
            if display and self._egl("eglInitialize", ctypes.c_uint, handle, ctypes.byref(major), ctypes.byref(minor)):
                return handle
        raise ContextError(f"no EGL display without a window system (EGL error {self._error()})")

    def _error(self) -> str:
        return hex(self._egl("eglGetError", ctypes.c_uint))

    def make_current(self) -> None:
        """Make it current in this thread."""
        self._egl("eglBindAPI", ctypes.c_uint, self._OPENGL_API)
        if not self._egl("eglMakeCurrent", ctypes.c_uint, self._display, _NOTHING, _NOTHING, self._context):
            raise ContextError(f"the EGL context could not be made current (EGL error {self._error()})")

    def release(self) -> None:
        """Make no context current in this thread."""
        self._egl("eglMakeCurrent", ctypes.c_uint, self._display, _NOTHING, _NOTHING, _NOTHING)

    def destroy(self) -> None:
        """Free it."""
        self._egl("eglDestroyContext", ctypes.c_uint, self._display, self._context)


class OSMesaContext:
    """A context of Mesa's that draws into memory and needs no window system or driver at all."""

    name = "osmesa"
    # OSMESA_FORMAT RGBA, DEPTH_BITS 24, PROFILE compatibility, CONTEXT_MAJOR_VERSION 3, MINOR 3
    _ATTRIBUTES = (0x22, 0x1908, 0x30, 24, 0x33, 0x35, 0x36, 3, 0x37, 3, 0)

    def __init__(self) -> None:
        self._mesa = _Library("libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so")
        if "OpenGL.platform" in sys.modules and os.environ.get("PYOPENGL_PLATFORM") != "osmesa":
            raise ContextError("PyOpenGL is loaded already for another one; set PYDART2_GL=osmesa before the start")
        attributes = (ctypes.c_int * len(self._ATTRIBUTES))(*self._ATTRIBUTES)
        context = self._mesa("OSMesaCreateContextAttribs", _pointer, attributes, _NOTHING)
        if not context:
            raise ContextError("no OpenGL 3.3 compatibility context")
        self._context, self.number = _pointer(context), int(context)
        self._pixel = (ctypes.c_ubyte * 4)()  # its own picture; ours are framebuffer objects
        os.environ["PYOPENGL_PLATFORM"] = "osmesa"
        load_opengl()

    def make_current(self) -> None:
        """Make it current in this thread."""
        if not self._mesa("OSMesaMakeCurrent", ctypes.c_ubyte, self._context, self._pixel, 0x1401, 1, 1):
            raise ContextError("the OSMesa context could not be made current")

    def release(self) -> None:
        """Make no context current in this thread."""
        self._mesa("OSMesaMakeCurrent", ctypes.c_ubyte, _NOTHING, _NOTHING, 0x1401, 0, 0)

    def destroy(self) -> None:
        """Free it."""
        self._mesa("OSMesaDestroyContext", None, self._context)


_WAYS: dict[str, Callable[[], Context]] = {"egl": EglContext, "osmesa": OSMesaContext}


def current_context() -> int:
    """A number for the context that is current in this thread, whoever made it; 0 if there is none."""
    for name, function in _CURRENT:
        library = _loaded(name)
        if library is not None and (context := library(function, _pointer)):
            return int(context)
    return 0


_CURRENT = (
    ("libEGL.so.1", "eglGetCurrentContext"),
    ("libGLX.so.0", "glXGetCurrentContext"),
    ("libOSMesa.so.8", "OSMesaGetCurrentContext"),
)


@contextmanager
def current(context: Context, lock: threading.RLock) -> Iterator[None]:
    """Make a context current, alone under the lock; afterwards that which was current before, of a window perhaps."""
    _check_process()
    with lock, keeping_garbage(), _nothing_current():
        context.make_current()
        try:
            yield
        finally:
            context.release()


@contextmanager
def keeping_garbage() -> Iterator[None]:
    """Within it no cycles of objects are deleted: a window that is among them would end the context that is current."""
    enabled = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if enabled:
            gc.enable()


@contextmanager
def _nothing_current() -> Iterator[None]:
    """Let go of the context of a window that is current in this thread; afterwards it is current again."""
    restore = _release_egl() or _release_glx()
    try:
        yield
    finally:
        if restore is not None:
            restore()


def _release_egl() -> Callable[[], None] | None:
    egl = _loaded("libEGL.so.1")
    if egl is None or not (context := egl("eglGetCurrentContext", _pointer)):
        return None
    display = _pointer(egl("eglGetCurrentDisplay", _pointer))
    draw, read = (_pointer(egl("eglGetCurrentSurface", _pointer, which)) for which in (0x3059, 0x305A))
    egl("eglMakeCurrent", ctypes.c_uint, display, _NOTHING, _NOTHING, _NOTHING)
    return lambda: egl("eglMakeCurrent", ctypes.c_uint, display, draw, read, _pointer(context))


def _release_glx() -> Callable[[], None] | None:
    glx = _loaded("libGLX.so.0")
    if glx is None or not (context := glx("glXGetCurrentContext", _pointer)):
        return None
    display = _pointer(glx("glXGetCurrentDisplay", _pointer))
    draw = ctypes.c_ulong(glx("glXGetCurrentDrawable", ctypes.c_ulong))
    read = ctypes.c_ulong(glx("glXGetCurrentReadDrawable", ctypes.c_ulong))
    glx("glXMakeContextCurrent", ctypes.c_int, display, ctypes.c_ulong(0), ctypes.c_ulong(0), _NOTHING)
    return lambda: glx("glXMakeContextCurrent", ctypes.c_int, display, draw, read, _pointer(context))


_found: dict[str, _Library] = {}


def _loaded(name: str) -> _Library | None:
    """A library that someone in this process has loaded; None if nobody has."""
    if name not in _found:
        try:
            ctypes.CDLL(name, mode=os.RTLD_NOLOAD)
        except OSError:
            return None
        _found[name] = _Library(name)
    return _found[name]
