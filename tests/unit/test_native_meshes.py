"""Meshes of triangles with the package's own collision detector."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import pydart2
from physics.models import body as body_of
from physics.models import box, floor, free_body, make_world, skeleton, sphere
from physics.models import joint as joint_of

CUBE = [(x, y, z) for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)]
CUBE_FACES = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
Triangle = tuple[int, int, int]


def mesh(folder: Path, name: str, corners: list[tuple[float, float, float]], triangles: list[Triangle]) -> str:
    path = folder / f"{name}.obj"
    lines = [f"v {x} {y} {z}" for x, y, z in corners] + [f"f {i + 1} {j + 1} {k + 1}" for i, j, k in triangles]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return f"<mesh><file_name>{path}</file_name><scale>1 1 1</scale></mesh>"


def cube(folder: Path) -> str:
    triangles = [t for a, b, c, d in CUBE_FACES for t in ((a, b, c), (a, c, d))]
    return mesh(folder, "cube", CUBE, triangles)


def sheet(folder: Path, cells: int = 24, size: float = 0.5) -> str:
    """A flat floor of triangles at y = 0, an uneven grid whose diagonals alternate."""
    rng = np.random.default_rng(2)
    at = [size * (np.arange(cells + 1) - cells / 2 + rng.uniform(-0.3, 0.3, cells + 1)) for _ in range(2)]
    corners = [(float(x), 0.0, float(z)) for x in at[0] for z in at[1]]
    triangles: list[Triangle] = []
    for i in range(cells):
        for j in range(cells):
            a, b, c, d = (p * (cells + 1) + q for p, q in ((i, j), (i, j + 1), (i + 1, j + 1), (i + 1, j)))
            triangles += [(a, b, c), (a, c, d)] if (i + j) % 2 else [(a, b, d), (b, c, d)]
    return mesh(folder, "sheet", corners, triangles)


def fixed(shape: str) -> str:
    return skeleton(body_of("ground", shape=shape), joint_of("weld", "ground", name="weld"), name="ground")


def native(folder: Path, *skeletons: str, dt: float = 0.001) -> pydart2.World:
    world = make_world(folder, *skeletons, dt=dt)
    world.set_collision_detector("native")
    return world


def test_a_mesh_of_a_cube_is_a_cube(tmp_path: Path) -> None:
    rng = np.random.default_rng(4)
    worlds = [
        native(tmp_path, free_body("a", shape=s), free_body("b", shape=s)) for s in (cube(tmp_path), box((1, 1, 1)))
    ]
    for _ in range(40):
        first, second = rng.normal(size=6), rng.normal(size=6)
        second[3:] = first[3:] + rng.uniform(-0.9, 0.9, 3)
        depths = []
        for world in worlds:
            world.skeletons[0].q, world.skeletons[1].q = first, second
            world.check_collision()
            depths.append(max((c.depth for c in world.collision_result.contacts), default=-1))
        assert depths[0] == pytest.approx(depths[1], abs=2e-3)  # faces come first for boxes, by 1 in 1000


SLIDING = {
    "box": (box((0.6, 0.4, 0.5)), 0.2, 0.02),
    "cylinder": ("<cylinder><radius>0.3</radius><height>0.4</height></cylinder>", 0.2, 0.02),
    "mesh": ("", 0.5, 0.2),
}


@pytest.mark.parametrize("name", SLIDING)
def test_what_slides_over_triangles_keeps_its_direction(tmp_path: Path, name: str) -> None:
    shape, low, moment = SLIDING[name]
    turn = np.pi / 2 if name == "cylinder" else 0.0
    mover = free_body(at=(-4, low, -2, turn, 0, 0), shape=shape or cube(tmp_path), inertia=(moment,) * 3)
    world = native(tmp_path, fixed(sheet(tmp_path)), mover)
    for skel in world.skeletons:
        skel.bodynodes[0].set_friction_coeff(0.0)
    way = np.array([3.0, 0.0, 1.7])
    skel = world.skeletons[1]
    start = skel.bodynodes[0].C
    skel.dq = [0, 0, 0, *(skel.bodynodes[0].T[:3, :3].T @ way)]
    world.step(2000)
    gone = skel.bodynodes[0].C - start
    np.testing.assert_allclose(gone / np.linalg.norm(gone), way / np.linalg.norm(way), atol=1e-3)
    np.testing.assert_allclose(np.linalg.norm(gone), 2 * np.linalg.norm(way), rtol=1e-3)
    assert np.abs(skel.dq[:3]).max() < 1e-3


def test_a_ball_rolls_straight_over_triangles(tmp_path: Path) -> None:
    ball = free_body(at=(-4, 0.3, -2, 0, 0, 0), shape=sphere(0.3), inertia=(0.036,) * 3)
    world = native(tmp_path, fixed(sheet(tmp_path)), ball)
    skel, way = world.skeletons[1], np.array([3.0, 0.0, 1.7])
    skel.dq = [*(np.cross((0, 1, 0), way) / 0.3), *way]
    start = skel.bodynodes[0].C
    world.step(2000)
    gone = skel.bodynodes[0].C - start
    np.testing.assert_allclose(gone / np.linalg.norm(gone), way / np.linalg.norm(way), atol=1e-3)
    np.testing.assert_allclose(np.linalg.norm(gone), 2 * np.linalg.norm(way), rtol=5e-3)


def bowl(folder: Path) -> str:
    """A ring of eight wedges around a flat middle: not convex."""
    corners, triangles = [(0.0, 0.0, 0.0)], []
    for radius, height in ((1.0, 0.0), (2.0, 1.0)):
        corners += [(radius * np.cos(a), height, radius * np.sin(a)) for a in np.arange(8) * np.pi / 4]
    for i in range(8):
        a, b = 1 + i, 1 + (i + 1) % 8
        triangles += [(0, b, a), (a, b, b + 8), (a, b + 8, a + 8)]
    return mesh(folder, "bowl", corners, triangles)


@pytest.mark.parametrize("kind", ["box", "sphere", "capsule", "cube"])
def test_a_bowl_holds_what_falls_in(tmp_path: Path, kind: str) -> None:
    shapes = {"box": box((0.5, 0.4, 0.3)), "sphere": sphere(0.25), "cube": cube(tmp_path)}
    shapes["capsule"] = "<capsule><radius>0.15</radius><height>0.3</height></capsule>"
    faller = free_body(
        at=(0.6, 1.6, 0.4, 0.5, 0.3, 0.2), shape=shapes[kind], inertia=(0.02 if kind != "cube" else 0.17,) * 3
    )
    world = native(tmp_path, fixed(bowl(tmp_path)), faller, dt=0.002)
    world.skeletons[1].bodynodes[0].set_friction_coeff(0.5)
    world.step(1500)
    x, y, z = world.skeletons[1].bodynodes[0].C
    assert np.hypot(x, z) < 1.6
    assert 0.1 < y < 1.0
    world.check_collision()
    contacts = world.collision_result.contacts
    assert contacts
    assert max(contact.depth for contact in contacts) < 0.005


def test_meshes_collide_with_each_other(tmp_path: Path) -> None:
    """A bowl in a bowl on a floor, neither convex: they touch where their corners do, and do not fall through."""
    lower = free_body("lower", at=(0, 0.01, 0, 0, 0, 0), shape=bowl(tmp_path), inertia=(1,) * 3)
    world = native(tmp_path, floor(), lower, dt=0.002)
    world.step(500)
    assert abs(world.skeletons[1].bodynodes[0].T[1, 3]) < 0.005
    other = native(
        tmp_path, fixed(bowl(tmp_path)), free_body(at=(0, 0.05, 0, 0, 0.2, 0), shape=bowl(tmp_path)), dt=0.002
    )
    other.step(300)
    assert other.collision_result.num_contacts() >= 3
    assert 0 < other.skeletons[1].bodynodes[0].T[1, 3] < 0.2
    assert np.abs(other.skeletons[1].dq).max() < 2e-3  # the engine lifts what is deep by 1 mm/s
