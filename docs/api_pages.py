"""The pages of the API reference: the classes that people use come first and alone are in the sidebar.

A page per module holds all of its public names. Modules that only the package itself needs have one too, which
`modules` links and the search finds.
"""

from __future__ import annotations

import importlib
import inspect
import pkgutil
import re
from collections.abc import Iterator

import pydart2

PRIVATE = re.compile(r"\._|\.(pydart2_api|flat_\w+)$")

#: The classes that lead.
CLASSES = (
    *(pydart2.World, pydart2.Skeleton, pydart2.BodyNode, pydart2.Joint, pydart2.Dof, pydart2.SkelVector),
    *(pydart2.CollisionResult, pydart2.Contact, pydart2.Recording, pydart2.Batch),
)
FOREIGN = "object, ndarray, LookedAt, NamedVector, ContactRow"  # bases whose methods are not ours to describe

#: What else scripts import.
MODULES = (
    *("gui", "gui.viewer", "gui.offscreen", "gui.recorder", "gui.camera", "gui.moving_cameras", "gui.trackball"),
    *("constraints", "contact_forces", "collision_filter", "shape", "shapenode", "marker", "softbody", "frames"),
    *("sensors", "inverse_kinematics", "queries", "run", "state", "errors", "engine", "manager", "resources", "models"),
    *("mjcf", "mjcf.coordinates", "muscle", "utils", "utils.transformations", "utils.progress", "gui.pyqt5.window"),
    *("gui.pyqt5.side_panel", "gui.runtime", "gui.opengl.renderer"),
)


def pages() -> dict[str, str]:
    """The pages by name, without `.rst`."""
    leading = {cls.__module__: cls for cls in CLASSES}
    shown = [f"pydart2.{name}" for name in MODULES]
    inside = [name for name in public_modules() if name not in leading and name not in shown]
    made = {name: class_page(cls) for name, cls in leading.items()}
    made |= {name: module_page(name) for name in (*shown, *inside)}
    return made | {"index": index(), "modules": modules_page(shown, inside)}


def public_modules() -> Iterator[str]:
    """The modules of the package whose name does not say that they are private."""
    for info in pkgutil.walk_packages(pydart2.__path__, "pydart2."):
        if not PRIVATE.search(info.name):
            yield info.name


def headline(module: str) -> str:
    """The first line of a module's docstring."""
    return (importlib.import_module(module).__doc__ or "").strip().partition("\n")[0]


def title(text: str) -> str:
    """A heading."""
    return f"{text}\n{'=' * len(text)}\n\n"


def class_page(cls: type) -> str:
    """A class with all that it inherits from its parts, then what else is in its module."""
    module, name = cls.__module__, cls.__name__
    return (
        f"{title(name)}.. autoclass:: {module}.{name}\n   :inherited-members: {FOREIGN}\n\n"
        f".. automodule:: {module}\n   :exclude-members: {name}\n"
    )


def module_page(name: str) -> str:
    """A module with all of its public names; not in the sidebar."""
    return f":orphan:\n\n{title(name)}.. automodule:: {name}\n"


def index() -> str:
    """The classes that lead, then every name at top level with a link to it."""
    rows = "\n".join(f"   * - :py:class:`~{cls.__module__}.{cls.__name__}`\n     - {summary(cls)}" for cls in CLASSES)
    names = ", ".join(link(name) for name in sorted(pydart2.__all__, key=str.lower))
    toc = "\n".join(f"   {cls.__name__} <{cls.__module__}>" for cls in CLASSES)
    return f"""{title("API reference")}Most scripts need ten classes:

.. list-table::
   :widths: 25 75

{rows}

Pictures, movies and windows are in :doc:`pydart2.gui <pydart2.gui>`, ways to tie bodies together in
:doc:`pydart2.constraints <pydart2.constraints>`, what can go wrong in :doc:`pydart2.errors <pydart2.errors>`;
:doc:`all modules <modules>` lists the rest.

At top level, as ``pydart2.World``: {names}.

.. toctree::
   :hidden:

{toc}
   All modules <modules>
"""


def summary(cls: type) -> str:
    """The first line of a class's docstring."""
    return (inspect.getdoc(cls) or "").partition("\n")[0]


def link(name: str) -> str:
    """A name at top level, linked to where it is described."""
    value = getattr(pydart2, name)
    if inspect.ismodule(value):
        private = PRIVATE.search(value.__name__)
        return f"``{name}``" if private else f":doc:`{name} <{value.__name__}>`"
    return f":py:obj:`{name} <{value.__module__}.{value.__name__}>`"


def modules_page(shown: list[str], inside: list[str]) -> str:
    """The tables of modules."""
    return f"""{title("All modules")}{table([cls.__module__ for cls in CLASSES])}

What else scripts import:

{table(shown)}

What the package itself is made of, and may change without notice:

{table(inside)}
"""


def table(modules: list[str]) -> str:
    """Links and headlines."""
    rows = "\n".join(f"   * - :doc:`{name} <{name}>`\n     - {headline(name)}" for name in modules)
    return f".. list-table::\n   :widths: 35 65\n\n{rows}"
