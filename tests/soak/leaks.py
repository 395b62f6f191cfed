"""Uses everything a little and ends; under LeakSanitizer what is lost shows. `make sanitize` runs it.

Python, NumPy and the engine keep some memory for good: tests/soak/leaks.supp names what is theirs.
"""

from __future__ import annotations

import contextlib
import gc
import pickle

import pydart2


def main() -> None:
    """Worlds of every kind: stepped, copied, changed, dropped and destroyed."""
    for model in ("cubes", "fullbody1", "softBodies"):
        for detector in range(4):
            world = pydart2.World(0.001, pydart2.data_path(f"skel/{model}.skel"))
            world.set_collision_detector(detector)
            world.step(3)
            skel = world.skeletons[-1]
            _ = world.collision_result.contacts, skel.q, skel.M, skel.bodynodes[0].J
            world.restore(world.snapshot())
            pickle.loads(pickle.dumps(world)).clone().step()
            with contextlib.suppress(ValueError):
                skel.q = [float("nan")] * skel.ndofs
            skel.set_root_joint_to_weld()
            world.remove_skeleton(skel)
            if detector % 2:
                world.destroy()
    del world, skel
    pydart2.init(verbose=False)
    gc.collect()


if __name__ == "__main__":
    main()
