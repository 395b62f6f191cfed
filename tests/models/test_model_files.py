"""The model files are complete, wherever they are installed."""

from __future__ import annotations

import shutil
import subprocess
import sys
import xml.etree.ElementTree as ET
from pathlib import Path

import pytest

import pydart2

DATA = Path(pydart2.data_path("SOURCES.md")).parent
TOOLS = Path(__file__).parents[2] / "tools"
MODELS = sorted(path.relative_to(DATA) for kind in ("skel", "sdf", "urdf") for path in DATA.rglob(f"*.{kind}"))


def named_meshes(model: Path) -> set[Path]:
    """The mesh files that a model names; their paths are relative to it."""
    root = ET.parse(model).getroot()
    names = [e.text or "" for tag in ("uri", "file_name") for e in root.iter(tag)]
    names += [e.get("filename", "") for e in root.iter("mesh") if e.get("filename")]
    return {(model.parent / name).resolve() for name in names}


def loaded(folder: Path, model: Path) -> pydart2.World:
    if model.suffix == ".skel":
        return pydart2.World(0.001, folder / model)
    world = pydart2.World(0.001)
    world.add_skeleton(folder / model)
    return world


def test_there_are_the_models() -> None:
    skel = ("chain", "cubes", "fullbody1", "ground", "shapes", "softBodies")
    robots = ["sdf/atlas/atlas_v3_no_head.sdf", "urdf/PR2/pr2.urdf"]
    assert sorted(str(m) for m in MODELS) == sorted([*robots, *(f"skel/{name}.skel" for name in skel)])


@pytest.mark.parametrize("model", MODELS, ids=str)
def test_xml_is_well_formed_and_says_what_it_is(model: Path) -> None:
    assert ET.parse(DATA / model).getroot().tag == {".skel": "skel", ".sdf": "sdf", ".urdf": "robot"}[model.suffix]
    assert "<!--" in (DATA / model).read_text(encoding="ascii").splitlines()[1]


@pytest.mark.parametrize("model", MODELS, ids=str)
def test_meshes_are_found_in_any_folder(model: Path, tmp_path: Path) -> None:
    """In a copy whose path has a space, each mesh that the model names is loaded."""
    folder = tmp_path / "some models"
    shutil.copytree(DATA, folder)
    world = loaded(folder, model)
    shapes = [node.shape for s in world.skeletons for b in s.bodynodes for node in b.shapenodes]
    meshes = {shape.path() for shape in shapes if shape.type() == "MeshShape"}
    assert {Path(m.removeprefix("file://")).resolve() for m in meshes} == named_meshes(folder / model)


def test_each_mesh_is_used() -> None:
    used = {path for model in MODELS for path in named_meshes(DATA / model)}
    assert used == {path.resolve() for path in DATA.rglob("*.obj")}


@pytest.mark.parametrize("mesh", sorted(DATA.rglob("*.obj")), ids=lambda path: f"{path.parent.name}/{path.name}")
def test_mesh_is_complete(mesh: Path) -> None:
    """It uses all of its points, and only colours of its library."""
    lines = [line.split() for line in mesh.read_text(encoding="ascii").splitlines()]
    library = mesh.parent / next(words[1] for words in lines if words[0] == "mtllib")
    stated = library.read_text(encoding="ascii").splitlines()
    colours = {line.split()[1] for line in stated if line.startswith("newmtl")}
    assert {words[1] for words in lines if words[0] == "usemtl"} <= colours
    points = sum(words[0] == "v" for words in lines)
    corners = [int(c.split("//")[0]) for words in lines if words[0] == "f" for c in words[1:]]
    assert set(corners) == set(range(1, points + 1))


def test_data_is_small() -> None:
    assert sum(path.stat().st_size for path in DATA.rglob("*") if path.is_file()) < 5_000_000


@pytest.mark.parametrize("tool", ["make_atlas", "make_skel", "make_fullbody1", "make_pr2"])
def test_tool_writes_what_is_there(tool: str, tmp_path: Path) -> None:
    subprocess.run([sys.executable, TOOLS / f"{tool}.py", tmp_path], check=True, capture_output=True)
    written = [path for path in tmp_path.rglob("*") if path.is_file()]
    assert written
    for path in written:
        assert path.read_bytes() == (DATA / path.relative_to(tmp_path)).read_bytes(), path
