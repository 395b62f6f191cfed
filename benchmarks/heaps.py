"""Heaps, stacks, walls and a thousand rows of three shapes, beside MuJoCo with the same ground and the same bodies.

Ours with the native detector and the iterative solver at their default settings; MuJoCo at its own. Each scene first
comes to rest for a while; then the time of a step is the median over pieces of steps, the engines in turn. "Asleep":
both put to sleep what lies still, and step it for 3 s first. Sag is how far the lowest body is below where it would
stand.

    python benchmarks/heaps.py                 all scenes, and how the time of a contact grows
    python benchmarks/heaps.py "stack of 20"   some of them, or "growth"
"""

from __future__ import annotations

import statistics
import sys
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass

import mujoco
import numpy as np
from harness import table

import pydart2

SIDE = 0.2  # m, of a box
PIECES = 9
GROWTH = "growth"


@dataclass(frozen=True)
class Body:
    """A box, ball or upright cylinder at a place; z is up."""

    kind: str
    size: tuple[float, float, float]
    place: tuple[float, float, float]


@dataclass(frozen=True)
class Scene:
    """Bodies on a ground, and how they are stepped."""

    bodies: list[Body]
    dt: float = 0.002
    warm: int = 250
    steps: int = 20
    drop: float = 0.0  # m, from which they fall
    spin: float = 0.0
    sleep: bool = False


def box(x: float, height: float, y: float = 0.0, width: float = SIDE) -> Body:
    """A box of 0.2 m, or a part of it."""
    return Body("box", (width, SIDE, SIDE), (x, y, height))


