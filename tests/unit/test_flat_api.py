"""How the flat functions treat ids, sizes and mistakes; what each of them gives is in the conformance tests."""

from __future__ import annotations

import gc
import inspect
import subprocess
import sys
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import pydart2
import pydart2.pydart2_api as papi
from pydart2.flat.table import ROWS

CUBES = "./data/skel/cubes.skel"


def function(name: str) -> Callable[..., Any]:
    return getattr(papi, name)


@pytest.mark.parametrize("name", [row.name for row in ROWS])
def test_each_says_what_it_does(name: str) -> None:
    doc = inspect.getdoc(function(name))
    assert doc is not None
    signature, _, text = doc.partition(": ")
    assert signature.startswith(f"{name}{inspect.signature(function(name))} -> ")
    assert text.endswith(".") and "singleton" not in text and text != "None"


def test_a_made_world_lives_without_references() -> None:
    wid = papi.createWorld(0.001)
    gc.collect()
    papi.world__step(wid)
    assert papi.world__getTime(wid) == pytest.approx(0.001)


@pytest.mark.parametrize("end", [lambda wid: papi.destroyWorld(wid), lambda wid: papi.destroy()])
def test_a_destroyed_world_has_no_id(end: Callable[[int], None]) -> None:
    wid = papi.createWorld(0.001)
    end(wid)
    with pytest.raises(IndexError, match=f"no world {wid}"):
        papi.world__getTime(wid)


def test_worlds_from_before_init_are_refused() -> None:
    wid = papi.createWorld(0.001)
    pydart2.init(verbose=False)
    with pytest.raises(IndexError, match=f"no world {wid}"):
        papi.world__getTime(wid)


def test_init_counts_from_zero() -> None:
    papi.createWorld(0.001)
    papi.init(False)
    assert papi.createWorld(0.25) == 0
    assert papi.world__getTimeStep(0) == 0.25


def test_a_world_object_is_found_by_its_id(cubes: pydart2.World) -> None:
    cubes.step()
    assert papi.world__getTime(cubes.id) == cubes.t > 0
    cubes.destroy()
    with pytest.raises(IndexError, match=f"no world {cubes.id}"):
        papi.world__getTime(cubes.id)


def test_a_world_object_is_not_kept_alive() -> None:
    world = pydart2.World(0.001)
    wid = world.id
    del world
    gc.collect()
    with pytest.raises(IndexError):
        papi.world__getTime(wid)


def test_the_last_world_of_an_id_is_found() -> None:
    papi.init(False)
    papi.createWorld(0.001)
    pydart2.init(verbose=False)
    world = pydart2.World(0.125)
    assert papi.world__getTimeStep(world.id) == 0.125
    pydart2.init(verbose=False)
    assert papi.createWorld(0.5) == world.id
    assert papi.world__getTimeStep(world.id) == 0.5


def test_a_length_must_be_the_real_one() -> None:
    wid = papi.createWorldFromSkel(CUBES)
    assert papi.skeleton__getPositions(wid, 1, 6).shape == (6,)
    with pytest.raises(ValueError, match="gives 6 numbers, got length 7"):
        papi.skeleton__getPositions(wid, 1, 7)


def test_out_must_fit() -> None:
    wid = papi.createWorldFromSkel(CUBES)
    with pytest.raises(ValueError, match=r"of shape \(6, 6\), got one of shape \(6, 5\)"):
        papi.skeleton__getMassMatrix(wid, 1, np.zeros((6, 5)))
    with pytest.raises(TypeError, match="float64"):
        papi.skeleton__getMassMatrix(wid, 1, np.zeros((6, 6), dtype=np.float32))
    with pytest.raises(TypeError, match="float64"):
        papi.skeleton__getMassMatrix(wid, 1, [[0.0] * 6] * 6)


def test_fixed_sizes_are_checked() -> None:
    wid = papi.createWorld(0.001)
    with pytest.raises(ValueError, match=r"\(3,\)"):
        papi.world__setGravity(wid, [0.0, 1.0])


