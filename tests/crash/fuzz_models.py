"""Loads damaged models: each is loaded or refused with a LoadError, the process lives, and its world still steps.

    python tests/crash/fuzz_models.py 5000 [FIRST]    five thousand files, from number FIRST

URDF, SDF, SKEL, MJCF (by MuJoCo's compiler and by the engine), and meshes under a model that is whole. File n is the
same in each run. One that ends the process is put into ``tests/crash/seeds``, where the tests find it.
"""

from __future__ import annotations

import collections
import copy
import itertools
import logging
import os
import random
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ET
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from importlib.util import find_spec
from pathlib import Path

if __name__ == "__main__":
    sys.path.insert(0, str(Path(__file__).parents[1]))

import pydart2
from oracle.models import dart_data
from pydart2.loading import Reader

SEEDS = Path(__file__).parent / "seeds"
NUMBERS = (
    *("nan", "inf", "-inf", "0", "-0", "-1", "1e308", "-1e308", "1e-308", "1e12", "1e-12", "99999999999999999999"),
    *("", " ", "x", "1,2", "0x10", "1 2", "1 2 3", "1 2 3 4 5 6 7", "true", "world", "9" * 400, "&lt;", "\u0663"),
)
LARGEST = 15_000  # bytes; larger models are slow to load and say the same
MOST_SECONDS = 10.0  # of processor time
#: The processes import the same package.
ENVIRONMENT = {**os.environ, "PYTHONPATH": str(Path(pydart2.__file__).parents[1])}
MESHES = (".obj", ".stl", ".dae", ".ply", ".off")
#: What a damaged mesh is part of: seen and collided with, and mirrored.
AROUND_A_MESH = """<robot name="r"><link name="l">
<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
<visual><geometry><mesh filename="{0}"/></geometry></visual>
<collision><geometry><mesh filename="{0}" scale="-1 1 1"/></geometry></collision></link></robot>"""
#: An OFF and a PLY of the kind that others write; the packages bring the other formats.
OFF = "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n"
PLY = (
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 4\nproperty list uchar int vertex_indices\nend_header\n" + OFF.split("\n", 2)[2]
)


@dataclass(frozen=True)
class Damaged:
    """What a damaged file holds, its suffix if it is a mesh, and which of MJCF's readers gets it."""

    data: bytes
    mesh: str = ""
    reader: Reader = "engine"

    @classmethod
    def seed(cls, path: Path) -> Damaged:
        """One of ``tests/crash/seeds``."""
        mesh = path.suffix if path.suffix in MESHES else ""
        return cls(path.read_bytes(), mesh, "mujoco" if path.stem.endswith("-mujoco") else "engine")


@cache
def mjcf_originals() -> list[Path]:
    """Gymnasium's robots, for MuJoCo's compiler."""
    found = find_spec("gymnasium")
    assert found and found.origin, "gymnasium is not installed: pip install gymnasium"
    return sorted((Path(found.origin).parent / "envs" / "mujoco" / "assets").glob("*.xml"))


@cache
def mesh_originals() -> list[tuple[str, bytes]]:
    """Suffix and content of small meshes: DART's, airo-models' and two from here."""
    found = find_spec("airo_models")
    assert found and found.origin, "airo-models is not installed: pip install airo-models"
    paths = [path for root in (dart_data(), Path(found.origin).parent) for path in sorted(root.rglob("*"))]
    small = [path for path in paths if path.suffix.lower() in MESHES and path.stat().st_size < 2 * LARGEST]
    return [(path.suffix.lower(), path.read_bytes()) for path in small] + [
        (".off", OFF.encode()),
        (".ply", PLY.encode()),
    ]


@cache
def originals() -> list[Path]:
    """Models for the engine's readers to be damaged: DART's own small ones and ours."""
    ours = [Path(pydart2.data_path(f"skel/{name}.skel")) for name in ("cubes", "chain", "shapes")]
    root = dart_data()
    theirs = (path for path in sorted(root.rglob("*")) if path.suffix in (".skel", ".urdf", ".sdf", ".xml", ".vsk"))
    readable = (path for path in theirs if path.relative_to(root).parts[0] != "skel_old" and "fetch" not in path.parts)
    return ours + [path for path in readable if path.is_file() and path.stat().st_size < LARGEST]


