"""The parent's side of Debian's DART binding: ask the child process, get NumPy arrays."""

from __future__ import annotations

import contextlib
import os
import re
import signal
import subprocess
import tempfile
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import IO, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .wire import OracleError, OracleMissing, decode, encode

DEBIAN_PYTHON = "/usr/bin/python3"
CONTACT = np.dtype(
    [
        ("point", float, 3),
        ("force", float, 3),
        ("normal", float, 3),
        ("depth", float),
        ("skel1", int),
        ("body1", int),
        ("skel2", int),
        ("body2", int),
    ]
)


@dataclass(frozen=True)
class Frame:
    """The world after `step` steps.

    Attributes
    ----------
    step, time
        Steps done and the engine's clock, in seconds.
    skeletons
        One dict of arrays per skeleton, in the order of the world; see `DartpyOracle.simulate`.
    contacts
        Structured array of dtype `CONTACT` in the engine's order, in world coordinates: point in metres,
        force in newtons on the first body, normal (towards the first body), depth in metres, and the indices
        of both bodies and of their skeletons, -1 for a frame of no skeleton. They are those that the last
        step saw, which was before it moved the bodies. Empty at step 0.
    """

    step: int
    time: float
    skeletons: list[dict[str, Any]]
    contacts: NDArray[Any]


@dataclass(frozen=True)
class Simulation:
    """What `DartpyOracle.simulate` returns; ``simulation[step]`` is the `Frame` of that step.

    Attributes
    ----------
    dt, gravity
        Time step in seconds, gravity (3,) in m/s² in world coordinates.
    skeletons
        One dict per skeleton: name, mobile, mass (kg), bodies, body_masses, joints, joint_types, dofs (names
        in the engine's order) and the limits q_lower, q_upper, dq_lower, dq_upper, tau_lower, tau_upper, (n,)
        each.
    frames
        The frames asked for, by step.
    """

    dt: float
    gravity: NDArray[np.float64]
    skeletons: list[dict[str, Any]]
    frames: dict[int, Frame]

    def __getitem__(self, step: int) -> Frame:
        return self.frames[step]


