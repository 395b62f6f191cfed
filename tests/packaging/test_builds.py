"""Every documented way to build and install, from a fresh copy of the sources."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import venv
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
NUMPY = subprocess.run(
    [sys.executable, "-c", "import numpy; print(numpy.__version__)"], check=True, capture_output=True, text=True
).stdout.strip()
# Leaves the folder of the sources, so that what is imported is what was installed.
SIMULATE = """
import os, sys
import pydart2
world = pydart2.World(0.001, "./data/skel/cubes.skel")
world.step(100)
assert abs(world.skeletons[-1].C[1] + 0.195) > 0.01, "the cube did not fall"
assert world.skeletons[-1].q["joint 1_pos_y"] < 0
from pydart2.cli.examples import example_names
assert "biped_stand" in example_names()
import _pydart2_api
assert _pydart2_api.world__getTime(world.id) == world.t
print(os.path.dirname(pydart2.__file__))
"""


def copy_sources(target: Path) -> Path:
    """The files of the repository, without anything that was built."""
    listed = subprocess.run(
        ["git", "ls-files", "-co", "--exclude-standard", "-z"], cwd=ROOT, check=True, capture_output=True, text=True
    ).stdout
    for name in filter(None, listed.split("\0")):
        if (ROOT / name).is_file():
            (target / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / name, target / name)
    return target


def run(*command: str | Path, cwd: Path, env: dict[str, str] | None = None) -> str:
    """The output of a command; a failure shows it."""
    result = subprocess.run([str(c) for c in command], cwd=cwd, env=env, capture_output=True, text=True)
    assert result.returncode == 0, result.stdout + result.stderr
    return result.stdout


@pytest.fixture
def sources(tmp_path: Path) -> Path:
    return copy_sources(tmp_path / "sources")


@pytest.fixture
def python(tmp_path: Path) -> Iterator[Path]:
    """A fresh virtual environment's interpreter."""
    venv.create(tmp_path / "venv", with_pip=True)
    yield tmp_path / "venv" / "bin" / "python"


@pytest.mark.packaging
def test_pip_install(sources: Path, python: Path, tmp_path: Path) -> None:
    run(python, "-m", "pip", "install", "-q", ".", cwd=sources)
    shutil.rmtree(sources)  # nothing of it is needed any more
    assert str(tmp_path / "venv") in run(python, "-c", SIMULATE, cwd=tmp_path)


@pytest.mark.packaging
def test_pip_install_editable(sources: Path, python: Path, tmp_path: Path) -> None:
    run(python, "-m", "pip", "install", "-q", "-e", ".", cwd=sources)
    assert str(sources) in run(python, "-c", SIMULATE, cwd=tmp_path)


@pytest.mark.packaging
@pytest.mark.parametrize("setuptools", ["setuptools<80", "setuptools"])
def test_setup_py(sources: Path, python: Path, tmp_path: Path, setuptools: str) -> None:
    run(python, "-m", "pip", "install", "-q", "-U", setuptools, "wheel", f"numpy=={NUMPY}", cwd=sources)
    run(python, "setup.py", "build", "build_ext", cwd=sources)
    run(python, "setup.py", "develop", cwd=sources)
    assert str(sources) in run(python, "-c", SIMULATE, cwd=tmp_path)


@pytest.mark.packaging
def test_cmake(sources: Path, tmp_path: Path) -> None:
    run("cmake", "-S", ".", "-B", "build", f"-DPython3_EXECUTABLE={sys.executable}", cwd=sources)
    run("cmake", "--build", "build", cwd=sources)
    env = {**os.environ, "PYTHONPATH": str(sources)}
    assert str(sources) in run(sys.executable, "-c", SIMULATE, cwd=tmp_path, env=env)


def configure(sources: Path, path: str, *options: str) -> str:
    """What setup.py or CMake says on its last line when the build fails."""
    env = {**os.environ, "PATH": path, "CXX": "", "CC": ""}
    command = (
        [sys.executable, "setup.py", "-q", "build_ext"]
        if not options
        else ["cmake", "-S", ".", "-B", "build", f"-DPython3_EXECUTABLE={sys.executable}", *options]
    )
    result = subprocess.run(command, cwd=sources, env=env, capture_output=True, text=True)
    assert result.returncode != 0
    return result.stderr


@pytest.mark.parametrize(
    ("missing", "sentence"),
    [
        (("c++", "g++", "gcc", "cc", "clang++", "clang"), "pydart2 needs a C++17 compiler: apt-get install g++"),
        (("cmake",), "pydart2 needs cmake to be built: apt-get install cmake"),
    ],
    ids=["compiler", "cmake"],
)
def test_missing_tool(sources: Path, tmp_path: Path, missing: tuple[str, ...], sentence: str) -> None:
    tools = tmp_path / "bin"
    tools.mkdir()
    for tool in Path("/usr/bin").iterdir():
        if tool.name not in missing:
            (tools / tool.name).symlink_to(tool)
    assert configure(sources, str(tools)).splitlines()[-1] == sentence


@pytest.mark.parametrize(
    ("package", "sentence"),
    [
        ("DART", "pydart2 needs DART 6.12 or newer: apt-get install libdart-all-dev"),
        ("SWIG", "pydart2 needs SWIG 4.1 or newer: apt-get install swig"),
    ],
)
def test_missing_package(sources: Path, package: str, sentence: str) -> None:
    assert sentence in configure(sources, os.environ["PATH"], f"-DCMAKE_DISABLE_FIND_PACKAGE_{package}=ON")
