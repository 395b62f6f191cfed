"""Imports of pydart2.utils."""

from __future__ import annotations

import subprocess
import sys

import pytest

import pydart2.utils

MODULES = ["colored_text", "jsonpickle", "log", "misc", "time_measure", "transformations"]


def run(code: str) -> str:
    """Standard output of a fresh interpreter."""
    return subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.strip()


def test_import_loads_nothing_heavy() -> None:
    heavy = "{'scipy', 'colorama', 'jsonpickle'}"
    code = f"import pydart2.utils, sys; print(sorted({heavy} & {{name.split('.')[0] for name in sys.modules}}))"
    assert run(code) == "[]"


@pytest.mark.parametrize("name", MODULES)
def test_submodule_is_an_attribute_after_import(name: str) -> None:
    assert run(f"import pydart2.utils; print(pydart2.utils.{name}.__name__)") == f"pydart2.utils.{name}"


def test_misc_does_not_load_scipy() -> None:
    assert run("import pydart2.utils, sys; pydart2.utils.misc; print('scipy' in sys.modules)") == "False"


def test_dir_and_all_name_the_submodules() -> None:
    assert set(MODULES) <= set(dir(pydart2.utils))
    assert sorted(pydart2.utils.__all__) == MODULES


def test_unknown_attribute() -> None:
    with pytest.raises(AttributeError, match="nothing_here"):
        _ = pydart2.utils.nothing_here
