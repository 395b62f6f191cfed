"""Move an arm by name: motors take two joints to their targets in steps of 5 ms, against gravity."""

import numpy as np
from _headless import arguments, rehearse

import pydart2 as pydart

TARGETS = {"upper_joint": 0.8, "fore_joint": -1.5}  # rad

if __name__ == "__main__":
    args = arguments()
    world = pydart.World(0.005)
    arm = world.add_empty_skeleton("arm")
    upper = arm.add_body("upper", joint="revolute", axis=(0, 0, 1))
    upper.add_box((0.5, 0.08, 0.08), mass=3.0, position=(0.25, 0, 0), color=(0.95, 0.5, 0.1))
    fore = arm.add_body("fore", upper, "revolute", axis=(0, 0, 1), position=(0.5, 0, 0))
    fore.add_box((0.4, 0.06, 0.06), mass=2.0, position=(0.2, 0, 0), color=(0.3, 0.33, 0.38))
    for dof in arm.dofs:
        dof.set_force_upper_limit(40.0)
        dof.set_force_lower_limit(-40.0)
    arm.set_targets(TARGETS, kp=1e4, kd=200.0, compensate="gravity")

    def check() -> dict[str, bool]:
        """Each joint is where it was sent, with no more than its motor can do."""
        off = max(abs(arm.q[name] - angle) for name, angle in TARGETS.items())
        most = float(np.abs(arm.motor_forces()).max())
        return {f"each joint is at most {off:.1e} rad from its target, held by {most:.1f} N m": off < 1e-4}

    if args.headless:
        rehearse(world, args, 1000, check, camera=None)
    else:
        pydart.gui.viewer.launch(world)
