"""The window as scripts and hands use it. Runs on any of Qt's platforms; see test_environments.py."""

from __future__ import annotations

import gc
import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image
from PyQt5.QtCore import QPoint, Qt
from PyQt5.QtGui import QImage
from PyQt5.QtTest import QTest

import pydart2
from gui.conftest import MakeWindow
from gui.hands import drag, drag_on, drop, pixel_of, spin, wait_for
from pydart2.gui.camera import as_camera
from pydart2.gui.trackball import Trackball


class Talkative(pydart2.World):
    """A world that notes what the window calls."""

    def __init__(self) -> None:
        super().__init__(0.001, "./data/skel/cubes.skel")
        self.heard: list[tuple[Any, ...]] = []

    def on_step_event(self) -> None:
        self.heard.append(("step", self.frame))

    def on_key_press(self, key: str) -> None:
        self.heard.append(("key", key))

    def on_mouse_press(self, pos: Any) -> None:
        self.heard.append(("press", *pos))

    def on_mouse_move(self, p0: Any, p1: Any) -> None:
        self.heard.append(("move", *(p1 - p0)))

    def on_mouse_release(self) -> None:
        self.heard.append(("release",))

    def on_close(self) -> None:
        self.heard.append(("close",))

    def status(self) -> str:
        return "all is well"

    def name(self) -> str:
        return "talk"


def button(window: Any, action: Any) -> Any:
    return window.toolbar.widgetForAction(action)


def click(window: Any, action: Any) -> None:
    QTest.mouseClick(button(window, action), Qt.LeftButton)


def test_toolbar_steps_plays_and_resets(make_window: MakeWindow) -> None:
    world = Talkative()
    window = make_window(world)
    click(window, window.stepAction)
    assert (world.frame, world.heard) == (1, [("step", 0)])
    click(window, window.playAction)
    wait_for(lambda: world.frame > 20)
    click(window, window.playAction)
    played = world.frame
    assert [frame for _, frame in world.heard] == list(range(played))
    spin(0.1)
    assert world.frame == played
    assert window.rangeSlider.maximum() == window.rangeSlider.value() == played
    click(window, window.resetAction)
    assert (world.frame, world.t, window.rangeSlider.maximum()) == (0, 0.0, 0)


def test_playing_is_paced_by_the_clock_and_says_how_fast(make_window: MakeWindow, cubes: pydart2.World) -> None:
    cubes.dt = 0.005
    window = make_window(cubes, size=(500, 300))
    window.speedBox.setCurrentIndex(window.speedBox.findText("0.5×"))
    window.playAction.setChecked(True)
    spin(1.2)
    assert 0.2 < cubes.t < 0.7
    assert "× real time (asked: 0.5×)" in window.statusView.pace.text()
    QTest.keyClick(window, Qt.Key_Up, Qt.ControlModifier)
    assert window.runtime.pacer.speed == 1.0


def test_a_window_with_nothing_to_do_waits(make_window: MakeWindow, cubes: pydart2.World) -> None:
    window = make_window(cubes)
    window.speedBox.setCurrentIndex(0)  # a tenth of real time: steps of 1 ms are due every 10 ms
    window.playAction.setChecked(True)
    wait_for(lambda: window.idleTimer.interval() > 0)
    before = cubes.frame
    wait_for(lambda: cubes.frame > before)


def test_slider_scrubs_and_anim_replays(make_window: MakeWindow, cubes: pydart2.World) -> None:
    cubes.step(200)
    window = make_window(cubes)
    states = [cubes.recording.states(i) for i in (0, 77, 200)] if cubes.recording else []
    window.rangeSlider.setValue(77)
    assert (cubes.x == states[1]).all()
    assert window.statusView.frame.text() == "frame 77 of 200, 0.077 s"
    for key, frame in ((Qt.Key_Home, 0), (Qt.Key_Right, 1), (Qt.Key_Left, 0), (Qt.Key_End, 200)):
        QTest.keyClick(window, key)
        assert window.runtime.frame == window.rangeSlider.value() == frame
    click(window, window.animAction)
    assert window.runtime.frame == 0
    wait_for(lambda: not window.animAction.isChecked())
    assert window.runtime.frame == 200
    assert (cubes.frame, (cubes.x == states[2]).all()) == (200, True)


