"""Every public name says what it is; every array that it takes or returns has a shape and a unit."""

from __future__ import annotations

import importlib
import inspect
import pkgutil
import re
from collections.abc import Iterator
from types import ModuleType
from typing import Any

import pytest

import pydart2

# Made from tables, with docstrings of their own kind: the engine's handles, the original's flat functions.
GENERATED = re.compile(r"pydart2\.(_|pydart2_api|flat_)")
ARRAY = re.compile(r"\b(NDArray|ArrayLike|SkelVector|ndarray|Matrix|Array|Vector)\b")
SHAPE = re.compile(r"\bshapes?\b|\((?:[\w.*+ ]+,)+[^)]*\)|\bnumbers?\b|\belementwise\b", re.I)
# Units, and words for what has none.
UNIT = re.compile(
    r"(?<!\w)(m|rad|degrees|kg|s|N|J|px|[Pp]ixels?)(?![\w(])|[mskgd][²³]|\b0 to 1\b"
    r"|\b([Uu]nits?|dimensionless|quaternions?|rotations?|ids?|[Ii]ndices|uint8|float32)\b"
)
LIKE = re.compile(r"(?:Like|of|for) (?:(\w+)\(\)|`([\w.]+)`)")  # "Like add_ext_force(), ...", "As for `render`."
CONVENTION = re.compile(r"^Arrays: .*?(?=\n\n|\Z)", re.MULTILINE | re.DOTALL)  # in a class, for all of its methods


def modules() -> Iterator[ModuleType]:
    """The package and all of its public modules."""
    yield pydart2
    for info in pkgutil.walk_packages(pydart2.__path__, "pydart2."):
        if not GENERATED.match(info.name) and "._" not in info.name:
            yield importlib.import_module(info.name)


def public(owner: Any, prefix: str) -> Iterator[tuple[str, Any]]:
    """The public functions, classes, methods and properties that a module or class defines."""
    for name, member in vars(owner).items():
        path = f"{prefix}.{name}"
        if name.startswith("_"):
            continue
        if isinstance(member, (staticmethod, classmethod)):
            member = member.__func__
        if inspect.isclass(member) and member.__module__ == prefix:
            yield path, member
            yield from public(member, path)
        own = inspect.isclass(owner) or getattr(member, "__module__", "") == prefix
        if isinstance(member, property) or (inspect.isfunction(member) and own):
            yield path, member


NAMES = dict(sorted(item for module in modules() for item in public(module, module.__name__)))


def documentation(path: str) -> str:
    """Its docstring, that of what it refers to, and the convention of its class."""
    text = inspect.getdoc(NAMES[path]) or ""
    owner = path.rpartition(".")[0]
    parts = [text, *CONVENTION.findall(inspect.getdoc(NAMES.get(owner)) or "")]
    for name in (method or reference for method, reference in LIKE.findall(text)):
        other = (
            f"{owner}.{name}" if f"{owner}.{name}" in NAMES else next((n for n in NAMES if n.endswith(f".{name}")), "")
        )
        if other and other != path:
            parts.append(documentation(other))
    return "\n".join(parts)


def arrays(member: Any) -> bool:
    """Whether it takes or returns an array."""
    function = member.fget if isinstance(member, property) else member
    if not inspect.isfunction(function):
        return False
    return any(ARRAY.search(str(annotation)) for annotation in function.__annotations__.values())


def test_every_module_has_a_docstring() -> None:
    assert [module.__name__ for module in modules() if not module.__doc__] == []


def test_every_public_name_has_a_docstring() -> None:
    missing = [path for path, member in NAMES.items() if not inspect.getdoc(member)]
    assert len(NAMES) > 500
    assert missing == []


@pytest.mark.parametrize("what", ["shape", "unit"])
def test_every_array_has_a_shape_and_a_unit(what: str) -> None:
    pattern = {"shape": SHAPE, "unit": UNIT}[what]
    with_arrays = {path: documentation(path) for path, member in NAMES.items() if arrays(member)}
    assert len(with_arrays) > 150
    lacking = [path for path, text in with_arrays.items() if not pattern.search(text)]
    assert lacking == [], "\n".join(f"{path}: {with_arrays[path]}" for path in lacking)
