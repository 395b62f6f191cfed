"""Keep away: an arm that sweeps slows down as it nears a visitor, and stands before it touches him."""

import numpy as np
from _headless import arguments, rehearse

import pydart2 as pydart


class Sweeper:
    """The nearer the visitor the slower: full speed from half a metre, none within 5 cm."""

    def __init__(self, arm: pydart.Skeleton) -> None:
        self.arm, self.nearest, self.phase = arm, np.inf, -np.pi / 2

    def compute(self) -> np.ndarray:
        """Moves the targets of the motors; shape (2,), N m, which are all."""
        gap = float(self.arm.world.distance(self.arm, "visitor").distances)
        self.nearest = min(self.nearest, gap)
        self.phase += self.arm.world.dt * 0.8 * np.clip((gap - 0.05) / 0.45, 0.0, 1.0)
        self.arm.set_targets([1.5 * np.sin(self.phase), 0.5], kp=2000.0, kd=120.0)
        return np.zeros(2)


if __name__ == "__main__":
    args = arguments()
    world = pydart.World(0.002, up="z")
    arm = world.add_empty_skeleton("arm")
    upper = arm.add_body("upper", joint="revolute", axis=(0, 0, 1), position=(0, 0, 0.5))
    upper.add_box((0.5, 0.08, 0.08), mass=3.0, position=(0.25, 0, 0))
    fore = arm.add_body("fore", upper, "revolute", axis=(0, 0, 1), position=(0.5, 0, 0))
    fore.add_box((0.4, 0.06, 0.06), mass=2.0, position=(0.2, 0, 0))
    world.add_cylinder(0.2, 1.6, 70.0, position=(0.4, 0.8, 0.8), name="visitor", fixed=True)
    arm.q = [-1.5, 0.5]
    arm.set_controller(sweeper := Sweeper(arm))
    if args.headless:
        text = "the arm comes within 6 cm of the visitor, and no nearer than 5"
        rehearse(world, args, 3000, lambda: {text: 0.05 <= sweeper.nearest < 0.06}, camera=None)
    else:
        pydart.gui.viewer.launch(world)
