"""Calls the whole public API with hostile arguments: every failure is a documented exception, and the process lives.

    python tests/crash/fuzz_api.py 1000000 [FIRST]    a million calls, or what an hour takes

Hypothesis draws the calls, four hundred to a world. After them a world that nobody touched steps as it always did.
"""

from __future__ import annotations

import contextlib
import inspect
import io
import itertools
import logging
import math
import os
import pickle
import re
import subprocess
import sys
import tempfile
import time
import warnings
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

if __name__ == "__main__":
    sys.path.insert(0, str(Path(__file__).parents[1]))

from hypothesis import HealthCheck, Phase, given, seed, settings
from hypothesis import strategies as st

import pydart2
from conformance.models import write_zoo
from oracle.models import dart_data
from pydart2 import sensors
from pydart2.flat import api as flat_api

#: What the documentation promises; anything else is a bug.
DOCUMENTED = (
    pydart2.PydartError,
    ValueError,
    TypeError,
    IndexError,
    KeyError,
    AttributeError,
    OverflowError,
    OSError,
    pickle.PicklingError,  # pickle's own, of a world whose controller is a lambda
)
CALLS_PER_WORLD = 400
MOST_SECONDS = 10.0  # of the processor for one call
MOST_SECONDS_IN_ALL = 3600.0
#: The processes import the same package.
ENVIRONMENT = {**os.environ, "PYTHONPATH": str(Path(pydart2.__file__).parents[1])}

#: Not called: they end other worlds, run as long as they are told to, or need a window.
LEFT_OUT = {"render", "render_with_color", "render_with_ri", "build", "step_until"}

NUMBERS = [0, 1, -1, 2, 0.5, -0.0, 1e-300, 1e300, math.nan, math.inf, -math.inf, 10**30, -(10**30), 2**31, 2**63, True]
VECTORS = [
    np.array(values)
    for values in ([], [1.0], [1.0, 2, 3], [math.nan] * 3, [math.inf] * 6, [0.1] * 6, [1e200] * 6, [0, 0, 1])
]
ODD = [
    None,
    "",
    "x",
    "h_pelvis",
    "j_thigh_left_z",
    "\0",
    "é" * 300,
    b"x",
    [],
    {},
    (),
    [1, "a"],
    [[1, 2], [3]],
    object(),
    3 + 4j,
]
ODD += [
    np.eye(3),
    np.eye(4),
    np.full((4, 4), math.nan),
    np.zeros((0, 3)),
    np.zeros((2, 2, 2)),
    np.arange(6),
    "<robot/>",
]
ODD += [
    slice(None),
    lambda *_: None,
    np.float32(0.1),
    np.int64(-1),
    np.array("text"),
    "./data/skel/cubes.skel",
    "../..",
]
VALUES: list[Any] = [*NUMBERS, *VECTORS, *ODD]


def fresh_worlds() -> list[pydart2.World]:
    """Worlds with all kinds of things in them: a person, each joint and shape, boxes that touch, soft bodies."""
    with tempfile.TemporaryDirectory() as folder:
        zoo = pydart2.World(0.001, write_zoo(Path(folder)), safe=False)
    worlds = [zoo, pydart2.World(0.001, dart_data() / "skel" / "fullbody1.skel", safe=False)]
    worlds += [pydart2.World(0.001, f"skel/{name}.skel") for name in ("cubes", "shapes", "softBodies")]
    worlds.append(built_world())
    for world in worlds:
        world.check_collision()
    return worlds


def built_world() -> pydart2.World:
    """A world built in code: with constraints, targets, sleepers and a soft body, and the iterative solver."""
    world = pydart2.World(0.001)
    world.add_ground()
    arm = world.add_empty_skeleton("arm")
    upper = arm.add_body("upper", joint="revolute", position=[0, 1, 0])
    upper.add_box([0.1, 0.3, 0.1])
    arm.add_body("lower", upper, joint="revolute", position=[0, 0.3, 0]).add_capsule(0.05, 0.2)
    box = world.add_box([0.1, 0.1, 0.1], position=[1, 0.05, 0])
    world.add_soft_box([0.2, 0.2, 0.2], 0.5, [-1, 0.1, 0])
    pydart2.constraints.DistanceConstraint(upper, box.bodynodes[0], [0, 1, 0], [1, 0, 0], rope=True).add_to_world(world)
    pydart2.constraints.RevoluteJointConstraint(upper, None, [0, 1, 0], [0, 0, 1]).add_to_world(world)
    arm.set_targets([0.1, 0.2], kp=10.0, kd=1.0)
    world.set_constraint_solver("iterative")
    world.set_sleeping()
    return world


