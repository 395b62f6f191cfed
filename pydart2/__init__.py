"""Robot physics for Python on the DART engine.

>>> import pydart2 as pydart
>>> world = pydart.World(1.0 / 2000.0, "./data/skel/cubes.skel")
>>> world.step()
>>> world.skeletons[-1].C
"""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

from pydart2 import constraints, pydart2_api
from pydart2.batch import Batch
from pydart2.bodynode import BodyNode
from pydart2.collision_result import CollisionResult
from pydart2.contact import Contact
from pydart2.contact_forces import Contacts
from pydart2.dof import Dof
from pydart2.engine import EngineInfo, engine_info
from pydart2.errors import DestroyedError, ExportError, LoadError, NameNotFound, PydartError, SimulationError
from pydart2.frames import SimpleFrame
from pydart2.inverse_kinematics import IKResult, Target
from pydart2.joint import (
    BallJoint,
    EulerJoint,
    FreeJoint,
    Joint,
    PlanarJoint,
    PrismaticJoint,
    RevoluteJoint,
    ScrewJoint,
    TranslationalJoint,
    TranslationalJoint2D,
    UniversalJoint,
    WeldJoint,
)
from pydart2.manager import init, set_verbose, verbose
from pydart2.marker import Marker
from pydart2.recording import Recording
from pydart2.resources import data_files, data_path
from pydart2.run import Run
from pydart2.shape import Shape
from pydart2.shapenode import ShapeNode
from pydart2.skel_vector import SkelVector
from pydart2.skeleton import Skeleton
from pydart2.softbody import SoftBodyNode
from pydart2.state import Snapshot
from pydart2.world import World, create_world

if TYPE_CHECKING:
    # The documented modules, for type checkers: at run time the imports above have bound them.
    from pydart2 import bodynode as bodynode
    from pydart2 import dof as dof
    from pydart2 import gui, models, utils
    from pydart2 import joint as joint
    from pydart2 import marker as marker
    from pydart2 import shape as shape
    from pydart2 import shapenode as shapenode
    from pydart2 import skel_vector as skel_vector
    from pydart2 import skeleton as skeleton

    __version__: str

papi = pydart2_api

__all__ = [
    "BallJoint",
    "Batch",
    "BodyNode",
    "CollisionResult",
    "Contact",
    "Contacts",
    "DestroyedError",
    "Dof",
    "EngineInfo",
    "EulerJoint",
    "ExportError",
    "FreeJoint",
    "IKResult",
    "Joint",
    "LoadError",
    "Marker",
    "NameNotFound",
    "PlanarJoint",
    "PrismaticJoint",
    "PydartError",
    "Recording",
    "RevoluteJoint",
    "ScrewJoint",
    "Shape",
    "ShapeNode",
    "Run",
    "SimpleFrame",
    "SimulationError",
    "SkelVector",
    "Skeleton",
    "Snapshot",
    "SoftBodyNode",
    "Target",
    "TranslationalJoint",
    "TranslationalJoint2D",
    "UniversalJoint",
    "WeldJoint",
    "World",
    "constraints",
    "create_world",
    "data_files",
    "data_path",
    "engine_info",
    "gui",
    "init",
    "models",
    "papi",
    "pydart2_api",
    "set_verbose",
    "utils",
    "verbose",
]

if "IPython" in sys.modules:
    from pydart2.utils.completion import register

    register()
    del register


def __getattr__(name: str) -> object:
    """What takes a while to import and is seldom wanted."""
    if name == "__version__":
        from importlib.metadata import version

        return version("pydart2")
    if name in ("gui", "models", "utils"):
        from importlib import import_module

        return import_module(f"pydart2.{name}")
    from pydart2.habits import in_package

    found = in_package(name)
    hint = "" if found is None or name[:1] == "_" else f"; here that is {found}"
    raise AttributeError(f"module 'pydart2' has no attribute {name!r}{hint}")
