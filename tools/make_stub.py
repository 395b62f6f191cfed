"""Writes the typed stub of the extension: python make_stub.py HEADERS... STUB.

Its classes are those of the headers that SWIG wraps: every public method of a class that ends in Handle, and of
ModelSource, is declared on lines of its own there. Its functions are those of pydart2/flat/table.py.
"""

from __future__ import annotations

import re
import runpy
import sys
from pathlib import Path
from typing import Any

FLAT_TABLE = Path(__file__).parents[1] / "pydart2" / "flat" / "table.py"

RETURNS = {
    "void": "None",
    "bool": "bool",
    "int": "int",
    "long": "int",
    "double": "float",
    "std::string": "str",
    "std::vector<std::string>": "list[str]",
    "Vector6d": "NDArray[np.float64]",
    "Blueprint": "tuple[Any, ...]",
}
ARGUMENTS = {
    "bool": "bool",
    "long": "int",
    "double": "float",
    "const std::string&": "str",
    "const std::vector<std::string>&": "list[str]",
    "const Blueprint&": "tuple[Any, ...]",
}
IDS = re.compile(r"(w|sk|b|dof|j|m|s)id\d?|i|index|ndofs|nout|\w+_type")
FLAT = {"verbose=True": "verbose: bool = True", "tuple of int": "tuple[int, ...]"}

MADE_IN_PYTHON = ("BatchHandle", "ModelSource", "QueriesHandle", "WorldHandle")

HEAD = '''"""The C++ layer: one handle per engine object. Made by tools/make_stub.py."""

from collections.abc import Callable
from typing import Any, Self, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pydart2.indexing import Names
from pydart2.skeleton import Skeleton
from pydart2.world import World

Vector = TypeVar("Vector", bound=NDArray[np.float64])

class LookedAt: ...

class LongForm:
    name: str
    def __init__(self, method: Callable[..., Any]) -> None: ...
    def __call__(self, owner: Any, value: Any = ...) -> Any: ...

class NamedVector(np.ndarray[tuple[int], np.dtype[np.float64]]):
    _names: Names | None
    def __getitem__(self, key: Any) -> Any: ...
    def __setitem__(self, key: Any, value: Any) -> None: ...

class ContactRow:
    _skeletons: tuple[Skeleton, ...] | None
    world: World
    state: NDArray[np.float64]
    point: NDArray[np.float64]
    p: NDArray[np.float64]
    force: NDArray[np.float64]
    f: NDArray[np.float64]
    skel_id1: int
    bodynode_id1: int
    skel_id2: int
    bodynode_id2: int
    shape_id1: int
    shape_id2: int
    normal: NDArray[np.float64]
    depth: float
    def __init__(self, _world: World, _state: ArrayLike) -> None: ...
    @classmethod
    def from_rows(cls, world: World, rows: ArrayLike, skeletons: tuple[Skeleton, ...]) -> list[Self]: ...

class IntVector(list[int]): ...

def restart() -> None: ...
def engine_version() -> str: ...
def engine_has_assertions() -> bool: ...
def engine_prefix() -> str: ...
def default_solver_name() -> str: ...
def default_dynamics_name() -> str: ...
'''


def argument(declaration: str) -> tuple[str, str]:
    """(name, Python type) of one C++ argument."""
    kind, name = re.fullmatch(r"(.*?[&*\s])(\w+)", declaration.strip()).groups()  # type: ignore[union-attr]
    kind = kind.strip()
    if kind.endswith("Handle&"):
        return name, kind.removeprefix("const ").removesuffix("&")
    if kind == "const ModelSource&":
        return name, "ModelSource"
    if kind == "Output&":
        return name, {"like": "Vector", "into": "NDArray[np.float64] | None"}.get(name, "")
    if kind == "const MatrixOut&":
        return name, "NDArray[np.float64]"
    if kind.endswith("*"):
        return name, "ArrayLike | None"
    return name, ARGUMENTS.get(kind, "ArrayLike")


def method(line: str) -> str | None:
    """The stub of the method that a line declares, None if it declares none."""
    found = re.fullmatch(r"\s+(static |explicit )?([\w:<>]+ )?(\w+)\((.*?)\)( const)?(;| \{.*)", line)
    if found is None:
        return None
    qualifier, result, name, declarations = found.group(1, 2, 3, 4)
    arguments = dict(argument(d) for d in declarations.split(",") if d.strip())
    python_result = RETURNS.get((result or "").strip(), (result or "").strip())
    if python_result.startswith("Eigen::"):
        python_result = "NDArray[np.float64]"
    if result is None:
        name, python_result = "__init__", "None"
    if "out" in arguments:
        python_result = "NDArray[np.float64]"
        del arguments["out"]
    if "into" in arguments:
        python_result = "NDArray[np.float64]"
    if "like" in arguments:
        python_result = "Vector"
    parameters = [] if (qualifier or "").strip() == "static" else ["self"]
    parameters += [f"{key}: {kind}" for key, kind in arguments.items()]
    decorator = "    @staticmethod\n" if (qualifier or "").strip() == "static" else ""
    return f"{decorator}    def {name}({', '.join(parameters)}) -> {python_result}: ..."


def classes(header: str) -> list[str]:
    """The stubs of a header's handle classes."""
    text = re.sub(r"[ \t]*//.*", "", header)
    text = re.sub(r"\(([^()]*)\)", lambda m: "(" + " ".join(m.group(1).split()) + ")", text)
    text = re.sub(r"\(\s*\n\s*", "(", text)
    stubs = []
    for name, body in re.findall(
        r"class (\w+Handle|ModelSource)\n\{\npublic:\n(.*?)\n(?:private:|\};)", text, re.DOTALL
    ):
        methods = [stub for line in body.splitlines() if (stub := method(line))]
        shown = [m for m in methods if not re.search("::|Ref|Busy|ShapeHandle, node: ", m)]
        shown = [m for m in shown if "__init__" not in m or name in MADE_IN_PYTHON]
        stubs.append(f"class {name}:\n" + "\n".join(shown) + "\n")
    return stubs


def function(row: Any) -> str:
    """The stub of a flat function, a row of the table; what is neither an id nor an index may be anything."""
    names = [name for name in row.parameters.split(", ") if name]
    parameters = [FLAT.get(name, f"{name}: {'int' if IDS.fullmatch(name) else 'Any'}") for name in names]
    result = FLAT.get(row.result, "NDArray[np.float64]" if row.result.startswith("(") else row.result)
    return f"def {row.name}({', '.join(parameters)}) -> {result}: ..."


def main() -> None:
    """Read the headers and the table, write the stub."""
    *headers, stub = map(Path, sys.argv[1:])
    parts = [part for header in sorted(headers) for part in classes(header.read_text())]
    functions = [function(row) for row in runpy.run_path(str(FLAT_TABLE))["ROWS"]]
    stub.write_text("\n".join([HEAD, *parts, *functions]) + "\n")


if __name__ == "__main__":
    main()
