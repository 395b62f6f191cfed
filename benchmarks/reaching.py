"""How many targets inverse kinematics reaches, in what time: python benchmarks/reaching.py [TARGETS].

Poses of a link at random positions within the limits, each from another random start, to 1e-6 m and rad, restarts
counted. Beside ours stand the loop of Pinocchio's documentation (damped least squares, in Python, without limits) and
the solver of PyPI's dartpy, both with the same restarts. ``pip install pin example-robot-data airo-models``; dartpy is
asked in a folder of its own.
"""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

TOLERANCE, RESTARTS, MOST = 1e-6, 50, 100
ARMS = {"ur5e": ("ur5e", "wrist_3_link"), "panda": ("panda", "panda_link8"), "xarm7": ("xarm7", "link7")}
ATLAS, PR2 = "sdf/atlas/atlas_v3_no_head.sdf", "urdf/PR2/pr2.urdf"
CROUCH = {"l_leg_kny": 0.6, "r_leg_kny": 0.6, "l_leg_hpy": -0.3, "r_leg_hpy": -0.3}
Attempt = Callable[[Any, Any], Any]  # target and start → whether it got there


def ours(count: int) -> dict[str, list[tuple[bool, float]]]:
    """Each case's outcomes and seconds; the arms' targets go into files for the others."""
    import pydart2

    found = {}
    for name, (model, link) in ARMS.items():
        arm = pydart2.World(0.001).add_skeleton(pydart2.models.find(model), base="fixed", missing_meshes="warn")
        found[name] = _reach(arm, arm.body(link), arm.dofs, {}, count, name)
    robot = pydart2.World(0.001).add_skeleton(PR2, base="fixed", missing_meshes="warn")
    side = [
        dof for dof in robot.dofs if dof.name.startswith("r_") and dof.joint.name in _above(robot, "r_wrist_roll_link")
    ]
    found["PR2's right arm"] = _reach(robot, robot.body("r_wrist_roll_link"), side, {}, count, "")
    atlas = pydart2.World(0.001).add_skeleton(ATLAS)
    atlas.set_positions(CROUCH)
    feet = {foot: atlas.body(foot).T for foot in ("l_foot", "r_foot")}
    side = [dof for dof in atlas.dofs if dof.name.startswith("l_arm") or dof.name.startswith("back")]
    found["Atlas' hand, feet held"] = _reach(atlas, atlas.body("l_hand"), side, feet, count, "", whole=True)
    return found


def _above(robot: Any, link: str) -> set[str]:
    """The joints that move a link."""
    body, names = robot.body(link), set()
    while body is not None:
        names.add(body.parent_joint.name)
        body = body.parent_bodynode
    return names


def _reach(
    skel: Any, hand: Any, dofs: list[Any], held: Any, count: int, name: str, whole: bool = False
) -> list[tuple[bool, float]]:
    """Targets by random positions of some dofs; those that do not belong to the problem stay."""
    rng, rest, ids = np.random.default_rng(0), skel.q.copy(), [dof.id for dof in dofs]
    low, high = np.maximum(skel.q_lower[ids], -np.pi), np.minimum(skel.q_upper[ids], np.pi)
    outcomes, asked = [], []
    for _ in range(count):
        skel.q = rest
        q = rest.copy()
        q[ids] = rng.uniform(low, high)
        skel.q = q
        goal = np.array(hand.T)
        start = rest.copy()
        start[ids] = rng.uniform(low, high)
        begin = time.process_time()
        result = skel.inverse_kinematics(
            {hand: goal, **held}, dofs=None if whole else ids, start=start, restarts=RESTARTS
        )
        seconds = time.process_time() - begin
        skel.q = result.q
        off = np.abs(np.asarray(hand.T) - goal).max()
        outcomes.append((bool(off < 2 * TOLERANCE and result.converged), seconds))
        asked.append((goal.tolist(), q[ids].tolist(), start[ids].tolist()))
    if name:
        targets = {
            "path": str(_bare(name)),
            "link": hand.name,
            "low": low.tolist(),
            "high": high.tolist(),
            "asked": asked,
        }
        _targets(name).write_text(json.dumps(targets))
    return outcomes


def _bare(name: str) -> Path:
    """An arm without its meshes, which dartpy does not find."""
    import pydart2

    text = Path(pydart2.models.find(ARMS[name][0])).read_text(encoding="utf-8")
    path = _targets(name).with_suffix(".urdf")
    path.write_text(re.sub(r"<(visual|collision)\b.*?</\1>", "", text, flags=re.DOTALL), encoding="utf-8")
    return path


