"""The package itself."""

from __future__ import annotations

import importlib
import sys
from types import ModuleType
from typing import Any

import numpy as np
import pytest

import pydart2

from .table import row, rows

MODULES = (
    "world constraints skeleton bodynode dof joint marker shape shapenode skel_vector contact collision_result "
    "recording utils"
)
CLASSES = {
    **{name: "joint" for name in ("BallJoint", "EulerJoint", "FreeJoint", "Joint", "PlanarJoint", "PrismaticJoint")},
    **{name: "joint" for name in ("RevoluteJoint", "ScrewJoint", "TranslationalJoint", "UniversalJoint", "WeldJoint")},
    **{
        name: name.lower()
        for name in ("World", "Skeleton", "Dof", "BodyNode", "ShapeNode", "Marker", "Contact", "Shape")
    },
    "CollisionResult": "collision_result",
    "SkelVector": "skel_vector",
}


@row("pydart2.init")
def test_init_destroys_all_worlds_and_counts_from_zero(capfd: pytest.CaptureFixture[str]) -> None:
    old = pydart2.World(0.001)
    pydart2.init()
    assert "Msg [pydart2_api] Initialize pydart manager OK" in capfd.readouterr().out
    assert [pydart2.World(0.001).id, pydart2.World(0.001).id] == [0, 1]
    with pytest.raises(pydart2.DestroyedError):
        old.step()
    pydart2.init(verbose=False)
    assert capfd.readouterr() == ("", "")


@rows("pydart2.", {name: name for name in MODULES.split()})
def test_submodule_is_an_attribute(case: str) -> None:
    module = getattr(pydart2, case)
    assert isinstance(module, ModuleType)
    assert module is sys.modules[f"pydart2.{case}"]


@rows("pydart2.", {name: (name, module) for name, module in CLASSES.items()})
def test_class_is_that_of_its_module(case: tuple[str, str]) -> None:
    name, module = case
    assert getattr(pydart2, name) is getattr(importlib.import_module(f"pydart2.{module}"), name)


@row("pydart2.papi", "pydart2.pydart2_api")
def test_the_extension_is_papi() -> None:
    package: Any = pydart2
    assert package.papi is package.pydart2_api is sys.modules["pydart2.pydart2_api"]
    world = pydart2.World(0.25)
    assert package.papi.world__getTimeStep(world.id) == 0.25


@row("pydart2.__version__")
def test_version_is_a_string_of_numbers() -> None:
    assert [part.isdigit() for part in pydart2.__version__.split(".")[:2]] == [True, True]


@row("pydart2.verbose", "pydart2.set_verbose")
def test_verbosity_is_kept() -> None:
    pydart2.set_verbose(False)
    assert pydart2.verbose() is False
    pydart2.set_verbose()
    assert pydart2.verbose() is True


@row("world.create_world")
def test_create_world(cubes: pydart2.World) -> None:
    made = pydart2.create_world(0.002, "./data/skel/cubes.skel")
    assert (made.dt, made.num_skeletons()) == (0.002, cubes.num_skeletons())
    np.testing.assert_allclose(made.x, cubes.x)
    assert pydart2.create_world(0.002).num_skeletons() == 0
