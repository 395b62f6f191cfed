"""Writes rows.json, the names that the package promises, from an inventory of the original's public API in Markdown.

    python3 tests/conformance/make_rows.py INVENTORY

A row is ``module.Class.member`` below ``pydart2``; ``member=`` is the setter of a property. Names are the inventory's
code spans: those of the first column of a table, and elsewhere those that have the form of a name.
"""

from __future__ import annotations

import json
import re
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

ROWS = Path(__file__).with_name("rows.json")

# Code spans that have the form of a name but are arguments, values, or names of something else.
NOT_NAMES = {
    1: "pydart2 None collision_filter verbose=True",
    2: """None TypeError realpath step skel_path reset render render_with_ri draw_with_ri num_frames set_frame status()
        name() on_close() on_mouse_release() on_step_event() render_with_ri(ri) draw_with_ri(ri) on_key_press(key)
        on_mouse_press(pos) on_mouse_move(p0,p1)""",
    3: "_filename realpath _id J J_rot_x,J_rot_y,J_rot_z,J_pos_x,J_pos_y,J_pos_z",
    5: "full=True full=False",
    7: "MIMIC=3",
    8: "world_position",
    10: "same",
    11: "_state size",
    12: "step()",
    16: "u",
    17: "builtins future",
}


CLASS = r"[A-Z][A-Za-z0-9]*[a-z][A-Za-z0-9]{2,}|Dof"


def spans(text: str) -> list[str]:
    return [re.sub(r"\s+", " ", span) for span in re.findall(r"`([^`]+)`", text)]


def cells(row: str) -> list[str]:
    return [cell.strip() for cell in re.split(r"(?<!\\)\|", row.strip().strip("|"))]


def blocks(body: str) -> Iterator[tuple[bool, str]]:
    """(whether it is a row of a table, text) of each row, list item and paragraph."""
    for paragraph in re.split(r"\n(?=\||\* )|\n\s*\n|(?<=\|)\n", body):
        yield paragraph.startswith("|"), paragraph


def names(span: str) -> list[str]:
    """The names in a code span: ``f(x)``, ``x``, ``x=``, ``A=0, B=1``, ``a, b``; none if it is something else."""
    if re.fullmatch(r"\w+ ?= ?[^()]+", span):
        return re.findall(r"(\w+) ?=", span)
    if re.fullmatch(r"\w+(, \w+)+(, …)?", span):
        return re.findall(r"\w+", span)
    found = re.fullmatch(r"([A-Za-z_]\w*)(\(.*\)|=)?", span)
    return [found[1] + "=" * (found[2] == "=")] if found else []


def top_level(number: int, body: str) -> Iterator[str]:
    ignored = NOT_NAMES[number].split()
    for is_row, text in blocks(body):
        for span in spans(cells(text)[0] if is_row else text):
            for name in names(span.removeprefix("pydart2.")):
                if span not in ignored and "muscle" not in span:
                    yield f"pydart2.{name}"


def module(number: int, body: str) -> Iterator[str]:
    """A module or package: a CamelCase span begins a class, the path that begins a list item a module or class."""
    top = re.match(r"`pydart2\.(\w+)`", body)[1]  # type: ignore[index]
    ignored = NOT_NAMES.get(number, "").split()
    owner, members_of_previous = [top], ""
    for is_row, text in blocks(body):
        if is_row:
            columns = cells(text)
            if columns[0].isdigit():  # a table of classes: number, class, members
                members_of_previous = members_of_previous if columns[2].startswith("same") else columns[2]
                text = columns[1] + members_of_previous
            else:
                text = columns[0]
        for i, span in enumerate(spans(text)):
            path = re.match(r"[\w.]+", span)
            if top in ("utils", "muscle") and text.startswith("* ") and i == 0 and path is not None:
                owner = [top, *[part for part in path[0].split(".") if part != top]]
                yield ".".join(owner)
                owner = owner if owner[-1][0].isupper() or "(" not in span else owner[:-1]
                continue
            span = span.removeprefix("class ").removeprefix(f"pydart2.{top}.")
            for name in names(span):
                if span.replace(" ", "") in ignored:
                    continue
                if re.fullmatch(CLASS, name) or name.startswith(("create_", "arcball_")):
                    owner = owner[: 1 + (top == "utils")]
                yield ".".join([*owner, name])
                if re.fullmatch(CLASS, name):
                    owner = [*owner, name]


