"""What people type who come from MuJoCo, PyBullet or dartpy, or who mistype, is answered by what to type here."""

from __future__ import annotations

import logging
import re

import numpy as np
import pytest

import pydart2
from pydart2.habits import ELSEWHERE, snake

# What is typed, what it raises, and what its sentence has.
MISTAKES = [
    # from MuJoCo
    ("robot.qpos", AttributeError, "Skeleton has no 'qpos'; here that is skel.q"),
    ("robot.ctrl", AttributeError, "skel.tau, or skel.set_targets()"),
    ("robot.nv", AttributeError, "skel.ndofs"),
    ("robot.body('l_hand').xpos", AttributeError, "BodyNode has no 'xpos'; here that is body.T[:3, 3]"),
    ("pydart2.MjModel.from_xml_path('a.xml')", AttributeError, "pydart2.World(dt, path)"),
    # from PyBullet
    ("pydart2.connect(pydart2.DIRECT)", AttributeError, "pydart2.World(dt); there is no server"),
    ("world.loadURDF('a.urdf')", AttributeError, "World has no 'loadURDF'; here that is world.add_skeleton(path)"),
    ("world.stepSimulation()", AttributeError, "world.step()"),
    ("world.setGravity(0, 0, -10)", AttributeError, "world.set_gravity()"),
    ("robot.joint('l_arm_shx').position", AttributeError, "joint.dofs[0].position()"),
    ("robot.links", AttributeError, "skel.bodynodes"),
    # from dartpy
    ("world.addSkeleton(robot)", AttributeError, "world.add_skeleton()"),
    ("robot.getPositions()", AttributeError, "skel.positions()"),
    ("robot.getMassMatrix()", AttributeError, "skel.mass_matrix()"),
    ("robot.body('l_hand').getWorldTransform()", AttributeError, "body.world_transform()"),
    # from anywhere
    ("pydart2.World('./data/skel/cubes.skel')", TypeError, "the time step comes first, in s: World(0.001, './data"),
    ("pydart2.World(0.001, up=[0, 0, 1])", TypeError, "up is 'x', 'y' or 'z', not [0, 0, 1]"),
    ("world.step(0.5)", TypeError, "count must be an integer, got 0.5"),
    ("world.launch()", AttributeError, "pydart2.gui.viewer.launch(world)"),
    ("pydart2.render(world)", AttributeError, "pydart2.gui.render(world)"),
    ("world['drc']", KeyError, "did you mean 'drc_skeleton'?"),
    ("robot.body('lhand')", KeyError, "did you mean 'l_hand'?"),
    ("robot.q['l_arm_shz']", KeyError, "did you mean 'l_arm_shy'?"),
    ("robot.positoins()", AttributeError, "did you mean 'positions'?"),
    ("world.add_box([0.2, 0.2, 0.2], pos=[0, 0, 1])", TypeError, "no option 'pos'; did you mean 'position'?"),
    ("world.add_box(0.2)", ValueError, "the edges of a box are three numbers, got 0.2"),
    ("world.add_sphere([0.1])", TypeError, "lengths are numbers, in m, not [0.1]"),
    ("robot.set_targets('l_arm_shx', 1.0)", TypeError, "a dict, as {'l_arm_shx': 0.5}"),
    ("robot.set_targets({'l_arm_shx': 1.0})", ValueError, "has a target and no gains; give kp, kd or both"),
    ("pydart2.Batch(100, world)", TypeError, "Batch(world, 64)"),
    ("world.set_collision_detector('Bullet')", KeyError, "did you mean 'bullet'?"),
    ("pydart2.gui.render(world, camera='Front')", KeyError, "did you mean 'front'?"),
    ("pydart2.gui.render(world, 'a.png')", TypeError, "two whole numbers, as 640, 480"),
]


@pytest.fixture(scope="module")
def names() -> dict[str, object]:
    world = pydart2.World(0.001, up="z")
    return {"world": world, "robot": world.add_skeleton("./data/sdf/atlas/atlas_v3_no_head.sdf"), "pydart2": pydart2}


@pytest.mark.parametrize(("code", "kind", "sentence"), MISTAKES, ids=[code for code, _, _ in MISTAKES])
def test_a_mistake_is_answered(code: str, kind: type[Exception], sentence: str, names: dict[str, object]) -> None:
    with pytest.raises(kind) as error:
        eval(code, names)
    assert sentence in str(error.value)


def test_a_set_habit_is_a_warning(names: dict[str, object], caplog: pytest.LogCaptureFixture) -> None:
    robot = names["robot"]
    assert isinstance(robot, pydart2.Skeleton)
    with caplog.at_level(logging.WARNING, "pydart2"):
        robot.qvel = np.zeros(33)
        robot.qvel = np.ones(33)
    assert [record.getMessage() for record in caplog.records] == [
        "Skeleton has no 'qvel', which is now an attribute of your own; here that is skel.dq"
    ]


def test_what_the_answers_name_exists(names: dict[str, object]) -> None:
    """Each answer begins with code whose first attribute is there."""
    for cls, table in ELSEWHERE.items():
        for name, answer in table.items():
            assert name == snake(name), "the table is in snake case"
            owner, _, rest = answer.partition(".")
            thing = {"skel": "Skeleton", "world": "World", "body": "BodyNode", "joint": "Joint", "dof": "Dof"}.get(
                owner
            )
            match = re.match(r"\w+", rest)
            if match is None or (thing is None and owner != "pydart2"):
                assert answer.startswith("World("), answer
            elif match[0] not in ("dofs", "bodynodes", "skeletons", "collision_result", "world"):  # of instances
                assert hasattr(getattr(pydart2, thing) if thing else pydart2, match[0]), (cls, answer)


def test_what_is_not_there_stays_so(names: dict[str, object]) -> None:
    world = names["world"]
    assert not hasattr(world, "on_step_event") and getattr(world, "nothing_like_it", 3) == 3
    with pytest.raises(AttributeError, match=r"^World has no 'entirely_different'$"):
        world.entirely_different  # type: ignore[attr-defined]  # noqa: B018
