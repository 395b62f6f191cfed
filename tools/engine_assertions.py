"""Lists the assertions of DART that end the process even though failed ones throw: tests/engine_assertions.txt.

    python tools/engine_assertions.py            writes the table anew
    python tools/engine_assertions.py --print    prints it

`src/cpp/engine/assertions.cpp` lets a failed assertion throw. The compiler took for granted that it does not: a
function that has a table of call sites (for its own destructors and handlers) has no entry for the assertion, and the
runtime ends the process there. The table has a row for each file and expression, with what keeps input from it.
"""

from __future__ import annotations

import re
import subprocess
import sys
from bisect import bisect
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

from elftools.dwarf.callframe import FDE
from elftools.elf.elffile import ELFFile

LIBRARIES = ("libdart", "libdart-utils", "libdart-utils-urdf", "libdart-collision-bullet", "libdart-collision-ode")
TABLE = Path(__file__).parents[1] / "tests" / "engine_assertions.txt"
TEST = "test_engine_assertions.py::test_what_input_reaches_is_refused"
TRIED = "a file that does this ends the process in which new texts are tried: test_fuzz.py::test_damaged_models"
DOFS = (
    "sizes of the engine's own vectors and matrices, made from the number of dofs; arrays of users have theirs checked"
)

#: Where the first pattern is in the file's name and the second in the expression, what keeps input away. The first row
#: that fits counts. "refused" names the case of TEST that tries it.
RULES = [
    (
        "^(IkFast|InverseKinematics|HierarchicalIK|GradientDescent|Problem|Population|BalanceConstraint)",
        "",
        "not called: inverse kinematics is our own",
    ),
    # What a call could ask for, and is refused.
    ("^(Box|Capsule|Cone|Cylinder|Pyramid)Shape", "> 0.0|0.0 <", "refused: sizes"),
    ("^BodyNode.cpp", "Coefficient of friction", "refused: friction"),
    ("^BodyNode.cpp", "Coefficient of restitution", "not called: contacts read the coefficients of shapes"),
    ("^GenericJoint", "^d >=", "refused: damping"),
    ("^GenericJoint", "^k >=", "refused: stiffness"),
    ("^GenericJoint", "^friction >=", "refused: Coulomb friction"),
    ("^(GenericJoint|ConstraintSolver)", "timeStep > 0", "refused: time step"),
    ("^GenericJoint", "^false", "refused: index of a dof, actuator type, number of values"),
    ("^(MetaSkeleton|ReferentialSkeleton)", "^false", "refused: number of values"),
    ("^Skeleton.cpp", "getMass", "refused: centre of no mass"),
    ("^Skeleton.cpp", "^false", "refused: index of a body, number of values"),
    ("^StlHelpers", "index", "refused: index of a body"),
    ("^JointConstraint", "LowerLimits", "refused: limits the wrong way round"),
    ("^WeldJointConstraint", "_body1 != _body2", "refused: a body welded to itself"),
    ("^MimicMotorConstraint", "getNumDofs|mimicJoint", "refused: mimic of another number of dofs, of no joint"),
    ("^ConstrainedGroup", "duplicate|not existing", "refused: a constraint twice"),
    ("^OdeHeightmap", "", "refused: heights in one row"),
    (
        "^ConstraintSolver|^World.cpp",
        "[Nn]ull|^constraint$|_frame|mConstraintSolver",
        "no call passes a null pointer on",
    ),
    (
        "^Skeleton.cpp|^FreeJoint",
        "getSkeleton|nullptr|getNumDofs",
        "bodies come from the skeleton's own lists; frames are not passed",
    ),
    # What the state could do.
    ("LcpConstraintSolver|LCPSolver", "isSymmetric", "replaced: engine/boxed_lcp.cpp; test_engine_solver.py"),
    ("LcpConstraintSolver", "getDimension", "taken out: engine/boxed_lcp.cpp; test_engine_solver.py"),
    ("LcpConstraintSolver", "mBoxedLcpSolver", "every world has one from the start"),
    ("(DantzigLCP|PGSLCP)Solver", "", "not called: solvers of before DART 6.7"),
    ("ContactConstraint", "isNan|lambda", "states are finite, and the solver takes zero for a solution with NaN"),
    (
        "ContactConstraint",
        "normal",
        "contacts without a normal or with NaN are left out, tangents normalised; states are finite",
    ),
    ("SoftContactConstraint", "D.col", "normals are made units: test_contacts.py::test_normals_are_units"),
    ("Constraint.cpp", "isActive|isReactive", "the solver asks isActive() first, which says whether a body can move"),
    ("^JointConstraint", "bouncing", "signs of a product with a restitution, which is not negative"),
    (
        "Constraint.cpp",
        "_?(index|idx) < mDim|localIndex|_?[vV]el|^delVel|_delVel",
        "loops of the solver from 0 to getDimension()",
    ),
    (
        "Constraint.cpp",
        "mBodyNode|shapeNode|^0$|^false$|nullptr",
        "a joint has a child, a contact two shapes of bodies; other shapes are not made",
    ),
    ("^ConstrainedGroup", "", "the solver adds active constraints alone"),
    ("^ConstraintSolver", "shapeNode", "all shapes belong to bodies"),
    ("^BodyNode.cpp", "isNan", "states are finite: check::finite, and the step's checks"),
    (
        "^(BodyNode|PointMass|SoftBodyNode|SoftMeshShape).cpp",
        "nullptr|_skeleton$|!= nullptr",
        "made by the engine, with its owner",
    ),
    ("^SoftBodyNode", "frags", TRIED),
    ("^BodyNode.cpp", "cols|getNumDependentGenCoords", DOFS),
    ("^BodyNode.cpp", "^false", "refused: index of a shape"),
    ("^World.cpp", "^false", "indices are checked; names that are taken get a number"),
    ("^Skeleton.cpp", "cache|node_it|nodeVec", DOFS),
    # Detectors.
    ("CollisionDetector.cpp", "dynamic_cast", "the shape's type, asked just before, says which class it is"),
    (
        "Collision(Detector|Group|Object)",
        "",
        "objects, groups and worlds that the detectors make, and keep as long as they are used",
    ),
    (
        "^(CollisionResult|CollisionFilter|DistanceFilter)",
        "",
        "contacts name shapes that are there; the filter asks of one skeleton first",
    ),
    ("^OcTree", "", "octrees cannot be made"),
    # Files.
    ("(Skel|Sdf|Vsk|Mjcf)Parser|XmlHelpers|DartLoader|^Geometry", "", TRIED),
    ("^(Mujoco|Body.cpp|BodyAttributes|Inertial|Weld.cpp|Worldbody|Utils.cpp)", "", TRIED),
    ("^Uri", "", "groups of a regular expression that has matched; paths are absolute"),
    # The engine's own house.
    (
        "^(Node|NameManager|SpecializedNodeManager|VersionCounter|Composite|Aspect|EmbeddedAspect)",
        "",
        "lists that the engine keeps in step; aspects are not exchanged",
    ),
    (
        "^(Frame|FixedFrame)",
        "",
        "messages of frames that are asked for what they are not; the world's frame is not changed",
    ),
    ("^Skeleton.cpp|^ReferentialSkeleton", "", DOFS),
    ("^(Linkage|Group|Chain|Branch|SharedLibraryManager)", "", "not called: no groups, chains, linkages or plugins"),
    ("^Memory.h", "", "the C library aligns to 16 bytes"),
    (
        r"^(DenseStorage|MapBase)\.h",
        "explained here",
        "no fixed-size member is put where it is not aligned: the handles are allocated by the engine's makers",
    ),
    (r"\.h$", "", DOFS),
]


