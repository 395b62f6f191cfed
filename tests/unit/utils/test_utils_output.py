"""pydart2.utils: log, colored_text, time_measure and jsonpickle."""

from __future__ import annotations

import logging
import sys
import time
import types
from collections.abc import Iterator
from pathlib import Path

import pytest

from pydart2.utils import colored_text, jsonpickle, log, time_measure

CODES = {"red": 31, "green": 32, "yello": 33, "blue": 34, "magenta": 35, "cyan": 36}


@pytest.mark.parametrize("color", CODES)
def test_colors(color: str) -> None:
    code = f"\x1b[{CODES[color]}mtext\x1b[0m"
    plain = "\x1b[1m" + code if color == "cyan" else code
    assert getattr(colored_text, color)("text") == plain
    assert getattr(colored_text, f"bright_{color}")("text") == "\x1b[1m" + code
    assert getattr(colored_text, f"dim_{color}")("text") == "\x1b[2m" + code
    assert getattr(colored_text, f"dim_{color}").__name__ == f"dim_{color}"


@pytest.fixture
def root_logger() -> Iterator[logging.Logger]:
    root = logging.getLogger()
    level, before = root.level, list(root.handlers)
    yield root
    root.setLevel(level)
    for handler in [h for h in root.handlers if h not in before]:
        root.removeHandler(handler)
        handler.close()


def test_log(root_logger: logging.Logger, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "run.log"
    path.write_text("of an earlier run\n")
    log.setup(path)
    log.setup(path)
    logging.getLogger("walker").debug("step %d", 7)
    logging.getLogger("walker").error("fell")
    out = capsys.readouterr().out.splitlines()
    assert [line.split("walker: ")[1] for line in out] == ["step 7", "fell"]
    assert f"[{colored_text.cyan('DEBUG')}]" in out[0]
    assert f"[{colored_text.red('ERROR')}]" in out[1]
    text = path.read_text()
    assert "[DEBUG] walker: step 7" in text
    assert "\x1b" not in text
    assert "earlier" not in text


def test_log_without_file_leaves_the_file(
    root_logger: logging.Logger, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    log.setup(tmp_path / "run.log")
    log.setup()
    logging.getLogger("walker").info("later")
    assert (tmp_path / "run.log").read_text() == ""
    assert capsys.readouterr().out.count("later") == 1


class Robot:
    logger: logging.Logger | None = None

    @time_measure.decorator_time_measure
    def plan(self, depth: int, *, wide: bool = False) -> tuple[int, bool]:
        """Plan."""
        return depth, wide

    @time_measure.decorator_time_measure_colored(colored_text.green)
    def act(self) -> None:
        raise RuntimeError("stuck")


def test_decorated_method_prints(capsys: pytest.CaptureFixture[str]) -> None:
    assert Robot().plan(3, wide=True) == (3, True)
    assert Robot.plan.__doc__ == "Plan."
    out = capsys.readouterr().out
    assert out.startswith("plan: 0.0")
    assert out.endswith(" s\n")


def test_decorated_method_reports_when_it_raises(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(RuntimeError, match="stuck"):
        Robot().act()
    assert capsys.readouterr().out.startswith("\x1b[32mact: ")


def test_decorated_method_logs(capsys: pytest.CaptureFixture[str], caplog: pytest.LogCaptureFixture) -> None:
    robot = Robot()
    robot.logger = logging.getLogger("robot")
    with caplog.at_level(logging.INFO):
        robot.plan(1)
    assert caplog.messages[0].startswith("plan: ")
    assert capsys.readouterr().out == ""


def test_time_measure(capsys: pytest.CaptureFixture[str]) -> None:
    with time_measure.TimeMeasure(name="nap", color=colored_text.red) as measure:
        time.sleep(0.02)
    seconds = measure.toc - measure.tic
    assert 0.02 <= seconds < 1.0
    assert capsys.readouterr().out == colored_text.red(f"nap: {seconds:.6f} s") + "\n"


def test_jsonpickle_is_missing(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.setitem(sys.modules, "jsonpickle", None)
    monkeypatch.delitem(sys.modules, "jsonpickle.ext.numpy", raising=False)
    jsonpickle.init_numpy_handler()
    out = capsys.readouterr().out
    assert "NG" in out
    assert "pip install jsonpickle" in out


def test_jsonpickle_is_there(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    calls: list[str] = []
    handlers = types.ModuleType("jsonpickle.ext.numpy")
    handlers.register_handlers = lambda: calls.append("registered")  # type: ignore[attr-defined]
    for name in ("jsonpickle", "jsonpickle.ext"):
        monkeypatch.setitem(sys.modules, name, types.ModuleType(name))
    monkeypatch.setitem(sys.modules, "jsonpickle.ext.numpy", handlers)
    jsonpickle.init_numpy_handler()
    assert calls == ["registered"]
    assert capsys.readouterr().out.endswith("OK\n")
