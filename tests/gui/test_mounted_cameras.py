"""Cameras that worlds have by name: MuJoCo, which has the same modes, is the judge of where they are."""

from __future__ import annotations

import gc
import logging
import pickle
from pathlib import Path
from typing import Any

import mujoco
import numpy as np
import pytest
from PIL import Image

import pydart2
from gui.conftest import MakeWindow
from pydart2.gui import MountedCamera
from pydart2.gui.camera import as_camera
from pydart2.poses import pose

ROBOT = """<mujoco><worldbody><geom type="plane" size="5 5 .1"/>
<camera name="still" pos="3 0 2" xyaxes="0 1 0 -.5 0 1" fovy="30"/><camera pos="0 0 9"/>
<body name="torso" pos="0 0 1.2" euler="0 10 0"><joint name="x" type="slide" axis="1 0 0"/><joint axis="0 1 0"/>
<geom type="capsule" size=".05 .2" euler="0 30 0"/>
<camera name="track" mode="track" pos="0 -3 0.3" xyaxes="1 0 0 0 0 1"/>
<camera name="com" mode="trackcom" pos="0 -3 0.3" xyaxes="1 0 0 0 0 1"/>
<camera name="at" mode="targetbody" target="thigh" pos="0 -3 0.3"/>
<camera name="atcom" mode="targetbodycom" target="torso" pos="0.2 -3 0.3"/>
<body name="thigh" pos="0 0 -.2"><joint axis="0 1 0"/><geom type="capsule" fromto="0 0 0 .1 0 -.4" size=".04" mass="2"/>
<camera name="eye" pos=".1 0 0" euler="0 90 0"/></body></body>
<body name="post" pos="1 1 1" euler="20 0 0"><camera name="post" pos="1 2 3"/>
<camera name="post track" mode="track" pos="1 2 3"/><camera name="post at" mode="targetbody" target="thigh"/></body>
</worldbody></mujoco>"""


def test_they_are_where_mujoco_has_them() -> None:
    world, model = pydart2.World(0.002, ROBOT), mujoco.MjModel.from_xml_string(ROBOT)
    data = mujoco.MjData(model)
    assert len(world.cameras) == model.ncam == 10 and "camera1" in world.cameras
    assert world.cameras["still"].fov == pytest.approx(np.radians(30.0))
    world.skeletons[-1].q = data.qpos[:] = [0.5, 0.3, -0.7]
    mujoco.mj_forward(model, data)
    for copy in (world, world.clone(), pickle.loads(pickle.dumps(world))):
        for i, camera in enumerate(copy.cameras.values()):
            assert camera.body is None or camera.body.skeleton.world is copy
            np.testing.assert_allclose(camera.eye()[:3, 3], data.cam_xpos[i], atol=1e-12)
            np.testing.assert_allclose(camera.eye()[:3, :3].ravel(), data.cam_xmat[i], atol=1e-12)


def test_robots_bring_theirs_and_take_them_along() -> None:
    world = pydart2.World(0.002, up="z")
    world.add_skeleton(ROBOT)
    assert list(world.cameras) == ["track", "com", "at", "atcom", "eye"]  # without those on what cannot move
    second = world.add_skeleton(ROBOT, position=[0.0, 5.0, 0.0])
    assert "torso (1)/eye" in world.cameras
    apart = world.cameras["torso (1)/eye"].eye() - world.cameras["eye"].eye()
    assert apart[:3, 3] == pytest.approx([0.0, 5.0, -1.2]) and apart[:3, :3] == pytest.approx(np.zeros((3, 3)), abs=0.2)
    world.remove_skeleton(second)
    assert list(world.cameras) == ["track", "com", "at", "atcom", "eye"]
    eye = world.cameras["eye"]
    world.skeletons[0].remove_body("thigh")
    with pytest.raises(pydart2.DestroyedError):
        eye.eye()


def test_what_has_no_counterpart_is_said(caplog: pytest.LogCaptureFixture) -> None:
    with caplog.at_level(logging.WARNING, "pydart2"):
        text = ROBOT.replace('<camera pos="0 0 9"/>', '<camera mode="targetbody" target="post"/>')
        world = pydart2.World(0.002, text)
    assert "cameras that follow or look at what cannot move" in caplog.text
    assert len(world.cameras) == 9


