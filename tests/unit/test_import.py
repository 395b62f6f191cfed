"""What importing the package brings with it, each in a process of its own."""

from __future__ import annotations

import os
import subprocess
import sys

import pytest


def run(code: str) -> str:
    environment = {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM")}
    done = subprocess.run(
        [sys.executable, "-W", "error", "-c", code], env=environment, capture_output=True, text=True, timeout=60
    )
    assert done.returncode == 0, done.stderr
    assert done.stderr == ""
    return done.stdout


@pytest.mark.parametrize("heavy", ["PyQt5", "OpenGL", "scipy", "PIL", "matplotlib", "hashlib", "concurrent"])
def test_import_is_light(heavy: str) -> None:
    found = f"[m for m in sys.modules if (m == {heavy!r} or m.startswith({heavy + '.'!r})) and m not in by_numpy]"
    assert run(f"import sys, numpy; by_numpy = {{*sys.modules}}; import pydart2; print({found})") == "[]\n"


def test_import_prints_nothing_and_a_world_needs_no_init() -> None:
    assert run("import pydart2; pydart2.World(0.001).step()") == ""


def test_init_prints_the_documented_line() -> None:
    assert run("import pydart2; pydart2.init(verbose=True)") == "Msg [pydart2_api] Initialize pydart manager OK\n"
    assert run("import pydart2; pydart2.init()") == "Msg [pydart2_api] Initialize pydart manager OK\n"
    assert run("import pydart2; pydart2.init(verbose=False)") == ""


def test_verbose() -> None:
    code = "import pydart2 as p; p.init(False); a = p.verbose(); p.set_verbose(); print(a, p.verbose())"
    assert run(code) == "False True\n"


def test_version_is_the_metadata_s() -> None:
    code = "import pydart2; from importlib.metadata import version; print(pydart2.__version__ == version('pydart2'))"
    assert run(code) == "True\n"


MODULES = "bodynode collision_result constraints contact dof joint marker recording shape shapenode"


def test_modules_are_attributes() -> None:
    """The documentation writes pydart2.joint.Joint.LOCKED after `import pydart2` alone."""
    names = (MODULES + " skel_vector skeleton world").split()
    code = f"import pydart2; print([m for m in {names} if not hasattr(pydart2, m)])"
    assert run(code) == "[]\n"
    assert run("import pydart2; print(pydart2.joint.Joint.LOCKED)") == "5\n"


def test_unknown_attribute() -> None:
    with pytest.raises(AssertionError, match="module 'pydart2' has no attribute 'nothing'"):
        run("import pydart2; pydart2.nothing")


def test_world_ids_start_at_zero_after_init() -> None:
    code = "import pydart2 as p; a = [p.World(0.1).id for _ in range(3)]; p.init(False); print(a, p.World(0.1).id)"
    assert run(code) == "[0, 1, 2] 0\n"
