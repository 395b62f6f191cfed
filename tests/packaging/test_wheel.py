"""The self-contained wheel on a bare Debian 12, made by debootstrap, which has Python and nothing else."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
pytestmark = pytest.mark.packaging

SIMULATE = """
import pydart2
world = pydart2.World(0.001, "skel/cubes.skel")
world.step(1000)
assert world.collision_result.num_contacts() > 0
robot = world.add_skeleton("sdf/atlas/atlas_v3_no_head.sdf")
print(f"{robot.m:.6f}", robot.ndofs)
"""
RENDER = """
import pydart2
world = pydart2.World(0.001, "skel/cubes.skel")
picture = pydart2.gui.render(world, 64, 48)
print(picture.shape, picture.std() > 1)
"""


def run(*command: str | Path, check: bool = True) -> subprocess.CompletedProcess[str]:
    result = subprocess.run(list(map(str, command)), capture_output=True, text=True)
    assert not check or result.returncode == 0, result.stdout + result.stderr
    return result


def debian_mirror() -> str:
    """Where this machine's packages come from."""
    lines = run("apt-get", "indextargets", "--format", "$(CODENAME) $(REPO_URI)").stdout.splitlines()
    return next(line.split()[1] for line in lines if line.split()[0] == "bookworm")


@pytest.fixture(scope="module")
def bare(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Path]:
    """A root file system with Python's virtual environments, and the wheel installed in /v."""
    if os.geteuid() != 0 or shutil.which("debootstrap") is None:
        pytest.fail("needs root and debootstrap: apt-get install debootstrap")
    root = tmp_path_factory.mktemp("bare") / "root"
    run("debootstrap", "--variant=minbase", "--include=python3,python3-venv", "bookworm", root, debian_mirror())
    shutil.copyfile("/etc/resolv.conf", root / "etc/resolv.conf")
    run(sys.executable, ROOT / "tools/make_wheel.py")
    (wheel,) = (ROOT / "dist").glob("*.whl")
    run(sys.executable, "-m", "pip", "download", "--quiet", "--dest", root / "wheels", wheel)
    run("chroot", root, "python3", "-m", "venv", "/v")
    run("chroot", root, "/v/bin/pip", "install", "--quiet", "--no-index", "--find-links", "/wheels", "pydart2")
    yield root
    shutil.rmtree(root)


def python(root: Path, code: str, check: bool = True) -> subprocess.CompletedProcess[str]:
    return run("chroot", root, "/v/bin/python", "-c", code, check=check)


def test_it_simulates(bare: Path) -> None:
    assert run("chroot", bare, "sh", "-c", "command -v gcc g++ cmake swig", check=False).stdout == ""
    assert not list(bare.glob("usr/lib/*/libdart*"))
    assert python(bare, SIMULATE).stdout == "146.554000 33\n"


def test_it_renders(bare: Path) -> None:
    """Without OpenGL it says what to install; with that it draws."""
    refused = python(bare, RENDER, check=False)
    assert refused.returncode == 1
    assert "apt-get install libegl1 libgl1 libgl1-mesa-dri" in refused.stderr
    run("chroot", bare, "apt-get", "update")
    run("chroot", bare, "apt-get", "install", "-y", "--no-install-recommends", "libegl1", "libgl1", "libgl1-mesa-dri")
    assert python(bare, RENDER).stdout == "(48, 64, 3) True\n"
