"""dartpy as a competitor: Debian's, and PyPI's with sleeping off."""

from __future__ import annotations

from typing import Any

import dartpy as dart
import numpy as np
from questions import play


def retriever() -> Any:
    """For SDF: without one the parser can crash on meshes."""
    composite = dart.utils.CompositeResourceRetriever()
    composite.addSchemaRetriever("file", dart.common.LocalResourceRetriever())
    return composite


def load_robot(path: str) -> Any:
    if path.endswith(".urdf"):
        return dart.utils.DartLoader().parseSkeleton(path)
    options = dart.utils.SdfParser.Options(retriever()) if hasattr(dart.utils.SdfParser, "Options") else retriever()
    return dart.utils.SdfParser.readSkeleton(dart.common.Uri.createFromPath(path), options)


class Model:
    """A scene in dartpy."""

    def __init__(self, scene: dict[str, Any]) -> None:
        if scene["world"]:
            world = dart.utils.SkelParser.readWorld(dart.common.Uri.createFromPath(scene["world"]))
        else:
            world = dart.simulation.World()
        self.world = world
        world.setGravity([0.0, scene["gravity"], 0.0])
        world.setTimeStep(scene["dt"])
        if hasattr(world, "setDeactivationOptions"):
            options = world.getDeactivationOptions()
            options.mEnabled = False
            world.setDeactivationOptions(options)
        if scene["robot"]:
            world.addSkeleton(load_robot(scene["robot"]))
        self.skeletons = [world.getSkeleton(i) for i in range(world.getNumSkeletons())]
        self.skel = skel = max(self.skeletons, key=lambda s: s.getNumDofs())
        self.body = skel.getBodyNode(skel.getNumBodyNodes() - 1)
        if scene["q"]:
            skel.setPositions(np.array(scene["q"]))
        if scene["stiffness"]:
            for i in range(6, skel.getNumDofs()):
                dof = skel.getDof(i)
                dof.setSpringStiffness(scene["stiffness"])
                dof.setRestPosition(dof.getPosition())
                dof.setDampingCoefficient(scene["damping"])
        self.step, self.num_dofs = world.step, skel.getNumDofs
        self.q, self.dq, self.M = skel.getPositions, skel.getVelocities, skel.getMassMatrix
        self.c, self.T, self.C = skel.getCoriolisAndGravityForces, self.body.getWorldTransform, skel.getCOM
        self.set_q, self.set_tau = skel.setPositions, skel.setForces
        self.variants = {"step": lambda: None}

    def J(self) -> Any:
        return self.skel.getLinearJacobian(self.body)

    def contacts(self) -> Any:
        return [(contact.point, contact.force) for contact in self.world.getLastCollisionResult().getContacts()]

    contact_objects = contacts

    def states(self) -> Any:
        return [(skel.getPositions(), skel.getVelocities()) for skel in self.skeletons]

    def set_states(self, states: Any) -> None:
        for skel, (q, dq) in zip(self.skeletons, states):
            if skel.getNumDofs():
                skel.setPositions(q)
                skel.setVelocities(dq)


if __name__ == "__main__":
    play(Model)