# Ways to damage a tree


def _elements(root: ET.Element) -> list[tuple[ET.Element, ET.Element]]:
    return [(parent, child) for parent in root.iter() for child in parent]


def _delete(root: ET.Element, rng: random.Random) -> None:
    parent, child = rng.choice(_elements(root))
    parent.remove(child)


def _double(root: ET.Element, rng: random.Random) -> None:
    parent, child = rng.choice(_elements(root))
    parent.insert(rng.randrange(len(parent) + 1), copy.deepcopy(child))  # the same one could end up inside itself


def _move(root: ET.Element, rng: random.Random) -> None:
    """Also into what is no parent of its kind."""
    parent, child = rng.choice(_elements(root))
    parent.remove(child)
    rng.choice(list(root.iter())).append(child)


def _rename(root: ET.Element, rng: random.Random) -> None:
    rng.choice(list(root.iter())).tag = rng.choice(list(root.iter())).tag


def _number(root: ET.Element, rng: random.Random) -> None:
    """One number, or a whole text or attribute."""
    element = rng.choice(list(root.iter()))
    value = rng.choice(NUMBERS)
    keys = [*element.attrib, None]
    key = rng.choice(keys)
    old = (element.text or "") if key is None else element.attrib[key]
    numbers = list(re.finditer(r"[-+.\deE]+", old))
    if numbers and rng.random() < 0.8:
        at = rng.choice(numbers)
        value = old[: at.start()] + value + old[at.end() :]
    if key is None:
        element.text = value
    else:
        element.attrib[key] = value


def _attribute(root: ET.Element, rng: random.Random) -> None:
    """Drop one, or give it the value of another."""
    with_some = [element for element in root.iter() if element.attrib]
    if not with_some:
        return
    element = rng.choice(with_some)
    key = rng.choice(list(element.attrib))
    if rng.random() < 0.5:
        del element.attrib[key]
    else:
        element.attrib[key] = rng.choice(list(rng.choice(with_some).attrib.values()))


def _text(root: ET.Element, rng: random.Random) -> None:
    """The text of another element."""
    rng.choice(list(root.iter())).text = rng.choice(list(root.iter())).text


TREE_CHANGES: tuple[Callable[[ET.Element, random.Random], None], ...] = (
    *(_delete, _double, _move, _rename, _attribute, _text),
    *(_number, _number, _number),
)


def damage_tree(root: ET.Element, rng: random.Random) -> bytes:
    """Some changes, most often one."""
    for _ in range(rng.choice((1, 1, 1, 2, 3, 8))):
        if len(root):
            rng.choice(TREE_CHANGES)(root, rng)
    return ET.tostring(root)


def _damage_bytes(data: bytes, rng: random.Random) -> bytes:
    """Flip, cut out, repeat or cut off."""
    at, length = rng.randrange(len(data)), rng.randrange(1, 40)
    kind = rng.randrange(4)
    if kind == 0:
        return data[:at] + bytes([rng.randrange(256)]) + data[at + 1 :]
    if kind == 1:
        return data[:at] + data[at + length :]
    if kind == 2:
        return data[:at] + data[at : at + length] * rng.randrange(2, 5) + data[at + length :]
    return data[:at]


def _damage_words(data: bytes, rng: random.Random) -> bytes:
    """Numbers of a text."""
    words = list(re.finditer(rb"[-+]?\d[-+.\deE]*", data))
    for at in sorted(rng.sample(words, min(len(words), rng.choice((1, 1, 3)))), key=lambda m: -m.start()):
        data = data[: at.start()] + rng.choice(NUMBERS).encode() + data[at.end() :]
    return data


def _damage_model(data: bytes, rng: random.Random) -> bytes:
    if rng.random() < 0.1:
        return _damage_bytes(data, rng)
    try:
        return damage_tree(ET.fromstring(data), rng)
    except ET.ParseError:
        return _damage_bytes(data, rng)


