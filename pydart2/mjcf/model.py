"""A compiled MJCF file, ready to be built."""

from __future__ import annotations

import contextlib
import logging
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from pydart2._native import WorldHandle
from pydart2.errors import LoadError
from pydart2.loading.readable import Readable
from pydart2.loading.xml import Document
from pydart2.mjcf.actuators import add_actuators
from pydart2.mjcf.cameras import cameras_of, note_cameras
from pydart2.mjcf.compile import Compiled, compile_model, mujoco_module, try_to_compile
from pydart2.mjcf.contacts import set_filter
from pydart2.mjcf.equalities import add_equalities
from pydart2.mjcf.geoms import GEOMS
from pydart2.mjcf.trees import Built, add_static, add_tree, trees_of

if TYPE_CHECKING:
    from pydart2.cameras import MountedCamera
    from pydart2.world import World

_log = logging.getLogger("pydart2")


class MjcfModel(Readable):
    """A compiled model. As a path, it is that of its file.

    Attributes
    ----------
    document : Document
    compiled : mujoco.MjModel
    built : Built or None
        Where its bodies went, of the last time that it was built.
    """

    has_world = True

    def __init__(self, document: Document, safe: bool = False, load_seconds: float | None = None) -> None:
        self.document = document
        if safe:
            try_to_compile(document.path, document.data, 60.0 if load_seconds is None else load_seconds)
        self.compiled: Compiled = compile_model(document.path, document.data)
        self.built: Built | None = None
        self.time_step = float(self.compiled.opt.timestep)

    @property
    def keyframes(self) -> dict[str, NDArray[np.float64]]:
        """Name → [q, dq] of all skeletons, shape (2 * sum of ndofs,), rad, m, rad/s and m/s."""
        model, states = self.compiled, {}
        for key in range(model.nkey if self.built else 0):
            qpos, qvel = model.key_qpos[key], model.key_qvel[key]
            parts = [part for c in self.built.coordinates.values() for part in (c.q(qpos), c.dq(qpos, qvel))]  # type: ignore[union-attr]
            states[str(model.key(key).name) or f"key{key}"] = np.concatenate(parts) if parts else np.zeros(0)
        return states

    def cameras(self, world: World, still: bool) -> Mapping[str, MountedCamera]:
        """Name → camera, of the world that it was loaded as or added to; without `still` only those that can move."""
        return dict(cameras_of(self.compiled, self.built, world, still)) if self.built else {}

    def load_world(self) -> WorldHandle:
        """A new world with all of it and MuJoCo's gravity.

        FCL, the default detector, has no planes and capsules: the world's is "native", or "bullet" if a mesh collides.
        """
        with self._located():
            return self._load_world()

    def add_to(self, world: WorldHandle) -> int:
        """Add its one tree to a world, without what cannot move; returns the skeleton's index there."""
        before = world.num_skeletons()
        try:
            with self._located():
                return self._add_to(world)
        except LoadError:
            for index in range(world.num_skeletons() - 1, before - 1, -1):
                world.remove_skeleton(index)
            raise

    @contextlib.contextmanager
    def _located(self) -> Iterator[None]:
        """What the builder refuses, as an error of the file."""
        try:
            yield
        except (ValueError, IndexError) as error:
            raise LoadError.at(self.document.path, None, str(error)) from error

    def _load_world(self) -> WorldHandle:
        model = self.compiled
        world = WorldHandle(float(model.opt.timestep))
        off = int(model.opt.disableflags) & int(mujoco_module().mjtDisableBit.mjDSBL_GRAVITY)
        world.set_gravity(np.zeros(3) if off else np.array(model.opt.gravity))
        world.set_collision_detector("bullet" if self._meshes_collide() else "native")
        built = self.built = Built()
        add_static(model, world, built)
        for bodies in trees_of(model).values():
            add_tree(model, world, bodies, built)
        self._complete(world, built)
        return world

    def _add_to(self, world: WorldHandle) -> int:
        trees = list(trees_of(self.compiled).values())
        if len(trees) != 1:
            many = f"it has {len(trees)} trees of bodies; load it with World(step, file)"
            raise self.document.error(self.document.root, many if trees else "it has no moving body")
        built = self.built = Built()
        index = add_tree(self.compiled, world, trees[0], built)
        self._complete(world, built)
        return index

    def _complete(self, world: WorldHandle, built: Built) -> None:
        """Add what there is beside bodies and joints, and say once what is left out."""
        notes = self._without_counterpart()
        set_filter(self.compiled, world, built, notes)
        add_equalities(self.compiled, world, built, notes)
        add_actuators(self.compiled, world, built, notes)
        note_cameras(self.compiled, built, notes)
        if notes:
            _log.warning("%s: left out: %s", self.document.path or "XML text", "; ".join(sorted(notes)))

    def _without_counterpart(self) -> set[str]:
        """What the engine has nothing for."""
        model = self.compiled
        present = {
            "tendons": model.ntendon,
            "soft bodies (flex)": model.nflex,
            "skins": model.nskin,
            "plugins": model.nplugin,
            "mocap bodies, which stay where they are": model.nmocap,
            "fluid forces": model.opt.density or model.opt.viscosity,
            "contact pairs": model.npair,
            "ranges of ball joints": np.any(model.jnt_limited[np.array(model.jnt_type) == 1]),
            "stiffness of free and ball joints": np.any(
                np.ravel(model.jnt_stiffness)[: model.njnt][np.array(model.jnt_type) < 2]
            ),
            "damping and friction of free joints": self._free_joints_resist(),
            "partial gravity compensation": np.any(~np.isin(model.body_gravcomp, (0.0, 1.0))),
        }
        return {what for what, count in present.items() if count}

    def _free_joints_resist(self) -> bool:
        model = self.compiled
        free = np.array(model.jnt_type)[np.array(model.dof_jntid)] == 0
        return bool(np.any(np.ravel(model.dof_damping)[: model.nv][free]) or np.any(model.dof_frictionloss[free]))

    def _meshes_collide(self) -> bool:
        model = self.compiled
        shaped = np.isin(model.geom_type, [GEOMS.index(kind) for kind in ("hfield", "mesh", "sdf")])
        return bool(np.any(shaped & ((np.array(model.geom_contype) | np.array(model.geom_conaffinity)) != 0)))
