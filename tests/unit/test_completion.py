"""What IPython completes after ``skel.body("``."""

from __future__ import annotations

import pytest
from IPython.core.completer import provisionalcompleter
from IPython.core.interactiveshell import InteractiveShell

import pydart2
from pydart2.utils.completion import names, register


@pytest.fixture(scope="module")
def namespace() -> dict[str, object]:
    world = pydart2.World(0.001, "./data/skel/chain.skel")
    return {"world": world, "skel": world.skeletons[0]}


@pytest.mark.parametrize(
    ("line", "typed", "found"),
    [
        ('skel.body("link 1', "link 1", ["link 1", "link 10"]),
        ("x = world.skeletons[-1].dof('joint 10_", "joint 10_", ["joint 10_x", "joint 10_y", "joint 10_z"]),
        ('world["skeleton 1"].joint("joint 10', "joint 10", ["joint 10"]),
        ('world.skeleton("', "", ["skeleton 1"]),
        ('skel.body("nothing', "nothing", []),
        ('nobody.body("l', "", []),
        ('skel.name("l', "", []),
        ('make_world().body("l', "", []),  # typing calls nothing
        ('skel.body("link 1").T', "", []),
    ],
)
def test_names(line: str, typed: str, found: list[str], namespace: dict[str, object]) -> None:
    assert names(line, namespace) == (typed, found)


def test_ipython_asks_it(namespace: dict[str, object]) -> None:
    shell = InteractiveShell.instance()
    try:
        register()
        shell.user_ns.update(namespace)
        line = 'skel.body("link 1'
        with provisionalcompleter():
            found = [completion.text for completion in shell.Completer.completions(line, len(line))]
        assert {"link 1", "link 10"} <= set(found)
    finally:
        InteractiveShell.clear_instance()
