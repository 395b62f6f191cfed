"""Loading: where models are found, how formats are known, what is refused and how that is said."""

from __future__ import annotations

import logging
import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import pydart2
from oracle.models import dart_model
from pydart2 import LoadError, Skeleton, World
from pydart2.loading import trial
from pydart2.loading.xml import parse

LINK = (
    "<link name='arm'><inertial><mass value='2'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial>"
)
URDF = f"<robot name='crane'>{LINK}</link></robot>"
SDF = "<sdf version='1.5'><model name='box'><link name='l'><inertial><mass>3</mass></inertial></link></model></sdf>"
BODY = "<body name='b'><inertia><mass>{mass}</mass></inertia></body>"
JOINT = "<joint name='j' type='free'><parent>world</parent><child>b</child></joint>"
SKELETON = f"<skeleton name='s'>{BODY.format(mass=4)}{JOINT}</skeleton>"
SKEL_WORLD = (
    f"<skel version='1.0'><world name='w'><physics><gravity>0 0 -1</gravity></physics>{SKELETON}</world></skel>"
)
MJCF = (
    "<mujoco><worldbody><body name='m'><freejoint/><geom type='sphere' size='.1' mass='5'/></body></worldbody></mujoco>"
)
TIP = "<Segment NAME='tip' POSITION='0 0 500'><JointHinge AXIS='1 0 0'/></Segment>"  # the engine gives it 1 kg
ROOT = f"<Segment NAME='v' MASS='5'><JointFree/>{TIP}</Segment>"
VSK = f"<KinematicModel><Skeleton>{ROOT}</Skeleton></KinematicModel>"
MASSES = {"urdf": 2, "sdf": 3, "skel": 4, "mjcf": 5, "vsk": 6}
TEXTS = {"urdf": URDF, "sdf": SDF, "skel": f"<skel version='1.0'>{SKELETON}</skel>", "mjcf": MJCF, "vsk": VSK}


@pytest.fixture
def world() -> World:
    return World(0.001)


def write(path: Path, text: str | bytes) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(text.encode() if isinstance(text, str) else text)
    return path


