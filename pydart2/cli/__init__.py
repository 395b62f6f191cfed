"""The command line: ``pydart2 COMMAND`` or ``python -m pydart2 COMMAND``.

Each module beside this one has some commands: `add(commands)` says what they take, and what runs them.
"""

from __future__ import annotations

import argparse
import json
import logging
import sys
from collections.abc import Sequence
from typing import Any

from pydart2.cli import bench, check, convert, examples, info, inspect, pictures
from pydart2.errors import PydartError

_MODULES = (pictures, inspect, check, convert, bench, examples, info)


def main(arguments: Sequence[str] | None = None) -> None:
    """Do what the command line says.

    The process ends with status 1 and a sentence if that fails, and with status 2 if the line makes no sense.
    """
    args = parser().parse_args(arguments)
    logging.basicConfig(format="%(levelname)s: %(message)s")
    try:
        answer = args.run(args)
    except (PydartError, OSError, ValueError, ImportError) as error:
        sys.exit(f"pydart2 {args.command}: {error}")
    except KeyboardInterrupt:
        sys.exit(130)
    if answer is not None:
        _print(answer, args)


def parser() -> argparse.ArgumentParser:
    """Of all commands."""
    top = argparse.ArgumentParser(prog="pydart2", description="Robot physics for Python on the DART engine.")
    commands = top.add_subparsers(dest="command", required=True, metavar="COMMAND")
    for module in _MODULES:
        module.add(commands)
    return top


def _print(answer: Any, args: argparse.Namespace) -> None:
    """A report as text, or with ``--json`` as JSON; status 1 if it says that something is wrong."""
    print(json.dumps(answer.data, indent=2) if args.json else answer.text)
    if not answer.good:
        sys.exit(1)
