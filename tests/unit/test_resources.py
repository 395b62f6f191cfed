"""Finding models: in the current folder first, then among the package's own."""

from __future__ import annotations

import os
import shutil
from pathlib import Path

import pytest

import pydart2
from pydart2 import LoadError
from pydart2.resources import find_model

CUBES = "skel/cubes.skel"
ATLAS = "sdf/atlas/atlas_v3_no_head.sdf"


def test_data_path_is_absolute_and_there() -> None:
    for name in (CUBES, ATLAS):
        path = Path(pydart2.data_path(name))
        assert path.is_absolute() and path.is_file()
        assert path.as_posix().endswith(name)


def test_data_files_are_those_that_data_path_takes() -> None:
    names = pydart2.data_files()
    assert CUBES in names and ATLAS in names
    assert names == sorted(names)
    for name in names:
        assert Path(pydart2.data_path(name)).is_file()


@pytest.mark.parametrize("name", ["skel/nothing.skel", "skel", "", "../pyproject.toml/x"])
def test_data_path_of_nothing(name: str) -> None:
    with pytest.raises(LoadError, match=r"no file .* among the models of pydart2") as info:
        pydart2.data_path(name)
    assert repr(name) in str(info.value)


@pytest.mark.parametrize("prefix", ["", "./", "data/", "./data/"])
@pytest.mark.parametrize("name", [CUBES, ATLAS])
def test_models_are_found_from_any_folder(
    prefix: str, name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    assert find_model(prefix + name) == pydart2.data_path(name)
    assert find_model(Path(prefix + name)) == pydart2.data_path(name)


def test_worlds_and_skeletons_are_found_so(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    world = pydart2.World(0.001, "./data/skel/cubes.skel")
    assert world.num_skeletons() == 4
    skel = world.add_skeleton("./data/" + ATLAS)
    assert skel.filename == pydart2.data_path(ATLAS)


def test_the_current_folder_comes_first(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    mine = tmp_path / "data" / CUBES
    mine.parent.mkdir(parents=True)
    shutil.copy(pydart2.data_path(CUBES), mine)
    monkeypatch.chdir(tmp_path)
    assert find_model("data/" + CUBES) == os.path.realpath(mine)
    assert find_model(CUBES) == pydart2.data_path(CUBES)  # it is not there without data/


def test_links_are_resolved(tmp_path: Path) -> None:
    """Meshes are looked for beside the file itself."""
    link = tmp_path / "linked.skel"
    link.symlink_to(pydart2.data_path(CUBES))
    assert find_model(link) == os.path.realpath(pydart2.data_path(CUBES))


@pytest.mark.parametrize(
    "name", ["nothing.skel", "./data/skel/cube.skel", "/nowhere/cubes.skel", "/data/skel/cubes.skel", "é" * 200]
)
def test_missing_model(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    with pytest.raises(LoadError, match="nor among the models of pydart2") as info:
        find_model(name)
    assert name in str(info.value) and str(tmp_path) in str(info.value)
    assert isinstance(info.value, OSError)
