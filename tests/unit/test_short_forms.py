"""A short name does what its long form does, wherever that comes from."""

from __future__ import annotations

import os
import pickle
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import pydart2
from pydart2.alias import Alias

SEVEN = np.full(6, 7.0)


def test_a_class_that_changes_the_long_form_does(cubes: pydart2.World, monkeypatch: pytest.MonkeyPatch) -> None:
    class Turned(pydart2.Skeleton):
        def positions(self, out: Any = None) -> Any:
            return SEVEN

        def set_positions(self, _q: Any = None, **by_name: float) -> None:
            self.given = _q

    turned, plain = Turned(cubes, _id=1), cubes.skeletons[1]
    turned.q = [1.0]
    assert turned.given == [1.0] and turned.q is SEVEN and plain.q is not SEVEN
    monkeypatch.setattr(pydart2.Skeleton, "positions", lambda self: SEVEN)
    assert plain.q is SEVEN
    monkeypatch.undo()
    assert plain.q is not SEVEN


def test_an_object_that_changes_the_long_form_does(cubes: pydart2.World) -> None:
    cube, other = cubes.skeletons[1:3]
    cube.positions = lambda: SEVEN
    assert cube.q is SEVEN and other.q is not SEVEN
    del cube.positions
    assert cube.q is not SEVEN
    given: list[Any] = []
    cube.set_positions = given.append
    cube.q = SEVEN
    assert given == [SEVEN] and not np.array_equal(cube.q, SEVEN)


def seven() -> Any:
    return SEVEN


def test_a_process_that_unpickles_it_hears_of_it(cubes: pydart2.World, tmp_path: Path) -> None:
    """It has never seen a function being set."""
    cubes.skeletons[1].positions = seven
    (tmp_path / "world").write_bytes(pickle.dumps(cubes))
    code = "import pickle, sys; print(pickle.load(open(sys.argv[1], 'rb')).skeletons[1].q.tolist())"
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join([str(Path(__file__).parent), *sys.path])}
    command = [sys.executable, "-c", code, tmp_path / "world"]
    done = subprocess.run(command, env=environment, capture_output=True, text=True)
    assert done.stdout.strip() == str(SEVEN.tolist()), done.stderr


class Handle:
    """Keeps what it is asked."""

    def __init__(self) -> None:
        self.asked: list[tuple[str, tuple[Any, ...]]] = []

    def __getattr__(self, name: str) -> Any:
        return lambda *given: self.asked.append((name, given))


def short_forms(cls: type) -> dict[str, property]:
    members = {name: getattr(cls, name) for name in dir(cls)}
    return {name: alias for name, alias in members.items() if isinstance(alias, Alias)}


@pytest.mark.parametrize("kind", [pydart2.Skeleton, pydart2.BodyNode])
def test_short_forms_ask_the_handle_what_the_long_form_asks(cubes: pydart2.World, kind: Any) -> None:
    """Those of methods that only hand on leave the method out."""
    cube = cubes.skeletons[1]
    owner, forwarded = (cube if kind is pydart2.Skeleton else cube.bodynodes[0]), 0
    owner._handle = handle = Handle()
    for name, alias in short_forms(kind).items():
        long, set_long = alias.fget.name, alias.fset.name if alias.fset else None
        if hasattr(getattr(kind, long), "forwards"):
            getattr(owner, name), getattr(owner, long)()
            forwarded += 1
        if hasattr(getattr(kind, set_long or "", None), "forwards"):
            setattr(owner, name, SEVEN), getattr(owner, set_long)(SEVEN)
            forwarded += 1
    assert len(handle.asked) == 2 * forwarded > 0
    for (name, given), (long, otherwise) in zip(handle.asked[::2], handle.asked[1::2], strict=True):
        assert name == long and list(map(id, given)) == list(map(id, otherwise))


def test_what_is_set_by_name_goes_the_long_way(cubes: pydart2.World) -> None:
    cube = cubes.skeletons[1]
    cube.q = {"joint 1_pos_y": 0.5}
    cube.tau = {"joint 1_pos_y": 2.0}
    assert cube.q["joint 1_pos_y"] == 0.5 and cube.tau["joint 1_pos_y"] == 2.0
    cube.dq = [1.0] * 6
    assert cube.dq.tolist() == [1.0] * 6


def test_no_value_is_none(cubes: pydart2.World) -> None:
    cube = cubes.skeletons[1]
    for name in ("q", "dq", "ddq", "x", "comms", "tau"):
        with pytest.raises(TypeError, match=r"s cannot be None$"):
            setattr(cube, name, None)


def test_forces_last_set_follow_the_tree(cubes: pydart2.World) -> None:
    cube = cubes.skeletons[1]
    cube.tau = np.arange(6.0)
    cube.joints[0].set_name("root")
    assert cube.tau["root_pos_x"] == 3.0
    cube.add_body("arm", cube.bodynodes[0], "revolute", axis=(0, 0, 1)).add_box((0.1, 0.1, 0.1), mass=1.0)
    assert cube.tau.shape == (7,) and cube.tau[cube.dofs[-1].name] == 0.0
    cube.remove_body("arm")
    assert cube.tau.shape == (6,)
