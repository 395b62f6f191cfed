"""What the window's menus and keys do beyond the original's: the recording, speed, cameras, selection, models."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

import numpy as np
from PyQt5.QtWidgets import QFileDialog
from scipy.spatial.transform import Rotation

from pydart2.bodynode import BodyNode
from pydart2.gui.first_look import floor_of, look, mounted, open_world
from pydart2.gui.placing import boxes
from pydart2.gui.pyqt5.actions import SPEEDS
from pydart2.gui.riding import RidingTrackball
from pydart2.gui.trackball import Trackball
from pydart2.loading import read_model
from pydart2.skeleton import Skeleton

if TYPE_CHECKING:
    from pydart2.dof import Dof
    from pydart2.gui.pyqt5.scripted import Scripted

MODEL_FILES = "Models (*.urdf *.sdf *.world *.skel *.vsk *.xml *.mjcf);;All files (*)"


class Commands:
    """The commands of a window."""

    def __init__(self, window: Scripted) -> None:
        self.window = window
        self.runtime = window.runtime

    # Recording and speed

    def back(self) -> None:
        """One recorded frame back."""
        self._scrub(self.runtime.frame - 1)

    def first_frame(self) -> None:
        """The first recorded frame."""
        self._scrub(self.runtime.first_frame)

    def last_frame(self) -> None:
        """The last recorded frame."""
        self._scrub(self.runtime.num_frames - 1)

    def _scrub(self, frame: int) -> None:
        self.runtime.scrub(frame)
        self.window.refresh()

    def faster(self) -> None:
        """The next higher speed."""
        self._change_speed(1)

    def slower(self) -> None:
        """The next lower speed."""
        self._change_speed(-1)

    def _change_speed(self, by: int) -> None:
        box = self.window.speedBox
        box.setCurrentIndex(min(max(box.currentIndex() + by, 0), len(SPEEDS) - 1))

    def set_speed(self, index: int) -> None:
        """Simulate at one of SPEEDS."""
        self.runtime.pacer.speed = SPEEDS[index]

    # Cameras

    def next_camera(self) -> None:
        """The next camera of the menu, after the last one the first."""
        scene = self.window.scene
        shown = next((i for i, tb in enumerate(scene.cameras) if tb is scene.tb), 0)
        self.window.camera_event((shown + 1) % max(scene.num_cameras(), 1))

    def first_look(self, view: str = "auto") -> None:
        """See what `gui.render` sees by that name: all, with the world's up upwards and a floor where there is none, or
        what a camera of the world sees."""
        sim, scene = self.window.sim, self.window.scene
        if (camera := mounted(self.window.world, view)) is not None:
            riding = [isinstance(tb, RidingTrackball) and tb.mount is camera for tb in scene.cameras]
            self.window.camera_event(riding.index(True))
            return
        self.window.glwidget.overlays.floor = floor_of(sim)
        if self.window.world is not None:
            rot = Rotation.from_matrix(look(sim, view=view).pose[:3, :3]).as_quat()
            scene.replace_camera(scene.cameras.index(scene.tb), Trackball(rot=rot.tolist()))
        self.frame_all()

    def frame_all(self) -> None:
        """Let the camera see all but floors."""
        world = self.window.world
        if world is None:
            return
        picture = self.window.glwidget
        items = [item for item in picture.overlays.scene(world).items if item.casts]
        corners = boxes(items)
        if len(corners) and np.isfinite(corners).all():
            aspect = picture.width() / max(picture.height(), 1)
            picture.camera.frame(corners[:, 0].min(axis=0), corners[:, 1].max(axis=0), aspect)
            picture.update()

    def follow(self, on: bool) -> None:
        """Let the camera follow the selected body, or the first one that moves."""
        part = self.window.glwidget.overlays.selected
        world = self.window.world
        if on and part is None and world is not None:
            part = next((skel for skel in world.skeletons if skel.ndofs), None)
        self.window.glwidget.follow(part if on else None)

    # What is shown

    def show_overlays(self, _on: bool) -> None:
        """Show contacts, forces and so on as the actions say."""
        overlays = self.window.glwidget.overlays
        for name in overlays.TOGGLES:
            setattr(overlays, name, self.window.named_actions[name].isChecked())
        self.window.glwidget.update()

    def show_inspector(self, on: bool) -> None:
        """Show the inspector or not."""
        self.window.inspector.setVisible(on)

    def full_screen(self, on: bool) -> None:
        """Fill the screen or not."""
        self.window.showFullScreen() if on else self.window.showNormal()

    def show_help(self, on: bool) -> None:
        """Show the help or not."""
        overlay = self.window.helpOverlay
        overlay.setVisible(on)
        if on:
            overlay.place()
            overlay.raise_()

    # Skeletons

    def select(self, part: BodyNode | Skeleton | None) -> None:
        """Select a part in the picture and in the tree; what is followed changes to it."""
        picture = self.window.glwidget
        picture.overlays.selected = part
        self.window.inspector.select(part)
        if picture.followed is not None and part is not None:
            picture.follow(part)
        picture.update()

    def pose(self, dof: Dof, position: float) -> None:
        """Move a dof; the skeleton starts from rest, as a jump in the middle of a swing can blow it up."""
        with self.runtime.guarded():
            dof.set_position(position)
            dof.skeleton.dq = np.zeros(dof.skeleton.ndofs)
        self.window.glwidget.update()

    def dismiss_error(self) -> None:
        """Hide the traceback."""
        self.runtime.dismiss_error()
        self.window.errorPane.hide()
        self.window.refresh()

    # Models

    def open(self) -> None:
        """Ask for a model file and open it."""
        options = QFileDialog.Options()
        path, _ = QFileDialog.getOpenFileName(self.window, "Open a model", "", MODEL_FILES, options=options)
        if path:
            self.open_model(path)

    def open_model(self, path: str | os.PathLike[str]) -> None:
        """Add a robot to the world; a file that holds a world takes the present one's place. Errors are shown."""
        with self.runtime.guarded():
            self._open_model(path)
        self.window.refresh()

    def _open_model(self, path: str | os.PathLike[str]) -> None:
        model, world = read_model(path), self.window.world
        if world is not None and not model.has_world:
            self.select(world.add_skeleton(model))
            return
        step = None if world is None else world.dt
        self.window.set_simulation(open_world(model, ground=True, step=step))
        self.window.look_upright()
        self.first_look()
