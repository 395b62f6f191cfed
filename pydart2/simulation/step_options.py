"""How a world steps: who finds contacts, who solves them, who moves the skeletons, and what a step does that fails."""

from __future__ import annotations

import numpy as np

from pydart2.errors import NameNotFound
from pydart2.simulation.part import WorldPart

_ITERATIVE: dict[str, float | str] = {
    "iterations": 28,
    "tolerance": 3e-6,
    "friction": "pyramid",
    "stabilisation": "split",
    "error_reduction": 0.2,
    "allowance": 1e-6,
    "correction_speed": 1.0,
    "threads": 1,
}
_ITERATIVE_NAMES = {"friction": ("pyramid", "cone", "engine"), "stabilisation": ("engine", "split")}
#: By number. 4 stays free: old code asks for it to find out that its engine has it not.
DETECTORS = {0: "dart", 1: "fcl", 2: "bullet", 3: "ode", 10: "native"}


def _option_number(option: str, value: float | str) -> float:
    """What C++ gets for an option of the iterative solver; NameNotFound for a word that is none of its."""
    if option not in _ITERATIVE_NAMES:
        return float(value)
    names = _ITERATIVE_NAMES[option]
    if value not in names:
        raise NameNotFound(option, str(value), ", ".join(names), names)
    return names.index(str(value))


def detector_number(name: str) -> int:
    """The number of a collision detector's name, -1 for one without."""
    return next((number for number, known in DETECTORS.items() if known == name), -1)


