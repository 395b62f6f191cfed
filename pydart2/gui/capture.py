"""Numbered pictures in a folder, and movies of them."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

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
    """Write pictures of shape (H, W, 3), uint8, as a movie with `rate` pictures a second, as MovieWriter does.

    Raises
    ------
    PydartError
        If PyAV is wanted and not installed, or there are no pictures.
    """
    writer = MovieWriter(path, rate)
    try:
        for picture in pictures:
            writer.add(picture)
    finally:
        writer.close()
    if writer.count == 0:
        raise PydartError(f"no pictures for {os.fspath(path)}")


class MovieWriter:
    """A movie that grows by pictures of shape (H, W, 3), uint8; the file is whole after close().

    The ending says the kind: mp4 and others with PyAV; gif, webp and png (animated) with Pillow, which needs the memory
    of all pictures. Without a picture there is no file.

    Attributes
    ----------
    count : int
        How many pictures there are.

    Raises
    ------
    PydartError
        If PyAV is wanted and not installed.
    """

    def __init__(self, path: str | os.PathLike[str], fps: float) -> None:
        self.path, self.fps, self.count = os.fspath(path), fps, 0
        self._images: list[Any] = []
        self._container: Any = None
        self._av: Any = None if Path(path).suffix.lower() in (".gif", ".webp", ".png") else _import_av()

    def add(self, picture: Picture) -> None:
        """Add a picture; pictures of another size than the first are brought to it."""
        if self._av is not None:
            self._encode(picture)
        else:
            from PIL import Image

            self._images.append(Image.fromarray(picture))
        self.count += 1

    def close(self) -> None:
        """Write what is left."""
        if self._container is not None:
            self._container.mux(self._stream.encode())
            self._container.close()
            self._container = None
        elif self._images:
            first, *rest = self._images
            duration = round(1000.0 / self.fps)
            first.save(self.path, save_all=True, append_images=rest, duration=duration, loop=0)
            self._images = []

    def _encode(self, picture: Picture) -> None:
        height, width = (side - side % 2 for side in picture.shape[:2])  # H.264 halves the colours' resolution
        if self._container is None:
            from fractions import Fraction

            self._container = self._av.open(self.path, "w")
            self._stream = self._container.add_stream("libx264", rate=Fraction(self.fps).limit_denominator(1000))
            self._stream.width, self._stream.height, self._stream.pix_fmt = width, height, "yuv420p"
        frame = self._av.VideoFrame.from_ndarray(picture, format="rgb24")
        if picture.shape[:2] != (self._stream.height, self._stream.width):  # odd, or a window has changed its size
            frame = frame.reformat(self._stream.width, self._stream.height)
        self._container.mux(self._stream.encode(frame))


def _import_av() -> Any:
    try:
        import av
    except ImportError:
        raise PydartError("mp4 movies need PyAV: pip install 'pydart2[video]'; or write a .gif") from None
    return av
