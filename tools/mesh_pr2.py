"""The visual shapes of PR2: each link as a few housings, drums and plates in the frame of the link.

The two arms share their shapes; of the four fingers one is stated and the others are its copies or
mirror images.  x points forward, y to the left, z up.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from mesh import Mesh, Outline, both, box, prism, tube
from mesh_rounded import drum, limb, shell

MATERIALS = {  # red, green, blue of the diffuse colour
    "white": (0.90, 0.90, 0.89),
    "grey": (0.56, 0.57, 0.59),
    "metal": (0.70, 0.71, 0.73),
    "dark": (0.20, 0.21, 0.23),
    "rubber": (0.09, 0.09, 0.10),
    "glass": (0.10, 0.13, 0.22),
    "light": (0.75, 0.12, 0.10),
}
WHEEL = 0.074792  # m, radius


def stadium(start: float, end: float, half: float, n: int = 8) -> Outline:
    """A strip along the first axis whose far end is half a circle."""
    turn = np.linspace(-np.pi / 2, np.pi / 2, n + 1)
    arc = list(zip((end + half * np.cos(turn)).tolist(), (half * np.sin(turn)).tolist()))
    return [(start, half), (start, -half), *arc]


def base() -> list[Mesh]:
    """A skirt on casters, a slot for the laser and the column at the back."""
    parts = [
        shell("white", (-0.332, -0.332, 0.045), (0.332, 0.332, 0.215), 0.02, 9.0, 40),
        shell("dark", (-0.315, -0.315, 0.2), (0.25, 0.315, 0.29), 0.004, 9.0, 40),
        shell("white", (-0.332, -0.332, 0.285), (0.322, 0.332, 0.318), 0.012, 9.0, 40),
        shell("grey", (-0.23, -0.23, 0.314), (0.25, 0.23, 0.325), 0.006, 12.0),
        box("dark", (-0.16, -0.29, -0.022), (0.16, 0.29, 0.06), 0.01),
        box("dark", (-0.29, -0.12, 0.0), (0.29, 0.12, 0.06), 0.01),
        box("dark", (-0.24, -0.155, 0.31), (-0.09, 0.155, 0.7), 0.012),
        shell("white", (-0.325, -0.195, 0.314), (-0.225, 0.195, 0.66), 0.012, 9.0),
        box("metal", (0.318, -0.1, 0.105), (0.336, 0.1, 0.16), 0.006),
        box("light", (-0.336, 0.2, 0.12), (-0.326, 0.26, 0.15), 0.003),
        *both(box("grey", (-0.23, 0.155, 0.31), (-0.13, 0.17, 0.66), 0.004)),
        *both(box("grey", (-0.2, 0.326, 0.08), (0.2, 0.336, 0.17), 0.004)),
    ]
    for x in (-0.2246, 0.2246):
        parts += both(drum("dark", "z", 0.036, 0.05, (x, 0.2246), 0.1))
    return parts


def bellow() -> list[Mesh]:
    """A folded cover behind the column."""
    folds = [
        (z, 0.0, 0.0, 0.022 - 0.007 * (k % 2), 0.183 - 0.007 * (k % 2))
        for k, z in enumerate(np.linspace(-0.148, 0.148, 21))
    ]
    return [limb("dark", [(float(z), u, v, a, b) for z, u, v, a, b in folds], power=9.0)]


def laser() -> list[Mesh]:
    """A scanning range finder; its beam turns in the plane z = 0."""
    return [
        box("dark", (-0.03, -0.03, -0.035), (0.03, 0.03, -0.008), 0.005),
        drum("light", "z", -0.01, 0.0, (0.0, 0.0), 0.0255, 0.001),
        drum("glass", "z", -0.001, 0.018, (0.0, 0.0), 0.025, 0.003),
        drum("dark", "z", 0.017, 0.03, (0.0, 0.0), 0.028, 0.004),
    ]


def caster() -> list[Mesh]:
    """The block between the wheels of a caster, on its vertical bearing."""
    return [
        drum("metal", "z", -0.012, 0.022, (0.0, 0.0), 0.034),
        *both(tube("metal", [(0.0, 0.02, 0.0), (0.0, 0.06, 0.0)], 0.014, 12)),
        box("dark", (-0.045, -0.027, -0.03), (0.045, 0.027, 0.045), 0.01),
    ]


def wheel() -> list[Mesh]:
    return [
        drum("rubber", "y", -0.017, 0.017, (0.0, 0.0), WHEEL, 0.007, 32),
        drum("grey", "y", -0.019, 0.019, (0.0, 0.0), 0.052, 0.003),
        drum("dark", "y", -0.021, 0.021, (0.0, 0.0), 0.018, 0.002, 16),
    ]


def torso() -> list[Mesh]:
    """Back, cover over the bellow, spine between the shoulders, bridge over them and neck."""
    back = [(-0.4, 0.055, 0.185), (-0.38, 0.065, 0.2), (0.02, 0.07, 0.205), (0.23, 0.07, 0.205), (0.25, 0.065, 0.2)]
    cover = [(0.19, 0.093, 0.2), (0.2, 0.1, 0.205), (0.27, 0.1, 0.205), (0.29, 0.088, 0.195)]
    bridge = [(0.14, 0.1, 0.2), (0.15, 0.11, 0.208), (0.265, 0.108, 0.206), (0.29, 0.094, 0.19)]
    return [
        limb("white", [(z, -0.145, 0.0, hx, hy) for z, hx, hy in back], power=8.0, n=32),
        limb("white", [(z, -0.185, 0.0, hx, hy) for z, hx, hy in cover], power=8.0, n=32),
        limb("white", [(z, -0.05, 0.0, hx, hy) for z, hx, hy in bridge], power=7.0, n=32),
        box("grey", (-0.13, -0.07, -0.33), (0.06, 0.07, 0.16), 0.012),
        box("dark", (0.05, -0.045, -0.31), (0.068, 0.045, 0.14), 0.006),
        box("dark", (0.03, -0.085, 0.175), (0.066, 0.085, 0.272), 0.008),
        *both(box("white", (0.035, 0.085, 0.16), (0.085, 0.125, 0.275), 0.01)),
        drum("grey", "z", 0.285, 0.3, (-0.017, 0.0), 0.1, 0.004, 32),
        drum("dark", "z", 0.295, 0.345, (-0.017, 0.0), 0.075, 0.006, 32),
    ]


def side_plate() -> list[Mesh]:
    return [
        box("grey", (-0.145, -0.006, -0.02), (-0.005, 0.006, 0.085), 0.002),
        *(drum("dark", "y", -0.008, 0.008, (x, z), 0.006, 0.001, 10) for x in (-0.13, -0.02) for z in (-0.005, 0.07)),
    ]


def screw() -> list[Mesh]:
    """The spindle of the lift."""
    return [
        tube("metal", [(0.0, 0.0, -0.35), (0.0, 0.0, 0.25)], 0.012, 12),
        drum("dark", "z", -0.37, -0.34, (0.0, 0.0), 0.03),
    ]


def head_pan() -> list[Mesh]:
    """A turntable with a yoke for the tilt axis."""
    cheek = [
        (x, z)
        for x, z in (
            (-0.02, -0.035),
            (0.05, -0.035),
            (0.092, -0.012),
            (0.095, 0.015),
            (0.075, 0.032),
            (0.05, 0.03),
            (-0.02, -0.015),
        )
    ]
    return [
        drum("grey", "z", -0.04, -0.02, (0.0, 0.0), 0.095, 0.005, 32),
        box("dark", (-0.06, -0.125, -0.038), (0.06, 0.125, -0.018), 0.006),
        *both(prism("grey", "y", 0.104, 0.124, cheek)),
    ]


def head_tilt() -> list[Mesh]:
    """The head, wide and flat, with a dark face."""
    levels = [
        (-0.012, -0.03, 0.0, 0.075, 0.086),
        (0.0, -0.025, 0.0, 0.088, 0.096),
        (0.03, -0.02, 0.0, 0.095, 0.1),
        (0.05, -0.018, 0.0, 0.093, 0.098),
        (0.058, -0.018, 0.0, 0.085, 0.09),
    ]
    return [
        limb("white", levels, power=6.0, n=32),
        box("dark", (0.05, -0.088, 0.004), (0.08, 0.088, 0.048), 0.006),
        *both(drum("metal", "y", 0.09, 0.11, (0.0, 0.0), 0.028, 0.003)),
    ]


def head_plate() -> list[Mesh]:
    return [shell("grey", (-0.125, -0.15, -0.007), (0.05, 0.15, 0.003), 0.003, 8.0)]


def sensor_mount() -> list[Mesh]:
    """The housing of the cameras."""
    levels = [
        (0.003, -0.015, 0.0, 0.045, 0.158),
        (0.012, -0.012, 0.0, 0.052, 0.165),
        (0.075, -0.012, 0.0, 0.05, 0.165),
        (0.092, -0.016, 0.0, 0.04, 0.155),
    ]
    return [limb("white", levels, power=7.0, n=32)]


def double_stereo() -> list[Mesh]:
    """The dark front of the camera housing."""
    return [
        shell("dark", (0.02, -0.155, 0.02), (0.0435, 0.155, 0.084), 0.004, 10.0),
        box("grey", (0.03, -0.006, 0.07), (0.0445, 0.006, 0.08), 0.001),
    ]


def eye(radius: float) -> list[Mesh]:
    """A camera that looks along x."""
    return [
        drum("metal", "x", -0.01, 0.006, (0.0, 0.0), radius, 0.002, 20),
        drum("glass", "x", -0.009, 0.0075, (0.0, 0.0), 0.72 * radius, 0.002, 20),
    ]


def tilt_mount() -> list[Mesh]:
    """The cradle of the tilting laser."""
    return [
        box("grey", (-0.03, -0.04, -0.02), (0.03, 0.04, -0.008), 0.003),
        *both(box("grey", (-0.018, 0.034, -0.02), (0.018, 0.042, 0.03), 0.003)),
        *both(drum("metal", "y", 0.04, 0.056, (0.0, 0.0), 0.016, 0.002, 16)),
    ]


def shoulder_pan() -> list[Mesh]:
    """A tall drum that holds the springs, and the fork of the lift axis."""
    levels = [
        (-0.31, 0.0, 0.0, 0.088, 0.09),
        (-0.295, 0.0, 0.0, 0.102, 0.102),
        (-0.1, 0.002, 0.0, 0.11, 0.108),
        (0.09, 0.002, 0.0, 0.11, 0.108),
        (0.118, 0.0, 0.0, 0.1, 0.1),
        (0.126, 0.0, 0.0, 0.085, 0.087),
    ]
    fork = [(x, z) for x, z in stadium(-0.02, 0.1, 0.072)]
    return [
        limb("white", levels, power=2.6, n=28),
        *both(prism("white", "y", 0.078, 0.104, fork)),
        *both(drum("grey", "y", 0.1, 0.11, (0.1, 0.0), 0.045, 0.003)),
        drum("dark", "z", 0.12, 0.135, (0.0, 0.0), 0.06, 0.003),
    ]


def shoulder_lift() -> list[Mesh]:
    """The drum on the lift axis and the socket of the roll axis."""
    return [
        drum("grey", "y", -0.075, 0.075, (0.0, 0.0), 0.083, 0.008, 28),
        limb("grey", [(0.03, 0.0, 0.0, 0.074, 0.08), (0.1, 0.0, 0.0, 0.07, 0.074)], axis="x", n=24),
    ]


def upper_arm_roll() -> list[Mesh]:
    return [
        drum("dark", "x", 0.098, 0.112, (0.0, 0.0), 0.07, 0.002, 28),
        drum("metal", "x", 0.108, 0.138, (0.0, 0.0), 0.076, 0.004, 28),
    ]


def upper_arm() -> list[Mesh]:
    """A tapering housing that ends in the fork of the elbow."""
    levels = [  # x, then the centre and the half widths in y and z
        (0.134, 0.0, 0.0, 0.076, 0.076),
        (0.15, 0.0, 0.0, 0.083, 0.083),
        (0.22, 0.0, -0.002, 0.083, 0.081),
        (0.29, 0.0, -0.004, 0.077, 0.07),
        (0.325, 0.0, -0.004, 0.072, 0.06),
        (0.335, 0.0, -0.004, 0.064, 0.052),
    ]
    fork = [(x, z) for x, z in stadium(0.28, 0.4, 0.05)]
    return [
        limb("white", levels, axis="x", power=3.0, n=28),
        *both(prism("white", "y", 0.055, 0.073, fork)),
        *both(drum("grey", "y", 0.07, 0.079, (0.4, 0.0), 0.036, 0.003)),
        box("grey", (0.19, -0.03, 0.07), (0.3, 0.03, 0.083), 0.005),
    ]


def elbow_flex() -> list[Mesh]:
    """The drum on the elbow axis and the socket of the forearm."""
    return [
        drum("grey", "y", -0.053, 0.053, (0.0, 0.0), 0.056, 0.006, 28),
        limb("grey", [(0.02, 0.0, 0.0, 0.048, 0.05), (0.08, 0.0, 0.0, 0.05, 0.05)], axis="x", n=24),
    ]


def forearm_roll() -> list[Mesh]:
    """The forearm's first ring with the hump of its camera."""
    hump = [
        (x, 0.0, z, 0.024, h)
        for x, z, h in ((0.1, 0.04, 0.014), (0.118, 0.042, 0.02), (0.145, 0.04, 0.02), (0.17, 0.034, 0.014))
    ]
    return [
        drum("dark", "x", 0.078, 0.09, (0.0, 0.0), 0.048, 0.002, 28),
        drum("metal", "x", 0.088, 0.11, (0.0, 0.0), 0.054, 0.004, 28),
        limb("grey", hump, axis="x", power=3.0),
    ]