class StepOptions(WorldPart):
    """The part of World that says how it steps."""

    def set_collision_detector(self, detector: int | str) -> None:
        """Choose how contacts are found: "dart", "fcl", "bullet", "ode", "native" or one of `*_COLLISION_DETECTOR`.

        "native" is the package's own, the others are the engine's. ValueError for any other, NameNotFound for a name.
        """
        if isinstance(detector, str) and detector not in DETECTORS.values():
            raise NameNotFound("collision detector", detector, ", ".join(DETECTORS.values()), DETECTORS.values())
        if not isinstance(detector, str) and not (isinstance(detector, (int, np.integer)) and detector in DETECTORS):
            known = " ".join(f"{i} ({name})" for i, name in DETECTORS.items())
            raise ValueError(f"no collision detector {detector!r}; they are {known}")
        self._handle.set_collision_detector(detector if isinstance(detector, str) else DETECTORS[int(detector)])

    def collision_detector(self) -> int:
        """One of the `*_COLLISION_DETECTOR`, -1 for another."""
        return detector_number(self._handle.collision_detector())

    def collision_detector_string(self) -> str:
        """Name of the detector's constant, as ``"FCL_COLLISION_DETECTOR"``."""
        return f"{self._handle.collision_detector().upper()}_COLLISION_DETECTOR"

    def set_dynamics(self, name: str) -> None:
        """Choose the code that moves the skeletons; ValueError for an unknown name.

        "fast" (default) is of ours: articulated-body forward dynamics, impulses and integration in the engine's order,
        with bitwise the same results. A moving chain without contact steps in less than half of the engine's time;
        contacts cost what they did. It covers rigid skeletons with all joints and actuators of the engine; soft ones,
        and one with a locked joint that moves, take the engine's code in that step. "engine" is the engine's own. The
        environment variable ``PYDART2_DYNAMICS`` names the one that new worlds start with.
        """
        self._handle.set_dynamics(name)

    def dynamics(self) -> str:
        """Name of the dynamics, "engine" or "fast"."""
        return self._handle.dynamics()

    def set_integrator(self, name: str) -> None:
        """Choose how velocities and positions go on in a step; ValueError for an unknown name.

        - "engine" (default): semi-implicit Euler, joint damping and springs implicit, Coriolis forces explicit.
        - "implicit": the same with Coriolis forces implicit too, by their derivatives. Fast turning bodies and limp
          chains stay stable; energy falls.
        - "rk4": the classical Runge-Kutta method, of fourth order in the step; damping and springs explicit.
        - "variational": discrete Lagrangian mechanics, of second order; energy stays near its value for ever.

        The last two are for skeletons that move freely: where in a step a contact, a limit or another constraint acts
        on a skeleton, a joint's motion is prescribed or the method finds no solution, the skeleton takes the engine's
        rule in that step; `Skeleton.integrator_fallbacks` counts these. Soft bodies always do. All but "engine" need
        the dynamics "fast", else ValueError.
        """
        self._handle.set_integrator(name)

    def integrator(self) -> str:
        """Name of the integrator, "engine", "implicit", "rk4" or "variational"."""
        return self._handle.integrator()

    def set_constraint_solver(self, name: str, **options: float | str) -> None:
        """Choose the code that solves contacts and constraints; ValueError for an unknown name.

        "fast" (default) and "dart", the engine's own, which gives bitwise the same states and contact forces. The
        environment variable ``PYDART2_SOLVER`` names the one that new worlds start with.

        "iterative" sweeps over the rows of all contacts and constraints until they agree: its time grows with their
        number, not with the cube of it, and its results are approximate. It switches set_warm_start() and
        set_contact_reduction() on, the others switch them off. Its options (a TypeError for others):

        ========================== ======================================================================
        `iterations` = 28          sweeps in a step, at most
        `tolerance` = 3e-6         m/s, rad/s: the residual at which the sweeps end. With "split", what impulses
                                   move and is slower than 100 of these (of 3e-6 at most) loses two in a step
        `friction` = "pyramid"     each of two tangents within mu times the normal force, so that along their
                                   diagonal it reaches sqrt(2) times that; "cone": both together; "engine": bounds
                                   from the normal forces without friction, which the engine takes
        `stabilisation` = "split"  depth is taken away by moving the bodies, which their velocities do not see;
                                   "engine": by velocities, at 1 mm/s at most
        `error_reduction` = 0.2    part of the depth that a step of "split" takes away
        `allowance` = 1e-6         m: depth that "split" leaves, and from twice which on it acts; 1e-4 at least with
                                   other detectors than "native", which alone sees what nearly touches
        `correction_speed` = 1     m/s: "split" is not faster
        `threads` = 1              that solve the groups of what touches each other, 1 in a `Batch`; results do not
                                   depend on it
        ========================== ======================================================================

        Groups of up to 40 contacts which the sweeps leave more than 1 cm/s from a solution, as where a light body lies
        below a heavy one, are then solved by Newton's method. Groups with soft bodies, or constraints of other classes
        than the engine's, are solved as by "fast".
        """
        unknown = [option for option in options if option not in _ITERATIVE]
        if unknown or (options and name != "iterative"):
            known = ", ".join(_ITERATIVE) if name == "iterative" else "none"
            raise TypeError(f"solver {name!r} has no option {(unknown or list(options))[0]!r}; its options: {known}")
        numbers = [_option_number(option, value) for option, value in (_ITERATIVE | options).items()]
        before = self._handle.constraint_solver()
        if name == "iterative":
            self._handle.set_iterative_options(np.array(numbers))
        else:
            self._handle.set_constraint_solver(name)
        if "iterative" in (before, name) and before != name:
            self._handle.set_warm_start(name == "iterative")
            self._handle.set_contact_reduction(name == "iterative")

    def constraint_solver(self) -> str:
        """Name of the constraint solver, "fast", "dart" or "iterative"."""
        return self._handle.constraint_solver()

    def constraint_solver_options(self) -> dict[str, float | str]:
        """The options of the constraint solver; none of "fast" and "dart"."""
        if self.constraint_solver() != "iterative":
            return {}
        values: dict[str, float | str] = dict(zip(_ITERATIVE, self._handle.iterative_options().tolist(), strict=True))
        for option in ("iterations", "threads"):
            values[option] = int(values[option])
        for option, names in _ITERATIVE_NAMES.items():
            values[option] = names[int(values[option])]
        return values

    def solver_iterations(self) -> int:
        """How many sweeps the "iterative" solver made in the last step, in the group with the most; else 0."""
        return self._handle.solver_iterations()

    def solver_residual(self) -> float:
        """How far the last step's forces of the "iterative" solver are from a solution, in m/s (rad/s for joints).

        The largest over the rows of ``W |x - P(x - w / W)|``: impulse x, velocity w that is left, the velocity W that a
        unit impulse gives, and P what brings an impulse within its bounds or into the friction cone.
        """
        return self._handle.solver_residual()

    def set_deterministic(self, enable: bool = True) -> None:
        """Make each step a function of the state alone, by forgetting first what detectors and constraints remember.

        The order of contacts is then not the engine's, and a step of `skel/fullbody1.skel` takes 0.2 ms more. With a
        warm start the state is that of a snapshot, which `x` is not.
        """
        self._handle.set_deterministic(enable)

    def is_deterministic(self) -> bool:
        """Whether each step is a function of the state alone."""
        return self._handle.deterministic()

    def set_blow_up(self, manner: str) -> None:
        """Choose what a step does whose numbers become infinite: "raise" (default) a SimulationError, or "nan".

        With "nan" the skeletons concerned read NaN in `q`, `dq`, `ddq` and `x` from then on, as older code awaits that
        asks ``np.isfinite(skel.q).all()``. Forces and commands that are set on them are ignored, further steps change
        the time alone, the other skeletons stay. reset(), restore(), set_states(), or a new `q` of the skeleton bring
        them back. Clones, pickles and batches have the setting; a world that reads NaN cannot be copied.
        """
        if manner not in ("raise", "nan"):
            raise ValueError(f'a step that blows up can "raise" or give "nan", got {manner!r}')
        self._handle.set_nan_at_blow_up(manner == "nan")

    def blow_up(self) -> str:
        """What a step does whose numbers become infinite: "raise" or "nan"."""
        return "nan" if self._handle.nan_at_blow_up() else "raise"

    def set_contact_reduction(self, enable: bool = True) -> None:
        """Let at most four contacts of each pair of faces bear forces, those that span the largest area.

        Off by default, on with "iterative". Faster where bodies meet in many points, but the results are no longer the
        engine's: the forces of a face spread over other points. The other contacts stay in `collision_result`, with
        force 0. With "iterative" and the "native" detector it changes nothing: that has four a pair of shapes.
        """
        self._handle.set_contact_reduction(enable)

    def contact_reduction(self) -> bool:
        """Whether contacts of a pair of faces are reduced to four."""
        return self._handle.contact_reduction()

    def set_warm_start(self, enable: bool = True) -> None:
        """Let the "fast" or "iterative" solver begin the search for the contact forces from those of the step before.

        Off by default, on with "iterative". Faster where many contacts last, but the forces of "fast" are the engine's
        to rounding only (nearer to the solution where the engine's direct solver gives up): what rests stays where it
        is, what tumbles takes another path after a while. What is remembered of the step
        before is in a snapshot; reset() forgets it.
        """
        self._handle.set_warm_start(enable)

    def warm_start(self) -> bool:
        """Whether the search for the contact forces begins from those of the step before."""
        return self._handle.warm_start()

    @property
    def max_contacts(self) -> int | None:
        """How many contacts a step takes; None, the default, for as many as there are.

        Bodies whose contacts are left out pass through each other; the first time that happens is a warning.
        """
        return self._handle.max_contacts() or None

    @max_contacts.setter
    def max_contacts(self, most: int | None) -> None:
        self._handle.set_max_contacts(0 if most is None else most or -1)

    @property
    def constraint_error_reduction(self) -> float:
        """The share of what ball, weld, revolute and distance constraints are off that a step takes away, 0 to 1.

        0.2, or the engine's 0.01 with ``engine_defaults=True``: that holds a fast four-bar to a millimetre or two at
        1 ms, 0.2 to a tenth of that. set_integrator("rk4") leaves nothing to take away.
        """
        return self._handle.constraint_error_reduction()

    @constraint_error_reduction.setter
    def constraint_error_reduction(self, share: float) -> None:
        self._handle.set_constraint_error_reduction(share)

    @property
    def contact_memory_limit(self) -> float:
        """Bytes that the equations of one group of touching bodies may take, 1e9 unless set.

        The exact solvers need 16 bytes for each pair of rows, three rows a contact. A step that needs more is a
        SimulationError, and takes nothing.
        """
        return self._handle.contact_memory_limit()

    @contact_memory_limit.setter
    def contact_memory_limit(self, limit: float) -> None:
        self._handle.set_contact_memory_limit(limit)
