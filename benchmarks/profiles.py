"""Where the time of a step goes, by `perf` (Debian's linux-perf): python benchmarks/profiles.py.

A bar that is missed has its limit here: no step is shorter than the parts of it that cannot be.
"""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
import time
from collections import Counter
from collections.abc import Callable
from dataclasses import asdict

from harness import BUILD, ENVIRONMENT, PLAYERS, ROOT, table
from scenes import atlas_with_meshes, scenes

SECONDS = 4.0  # of sampling
HERTZ = 2000
FALL = 100  # steps
LYING = 1500  # steps
CPP = ROOT / "src" / "cpp"
SCENES = ("cubes", "chain", "fullbody1", "softBodies", "Atlas", "PR2", "Atlas with meshes")
MANY = ("Atlas × 1", "Atlas × 16", "Atlas × 256", "Atlas × 256, FCL", "snapshot of 64", "clone of 64")
#: Detector, solver, and whether there is a floor.
HUMANS = {
    "native, iterative": ("native", "iterative", True),
    "Bullet": ("bullet", "fast", True),
    "FCL": ("fcl", "fast", True),
    "native, iterative, in the air": ("native", "iterative", False),
}
#: Of a library's name, and of a function's. The first that is found.
PARTS = (
    ("contacts found", r"libfcl|libode|libBullet|libLinear|libccd|libassimp", r"^dart::collision::|^room collision"),
    ("LCP", r"^$", r"pydart2::DantzigLcp"),
    ("constraint rows", r"^$", r"^room contact|^dart::constraint::"),
    ("dynamics, ours", r"^$", r"^room (dynamics|state)"),
    ("engine's objects", r"libdart", r"^dart::"),
    ("memory", r"^libc\.|kernel|^libstdc", r"^$"),
    ("Python", r"^libpython|umath", r"^$"),
)


def rooms() -> dict[str, str]:
    """Our classes, and functions in C++ files alone, by the room that they stand in."""
    found: dict[str, str] = {}
    for path in sorted(CPP.glob("*/*.?pp"), key=lambda path: path.suffix != ".hpp"):
        text = path.read_text(encoding="utf-8")
        names = re.findall(r"^(?:class|struct) (\w+)", text, re.M)
        names += re.findall(r"^[\w:<>&*, \[\]]*?[\w>&*] [&*]?(\w+)\(", text, re.M)
        for name in names:
            found.setdefault(name, path.parent.name)
    return found


def part_of(library: str, function: str, room_of: dict[str, str]) -> str:
    """What of a step a function belongs to."""
    if "pydart2" in library:
        names = re.findall(r"\w+", re.sub(r"\(anonymous namespace\)|pydart2::|<.*?>", "", function))
        function = next((f"room {room_of[name]}, {function}" for name in names if name in room_of), function)
    for part, libraries, functions in PARTS:
        if re.search(libraries, library) or re.search(functions, function):
            return part
    return "other"


def play(name: str) -> None:
    """Say so when the clock may start, then step until killed."""
    call = maker(name)
    call()
    print("ready", flush=True)
    begin, steps = time.thread_time(), 0
    while True:
        pause = time.thread_time() + 0.1  # what nobody reads while perf records has to go into a pipe
        while time.thread_time() < pause:
            steps += call()
        print((time.thread_time() - begin) / steps, flush=True)


def maker(name: str) -> Callable[[], int]:
    """A function that steps, and says how many steps (of robots) those were."""
    sys.path.insert(0, str(PLAYERS))
    from ours import Model
    from robots import robots

    if name.startswith("Atlas ×"):
        count = int(re.findall(r"\d+", name)[0])
        world = robots(count, "fcl" if "FCL" in name else "native")
        start = world.states()

        def step() -> int:
            world.set_states(start)
            world.step(FALL)
            return FALL * count

        return step
    method, _, copied = name.partition(" of ")
    if copied:
        world = robots(int(copied), "fcl")
        world.step(3)

        def copy() -> int:
            getattr(world, method)()
            return int(copied)

        return copy
    if name in HUMANS:
        from rollouts import human

        detector, solver, ground = HUMANS[name]
        world = human(detector, solver, 0.1, ground)
        world.step(LYING if ground else 1)
        lying = world.states()

        def lie() -> int:
            world.set_states(lying)
            world.step(FALL)
            return FALL

        return lie
    scene = {scene.name: scene for scene in [*scenes().values(), *atlas_with_meshes()]}[name]
    model = Model(asdict(scene))
    model.step(scene.warm)
    states = model.states()

    def again() -> int:
        model.set_states(states)
        model.step(scene.steps)
        return scene.steps

    return again