class Assertion(NamedTuple):
    """A precondition as the library has it."""

    file: str
    expression: str


def uleb(data: bytes, at: int) -> tuple[int, int]:
    """A number of the DWARF kind, and where the next one is."""
    value = shift = 0
    while True:
        byte = data[at]
        at += 1
        value |= (byte & 0x7F) << shift
        shift += 7
        if byte < 0x80:
            return value, at


class Library:
    """What the file of a shared library says of itself."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self.data = path.read_bytes()
        with path.open("rb") as opened:
            elf = ELFFile(opened)
            self.sections = [(s["sh_addr"], s["sh_size"], s["sh_offset"]) for s in elf.iter_sections() if s["sh_addr"]]
            entries = elf.get_dwarf_info(relocate_dwarf_sections=False).EH_CFI_entries()
            self.functions = sorted(  # begin, length, table of call sites
                (e.header["initial_location"], e.header["address_range"], e.lsda_pointer)
                for e in entries
                if isinstance(e, FDE)
            )

    def offset(self, address: int) -> int:
        """Where in the file an address is."""
        for start, size, offset in self.sections:
            if start <= address < start + size:
                return int(address - start + offset)
        raise ValueError(f"{address:#x} is in no section of {self.path}")

    def text(self, address: int) -> str:
        """The text at an address."""
        start = self.offset(address)
        return self.data[start : self.data.index(b"\0", start)].decode()

    def call_sites(self, table: int) -> list[tuple[int, int]]:
        """Begin and length, from the begin of the function, of the calls that may throw."""
        at = self.offset(table)
        assert self.data[at] == 0xFF, "landing pads from the begin of the function"
        at += 1
        if self.data[at] != 0xFF:  # the types that are caught
            _, at = uleb(self.data, at + 1)
        else:
            at += 1
        assert self.data[at] == 0x01, "call sites as ULEB128"
        length, at = uleb(self.data, at + 1)
        end, sites = at + length, []
        while at < end:
            start, at = uleb(self.data, at)
            size, at = uleb(self.data, at)
            _, at = uleb(self.data, at)
            _, at = uleb(self.data, at)
            sites.append((start, size))
        return sites

    def assertions(self) -> Iterator[tuple[int, Assertion]]:
        """The calls of __assert_fail: where, and what they say.

        Where a function has the name of the file in a register for long, that is the one of its other assertions, or of
        others that say the same.
        """
        command = ["objdump", "-d", "--no-show-raw-insn", str(self.path)]
        lines = subprocess.run(command, capture_output=True, text=True, check=True).stdout.splitlines()
        registers: dict[str, int | None] = {}
        calls, files = [], dict[int | None, int]()
        for line in lines:
            if loaded := re.search(r"lea .*\(%rip\),%(\w+) +# ([0-9a-f]+)", line):
                registers[loaded[1]] = int(loaded[2], 16)
            elif moved := re.search(r"mov +(\S+),%(r\w+)$", line):
                registers[moved[2]] = registers.get(moved[1].lstrip("%"))
            elif line.endswith("<__assert_fail@plt>") and "call" in line:
                expression, file, function = (registers.get(name) for name in ("rdi", "rsi", "rcx"))
                assert expression is not None, line
                calls.append((int(line.split(":")[0], 16), expression, file, function))
                if file is not None:
                    files[function] = files[expression] = file
        for call, expression, file, function in calls:
            where = file or files.get(function) or files[expression]
            yield call, Assertion(Path(self.text(where)).name, " ".join(self.text(expression).split()))

    def ends_process(self, call: int) -> bool:
        """Whether an exception out of a call finds no entry in the table of its function."""
        start, size, table = self.functions[bisect(self.functions, call, key=lambda function: function[0]) - 1]
        if not start <= call < start + size:
            raise ValueError(f"{call:#x} is in no function of {self.path}")
        return table is not None and not any(b <= call - start < b + n for b, n in self.call_sites(table))


def installed(name: str) -> Path:
    """The file of a library that the linker takes."""
    listed = subprocess.run(["/sbin/ldconfig", "-p"], capture_output=True, text=True, check=True).stdout
    found = re.search(rf"{re.escape(name)}\.so[.0-9]* .*=> (\S+)", listed)
    if found is None:
        raise FileNotFoundError(f"{name} is not installed")
    return Path(found[1]).resolve()


def count() -> tuple[Counter[Assertion], int]:
    """How many sites of each assertion end the process, and how many sites there are in all."""
    deadly, sites = Counter[Assertion](), 0
    for name in LIBRARIES:
        library = Library(installed(name))
        for call, assertion in library.assertions():
            sites += 1
            deadly[assertion] += library.ends_process(call)
    return +deadly, sites


def answer(assertion: Assertion) -> str:
    """What keeps input from an assertion."""
    for file, expression, what in RULES:
        if re.search(file, assertion.file) and re.search(expression, assertion.expression):
            return what
    raise LookupError(f"no rule for {assertion.expression!r} in {assertion.file}: what keeps input from it?")


def table() -> str:
    """The text of the table."""
    deadly, sites = count()
    rows = sorted(f"{a.file} | {n} | {a.expression[:110]} | {answer(a)}" for a, n in deadly.items())
    head = [
        "# Written by tools/engine_assertions.py, which says what it is.",
        f"# {sites} assertions in {len(LIBRARIES)} libraries; {deadly.total()} of them end the process if they fail.",
        "# file | sites that end the process | expression | what keeps input from it",
    ]
    return "\n".join([*head, *rows]) + "\n"


if __name__ == "__main__":
    if sys.argv[1:] == ["--print"]:
        print(table(), end="")
    else:
        TABLE.write_text(table())
