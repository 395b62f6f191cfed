"""Time of a picture, beside the `mujoco` package: python benchmarks/rendering.py. Needs `pip install mujoco`.

60 meshes with 100,320 triangles in all over a floor, 640 by 480, no anti-aliasing, with a shadow map of 1024 by 1024
and without; both draw the same triangles, turn by turn. Then Atlas, standing. Prints ms (medians) and their ratio.
"""

from __future__ import annotations

import os
import statistics
import sys
import time
from collections.abc import Callable

os.environ.setdefault("MUJOCO_GL", "egl")

import numpy as np
from PIL import Image

import pydart2
from pydart2.gui import Camera, OffscreenRenderer, drawing, geometry
from pydart2.gui.draw_list import Scene

try:
    import mujoco
except ImportError:
    sys.exit("this benchmark compares with MuJoCo's renderer: pip install mujoco")

WIDTH, HEIGHT, ROUNDS = 640, 480, 60
EYE, TARGET, FOV = np.array([0.0, -5.0, 3.4]), np.array([0.0, 0.2, 0.2]), 45.0
PLACES = [np.array([0.55 * column - 2.475, 0.6 * row - 1.5, 0.35]) for row in range(6) for column in range(10)]


def vase(seed: int) -> geometry.Mesh:
    """A closed surface of revolution with 1672 triangles; each seed gives another."""
    rng = np.random.default_rng(seed)
    t = np.linspace(0.0, np.pi, 24)
    radii = 0.22 * np.sin(t) * (1.0 + 0.25 * np.sin(rng.integers(2, 7) * t + rng.uniform(0.0, 6.0)))
    radii[[0, -1]] = 0.0
    surface = geometry.revolve(list(radii), list(-0.3 * np.cos(t)), [(1.0, 0.0)] * 24, 38)
    return geometry.mesh(surface.vertices, surface.triangles)


MESHES = [vase(seed) for seed in range(len(PLACES))]
COLORS = np.random.default_rng(1).uniform(0.3, 0.9, (len(PLACES), 3))


class Ours:
    """The scene for `OffscreenRenderer`; described anew for every picture, as a world's is."""

    def render(self) -> None:
        scene = Scene((0.0, 0.0, 1.0))
        scene.add_ground(0.0, 12.0)
        pose = np.eye(4)
        for mesh, place, color in zip(MESHES, PLACES, COLORS):
            pose[:3, 3] = place
            scene.add(mesh, pose, 1.0, color)
        drawing.draw(scene)


def ours(shadows: bool) -> Callable[[], np.ndarray]:
    renderer = OffscreenRenderer(WIDTH, HEIGHT, samples=0)
    renderer.scene.style.shadows = shadows
    camera = Camera.look_at(EYE, TARGET, (0.0, 0.0, 1.0), np.radians(FOV))
    return lambda: renderer.render(Ours(), camera=camera)


def theirs(shadows: bool) -> Callable[[], np.ndarray]:
    spec = mujoco.MjSpec()
    spec.visual.quality.shadowsize, spec.visual.quality.offsamples = 1024, 0
    spec.visual.global_.fovy = FOV
    spec.worldbody.add_light(
        type=mujoco.mjtLightType.mjLIGHT_DIRECTIONAL, pos=[2, -2, 4], dir=[-0.45, 0.6, -1], castshadow=True
    )
    checker, flat = mujoco.mjtBuiltin.mjBUILTIN_CHECKER, mujoco.mjtTexture.mjTEXTURE_2D
    spec.add_texture(name="grid", type=flat, builtin=checker, rgb1=[0.8] * 3, rgb2=[0.75] * 3, width=256, height=256)
    floor = spec.add_material(name="floor", texrepeat=[6, 6], rgba=[1, 1, 1, 1])
    floor.textures[mujoco.mjtTextureRole.mjTEXROLE_RGB] = "grid"
    spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_PLANE, size=[6, 6, 0.1], material="floor")
    for i, (mesh, place, color) in enumerate(zip(MESHES, PLACES, COLORS)):
        vertices, faces = mesh.vertices.reshape(-1), mesh.triangles.reshape(-1).astype(np.int32)
        spec.add_mesh(name=f"m{i}", uservert=vertices.tolist(), userface=faces.tolist())
        kind = mujoco.mjtGeom.mjGEOM_MESH
        spec.worldbody.add_geom(type=kind, meshname=f"m{i}", pos=place, rgba=[*color, 1.0])
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    renderer = mujoco.Renderer(model, HEIGHT, WIDTH)
    camera = mujoco.MjvCamera()
    offset = TARGET - EYE
    camera.lookat[:], camera.distance = TARGET, np.linalg.norm(offset)
    camera.azimuth = np.degrees(np.arctan2(offset[1], offset[0]))
    camera.elevation = np.degrees(np.arcsin(offset[2] / camera.distance))

    def picture() -> np.ndarray:
        renderer.update_scene(data, camera)
        renderer.scene.flags[mujoco.mjtRndFlag.mjRND_SHADOW] = shadows
        renderer.scene.flags[mujoco.mjtRndFlag.mjRND_REFLECTION] = False
        return renderer.render()

    return picture


def standing_atlas() -> Callable[[], np.ndarray]:
    world = pydart2.World(0.001)
    world.set_gravity([0.0, 0.0, -9.81])
    world.add_skeleton(pydart2.data_path("sdf/atlas/atlas_v3_no_head.sdf"))
    renderer = OffscreenRenderer(WIDTH, HEIGHT, samples=0)
    return lambda: renderer.render(world, camera=1)


def medians(*draw: Callable[[], np.ndarray]) -> list[tuple[float, float]]:
    """ms of each, called in turn: by the clock, and of all cores together."""
    times: list[list[tuple[float, float]]] = [[] for _ in draw]
    for round_number in range(ROUNDS + 5):
        for function, spent in zip(draw, times):
            start, used = time.perf_counter(), time.process_time()
            function()
            if round_number >= 5:
                spent.append((1000.0 * (time.perf_counter() - start), 1000.0 * (time.process_time() - used)))
    return [tuple(map(statistics.median, zip(*spent))) for spent in times]


def main() -> None:
    triangles = sum(len(mesh.triangles) for mesh in MESHES)
    print(f"{len(MESHES)} meshes, {triangles} triangles, {WIDTH} by {HEIGHT}, no anti-aliasing")
    for shadows, bar in ((True, 1.0), (False, 1.4)):
        draw = ours(shadows), theirs(shadows)
        if len(sys.argv) > 1:
            for name, function in zip(("pydart2", "mujoco"), draw):
                Image.fromarray(function()).save(f"{sys.argv[1]}/{name}-{'shadows' if shadows else 'plain'}.png")
        mine, other = medians(*draw)
        print(f"  {'with' if shadows else 'without'} shadows (bar {bar})")
        for i, kind in enumerate(("by the clock", "of all cores")):
            print(f"    {kind}: pydart2 {mine[i]:6.1f} ms, mujoco {other[i]:6.1f} ms, ratio {mine[i] / other[i]:.2f}")
    ((clock, cores),) = medians(standing_atlas())
    print(f"Atlas, standing, with shadows: {1000.0 / clock:.0f} pictures/s (bar 30)")
    print(f"    by the clock: {clock:.1f} ms, of all cores: {cores:.1f} ms")


if __name__ == "__main__":
    main()
