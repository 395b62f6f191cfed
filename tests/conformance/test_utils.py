"""pydart2.utils without its transformations."""

from __future__ import annotations

import logging
import re
import sys
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

import pydart2
from pydart2.utils import colored_text, jsonpickle, log, misc, time_measure

from .table import row, rows


@rows("utils.", {n: n for n in ("transformations", "misc", "log", "jsonpickle", "time_measure", "colored_text")})
def test_submodule(case: str) -> None:
    part = getattr(pydart2.utils, case)
    assert isinstance(part, ModuleType) and part is sys.modules[f"pydart2.utils.{case}"]


@row("utils.misc.S")
def test_text() -> None:
    text = misc.S
    assert (text(0.5), text(0.5, 2), text(None)) == ("0.500000", "0.50", "None")
    assert re.findall(r"[\d.]+", text([1, 0.5], precision=3)) == ["1.000", "0.500"]


@row("utils.misc.split_by_sizes")
def test_split() -> None:
    pieces = misc.split_by_sizes(np.arange(6), [1, 2, 3])
    assert [list(piece) for piece in pieces] == [[0], [1, 2], [3, 4, 5]]


MISC: dict[str, tuple[tuple[Any, ...], Any]] = {
    "norm2": (([3.0, 4.0],), 25.0),
    "deg2rad": ((180.0,), np.pi),
    "rad2deg": ((np.pi,), 180.0),
    "vel": ((0.1, 1.0, 2.0, 4.0), 15.0),
    "acc": ((0.1, 1.0, 2.0, 4.0), 100.0),
    "grad": ((lambda x: x[0] ** 2 * x[1], np.array([1.0, 2.0]), 1e-4), [4.0, 1.0]),
    "grad4": ((lambda x: x[0] ** 4 * x[1], np.array([1.0, 2.0]), 1e-2), [8.0, 1.0]),
}


@rows("utils.misc.", {name: (name, *case) for name, case in MISC.items()})
def test_function(case: tuple[str, tuple[Any, ...], Any]) -> None:
    name, args, expected = case
    assert_allclose(getattr(misc, name)(*args), expected, rtol=1e-6)


def test_missing_ends() -> None:
    assert (misc.vel(0.1, None, 2.0, 4.0), misc.vel(0.1, 1.0, 2.0, None)) == (20.0, 10.0)


@row("utils.misc.penalize", "utils.misc.confine")
def test_intervals() -> None:
    assert [misc.penalize(x, 1.0, 2.0) for x in (0.5, 1.5, 2.25)] == [0.5, 0.0, 0.25]
    assert [misc.confine(x, 1.0, 2.0) for x in (0.5, 1.5, 2.25)] == [1.0, 1.5, 2.0]
    assert_allclose(misc.confine(np.array([0, 3]), [1, 1], [2, 2]), [1, 2])


@row("utils.log.setup")
def test_log(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    root = logging.getLogger()
    level, handlers = root.level, list(root.handlers)
    try:
        log.setup(tmp_path / "log.txt")
        logging.getLogger("part").debug("something happened")
        assert root.level == logging.DEBUG
        assert "something happened" in (tmp_path / "log.txt").read_text(encoding="utf-8")
        out = capsys.readouterr().out
        assert "something happened" in out and "\x1b[" in out
    finally:
        root.setLevel(level)
        for handler in [handler for handler in root.handlers if handler not in handlers]:
            root.removeHandler(handler)
            handler.close()


COLORS = {"red": 31, "green": 32, "yello": 33, "blue": 34, "magenta": 35, "cyan": 36}


@rows(
    "utils.colored_text.",
    {f"{style}{name}": (style, name) for style in ("", "bright_", "dim_") for name in COLORS},
)
def test_color(case: tuple[str, str]) -> None:
    style, name = case
    text = getattr(colored_text, style + name)("words")
    codes = set(";".join(re.findall(r"\x1b\[([\d;]*)m", text.partition("words")[0])).split(";"))
    assert str(COLORS[name]) in codes
    assert ("1" in codes) == (style == "bright_" or (name == "cyan" and style == ""))
    assert ("2" in codes) == (style == "dim_")
    assert text.partition("words")[2] == "\x1b[0m"


class Worker:
    """Something with methods to measure, and a logger like that of the `logging` module."""

    def __init__(self) -> None:
        self.logger = self
        self.lines: list[str] = []

    def info(self, text: str) -> None:
        self.lines.append(text)

    def work(self, x: int) -> int:
        return 2 * x


@row("utils.time_measure.decorator_time_measure", "utils.time_measure.decorator_time_measure_colored")
def test_measured_method() -> None:
    worker = Worker()
    plain: Any = time_measure.decorator_time_measure(Worker.work)
    loud: Any = time_measure.decorator_time_measure_colored(str.upper)(Worker.work)
    assert plain(worker, 3) == loud(worker, 3) == 6
    assert "work" in worker.lines[0] and "WORK" in worker.lines[1]


@row("utils.time_measure.TimeMeasure")
def test_time_measure(capsys: pytest.CaptureFixture[str]) -> None:
    with time_measure.TimeMeasure(name="nothing") as measure:
        pass
    assert 0 <= measure.toc - measure.tic < 1
    assert "nothing" in capsys.readouterr().out


@row("utils.jsonpickle.init_numpy_handler")
def test_jsonpickle(capsys: pytest.CaptureFixture[str]) -> None:
    jsonpickle.init_numpy_handler()
    out = capsys.readouterr().out
    try:
        import jsonpickle as installed
    except ImportError:
        assert "NG" in out
    else:
        assert "OK" in out
        assert_allclose(installed.decode(installed.encode(np.arange(3.0))), [0, 1, 2])
