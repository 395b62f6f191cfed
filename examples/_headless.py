"""What the examples share: their options, and a run without a window that checks what an example claims.

python examples/biped_jump.py                          in a window
python examples/biped_jump.py --headless               without one; the exit status is 1 if the claim is wrong
python examples/biped_jump.py --headless --output DIR  the same, with a picture and a clip in DIR
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np

import pydart2 as pydart
from pydart2.gui.first_look import floor_of, look
from pydart2.utils.progress import progress

#: What an example claims, in sentences with the measured figures, and whether each holds.
Check = Callable[[], Mapping[str, bool]]

PICTURE = (640, 480)  # pixels
RATE = 25  # pictures in a second of the clip


def arguments(model: bool = False) -> argparse.Namespace:
    """The options of the command line; `model` is the path of one, None if it is missing."""
    script = sys.modules["__main__"]
    parser = argparse.ArgumentParser(description=script.__doc__)
    if model:
        parser.add_argument("model", nargs="?", help="a URDF or SDF file")
    parser.add_argument("--headless", action="store_true", help="simulate without a window, and check the claim")
    parser.add_argument("--steps", type=int, help="how many steps; default: as many as the claim needs")
    parser.add_argument("--output", type=Path, metavar="DIR", help="where to put a picture and a clip")
    args = parser.parse_args()
    if not args.headless and (args.steps is not None or args.output is not None):
        parser.error("--steps and --output are for --headless")
    if args.headless:
        np.random.seed(0)  # the same run each time
    return args


def rehearse(
    world: pydart.World,
    args: argparse.Namespace,
    steps: int,
    check: Check | None = None,
    camera: Any = 0,
    keys: Mapping[int, str] | None = None,
    every: int | None = None,
) -> None:
    """Simulate without a window; check the claim; save the last picture and a clip.

    Parameters
    ----------
    steps
        As many as the claim needs; `--steps` overrides it.
    camera
        As of `pydart2.gui.render`: 0 is Y up, 1 is Z up. None: one that sees the world as it is now,
        and stays; then a floor is drawn.
    keys
        Step → the key that a user would press before it.
    every
        Steps from picture to picture of the clip; default: real time.
    """
    clip = Clip(world, args, camera, every or max(1, round(1.0 / (RATE * world.dt))))
    user: Any = world
    for i in progress(range(args.steps if args.steps is not None else steps), Path(sys.argv[0]).stem):
        clip.look(i)
        if keys and i in keys:
            user.on_key_press(keys[i])
        if hasattr(user, "on_step_event"):
            user.on_step_event()
        world.step()
    clip.save()
    finish(args, steps, check)


def finish(args: argparse.Namespace, steps: int, check: Check | None) -> None:
    """Print what holds of the claim; end the process with status 1 if something does not."""
    if check is None:
        return
    if args.steps is not None and args.steps < steps:
        print(f"not checked: that takes {steps} steps")
        return
    claims = check()
    for text, holds in claims.items():
        print(f"{'ok' if holds else 'WRONG'}: {text}")
    if not all(claims.values()):
        sys.exit(1)


class Clip:
    """The pictures of a run, if `--output` asks for them."""

    def __init__(self, world: pydart.World, args: argparse.Namespace, camera: Any = 0, every: int = 1) -> None:
        self.world, self.folder, self.camera, self.every = world, args.output, camera, every
        self.pictures: list[Any] = []
        if camera is None:
            self.camera = look(world, PICTURE[0] / PICTURE[1])
        if self.folder is not None:
            self.renderer = pydart.gui.OffscreenRenderer(*PICTURE)
            if camera is None:
                self.renderer.scene.show.floor = floor_of(world)

    def look(self, step: int) -> None:
        """Take a picture before a step if it is time."""
        if self.folder is not None and step % self.every == 0:
            self.pictures.append(self.renderer.render(self.world, camera=self.camera))

    def save(self) -> None:
        """Save the last picture as png, and all as webp, under the example's name."""
        if self.folder is None:
            return
        from PIL import Image

        from pydart2.gui.capture import write_movie

        self.look(0)
        self.folder.mkdir(parents=True, exist_ok=True)
        path = self.folder / Path(sys.argv[0]).stem
        Image.fromarray(self.pictures[-1]).save(path.with_suffix(".png"))
        if len(self.pictures) > 1:
            write_movie(path.with_suffix(".webp"), self.pictures, RATE)
        print(f"saved {path.with_suffix('.*')}")
