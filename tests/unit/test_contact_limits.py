"""As many contacts as there are, and memory for no more than is wanted."""

from __future__ import annotations

import logging
import pickle

import pytest

import pydart2

SIDE = 20  # boxes along an edge: 400 boxes with four contacts and more


def box(name: str, size: str, place: str, joint: str) -> str:
    return f"""<skeleton name="{name}"><body name="{name}"><transformation>{place} 0 0 0</transformation>
      <inertia><mass>1</mass></inertia>
      <collision_shape><geometry><box><size>{size}</size></box></geometry></collision_shape></body>
      <joint type="{joint}" name="{name}"><parent>world</parent><child>{name}</child></joint></skeleton>"""


def boxes(count: int) -> pydart2.World:
    """Boxes of 0.2 m in a square, apart from each other, on a floor."""
    bodies = [box("floor", "40 0.2 40", "0 -0.1 0", "weld")]
    for i in range(count):
        bodies.append(box(f"b{i}", "0.2 0.2 0.2", f"{0.5 * (i % SIDE)} 0.0999 {0.5 * (i // SIDE)}", "free"))
    physics = "<physics><time_step>0.002</time_step><gravity>0 -9.81 0</gravity></physics>"
    world = pydart2.World(0.002, f'<skel version="1.0"><world name="w">{physics}{"".join(bodies)}</world></skel>')
    world.disable_recording()
    return world


@pytest.mark.parametrize("detector", range(4), ids=["dart", "fcl", "bullet", "ode"])
def test_no_box_sinks_where_there_are_more_than_a_thousand_contacts(detector: int) -> None:
    world = boxes(SIDE * SIDE)
    world.set_collision_detector(detector)
    world.step(25)
    assert world.collision_result.num_contacts() >= 4 * SIDE * SIDE
    lowest = min(skel.bodynodes[0].C[1] for skel in world.skeletons[1:])
    assert lowest > 0.0999 - 2e-4


def test_a_limit_is_a_setting_and_says_so_once(caplog: pytest.LogCaptureFixture) -> None:
    world = boxes(30)
    assert world.max_contacts is None
    pydart2.set_verbose(True)
    world.max_contacts = 50
    with caplog.at_level(logging.WARNING, "pydart2"):
        world.step(5)
    [record] = [r for r in caplog.records if "max_contacts" in r.getMessage()]
    assert "there are 50 contacts or more, and world.max_contacts is 50" in record.getMessage()
    assert world.collision_result.num_contacts() == 50
    for copy in (world.clone(), pickle.loads(pickle.dumps(world))):
        assert copy.max_contacts == 50
    world.max_contacts = None
    world.step()
    assert world.collision_result.num_contacts() >= 120


def test_a_group_too_large_for_an_exact_solver_is_named_once(caplog: pytest.LogCaptureFixture) -> None:
    """Ten boxes that touch have some three hundred rows, forty more than a thousand."""
    pydart2.set_verbose(True)
    world = pydart2.World(0.002, up="z")
    world.add_ground()
    world.set_collision_detector("native")
    for i in range(40):
        world.add_box([0.2, 0.2, 0.2], 1.0, position=[0.1999 * (i % 8), 0.1999 * (i // 8), 0.0999])
        if i == 9:
            with caplog.at_level(logging.WARNING, "pydart2"):
                world.step()
            assert caplog.records == []
    with caplog.at_level(logging.WARNING, "pydart2"):
        world.step()
        world.step()
    [record] = caplog.records
    assert "rows" in record.getMessage() and 'set_constraint_solver("iterative")' in record.getMessage()


@pytest.mark.parametrize("most", [0, -1, -7, 2**31])
def test_a_limit_is_positive(most: int) -> None:
    world = pydart2.World(0.001)
    with pytest.raises(ValueError, match="the number of contacts must be positive, or None for no limit"):
        world.max_contacts = most


@pytest.mark.parametrize("solver", ["fast", "dart"])
def test_equations_that_would_not_fit_are_refused(solver: str) -> None:
    world = pydart2.World(0.001, pydart2.data_path("skel/cubes.skel"))
    world.set_constraint_solver(solver)
    world.contact_memory_limit = 1000.0
    with pytest.raises(
        pydart2.SimulationError, match=r"have \d+ rows, whose matrix would take .* GB; world.contact_memory"
    ):
        world.step(1000)
    assert world.clone().contact_memory_limit == 1000.0
    world.contact_memory_limit = 1e9
    world.step(100)
    for limit in (0.0, -1.0, float("nan")):
        with pytest.raises(ValueError, match="contact memory limit"):
            world.contact_memory_limit = limit


def test_a_snapshot_of_before_there_were_such_settings_fits() -> None:
    """Settings that are as they always were leave the digest of the model as it was."""
    world = pydart2.World(0.001, pydart2.data_path("skel/cubes.skel"))
    before = world.snapshot().model
    world.max_contacts = 10
    assert world.snapshot().model != before
    world.max_contacts = None
    assert world.snapshot().model == before
