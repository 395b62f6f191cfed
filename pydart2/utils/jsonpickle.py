"""NumPy arrays in jsonpickle."""

from __future__ import annotations

from importlib import import_module


def init_numpy_handler() -> None:
    """Register jsonpickle's handlers for NumPy; prints OK, or NG if jsonpickle is not installed."""
    try:
        handlers = import_module("jsonpickle.ext.numpy")
    except ImportError as error:
        print(f"jsonpickle's NumPy handlers: NG ({error}); pip install jsonpickle")
        return
    handlers.register_handlers()
    print("jsonpickle's NumPy handlers: OK")