def test_callbacks_reach_the_simulation(make_window: MakeWindow) -> None:
    world = Talkative()
    window = make_window(world)
    QTest.keyClick(window, Qt.Key_G)
    QTest.keyClick(window, "1")
    drag(window.glwidget, (50, 60), (60, 65))
    assert world.heard[:3] == [("key", "G"), ("key", "1"), ("press", 50.0, 60.0)]
    moves = [entry[1:] for entry in world.heard if entry[0] == "move"]
    assert np.sum(moves, axis=0).tolist() == [10.0, 5.0]
    assert world.heard[-1] == ("release",)
    assert window.statusView.text.text() == "all is well"
    QTest.keyClick(window, Qt.Key_Escape)
    assert world.heard[-1] == ("close",)
    assert not window.isVisible()


def test_space_plays_and_is_not_given_to_the_simulation(make_window: MakeWindow) -> None:
    world = Talkative()
    window = make_window(world)
    QTest.keyClick(window, Qt.Key_Space)
    assert window.playAction.isChecked()
    QTest.keyClick(window, Qt.Key_Space)
    assert not window.playAction.isChecked()
    assert ("key", " ") not in world.heard


def test_every_callback_can_be_replaced(make_window: MakeWindow, cubes: pydart2.World) -> None:
    window = make_window(cubes)
    drawn: list[str] = []
    window.set_callback("render_with_ri", lambda ri: drawn.append("3-D"))
    window.set_callback("draw_with_ri", lambda ri: drawn.append("2-D"))
    window.glwidget.picture()
    assert {"3-D", "2-D"} <= set(drawn)
    assert window.callbacks_as_string() == "reset, step, render_with_ri, draw_with_ri, num_frames, set_frame"
    assert not window.has_callback("status")
    with pytest.raises(KeyError):
        window.callback("stop")
    window.init_callbacks()
    assert window.callback("draw_with_ri") is None


def test_drags_turn_zoom_and_move_the_camera(make_window: MakeWindow, cubes: pydart2.World) -> None:
    window = make_window(cubes)
    picture = window.glwidget
    trackball = window.scene.tb

    def change(modifiers: Any, start: Any = (300, 200), end: Any = (340, 220)) -> tuple[float, np.ndarray[Any, Any]]:
        before = trackball.view
        drag(picture, start, end, modifiers=modifiers)
        after = trackball.view
        return float(np.abs(after[:3, :3] - before[:3, :3]).max()), after[:3, 3] - before[:3, 3]

    turned, moved = change(Qt.NoModifier)
    assert turned > 0.01
    assert np.allclose(moved, 0.0, atol=1e-6)  # about the origin
    turned, moved = change(Qt.ShiftModifier)
    assert turned == 0.0
    assert moved[2] != 0.0 and moved[:2].tolist() == [0.0, 0.0]
    turned, moved = change(Qt.ControlModifier)
    pixel = 2.0 * -trackball.trans[2] * np.tan(np.pi / 8.0) / picture.height()
    assert (turned, moved[2]) == (0.0, 0.0)
    assert moved[:2] == pytest.approx([40 * pixel, -20 * pixel])
    picture.set_lock_camera()
    assert change(Qt.NoModifier)[0] == 0.0


def test_cameras(make_window: MakeWindow, cubes: pydart2.World, capsys: pytest.CaptureFixture[str]) -> None:
    window = make_window(cubes)
    assert [action.text() for action in window.cameraGroup.actions()] == ["Camera Y up", "Camera Z up"]
    window.add_camera(Trackball(trans=[0.0, 0.0, -9.0]), "Far")
    assert window.num_cameras() == 3
    window.cameraGroup.actions()[2].trigger()
    assert window.scene.tb.trans == [0.0, 0.0, -9.0]
    assert window.replace_camera(2, Trackball(trans=[0.0, 0.0, -8.0]))
    assert window.scene.tb.trans == [0.0, 0.0, -8.0]
    assert not window.replace_camera(7, Trackball())
    window.printCamAction.trigger()
    assert "Trackball(rot=[0.000, 0.000, 0.000, 1.000], \ntrans=[0.000, 0.000, -8.000])" in capsys.readouterr().out
    window.named_actions["next_camera"].trigger()
    assert window.scene.tb is window.scene.cameras[0]
    QTest.keyClick(window, Qt.Key_F3)
    camera = as_camera(window.scene.tb)
    for skel in cubes.skeletons[1:]:
        x, y, _, w = camera.projection(1.0) @ camera.view @ np.append(skel.C, 1.0)
        assert abs(x / w) < 1.0 and abs(y / w) < 1.0


