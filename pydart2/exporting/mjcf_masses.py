"""Masses that MuJoCo takes: those of bodies, and of a body that moves neither 0 nor without moments of inertia."""

from __future__ import annotations

import numpy as np

from pydart2.exporting.losses import Losses
from pydart2.exporting.numbers import Element, add, attributes, inverse, text
from pydart2.exporting.parts import Array, LinkPart, SkeletonPart

_LEAST = 1e-13  # kg, kg m²: MuJoCo takes no moving body of 1e-15 or less
_TOLERANCE = 1e-12  # of the largest moment


def leader_of(link: LinkPart) -> LinkPart | None:
    """The body that it is welded to and that moves; None if it cannot move."""
    one: LinkPart | None = link
    while one is not None and not one.joint.dofs:
        one = one.parent
    return one


def settle_masses(skel: SkeletonPart, losses: Losses) -> None:
    """Give each body that moves moments of inertia that a body can have, its own or those of all welded to it.

    ExportError if they have none together.
    """
    welded: dict[int, list[LinkPart]] = {}
    for link in skel.links:
        if (leader := leader_of(link)) is not None:
            welded.setdefault(id(leader), []).append(link)
        elif not _is_possible(link.inertia):
            link.inertia = np.zeros((3, 3))  # no matter what: it does not move
    for leader, *others in welded.values():
        if not all(_is_possible(link.inertia) for link in (leader, *others)):
            _join(leader, others, losses)
        for link in (leader, *others):
            _raise_to_least(link, link is leader, losses)


def _is_possible(inertia: Array) -> bool:
    """Whether the sum of any two principal moments is the third or more."""
    least, middle, most = np.linalg.eigvalsh(inertia)
    slack = _TOLERANCE * most + _LEAST / 100.0
    return bool(least >= -slack and least + middle >= most - slack)


def _join(leader: LinkPart, others: list[LinkPart], losses: Losses) -> None:
    """Let a body have the mass of all that are welded to it."""
    poses = {id(leader): np.eye(4)}
    for link in others:
        poses[id(link)] = poses[id(link.parent)] @ link.in_parent @ inverse(link.in_link)
    links = [leader, *others]
    mass = sum(link.mass for link in links)
    weights = [link.mass if mass > 0.0 else 1.0 for link in links]
    coms = [poses[id(link)][:3, :3] @ link.com + poses[id(link)][:3, 3] for link in links]
    com = np.average(coms, axis=0, weights=weights)
    inertia = np.zeros((3, 3))
    for link, place in zip(links, coms, strict=True):
        turn, away = poses[id(link)][:3, :3], place - com
        inertia += turn @ link.inertia @ turn.T + link.mass * (away @ away * np.eye(3) - np.outer(away, away))
    if not _is_possible(inertia):
        moments = ", ".join(f"{moment:.4g}" for moment in np.linalg.eigvalsh(inertia))
        raise losses.refuse(
            f"body {leader.name!r} with what is welded to it has the principal moments of inertia {moments} kg m², of "
            "which two sum to less than the third, as no body has them"
        )
    if others:
        losses.add("masses of bodies that are welded together, now of the first", leader.name)
    leader.mass, leader.com, leader.inertia = mass, com, inertia
    for link in others:
        link.mass, link.com, link.inertia = 0.0, np.zeros(3), np.zeros((3, 3))


def _raise_to_least(link: LinkPart, moves: bool, losses: Losses) -> None:
    if link.mass < _LEAST and moves:
        losses.add(f"that bodies that move weigh nothing, now {_LEAST} kg", link.name)
        link.mass = _LEAST
    if link.mass > 0.0 and np.linalg.eigvalsh(link.inertia)[0] < _LEAST:
        losses.add(f"that bodies with mass have no moment of inertia, now {_LEAST} kg m² more", link.name)
        link.inertia = link.inertia + _LEAST * np.eye(3)


def add_inertial(body: Element, link: LinkPart) -> None:
    """What a body weighs; MuJoCo takes one without for one that weighs nothing."""
    if link.mass == 0.0:
        return
    inertia, diagonal = link.inertia, np.diag(link.inertia)
    element = add(body, "inertial", **attributes(pos=link.com, mass=link.mass))
    if np.array_equal(inertia, np.diag(diagonal)):
        element.set("diaginertia", text(diagonal))
    else:  # MuJoCo's own decomposition of a fullinertia is one to 1e-9 in older versions
        principal, axes = np.linalg.eigh(inertia)
        element.attrib.update(attributes(diaginertia=principal, xyaxes=axes[:, :2].T))
