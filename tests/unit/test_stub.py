"""The typed stub of the extension: every public method of a handle that Python can call stands in it."""

from __future__ import annotations

import runpy
from pathlib import Path

import pytest

from pydart2 import pydart2_api

HEADER = """
/// A thing.
class ThingHandle
{
public:
  int size() const; ///< Of all.
  double mass() const { return 1.0; }   // kg
  void set_name(
      const std::string& name,  ///< New.
      long index);

private:
  int hidden() const;
};
"""


def test_comments_hide_no_method() -> None:
    tool = runpy.run_path(str(Path(__file__).parents[2] / "tools" / "make_stub.py"))
    assert tool["classes"](HEADER) == [
        """class ThingHandle:
    def size(self) -> int: ...
    def mass(self) -> float: ...
    def set_name(self, name: str, index: int) -> None: ...
"""
    ]


@pytest.mark.parametrize("name", [name for name in dir(pydart2_api) if name.endswith("Handle")])
def test_every_method_is_in_it(name: str) -> None:
    stub = Path(pydart2_api.__file__).with_suffix(".pyi").read_text()
    _, _, rest = stub.partition(f"class {name}:\n")
    declared = rest.partition("\nclass ")[0]
    methods = [method for method in vars(getattr(pydart2_api, name)) if not method.startswith(("_", "this"))]
    assert [method for method in methods if f"def {method}(" not in declared] == []
