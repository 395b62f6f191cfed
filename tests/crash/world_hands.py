"""The hands of fuzz_worlds.py: the world they hold, and the values that they give to calls."""

from __future__ import annotations

import math
import random
from collections.abc import Callable
from typing import Any

import numpy as np

import pydart2
from crash.fuzz_api import VALUES

MODELS = ("cubes", "chain", "shapes", "softBodies", "fullbody1")
MOST_CONTACTS_AT_ALL = 300  # of skins, which only the exact solvers take: in a step of 829 they are at it for 15 s
EXTREMES = (0.0, -1.0, 1e-12, 1e-6, 1e-3, 1e3, 1e6, 1e12, 1e300, math.nan, math.inf, -math.inf)
MOST_SKELETONS, MOST_DOFS = 8, 120

Deed = Callable[["Hands"], Any]
DEEDS: dict[str, Deed] = {}


class Wrong(AssertionError):
    """What a deed found that must not be."""


def deed(call: Deed) -> Deed:
    DEEDS[call.__name__] = call
    return call


class Hands:
    """A world, what was kept of it and of earlier ones, and the values that calls get: most are sensible."""

    def __init__(self, seed: int) -> None:
        self.random = random.Random(seed)
        self.kept: list[Any] = []
        self.new_world()

    def new_world(self) -> None:
        draw = self.random.random()
        name = self.random.choice(MODELS[:4] if draw < 0.95 else MODELS)
        self.world = pydart2.World(0.001, f"skel/{name}.skel") if draw < 0.4 else pydart2.World(0.001)
        self.world.max_contacts = MOST_CONTACTS_AT_ALL
        if draw > 0.5:
            self.world.add_ground()

    # Values

    def odd(self, value: Any, often: float = 0.04) -> Any:
        """Mostly `value`, now and then anything."""
        return self.random.choice(VALUES) if self.random.random() < often else value

    def number(self, typical: float = 1.0, sign: bool = False) -> Any:
        if self.random.random() < 0.06:
            return self.odd(self.random.choice(EXTREMES), 0.3)
        return typical * math.exp(self.random.gauss(0.0, 0.7)) * (self.random.choice((1, -1)) if sign else 1)

    def count(self, typical: int) -> Any:
        """Of steps: an int is one that ends before tomorrow."""
        value = self.odd(typical)
        return value if not isinstance(value, int) or abs(value) < 100 else typical

    def vector(self, n: int = 3, typical: float = 1.0, sign: bool = True) -> Any:
        if self.random.random() < 0.9:
            values = [typical * math.exp(self.random.gauss(0.0, 0.7)) for _ in range(n)]
            return self.odd([self.random.choice((1, -1)) * value for value in values] if sign else values, 0.02)
        return [self.number(typical, sign) for _ in range(self.odd(n, 0.0) + (self.random.random() < 0.1))]

    def pose(self) -> Any:
        T = np.eye(4)
        angle = self.random.gauss(0.0, 1.0)
        T[:2, :2] = [[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]]
        T[:3, 3] = self.vector() if self.random.random() < 0.5 else 0.0
        return self.odd(T)

    def flip(self) -> bool:
        return self.random.random() < 0.5

    # Things

    def skel(self) -> pydart2.Skeleton:
        return self.random.choice(self.world.skeletons or [self.world.add_box([0.1, 0.1, 0.1])])

    def body(self) -> pydart2.BodyNode:
        bodies = self.skel().bodynodes
        return self.random.choice(bodies) if bodies else self.skel().add_body("body", mass=1.0)

    def joint(self) -> Any:
        return self.random.choice(self.skel().joints or [self.body().skel.joints[0]])

    def dof(self) -> Any:
        return self.random.choice([dof for skel in self.world.skeletons for dof in skel.dofs] or [self.skel()])

    def shape(self) -> Any:
        nodes = self.body().shapenodes
        return self.random.choice(nodes) if nodes else self.body().add_sphere(0.1)

    def bodies(self) -> Any:
        """As queries and filters take them."""
        whole = self.random.choice((self.body(), self.skel(), self.body().name, [self.body(), self.skel()]))
        return self.odd(whole)

    def keep(self, thing: Any) -> Any:
        self.kept.append(thing)
        del self.kept[:-12]
        return thing

    def has_room(self) -> bool:
        skeletons = self.world.skeletons
        return len(skeletons) < MOST_SKELETONS and sum(skel.ndofs for skel in skeletons) < MOST_DOFS

    def options(self) -> dict[str, Any]:
        drawn: dict[str, Any] = {"orientation": None, "friction": self.number(), "restitution": self.number(0.3)}
        drawn["fixed"] = self.random.random() < 0.2
        return drawn if self.flip() else {}