def forearm() -> list[Mesh]:
    levels = [
        (0.108, 0.0, -0.002, 0.052, 0.05),
        (0.125, 0.0, -0.002, 0.06, 0.054),
        (0.18, 0.0, -0.004, 0.06, 0.053),
        (0.24, 0.0, -0.004, 0.053, 0.045),
        (0.272, 0.0, -0.002, 0.048, 0.036),
        (0.28, 0.0, -0.002, 0.042, 0.03),
    ]
    fork = [(x, z) for x, z in stadium(0.24, 0.321, 0.027)]
    return [
        limb("white", levels, axis="x", power=3.0, n=28),
        *both(prism("white", "y", 0.034, 0.046, fork)),
        *both(drum("grey", "y", 0.044, 0.05, (0.321, 0.0), 0.02, 0.002, 16)),
    ]


def camera() -> list[Mesh]:
    return [*eye(0.013), box("dark", (-0.03, -0.016, -0.016), (-0.008, 0.016, 0.016), 0.004)]


def wrist_flex() -> list[Mesh]:
    return [
        drum("grey", "y", -0.032, 0.032, (0.0, 0.0), 0.029, 0.004, 24),
        drum("grey", "x", 0.01, 0.034, (0.0, 0.0), 0.027, 0.002, 24),
    ]