@pytest.mark.parametrize(
    ("name", "args"),
    [
        ("skeleton__getName", (4,)),
        ("bodynode__getMass", (1, 1)),
        ("bodynode__getMass", (1, -1)),
        ("bodynode__getChildBodyNode", (1, 0, 0)),
        ("dof__getName", (1, 6)),
        ("joint__getName", (1, 1)),
        ("joint__getRestPosition", (1, 0, 6)),
        ("marker__getBodyNode", (1, 0)),
        ("shapenode__getOffset", (1, 0, 2)),
        ("world__getIndex", (5,)),
    ],
)
def test_an_id_that_is_not_there_is_an_index_error(name: str, args: tuple[int, ...]) -> None:
    wid = papi.createWorldFromSkel(CUBES)
    with pytest.raises(IndexError):
        function(name)(wid, *args)


@pytest.mark.parametrize(
    ("name", "args"),
    [
        ("revolute_joint__getAxis", (1, 0)),
        ("prismatic_joint__setAxis", (1, 0, [1, 0, 0])),
        ("universal_joint__getAxis1", (1, 0)),
        ("euler_joint__getAxisOrder", (1, 0)),
        ("sphere_shape__getRadius", (1, 0, 0)),
        ("cylindershape__getHeight", (1, 0, 0)),
        ("mesh_shape__getScale", (1, 0, 0)),
        ("multisphereshape__getSpheres", (1, 0, 0, 4)),
    ],
)
def test_the_wrong_kind_is_a_type_error(name: str, args: tuple[Any, ...]) -> None:
    wid = papi.createWorldFromSkel(CUBES)
    with pytest.raises(TypeError, match=r"is a FreeJoint and has no|a BoxShape has no"):
        function(name)(wid, *args)


def test_numbers_that_mean_nothing_are_value_errors() -> None:
    wid = papi.createWorldFromSkel(CUBES)
    with pytest.raises(ValueError, match="no collision detector 5"):
        papi.world__setCollisionDetector(wid, 5)
    with pytest.raises(ValueError, match="no actuator type 9"):
        papi.joint__setActuatorType(wid, 1, 0, 9)


def test_a_missing_file_is_a_load_error() -> None:
    with pytest.raises(pydart2.LoadError, match=r"nothing\.skel"):
        papi.createWorldFromSkel("nothing.skel")
    with pytest.raises(pydart2.LoadError, match=r"nothing\.urdf"):
        papi.world__addSkeleton(papi.createWorld(0.001), "nothing.urdf")


def test_wrong_argument_counts_are_type_errors() -> None:
    with pytest.raises(TypeError, match="'wid'"):
        papi.world__getTime()
    with pytest.raises(TypeError, match="too many"):
        papi.world__getTime(0, 1)


def test_arguments_may_be_named_and_of_numpy() -> None:
    wid = np.int64(papi.createWorld(0.001))
    papi.world__setTime(time=np.float32(0.5), wid=wid)
    assert papi.world__getTime(wid) == 0.5


def test_an_unknown_name_is_an_attribute_error() -> None:
    with pytest.raises(AttributeError, match=r"'pydart2\.pydart2_api' has no attribute 'world__jump'"):
        function("world__jump")
    assert not hasattr(papi, "__path__")


def test_completion_knows_all() -> None:
    assert {"world__step", "IntVector", "WorldHandle"} < set(dir(papi))


@pytest.mark.parametrize(
    "statement",
    [
        "import pydart2; step = pydart2.papi.world__step",
        "import pydart2.pydart2_api as papi; step = papi.world__step",
        "from pydart2.pydart2_api import world__step as step",
        "from pydart2.flat import api as flat_api; step = flat_api.MEMBERS['world__step']",
        "import _pydart2_api; step = _pydart2_api.world__step",
    ],
)
def test_every_way_to_import_gives_the_same_function(statement: str) -> None:
    code = f"{statement}; import sys; print(step is sys.modules['pydart2.pydart2_api'].world__step)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60)
    assert (done.stdout, done.stderr) == ("True\n", "")
