"""Worlds share what was imported from mesh files and FCL's trees of triangles, and nothing else of their shapes."""

from __future__ import annotations

import os
import pickle
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import pydart2
from pydart2 import World

STL = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
LINK = (
    '<robot name="{name}"><link name="{name}"><inertial><mass value="1"/>'
    '<inertia ixx="0.4" iyy="0.4" izz="0.4" ixy="0" ixz="0" iyz="0"/></inertial>'
    "<visual>{shape}</visual><collision>{shape}</collision></link></robot>"
)
FLOOR = LINK.format(name="floor", shape="<geometry><box size='100 100 1'/></geometry>")


def ball(path: Path, radius: float = 1.0, rings: int = 12) -> Path:
    """A ball of triangles, of 4 * rings^2."""
    polar, around = np.linspace(0, np.pi, rings + 1), np.linspace(0, 2 * np.pi, 2 * rings + 1)
    x, y = np.outer(np.sin(polar), np.cos(around)), np.outer(np.sin(polar), np.sin(around))
    grid = radius * np.stack([x, y, np.outer(np.cos(polar), np.ones_like(around))], axis=-1)
    a, b, c, d = grid[:-1, :-1], grid[1:, :-1], grid[1:, 1:], grid[:-1, 1:]
    triangles = np.zeros(4 * rings**2, STL)
    triangles["corners"] = np.concatenate([np.stack(t, axis=2).reshape(-1, 3, 3) for t in ((a, b, c), (a, c, d))])
    path.write_bytes(bytes(80) + np.uint32(len(triangles)).tobytes() + triangles.tobytes())
    return path


def ball_world(path: Path, scale: str = "1 1 1") -> World:
    """A ball on the floor."""
    world = World(0.001)
    world.g = [0, 0, -9.81]
    world.add_skeleton(FLOOR).set_mobile(False)
    shape = f'<geometry><mesh filename="{path}" scale="{scale}"/></geometry>'
    robot = world.add_skeleton(LINK.format(name="ball", shape=shape))
    robot.q = [0.3, 0.2, 0.1, 0, 0, 1.499]
    return world


def mesh_of(world: World) -> Any:
    """The ball's mesh, from which a viewer draws."""
    return world.skeletons[1].bodynodes[0].shapenodes[0].shape._handle.mesh(0)  # type: ignore[union-attr]


def radius_of(world: World) -> float:
    return float(np.linalg.norm(mesh_of(world).vertices(), axis=1).max())


def touches(world: World) -> bool:
    """Whether the ball reaches 0.1 m below its own radius of 1 m."""
    world.skeletons[1].q = [0, 0, 0, 0, 0, 1.6]
    world.check_collision()
    return world.collision_result.num_contacts() > 0


@pytest.mark.parametrize("detector", ["FCL", "BULLET", "ODE"])
def test_worlds_with_one_file_go_separate_ways(tmp_path: Path, detector: str) -> None:
    """Loaded, cloned and pickled worlds do what a world alone does, whatever becomes of the others."""
    path = ball(tmp_path / "ball.stl")
    number = getattr(World, f"{detector}_COLLISION_DETECTOR")
    first = ball_world(path)
    first.set_collision_detector(number)
    start = first.clone().x
    first.step(200)
    worlds = [first.clone(), pickle.loads(pickle.dumps(first)), first.clone()]
    first.step(100)
    assert first.collision_result.num_contacts() > 0
    worlds[2].x = start
    worlds[2].step(3)
    end = first.x
    first.destroy()
    for world in worlds[:2]:
        world.step(100)
        np.testing.assert_array_equal(world.x, end)


def test_what_is_shared_outlives_the_world_that_read_it(tmp_path: Path) -> None:
    path = ball(tmp_path / "ball.stl")
    first = ball_world(path)
    clone = first.clone()
    assert radius_of(first) == pytest.approx(1)
    first.destroy()
    assert radius_of(clone) == pytest.approx(1)
    mesh = mesh_of(clone)
    clone.destroy()
    with pytest.raises(pydart2.DestroyedError):
        mesh.vertices()


def test_a_file_that_has_changed_is_not_shared(tmp_path: Path) -> None:
    """Each world keeps the mesh that it was loaded with."""
    first = ball_world(ball(tmp_path / "ball.stl"))
    ball(tmp_path / "ball.stl", radius=1.25)
    second = ball_world(tmp_path / "ball.stl")
    assert [radius_of(world) for world in (first, second)] == pytest.approx([1, 1.25])
    assert [touches(world) for world in (first, second)] == [False, True]


def test_materials_that_have_changed_are_not_shared(tmp_path: Path) -> None:
    """They may be in a file of their own, which may come later."""
    path = tmp_path / "board.obj"
    path.write_text("mtllib board.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl paint\nf 1 2 3\n", encoding="ascii")
    worlds = [ball_world(path)]
    for color in ("1 0 0", "0 1 0"):
        path.with_suffix(".mtl").write_text(f"newmtl paint\nKd {color}\n", encoding="ascii")
        worlds += [ball_world(path), worlds[-1].clone()]
    found = [tuple(mesh_of(world).diffuse()[:3]) for world in worlds]
    assert found[1:] == [(1, 0, 0), (1, 0, 0), (0, 1, 0), (0, 1, 0)] and found[0] not in found[1:]


def test_scales_are_not_shared(tmp_path: Path) -> None:
    path = ball(tmp_path / "ball.stl")
    worlds = [ball_world(path, scale) for scale in ("1 1 1", "1 1 1.25", "1 1 1")]
    assert [touches(world) for world in worlds] == [False, True, False]


MEMORY = """
import gc, os, sys
from pathlib import Path
sys.path.insert(0, sys.argv[1])
from unit.test_shared_meshes import FLOOR, LINK, World, ball, ball_world
folder, kind = Path(sys.argv[2]), sys.argv[3]

def resident():
    gc.collect()
    return int(Path("/proc/self/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 2**20

def cylinders(first):
    world = World(0.001)
    for i in range(first, first + 40):
        shape = f"<geometry><cylinder radius='{i + 1}' length='2'/></geometry>"
        world.add_skeleton(LINK.format(name=f"c{i}", shape=shape))
    return world

if kind == "mesh":
    few, path = ball_world(ball(folder / "few.stl", rings=4)), ball(folder / "many.stl", rings=100)
    load = lambda: ball_world(path)
else:
    few, load = cylinders(0), lambda: cylinders(40)
before = resident()
world = load()
first = resident() - before
world.clone()  # takes memory for a while, as all others do
before = resident()
worlds = [world.clone() for _ in range(5)] + [load() for _ in range(5)]
print(first, (resident() - before) / 10)
"""


@pytest.mark.skipif("ASAN_OPTIONS" in os.environ, reason="AddressSanitizer keeps what has been freed")
@pytest.mark.parametrize(("kind", "most"), [("mesh", 1.0), ("cylinders", 2.0)])
def test_worlds_with_equal_shapes_take_little_memory(tmp_path: Path, kind: str, most: float) -> None:
    """One with 40,000 triangles or 40 cylinders takes more than 10 MB, another one like it not much."""
    command = [sys.executable, "-c", MEMORY, str(Path(__file__).resolve().parents[1]), str(tmp_path), kind]
    done = subprocess.run(command, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr[-2000:]
    first, another = map(float, done.stdout.split())
    print(f"{kind}: {first:.1f} MB, {another:.2f} MB")
    assert first > 10 and another < most, (first, another)