def wrist_roll() -> list[Mesh]:
    return [
        drum("dark", "x", 0.032, 0.04, (0.0, 0.0), 0.026, 0.001, 24),
        drum("metal", "x", 0.038, 0.05, (0.0, 0.0), 0.032, 0.003, 24),
    ]


def palm() -> list[Mesh]:
    """The gripper's motor housing, wide across the fingers."""
    levels = [
        (0.046, 0.0, 0.0, 0.036, 0.03),
        (0.056, 0.0, 0.0, 0.047, 0.036),
        (0.085, 0.0, 0.0, 0.062, 0.036),
        (0.104, 0.0, 0.0, 0.06, 0.03),
        (0.112, 0.0, 0.0, 0.054, 0.024),
    ]
    return [
        limb("white", levels, axis="x", power=4.0, n=24),
        box("dark", (0.06, -0.035, -0.0385), (0.1, 0.035, 0.0385), 0.004),
        box("light", (0.048, -0.004, 0.03), (0.056, 0.004, 0.035), 0.001),
    ]


def finger() -> list[Mesh]:
    """The left finger of a gripper: two bars between its hinges."""

    def bar(path: list[tuple[float, float]], width: float) -> Mesh:
        outline = [(x, y - width) for x, y in path] + [(x, y + width) for x, y in reversed(path)]
        return prism("grey", "z", -0.011, 0.011, outline)

    return [
        bar([(-0.008, 0.006), (0.03, 0.022), (0.05, 0.0225)], 0.0065),
        bar([(0.048, 0.0225), (0.098, 0.0085)], 0.006),
        drum("dark", "z", -0.0145, 0.0145, (0.0, 0.006), 0.0075, 0.001, 14),
        drum("dark", "z", -0.0135, 0.0135, (0.09137, 0.01), 0.0065, 0.001, 14),
    ]


