"""Models of installed packages, by name."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

import pydart2
from pydart2 import NameNotFound, World, models

LINK = "<link name='l'><inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial>"
URDF = f"<robot name='r'>{LINK}{{}}</link></robot>"
FILES = {
    "acme/arms/v1/crane.urdf": URDF.format(""),
    "acme/arms/v2/crane.urdf": URDF.format(""),
    "acme/digger_robot.urdf": URDF.format("").replace("'r'", "'digger'"),
    "acme/no_model.xml": "<package/>",
    "acme/walker.xml": "<!-- MJCF --><mujoco/>",
    "acme/gone.urdf": None,
}
MESH = "<visual><geometry><mesh filename='package://acme/meshes/a.obj'/></geometry></visual>"


@pytest.fixture
def acme(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """An installed package with models."""
    for name, text in FILES.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        if text is not None:
            (tmp_path / name).write_text(text)
    info = tmp_path / "acme-1.0.dist-info"
    info.mkdir()
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: acme\nVersion: 1.0\n")
    (info / "RECORD").write_text("".join(f"{name},sha256=x,1\n" for name in FILES))
    monkeypatch.syspath_prepend(tmp_path)
    models._models.cache_clear()
    yield tmp_path / "acme"
    models._models.cache_clear()


@pytest.mark.parametrize("name", ["digger", "Digger_Robot", "digger_robot.urdf", "acme/digger", "digger_description"])
def test_a_robot_by_name(acme: Path, name: str) -> None:
    assert models.find(name) == str(acme / "digger_robot.urdf")
    assert World(0.001).add_skeleton(models.find(name)).name == "digger"


def test_names(acme: Path) -> None:
    """Those that are there and are models; our own as well."""
    assert {"crane", "digger_robot", "walker", "pr2", "fullbody1"} <= set(models.names())
    assert not {"no_model", "gone"} & set(models.names())
    assert models.find("data/urdf/pr2/pr2") == pydart2.data_path("urdf/PR2/pr2.urdf")


def test_several_of_a_name(acme: Path) -> None:
    with pytest.raises(ValueError, match=r"2 models 'crane'; say which: 'v1/crane', 'v2/crane'"):
        models.find("crane")
    assert models.find("v2/crane") == models.find("acme/v2/crane") == str(acme / "arms/v2/crane.urdf")


@pytest.mark.parametrize("name", ["no_model", "gone", "v3/crane", "", "nothing"])
def test_what_is_not_there(acme: Path, name: str) -> None:
    with pytest.raises(NameNotFound, match="pip install airo-models example-robot-data"):
        models.find(name)


def test_a_near_name_is_said(acme: Path) -> None:
    with pytest.raises(NameNotFound, match="did you mean 'digger_robot'"):
        models.find("diger_robot")


def test_packages_are_found(acme: Path) -> None:
    """From a text, which lies in no folder of theirs."""
    (acme / "meshes").mkdir()
    (acme / "meshes" / "a.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    (node,) = World(0.001).add_skeleton(URDF.format(MESH)).bodynodes[0].shapenodes
    assert node.shape.path() == str(acme / "meshes" / "a.obj")


def test_a_robot_that_others_modelled() -> None:
    """Of airo-models, which the tests bring."""
    assert World(0.001, up="z").add_skeleton(models.find("ur5e"), base="fixed").ndofs == 6