def scene() -> pydart2.World:
    """A red box that falls past a camera that looks at it from x, and one that falls along with it."""
    world = pydart2.World(0.01, up="z")
    box = world.add_box((0.4, 0.4, 0.4), position=(0.0, 0.0, 2.0), color=(1.0, 0.0, 0.0)).bodynodes[0]
    along_x = pose([4.0, 0.0, 0.0], [[0, 0, 1], [1, 0, 0], [0, 1, 0]])
    world.cameras["beside"] = MountedCamera(box, along_x, mode="track")
    world.cameras["standing"] = MountedCamera(None, pose([0.0, 0.0, 2.0]) @ along_x, fov=1.0)
    world.cameras["turning"] = MountedCamera(
        None, pose([0.0, 0.0, 2.0]) @ along_x, fov=1.0, mode="targetbody", target=box
    )
    return world


def red(picture: Any) -> np.ndarray:
    """Middle of what is red, [row, column], from 0 to 1."""
    mask = picture[..., 0].astype(int) > 1.5 * picture[..., 1].astype(int) + 40
    assert mask.any()
    return (np.argwhere(mask).mean(axis=0) + 0.5) / mask.shape


def test_pictures_and_movies_by_name(tmp_path: Path) -> None:
    world = scene()
    world.step(40)  # 0.8 m
    for name, row in (("beside", 0.5), ("turning", 0.5), ("standing", 0.5 + 0.5 * 0.8 / 4.0 / np.tan(0.5))):
        where = red(pydart2.gui.render(world, 96, 96, camera=name))
        assert where == pytest.approx([row, 0.5], abs=0.02), name
    world.reset()
    pydart2.gui.record(world, tmp_path / "fall.webp", 0.4, 10, camera="beside", size=(64, 64))
    with Image.open(tmp_path / "fall.webp") as movie:
        movie.seek(movie.n_frames - 1)  # type: ignore[attr-defined]
        assert red(np.asarray(movie.convert("RGB"))) == pytest.approx([0.5, 0.5], abs=0.03)
    with pytest.raises(pydart2.NameNotFound, match="beside"):
        pydart2.gui.render(world, 16, 16, camera="besides")


def test_the_window_goes_along_and_the_mouse_moves_it_from_there(make_window: MakeWindow) -> None:
    world = scene()
    window = make_window(world)
    window.commands.first_look("beside")
    assert [action.text() for action in window.cameraGroup.actions()][-3:] == ["beside", "standing", "turning"]
    world.step(40)
    seen = as_camera(window.scene.tb)
    np.testing.assert_allclose(seen.pose, world.cameras["beside"].eye(), atol=1e-9)
    window.scene.tb.trans[0] += 0.3  # as the mouse does
    moved = as_camera(window.scene.tb).pose
    world.step(10)
    fallen = world.cameras["beside"].eye()[2, 3] - seen.pose[2, 3]
    assert fallen < -0.1
    np.testing.assert_allclose(as_camera(window.scene.tb).pose[:3, 3] - moved[:3, 3], [0, 0, fallen], atol=1e-9)
    window.commands.first_look("standing")
    assert as_camera(window.scene.tb).fov == 1.0
    window.commands.first_look("beside")
    world.remove_skeleton(world.skeletons[0])
    np.testing.assert_allclose(as_camera(window.scene.tb).pose[:3, 3] - moved[:3, 3], [0, 0, fallen], atol=1e-9)
    window.set_simulation(pydart2.World(0.001))
    assert [action.text() for action in window.cameraGroup.actions()] == ["Camera Y up", "Camera Z up"]
    gc.collect()


def test_what_is_no_camera() -> None:
    body = pydart2.World(0.001).add_sphere(0.1).bodynodes[0]
    for wrong, match in (
        ({"mode": "follow"}, "no mode 'follow'"),
        ({"mode": "track"}, "needs a body"),
        ({"mode": "targetbody"}, "needs a target"),
        ({"fov": 4.0}, "between 0 and pi"),
        ({"pose": np.eye(3)}, r"\(4, 4\)"),
    ):
        with pytest.raises(ValueError, match=match):
            MountedCamera(None, **{"pose": np.eye(4), **wrong})  # type: ignore[arg-type]
    above = MountedCamera(None, pose([0.0, 5.0, 0.0]), mode="targetbody", target=body)
    assert np.isfinite(above.eye()).all()  # straight above what it looks at