def profile(name: str, room_of: dict[str, str]) -> tuple[float, Counter[str]]:
    """Seconds of a step, and the share of each part."""
    data = BUILD / "perf.data"
    data.parent.mkdir(parents=True, exist_ok=True)
    command, environment = [sys.executable, __file__, name], {**ENVIRONMENT, "PYDART2_SOLVER": "fast"}
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env=environment) as child:
        assert child.stdout is not None
        child.stdout.readline()
        record = ["perf", "record", "-q", "-e", "cpu-clock", "-F", str(HERTZ), "-o", str(data), "-p", str(child.pid)]
        subprocess.run([*record, "--", "sleep", str(SECONDS)], check=True)
        child.kill()
        seconds = float(child.stdout.read().split()[-1])
    report = ["perf", "report", "-i", str(data), "--stdio", "-q", "--no-children", "-F", "overhead,dso,sym", "-t", "|"]
    printed = subprocess.run(report, check=True, capture_output=True, text=True).stdout
    shares: Counter[str] = Counter()
    for line in printed.splitlines():
        if line.count("|") >= 2:
            share, library, function = (cell.strip() for cell in line.split("|", 2))
            shares[part_of(library, function[4:], room_of)] += float(share.rstrip("%")) / 100.0
    return seconds, shares


def rows_of(names: tuple[str, ...], room_of: dict[str, str]) -> list[list[object]]:
    """A row of each: the time, and of that the parts."""
    rows: list[list[object]] = []
    for name in names:
        seconds, shares = profile(name, room_of)
        rows.append([name, f"{seconds * 1e6:.3g}", *(f"{seconds * shares[part] * 1e6:.3g}" for part in columns())])
    return rows


def columns() -> list[str]:
    """The parts, in the order of the table."""
    return [*(part for part, _, _ in PARTS), "other"]


def main() -> None:
    """Two tables."""
    print("## Where the time goes\n")
    if shutil.which("perf") is None:
        print("Not measured: there is no `perf` (Debian's linux-perf).")
        return
    room_of = rooms()
    print(f"µs of a step with the fast solver, and of its parts, by samples of {SECONDS:.0f} s.\n")
    print(table(["scene", "step", *columns()], rows_of(SCENES, room_of)))
    print(
        "\nContacts are found by the engine's libraries, and the LCP is solved by its algorithm, in its order of\n"
        "operations: the states have its bits. Its objects: soft bodies' points, the flags that say what is out of\n"
        "date, what it asks of every shape in a step."
    )
    print(
        "\nAtlas apart without contact, with the native detector: of a robot and step, of its snapshot, of its copy.\n"
    )
    print(table(["robots", "µs", *columns()], rows_of(MANY, room_of)))
    print(
        "\nThe dynamics of a robot are the same in each row: what they take more of many is the wait for memory\n"
        "that no longer fits into the caches (Many robots). A snapshot puts every shape into FCL's tree again,\n"
        "and a copy makes the engine's objects, one by one."
    )
    print("\nThe limp human after 1.5 s, when it lies; the rows of `iterative` are also swept.\n")
    print(table(["human", "µs", *columns()], rows_of(tuple(HUMANS), room_of)))
    print(
        "\nIn the air the dynamics need one articulated inertia, with implicit damping. On the floor the engine's\n"
        "impulses need the one without it, too, and go through the tree once more, as do the sweeps' rows."
    )


if __name__ == "__main__":
    if len(sys.argv) > 1:
        play(sys.argv[1])
    else:
        main()