def triangle(path: Path) -> Path:
    """A mesh file with one triangle."""
    if path.suffix == ".obj":
        return write(path, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    corners = "".join(f"vertex {corner}\n" for corner in ("0 0 0", "1 0 0", "0 1 0"))
    return write(path, f"solid s\nfacet normal 0 0 1\nouter loop\n{corners}endloop\nendfacet\nendsolid s\n")


def refusal(what: Any, **options: Any) -> LoadError:
    """The error of loading a skeleton."""
    with pytest.raises(LoadError) as info:
        World(0.001).add_skeleton(what, reader="engine", **options)
    return info.value


# Formats and sources


@pytest.mark.parametrize("name", ["model", "model.txt", "model.skel", "model.urdf"])
@pytest.mark.parametrize("kind", TEXTS)
def test_the_root_element_says_the_format(world: World, tmp_path: Path, kind: str, name: str) -> None:
    assert world.add_skeleton(write(tmp_path / name, TEXTS[kind]), reader="engine").m == pytest.approx(MASSES[kind])


@pytest.mark.parametrize("kind", TEXTS)
def test_texts_and_bytes(world: World, kind: str) -> None:
    for text in (TEXTS[kind], "\n  " + TEXTS[kind], TEXTS[kind].encode(), TEXTS[kind].encode("utf-8-sig")):
        skel = world.add_skeleton(text, reader="engine")
        assert skel.m == pytest.approx(MASSES[kind]) and skel.filename is None


@pytest.mark.parametrize("kind", TEXTS)
def test_a_world_of_any_format(kind: str) -> None:
    assert sum(skel.m for skel in World(0.002, TEXTS[kind], reader="engine").skeletons) == pytest.approx(MASSES[kind])


def test_a_text_as_the_original_takes_it() -> None:
    for world in (World(0.002, SKEL_WORLD, True), World(0.002, SKEL_WORLD, xmlstr=True), World(0.002, SKEL_WORLD)):
        assert world.dt == 0.002 and world.skeletons[0].name == "s"
        np.testing.assert_array_equal(world.g, [0, 0, -1])


def test_gravity_without_a_world_in_the_file() -> None:
    np.testing.assert_array_equal(World(0.001, URDF).g, [0, -9.81, 0])


def test_a_world_is_no_skeleton() -> None:
    assert "is a world; load it with World(step, file)" in str(refusal(SKEL_WORLD))
    two = MJCF.replace("</worldbody>", "<body name='n'><geom type='sphere' size='1'/></body></worldbody>")
    assert "a world of several skeletons" in str(refusal(two))
    assert len(World(0.001, two, reader="engine").skeletons) == 2


def test_uris(world: World, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = write(tmp_path / "cranes" / "urdf" / "crane.urdf", URDF)
    assert world.add_skeleton(f"file://{path}").filename == str(path)
    assert world.add_skeleton("package://cranes/urdf/crane.urdf", packages={"cranes": tmp_path / "cranes"}).m == 2
    monkeypatch.setenv("ROS_PACKAGE_PATH", f"/nowhere:{tmp_path}")
    assert world.add_skeleton("package://cranes/urdf/crane.urdf").m == 2
    monkeypatch.setenv("DART_DATA_PATH", str(tmp_path))
    assert world.add_skeleton("dart://sample/cranes/urdf/crane.urdf").m == 2
    for uri in ("file:///nowhere/x", "package://none/x", "dart://sample/x", "dart://y", "http://localhost/x"):
        with pytest.raises(LoadError, match=f"no file '{uri}': "):
            world.add_skeleton(uri)


def test_debian_packs_the_samples(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("DART_DATA_PATH", raising=False)
    dart_model("skel/fullbody1.skel")  # fails and says so where dart-doc is not installed
    assert [s.ndofs for s in World(0.001, "dart://sample/skel/fullbody1.skel").skeletons] == [6, 37]


@pytest.mark.parametrize("folder", ["plain", "a space", "ünïcode", "a#b", "a?b", "a%20b"])
def test_any_folder(world: World, tmp_path: Path, folder: str) -> None:
    mesh = triangle(tmp_path / folder / "meshes" / "tri.obj")
    text = (
        f"<robot name='r'>{LINK}<visual><geometry><mesh filename='meshes/tri.obj'/></geometry></visual></link></robot>"
    )
    skel = world.add_skeleton(write(tmp_path / folder / "r.urdf", text))
    (node,) = skel.bodynodes[0].shapenodes
    assert Path(node.shape.path().removeprefix("file://")) == mesh


def test_the_fallback_is_logged(world: World, tmp_path: Path, caplog: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    with caplog.at_level(logging.INFO, "pydart2"):
        World(0.001, "./data/skel/cubes.skel")
    assert f"using {pydart2.data_path('skel/cubes.skel')}" in caplog.text


def test_subclasses_get_the_path(tmp_path: Path) -> None:
    """A class of the user's may look at the file name that it is given."""

    class Mine(Skeleton):
        def __init__(self, _world: World, _filename: Any = None) -> None:
            self.seen = os.fspath(_filename)
            super().__init__(_world, _filename=_filename)

    path = write(tmp_path / "r.urdf", URDF)
    skel = World(0.001).add_skeleton(path, Mine)
    assert isinstance(skel, Mine) and skel.seen == skel.filename == str(path)


# Refusals: file, line, reason


def test_the_error_has_its_parts(tmp_path: Path) -> None:
    path = write(tmp_path / "r.urdf", "<robot name='r'>\n\n<link/></robot>")
    error = refusal(path)
    assert (error.path, error.line, error.reason) == (str(path), 3, "<link> needs the attribute 'name'")
    assert str(error) == f"cannot load '{path}', line 3: <link> needs the attribute 'name'"
    assert (refusal("<robot>").path, refusal("<robot>").line) == (None, 1)


REFUSED = [
    ("", None, "empty"),
    ("<robot>\n<a>\n</b></robot>", 3, "not well-formed: mismatched tag"),
    ("<!DOCTYPE r [\n<!ENTITY a 'b'>]><robot/>", 2, "declares the entity 'a'"),
    ("<robot>\n\0</robot>", 2, "zero byte"),
    ("\n<house/>", 2, "its root element is <house>; known are <skel>, <sdf>, <robot>"),
    ("<a>" * 300 + "</a>" * 300, 1, "nested more than 200 deep"),
    ("<robot name='r'/>", 1, "needs <link>"),
    (URDF.replace("'2'", "'two'"), 1, "the attribute 'value' of <mass>: 'two' is not a number"),
    (URDF.replace("'2'", "'nan'"), 1, "must be finite, got 'nan'"),
    (URDF.replace("'2'", "'-2'"), 1, "body 'arm': its mass must be zero or positive"),
    (URDF.replace("'2'", "''"), 1, "must be a number, got ''"),
    (
        URDF.replace("</link>", "<visual><geometry><box size='1 2'/></geometry></visual></link>"),
        1,
        "3 numbers, got '1 2'",
    ),
    ("<sdf version='1.9'>\n<model/></sdf>", 1, "its SDF version is 1.9; the engine reads 1.4, 1.5, 1.6"),
    ("<sdf version='1.5'><world name='w'/></sdf>", 1, "is a world"),
    ("<skel>\n<skeleton name='s'/></skel>", 2, "<skeleton> 's' needs <joint>"),
    (f"<skel>\n{SKELETON.replace('free', 'magic')}</skel>", 2, "of type 'magic'; known are weld, ball"),
    (f"<skel>\n{SKELETON.replace('free', 'revolute')}</skel>", 2, "of type 'revolute' and needs <axis><xyz>"),
    (
        f"<skel>\n{SKELETON.replace('<child>b', '<child>c')}</skel>",
        2,
        "its child 'c' is not a <body> of <skeleton> 's'",
    ),
    (f"<skel>\n{SKELETON.replace('<parent>world', '<parent>b')}</skel>", 2, "<body> 'b' is among its own ancestors"),
    (
        f"<skel>\n{SKELETON.replace('<joint', BODY.replace(chr(39) + 'b', chr(39) + 'lost') + '<joint')}</skel>",
        2,
        "in no joint",
    ),
    (f"<skel>{SKELETON.replace('4', 'inf')}</skel>", 1, "<mass> of <inertia> must be finite, got 'inf'"),
    ("<mujoco/>", 1, "<mujoco> needs <worldbody>"),
    ("<mujoco>\n<include/><worldbody/></mujoco>", 2, "<include> needs the attribute 'file'"),
    ("<KinematicModel>\n<Skeleton/></KinematicModel>", 2, "<Skeleton> needs <Segment>"),
]


@pytest.mark.parametrize("text, line, reason", REFUSED, ids=[reason for _, _, reason in REFUSED])
def test_refused(tmp_path: Path, text: str, line: int | None, reason: str) -> None:
    error = refusal(write(tmp_path / "model", text.replace("{mass}", "1")))
    assert reason in error.reason and error.line == line and repr(str(tmp_path / "model")) in str(error)


def test_what_the_checks_miss_is_tried_by_the_helper(world: World) -> None:
    """No check knows of a mesh made flat: the engine would abort."""
    mesh = pydart2.data_path("obj/atlas/l_foot.obj")
    text = URDF.replace(
        "</link>", f"<visual><geometry><mesh filename='{mesh}' scale='0 1 1'/></geometry></visual></link>"
    )
    assert "the engine would abort: it needs (scale.array() > 0.0).all()" in str(refusal(text))
    world.add_skeleton(URDF)
    world.step()


def test_the_engine_says_why() -> None:
    """Two roots: the reason is the URDF parser's."""
    text = URDF.replace("</robot>", "<link name='other'/></robot>")
    assert "the engine says: " in str(refusal(text)) and "root link" in str(refusal(text, safe=False))


def test_limits_may_be_infinite(world: World) -> None:
    text = f"<skel>{SKELETON}</skel>".replace("free", "revolute").replace(
        "</joint>", "<axis><xyz>0 0 1</xyz><limit><lower>-inf</lower><upper>inf</upper></limit></axis></joint>"
    )
    assert world.add_skeleton(text).q_lower == [-np.inf]


def test_line_ends_and_tabs_between_numbers(world: World) -> None:
    """The engine's SKEL parser aborts on them."""
    body = (
        "<body name='b'><transformation>1 2\n3\t0 0\r\n0\n</transformation><inertia><mass> 4 </mass></inertia></body>"
    )
    skel = world.add_skeleton(f"<skel><skeleton name='s'>{body}{JOINT}</skeleton></skel>")
    np.testing.assert_array_equal(skel.bodynodes[0].T[:3, 3], [1, 2, 3])


@pytest.mark.parametrize("encoding", ["latin-1", "utf-8", "utf-16"])
def test_encodings(world: World, encoding: str) -> None:
    text = f"<?xml version='1.0' encoding='{encoding}'?>" + URDF.replace("arm", "bras levé")
    assert world.add_skeleton(text.encode(encoding)).bodynodes[0].name == "bras levé"


def test_an_encoding_that_is_not_so(world: World, caplog: Any) -> None:
    assert world.add_skeleton(URDF.replace("arm", "levé").encode("latin-1")).bodynodes[0].name == "levé"
    assert "reading it as Latin-1" in caplog.text


def test_removed_elements_leave_the_lines() -> None:
    document = parse(b"<a>\n<b c='>'>x\n</b>\n<d/></a>", None)
    document.remove([document.root.children[0]])
    assert document.data == b"<a>\n          \n    \n<d/></a>"


def test_bad_options(world: World) -> None:
    with pytest.raises(ValueError, match="missing_meshes must be 'error' or 'warn', got 'no'"):
        world.add_skeleton(URDF, missing_meshes="no")  # type: ignore[arg-type]
    with pytest.raises(LoadError, match="no folder '/nowhere', which packages= gives for 'x'"):
        world.add_skeleton(URDF, packages={"x": "/nowhere"})


# Meshes and packages

WITH_MESH = {
    "urdf": "<robot name='r'>\n" + LINK + "<{tag}><geometry><mesh filename='{uri}'/></geometry></{tag}></link></robot>",
    "sdf": SDF.replace(
        "</link>", "\n<{tag} name='s'><geometry><mesh><uri>{uri}</uri></mesh></geometry></{tag}></link>"
    ),
    "skel": f"<skel>{SKELETON}</skel>".replace(
        "</body>",
        "\n<{tag}_shape><geometry><mesh><file_name>{uri}</file_name><scale>1 1 1</scale></mesh></geometry>"
        "</{tag}_shape></body>",
    ),
}


def with_mesh(kind: str, uri: str, tag: str) -> str:
    if kind == "skel":
        tag = {"visual": "visualization"}.get(tag, tag)
    return WITH_MESH[kind].format(uri=uri, tag=tag)


@pytest.mark.parametrize("tag", ["visual", "collision"])
@pytest.mark.parametrize("kind", WITH_MESH)
def test_missing_meshes(world: World, tmp_path: Path, caplog: Any, kind: str, tag: str) -> None:
    path = write(tmp_path / "model", with_mesh(kind, "gone.obj", tag))
    if tag == "collision":
        error = refusal(path)
        assert error.line == 2 and f"the collision mesh 'gone.obj' of <{'body' if kind == 'skel' else 'link'}>" in str(
            error
        )
        assert f"there is no file {tmp_path / 'gone.obj'}" in str(error) and "missing_meshes='warn'" in str(error)
    skel = world.add_skeleton(path, missing_meshes="error" if tag == "visual" else "warn")
    assert skel.m == MASSES[kind] and skel.bodynodes[0].shapenodes == []
    assert f"{path}, line 2: the {tag} mesh 'gone.obj'" in caplog.text and "left out" in caplog.text


@pytest.mark.parametrize("kind", WITH_MESH)
def test_packages(world: World, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, kind: str) -> None:
    """The caller's, then ROS_PACKAGE_PATH, then the folders above the file."""
    path = write(
        tmp_path / "above" / "cranes" / "models" / "deep" / "model",
        with_mesh(kind, "package://cranes/m/a.obj", "visual"),
    )

    def size(**options: Any) -> int:
        """How many shapes there are, and where their mesh is."""
        return len(world.add_skeleton(path, **options).bodynodes[0].shapenodes)

    assert size() == 0
    triangle(tmp_path / "above" / "cranes" / "m" / "a.obj")
    assert size() == 1
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path / "ros"))
    triangle(tmp_path / "ros" / "group" / "cranes" / "m" / "a.obj")
    node = world.add_skeleton(path).bodynodes[0].shapenodes[0]
    assert node.shape.path() == str(tmp_path / "ros" / "group" / "cranes" / "m" / "a.obj")
    triangle(tmp_path / "mine" / "m" / "a.obj")
    node = world.add_skeleton(path, packages={"cranes": tmp_path / "mine"}).bodynodes[0].shapenodes[0]
    assert node.shape.path() == str(tmp_path / "mine" / "m" / "a.obj")


def test_an_unknown_package_says_what_to_do(tmp_path: Path) -> None:
    error = refusal(write(tmp_path / "model", with_mesh("urdf", "package://none/a.obj", "collision")))
    assert "name its folder with packages={'none': folder}, or put it into ROS_PACKAGE_PATH" in str(error)


def test_a_mesh_that_is_none(tmp_path: Path) -> None:
    write(tmp_path / "bad.stl", "this is no mesh")
    error = refusal(write(tmp_path / "model", with_mesh("urdf", "bad.stl", "collision")))
    assert "bad.stl" in error.reason


def test_lines_in_a_mesh(tmp_path: Path) -> None:
    """They are left out: the engine would read beyond a line's two corners."""
    write(tmp_path / "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2\nf 2 3\nf 1 2 3\n")
    text = with_mesh("skel", "a.obj", "collision").replace("<skel>", "<skel><world name='w'>")
    for model in (with_mesh("urdf", "a.obj", "collision"), text.replace("</skel>", "</world></skel>")):
        world = World(0.001, write(tmp_path / "model", model))
        world.step(3)
        shape = world.skeletons[0].bodynodes[0].shapenodes[0].shape
        assert shape._handle.mesh(0).triangles().tolist() == [[0, 1, 2]]


def test_a_mesh_changes_after_a_trial(world: World, tmp_path: Path) -> None:
    """A file that worked is not tried again, unless its mesh has changed."""
    triangle(tmp_path / "a.stl")
    path = write(tmp_path / "model", with_mesh("sdf", "a.stl", "collision"))
    world.add_skeleton(path)
    write(tmp_path / "a.stl", "no longer a mesh")
    assert "a.stl" in refusal(path).reason


def test_mjcf_meshes(world: World, tmp_path: Path, caplog: Any) -> None:
    """Beside the file without a meshdir; a geom that collides with nothing is visual."""
    text = MJCF.replace("<worldbody>", "<asset><mesh name='a' file='a.obj'/></asset><worldbody>").replace(
        "<freejoint/>",
        "<freejoint/><inertial pos='0 0 0' mass='5' diaginertia='1 1 1'/><geom type='mesh' mesh='a'{flags}/>",
    )
    loud, quiet = text.format(flags=""), text.format(flags=" contype='0' conaffinity='0'")
    assert "the collision mesh 'a.obj'" in str(refusal(write(tmp_path / "m.xml", loud)))
    assert len(world.add_skeleton(write(tmp_path / "m.xml", quiet), reader="engine").bodynodes[0].shapenodes) == 1
    assert "the visual mesh 'a.obj'" in caplog.text
    triangle(tmp_path / "a.obj")
    assert len(world.add_skeleton(write(tmp_path / "m.xml", loud), reader="engine").bodynodes[0].shapenodes) == 2
    triangle(tmp_path / "sub" / "a.obj").rename(tmp_path / "sub" / "b.obj")
    text = loud.replace("<mujoco>", "<mujoco><compiler meshdir='sub'/>").replace("a.obj", "b.obj")
    assert len(world.add_skeleton(write(tmp_path / "m.xml", text), reader="engine").bodynodes[0].shapenodes) == 2


def test_mjcf_includes(world: World, tmp_path: Path) -> None:
    main = MJCF.replace("<worldbody>", "\n<include file='part.xml'/><worldbody>")
    path = write(tmp_path / "main.xml", main)
    assert (refusal(path).line, "it includes 'part.xml': there is no file" in str(refusal(path))) == (2, True)
    write(tmp_path / "part.xml", "<mujoco><option gravity='0 0 -3'/></mujoco>")
    assert world.add_skeleton(path, reader="engine").m == pytest.approx(5)
    write(tmp_path / "part.xml", "<mujoco>\n<option gravity='0 0 x'/></mujoco>")
    assert (refusal(path).path, refusal(path).line) == (str(tmp_path / "part.xml"), 2)
    write(tmp_path / "part.xml", "<mujoco><include file='main.xml'/></mujoco>")
    assert "it includes 'main.xml', which includes this file" in str(refusal(path))
    for i in range(12):
        write(tmp_path / f"part{i}.xml", f"<mujoco><include file='part{i + 1}.xml'/></mujoco>")
    write(path, main.replace("part", "part0"))
    assert "more than 8 deep" in str(refusal(path))


def test_urdf_world(tmp_path: Path) -> None:
    write(tmp_path / "r.urdf", URDF)
    entity = "<entity model='m' name='one'><origin xyz='1 2 3' rpy='0 0 0'/></entity>"
    path = write(tmp_path / "w.urdf", f"<world name='w'><include filename='r.urdf' model_name='m'/>{entity}</world>")
    (skel,) = World(0.001, path).skeletons
    np.testing.assert_allclose(skel.bodynodes[0].T[:3, 3], [1, 2, 3], atol=1e-12)
    write(tmp_path / "r.urdf", URDF.replace("'2'", "'x'"))
    with pytest.raises(LoadError, match=r"r\.urdf', line 1"):
        World(0.001, path)


# The helper


def test_this_process_is_not_forked(tmp_path: Path) -> None:
    """Handlers of os.fork() do not run, and threads that hold locks do no harm."""
    code = f"""
import os, pydart2
os.register_at_fork(before=lambda: print("forked"))
pydart2.World(0.001).add_skeleton({URDF!r}, safe=True)
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "" and done.stderr == ""


def test_quick_models_leave_one_thread() -> None:
    """After a second thread the C++ library counts references with locked instructions, which steps feel by a tenth."""
    code = f"""
import ctypes, pydart2
pydart2.World(0.001, "skel/cubes.skel").add_skeleton({URDF!r})
print(ctypes.c_char.in_dll(ctypes.CDLL(None), "__libc_single_threaded").value)
"""
    environment = {**os.environ, "OPENBLAS_NUM_THREADS": "1"}
    done = subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=True)
    assert done.stdout == repr(b"\x01") + "\n", done.stderr


def test_own_models_are_not_tried(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("pydart2.loading.try_model", lambda *_: ("tried", 0.0))
    World(0.001, "skel/cubes.skel")
    with pytest.raises(LoadError, match="tried"):
        World(0.001, "skel/cubes.skel", safe=True)
    with pytest.raises(LoadError, match="tried"):
        World(0.001, SKEL_WORLD)
    World(0.001, SKEL_WORLD, safe=False)


def test_a_missing_helper_is_said(world: World, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("pydart2.loading.trial.HELPER", Path("/nowhere/_try_load"))
    with pytest.raises(pydart2.PydartError, match=r"cannot run /nowhere/_try_load: .*safe=False"):
        world.add_skeleton(URDF.replace("crane", "new"))


def stub(path: Path, script: str) -> Path:
    """A helper that is a child of nobody and does as the script says."""
    write(path, f"#!/bin/sh\nexec 3<&0\n({script}) <&3 &\n").chmod(0o755)
    return path


def test_a_parser_that_never_ends(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """Signal 24 is what the limit of processor time sends; who only waits is ended by the clock, with its children."""
    monkeypatch.setattr("pydart2.loading.trial.HELPER", stub(tmp_path / "slow", "read l; printf -- '-24 0 0\\n'"))
    monkeypatch.setattr("pydart2.loading.trial.SECONDS", 1.0)
    assert "does not finish it in 1 s of processor time; load_seconds= waits longer" in str(
        refusal(URDF.replace("crane", "slow"))
    )
    pid = tmp_path / "pid"
    monkeypatch.setattr("pydart2.loading.trial.HELPER", stub(tmp_path / "idle", f"sleep 999 & echo $! >{pid}; wait"))
    monkeypatch.setattr("pydart2.loading.trial.SECONDS", 0.02)
    assert "the engine does not finish it in 0.2" in str(refusal(URDF.replace("crane", "idle")))
    assert is_gone(int(pid.read_text()))


def is_gone(pid: int) -> bool:
    """Within 5 s."""
    for _ in range(500):
        status = Path(f"/proc/{pid}/stat")
        if not status.exists() or status.read_text().split(") ")[1][0] == "Z":
            return True
        time.sleep(0.01)
    return False


def test_a_helper_that_ends_at_once(world: World, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr("pydart2.loading.trial.HELPER", stub(tmp_path / "broken", "exit 3"))
    with pytest.raises(pydart2.PydartError, match="ends at once"):
        world.add_skeleton(URDF.replace("crane", "ends"))


def test_a_helper_is_kept(world: World) -> None:
    """Also after a model that crashes it; one that somebody ended is replaced."""
    world.add_skeleton(URDF.replace("crane", "first"))
    group = trial._idle[-1].group
    text = URDF.replace("</link>", "<visual><geometry><mesh filename='{}' scale='0 1 1'/></geometry></visual></link>")
    assert "would abort" in str(refusal(text.format(pydart2.data_path("obj/atlas/l_foot.obj"))))
    world.add_skeleton(URDF.replace("crane", "second"))
    assert trial._idle[-1].group == group
    os.killpg(group, signal.SIGKILL)
    world.add_skeleton(URDF.replace("crane", "third"))
    assert trial._idle[-1].group != group


def test_helpers_are_no_children_and_end(tmp_path: Path) -> None:
    """Who waits for all children waits for none of ours; a forked process has its own; they end when it does."""
    code = f"""
import os, pydart2
from pydart2.loading import trial
def load(name):
    pydart2.World(0.001).add_skeleton({URDF!r}.replace("crane", name))
    return trial._idle[-1].group
group = load("parent")
try:
    os.waitpid(-1, os.WNOHANG)
except ChildProcessError:
    print(group, flush=True)
child = os.fork()
own = load("child" if child == 0 else "again")
if child == 0:
    print(own, flush=True)
    os._exit(own == group)
assert own == group and os.waitpid(child, 0)[1] == 0
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    groups = list(map(int, done.stdout.split()))
    assert len(groups) == 2
    for group in groups:
        for _ in range(500):
            try:
                os.killpg(group, 0)
            except ProcessLookupError:
                break
            time.sleep(0.01)
        else:
            pytest.fail("a helper outlives its user")


def test_a_new_text_takes_a_few_starts_of_a_program() -> None:
    """2 to 3 ms where a program that does nothing takes half a millisecond; 20 before there was a helper that stays."""
    load, start = [], []
    for i in range(40):
        begin = time.perf_counter()
        World(0.001).add_skeleton(URDF.replace("crane", f"new{i}"))
        load.append(time.perf_counter() - begin)
        begin = time.perf_counter()
        subprocess.run(["true"], check=True)
        start.append(time.perf_counter() - begin)
    assert min(load) < 10.0 * min(start)


def test_no_line_is_longer_than_needed() -> None:
    """Even of a huge value, the error shows a part."""
    assert len(str(refusal(URDF.replace("'2'", f"'{'9' * 100_000}x'")))) < 500
    assert re.search(r"\d", str(refusal(URDF.replace("'2'", "'9 9'"))))
