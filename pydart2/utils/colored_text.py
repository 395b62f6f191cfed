"""Text in colour for terminals, by ANSI codes: ``print(red("no"))``.

The spelling "yello" is the API. ``cyan`` is bright, the same as ``bright_cyan``.
"""

from __future__ import annotations

from collections.abc import Callable

_RESET = "\x1b[0m"
_BRIGHT = "\x1b[1m"
_DIM = "\x1b[2m"


def _painter(name: str, number: int, style: str = "") -> Callable[[str], str]:
    def paint(txt: str) -> str:
        return f"{style}\x1b[{number}m{txt}{_RESET}"

    paint.__name__ = paint.__qualname__ = name
    paint.__doc__ = f"The text between the codes for {name.replace('_', ' ').replace('yello', 'yellow')} and for reset."
    return paint


red = _painter("red", 31)
green = _painter("green", 32)
yello = _painter("yello", 33)
blue = _painter("blue", 34)
magenta = _painter("magenta", 35)
cyan = _painter("cyan", 36, _BRIGHT)

bright_red = _painter("bright_red", 31, _BRIGHT)
bright_green = _painter("bright_green", 32, _BRIGHT)
bright_yello = _painter("bright_yello", 33, _BRIGHT)
bright_blue = _painter("bright_blue", 34, _BRIGHT)
bright_magenta = _painter("bright_magenta", 35, _BRIGHT)
bright_cyan = _painter("bright_cyan", 36, _BRIGHT)

dim_red = _painter("dim_red", 31, _DIM)
dim_green = _painter("dim_green", 32, _DIM)
dim_yello = _painter("dim_yello", 33, _DIM)
dim_blue = _painter("dim_blue", 34, _DIM)
dim_magenta = _painter("dim_magenta", 35, _DIM)
dim_cyan = _painter("dim_cyan", 36, _DIM)
