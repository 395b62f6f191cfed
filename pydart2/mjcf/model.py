"""A compiled MJCF file, ready to be built."""

from __future__ import annotations

import logging

import numpy as np

from pydart2._native import WorldHandle
from pydart2.loading.xml import Document
from pydart2.mjcf.compile import Compiled, compile_model, mujoco_module
from pydart2.mjcf.contacts import add_equalities, set_filter
from pydart2.mjcf.trees import Built, add_static, add_tree, trees_of

_log = logging.getLogger("pydart2")


class MjcfModel:
    """A compiled model. As a path, it is that of its file.

    Attributes
    ----------
    document : Document
    compiled : mujoco.MjModel
    built : Built or None
        Where its bodies went, of the last time that it was built.
    """

    has_world = True
    has_skeleton = True

    def __init__(self, document: Document) -> None:
        self.document = document
        self.compiled: Compiled = compile_model(document.path, document.data)
        self.built: Built | None = None

    def __fspath__(self) -> str:
        return self.document.path or ""

    def load_world(self) -> WorldHandle:
        """A new world with all of it, MuJoCo's gravity, and Bullet as its detector, which has planes and capsules."""
        model = self.compiled
        world = WorldHandle(float(model.opt.timestep))
        off = int(model.opt.disableflags) & int(mujoco_module().mjtDisableBit.mjDSBL_GRAVITY)
        world.set_gravity(np.zeros(3) if off else np.array(model.opt.gravity))
        world.set_collision_detector("bullet")
        built = self.built = Built()
        add_static(model, world, built)
        for bodies in trees_of(model).values():
            add_tree(model, world, bodies, built)
        notes = self._without_counterpart()
        set_filter(model, world, built, notes)
        add_equalities(model, world, built, notes)
        self._warn(notes)
        return world

    def add_to(self, world: WorldHandle) -> int:
        """Add its one tree to a world, without what cannot move; returns the skeleton's index there."""
        trees = list(trees_of(self.compiled).values())
        if len(trees) != 1:
            many = f"it has {len(trees)} trees of bodies; load it with World(step, file)"
            raise self.document.error(self.document.root, many if trees else "it has no moving body")
        built = self.built = Built()
        index = add_tree(self.compiled, world, trees[0], built)
        notes = self._without_counterpart()
        set_filter(self.compiled, world, built, notes)
        add_equalities(self.compiled, world, built, notes)
        self._warn(notes)
        return index

    def _warn(self, notes: set[str]) -> None:
        if notes:
            _log.warning("%s: left out: %s", self.document.path or "XML text", "; ".join(sorted(notes)))

    def _without_counterpart(self) -> set[str]:
        """What the engine has nothing for."""
        model = self.compiled
        present = {
            "tendons": model.ntendon,
            "actuators (set forces instead)": model.nu,
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
            "armature": np.any(model.dof_armature),
        }
        return {what for what, count in present.items() if count}

    def _free_joints_resist(self) -> bool:
        model = self.compiled
        free = np.array(model.jnt_type)[np.array(model.dof_jntid)] == 0
        return bool(np.any(np.ravel(model.dof_damping)[: model.nv][free]) or np.any(model.dof_frictionloss[free]))
