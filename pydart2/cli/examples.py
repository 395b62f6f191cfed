"""``pydart2 examples``: list, run or copy the examples that come with the package."""

from __future__ import annotations

import argparse
import ast
import runpy
import shutil
import sys
from pathlib import Path
from typing import Any

from pydart2.errors import NameNotFound
from pydart2.resources import examples_folder


def add(commands: Any) -> None:
    """Add the command."""
    parser = commands.add_parser(
        "examples", help="list, run or copy the examples", description="Without a name it lists the examples."
    )
    parser.add_argument("name", nargs="?", metavar="NAME", help="the example to run, as biped_stand")
    parser.add_argument("options", nargs=argparse.REMAINDER, help="passed on to it, as --headless")
    parser.add_argument("--copy", type=Path, metavar="DIR", help="copy all of them to a folder to change them")
    parser.set_defaults(run=run)


def run(args: argparse.Namespace) -> None:
    """List, run or copy."""
    if args.copy is not None:
        copy_examples(args.copy)
    elif args.name is None:
        list_examples()
    else:
        run_example(args.name, args.options)


def example_names() -> list[str]:
    """The names of the examples, sorted."""
    return sorted(path.stem for path in examples_folder().glob("[!_]*.py"))


def list_examples() -> None:
    """Print each example's name and first line."""
    width = max(map(len, example_names()))
    for name in example_names():
        text = ast.get_docstring(ast.parse((examples_folder() / f"{name}.py").read_text())) or ""
        print(f"{name:<{width}}  {text.splitlines()[0]}")


def run_example(name: str, options: list[str]) -> None:
    """Run one as a script."""
    name = name.removesuffix(".py")
    if name not in example_names():
        sys.exit(str(NameNotFound("example", name, "pydart2", example_names())))
    path = examples_folder() / f"{name}.py"
    sys.argv = [str(path), *options]
    sys.path.insert(0, str(path.parent))
    runpy.run_path(str(path), run_name="__main__")


def copy_examples(folder: Path) -> None:
    """Copy all to a folder; never over a file that is there."""
    paths = sorted(examples_folder().glob("*.py"))
    existing = [path.name for path in paths if (folder / path.name).exists()]
    if existing:
        sys.exit(f"{folder} already has {', '.join(existing)}; choose another folder")
    folder.mkdir(parents=True, exist_ok=True)
    for path in paths:
        shutil.copy(path, folder)
    print(f"copied {len(paths)} files to {folder}; try: python {folder / 'biped_stand.py'}")