def finger_tip() -> list[Mesh]:
    """The tip of a left finger with its pad; it closes at y = -0.005 of its own frame."""
    back = [(-0.008, 0.012), (-0.008, -0.003), (0.024, -0.003), (0.024, 0.003), (0.012, 0.011)]
    return [
        prism("metal", "z", -0.0105, 0.0105, back),
        box("rubber", (-0.006, -0.006, -0.0115), (0.0235, -0.002, 0.0115), 0.001),
    ]


Shape = Callable[[], list[Mesh]]


def flipped(shape: Shape) -> Shape:
    return lambda: [part.mirrored() for part in shape()]


SHAPES: dict[str, Shape] = {
    "base": base,
    "bellow": bellow,
    "laser": laser,
    "caster": caster,
    "wheel": wheel,
    "torso": torso,
    "side_plate": side_plate,
    "screw": screw,
    "head_pan": head_pan,
    "head_tilt": head_tilt,
    "head_plate": head_plate,
    "sensor_mount": sensor_mount,
    "double_stereo": double_stereo,
    "small_eye": lambda: eye(0.0125),
    "large_eye": lambda: eye(0.0185),
    "tilt_mount": tilt_mount,
    "shoulder_pan": shoulder_pan,
    "shoulder_lift": shoulder_lift,
    "upper_arm_roll": upper_arm_roll,
    "upper_arm": upper_arm,
    "elbow_flex": elbow_flex,
    "forearm_roll": forearm_roll,
    "forearm": forearm,
    "camera": camera,
    "wrist_flex": wrist_flex,
    "wrist_roll": wrist_roll,
    "palm": palm,
    "l_finger": finger,
    "r_finger": flipped(finger),
    "l_finger_tip": finger_tip,
    "r_finger_tip": flipped(finger_tip),
}