def vector(number: int, body: str) -> Iterator[str]:
    """The operations on a vector: each is a row."""
    for is_row, text in blocks(body):
        for span in spans(cells(text)[0] if is_row else text):
            if (is_row and span != "__getslice__") or span.startswith(("v", "str(", "repr(")):
                yield f"skel_vector.SkelVector: {span}"
    yield from (f"skel_vector.SkelVector{member}" for member in ("", ".skel", ".keys"))


MODULES = {
    "World": "world.",
    "CollisionFilter": "collision_filter.",
    **dict.fromkeys(("Joint", "BallJoint", "FreeJoint"), "joint."),
    **{name: f"{name.lower()}." for name in ("Skeleton", "BodyNode", "ShapeNode", "Contact")},
    "CollisionResult": "collision_result.",
    "SkeletonBuilder": "skeleton_builder.",
    "Renderer": "gui.opengl.renderer.",
    "OpenGLScene": "gui.opengl.scene.",
}


def extensions(number: int, body: str) -> Iterator[str]:
    """Names of forks, each with its class before it or named in a span before it: ``Class.{a,b}``, ``c/d``."""
    for is_row, text in blocks(body):
        owner = ""
        for span in spans(cells(text)[1]) if is_row else []:
            for part in re.split(r", ?(?![^{(\[]*[})\]])", span):
                for name in alternatives(re.sub(r"(?<=.)\(.*\)", "", part)):
                    head, _, last = name.rpartition(".")
                    if re.fullmatch(CLASS, last) and not head:  # a class, or a signature of one
                        yield MODULES.get(last, owner and owner + ".") + part
                        owner = last if last in MODULES else owner
                        continue
                    owner = head or owner
                    for one in owner.split("/"):
                        yield MODULES.get(one, "") + (f"{one}.{last}" if one else last)


def alternatives(text: str) -> list[str]:
    """``a_{b,c}`` is a_b, a_c; ``a/b`` is a, b; ``id1/2`` is id1, id2; ``X[V2]`` is X, XV2."""
    braces = re.search(r"\{([^}]*)\}", text)
    if braces:
        plain = [option for option in braces[1].split(",") if "*" not in option]
        options = plain + [f"set_{option}" for option in plain if "set_*" in braces[1]]
        return [name for option in options for name in alternatives(text.replace(braces[0], option))]
    if "[V2]" in text:
        return [text.replace("[V2]", ""), text.replace("[V2]", "V2")]
    head, dot, tail = text.rpartition(".")
    numbered = re.fullmatch(r"(\w+)(\d)/(\d)", tail)
    return [
        head + dot + name
        for name in ([numbered[1] + n for n in numbered.groups()[1:]] if numbered else tail.split("/"))
    ]


def flat(number: int, body: str) -> Iterator[str]:
    yield "pydart2_api.IntVector"
    yield from (f"pydart2_api.{name}" for name in re.findall(r"^\| `(\w+)\(", body, re.MULTILINE))


READERS: dict[int, Callable[[int, str], Iterator[str]]] = {
    **dict.fromkeys((*range(2, 15), 16, 17), module),
    1: top_level,
    4: vector,
    18: extensions,
    20: flat,
}


def main(inventory: str) -> None:
    parts = re.split(r"^## (\d+)\. ", Path(inventory).read_text(encoding="utf-8"), flags=re.MULTILINE)
    seen: set[str] = set()
    rows: dict[str, list[str]] = {}
    for number, body in zip(map(int, parts[1::2]), parts[2::2]):
        if number in READERS:
            found = [row for row in dict.fromkeys(READERS[number](number, body)) if row not in seen]
            seen.update(found)
            rows[str(number)] = found
    ROWS.write_text(json.dumps(rows, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
    print(f"{sum(map(len, rows.values()))} rows in {ROWS}")


if __name__ == "__main__":
    main(*sys.argv[1:])
