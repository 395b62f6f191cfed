"""Pictures and videos without a display.

Colours, distances along the optical axis, which body is at which pixel, and a clip. Nothing here needs a screen.
"""

from collections.abc import Mapping
from pathlib import Path

import numpy as np
from _headless import arguments, finish
from numpy.typing import NDArray
from PIL import Image

import pydart2 as pydart

EYE = np.array([0.0, 0.0, 1.0])  # m; it looks along -z, at the cubes
SIZE = 480, 360


def shades(depth: NDArray[np.float32], nearest: float, furthest: float) -> NDArray[np.uint8]:
    """Distances as a grey picture: near is bright, the background black."""
    grey = np.clip((furthest - depth) / (furthest - nearest), 0.0, 1.0)
    return np.repeat((255 * grey)[:, :, np.newaxis], 3, axis=2).astype(np.uint8)


def colours(segmentation: NDArray[np.int32]) -> NDArray[np.uint8]:
    """A colour for each skeleton, black for none."""
    palette = np.array([[200, 200, 200], [214, 39, 40], [44, 160, 44], [255, 187, 40], [0, 0, 0]], dtype=np.uint8)
    return palette[segmentation[:, :, 0]]  # -1 is the last colour


def check(depth: NDArray[np.float32], segmentation: NDArray[np.int32], cube: pydart.Skeleton) -> Mapping[str, bool]:
    """The picture's depth of the first cube is the distance from the eye to its front."""
    skeletons = sorted(set(segmentation[:, :, 0].ravel().tolist()))
    front = EYE[2] - (cube.C[2] + 0.025)  # it is 0.05 m wide
    seen = float(np.median(depth[segmentation[:, :, 0] == cube.id]))
    return {
        f"the picture shows the background, the ground and three cubes: {skeletons}": skeletons == [-1, 0, 1, 2, 3],
        f"the green cube is {seen:.4f} m away, by its position {front:.4f} m": abs(seen - front) < 1e-3,
    }


if __name__ == "__main__":
    args = arguments()
    folder = args.output or Path("pictures")
    folder.mkdir(parents=True, exist_ok=True)
    world = pydart.World(1.0 / 2000.0, "./data/skel/cubes.skel")

    # A video: the ending says the kind; .mp4 needs pip install 'pydart2[video]'
    camera = pydart.gui.Camera.look_at(eye=EYE, target=[0.0, -0.25, 0.0], up=[0.0, 1.0, 0.0])
    pydart.gui.record(world, folder / "headless_video.webp", seconds=1.5, fps=25, size=(480, 360), camera=camera)

    # Pictures as arrays. The eye may also be a pose, here without rotation, and a vertical field of view
    pose = np.eye(4)
    pose[:3, 3] = EYE - np.array([0.0, 0.25, 0.0])
    rgb = pydart.gui.render(world, *SIZE, camera=(pose, 0.5))
    depth = pydart.gui.render(world, *SIZE, camera=(pose, 0.5), mode="depth")
    segmentation = pydart.gui.render(world, *SIZE, camera=(pose, 0.5), mode="segmentation")
    for name, array in {"rgb": rgb, "depth": depth, "segmentation": segmentation}.items():
        print(f"{name}: {array.shape} {array.dtype}")

    picture = np.concatenate([rgb, shades(depth, 0.7, 1.3), colours(segmentation)], axis=1)
    Image.fromarray(picture).save(folder / "headless_video.png")
    print(f"saved {folder / 'headless_video.*'}")
    finish(args, 0, lambda: check(depth, segmentation, world.skeletons[2]))
