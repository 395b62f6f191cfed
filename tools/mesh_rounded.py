"""Rounded solids for bodies and housings; each is a loft along an axis."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from mesh import Mesh, Point, loft, oval

Level = tuple[float, float, float, float, float]  # height, then the centre and the half widths in the two other axes

DOME = np.radians((75.0, 50.0, 25.0))  # where a domed end has its rings


def _scaled(level: Level, rise: float, angle: float) -> Level:
    height, u, v, half_u, half_v = level
    shrink = float(np.cos(angle))
    return height + rise * float(np.sin(angle)), u, v, half_u * shrink, half_v * shrink


def limb(
    material: str,
    levels: Sequence[Level],
    ends: tuple[float, float] = (0.0, 0.0),
    axis: str = "z",
    power: float = 2.3,
    n: int = 16,
) -> Mesh:
    """A solid with given cross sections; its first and last end may bulge by a length to a dome."""
    first, last = ends
    sign = 1.0 if levels[-1][0] >= levels[0][0] else -1.0
    low = [_scaled(levels[0], -sign * first, float(a)) for a in DOME] if first else []
    high = [_scaled(levels[-1], sign * last, float(a)) for a in DOME[::-1]] if last else []
    rings = [*low, *levels, *high]
    return loft(material, axis, ((h, oval(u, v, hu, hv, power, n)) for h, u, v, hu, hv in rings))


def ball(material: str, centre: Point, radii: Point, n: int = 12) -> Mesh:
    """An ellipsoid, closed by a small flat at each pole."""
    x, y, z = centre
    rx, ry, rz = radii
    angles = np.radians(np.linspace(-80.0, 80.0, n // 2 + 1))
    rings = zip(np.sin(angles), np.cos(angles))
    return loft(material, "z", ((z + rz * s, oval(x, y, rx * c, ry * c, 2.0, n)) for s, c in rings))


def drum(
    material: str,
    axis: str,
    low: float,
    high: float,
    centre: tuple[float, float],
    radius: float,
    bevel: float = 0.004,
    n: int = 24,
) -> Mesh:
    """A round disc or cylinder with bevelled rims."""
    u, v = centre
    rings = ((low, radius - bevel), (low + bevel, radius), (high - bevel, radius), (high, radius - bevel))
    return loft(material, axis, ((h, oval(u, v, r, r, 2.0, n)) for h, r in rings))


def shell(
    material: str,
    low: Point,
    high: Point,
    bevel: float = 0.015,
    power: float = 6.0,
    n: int = 32,
) -> Mesh:
    """A box with round vertical edges and bevelled rims."""
    (u, v), (hu, hv) = ((low[i] + high[i]) / 2.0 for i in (0, 1)), ((high[i] - low[i]) / 2.0 for i in (0, 1))
    rings = ((low[2], bevel), (low[2] + bevel, 0.0), (high[2] - bevel, 0.0), (high[2], bevel))
    return loft(material, "z", ((h, oval(u, v, hu - inset, hv - inset, power, n)) for h, inset in rings))


def library_text(title: str, colours: Iterable[tuple[str, Point]]) -> str:
    """Wavefront MTL text: a matt colour for each material."""
    lines = [f"# {title}"]
    for name, colour in colours:
        rgb = " ".join(f"{v:.12g}" for v in colour)
        lines += ["", f"newmtl {name}", f"Ka {rgb}", f"Kd {rgb}", "Ks 0.15 0.15 0.15", "Ns 20"]
    return "\n".join(lines) + "\n"
