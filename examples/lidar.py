"""A lidar: a puck that slides through a room turns where its rays say that a wall is near."""

import numpy as np
from _headless import arguments, rehearse

import pydart2 as pydart
from pydart2.sensors import Lidar

world = pydart.World(0.002, up="z")
world.add_ground()
for i, (x, y) in enumerate([(3, 0), (-3, 0), (0, 3), (0, -3)]):
    size = [0.2, 6.2, 0.5] if x else [6.2, 0.2, 0.5]
    world.add_box(size, None, [x, y, 0.25], fixed=True, name=f"wall {i}")
puck = world.add_cylinder(0.2, 0.2, 2.0, position=[-1.0, -2.0, 0.101], name="puck")
lidar = Lidar(puck.bodynodes[0], Lidar.fan(2.0 * np.pi, 73)[:-1], max_distance=10.0, rate=50.0)
near: list[float] = []


def steer() -> np.ndarray:
    """Push away from what the rays see, and in a circle round the middle."""
    ranges, rays = lidar.read(), puck.bodynodes[0].T[:2, :2] @ lidar.directions[:, :2].T
    near.append(float(ranges.min()))
    away = -(rays * np.maximum(1.2 - ranges, 0.0)).sum(axis=1)
    onwards = np.array([-puck.C[1], puck.C[0]]) + 0.5 * puck.C[:2]
    force = 2.0 * away + 15.0 * onwards / np.linalg.norm(onwards) - 8.0 * puck.dC[:2]
    return np.array([0.0, 0.0, -5.0 * puck.dq[2], *(force + 0.0), 0.0])


if __name__ == "__main__":
    args = arguments()
    puck.set_controller(steer)
    if args.headless:
        rehearse(world, args, 4000, lambda: {f"no wall nearer than {min(near):.2f} m": min(near) > 0.3}, camera=None)
    else:
        pydart.gui.viewer.launch(world)