def _targets(name: str) -> Path:
    folder = Path(__file__).resolve().parent.parent / "build" / "reaching"
    folder.mkdir(parents=True, exist_ok=True)
    return folder / f"{name}.json"


def _pinocchio(targets: dict[str, Any]) -> Attempt:
    """The loop of its documentation, "Inverse kinematics (clik)", on the frame of the link."""
    import pinocchio as pin

    model = pin.buildModelFromUrdf(targets["path"])
    data, frame = model.createData(), model.getFrameId(targets["link"])

    def attempt(goal: Any, start: Any) -> Any:
        q, aim = np.array(start), pin.SE3(np.array(goal))
        for _ in range(MOST):
            pin.framesForwardKinematics(model, data, q)
            error = pin.log(data.oMf[frame].actInv(aim)).vector
            if np.linalg.norm(error) < TOLERANCE:
                return True
            J = pin.computeFrameJacobian(model, data, q, frame)
            J = -pin.Jlog6(aim.actInv(data.oMf[frame])) @ J
            q = pin.integrate(model, q, -J.T @ np.linalg.solve(J @ J.T + 1e-12 * np.eye(6), error))
        return False

    return attempt


def _dartpy(targets: dict[str, Any]) -> Attempt:
    import dartpy as dart

    loader = getattr(dart.utils, "DartLoader", None) or dart.io.DartLoader
    reader = loader()
    options = reader.getOptions()
    options.mDefaultRootJointType = loader.RootJointType.FIXED
    reader.setOptions(options)
    reader.addPackageDirectory("", str(Path(targets["path"]).parent))
    skel = reader.parseSkeleton(targets["path"])
    body = skel.getBodyNode(targets["link"])
    ik = body.getIK(True)
    aim = dart.dynamics.SimpleFrame(dart.dynamics.Frame.World(), "aim")
    ik.setTarget(aim)
    ik.getSolver().setTolerance(TOLERANCE)
    ik.getSolver().setNumMaxIterations(MOST)

    def attempt(goal: Any, start: Any) -> Any:
        aim.setTransform(dart.math.Isometry3(np.array(goal)))
        skel.setPositions(np.array(start))
        ik.solveAndApply(True)
        return np.abs(body.getWorldTransform().matrix() - np.array(goal)).max() < 2 * TOLERANCE

    return attempt


def play(make: Callable[[dict[str, Any]], Attempt], name: str) -> list[tuple[bool, float]]:
    """Another library's outcomes on the targets of an arm, with restarts."""
    targets = json.loads(_targets(name).read_text())
    attempt, rng = make(targets), np.random.default_rng(1)
    outcomes = []
    for goal, _, start in targets["asked"]:
        begin, reached = time.process_time(), False
        for _ in range(RESTARTS + 1):
            reached = bool(attempt(goal, start))
            if reached:
                break
            start = rng.uniform(targets["low"], targets["high"])
        outcomes.append((reached, time.process_time() - begin))
    return outcomes


def row(who: str, case: str, outcomes: list[tuple[bool, float]]) -> str:
    """Of the table."""
    times = 1e3 * np.array([seconds for _, seconds in outcomes])
    share = 100.0 * np.mean([reached for reached, _ in outcomes])
    late = np.quantile(times, 0.99)
    return f"| {case} | {who} | {share:.1f} % | {times.mean():.2f} | {np.median(times):.2f} | {late:.1f} |"


def in_another(name: str) -> list[tuple[bool, float]] | None:
    """dartpy's outcomes, in the interpreter that DARTPY names; None without one."""
    if "DARTPY" not in os.environ:
        return None
    done = subprocess.run([os.environ["DARTPY"], __file__, "--dartpy", name], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(done.stderr[-2000:])
    return [tuple(pair) for pair in json.loads(done.stdout.splitlines()[-1])]  # type: ignore[misc]


def main(count: int) -> None:
    """Print the table."""
    print("| reaches | by | within 1e-6 | mean ms | median | 99 % |\n|---|---|---|---|---|---|")
    for case, outcomes in ours(count).items():
        print(row("pydart2", case, outcomes), flush=True)
        if case in ARMS:
            print(row("Pinocchio", case, play(_pinocchio, case)), flush=True)
            if theirs := in_another(case):
                print(row("dartpy", case, theirs), flush=True)


if __name__ == "__main__":
    if sys.argv[1:2] == ["--dartpy"]:
        print(json.dumps(play(_dartpy, sys.argv[2])))
    else:
        main(int(sys.argv[1]) if len(sys.argv) > 1 else 1000)
