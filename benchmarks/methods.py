"""Three methods for the contacts of one step, in NumPy, counted in passes over the contacts: why the solver sweeps.

    python benchmarks/methods.py

Each scene has stood for a while under the native detector. Its contacts and the velocities that weight would give are
one problem: impulses x in friction cones such that w = W x - b is complementary to them, with W = J M^-1 J'. How many
passes bring the residual, the largest W_ii |x_i - P(x_i - w_i / W_ii)|, below 1e-3 and 1e-6 m/s, from no impulses and
from those of the solution with 1 % of noise:

- sweeps: projected block Gauss-Seidel;
- sweeps that go on in their direction: nonsmooth nonlinear conjugate gradients (Silcowitz, Niebe, Erleben 2010);
- ADMM on the Delassus operator (Carpentier, Le Lidec, Montaut, RSS 2024), each of whose passes solves with a factor of
  W + rho, which fills in; a pass of the others reads the rows.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import heaps
import numpy as np
from harness import table
from scipy.sparse import csc_matrix, diags
from scipy.sparse.linalg import splu

MOST = 3000
LEVELS = (1e-3, 1e-6)


@dataclass
class Problem:
    """Rows J of contacts, three each, normal first; Y is M^-1 J'."""

    J: csc_matrix
    Y: csc_matrix
    b: np.ndarray
    mu: float

    def __post_init__(self) -> None:
        self.W = (self.J @ self.Y).tocsr()
        self.count = self.J.shape[0] // 3
        self.diagonal = self.W.diagonal()

    def project(self, x: np.ndarray) -> np.ndarray:
        """Into the cones, as the solver does: the normal first."""
        p = x.reshape(-1, 3).copy()
        p[:, 0] = np.maximum(p[:, 0], 0.0)
        out = np.linalg.norm(p[:, 1:], axis=1)
        most = self.mu * p[:, 0]
        p[:, 1:] *= np.where(out > most, most / np.maximum(out, 1e-300), 1.0)[:, None]
        return p.ravel()

    def residual(self, x: np.ndarray) -> float:
        """The largest of a row."""
        w = self.W @ x - self.b
        return float(np.max(self.diagonal * np.abs(x - self._project_rows(x, x - w / self.diagonal))))

    def _project_rows(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        p, x = y.reshape(-1, 3).copy(), x.reshape(-1, 3)
        out = np.linalg.norm(p[:, 1:], axis=1)
        most = self.mu * np.maximum(x[:, 0], 0.0)
        p[:, 0] = np.maximum(p[:, 0], 0.0)
        p[:, 1:] *= np.where(out > most, most / np.maximum(out, 1e-300), 1.0)[:, None]
        return p.ravel()


def problem_of(world: heaps.Ours, dt: float, mu: float = 1.0) -> Problem:
    """Of the contacts of a world's last step, with the velocities that weight gives in the next."""
    skeletons = world.world.skeletons
    number = {skel.id: i for i, skel in enumerate(skeletons[1:])}
    rows, columns, values, scaled = [], [], [], []
    velocity = np.zeros(6 * len(number))
    inverse = {}
    for skel in skeletons[1:]:
        i, body = number[skel.id], skel.bodynodes[0]
        turn = body.T[:3, :3]
        inverse[skel.id] = (body.C, 1.0 / body.m, turn @ np.linalg.inv(body.I) @ turn.T)
        velocity[6 * i + 3 : 6 * i + 6] = body.dC + np.array([0.0, 0.0, -9.81]) * dt
        velocity[6 * i : 6 * i + 3] = body.world_angular_velocity()
    contacts = world.world.collision_result.contacts
    for k, contact in enumerate(contacts):
        normal = contact.normal
        first = np.cross(normal, [1.0, 0.0, 0.0] if abs(normal[0]) < 0.9 else [0.0, 1.0, 0.0])
        first /= np.linalg.norm(first)
        for row, direction in enumerate((normal, first, np.cross(normal, first))):
            for sign, skel_id in ((1.0, contact.skel_id1), (-1.0, contact.skel_id2)):
                if skel_id not in number:
                    continue
                center, mass, inertia = inverse[skel_id]
                moment = np.cross(contact.point - center, sign * direction)
                rows += [3 * k + row] * 6
                columns += range(6 * number[skel_id], 6 * number[skel_id] + 6)
                values += [*moment, *(sign * direction)]
                scaled += [*(inertia @ moment), *(mass * sign * direction)]
    shape = (3 * len(contacts), len(velocity))
    J = csc_matrix((values, (rows, columns)), shape)
    return Problem(J, csc_matrix((scaled, (rows, columns)), shape).T.tocsc(), -(J @ velocity), mu)


Watch = Callable[[np.ndarray], bool]


def sweeps(problem: Problem, x: np.ndarray, done: Watch, accelerate: bool) -> None:
    """Block after block, each with its own W and all others as they are."""
    W = problem.W
    blocks = [np.linalg.inv(W[3 * i : 3 * i + 3, 3 * i : 3 * i + 3].toarray()) for i in range(problem.count)]
    parts = [(W[3 * i : 3 * i + 3].indices, W[3 * i : 3 * i + 3].toarray()) for i in range(problem.count)]
    parts = [(np.unique(indices), dense[:, np.unique(indices)]) for indices, dense in parts]
    x, along, last_square = x.copy(), np.zeros_like(x), 0.0
    for sweep in range(MOST):
        before = x.copy()
        for i, (indices, rows) in enumerate(parts):
            mine = slice(3 * i, 3 * i + 3)
            w = rows @ x[indices] - problem.b[mine]
            y = x[mine] - blocks[i] @ w
            y[0] = max(y[0], 0.0)
            out, most = float(np.hypot(y[1], y[2])), problem.mu * y[0]
            if out > most:
                y[1:] *= most / out
            x[mine] = y
        if done(x):
            return
        if accelerate:
            step = x - before
            square = step @ step
            share = 0.0 if sweep == 0 else square / last_square
            last_square = square
            if share > 1.0:
                along[:] = 0.0
            else:
                x = x + share * along
                along = share * along + step


def admm(problem: Problem, x: np.ndarray, done: Watch) -> None:
    """Splits x = z with z in the cones; rho is balanced by the two residuals, each time with a new factor."""
    rho = float(np.sqrt(problem.diagonal.max() * problem.diagonal.min()))
    z, y = x.copy(), np.zeros_like(x)
    W, eye = problem.W.tocsc(), diags(np.ones(len(x)))
    factor = splu((W + (rho + 1e-9) * eye).tocsc())
    for i in range(MOST):
        x = factor.solve(problem.b + rho * z - y)
        last, z = z, problem.project(x + y / rho)
        y = y + rho * (x - z)
        if done(z):
            return
        primal, dual = np.abs(x - z).max(), rho * np.abs(z - last).max() / problem.diagonal.mean()
        if i % 10 == 9 and (primal > 10.0 * dual or dual > 10.0 * primal):
            rho *= 3.0 if primal > dual else 1.0 / 3.0
            factor = splu((W + (rho + 1e-9) * eye).tocsc())


METHODS: dict[str, Callable[[Problem, np.ndarray, Watch], None]] = {
    "sweeps": lambda problem, x, done: sweeps(problem, x, done, accelerate=False),
    "sweeps that go on": lambda problem, x, done: sweeps(problem, x, done, accelerate=True),
    "ADMM": admm,
}


def passes(problem: Problem, method: str, x: np.ndarray) -> list[int | str]:
    """How many until each level."""
    reached: list[int | str] = [f">{MOST}"] * len(LEVELS)
    count = 0

    def done(now: np.ndarray) -> bool:
        nonlocal count
        count += 1
        residual = problem.residual(now)
        for i, level in enumerate(LEVELS):
            if residual <= level and isinstance(reached[i], str):
                reached[i] = count
        return residual <= LEVELS[-1]

    METHODS[method](problem, x, done)
    return reached


def lines(name: str, scene: heaps.Scene) -> list[list[object]]:
    """Of one scene."""
    world = heaps.Ours(scene)
    world.step(100)
    problem = problem_of(world, scene.dt)
    solution: list[np.ndarray] = []
    sweeps(
        problem, np.zeros(len(problem.b)), lambda x: bool(solution.append(x.copy())) or problem.residual(x) < 1e-6, True
    )
    warm = solution[-1] * (1.0 + 0.01 * np.random.default_rng(0).standard_normal(len(problem.b)))
    found = []
    for method in METHODS:
        cold, again = (passes(problem, method, x) for x in (np.zeros(len(problem.b)), warm))
        found.append([name, problem.count, method, " / ".join(map(str, cold)), " / ".join(map(str, again))])
    return found


if __name__ == "__main__":
    scenes = {name: heaps.SCENES[name]() for name in ("stack of 10", "stack of 20", "wall of 36", "wall of 100")}
    head = ["scene", "contacts", "method", "passes to 1e-3 / 1e-6 m/s", "begun 1 % off"]
    print(table(head, [line for name, scene in scenes.items() for line in lines(name, scene)]))
