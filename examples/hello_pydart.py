"""Load a world of cubes and run it for 2 seconds."""

import pydart2 as pydart

if __name__ == "__main__":
    print("Hello, PyDART!")

    pydart.init()
    print("pydart initialization OK")

    world = pydart.World(1.0 / 2000.0, "./data/skel/cubes.skel")
    print("pydart create_world OK")

    while world.t < 2.0:
        if world.nframes % 100 == 0:
            skel = world.skeletons[-1]
            print(f"{world.t:.4f}s: The last cube COM = {skel.C}")
        world.step()
