"""How long a load may take, what it waits for, and how long long chains take."""

from __future__ import annotations

import math
import threading
import time

import numpy as np
import pytest

from pydart2 import LoadError, World

SLOW_SECONDS = 0.02


def long_chain(links: int) -> str:
    inertia = '<inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/>'
    joint = '<parent link="{0}"/><child link="{1}"/><origin xyz="0 0 0.1"/><axis xyz="1 0 0"/>'
    bodies = [f'<link name="{i}"><inertial><mass value="1"/>{inertia}</inertial></link>' for i in range(links)]
    joints = [f'<joint name="j{i}" type="continuous">{joint.format(i, i + 1)}</joint>' for i in range(links - 1)]
    return f'<robot name="chain">{"".join(bodies + joints)}</robot>'


def long_chain_world(links: int, detector: str) -> str:
    """The same as a SKEL world."""
    body = '<body name="b{0}"><transformation>0 0 {0} 0 0 0</transformation><inertia><mass>1</mass></inertia></body>'
    joint = '<joint type="revolute" name="j{0}"><parent>{1}</parent><child>b{0}</child>{2}</joint>'
    axis = "<axis><xyz>1 0 0</xyz></axis>"
    bodies = "".join(body.format(i) for i in range(links))
    joints = "".join(joint.format(i, f"b{i - 1}" if i else "world", axis) for i in range(links))
    physics = f"<physics><gravity>0 0 -1</gravity><collision_detector>{detector}</collision_detector></physics>"
    return f'<skel version="1.0"><world name="w">{physics}<skeleton name="s">{bodies}{joints}</skeleton></world></skel>'


def test_chains_of_very_many_links() -> None:
    """The engine makes its matrices anew for each link, so that 2,000 took 64 times as long as 500; here they are made
    once. How long both take depends on the machine: the bars are for the trial and for the reading each."""
    took = {}
    for links, seconds in ((500, 2.0), (2000, 10.0)):
        world = World(0.001)
        start = time.process_time()
        chain = world.add_skeleton(long_chain(links), safe=True, load_seconds=seconds)
        took[links] = time.process_time() - start
        assert took[links] < seconds
        assert chain.ndofs == 6 + links - 1 and chain.m == pytest.approx(links)
        assert chain.C[2] == pytest.approx(0.05 * (links - 1))
    assert took[2000] < 25.0 * took[500]
    short = world.add_skeleton(long_chain(40), safe=False)
    np.testing.assert_allclose(short.M[3:6, 3:6], 40.0 * np.eye(3), atol=1e-9)


@pytest.mark.parametrize(("safe", "said"), [(True, "0.2 s"), (False, "0.02 s of processor time")])
def test_what_takes_longer_says_how_to_wait(safe: bool, said: str) -> None:
    """The trial ends by the clock too, at ten times the seconds."""
    text = long_chain(2000).replace("chain", "slow", 1)
    world = World(0.001)
    with pytest.raises(LoadError, match=f"does not finish it in {said}; load_seconds= waits longer"):
        world.add_skeleton(text, safe=safe, load_seconds=SLOW_SECONDS)
    assert world.num_skeletons() == 0
    assert world.add_skeleton(text, safe=safe, load_seconds=1e5).m > 999.0


def test_a_world_and_several_skeletons_take_it() -> None:
    text = long_chain_world(1000, "dart")
    for load in (
        lambda **options: World(0.001, text, safe=False, **options).skeletons,
        lambda **options: World(0.001).add_skeletons(text, safe=False, **options),
    ):
        with pytest.raises(LoadError, match="load_seconds= waits longer"):
            load(load_seconds=SLOW_SECONDS)
        assert [skel.ndofs for skel in load()] == [1000]


@pytest.mark.parametrize("wrong", [0.0, -1.0, math.nan, math.inf, "2", [1.0]])
def test_no_time(wrong: object) -> None:
    with pytest.raises(ValueError, match=r"load_seconds must be above 0 and at most 100000, got"):
        World(0.001).add_skeleton("skel/cubes.skel", load_seconds=wrong)  # type: ignore[arg-type]


def test_ode_is_free_while_a_file_that_asks_for_it_is_read() -> None:
    """Who changes a detector waits for ODE with the interpreter's lock: nothing else would go on meanwhile."""
    text = long_chain_world(1500, "ode")
    read: list[World] = []
    thread = threading.Thread(target=lambda: read.append(World(0.001, text, safe=False)))
    other = World(0.001, "skel/cubes.skel")
    longest, start = 0.0, time.monotonic()
    thread.start()
    while thread.is_alive():
        before = time.monotonic()
        other.set_collision_detector("ode")
        other.set_collision_detector("dart")
        longest = max(longest, time.monotonic() - before)
    thread.join()
    assert longest < 0.3 * (time.monotonic() - start)
    assert read[0].collision_detector_string() == "ODE_COLLISION_DETECTOR"
    other.set_collision_detector("ode")
    other.step(3)
    read[0].step()