def things_of(world: pydart2.World) -> list[Any]:
    """The objects whose methods are called."""
    found: list[Any] = [world, world.recording, world.collision_result, world.collision_filter]
    for skel in world.skeletons:
        found += [skel, *skel.dofs[::4], *skel.joints, *skel.markers[:1]]
        for body in skel.bodynodes[::2]:
            found += [body, *body.shapenodes, *(node.shape for node in body.shapenodes)]
    found += [*world.collision_result.contacts[:1], *world.constraints, world.contacts, world.snapshot()]
    if len(world.constraints) > 1:  # a built world
        arm, ground = world.skeletons[1], world.skeletons[0]
        frame = pydart2.SimpleFrame(arm.bodynodes[0])
        found += [frame, sensors.IMU(frame), sensors.ForceTorque(arm.joints[1]), sensors.JointEncoder(arm.dofs)]
        found += [sensors.Lidar(frame, np.eye(3)), sensors.Touch(ground.bodynodes[0])]
        found += [world.distance(arm, ground), world.raycast([0, 5, 0], [0, -1, 0]), world.recording.run]
    return [thing for thing in found if thing is not None]


def things_of_batch() -> list[Any]:
    """A batch, and one of its worlds, which the calls may destroy or make unlike the others."""
    batch = pydart2.Batch(pydart2.World(0.001, "skel/cubes.skel"), 2, threads=2)
    world = batch.worlds[1]
    return [batch, batch, world, world.skeletons[1]]


def members(thing: Any) -> list[tuple[str, str]]:
    """What can be done with an object: ("call", method), ("get" or "set", property)."""
    found = []
    for name in dir(type(thing)):
        member = inspect.getattr_static(type(thing), name)
        if name.startswith("_") or name in LEFT_OUT:
            continue
        if isinstance(member, property):
            found.append(("get", name))
            if member.fset is not None:
                found.append(("set", name))
        elif callable(member):
            found.append(("call", name))
    return found


def bounded(name: str, arguments: list[Any]) -> list[Any]:
    """A number of steps that ends before tomorrow; all else as it is."""
    if name == "step":
        return [argument for argument in arguments if not isinstance(argument, int) or abs(argument) < 4]
    return arguments


def do(thing: Any, kind: str, name: str, arguments: list[Any]) -> None:
    """One call."""
    if kind == "get":
        getattr(thing, name)
    elif kind == "set":
        setattr(thing, name, arguments[0] if arguments else None)
    else:
        getattr(thing, name)(*bounded(name, arguments))


def flat_calls() -> list[tuple[str, Callable[..., Any]]]:
    """The flat functions, but those that end all worlds or make ever more of them."""
    return [(name, call) for name, call in flat_api.MEMBERS.items() if "__" in name and "render" not in name]


@dataclass
class Report:
    """What a run found."""

    calls: int = 0
    accepted: int = 0
    refused: int = 0
    troubles: list[str] = field(default_factory=list)