def test_a_world_with_gravity_along_z_starts_with_z_up(make_window: MakeWindow, atlas: pydart2.Skeleton) -> None:
    window = make_window(atlas.world)
    assert window.scene.tb is window.scene.cameras[1]


@pytest.mark.parametrize("model", ["cubes", "fullbody1"])
def test_the_picture_is_the_headless_one_pixel_for_pixel(make_window: MakeWindow, model: str) -> None:
    world = pydart2.World(0.001, f"./data/skel/{model}.skel")
    world.step(30)
    window = make_window(world)
    shown = window.glwidget.picture()
    height, width = shown.shape[:2]
    assert (shown == pydart2.gui.render(world, width, height, camera=window.scene.tb)).all()


def test_pictures_that_move_are_drafts_without_a_graphics_card(make_window: MakeWindow, cubes: pydart2.World) -> None:
    window = make_window(cubes)
    window.commands.frame_all()
    picture = window.glwidget

    spin(0.1)
    still = picture.picture()
    assert not picture.is_draft and picture._target.samples == 4
    window.playAction.setChecked(True)
    wait_for(lambda: cubes.t > 0.1)
    assert picture.is_draft and picture._target.samples == 0
    with picture.current():
        assert picture.to_show() is picture._target  # one that was begun before
    assert (picture.picture() != still).any()
    assert picture._target.samples == 4  # a capture is as fine as ever
    window.playAction.setChecked(False)
    spin(0.1)
    paused = picture.grab().toImage().convertToFormat(QImage.Format_RGB888)
    rows = np.frombuffer(paused.constBits().asstring(paused.sizeInBytes()), np.uint8)
    rows = rows.reshape(paused.height(), paused.bytesPerLine())[:, : 3 * paused.width()]
    assert (rows.reshape(paused.height(), paused.width(), 3) == picture.picture()).all()


def test_no_other_window_is_deleted_in_the_middle_of_a_picture(make_window: MakeWindow, cubes: pydart2.World) -> None:
    """Windows are parts of cycles, and Qt lets go of the context that is current when it deletes one."""
    collecting: list[bool] = []
    cubes.render_with_ri = lambda ri: collecting.append(gc.isenabled())  # type: ignore[attr-defined]
    window = make_window(cubes)
    spin(0.05)
    window.glwidget.picture()
    pydart2.gui.render(cubes, 64, 48)
    assert len(collecting) >= 3 and not any(collecting)
    assert gc.isenabled()


def test_screenshot_has_the_true_size(make_window: MakeWindow, tmp_path: Path) -> None:
    window = make_window(Talkative())
    click(window, window.screenshotAction)
    path = tmp_path / "captures" / "talk_frame.0000.png"
    with Image.open(path) as image:
        assert image.format == "PNG"
        assert image.size == window.glwidget.pixels
        assert (np.asarray(image.convert("RGB")) == window.glwidget.picture()).all()
    assert window.glwidget.captureIndex == 1


