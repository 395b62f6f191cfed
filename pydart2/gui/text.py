"""Letters as pictures, drawn by Pillow from the font that comes with it."""

from __future__ import annotations

import sys
import unicodedata
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

# What Pillow's own font has, and what is shown in place of what is often wanted beside it.
_CHARACTERS = "".join(map(chr, range(32, 127)))
_INSTEAD = str.maketrans(dict(zip("–—‘’“”•×μ", "--''\"\"*xu")) | {"°": " deg", "…": "...", "²": "^2", "³": "^3"})
_COLUMNS = 16
_SIZES = {
    "GLUT_BITMAP_9_BY_15": 15,
    "GLUT_BITMAP_8_BY_13": 13,
    "GLUT_BITMAP_TIMES_ROMAN_10": 10,
    "GLUT_BITMAP_TIMES_ROMAN_24": 24,
    "GLUT_BITMAP_HELVETICA_10": 10,
    "GLUT_BITMAP_HELVETICA_12": 12,
    "GLUT_BITMAP_HELVETICA_18": 18,
}


class Glyph(NamedTuple):
    """Where a letter is in the picture of the atlas, and how far the next one is, pixels."""

    x: int
    y: int
    advance: float


@dataclass(frozen=True)
class Atlas:
    """The letters of a size.

    Attributes
    ----------
    pixels : (h, w, 4) uint8
        White, covered by alpha; row 0 on top.
    cell : (width, height)
        Of each letter, pixels.
    ascent : int
        Pixels from the top of a cell to the baseline.
    glyphs : dict
        Letter → Glyph.
    """

    pixels: NDArray[np.uint8]
    cell: tuple[int, int]
    ascent: int
    glyphs: dict[str, Glyph]

    def width(self, text: str) -> float:
        """Of a line of text, pixels."""
        return sum(self.glyphs[letter].advance for letter in plain(text))


def plain(line: str) -> str:
    """A line in the letters of the font: accents are left out, what is not known becomes a question mark."""
    letters = unicodedata.normalize("NFKD", line.translate(_INSTEAD)).translate(_INSTEAD)
    return "".join(c if c in _CHARACTERS else "?" for c in letters if not unicodedata.combining(c))


@lru_cache(maxsize=16)
def atlas(size: int) -> Atlas:
    """The letters of a height in pixels."""
    from PIL import Image, ImageDraw, ImageFont

    font = ImageFont.load_default(size)
    ascent, descent = font.getmetrics()  # type: ignore[union-attr]
    cell = (int(max(font.getlength(c) for c in _CHARACTERS)) + 3, ascent + descent + 2)
    rows = -(-len(_CHARACTERS) // _COLUMNS)
    picture = Image.new("L", (_COLUMNS * cell[0], rows * cell[1]))
    draw, glyphs = ImageDraw.Draw(picture), {}
    for i, letter in enumerate(_CHARACTERS):
        x, y = (i % _COLUMNS) * cell[0], (i // _COLUMNS) * cell[1]
        draw.text((x + 1, y + 1), letter, fill=255, font=font)
        glyphs[letter] = Glyph(x, y, font.getlength(letter))
    pixels = np.full((*picture.size[::-1], 4), 255, np.uint8)
    pixels[:, :, 3] = np.asarray(picture)
    return Atlas(pixels, cell, ascent + 1, glyphs)


def size_of(font: Any) -> int:
    """Pixels of a font: a number, or one of GLUT's bitmap fonts; 18 for any other."""
    if isinstance(font, (int, np.integer)) and 6 <= font <= 400:
        return int(font)
    glut = sys.modules.get("OpenGL.GLUT")  # who has one of its fonts has imported it
    for name, size in _SIZES.items():
        if font == name or (font is not None and font is getattr(glut, name, None)):
            return size
    return 18
