"""The command line: ``pydart2 COMMAND`` or ``python -m pydart2 COMMAND``.

Each module beside this one has some commands: `add(commands)` says what they take, and what runs them.
"""

from __future__ import annotations

import argparse
import json
import logging
import os
import sys
from collections.abc import Sequence
from typing import Any

import pydart2
from pydart2.cli import bench, check, convert, examples, info, inspect, pictures
from pydart2.cli.models import path_of
from pydart2.errors import PydartError

_FIRST_LINES = """first lines to try:
  pydart2 view skel/fullbody1.skel
  pydart2 render urdf/PR2/pr2.urdf -o pr2.png
  pydart2 examples biped_stand

pydart2 COMMAND --help says more of each."""

_MODULES = (pictures, inspect, check, convert, bench, examples, info)


def main(arguments: Sequence[str] | None = None) -> None:
    """Do what the command line says.

    The process ends with status 1 and a sentence if that fails, and with status 2 if the line makes no sense.
    """
    commands = parser()
    args = commands.parse_args(arguments)
    if args.command is None:
        commands.print_help()
        return
    logging.basicConfig(format="%(levelname)s: %(message)s")
    try:
        if "file" in args:
            args.file = path_of(args.file)
        answer = args.run(args)
        if answer is not None:
            _print(answer, args)
    except BrokenPipeError:  # who reads what is printed has read enough, as head does
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        sys.exit(1)
    except (PydartError, OSError, ValueError, ImportError) as error:
        sys.exit(f"pydart2 {args.command}: {_sentence(error)}")
    except KeyboardInterrupt:
        sys.exit(130)


def parser() -> argparse.ArgumentParser:
    """Of all commands."""
    top = argparse.ArgumentParser(
        prog="pydart2",
        description="Robot physics for Python on the DART engine.",
        epilog=_FIRST_LINES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    top.add_argument("--version", action="version", version=f"pydart2 {pydart2.__version__}")
    commands = top.add_subparsers(dest="command", metavar="COMMAND", title="commands")
    for module in _MODULES:
        module.add(commands)
    return top


def _sentence(error: Exception) -> str:
    """Without the number that a system's errors begin with."""
    if isinstance(error, OSError) and error.strerror and error.filename is not None:
        return f"{error.strerror}: {error.filename!r}"
    return str(error)


def _print(answer: Any, args: argparse.Namespace) -> None:
    """A report as text, or with ``--json`` as JSON; status 1 if it says that something is wrong."""
    print(json.dumps(answer.data, indent=2) if args.json else answer.text, flush=True)
    if not answer.good:
        sys.exit(1)
