"""The house: which file may know which."""

from __future__ import annotations

import ast
import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

import pydart2

ROOT = Path(__file__).parents[2]
PACKAGE = Path(pydart2.__file__).parent
CPP = ROOT / "src" / "cpp"

# What a room of src/cpp may include, besides itself. `handles` and `python` are on top.
BELOW = {
    "base": set[str](),
    "engine": {"base"},
    "collision": {"engine"},
    "loading": {"collision"},
    "dynamics": {"collision"},
    "contact": {"dynamics"},
    "state": {"contact", "loading"},
    "handles": {"state"},
    "python": {"handles"},
}


# The one lazy import by which the core reaches the screen.
DOOR = ("pydart2.screen", "pydart2.gui.drawing")


def python_arrows() -> dict[str, set[str]]:
    """Which module of the package imports which when the program runs, also inside functions."""
    files = {name_of(path): path for path in PACKAGE.rglob("*.py") if path.name != "pydart2_api.py"}
    return {name: set(imports(path, set(files))) - {name} for name, path in files.items()}


def name_of(path: Path) -> str:
    parts = path.relative_to(PACKAGE.parent).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


def imports(path: Path, modules: set[str]) -> Iterator[str]:
    """The package's modules that a file imports, those for type checking left out."""
    for node in run_time_nodes(ast.parse(path.read_text())):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names if alias.name in modules)
        elif isinstance(node, ast.ImportFrom) and node.module:
            assert node.level == 0, f"{path}: relative import"
            for alias in node.names:
                whole = f"{node.module}.{alias.name}"
                if whole in modules or node.module in modules:
                    yield whole if whole in modules else node.module


def run_time_nodes(node: ast.AST) -> Iterator[ast.AST]:
    for child in ast.iter_child_nodes(node):
        if isinstance(child, ast.If) and "TYPE_CHECKING" in ast.unparse(child.test):
            continue
        yield child
        yield from run_time_nodes(child)


def circles(arrows: dict[str, set[str]]) -> list[set[str]]:
    """The groups of two or more that reach each other."""
    reach: dict[str, set[str]] = {}
    for start in arrows:
        seen, todo = set[str](), list(arrows[start])
        while todo:
            name = todo.pop()
            if name not in seen:
                seen.add(name)
                todo += arrows.get(name, ())
        reach[start] = seen
    found = {frozenset({a} | {b for b in reach[a] if a in reach[b]}) for a in arrows if a in reach[a]}
    return [set(group) for group in found]


def without_faces(arrows: dict[str, set[str]]) -> dict[str, set[str]]:
    """A package's face, an `__init__` beside other files, only hands names on."""
    return {name: targets - {"pydart2"} for name, targets in arrows.items() if name != "pydart2"}


def test_a_circle_is_found() -> None:
    assert circles({"a": {"b"}, "b": {"c"}, "c": {"b"}}) == [{"b", "c"}]


def test_python_modules_do_not_run_in_circles() -> None:
    arrows = without_faces(python_arrows())
    arrows[DOOR[0]].remove(DOOR[1])
    assert circles(arrows) == []


def test_the_window_runs_in_no_circle_for_type_checkers_either() -> None:
    files = {name_of(path): path for path in (PACKAGE / "gui" / "pyqt5").glob("[a-z]*.py")}
    arrows = {
        name: {node.module for node in ast.walk(ast.parse(path.read_text())) if isinstance(node, ast.ImportFrom)}
        & files.keys()
        for name, path in files.items()
    }
    assert len(arrows) > 15 and any(arrows.values())
    assert circles(arrows) == []  # type: ignore[arg-type]


def test_the_core_reaches_the_screen_by_one_door() -> None:
    rooms_with_pictures = ("pydart2.gui", "pydart2.cli", "pydart2.__main__")
    arrows = {
        (name, target)
        for name, targets in without_faces(python_arrows()).items()
        for target in targets
        if target.startswith("pydart2.gui") and not name.startswith(rooms_with_pictures)
    }
    assert arrows == {DOOR}


def test_one_file_imports_the_extension() -> None:
    statement = re.compile(r"^ *from pydart2\._?pydart2_api import", re.MULTILINE)
    assert [path.name for path in PACKAGE.rglob("*.py") if statement.search(path.read_text())] == ["_native.py"]


def test_using_models_loads_nothing_of_the_screen() -> None:
    code = (
        "import pydart2, sys; w = pydart2.World(0.001, './data/skel/cubes.skel'); w.step(); w.clone(); "
        "print([m for m in sys.modules if m.startswith(('pydart2.gui', 'OpenGL', 'PyQt5'))])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


def cpp_files() -> list[Path]:
    return sorted(path for path in CPP.rglob("*") if path.suffix in (".cpp", ".hpp"))


def below(room: str) -> set[str]:
    return {room}.union(*(below(lower) for lower in BELOW[room]))


@pytest.mark.parametrize("path", cpp_files(), ids=lambda path: str(path.relative_to(CPP)))
def test_cpp_includes_point_down(path: Path) -> None:
    room = path.relative_to(CPP).parts[0]
    rooms = {include.split("/")[0] for include in re.findall(r'#include "([^"]+)"', path.read_text())}
    assert rooms & BELOW.keys() <= below(room)


# How a file reaches what the engine keeps to itself.
REACHES = {
    "a detail header": r"#include <dart/[^>]*/detail/",
    "the dynamic loader": r"\b(dlsym|dladdr|dl_iterate_phdr)\b|#include <(elf|link)\.h>",
    "a redefined symbol": r"\b__assert_fail\s*\(",
    "a protected member": r"\.\*\(?&\w+::m[A-Z]",
}


@pytest.mark.parametrize("how", REACHES)
def test_only_the_engine_room_reaches_into_the_engine(how: str) -> None:
    found = {path.relative_to(CPP).parts[0] for path in cpp_files() if re.search(REACHES[how], path.read_text())}
    assert found <= {"engine"}


def test_the_classes_that_extend_the_engine_are_these() -> None:
    """By its public interface; whoever adds one says here that it is no way to protected members."""
    pattern = r"\b(?:class|struct) (\w+)(?: final)?\s*:\s*(?:public |private )?(?:CompletedDetector<)?dart::"
    found = {
        name
        for path in cpp_files()
        if path.relative_to(CPP).parts[0] != "engine"
        for name in re.findall(pattern, path.read_text())
    }
    assert found <= {
        "BulletDetector",
        "DartDetector",
        "FastConstraintSolver",
        "FclDetector",
        "NativeDetector",
        "NativeGroup",
        "Object",
        "OdeDetector",
        "PartFilter",
        "Retriever",
        "TextResource",
    }


def test_the_page_names_files_that_are_there() -> None:
    """`docs/architecture.md` says where things are: whole paths, folders, and the ends of paths."""
    page = (ROOT / "docs" / "architecture.md").read_text(encoding="utf-8")
    tops = (
        ROOT / top for top in ("benchmarks", "data", "docs", "examples", "pydart2", "src", "swig", "tests", "tools")
    )
    paths = [str(path.relative_to(ROOT)) for top in tops for path in top.rglob("*.*")]
    named = re.findall(r"`([\w./*]+(?:/\w+|\.(?:py|cpp|hpp|i)))`", page)
    assert len(named) > 60
    for name in named:
        pattern = re.compile(re.escape(name).replace(r"\*", r"\w*") + r"(/|$)")
        assert any(pattern.search(path) for path in paths), name
