"""The questions, asked of any binding: `play(binding)` answers the one on the command line, all at once or one by one.

A binding has ``load(scene)``, which returns an object with the calls that are measured: world-wide ``step``,
``states``, ``set_states``, ``contacts`` (points and forces, as numbers or in ``contact_objects``); of the last skeleton
``q dq M c J T C``, ``set_q``, ``set_tau``, ``num_dofs``.
"""

from __future__ import annotations

import ctypes
import json
import os
import sys
from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
from clock import once, per_call

Answers = dict[str, Callable[[], float]]  # seconds


def step(model: Any, scene: dict[str, Any]) -> dict[str, float]:
    """Seconds of a step, and how many contacts there are after the last."""
    start, figures = model.states(), {}
    loop = range(scene["steps"])

    def steps() -> None:
        for _ in loop:
            model.step()

    for name, prepare in model.variants.items():
        prepare()
        figures[name] = once(steps, before=lambda: model.set_states(start)) / len(loop)
    figures["contacts"] = len(model.contacts())
    return figures


READS = ("q", "dq", "M", "c", "J", "T", "C", "contacts", "contact_objects")


def access(model: Any, scene: dict[str, Any]) -> Answers:
    """Reading with nothing changed, writing, and reading just after q changed."""
    model.step()
    poses = [model.q(), model.q() + 1e-3]
    tau = np.zeros(model.num_dofs())

    def after_q(call: Any) -> float:
        """Seconds of writing q and the call."""

        def calls() -> None:
            for q in poses:
                model.set_q(q)
                call()

        return per_call(calls) / 2

    def only_after_q(call: Any) -> float:
        return after_q(call) - after_q(lambda: None)

    answers = {name: partial(per_call, getattr(model, name)) for name in READS}
    answers["q ="] = partial(after_q, lambda: None)
    answers["tau ="] = partial(per_call, lambda: model.set_tau(tau))
    answers |= {f"{name} after q =": partial(only_after_q, getattr(model, name)) for name in READS[2:-2]}
    return answers


def control(model: Any, scene: dict[str, Any]) -> Answers:
    """One step under PD and under stable PD control (Tan, Liu, Turk 2011), as a user would write them."""
    n, h, start = model.num_dofs(), scene["dt"], model.states()
    target = np.array(model.q())
    joints = np.repeat([0.0, 1.0], [6, n - 6])  # without the free root
    soft, light = 40.0 * joints, 0.5 * joints  # with more, the light feet blow up
    stiffness, damping = 400.0 * joints, 40.0 * joints
    implicit = h * np.diag(damping)

    def pd() -> None:
        model.set_tau(-soft * (model.q() - target) - light * model.dq())
        model.step()

    def stable_pd() -> None:
        dq = model.dq()
        p, d = -stiffness * (model.q() + h * dq - target), -damping * dq
        ddq = np.linalg.solve(model.M() + implicit, p + d - model.c())
        model.set_tau(p + d - h * damping * ddq)
        model.step()

    def run(loop: Any) -> float:
        steps = range(scene["steps"])
        return once(lambda: [loop() for _ in steps], lambda: model.set_states(start), repeats=1) / len(steps)

    return {"PD": partial(run, pd), "stable PD": partial(run, stable_pd)}


def states(model: Any, scene: dict[str, Any]) -> list[str]:
    """The states after 1,000 steps, to the last bit."""
    for _ in range(1000):
        model.step()
    return [number.hex() for number in np.asarray(model.states()).tolist()]


def resident() -> int:
    """Bytes of this process in memory, without what has been freed and could hide what comes next."""
    ctypes.CDLL(None).malloc_trim(0)
    with open("/proc/self/statm") as statm:
        return int(statm.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def load(binding: Any, scene: dict[str, Any]) -> dict[str, float]:
    """Seconds of loading the scene, and bytes of each further world."""
    keep = [binding(scene)]
    seconds = once(lambda: keep.append(binding(scene)), lambda: None)
    before, count = resident(), 40
    keep += [binding(scene) for _ in range(count)]
    return {"seconds": seconds, "bytes": (resident() - before) / count}


def talk(answers: Answers) -> None:
    """Tell the names of the figures, then those that are asked for, as often as they are."""
    print("answer", json.dumps(list(answers)), flush=True)
    for line in sys.stdin:
        print("answer", answers[line.strip()](), flush=True)


def play(binding: Any) -> None:
    """Answer the question on the command line: QUESTION SCENE."""
    question, scene = sys.argv[1], json.loads(sys.argv[2])
    if question == "load":
        print(json.dumps(load(binding, scene)))
        return
    model = binding(scene)
    for _ in range(scene["warm"]):
        model.step()
    if question in ("access", "control"):
        talk({"access": access, "control": control}[question](model, scene))
    else:
        print(json.dumps({"step": step, "states": states}[question](model, scene)))
