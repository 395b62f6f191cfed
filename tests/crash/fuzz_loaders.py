"""The loaders under libFuzzer: models that reach new branches of them are kept, and damaged further.

    python tests/crash/fuzz_loaders.py 20000 [FOLDER]    twenty thousand models; FOLDER keeps those that reached some

Atheris drives libFuzzer from Python and counts the branches of pydart2. Each model goes a user's way: checked, tried in
the helper, read by the engine, simulated; as a world, and as a skeleton added to one. A crash, ten seconds without an
end or an undocumented exception stops the run, and the model is put into ``tests/crash/seeds``.
"""

from __future__ import annotations

import contextlib
import logging
import random
import sys
import xml.etree.ElementTree as ET
from pathlib import Path

import atheris

sys.path.insert(0, str(Path(__file__).parents[1]))
with atheris.instrument_imports(include=["pydart2"]):
    import pydart2.loading

from crash import fuzz_models

FOUND = Path(__file__).parents[2] / "build" / "fuzz"
MAX_BYTES = 4 * fuzz_models.LARGEST


def damage(data: bytes, most: int, seed: int) -> bytes:
    """Mostly the tree of elements; a quarter of the time, and where there is none, libFuzzer damages bytes."""
    rng = random.Random(seed)
    if rng.random() < 0.75:
        with contextlib.suppress(ET.ParseError):
            damaged = fuzz_models.damage_tree(ET.fromstring(data), rng)
            if len(damaged) <= most:
                return damaged
    return bytes(atheris.Mutate(data, most))


def cross(first: bytes, second: bytes, most: int, seed: int) -> bytes:
    """The first model with an element of the second in it."""
    rng = random.Random(seed)
    with contextlib.suppress(ET.ParseError):
        root, other = ET.fromstring(first), ET.fromstring(second)
        rng.choice(list(root.iter())).append(rng.choice(list(other.iter())))
        crossed = ET.tostring(root)
        if len(crossed) <= most:
            return crossed
    return first


def load(data: bytes) -> None:
    """Load a model as a world and as a skeleton; raises what is no documented exception."""
    fuzz_models.load(fuzz_models.Damaged(data))
    world = pydart2.World(0.001)
    with contextlib.suppress(pydart2.LoadError, pydart2.SimulationError):
        world.add_skeleton(data, reader="engine")
        world.step()


def main() -> None:
    """Exit code 0 if there was no trouble; libFuzzer says on standard error what it does."""
    count, found = sys.argv[1], Path(sys.argv[2]) if len(sys.argv) > 2 else FOUND
    found.mkdir(parents=True, exist_ok=True)
    models = (
        *fuzz_models.originals(),
        *(path for path in fuzz_models.SEEDS.iterdir() if path.suffix not in fuzz_models.MESHES),
    )
    flags = {
        "runs": count,
        "seed_inputs": ",".join(map(str, models)),
        "max_len": MAX_BYTES,
        "timeout": round(fuzz_models.MOST_SECONDS),
        "artifact_prefix": f"{fuzz_models.SEEDS}/",
        "print_final_stats": 1,
    }
    logging.disable(logging.CRITICAL)
    arguments = [sys.argv[0], *(f"-{name}={value}" for name, value in flags.items()), str(found)]
    atheris.Setup(arguments, load, custom_mutator=damage, custom_crossover=cross)
    atheris.Fuzz()


if __name__ == "__main__":
    main()
