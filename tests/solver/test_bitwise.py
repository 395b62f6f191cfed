"""The fast constraint solver gives the bits of the engine's own: states, contact forces, constraint matrices.

So do the package's collision detectors and its fast dynamics, with which it steps here; the engine steps with its own.

In all models that the engine loads, with its four collision detectors, as the models are and with joints, contacts and
constraints of all kinds (scenes.hpp).  `make test-solver` runs the long form.
"""

from __future__ import annotations

import itertools
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

from .program import DETECTORS, VARIATIONS, Scene, check, compare_lcp, models

Scenes = list[tuple[str, str]]


def compare(files: list[Path], steps: int, scenes: list[Scenes]) -> list[Scene]:
    """Outcomes of all scenes, two models at a time; fails if one differs."""
    with ThreadPoolExecutor(2) as pool:
        outcomes = list(pool.map(lambda file, some: check(file, steps, some), files, scenes))
    wrong = [
        f"{file.name}: {scene}"
        for file, some in zip(files, outcomes)
        for scene in some
        if scene.result not in ("equal", "refused", "engine", "varies") or scene.difference != 0.0
    ]
    assert not wrong, "\n".join(wrong)
    for file, some in zip(files, outcomes):
        for scene in some:
            if scene.result in ("engine", "varies"):
                print(f"{file.name}, {scene[:2]}: equal until step {scene.steps}, then {scene.result} (check.cpp)")
    return [scene for some in outcomes for scene in some]


def test_every_model() -> None:
    """A few steps, with three of the twenty pairs of detector and variation for each model in turn."""
    files = models(".skel", ".urdf", ".sdf", ".vsk")
    pairs = itertools.cycle(itertools.product(VARIATIONS, DETECTORS))
    scenes = [[(detector, variation) for variation, detector in itertools.islice(pairs, 3)] for _ in files]
    outcomes = compare(files, 10, scenes)
    equal = [scene for scene in outcomes if scene.result == "equal"]
    assert len(equal) > 0.85 * len(outcomes)
    pairs_seen = Counter((scene.detector, scene.variation) for scene in equal)
    assert len(pairs_seen) == 20
    assert min(pairs_seen.values()) >= 10
    assert sum(scene.contacts for scene in equal) > 5_000
    assert max(scene.rows for scene in equal) > 100
    assert sum(scene.skeletons > 0 for scene in equal) > 0.95 * len(equal)


def test_bodies_at_rest_on_each_other() -> None:
    """Many steps with many contacts, among them skeletons that two groups of constraints share."""
    names = {"cubes.skel", "softBodies.skel", "fullbody1.skel"}
    files = [file for file in models(".skel") if file.name in names and "data" in file.parts]
    scenes: Scenes = [
        ("bullet", "pile"),
        ("dart", "pile"),
        ("fcl", "joined"),
        ("fcl", "plain"),
        ("ode", "joined"),
        ("dart", "surface"),
    ]
    outcomes = compare(files, 200, [scenes] * len(files))
    assert {scene.result for scene in outcomes} == {"equal"}
    assert min(scene.contacts for scene in outcomes if scene.variation == "pile") > 1_000


def test_numbers_that_grow_until_they_are_nan() -> None:
    """Redundant constraints throw a chain apart; the engine ends the process in the step after its first NaN."""
    file = next(file for file in models(".skel") if file.name == "chain.skel" and "data" in file.parts)
    outcomes = compare([file], 1000, [[(detector, "joined") for detector in DETECTORS]])
    assert {scene.result for scene in outcomes} == {"engine"}
    assert min(scene.steps for scene in outcomes) > 100


def test_complementarity_problems() -> None:
    """Random ones, also those that the engine's solver gives up."""
    outcomes = compare_lcp(10_000)
    assert outcomes["different"] == 0
    assert outcomes["equal"] > 9_500
    assert outcomes["given-up"] > 10


@pytest.mark.solver
@pytest.mark.parametrize("file", models(".skel", ".urdf", ".sdf", ".vsk", ".xml", ".world"), ids=lambda file: file.name)
def test_thousand_steps(file: Path) -> None:
    """As the model is with each detector, and each variation with one of them."""
    scenes: Scenes = [(detector, "plain") for detector in DETECTORS]
    first = sum(file.name.encode())
    scenes += [(DETECTORS[(first + i) % len(DETECTORS)], name) for i, name in enumerate(VARIATIONS[1:])]
    compare([file] * len(scenes), 1000, [[scene] for scene in scenes])
