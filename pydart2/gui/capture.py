"""Numbered pictures in a folder, and movies of them."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from pydart2.errors import PydartError

Picture = NDArray[np.uint8]


class CaptureFolder:
    """Saves pictures as `name.0000.png`, `name.0001.png` … in a folder that it makes.

    Attributes
    ----------
    path : str
    index : int
        Number of the next picture.
    """

    def __init__(self, path: str | os.PathLike[str] = "data/captures") -> None:
        self.path = os.fspath(path)
        self.index = 0

    def next_path(self, name: str) -> Path:
        """Where the next picture goes; makes the folder."""
        Path(self.path).mkdir(parents=True, exist_ok=True)
        path = Path(self.path) / f"{name.replace('/', '_')}.{self.index:04d}.png"
        self.index += 1
        return path

    def pictures(self, name: str = "*") -> list[Path]:
        """The pictures of a name in order."""
        return sorted(Path(self.path).glob(f"{name.replace('/', '_')}.[0-9]*.png"))

    def empty(self) -> int:
        """Remove the pictures of the folder; returns how many."""
        pictures = self.pictures()
        for path in pictures:
            path.unlink()
        self.index = 0
        return len(pictures)

    def movie(self, name: str, rate: float) -> Path:
        """Make `name.mp4` of the pictures of a name, with `rate` of them a second; PydartError if there are none."""
        path = Path(self.path) / f"{name.replace('/', '_')}.mp4"
        write_movie(path, read_pictures(self.pictures(name)), rate)
        return path


def read_pictures(paths: Iterable[Path]) -> Iterator[Picture]:
    """Each picture, shape (H, W, 3), uint8."""
    from PIL import Image

    for path in paths:
        with Image.open(path) as image:
            yield np.asarray(image.convert("RGB"))


def write_movie(path: str | os.PathLike[str], pictures: Iterable[Picture], rate: float) -> None:
    """Write pictures of shape (H, W, 3), uint8, as a movie with `rate` pictures a second.

    The ending says the kind: mp4 and others with PyAV; gif, webp and png (animated) with Pillow.

    Raises
    ------
    PydartError
        If PyAV is wanted and not installed, or there are no pictures.
    """
    frames = iter(pictures)
    first = next(frames, None)
    if first is None:
        raise PydartError(f"no pictures for {os.fspath(path)}")
    if Path(path).suffix.lower() in (".gif", ".webp", ".png"):
        _write_with_pillow(path, first, frames, rate)
    else:
        _write_with_av(path, first, frames, rate)


def _write_with_pillow(path: str | os.PathLike[str], first: Picture, rest: Iterator[Picture], rate: float) -> None:
    from PIL import Image

    images = (Image.fromarray(picture) for picture in rest)
    Image.fromarray(first).save(path, save_all=True, append_images=images, duration=round(1000.0 / rate), loop=0)


def _write_with_av(path: str | os.PathLike[str], first: Picture, rest: Iterator[Picture], rate: float) -> None:
    from fractions import Fraction

    try:
        import av
    except ImportError:
        raise PydartError("mp4 movies need PyAV: pip install 'pydart2[video]'; or write a .gif") from None
    height, width = (side - side % 2 for side in first.shape[:2])  # H.264 halves the colours' resolution
    with av.open(os.fspath(path), "w") as container:
        stream = container.add_stream("libx264", rate=Fraction(rate).limit_denominator(1000))
        stream.width, stream.height, stream.pix_fmt = width, height, "yuv420p"
        for picture in _chain(first, rest):
            frame = av.VideoFrame.from_ndarray(picture, format="rgb24")
            if picture.shape != (height, width, 3):  # odd, or the window has changed its size
                frame = frame.reformat(width, height)
            container.mux(stream.encode(frame))
        container.mux(stream.encode())


def _chain(first: Picture, rest: Iterator[Picture]) -> Iterator[Picture]:
    yield first
    yield from rest