def test_capture_movie_and_empty(make_window: MakeWindow, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    import av

    world = Talkative()
    window = make_window(world, size=(500, 300))
    window.set_capture_rate(20)
    window.captureAction.setChecked(True)
    window.playAction.setChecked(True)
    while world.frame < 100:
        spin(0.02)
    window.playAction.setChecked(False)
    count = len(list((tmp_path / "captures").glob("talk.*.png")))
    assert count == world.frame // 20
    click(window, window.movieAction)
    with av.open(str(tmp_path / "captures" / "talk.mp4")) as movie:
        stream = movie.streams.video[0]
        assert sum(1 for _ in movie.decode(stream)) == count
        assert stream.average_rate == 50  # real time: a picture every 20 steps of 1 ms
    folder = tmp_path / "captures"
    assert window.statusBar().currentMessage() == f"movie: {folder / 'talk.mp4'}"
    assert "capture folder" in window.emptyAction.toolTip()
    window.emptyAction.trigger()
    assert window.statusBar().currentMessage() == f"{count} pictures removed from {folder}"
    assert not list((tmp_path / "captures").glob("*.png"))
    click(window, window.movieAction)
    assert window.statusBar().currentMessage() == "No pictures for a movie: tick Capture and play first"
    with pytest.raises(ValueError, match="at least 1, not 0"):
        window.set_capture_rate(0)


def test_selection_goes_both_ways(make_window: MakeWindow, cubes: pydart2.World) -> None:
    window = make_window(cubes)
    window.commands.frame_all()
    picture, tree = window.glwidget, window.inspector.tree
    body = cubes.skeletons[2].bodynodes[0]
    QTest.mouseClick(picture, Qt.LeftButton, Qt.NoModifier, pixel_of(window, body.C))
    assert picture.overlays.selected is body
    assert tree.currentItem().text(0) == body.name
    assert window.inspector.sliders.skeleton is body.skel
    other = cubes.skeletons[3].bodynodes[0]
    before = picture.picture()
    tree.setCurrentItem(tree._items[other])
    assert picture.overlays.selected is other
    assert (picture.picture() != before).any()
    QTest.mouseClick(picture, Qt.LeftButton, Qt.NoModifier, QPoint(3, 3))
    assert picture.overlays.selected is None and tree.currentItem() is None


def test_sliders_pose_the_robot(make_window: MakeWindow, atlas: pydart2.Skeleton) -> None:
    window = make_window(atlas.world, size=(900, 900))
    sliders = window.inspector.sliders
    row = next(row for row in sliders.rows if row.dof.name == "l_leg_kny")
    low, high = row.dof.position_lower_limit(), row.dof.position_upper_limit()
    sliders.ensureWidgetVisible(row.slider)
    atlas.dq = np.ones(atlas.ndofs)
    row.slider.setValue(row.slider.maximum())
    assert row.dof.position() == pytest.approx(high)
    assert not atlas.dq.any()  # from rest
    row.box.setValue(low)
    assert row.dof.position() == pytest.approx(low, abs=1e-3)
    row.dof.set_position(0.5)
    window.refresh()
    assert row.box.value() == pytest.approx(0.5)
    assert row.slider.value() == round((0.5 - low) / (high - low) * row.slider.maximum())


def test_plots_hold_what_the_simulation_did(make_window: MakeWindow, cubes: pydart2.World) -> None:
    cubes.skeletons[1].q = [0.0, 0.0, 0.0, 0.0, 9.0, 0.0]  # free fall
    window = make_window(cubes, size=(900, 900))
    window.inspector.show_skeleton(cubes.skeletons[1])
    row = window.inspector.sliders.rows[4]
    QTest.mouseClick(row.plot, Qt.LeftButton)
    window.inspector.plots.box.setCurrentText("velocity")
    for _ in range(100):
        window.runtime.step()
    window.refresh()
    samples = np.array(window.inspector.plots.samples(row.dof))
    assert len(samples) == pytest.approx(20, abs=1)
    assert samples[:, 1] == pytest.approx(-9.81 * samples[:, 0], rel=1e-6)
    window.resetAction.trigger()
    window.runtime.step()
    assert [time for time, _ in window.inspector.plots.samples(row.dof)] == [0.0, cubes.t]
    QTest.mouseClick(row.plot, Qt.LeftButton)
    assert window.inspector.plots.dofs == []


def test_plots_of_a_recording_show_its_past_and_move_with_the_frame(
    make_window: MakeWindow, cubes: pydart2.World
) -> None:
    cubes.skeletons[1].q = [0.0, 0.0, 0.0, 0.0, 900.0, 0.0]
    cubes.recording.clear()
    cubes.step(12000)  # 12 s of free fall, before there is a window
    window = make_window(cubes, size=(900, 900))
    window.inspector.show_skeleton(cubes.skeletons[1])
    row, plots = window.inspector.sliders.rows[4], window.inspector.plots
    QTest.mouseClick(row.plot, Qt.LeftButton)
    for quantity, slope in (("position", None), ("velocity", -9.81)):
        plots.box.setCurrentText(quantity)
        samples = np.array(plots.samples(row.dof))
        assert (len(samples), samples[0, 0], samples[-1, 0]) == (2401, 0.0, pytest.approx(12.0))
        if slope is not None:
            assert samples[:, 1] == pytest.approx(slope * samples[:, 0], abs=1e-6)

    def shown() -> tuple[list[float], float]:
        window.refresh()
        return plots.plot.viewRange()[0], plots.marker.value()

    assert shown() == (pytest.approx([2.0, 12.0], abs=0.01), pytest.approx(12.0))
    assert not plots.marker.isVisible()
    window.rangeSlider.setValue(1000)
    assert shown() == (pytest.approx([0.0, 6.0], abs=0.01), pytest.approx(1.0))
    assert plots.marker.isVisible()
    window.animAction.setChecked(True)
    wait_for(lambda: shown()[1] > 1.05)
    assert len(plots.samples(row.dof)) == 2401  # a replay adds nothing
    window.animAction.setChecked(False)
    window.stepEvent()
    plots.box.setCurrentText("force")  # which is not recorded
    assert plots.samples(row.dof) == []


@pytest.mark.parametrize("world", ["cubes", "none"])
def test_the_inspector_folds_away_in_a_narrow_window(make_window: MakeWindow, world: str, request: Any) -> None:
    window = make_window(request.getfixturevalue("cubes") if world == "cubes" else None, size=(1280, 720))
    assert window.inspector.isVisible() == (world == "cubes")
    window.resize(640, 480)
    spin(0.05)
    assert (window.width(), window.height()) == (640, 480)
    assert not window.inspector.isVisible()
    assert window.glwidget.width() > 550 and window.glwidget.height() > 300
    window.resize(1280, 720)
    spin(0.05)
    assert window.inspector.isVisible() == (world == "cubes")


def test_a_folded_inspector_can_be_asked_for_and_stays_away_when_closed(
    make_window: MakeWindow, cubes: pydart2.World
) -> None:
    window = make_window(size=(640, 480))
    window.set_simulation(cubes)
    assert not window.inspector.isVisible()
    window.named_actions["inspector"].setChecked(True)
    assert window.inspector.isVisible()
    window.named_actions["inspector"].setChecked(False)
    window.resize(1280, 720)
    spin(0.05)
    assert window.inspector.isVisible()
    window.named_actions["inspector"].setChecked(False)
    for size in ((640, 480), (1280, 720)):
        window.resize(*size)
        spin(0.05)
        assert not window.inspector.isVisible()


def test_pulling_moves_the_body_to_the_mouse(make_window: MakeWindow, cubes: pydart2.World) -> None:
    window = make_window(cubes)
    window.commands.frame_all()
    picture, body = window.glwidget, cubes.skeletons[3].bodynodes[0]
    start = pixel_of(window, body.C)
    QTest.mousePress(picture, Qt.RightButton, Qt.NoModifier, start)
    pull = picture.overlays.pull
    assert pull is not None and pull.body is body
    before = picture.picture()
    goal = pull.point + picture.camera.rotation.T @ [0.1, 0.4, 0.0]  # in the picture's plane
    drag_on(picture, pixel_of(window, goal))
    assert pull.target == pytest.approx(goal, abs=0.03)
    assert (picture.picture() != before).any()  # the arrow
    for _ in range(3000):
        window.runtime.step()
    sag = 9.81 * body.m / pull.stiffness
    assert pull.point == pytest.approx(pull.target - [0.0, sag, 0.0], abs=0.01)
    QTest.mouseRelease(picture, Qt.RightButton, Qt.NoModifier, start)
    assert picture.overlays.pull is None


def test_the_camera_follows_a_body(make_window: MakeWindow, cubes: pydart2.World) -> None:
    window = make_window(cubes)
    window.commands.frame_all()
    skel = cubes.skeletons[1]
    pixel = pixel_of(window, skel.bodynodes[0].C)
    QTest.mouseDClick(window.glwidget, Qt.LeftButton, Qt.NoModifier, pixel)
    assert window.named_actions["follow"].isChecked()
    skel.set_positions(skel.q + np.array([0.0, 0.0, 0.0, 5.0, 2.0, -3.0]))
    window.glwidget.picture()
    moved = pixel_of(window, skel.bodynodes[0].C) - pixel
    assert abs(moved.x()) <= 1 and abs(moved.y()) <= 1
    window.named_actions["follow"].setChecked(False)
    assert window.glwidget.followed is None


def test_every_toggle_changes_the_picture(make_window: MakeWindow, cubes: pydart2.World) -> None:
    cubes.set_sleeping()
    cubes.step(1500)
    window = make_window(cubes)
    window.commands.frame_all()
    cubes.skeletons[3].bodynodes[0].shapenodes[0].shape.set_size([0.2, 0.2, 0.2])
    for name in window.glwidget.overlays.TOGGLES:
        before = window.glwidget.picture()
        window.named_actions[name].toggle()
        assert (window.glwidget.picture() != before).any(), name
        window.named_actions[name].toggle()
        assert (window.glwidget.picture() == before).all(), name


def test_help_lists_every_key(make_window: MakeWindow) -> None:
    from pydart2.gui.user_input import KEYS, shortcut

    window = make_window()
    QTest.keyClick(window, Qt.Key_F1)
    assert window.helpOverlay.isVisible()
    for key in KEYS:
        assert key.text in window.helpOverlay.text()
        shortcuts = [sequence.toString() for sequence in window.named_actions[key.action].shortcuts()]
        assert shortcuts == list(key.keys)
    assert shortcut("help") == "F1"
    assert set(window.named_actions) == {key.action for key in KEYS}
    QTest.keyClick(window, Qt.Key_Escape)
    assert window.isVisible() and not window.helpOverlay.isVisible()


def test_models_can_be_dropped(make_window: MakeWindow, tmp_path: Path) -> None:
    window = make_window()
    drop(window, pydart2.data_path("sdf/atlas/atlas_v3_no_head.sdf"))
    assert [skel.ndofs for skel in window.sim.skeletons] == [33, 0]  # and a ground, for Play
    assert list(window.sim.up) == [0.0, 0.0, 1.0]
    assert window.cameraGroup.checkedAction().text() == "Camera Z up"
    assert window.inspector.tree.topLevelItemCount() == 2
    drop(window, pydart2.data_path("sdf/atlas/atlas_v3_no_head.sdf"))
    window.refresh()
    assert window.inspector.tree.topLevelItemCount() == 3
    window.sim.dt = 0.002
    drop(window, pydart2.data_path("skel/cubes.skel"))
    assert (window.sim.num_skeletons(), window.sim.dt) == (4, 0.002)
    (tmp_path / "scene.xml").write_text(
        """<mujoco><option gravity="0 0 -1.62"/><worldbody><geom type="plane" size="5 5 .1"/>
        <body><freejoint/><geom size=".1"/></body><body pos="1 0 0"><freejoint/><geom size=".1"/></body>
        </worldbody></mujoco>"""
    )
    drop(window, tmp_path / "scene.xml")
    assert (window.sim.num_skeletons(), window.sim.gravity()[2]) == (3, -1.62)
    (tmp_path / "broken.urdf").write_text("<robot>")
    drop(window, tmp_path / "broken.urdf")
    assert window.errorPane.isVisible()
    assert "LoadError" in window.errorPane.title.text()


def test_an_error_in_user_code_is_shown_and_can_be_dismissed(
    make_window: MakeWindow, capsys: pytest.CaptureFixture[str]
) -> None:
    class Broken(pydart2.World):
        def step(self, n: int = 1) -> None:
            super().step(n)
            if self.frame == 5:
                raise ZeroDivisionError("gain is 1 / 0")

    window = make_window(Broken(0.001, "./data/skel/cubes.skel"))
    window.playAction.setChecked(True)
    wait_for(lambda: not window.playAction.isChecked())
    assert window.sim.frame == 5
    assert window.errorPane.isVisible()
    assert window.errorPane.title.text() == "Paused by an error: ZeroDivisionError: gain is 1 / 0"
    assert "raise ZeroDivisionError" in window.errorPane.text.toPlainText()
    QTest.mouseClick(window.errorPane.copy_button, Qt.LeftButton)
    QTest.mouseClick(window.errorPane.dismiss_button, Qt.LeftButton)
    assert not window.errorPane.isVisible()
    click(window, window.playAction)
    wait_for(lambda: window.sim.frame > 5)
    assert "gain is 1 / 0" in capsys.readouterr().err


def test_texts_change_ten_times_a_second_and_stop_at_what_is_shown(
    make_window: MakeWindow, cubes: pydart2.World, monkeypatch: pytest.MonkeyPatch
) -> None:
    window = make_window(cubes)
    clock = [time.monotonic() + 10.0]
    monkeypatch.setattr("pydart2.gui.pyqt5.window.time.monotonic", lambda: clock[0])
    frame = window.statusView.frame
    window.runtime.play()
    window.runtime.step()
    window.synchronize()
    assert frame.text().startswith("frame 1 ")
    window.runtime.step()
    clock[0] += 0.05
    window.synchronize()
    assert (window.rangeSlider.value(), frame.text().split(" ")[1]) == (2, "1")
    clock[0] += 0.06
    window.synchronize()
    assert frame.text().startswith("frame 2 ")
    window.runtime.step()
    window.runtime.pause()
    window.synchronize()
    assert frame.text().startswith("frame 3 ")


def test_long_words_push_nothing_off_the_screen(make_window: MakeWindow, cubes: pydart2.World) -> None:
    """Neither a long error nor a long status widens the window or narrows the inspector."""
    window = make_window(cubes)
    window.resize(1400, 800)
    spin(0.2)
    before = window.width(), window.inspector.width()
    window.errorPane.show_error("ValueError: " + "w" * 400)
    cubes.status = lambda: "status " * 200  # type: ignore[attr-defined]
    window.synchronize()
    spin(0.2)
    assert (window.width(), window.inspector.width()) == before
    assert window.minimumSizeHint().width() < 1400


@pytest.mark.parametrize("hook", ["render_with_ri", "draw_with_ri", "status", "on_key_press", "render"])
def test_any_hook_may_raise(make_window: MakeWindow, hook: str, capsys: pytest.CaptureFixture[str]) -> None:
    def fail(self: Any, *args: Any) -> None:
        raise ValueError(f"in {hook}")

    broken = type("Broken", (pydart2.World,), {hook: fail})
    window = make_window(broken(0.001, "./data/skel/cubes.skel"))
    QTest.keyClick(window, Qt.Key_A)
    window.glwidget.picture()
    assert f"ValueError: in {hook}" in window.errorPane.title.text()
    assert len(window.runtime.errors) == 1
    assert window.isVisible()
    capsys.readouterr()


def test_any_object_can_be_a_simulation(make_window: MakeWindow) -> None:
    class Ball:
        height = 5

        def step(self) -> bool:
            self.height -= 1
            return self.height > 0

        def render_with_ri(self, ri: Any) -> None:
            ri.set_color(1.0, 0.0, 0.0)
            ri.render_sphere([0.0, 0.1 * self.height, 0.0], 0.2)

    window = make_window(Ball())
    assert window.inspector.isHidden()
    before = window.glwidget.picture()
    click(window, window.playAction)
    wait_for(lambda: not window.playAction.isChecked())
    assert window.sim.height == 0
    assert (window.glwidget.picture() != before).any()


def test_side_panel_beside_the_picture(make_window: MakeWindow, cubes: pydart2.World) -> None:
    panel = pydart2.gui.side_panel.SidePanel(width=200)
    clicked: list[bool] = []
    button = panel.add_push_button("push", clicked.append)
    window = make_window(cubes)
    width = window.width()
    window.add_right_panel(panel)
    spin(0.05)
    assert window.width() == width + 200
    QTest.mouseClick(button, Qt.LeftButton)
    assert clicked == [False]


def test_simulation_can_be_exchanged(make_window: MakeWindow, cubes: pydart2.World, atlas: pydart2.Skeleton) -> None:
    window = make_window(cubes)
    window.commands.select(cubes.skeletons[1])
    window.playAction.setChecked(True)
    window.set_simulation(atlas.world)
    spin(0.05)
    assert window.get_simulation() is atlas.world
    assert not window.playAction.isChecked()
    assert window.glwidget.overlays.selected is None
    assert window.inspector.sliders.skeleton is atlas


def test_a_destroyed_world_is_an_error_in_the_window(make_window: MakeWindow, cubes: pydart2.World) -> None:
    window = make_window(cubes)
    cubes.destroy()
    window.playAction.setChecked(True)
    window.glwidget.picture()
    spin(0.1)
    assert "DestroyedError" in window.errorPane.title.text()
