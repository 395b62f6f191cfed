"""Meshes with a negative scale: mirrored, facing outwards, drawn and collided with as their vertices say."""

from __future__ import annotations

import itertools
import pickle
from pathlib import Path

import numpy as np
import pytest

from pydart2 import World
from pydart2.shape import MeshShape

INERTIAL = "<inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial>"
#: A wedge from x = 1 to 3, y = 0 to 1, as high as z = 1 at x = 3: no mirror image of it is the wedge itself.
CORNERS = np.array([[1, 0, 0], [3, 0, 0], [3, 1, 0], [1, 1, 0], [3, 0, 1], [3, 1, 1]], float)
FACES = np.array([[0, 2, 1], [0, 3, 2], [1, 2, 5], [1, 5, 4], [0, 1, 4], [3, 5, 2], [0, 4, 5], [0, 5, 3]])
DETECTORS = ("fcl", "bullet", "ode", "native")


@pytest.fixture
def wedge(tmp_path: Path) -> Path:
    """In a folder whose name needs care in XML and in URIs."""
    path = tmp_path / "a & b #1" / "wedge.obj"
    path.parent.mkdir()
    lines = [f"v {x} {y} {z}" for x, y, z in CORNERS]
    path.write_text("\n".join(lines + [f"f {a} {b} {c}" for a, b, c in FACES + 1]))
    return path


def text(kind: str, scale: str) -> str:
    """A model with the wedge as its only shape, to stand beside it."""
    if kind == "urdf":
        shapes = "".join(
            f"<{tag}><geometry><mesh filename='wedge.obj' scale='{scale}'/></geometry></{tag}>"
            for tag in ("visual", "collision")
        )
        return f"<robot name='r'><link name='l'>{INERTIAL}{shapes}</link></robot>"
    if kind == "sdf":
        mesh = f"<geometry><mesh><uri>wedge.obj</uri><scale>{scale}</scale></mesh></geometry>"
        link = f"<visual name='v'>{mesh}</visual><collision name='c'>{mesh}</collision>"
        return f"<sdf version='1.5'><model name='m'><link name='l'>{link}</link></model></sdf>"
    mesh = f"<geometry><mesh><file_name>wedge.obj</file_name><scale>{scale}</scale></mesh></geometry>"
    shapes = f"<visualization_shape>{mesh}</visualization_shape><collision_shape>{mesh}</collision_shape>"
    body = f"<body name='b'><inertia><mass>1</mass></inertia>{shapes}</body>"
    joint = "<joint type='free' name='j'><parent>world</parent><child>b</child></joint>"
    return f"<skel version='1.0'><skeleton name='s'>{body}{joint}</skeleton></skel>"


def file(wedge: Path, kind: str, scale: str) -> Path:
    path = wedge.with_name(f"model.{kind}")
    path.write_text(text(kind, scale))
    return path


def drawn(world: World) -> list[tuple[np.ndarray, np.ndarray, np.ndarray]]:
    """Corners, normals and triangles of each mesh shape of the first skeleton."""
    shapes = [node.shape for node in world.skeletons[0].bodynodes[0].shapenodes]
    meshes = [(shape._handle.mesh(0), shape.scale()) for shape in shapes if isinstance(shape, MeshShape)]
    return [(mesh.vertices() * scale, mesh.normals(), mesh.triangles().astype(int)) for mesh, scale in meshes]


def volume(corners: np.ndarray, triangles: np.ndarray) -> float:
    """Of what the triangles enclose, > 0 if they face outwards (Gauss)."""
    a, b, c = (corners[triangles[:, i]] for i in range(3))
    return float(np.einsum("ij,ij->", a, np.cross(b, c))) / 6.0


@pytest.mark.parametrize("signs", list(itertools.product([1, -1], repeat=3)), ids=str)
@pytest.mark.parametrize("kind", ["urdf", "sdf", "skel"])
def test_what_is_drawn(wedge: Path, kind: str, signs: tuple[int, ...]) -> None:
    """The corners are the file's times the scale; triangles and normals look outwards; copies are the same."""
    scale = np.array([2.0, 1.0, 0.5]) * signs
    world = World(0.001)
    world.add_skeleton(file(wedge, kind, " ".join(map(str, scale))))
    shapes = drawn(world)
    assert len(shapes) == 2
    for corners, normals, triangles in shapes:
        wanted = {tuple(corner) for corner in CORNERS * scale}
        assert {tuple(corner) for corner in corners} == wanted
        assert volume(corners, triangles) == pytest.approx(1.0)
        a, b, c = (corners[triangles[:, i]] for i in range(3))
        assert (np.einsum("ij,ij->i", np.cross(b - a, c - a), normals[triangles[:, 0]]) > 0.0).all()
    shape = world.skeletons[0].bodynodes[0].shapenodes[0].shape
    np.testing.assert_array_equal(shape.scale(), [2.0, 1.0, 0.5])
    assert shape.path() == str(wedge)
    for copy in (world.clone(), pickle.loads(pickle.dumps(world))):
        for ours, theirs in zip(drawn(copy), shapes, strict=True):
            assert all(np.array_equal(x, y) for x, y in zip(ours, theirs, strict=True))


def test_beside_the_file_as_it_is(wedge: Path) -> None:
    """One file in both ways in one world, in any order."""
    for order in (("1 1 1", "-1 1 1"), ("-1 1 1", "1 1 1")):
        world = World(0.001)
        for scale in order:
            world.add_skeleton(file(wedge, "urdf", scale))
        bounds = [skel.bodynodes[0].shapenodes[0].shape.bounding_box() for skel in world.skeletons]
        lows = [float(low[0]) for low, _ in bounds]
        assert lows == [1.0 if scale[0] == "1" else -3.0 for scale in order]


@pytest.mark.parametrize("detector", DETECTORS)
def test_what_is_collided_with(wedge: Path, detector: str) -> None:
    """A ball rests on the mirrored wedge's flat side, where the file as it is would let it fall."""
    world = World(0.001, up="z")
    world.set_collision_detector(detector)
    assert world.add_skeleton(file(wedge, "urdf", "-1 1 -1"), base="fixed").ndofs == 0
    ball = world.add_sphere(0.2, 1.0, [-2.5, 0.5, 0.201])
    world.step(300)
    assert ball.bodynodes[0].C[2] == pytest.approx(0.2, abs=0.01)
    assert world.collision_result.num_contacts() > 0


def test_a_changed_skeleton_keeps_it(wedge: Path) -> None:
    """Its meshes are then written by their files, and read again."""
    world = World(0.001)
    skel = world.add_skeleton(file(wedge, "urdf", "-1 1 1"))
    before = drawn(world)
    skel.bodynodes[0].add_sphere(0.1)
    for copy in (world.clone(), pickle.loads(pickle.dumps(world)), pickle.loads(pickle.dumps(world.clone()))):
        for ours, theirs in zip(drawn(copy), before, strict=True):
            assert all(np.array_equal(x, y) for x, y in zip(ours, theirs, strict=True))
