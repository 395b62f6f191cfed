"""Writes the typed stub of the extension from the headers that SWIG wraps: python make_stub.py HEADERS... STUB.

Every public method of a class that ends in Handle is declared on lines of its own there.
"""

from __future__ import annotations

import re
import sys
from pathlib import Path

RETURNS = {
    "void": "None",
    "bool": "bool",
    "int": "int",
    "long": "int",
    "double": "float",
    "std::string": "str",
    "std::vector<std::string>": "list[str]",
    "Vector6d": "NDArray[np.float64]",
}
ARGUMENTS = {"bool": "bool", "long": "int", "double": "float", "const std::string&": "str"}

HEAD = '''"""The C++ layer: one handle per engine object. Made by tools/make_stub.py."""

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pydart2.indexing import Names
from pydart2.skel_vector import SkelVector

class NamedVector(np.ndarray[tuple[int], np.dtype[np.float64]]):
    _names: Names | None
    def __getitem__(self, key: Any) -> Any: ...
    def __setitem__(self, key: Any, value: Any) -> None: ...

def restart() -> None: ...
'''


def argument(declaration: str) -> tuple[str, str]:
    """(name, Python type) of one C++ argument."""
    kind, name = re.fullmatch(r"(.*?[&*\s])(\w+)", declaration.strip()).groups()  # type: ignore[union-attr]
    kind = kind.strip()
    if kind.endswith("Handle&"):
        return name, kind.removeprefix("const ").removesuffix("&")
    if kind == "Output&":
        return name, "SkelVector"
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
    if "like" in arguments:
        python_result = "SkelVector"
    parameters = [] if (qualifier or "").strip() == "static" else ["self"]
    parameters += [f"{key}: {kind}" for key, kind in arguments.items()]
    decorator = "    @staticmethod\n" if (qualifier or "").strip() == "static" else ""
    return f"{decorator}    def {name}({', '.join(parameters)}) -> {python_result}: ..."


def classes(header: str) -> list[str]:
    """The stubs of a header's handle classes."""
    text = re.sub(r"///.*|//.*", "", header)
    text = re.sub(r"\(([^()]*)\)", lambda m: "(" + " ".join(m.group(1).split()) + ")", text)
    text = re.sub(r"\(\s*\n\s*", "(", text)
    stubs = []
    for name, body in re.findall(r"class (\w+Handle)\n\{\npublic:\n(.*?)\n(?:private:|\};)", text, re.DOTALL):
        methods = [stub for line in body.splitlines() if (stub := method(line))]
        shown = [m for m in methods if "::" not in m and "Ref" not in m and "ShapeHandle, node: " not in m]
        shown = [m for m in shown if "__init__" not in m or name == "WorldHandle"]
        stubs.append(f"class {name}:\n" + "\n".join(shown) + "\n")
    return stubs


def main() -> None:
    """Read the headers, write the stub."""
    *headers, stub = map(Path, sys.argv[1:])
    parts = [part for header in sorted(headers) for part in classes(header.read_text())]
    stub.write_text("\n".join([HEAD, *parts]))


if __name__ == "__main__":
    main()
