"""Sphinx extension: the pages that are made from the product itself.

A page per example with the clip that the example makes, a page per module for the API reference, and the keys of the
window. All go to docs/examples, docs/api and docs/generated, which are not in the repository.
"""

from __future__ import annotations

import ast
import subprocess
import sys
from pathlib import Path
from typing import Any

import api_pages

import pydart2
from pydart2.cli.examples import example_names
from pydart2.resources import examples_folder
from pydart2.utils.progress import progress

DOCS = Path(__file__).parent
PICTURES = DOCS / "examples" / "pictures"
MODEL = {name: ["./data/sdf/atlas/atlas_v3_no_head.sdf"] for name in ("view_skeleton", "inspect_skeleton")}


def setup(app: Any) -> dict[str, bool]:
    """Make the pages before Sphinx looks for them, and look after docstrings before and after Napoleon does, at 500."""
    app.connect("builder-inited", lambda _app: make_pages())
    app.connect("autodoc-process-docstring", note_docstring, priority=400)
    app.connect("autodoc-process-docstring", restore_docstring, priority=600)
    return {"parallel_read_safe": True}


def make_pages() -> None:
    """All of them."""
    names = example_names()
    outputs = {name: run_example(name) for name in progress(names, "examples", unit="example", total=len(names))}
    for name, output in outputs.items():
        write(DOCS / "examples" / f"{name}.md", example_page(name, output))
    write(DOCS / "examples" / "gallery.md", gallery(names))
    pages = api_pages.pages()
    for name, text in pages.items():
        write(DOCS / "api" / f"{name}.rst", text)
    for path in (DOCS / "api").iterdir():
        if path.name.removesuffix(".rst") not in pages:  # of a module that is no more
            path.unlink()
    write(DOCS / "generated" / "keys.md", keys_table())


def write(path: Path, text: str) -> None:
    """Write a page if it has changed, so that Sphinx does not read it again for nothing."""
    path.parent.mkdir(parents=True, exist_ok=True)
    if not path.is_file() or path.read_text(encoding="utf-8") != text:
        path.write_text(text, encoding="utf-8")


# Docstrings

_noted: dict[str, list[str]] = {}


def note_docstring(_app: Any, what: str, name: str, _object: Any, _options: Any, lines: list[str]) -> None:
    """Keep what is written of a property; what is written of a class's module is no more than of the class."""
    if what == "property":
        _noted[name] = list(lines)
    elif what == "module" and name in {cls.__module__ for cls in api_pages.CLASSES}:
        lines.clear()


def restore_docstring(_app: Any, what: str, name: str, _object: Any, _options: Any, lines: list[str]) -> None:
    """Napoleon takes what is before a colon in a property's first line for its type."""
    if what == "property":
        lines[:] = _noted.pop(name)


# Examples


def run_example(name: str) -> str:
    """What an example prints headless; its picture and clip go to PICTURES. Not again while nothing has changed."""
    script, log = examples_folder() / f"{name}.py", PICTURES / f"{name}.txt"
    package = max(path.stat().st_mtime for path in Path(pydart2.__file__).parent.rglob("*.py"))
    if log.is_file() and log.stat().st_mtime > max(script.stat().st_mtime, package):
        return log.read_text(encoding="utf-8")
    PICTURES.mkdir(parents=True, exist_ok=True)
    command = [sys.executable, str(script), *MODEL.get(name, []), "--headless", "--output", str(PICTURES)]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode:
        raise RuntimeError(f"example {name} fails:\n{done.stdout}{done.stderr}")
    log.write_text(done.stdout, encoding="utf-8")
    return done.stdout


def docstring(name: str) -> tuple[str, str]:
    """The title of an example and the rest of its docstring."""
    text = ast.get_docstring(ast.parse((examples_folder() / f"{name}.py").read_text(encoding="utf-8"))) or name
    title, _, rest = text.partition("\n")
    return title.rstrip("."), rest.strip()


def picture(name: str) -> str:
    """The file name of the clip, else of the picture; empty for an example that shows numbers."""
    made = [path.name for ending in ("webp", "png") if (path := PICTURES / f"{name}.{ending}").is_file()]
    return made[0] if made else ""


def example_page(name: str, output: str) -> str:
    """Text, clip, what it says of itself, and the script."""
    title, text = docstring(name)
    heading, _, what = title.partition(": ")
    text = f"{what[:1].upper()}{what[1:]}.\n\n{text}" if what else text
    text = "\n".join(line for line in text.splitlines() if not line.startswith("    "))
    checks = [line.removeprefix("ok: ") for line in output.splitlines() if line.startswith("ok: ")]
    claims = "In the run that made this page:\n\n" + "\n".join(f"- {line}" for line in checks) if checks else ""
    options = " ".join(["", *MODEL.get(name, [])])
    image = f"```{{image}} pictures/{picture(name)}\n:class: clip\n:alt: {title}\n```" if picture(name) else ""
    return f"""# {heading}

{text.strip()}

{image}

{claims}

```sh
python examples/{name}.py{options}                             # in a window
python examples/{name}.py{options} --headless --output {name}  # without one
```

```{{literalinclude}} {script_path(name)}
:language: python
```
"""


def script_path(name: str) -> str:
    """From the page to the script."""
    return "/" + str(Path("..") / "examples" / f"{name}.py")


def gallery(names: list[str]) -> str:
    """The clips of all examples as thumbnails, then those that show numbers."""
    cards = "\n".join(card(name) for name in names if picture(name))
    rows = "\n".join(f"| [{name}]({name}.md) | {docstring(name)[0]} |" for name in names if not picture(name))
    return f"""# Examples

Each runs as `pydart2 examples NAME`, with a window or with `--headless`; then it checks what it claims, and
`--output DIR` saves a picture and a clip. `pydart2 examples --copy DIR` copies all of them to be changed.

:::::{{container}} gallery
{cards}
:::::

These print numbers:

| example | what it shows |
|---|---|
{rows}

```{{toctree}}
:hidden:

{chr(10).join(names)}
```
"""


def card(name: str) -> str:
    """A thumbnail with its title, both linked to the example's page."""
    title = docstring(name)[0]
    return f"""::::{{container}} card
[![{title}](pictures/{picture(name)})]({name}.md)

[{title}]({name}.md)
::::"""


# The window


def keys_table() -> str:
    """The keys and drags that the window obeys, from the table that it obeys."""
    from pydart2.gui.user_input import help_rows

    rows = "\n".join(f"| {keys} | {text} |" for keys, text in help_rows())
    return f"# Keys of the window\n\n| key or drag | what it does |\n|---|---|\n{rows}\n"
