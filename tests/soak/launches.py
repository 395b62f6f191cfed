"""Launches the window again and again under an X server, and looks at how each process ends.

    python tests/soak/launches.py 500

Models, windows (Qt's, with its pictures or ours, and GLUT's) and ways to end are drawn at random. A process that ends
with another status than 0 leaves its core and what it said in build/launches; exit code 1 then.
"""

from __future__ import annotations

import os
import random
import resource
import subprocess
import sys
import tempfile
import textwrap
from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
KEPT = ROOT / "build" / "launches"
MODELS = ("skel/cubes.skel", "skel/fullbody1.skel", "skel/softBodies.skel", "sdf/atlas/atlas_v3_no_head.sdf")
WINDOWS = {
    "Qt, its pictures": ("launch", {"PYDART2_QT_PICTURES": "1"}),
    "Qt, our pictures": ("launch", {"PYDART2_QT_PICTURES": ""}),
    "GLUT": ("launch_glut", {}),
}
#: After so many steps the script does this, if the time is not up before.
ENDS = {
    "time": "pass",
    "exit": "raise SystemExit(0)",
    "Ctrl-C": "os.kill(os.getpid(), signal.SIGINT)",
    "os._exit": "os._exit(0)",
    "a thread that steps": "threading.Thread(target=other.step, args=(10**6,), daemon=True).start()",
    "a picture, then exit": "pydart2.gui.render(self, 64, 48); raise SystemExit(0)",
}
LAUNCH = """
import os, signal, sys, threading
import pydart2

other = pydart2.World(0.001, "skel/cubes.skel")

class Ending(pydart2.World):
    def on_step_event(self):
        if self.frame == {frame}:
            {end}

path = pydart2.data_path("{model}")
world = Ending(0.001, path) if path.endswith(".skel") else Ending(0.001)
if not path.endswith(".skel"):
    world.add_skeleton(path)
pydart2.gui.viewer.{launch}(world)
"""
SECONDS = 900.0


@contextmanager
def x_server() -> Iterator[str]:
    """The name of a display of its own."""
    command = ["Xvfb", "-displayfd", "1", "-screen", "0", "1280x1024x24", "-noreset", "-nolisten", "tcp"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True) as server:
        assert server.stdout
        yield f":{server.stdout.readline().strip()}"
        server.terminate()


def keep_cores() -> None:
    resource.setrlimit(resource.RLIMIT_CORE, (resource.RLIM_INFINITY, resource.RLIM_INFINITY))


def launch(draw: random.Random, display: str, folder: Path) -> tuple[str, int, str]:
    """One launch: what was drawn, the status, and what was said on stderr."""
    model, window, end = draw.choice(MODELS), draw.choice(list(WINDOWS)), draw.choice(list(ENDS))
    name, choice = WINDOWS[window]
    script = LAUNCH.format(model=model, frame=draw.randrange(1, 60), launch=name, end=ENDS[end])
    environment = {
        **os.environ,
        "PYTHONPATH": str(ROOT),
        "DISPLAY": display,
        "QT_QPA_PLATFORM": "xcb",
        "XDG_RUNTIME_DIR": str(folder),
        "PYTHONFAULTHANDLER": "1",
        "PYDART2_VIEWER_SECONDS": f"{draw.uniform(0.05, 1.5):.2f}",
        **choice,
    }
    command = [sys.executable, "-c", textwrap.dedent(script)]
    try:
        done = subprocess.run(
            command, capture_output=True, text=True, env=environment, cwd=folder, timeout=SECONDS, preexec_fn=keep_cores
        )
    except subprocess.TimeoutExpired as late:
        return f"{window}, {end}, {model}", 124, str(late.stderr)
    return f"{window}, {end}, {model}", done.returncode, done.stderr


def main(count: int, seed: int) -> int:
    """How many launches ended badly."""
    draw, ends, bad = random.Random(seed), Counter[str](), 0
    with x_server() as display:
        for number in range(count):
            with tempfile.TemporaryDirectory() as name:
                folder = Path(name)
                what, status, said = launch(draw, display, folder)
                ends[what.split(",")[0] + f" {status}"] += 1
                if status == 0 or (status == 130 and "Ctrl-C" in what):
                    continue
                bad += 1
                KEPT.mkdir(parents=True, exist_ok=True)
                (KEPT / f"{number}.txt").write_text(f"{what}: status {status}\n{said}")
                for core in folder.glob("core*"):
                    core.replace(KEPT / f"{number}.core")
                print(f"launch {number}: {what}: status {status}, see {KEPT}", flush=True)
    print(f"{count} launches, {bad} ended badly:", dict(sorted(ends.items())))
    return bad


if __name__ == "__main__":
    sys.exit(main(int(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 0) > 0)
