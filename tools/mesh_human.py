"""The visual shapes of the humanoid: each body as a few rounded solids in the frame of the body.

Limbs are stated for the left side; the right side is their mirror image.  x points forward, y to the
left, z up; all frames are parallel in the zero pose.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from mesh import Mesh, both, box, loft, tube, turned
from mesh_rounded import ball, limb

MATERIALS = {  # red, green, blue of the diffuse colour
    "skin": (0.87, 0.67, 0.54),
    "lips": (0.72, 0.42, 0.38),
    "hair": (0.22, 0.14, 0.09),
    "eye": (0.95, 0.95, 0.95),
    "iris": (0.16, 0.20, 0.26),
    "shirt": (0.20, 0.42, 0.66),
    "belt": (0.20, 0.13, 0.09),
    "buckle": (0.70, 0.66, 0.52),
    "trousers": (0.24, 0.26, 0.32),
    "shoe": (0.33, 0.19, 0.11),
    "sole": (0.88, 0.87, 0.84),
}
SCAPULA = 53.99  # degrees by which the scapula leans outwards from the vertical


def pelvis() -> list[Mesh]:
    """Hips with a belt."""
    hips = [  # z, then the centre and the half widths in x and y
        (-0.09, 0.0, 0.0, 0.07, 0.1),
        (-0.06, -0.004, 0.0, 0.093, 0.145),
        (-0.02, -0.006, 0.0, 0.1, 0.158),
        (0.025, -0.002, 0.0, 0.092, 0.148),
        (0.05, 0.0, 0.0, 0.089, 0.142),
    ]
    belt = [(z, 0.0, 0.0, 0.0925, 0.1455) for z in (0.022, 0.05)]
    return [
        limb("trousers", hips, (0.03, 0.0), n=24),
        limb("belt", belt, n=24),
        box("buckle", (0.088, -0.019, 0.021), (0.0955, 0.019, 0.049), 0.002),
    ]


def abdomen() -> list[Mesh]:
    """Waist to ribs; the hem hides the joint above the belt."""
    levels = [
        (-0.01, 0.0, 0.0, 0.091, 0.143),
        (0.0, 0.0, 0.0, 0.093, 0.145),
        (0.06, 0.002, 0.0, 0.089, 0.136),
        (0.13, 0.005, 0.0, 0.094, 0.142),
        (0.2, 0.006, 0.0, 0.103, 0.154),
        (0.25, 0.004, 0.0, 0.107, 0.16),
    ]
    return [limb("shirt", levels, (0.0, 0.025), n=24)]


def spine() -> list[Mesh]:
    """Chest and shoulders up to the collar."""
    levels = [
        (-0.02, 0.004, 0.0, 0.107, 0.16),
        (0.03, 0.003, 0.0, 0.111, 0.164),
        (0.075, -0.001, 0.0, 0.105, 0.165),
        (0.11, -0.008, 0.0, 0.088, 0.15),
        (0.135, -0.013, 0.0, 0.07, 0.11),
        (0.155, -0.014, 0.0, 0.06, 0.074),
    ]
    collar = [(0.15, -0.013, 0.0, 0.064, 0.066), (0.172, -0.012, 0.0, 0.06, 0.061)]
    return [limb("shirt", levels, (0.02, 0.0), n=24), limb("shirt", collar, n=20)]


def face() -> list[Mesh]:
    """Eyes, brows, nose, mouth and ears."""
    nose = [(0.1035, 0.0, 0.12), (0.1125, 0.0, 0.095), (0.117, 0.0, 0.081), (0.104, 0.0, 0.07)]
    return [
        *both(ball("eye", (0.0935, 0.031, 0.112), (0.0122, 0.0145, 0.0085))),
        *both(ball("iris", (0.1037, 0.0315, 0.112), (0.0028, 0.0058, 0.006))),
        *both(tube("hair", [(0.0905, 0.048, 0.127), (0.1015, 0.033, 0.132), (0.1065, 0.016, 0.129)], 0.0033)),
        tube("skin", nose, (0.006, 0.0085, 0.0115, 0.008), 12),
        ball("lips", (0.1, 0.0, 0.046), (0.0065, 0.021, 0.006)),
        *both(ball("skin", (0.006, 0.073, 0.1), (0.018, 0.009, 0.03))),
    ]


def head() -> list[Mesh]:
    neck = [(-0.045, -0.012, 0.0, 0.055, 0.054), (0.0, -0.006, 0.0, 0.05, 0.05), (0.06, 0.004, 0.0, 0.05, 0.049)]
    skull = [
        (0.008, 0.068, 0.0, 0.026, 0.026),
        (0.02, 0.055, 0.0, 0.045, 0.041),
        (0.045, 0.035, 0.0, 0.069, 0.055),
        (0.075, 0.022, 0.0, 0.086, 0.065),
        (0.11, 0.014, 0.0, 0.096, 0.071),
        (0.15, 0.01, 0.0, 0.097, 0.073),
        (0.18, 0.008, 0.0, 0.088, 0.066),
        (0.2, 0.006, 0.0, 0.07, 0.054),
    ]
    hair = [  # ends at the hairline in front, so its centre moves forward as it rises
        (0.056, -0.046, 0.0, 0.03, 0.05),
        (0.085, -0.036, 0.0, 0.048, 0.066),
        (0.12, -0.024, 0.0, 0.064, 0.0735),
        (0.15, -0.012, 0.0, 0.08, 0.076),
        (0.172, 0.002, 0.0, 0.0945, 0.0725),
        (0.19, 0.006, 0.0, 0.0855, 0.065),
        (0.204, 0.006, 0.0, 0.068, 0.053),
    ]
    return [
        limb("skin", neck, n=20),
        limb("skin", skull, (0.006, 0.02), n=24),
        limb("hair", hair, (0.012, 0.02), n=24),
        *face(),
    ]


def thigh() -> list[Mesh]:
    levels = [
        (0.02, 0.0, -0.006, 0.08, 0.07),
        (-0.04, 0.002, -0.002, 0.086, 0.078),
        (-0.12, 0.004, 0.0, 0.083, 0.075),
        (-0.22, 0.003, -0.003, 0.073, 0.066),
        (-0.31, 0.0, -0.004, 0.063, 0.059),
        (-0.365, 0.0, -0.003, 0.058, 0.056),
    ]
    return [limb("trousers", levels, (0.04, 0.045), n=20)]


def shin() -> list[Mesh]:
    """The trouser leg below the knee; it ends over the shoe."""
    levels = [
        (0.0, 0.001, -0.003, 0.055, 0.054),
        (-0.07, -0.006, -0.002, 0.057, 0.053),
        (-0.13, -0.01, 0.0, 0.058, 0.053),
        (-0.22, -0.007, 0.0, 0.052, 0.049),
        (-0.3, -0.003, 0.0, 0.049, 0.047),
        (-0.352, 0.0, 0.0, 0.051, 0.047),
        (-0.36, 0.0, 0.0, 0.05, 0.046),
    ]
    return [limb("trousers", levels, (0.05, 0.0), n=20)]


def heel() -> list[Mesh]:
    """The shoe up to the ball of the foot."""
    upper = [  # x, then the centre and the half widths in y and z
        (-0.052, 0.0, -0.006, 0.022, 0.026),
        (-0.044, 0.0, -0.001, 0.031, 0.037),
        (-0.02, 0.0, 0.0, 0.0385, 0.041),
        (0.02, 0.0, -0.003, 0.04, 0.039),
        (0.055, 0.0, -0.014, 0.0425, 0.029),
        (0.09, -0.002, -0.021, 0.046, 0.022),
        (0.112, -0.002, -0.024, 0.047, 0.019),
    ]
    collar = [(0.01, -0.006, 0.0, 0.045, 0.0385), (0.045, -0.004, 0.0, 0.043, 0.038)]
    outline = [(-0.056, 0.02), (-0.045, 0.034), (-0.01, 0.041), (0.06, 0.044), (0.112, 0.049)]
    left = [(x, y - 0.002 * (x > 0)) for x, y in outline]
    right = [(x, -y - 0.002 * (x > 0)) for x, y in reversed(outline)]
    rows = ((0.045, 0.0205), (0.062, 0.0145), (0.078, 0.01))
    laces = [tube("sole", [(x, -0.018, z), (x, 0.014, z)], 0.0028, 6) for x, z in rows]
    return [
        limb("shoe", upper, (0.004, 0.012), axis="x", power=2.6),
        limb("shoe", collar, n=20),
        loft("sole", "z", [(z, [*left, *right]) for z in (-0.0486, -0.034)]),
        *laces,
    ]


def toe() -> list[Mesh]:
    """The toe cap; it hides the joint inside the shoe."""
    cap = [
        (0.0, -0.002, -0.022, 0.0465, 0.019),
        (0.03, -0.003, -0.024, 0.045, 0.0165),
        (0.054, -0.006, -0.026, 0.037, 0.014),
        (0.066, -0.009, -0.028, 0.026, 0.011),
    ]
    outline = [(-0.004, 0.049), (0.03, 0.046), (0.056, 0.035), (0.072, 0.019), (0.08, 0.001)]
    left = [(x, y - 0.002) for x, y in outline]
    right = [(x, -y * (0.95 if x < 0.05 else 1.15) - 0.004) for x, y in reversed(outline)]
    return [
        limb("shoe", cap, (0.02, 0.008), axis="x", power=2.6),
        loft("sole", "z", [(z, [*left, *right]) for z in (-0.045, -0.034)]),
    ]


def scapula() -> list[Mesh]:
    """The slope from the neck to the shoulder."""
    slope = tube("shirt", [(-0.012, 0.02, 0.118), (-0.006, 0.09, 0.105), (0.0, 0.16, 0.083)], (0.05, 0.053, 0.047), 16)
    return [turned(slope, SCAPULA, (0.0, 0.0, 0.0))]


def bicep() -> list[Mesh]:
    """A short sleeve and the arm below it."""
    sleeve = [
        (0.015, 0.0, 0.0, 0.049, 0.043),
        (-0.03, 0.0, 0.006, 0.054, 0.05),
        (-0.09, 0.0, 0.006, 0.051, 0.047),
        (-0.135, 0.0, 0.006, 0.05, 0.046),
    ]
    arm = [
        (-0.1, 0.001, 0.004, 0.041, 0.038),
        (-0.16, 0.003, 0.003, 0.04, 0.036),
        (-0.22, 0.0, 0.001, 0.034, 0.033),
        (-0.258, 0.0, 0.0, 0.033, 0.032),
    ]
    return [limb("shirt", sleeve, (0.036, 0.0), n=20), limb("skin", arm, (0.0, 0.03))]


def forearm() -> list[Mesh]:
    levels = [
        (0.0, 0.0, 0.0, 0.033, 0.033),
        (-0.05, 0.002, 0.002, 0.038, 0.034),
        (-0.11, 0.002, 0.001, 0.033, 0.028),
        (-0.165, 0.0, 0.0, 0.027, 0.021),
        (-0.2, 0.0, 0.0, 0.0265, 0.0195),
    ]
    return [limb("skin", levels, (0.03, 0.015))]


def hand() -> list[Mesh]:
    """A palm and five slightly bent fingers; the palm faces the thigh and the thumb points forward."""
    palm = [
        (0.0, 0.0, 0.0, 0.0265, 0.018),
        (-0.03, 0.004, -0.001, 0.035, 0.017),
        (-0.07, 0.002, -0.002, 0.0385, 0.0135),
        (-0.082, 0.001, -0.003, 0.038, 0.0115),
    ]
    fingers = [(-0.0285, 0.046, 0.0078), (-0.0095, 0.06, 0.0088), (0.0105, 0.064, 0.009), (0.03, 0.056, 0.0087)]
    parts = [limb("skin", palm, (0.01, 0.006))]
    for x, length, radius in fingers:
        bend = [(x, -0.003, -0.076), (x, -0.005, -0.08 - 0.5 * length), (x, -0.014, -0.08 - length)]
        parts.append(tube("skin", bend, (radius, 0.93 * radius, 0.66 * radius)))
    thumb = [(0.02, -0.002, -0.018), (0.042, -0.009, -0.045), (0.05, -0.015, -0.07), (0.05, -0.018, -0.088)]
    return [*parts, tube("skin", thumb, (0.013, 0.0115, 0.01, 0.0065))]


Shape = Callable[[], list[Mesh]]
TRUNK: dict[str, Shape] = {"pelvis": pelvis, "abdomen": abdomen, "spine": spine, "head": head}
LIMB: dict[str, Shape] = {
    "thigh": thigh,
    "shin": shin,
    "heel": heel,
    "toe": toe,
    "scapula": scapula,
    "bicep": bicep,
    "forearm": forearm,
    "hand": hand,
}
GROUND = {"light": (0.74, 0.75, 0.73), "dark": (0.60, 0.62, 0.61), "edge": (0.42, 0.43, 0.43)}
TILE = 0.5  # m, side of a tile of the ground


def tile(x: float, y: float, material: str) -> Mesh:
    corners = [(x, y, 0.0), (x + TILE, y, 0.0), (x + TILE, y + TILE, 0.0), (x, y + TILE, 0.0)]
    return Mesh(np.array(corners), ((0, 1, 2, 3),), material)


def ground(half: float) -> list[Mesh]:
    """Square tiles in two colours on a slab of twice a half width; its top is at z = 0."""
    count = round(half / TILE)
    square = [(half, half), (-half, half), (-half, -half), (half, -half)]
    slab = loft("edge", "z", [(z, square) for z in (-0.05, -0.001)])
    places = [(i, j) for i in range(-count, count) for j in range(-count, count)]
    return [slab, *(tile(i * TILE, j * TILE, "light" if (i + j) % 2 else "dark") for i, j in places)]


def y_up(mesh: Mesh) -> Mesh:
    """The mesh in a frame whose y axis points up and whose x axis stays."""
    return Mesh(mesh.points[:, (0, 2, 1)] * (1.0, 1.0, -1.0), mesh.faces, mesh.material)
