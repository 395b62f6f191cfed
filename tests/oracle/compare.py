"""Comparing a world here with what the oracle reports of the same world."""

from __future__ import annotations

import numpy as np

import pydart2

from .dartpy_oracle import Frame

TOLERANCE = 1e-12  # times the largest entry


def assert_close(ours: np.ndarray, theirs: np.ndarray, what: str) -> None:
    """max|a - b| <= 1e-12 max|b|."""
    ours, theirs = np.asarray(ours), np.asarray(theirs)
    assert ours.shape == theirs.shape, what
    if theirs.size:
        assert np.max(np.abs(ours - theirs)) <= TOLERANCE * np.max(np.abs(theirs)), what


def assert_same_frame(world: pydart2.World, theirs: Frame) -> None:
    """Everything that dartpy reports about a frame."""
    assert world.t == theirs.time
    for skel, their in zip(world.skeletons, theirs.skeletons, strict=True):
        for name in ("q", "dq", "ddq", "M", "c", "C", "dC"):
            assert_close(getattr(skel, name), their[name], f"{skel} {name}")
        assert_close(skel.constraint_forces(), their["constraint_forces"], f"{skel} constraint forces")
        for i, body in enumerate(skel.bodynodes):
            assert_close(body.T, their["T"][i], f"{body} T")
            assert_close(body.J, their["J"][i], f"{body} J")
            assert_close(body.angular_jacobian(), their["Jang"][i], f"{body} angular Jacobian")
    contacts = world.collision_result.contacts
    assert len(contacts) == len(theirs.contacts)
    for ours, contact in zip(contacts, theirs.contacts, strict=True):
        ids = (ours.skel_id1, ours.bodynode_id1, ours.skel_id2, ours.bodynode_id2)
        assert ids == tuple(contact[name] for name in ("skel1", "body1", "skel2", "body2"))
        assert_close(ours.point, contact["point"], "contact point")
        assert_close(ours.force, contact["force"], "contact force")
        assert_close(ours.normal, contact["normal"], "contact normal")
        assert_close(np.array([ours.depth]), np.array([contact["depth"]]), "penetration depth")
