"""The optimised engine of `make engine`: the same numbers as Debian's, to the last bit."""

from __future__ import annotations

import os
import sys
from pathlib import Path

import pytest
from test_builds import ROOT, copy_sources, run

PREFIX = (ROOT / "build" / "engine" / "prefix").resolve()
STATES = """
import pydart2
for name in ("cubes", "chain", "fullbody1", "softBodies", "shapes"):
    world = pydart2.World(0.001, f"skel/{name}.skel")
    world.step(1000)
    print(name, [x.hex() for x in world.x.tolist()])
world = pydart2.World(0.001, "skel/ground.skel")
atlas = world.add_skeleton("sdf/atlas/atlas_v3_no_head.sdf")
atlas.set_positions({"root_rot_x": -1.5707963267948966, "root_pos_y": -0.0235})
world.step(1000)
print("Atlas", [x.hex() for x in world.x.tolist()])
with open("/proc/self/maps") as maps:
    print(*sorted({line.split()[-1] for line in maps if "libdart.so" in line}))
"""


@pytest.mark.packaging
@pytest.mark.skipif(not (PREFIX / ".version").exists(), reason="the optimised engine is not built: make engine")
def test_states_are_bitwise_those_of_debians_engine(tmp_path: Path) -> None:
    found = []
    for prefix in ("", str(PREFIX)):
        target = tmp_path / ("optimised" if prefix else "debian")
        sources = copy_sources(target / "sources")
        install = (sys.executable, "-m", "pip", "install", "-q", "--no-deps", "--no-build-isolation")
        run(*install, "--target", target / "site", ".", cwd=sources, env={**os.environ, "PYDART2_DART_PREFIX": prefix})
        env = {**os.environ, "PYTHONPATH": str(target / "site")}
        *states, library = run(sys.executable, "-c", STATES, cwd=tmp_path, env=env).splitlines()
        assert library.startswith(prefix or "/usr/lib/"), library
        found.append(states)
    assert found[0] == found[1]