def example(draws: list[tuple[int, int, int, int, int]], tell: Callable[[str], None]) -> tuple[int, int, list[str]]:
    """Do some calls on fresh worlds; how many were accepted and refused, and what went wrong."""
    worlds = fresh_worlds()
    troubles: list[str] = []
    groups = [*map(things_of, worlds), things_of_batch()]
    flat = flat_calls()
    accepted = refused = 0
    for which, member, count, first, second in draws:
        arguments = [VALUES[i % len(VALUES)] for i in (first, second, first + second)][: count % 4]
        if which % 10 == 0:
            name, function = flat[member % len(flat)]
            world = worlds[which // 10 % len(worlds)]
            thing, kind = flat_api, "call"
            call = partial(function, *bounded(name[-4:], [world.id, *arguments]))
        else:
            things = groups[which // 10 % len(groups)]
            thing = things[which // 100 % len(things)]
            choices = members(thing)
            kind, name = choices[member % len(choices)]
            call = partial(do, thing, kind, name, arguments)
        text = f"{type(thing).__name__} {kind} {name} {arguments!r}".replace("\n", " ")[:300]
        tell(text)
        start = time.process_time()
        try:
            call()
            accepted += 1
        except DOCUMENTED:
            refused += 1
        except Exception as error:
            troubles.append(f"{text}: {error!r:.300}")
        if time.process_time() - start > MOST_SECONDS:
            troubles.append(f"{text}: took {time.process_time() - start:.1f} s of the processor")
    for world in worlds:
        with contextlib.suppress(*DOCUMENTED):
            world.reset()
    healthy = pydart2.World(0.001, "skel/cubes.skel")
    healthy.step(2)
    if not np.isfinite(healthy.x).all() or healthy.frame != 2:
        troubles.append("the next world does not step")
    return accepted, refused, troubles


def work(first: int, examples: int, log: io.TextIOBase) -> None:
    """Do some examples, in this process; `log` gets each call before it is made."""
    logging.disable(logging.CRITICAL)
    warnings.simplefilter("ignore")
    numbers = st.integers(0, 2**16 - 1)
    draws = st.lists(
        st.tuples(numbers, numbers, numbers, numbers, numbers), min_size=CALLS_PER_WORLD, max_size=CALLS_PER_WORLD
    )

    def tell(text: str) -> None:
        log.seek(0)
        log.truncate()
        log.write(text)
        log.flush()

    @seed(first)
    @settings(
        max_examples=examples,
        deadline=None,
        database=None,
        phases=[Phase.generate],
        suppress_health_check=list(HealthCheck),
    )
    @given(draws)
    def calls(drawn: list[tuple[int, int, int, int, int]]) -> None:
        accepted, refused, troubles = example(drawn, tell)
        print(accepted, refused, flush=True)
        print(*(f"TROUBLE {trouble}" for trouble in troubles), sep="\n", end="\n" * bool(troubles), flush=True)

    calls()


def batches(calls: int, first: int) -> Iterator[tuple[int, int]]:
    """Seeds and numbers of examples of the processes of a run."""
    for number in itertools.count(first):
        if calls <= 0:
            return
        examples = min(50, -(-calls // CALLS_PER_WORLD))
        yield number, examples
        calls -= examples * CALLS_PER_WORLD


def run(calls: int, first: int) -> Report:
    """Make calls in other processes, an hour long at most, and say what came of them."""
    report, end = Report(), time.monotonic() + MOST_SECONDS_IN_ALL
    log = Path(__file__).parents[2] / "build" / f"fuzz-{first}.log"
    log.parent.mkdir(exist_ok=True)
    for number, examples in itertools.takewhile(lambda _: time.monotonic() < end, batches(calls, first)):
        command = [sys.executable, str(Path(__file__).resolve()), "--work", str(number), str(examples), str(log)]
        with tempfile.TemporaryDirectory() as folder:  # for the files that calls write
            done = subprocess.run(
                command, capture_output=True, text=True, errors="replace", env=ENVIRONMENT, cwd=folder
            )
        for line in done.stdout.splitlines():
            if line.startswith("TROUBLE "):
                report.troubles.append(f"seed {number}: {line[8:]}")
            elif re.fullmatch(r"\d+ \d+", line):
                accepted, refused = map(int, line.split())
                report.accepted, report.refused = report.accepted + accepted, report.refused + refused
        if done.returncode != 0:
            report.troubles.append(
                f"seed {number}, code {done.returncode}, at {log.read_text(errors='replace')}\n{done.stderr[-1200:]}"
            )
    report.calls = report.accepted + report.refused
    return report


def main() -> None:
    """Make as many calls as asked for; exit code 1 if there was trouble."""
    found = run(int(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 0)
    print(f"{found.calls} calls: {found.accepted} accepted, {found.refused} refused, {len(found.troubles)} troubles")
    print(*found.troubles, sep="\n")
    sys.exit(bool(found.troubles))


if __name__ == "__main__":
    if sys.argv[1] == "--work":
        with open(sys.argv[4], "w") as opened:
            work(int(sys.argv[2]), int(sys.argv[3]), opened)
    else:
        main()
