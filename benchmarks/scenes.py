"""The worlds that are measured, as arguments that every competitor can build them from."""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path

import pydart2


@dataclass(frozen=True)
class Scene:
    """A world: a SKEL world, a robot to add to it, and the robot's pose and springs."""

    name: str
    world: str | None
    robot: str | None = None
    gravity: float = -9.81  # along y
    q: list[float] = field(default_factory=list)
    stiffness: float = 0.0
    damping: float = 0.0
    dt: float = 0.001
    warm: int = 300  # steps before the clock starts: contacts are made
    steps: int = 300  # timed at a time, always from the same state

    def dump(self) -> str:
        """For a competitor's command line."""
        return json.dumps(asdict(self))


def _standing_atlas() -> Scene:
    standing = json.loads(Path(pydart2.data_path("sdf/atlas/standing.json")).read_text(encoding="ascii"))
    world, robot = (pydart2.data_path(standing[key]) for key in ("world", "robot"))
    skel = pydart2.World(0.001).add_skeleton(robot)
    skel.set_positions(standing["q"])
    q = skel.q.tolist()
    return Scene("Atlas", world, robot, q=q, stiffness=standing["stiffness"], damping=standing["damping"], steps=100)


def atlas_with_meshes() -> list[Scene]:
    """Atlas with the meshes of Debian's dart-doc, which touch the ground in 65 points; none without them."""
    robot = Path("/usr/share/doc/dart/data/sdf/atlas/atlas_v3_no_head.sdf")
    return [replace(_standing_atlas(), name="Atlas with meshes", robot=str(robot), steps=100)] if robot.exists() else []


def standing_human() -> Scene:
    """As in examples/biped_stand.py, for a controller that holds the pose."""
    world = pydart2.data_path("skel/fullbody1.skel")
    q = pydart2.World(0.001, world).skeletons[-1].q
    q["j_pelvis_pos_y"], q["j_pelvis_rot_y"] = -0.05, -0.2
    for side in ("left", "right"):
        q[f"j_thigh_{side}_z", f"j_shin_{side}", f"j_heel_{side}_1"] = 0.15, -0.4, 0.25
    return Scene("standing fullbody1", world, q=q.tolist(), dt=1.0 / 2000.0, warm=0, steps=600)


def scenes() -> dict[str, Scene]:
    """Scenes by name, from models that come with the package."""
    skel = {name: pydart2.data_path(f"skel/{name}.skel") for name in ("cubes", "chain", "fullbody1", "softBodies")}
    found = [
        Scene("cubes", skel["cubes"], steps=1000),
        Scene("chain", skel["chain"], steps=2000),
        Scene("fullbody1", skel["fullbody1"]),
        Scene("softBodies", skel["softBodies"], warm=100, steps=100),
        _standing_atlas(),
        Scene("PR2", None, pydart2.data_path("urdf/PR2/pr2.urdf"), gravity=0.0),
    ]
    return {scene.name: scene for scene in found}