class DartpyOracle:
    """Debian's ``dartpy`` in a child process, started at the first question and kept for the next ones.

    Questions do not influence each other. One on which the engine aborts raises `OracleError` with what the
    engine printed. Use it as a context manager, or call `close`.

    Parameters
    ----------
    python
        The interpreter that has ``dartpy``.
    patience
        Whole seconds after which a question is given up.
    """

    def __init__(self, python: str = DEBIAN_PYTHON, patience: int = 600) -> None:
        self._python = python
        self._patience = patience
        self._child: subprocess.Popen[str] | None = None
        self._log: IO[str] | None = None

    def __enter__(self) -> DartpyOracle:
        return self

    def __exit__(self, *error: object) -> None:
        self.close()

    def simulate(
        self,
        model: str | Path | Sequence[str | Path],
        *,
        dt: float | None = None,
        gravity: ArrayLike | None = None,
        detector: str | None = None,
        packages: dict[str, str | Path] | None = None,
        skeleton_states: Sequence[tuple[ArrayLike, ArrayLike] | None] | None = None,
        forces: Sequence[ArrayLike | None] | None = None,
        steps: int = 0,
        report_at: Iterable[int] | None = None,
        fields: Sequence[str] | None = None,
    ) -> Simulation:
        """Build a world from files, set its state, step it and report.

        Parameters
        ----------
        model
            A file or several. A .skel or an SDF file with a <world> gives the world, and must come first;
            other SDF files and .urdf give skeletons, added in order. Without a world file the world is empty
            at first, with gravity (0, -9.81, 0).
        dt, gravity, detector
            Set after all skeletons are in; None leaves what the file or the engine has (0.001 s; gravity
            above; fcl with meshes). A detector ("fcl", "dart", "bullet", "ode") is one as created: "fcl"
            turns primitives into meshes, while the <collision_detector>fcl of a SKEL file does not.
        packages
            Folders of the package:// URIs of URDF files, by package name.
        skeleton_states
            (q, dq) of each skeleton in world order, None to leave one as loaded.
        forces
            Generalized forces of each skeleton, set again before every step; None for none.
        steps, report_at
            Steps to do and the steps to report, 0 and `steps` by default.
        fields
            Which of the fields below to report; all by default.

        Returns
        -------
        Simulation
            Each frame has per skeleton (n dofs, b bodies; SI units, world coordinates, angles in rad): q, dq,
            ddq, c (Coriolis and gravity), g (gravity), constraint_forces (n,); M (n, n); C, dC, centre of
            mass and its velocity (3,); T (b, 4, 4) body to world; J, Jang (b, 3, n), linear Jacobian of the
            body origin and angular Jacobian, a column for every dof of the skeleton; kinetic and potential
            energy, scalars in J.

        Notes
        -----
        For soft bodies the engine computes g partly from memory that it never initialised: compare c
        instead. Their masses here are without the point masses.
        """
        asked = sorted({0, steps} if report_at is None else set(report_at))
        if asked and not 0 <= asked[0] <= asked[-1] <= steps:
            raise ValueError(f"report_at must lie within 0..{steps}, got {asked}")
        files = [model] if isinstance(model, (str, Path)) else model
        request = {
            "models": [os.path.abspath(file) for file in files],
            "dt": dt,
            "gravity": gravity,
            "detector": detector,
            "packages": {name: os.path.abspath(folder) for name, folder in (packages or {}).items()},
            "skeleton_states": skeleton_states,
            "forces": forces,
            "steps": steps,
            "report_at": asked,
            "fields": fields,
        }
        return _simulation(self._ask(request))

    def close(self) -> None:
        """End the child process, if there is one."""
        if self._child is None:
            return
        assert self._child.stdin is not None and self._child.stdout is not None and self._log is not None
        with contextlib.suppress(ProcessLookupError):
            os.killpg(self._child.pid, signal.SIGKILL)  # with the fork that may be working on a question
        self._child.wait()
        self._child.stdout.close()
        self._log.close()
        with contextlib.suppress(BrokenPipeError):  # closing writes what a dead child did not read
            self._child.stdin.close()
        self._child = None

    def _ask(self, request: dict[str, Any]) -> Any:
        line = encode({**request, "patience": self._patience}) + "\n"
        if self._child is None:
            self._start()
        assert self._child is not None and self._child.stdin is not None and self._log is not None
        self._log.seek(0)
        self._log.truncate()
        with contextlib.suppress(BrokenPipeError):  # _answer says why it is gone
            self._child.stdin.write(line)
            self._child.stdin.flush()
        try:
            return self._answer()
        except OracleError:
            raise
        except BaseException:  # interrupted: the answer still to come would be taken for the next question's
            self.close()
            raise

    def _start(self) -> None:
        """Start the child and wait until it has imported the binding."""
        if not os.access(self._python, os.X_OK):
            raise OracleMissing(f"the oracle needs {self._python}: apt-get install python3 python3-dartpy")
        # A file, not a pipe: nobody would empty a pipe while waiting for the answer.
        self._log = tempfile.TemporaryFile("w+", errors="replace")  # noqa: SIM115 - closed by close()
        self._child = subprocess.Popen(
            # -E and -s: neither the environment nor the user's own packages may replace Debian's.
            [self._python, "-E", "-s", str(Path(__file__).with_name("dartpy_child.py"))],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=self._log,
            text=True,
            start_new_session=True,
            # Preloaded libraries (sanitizers, allocators) are for the tested package, not for its oracle.
            env={name: value for name, value in os.environ.items() if not name.startswith("LD_")},
        )
        try:
            self._answer()
        except OracleError as error:
            missing = re.search("No module named '(dartpy|numpy)'", str(error))
            if missing is None:
                raise
            raise OracleMissing(
                f"{self._python} has no module {missing[1]!r}, the oracle needs it: "
                "apt-get install python3-dartpy python3-numpy"
            ) from error

    def _answer(self) -> Any:
        """Return the child's next answer; raise with the end of what was printed if there is none."""
        assert self._child is not None and self._child.stdout is not None and self._log is not None
        line = self._child.stdout.readline()
        answer = decode(line) if line else {"error": f"{self._python} ended with status {self._child.wait()}"}
        if "error" not in answer:
            return answer["result"]
        self._log.seek(0)
        printed = self._log.read()[-4000:]
        if not line:
            self.close()
        raise OracleError(f"{answer['error']}\n{printed}")


def _simulation(result: dict[str, Any]) -> Simulation:
    frames = {
        item["step"]: Frame(item["step"], item["time"], item["skeletons"], _contacts(item["contacts"]))
        for item in result["frames"]
    }
    return Simulation(result["dt"], result["gravity"], result["skeletons"], frames)


def _contacts(table: dict[str, NDArray[Any]]) -> NDArray[Any]:
    """Return the two plain tables of a child's contacts as one array of dtype `CONTACT`."""
    numbers, bodies = table["numbers"], table["bodies"]
    contacts = np.zeros(len(numbers), dtype=CONTACT)
    for column, name in enumerate(("point", "force", "normal")):
        contacts[name] = numbers[:, 3 * column : 3 * column + 3]
    contacts["depth"] = numbers[:, 9]
    for column, name in enumerate(("skel1", "body1", "skel2", "body2")):
        contacts[name] = bodies[:, column]
    return contacts
