"""Names completed in IPython and notebooks, ``skel.body("l_<tab>``; registered when pydart2 is imported there."""

from __future__ import annotations

import ast
import re
import sys
from collections.abc import Mapping
from typing import Any

#: Method → the attribute that has what it finds by name.
_LISTS = {"body": "bodynodes", "bodynode": "bodynodes", "joint": "joints", "dof": "dofs", "marker": "markers",
          "skeleton": "skeletons"}  # fmt: skip
_CALL = re.compile(rf"""([A-Za-z_][\w.]*(?:\[[^\[\]]*\][\w.]*)*)\.({"|".join(_LISTS)})\(\s*["']([^"']*)$""")
_PLAIN = (ast.Expression, ast.Name, ast.Attribute, ast.Subscript, ast.Constant, ast.UnaryOp, ast.USub, ast.Load)


def names(line: str, namespace: Mapping[str, Any]) -> tuple[str, list[str]]:
    """What is typed of a name at the end of a line, and the names that begin so; none where no name is wanted."""
    match = _CALL.search(line)
    if match is None:
        return "", []
    expression, method, typed = match.groups()
    try:
        tree = ast.parse(expression, mode="eval")
        if not all(isinstance(node, _PLAIN) for node in ast.walk(tree)):
            return "", []
        things = getattr(
            eval(compile(tree, "<completion>", "eval"), {"__builtins__": {}}, dict(namespace)), _LISTS[method]
        )
        return typed, [thing.name for thing in things if thing.name.startswith(typed)]
    except Exception:  # nothing to be said of it while somebody types
        return "", []


def register() -> None:
    """Let the IPython that this runs in ask names()."""
    try:
        from IPython.core.completer import SimpleCompletion

        shell = sys.modules["IPython"].get_ipython()
        matchers = shell.Completer.custom_matchers
    except (ImportError, AttributeError):  # none runs, or one of long ago
        return

    def matcher(context: Any) -> dict[str, Any]:
        typed, found = names(context.text_until_cursor, shell.user_ns)
        return {"completions": [SimpleCompletion(text=name) for name in found], "matched_fragment": typed}

    matcher.matcher_api_version = 2  # type: ignore[attr-defined]
    matcher.matcher_identifier = "pydart2"  # type: ignore[attr-defined]
    matchers.append(matcher)
