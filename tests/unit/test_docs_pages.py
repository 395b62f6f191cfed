"""The pages of the documentation that are made from the package: the API reference, the gallery, the keys."""

from __future__ import annotations

import re
import runpy
import sys
from pathlib import Path
from types import ModuleType

import pytest

import pydart2

DOCS = Path(__file__).resolve().parents[2] / "docs"


@pytest.fixture(scope="module")
def api() -> ModuleType:
    sys.path.insert(0, str(DOCS))
    import api_pages  # type: ignore[import-not-found]

    sys.path.remove(str(DOCS))
    return api_pages


@pytest.fixture(scope="module")
def pages(api: ModuleType) -> dict[str, str]:
    return api.pages()


def test_ten_classes_lead_and_only_they_are_in_the_sidebar(pages: dict[str, str]) -> None:
    leading = re.findall(r"^   (\w+) <(pydart2\.\w+)>$", pages["index"], re.MULTILINE)
    assert [name for name, _ in leading][:4] == ["World", "Skeleton", "BodyNode", "Joint"]
    assert len(leading) == 10
    shown = {page for _, page in leading} | {"index", "modules"}
    assert {name for name, text in pages.items() if not text.startswith(":orphan:")} == shown


def test_methods_of_a_class_are_together(pages: dict[str, str]) -> None:
    """World.raycast() is written in another module."""
    assert ".. autoclass:: pydart2.world.World\n   :inherited-members: object" in pages["pydart2.world"]
    assert pydart2.World.raycast.__module__ != "pydart2.world"
    assert pages["pydart2.joint"].endswith(".. automodule:: pydart2.joint\n   :exclude-members: Joint\n")  # its kinds


def test_every_module_and_every_name_at_top_level_has_a_page(api: ModuleType, pages: dict[str, str]) -> None:
    assert set(api.public_modules()) | {"index", "modules"} == set(pages)
    for name in api.MODULES:
        assert f"pydart2.{name}" in pages
    listed = re.findall(r":doc:`(pydart2\S*) <", pages["modules"])
    assert sorted(listed) == sorted(set(pages) - {"index", "modules"})
    for name in pydart2.__all__:
        target = re.search(rf"`{name} <([\w.]+)>`", pages["index"])
        if target is not None:
            assert target[1] in pages or target[1].rpartition(".")[0] in pages, name
        else:
            assert name in ("papi", "pydart2_api")


def test_the_gallery_shows_each_clip(monkeypatch: pytest.MonkeyPatch, tmp_path: Path, api: ModuleType) -> None:
    monkeypatch.syspath_prepend(DOCS)
    import generated_pages as pages  # type: ignore[import-not-found]

    names = pages.example_names()
    clips = names[:15]
    for name in clips:
        (tmp_path / f"{name}.webp").touch()
    monkeypatch.setattr(pages, "PICTURES", tmp_path)
    text = pages.gallery(names)
    assert re.findall(r"^\[!\[.+\]\(pictures/(\w+)\.webp\)\]\((\w+)\.md\)$", text, re.MULTILINE) == [
        (name, name) for name in clips
    ]
    assert re.findall(r"^\| \[(\w+)\]\(", text, re.MULTILINE) == names[15:]
    from pydart2.gui.user_input import KEYS

    assert all(key.text in pages.keys_table() for key in KEYS)


def test_a_colon_makes_no_type_of_what_a_property_says(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(DOCS)
    import generated_pages as pages

    text = "The kept frames, oldest first: states and contacts."
    lines = [text]
    pages.note_docstring(None, "property", "pydart2.Recording.history", None, None, lines)
    lines[:] = ["states and contacts.", "", ":type: The kept frames, oldest first"]  # as Napoleon has it
    pages.restore_docstring(None, "property", "pydart2.Recording.history", None, None, lines)
    assert lines == [text]
    about = ["A world."]
    pages.note_docstring(None, "module", "pydart2.world", None, None, about)
    assert about == []


def test_array_like_stays_array_like() -> None:
    settings = runpy.run_path(str(DOCS / "conf.py"))
    assert settings["autodoc_type_aliases"] == {"ArrayLike": "ArrayLike"}
