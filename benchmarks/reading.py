"""What reading and writing costs next to Debian's dartpy on the same library, fullbody1 (37 dofs): time ratios.

Both run in child processes in turn, because they need different versions of NumPy; the least time of several rounds
counts. Vectors here have names, those of dartpy have none.
"""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "tests"))
from oracle.models import dart_model

ROUNDS = 5

COMMON = """
import json, sys, timeit
def least(call, count=20000):
    call()
    return min(timeit.repeat(call, number=count, repeat=5)) / count * 1e9
"""
OURS = """
import pydart2
world = pydart2.World(0.001, sys.argv[1])
skel = world.skeletons[1]
body = skel.body("h_hand_left")
q = skel.q
def set_q(): skel.q = q
def set_tau(): skel.tau = q
calls = {"q": lambda: skel.q, "dq": lambda: skel.dq, "M": lambda: skel.M, "c": lambda: skel.c,
         "T": lambda: body.T, "J": lambda: body.J, "C": lambda: skel.C, "q =": set_q, "tau =": set_tau}
"""
THEIRS = """
import dartpy
world = dartpy.utils.SkelParser.readWorld(sys.argv[1])
skel = world.getSkeleton(1)
body = skel.getBodyNode("h_hand_left")
q = skel.getPositions()
calls = {"q": skel.getPositions, "dq": skel.getVelocities, "M": skel.getMassMatrix,
         "c": skel.getCoriolisAndGravityForces, "T": body.getWorldTransform,
         "J": lambda: skel.getLinearJacobian(body), "C": skel.getCOM,
         "q =": lambda: skel.setPositions(q), "tau =": lambda: skel.setForces(q)}
"""
PRINT = """
print(json.dumps({name: least(call) for name, call in calls.items()}))
"""


def measure(python: str, program: str) -> dict[str, float]:
    """ns of each call."""
    command = [python, "-c", COMMON + program + PRINT, str(dart_model("skel/fullbody1.skel"))]
    result: dict[str, float] = json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)
    return result


def main() -> None:
    """Run both in turn, several times."""
    ours, theirs = [], []
    for _ in range(ROUNDS):
        ours.append(measure(sys.executable, OURS))
        theirs.append(measure("/usr/bin/python3", THEIRS))
    print(f"{'':6} {'pydart2':>8} {'dartpy':>8}  ratio (of the rounds)")
    for name in ours[0]:
        ratios = sorted(a[name] / b[name] for a, b in zip(ours, theirs, strict=True))
        a, b = min(run[name] for run in ours), min(run[name] for run in theirs)
        print(f"{name:6} {a:5.0f} ns {b:5.0f} ns  {ratios[ROUNDS // 2]:.2f} ({ratios[0]:.2f} to {ratios[-1]:.2f})")


if __name__ == "__main__":
    main()
