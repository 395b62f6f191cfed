"""Builds the extension with CMake and puts models and examples into the package; the rest is in pyproject.toml."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext
from setuptools.command.build_py import build_py
from setuptools.command.develop import develop

ROOT = Path(__file__).resolve().parent
sys.path.insert(0, str(ROOT / "tools"))

import package_readme  # noqa: E402 (beside us, not installed)


class BuildExtension(build_ext):
    """Runs CMake; in an editable or in-place build the results go into the source folder."""

    def run(self) -> None:
        in_place = self.inplace or self.editable_mode
        package = ROOT / "pydart2" if in_place else Path(self.build_lib).resolve() / "pydart2"
        prefix = os.environ.get("PYDART2_DART_PREFIX", "")  # of another DART than Debian's, as make engine builds
        cmake_folder = ROOT / "build" / f"cmake-{sys.implementation.cache_tag}{'-prefix' if prefix else ''}"
        require("cmake", "apt-get install cmake")
        configure = ["cmake", "-S", str(ROOT), "-B", str(cmake_folder), f"-DPYDART2_OUTPUT_DIR={package}"]
        configure.append(f"-DPYDART2_DART_PREFIX={prefix and Path(prefix).resolve()}")
        run_cmake(
            [*configure, f"-DPython3_EXECUTABLE={sys.executable}", f"-DPython3_NumPy_INCLUDE_DIR={numpy_headers()}"]
        )
        run_cmake(["cmake", "--build", str(cmake_folder), "--parallel", str(os.cpu_count())])

    def copy_extensions_to_source(self) -> None:
        """Nothing: CMake has put them there."""

    def get_outputs(self) -> list[str]:
        """Nothing: the whole build folder is installed."""
        return []

    def get_output_mapping(self) -> dict[str, str]:
        """Nothing: CMake writes straight to where an editable install looks."""
        return {}


class BuildPackage(build_py):
    """Puts the models and the examples beside the modules."""

    def run(self) -> None:
        super().run()
        if not self.editable_mode:
            for folder in ("data", "examples"):
                ignored = shutil.ignore_patterns("__pycache__")
                shutil.copytree(
                    ROOT / folder, Path(self.build_lib) / "pydart2" / folder, ignore=ignored, dirs_exist_ok=True
                )


class Develop(develop):
    """What setuptools does since version 80, in older ones too: easy_install finds no SciPy."""

    def run(self) -> None:
        no_deps = ["--no-deps"] if self.no_deps else []
        result = subprocess.run([sys.executable, "-m", "pip", "install", "--editable", str(ROOT), *no_deps])
        if result.returncode != 0:
            sys.exit(result.returncode)


def require(program: str, remedy: str) -> None:
    """End the build with one sentence if a program is missing."""
    if shutil.which(program) is None:
        sys.exit(f"pydart2 needs {program} to be built: {remedy}")


def numpy_headers() -> str:
    """NumPy's include folder, of the Python that builds."""
    try:
        import numpy
    except ImportError:
        sys.exit("pydart2 needs NumPy to be built: pip install numpy")
    return numpy.get_include()


def run_cmake(command: list[str]) -> None:
    """Run CMake; if it ends with one of our own sentences, so does the build."""
    result = subprocess.run(command, stdout=sys.stdout, stderr=subprocess.PIPE, text=True)
    if result.returncode == 0:
        return
    ours = re.search(r"pydart2 needs .*", result.stderr)
    sys.exit(ours.group() if ours else f"{result.stderr}\npydart2 could not be built; see the message above")


setup(
    long_description=package_readme.readme(package_readme.source()),
    long_description_content_type="text/markdown",
    ext_modules=[Extension("pydart2._pydart2_api", sources=[])],
    cmdclass={"build_ext": BuildExtension, "build_py": BuildPackage, "develop": Develop},
)
