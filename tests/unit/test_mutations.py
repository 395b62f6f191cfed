"""The changes that tools/mutate.py tries can be made: code that moves on leaves none of them behind."""

from __future__ import annotations

import runpy
from pathlib import Path

ROOT = Path(__file__).parents[2]


def test_each_change_has_one_place_and_tests() -> None:
    listed = runpy.run_path(str(ROOT / "tools" / "mutate.py"))["read"]((ROOT / "tests" / "mutations.txt").read_text())
    assert len(listed) > 60
    places = {(one.file, one.old): (ROOT / one.file).read_text().count(one.old) for one in listed}
    assert {place: count for place, count in places.items() if count != 1} == {}
    assert [test for one in listed for test in one.tests if not (ROOT / "tests" / test).exists()] == []