def damaged(number: int) -> Damaged:
    """Damaged file number `number`: one of ten a mesh, three of twenty for MuJoCo's compiler."""
    rng = random.Random(number)
    kind = rng.random()
    if kind < 0.1:
        suffix, data = rng.choice(mesh_originals())
        if suffix == ".dae" and rng.random() < 0.7:
            return Damaged(_damage_model(data, rng), suffix)
        text = not data.startswith(b"\0") and rng.random() < 0.5
        return Damaged((_damage_words if text else _damage_bytes)(data, rng), suffix)
    reader: Reader = "mujoco" if kind < 0.25 else "engine"
    models = mjcf_originals() if kind < 0.25 else originals()
    return Damaged(_damage_model(rng.choice(models).read_bytes(), rng), reader=reader)


# Loading them


def _load(file: Damaged) -> pydart2.World:
    if not file.mesh:
        return pydart2.World(0.001, file.data, missing_meshes="warn", reader=file.reader)
    with tempfile.NamedTemporaryFile(suffix=file.mesh) as mesh:
        mesh.write(file.data)
        mesh.flush()
        world = pydart2.World(0.001)
        world.add_skeleton(AROUND_A_MESH.format(mesh.name).encode())
        return world


def _processor_seconds() -> float:
    """Of this process and of those that it had try a model: what else runs on the machine does not count."""
    return sum(os.times()[:4])


def load(file: Damaged) -> tuple[float, str]:
    """Load a model as a user would: processor seconds of the longest call, and what came of it.

    Any other exception than the documented ones goes on.
    """
    outcome, times = "loaded", [_processor_seconds()]
    try:
        world = _load(file)
        for _ in range(2):
            times.append(_processor_seconds())
            world.step()
    except pydart2.LoadError as error:
        outcome = "refused"
        if len(error.reason.split()) < 3:
            raise AssertionError(f"no sentence: {error}") from error
    except pydart2.SimulationError:
        outcome = "cannot be simulated"
    times.append(_processor_seconds())
    healthy = pydart2.World(0.001, "skel/cubes.skel")
    healthy.step(2)
    if not (healthy.x == healthy.x).all() or healthy.frame != 2:
        raise AssertionError("the next world does not step")
    return max(after - before for before, after in itertools.pairwise(times)), outcome


def work(first: int, count: int) -> None:
    """Load some, in this process; writes the number before each, and its longest call and outcome after."""
    logging.disable(logging.CRITICAL)
    for number in range(first, first + count):
        print(number, end=" ", flush=True)
        seconds, outcome = load(damaged(number))
        print(f"{seconds:.3f} {outcome}", flush=True)


def run(first: int, count: int) -> tuple[collections.Counter[str], list[str]]:
    """Outcomes and troubles of some files, loaded in other processes, each of which goes on after a LoadError."""
    outcomes: collections.Counter[str] = collections.Counter()
    troubles: list[str] = []
    number, end = first, first + count
    while number < end:
        command = [sys.executable, __file__, "--work", str(number), str(end - number)]
        done = subprocess.run(command, capture_output=True, text=True, errors="replace", env=ENVIRONMENT)
        for line in done.stdout.splitlines():
            number = int(line.split()[0]) + 1
            words = line.split(maxsplit=2)
            if len(words) == 3:
                outcomes[words[2]] += 1
                if float(words[1]) > MOST_SECONDS:
                    troubles.append(f"file {number - 1} took {words[1]} s")
        if done.returncode == 0:
            break
        troubles.append(f"file {number - 1} ended the process ({done.returncode}):\n{done.stderr[-1500:]}")
        SEEDS.mkdir(exist_ok=True)
        file = damaged(number - 1)
        (SEEDS / f"model-{number - 1}-{file.reader}{file.mesh or '.xml'}").write_bytes(file.data)
    return outcomes, troubles


def main() -> None:
    """Run as many as asked for; exit code 1 if there was trouble."""
    count, first = int(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 0
    outcomes, troubles = run(first, count)
    print(f"{sum(outcomes.values())} damaged models:", ", ".join(f"{n} {kind}" for kind, n in sorted(outcomes.items())))
    print(*troubles, sep="\n")
    sys.exit(bool(troubles))


if __name__ == "__main__":
    if sys.argv[1] == "--work":
        work(int(sys.argv[2]), int(sys.argv[3]))
    else:
        main()