def apart(count: int) -> Scene:
    """Boxes on the ground that do not touch each other."""
    return Scene([box(0.4 * (i % 20), SIDE / 2, 0.4 * (i // 20)) for i in range(count)])


def stack(count: int) -> Scene:
    """One box on the other."""
    return Scene([box(0.0, SIDE * (i + 0.5)) for i in range(count)])


def wall(side: int) -> Scene:
    """Rows of boxes, every second one shifted by half a box, with half bricks at its ends."""
    bodies = []
    for row in range(side):
        height = SIDE * (row + 0.5)
        if row % 2 == 0:
            bodies += [box(SIDE * i, height) for i in range(side)]
        else:
            bodies += [box(SIDE * (i + 0.5), height) for i in range(side - 1)]
            bodies += [box(x, height, width=SIDE / 2) for x in (-SIDE / 4, SIDE * (side - 0.75))]
    return Scene(bodies)


def shapes(count: int, sleep: bool = False) -> Scene:
    """Rows of boxes, cylinders and balls of 1 m, 1.5 m apart, 2 cm above the ground."""
    kinds = ("box", "cylinder", "ball")
    bodies = [
        Body(kind, (1.0, 1.0, 1.0), (1.5 * (i % 50), 1.5 * (3 * (i // 50) + row), 0.52))
        for row, kind in enumerate(kinds)
        for i in range(count)
    ]
    if sleep:
        return Scene(bodies, dt=0.001, warm=3000, drop=0.02, sleep=True)
    return Scene(bodies, dt=0.001, steps=5, drop=0.02, spin=0.1)


SCENES: dict[str, Callable[[], Scene]] = {
    "10 boxes apart": lambda: apart(10),
    "50 boxes apart": lambda: apart(50),
    "200 boxes apart": lambda: apart(200),
    "stack of 5": lambda: stack(5),
    "stack of 10": lambda: stack(10),
    "stack of 20": lambda: stack(20),
    "stack of 40": lambda: stack(40),
    "wall of 16": lambda: wall(4),
    "wall of 36": lambda: wall(6),
    "wall of 100": lambda: wall(10),
    "wall of 400": lambda: wall(20),
    "3 × 100 shapes": lambda: shapes(100),
    "3 × 1000 shapes": lambda: shapes(1000),
    "3 × 1000 shapes, asleep": lambda: shapes(1000, sleep=True),
}


def spins(scene: Scene) -> np.ndarray:
    """Angular velocities to begin with, the same for both, rad/s."""
    rng = np.random.default_rng(1)
    return rng.uniform(-scene.spin, scene.spin, (len(scene.bodies), 3))


class Ours:
    """The scene in pydart2."""

    def __init__(self, scene: Scene, detector: str = "native", solver: str = "iterative") -> None:
        self.world = pydart2.World(scene.dt)
        self.world.set_gravity([0.0, 0.0, -9.81])
        self.world.set_recording(False)
        reach = 2.0 * max(max(abs(v) for v in body.place) for body in scene.bodies) + 10.0
        self.world.add_box((reach, reach, 1.0), None, (0.0, 0.0, -0.5), fixed=True, name="ground")
        for body, spin in zip(scene.bodies, spins(scene), strict=True):
            self._add(body).dq = np.r_[spin, 0.0, 0.0, 0.0]
        self.world.set_collision_detector(detector)
        self.world.set_constraint_solver(solver)
        self.world.set_sleeping(scene.sleep)

    def _add(self, body: Body) -> pydart2.Skeleton:
        if body.kind == "box":
            return self.world.add_box(body.size, None, body.place)
        if body.kind == "ball":
            return self.world.add_sphere(body.size[0] / 2, None, body.place)
        return self.world.add_cylinder(body.size[0] / 2, body.size[2], None, body.place)

    def step(self, count: int) -> None:
        """Steps without a return to Python."""
        self.world.step(count)

    def heights(self) -> np.ndarray:
        """Of all bodies."""
        return np.array([skeleton.C[2] for skeleton in self.world.skeletons[1:]])

    def residual(self) -> float:
        """What the last step's solver left, m/s."""
        return self.world.solver_residual()

    def contacts(self) -> int:
        """Of the last step."""
        return len(self.world.collision_result.contacts)


class Theirs:
    """The scene in MuJoCo."""

    def __init__(self, scene: Scene) -> None:
        reach = 2.0 * max(max(abs(v) for v in body.place) for body in scene.bodies) + 10.0
        sleep = "enable" if scene.sleep else "disable"
        geoms = "".join(self._body(body) for body in scene.bodies)
        self.model = mujoco.MjModel.from_xml_string(
            f'<mujoco><option timestep="{scene.dt}" gravity="0 0 -9.81"><flag sleep="{sleep}"/></option>'
            f'<size memory="400M"/><worldbody>'
            f'<geom type="box" size="{reach / 2} {reach / 2} 0.5" pos="0 0 -0.5"/>{geoms}</worldbody></mujoco>'
        )
        self.data = mujoco.MjData(self.model)
        self.data.qvel.reshape(-1, 6)[:, 3:] = spins(scene)

    @staticmethod
    def _body(body: Body) -> str:
        a, b, c = (s / 2 for s in body.size)
        size = {"box": f"{a} {b} {c}", "ball": f"{a}", "cylinder": f"{a} {b}"}[body.kind]
        kind = {"box": "box", "ball": "sphere", "cylinder": "cylinder"}[body.kind]
        place = "{} {} {}".format(*body.place)
        return f'<body pos="{place}"><freejoint/><geom type="{kind}" size="{size}"/></body>'

    def step(self, count: int) -> None:
        """Steps without a return to Python."""
        mujoco.mj_step(self.model, self.data, count)

    def heights(self) -> np.ndarray:
        """Of all bodies."""
        return self.data.qpos.reshape(-1, 7)[:, 2]

    def contacts(self) -> int:
        """Of the last step."""
        return int(self.data.ncon)


def measure(scene: Scene) -> list[object]:
    """Both engines in turn: times of a step, their ratio, contacts, sags and our residual."""
    ours, theirs = Ours(scene), Theirs(scene)
    players: list[Ours | Theirs] = [ours, theirs]
    for player in players:
        player.step(scene.warm)
    times: list[list[float]] = [[], []]
    for _ in range(PIECES):
        for which, player in enumerate(players):
            begin = time.process_time()
            player.step(scene.steps)
            times[which].append((time.process_time() - begin) / scene.steps)
    mine, other = (statistics.median(part) for part in times)
    rest = np.array([body.place[2] - scene.drop for body in scene.bodies])
    sags = [f"{1e3 * float((rest - player.heights()).max()):.2f}" for player in players]
    return [
        f"{mine * 1e6:.0f}",
        f"{other * 1e6:.0f}",
        f"{mine / other:.2f}",
        f"{ours.contacts()} / {theirs.contacts()}",
        " / ".join(sags),
        f"{ours.residual():.1e}",
    ]


def rows(names: list[str]) -> Iterator[list[object]]:
    """A line for each scene."""
    for name in names:
        yield [name, *measure(SCENES[name]())]


def growth(kind: type[Ours] | type[Theirs]) -> float:
    """Time of a contact in the wall of 400 to that in the wall of 16, the two in turn: the median."""
    small, large = players = kind(wall(4)), kind(wall(20))
    for player in players:
        player.step(250)
    ratios = []
    for _ in range(2 * PIECES):
        times = []
        for player, steps in ((small, 200), (large, 20)):
            begin = time.process_time()
            player.step(steps)
            times.append((time.process_time() - begin) / steps / player.contacts())
        ratios.append(times[1] / times[0])
    return statistics.median(ratios)


if __name__ == "__main__":
    head = ["scene", "ours, µs", "MuJoCo, µs", "ratio", "contacts", "sag, mm", "residual, m/s"]
    names = sys.argv[1:] or [*SCENES, GROWTH]
    if scenes := [name for name in names if name != GROWTH]:
        print(table(head, list(rows(scenes))))
    if GROWTH in names:
        print(f"A contact of the wall of 400 takes {growth(Ours):.1f} times that of the wall of 16,", end=" ")
        print(f"in MuJoCo {growth(Theirs):.1f} times.")
