"""What people type who come from MuJoCo, PyBullet or dartpy, or who mistype, is answered by what to type here."""

from __future__ import annotations

import logging
import re

import numpy as np
import pytest

import pydart2
from pydart2 import sensors
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
    ("world.add_sphere([0.1])", TypeError, "a length must be a number, got [0.1]"),
    ("world.add_sphere(0.1, mass='light')", TypeError, "mass must be a number, got 'light'"),
    ("world.add_box('large')", TypeError, "the edges of a box must be numbers, got 'large'"),
    ("world.add_box([1, 1, 1], color='red')", TypeError, "a color must be numbers, got 'red'"),
    ("world.add_box([1, 1, 1], color=[1, 0])", ValueError, "a color is red, green and blue"),
    ("world.add_ground('here')", TypeError, "height must be a number, got 'here'"),
    ("world.add_skeleton(3)", TypeError, "a model is a path, a URI or the text of a file, got 3"),
    ("world.remove_skeleton(robot.body('l_hand'))", ValueError, "[BodyNode(15): l_hand] is not in"),
    ("world.restore(world.x)", TypeError, "a world is restored from what its snapshot() gave"),
    ("world.contacts_between(robot, 'l_hnd')", KeyError, "did you mean 'l_hand'?"),
    ("world.distance(robot, 3)", TypeError, "bodies are given as bodies, skeletons or their names, got 3"),
    ("world.raycast([0, 0, 1], 'down')", TypeError, "directions must be numbers, got 'down'"),
    ("world.linearize('small')", TypeError, "change must be a number, got 'small'"),
    ("world.recording.q(robot.body('l_hand').T)", IndexError, "no skeleton array"),
    ("robot.attach(None)", ValueError, "None is not a body of"),
    ("robot.impulse_response('lhand', [1, 0, 0])", KeyError, "did you mean 'l_hand'?"),
    ("robot.inverse_kinematics('l_hand')", TypeError, "targets are given by body"),
    ("robot.joint('l_arm_shx').set_mimic('l_arm_shz')", KeyError, "did you mean 'l_arm_shy'?"),
    ("robot.joint('l_arm_shx').command('l')", TypeError, "given by its index in the joint, not by 'l'"),
    ("robot.body('l_hand').relative_pose('r_hand')", TypeError, "a frame is a body, a SimpleFrame, or None"),
    ("robot.body('l_hand').relative_jacobian(None, 'r_hand')", TypeError, "a frame is a body, a SimpleFrame, or None"),
    ("robot.body('l_hand').expand_jacobian([1, 2])", ValueError, "a Jacobian needs shape (r, "),
    (
        "setattr(pydart2.Batch(world, 2), 'q', [0.0])",
        ValueError,
        "positions needs shape (2, 33), or (33,) for all worlds",
    ),
    ("sensors.Touch('l_hand')", TypeError, "a Touch is of a body, as robot.body(0), got 'l_hand'"),
    ("sensors.ForceTorque('l_arm_shx')", TypeError, "a ForceTorque sits in a joint, as robot.joint(0)"),
    ("sensors.JointEncoder(robot.dof('l_arm_shx'))", TypeError, "a JointEncoder is of a list of dofs, as robot.dofs"),
    ("sensors.IMU(robot.body('l_hand'), rate='often')", TypeError, "rate must be a number, got 'often'"),
    ("pydart2.SimpleFrame('l_hand')", TypeError, "a frame is a body, a SimpleFrame, or None for the world"),
    ("pydart2.SimpleFrame(pydart2.SimpleFrame())", TypeError, "is fixed in a body, or in the world, not in"),
    ("pydart2.SimpleFrame(translation='up')", TypeError, "a position must be numbers, got 'up'"),
    ("robot.add_body('tail', limits='wide')", TypeError, "limits must be numbers, got 'wide'"),
    ("robot.add_body('tail', joint=['ball'])", ValueError, "no joint ['ball']; there are ball, euler"),
    ("world.add_skeleton('atlas.urdf', name=3)", ValueError, "name must be a string that is not empty, got 3"),
    ("world.add_skeleton('atlas.urdf', packages='/opt')", TypeError, "packages are folders by name"),
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
    robot = world.add_skeleton("./data/sdf/atlas/atlas_v3_no_head.sdf")
    return {"world": world, "robot": robot, "pydart2": pydart2, "sensors": sensors}


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
