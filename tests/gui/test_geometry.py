"""Meshes against the closed forms of their volumes."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from pydart2.gui import geometry
from pydart2.gui.geometry import Mesh

POLYGON = 40 / 2 * np.sin(2 * np.pi / 40)  # area of the 40-gon in the unit circle


def volume(mesh: Mesh) -> float:
    """By the divergence theorem."""
    a, b, c = mesh.vertices[mesh.triangles].astype(float).transpose(1, 0, 2)
    return float(np.einsum("ij,ij->", a, np.cross(b, c)) / 6.0)


@pytest.mark.parametrize(
    ("mesh", "expected", "tolerance"),
    [
        (geometry.sphere(3), 4 / 3 * np.pi, 0.002),
        (geometry.sphere(4), 4 / 3 * np.pi, 0.0005),
        (geometry.box(), 1.0, 1e-6),
        (geometry.cylinder(), POLYGON, 1e-6),
        (geometry.cone(), POLYGON / 3, 1e-6),
        (geometry.pyramid(), 1 / 3, 1e-6),
        (geometry.capsule(2.0), 2 * np.pi + 4 / 3 * np.pi, 0.01),
        (geometry.hull_of_spheres(((0.5, 0, 0, 0),)), np.pi / 6, 0.01),
        (geometry.hull_of_spheres(((0.5, 0, 0, -1), (0.5, 0, 0, 1))), np.pi / 6 + np.pi / 2, 0.01),
    ],
)
def test_volume_and_outward_faces(mesh: Mesh, expected: float, tolerance: float) -> None:
    assert volume(mesh) == pytest.approx(expected, rel=tolerance)
    assert mesh.is_closed


@pytest.mark.parametrize(
    "mesh", [geometry.sphere(), geometry.box(), geometry.cylinder(), geometry.cone(), geometry.capsule(1.0)]
)
def test_normals_are_unit_and_point_as_the_faces_do(mesh: Mesh) -> None:
    assert np.linalg.norm(mesh.normals, axis=1) == pytest.approx(1.0, abs=1e-6)
    corners = mesh.vertices[mesh.triangles]
    faces = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    assert (np.einsum("ij,ikj->ik", faces, mesh.normals[mesh.triangles]) > 0.0).all()


def test_open_and_inside_out_meshes_are_not_closed() -> None:
    cube = geometry.box()
    assert not geometry.quad().is_closed
    assert not Mesh(cube.vertices, cube.normals, cube.triangles[1:]).is_closed
    assert not Mesh(cube.vertices, cube.normals, cube.triangles[:, ::-1]).is_closed
    assert not geometry.mesh([], []).is_closed


@settings(max_examples=20)
@given(st.integers(2, 8), st.integers(2, 8), st.integers(0, 1000))
def test_heightmap(rows: int, columns: int, seed: int) -> None:
    heights = np.random.default_rng(seed).normal(size=(rows, columns))
    mesh = geometry.heightmap(heights)
    assert len(mesh.triangles) == 2 * (rows - 1) * (columns - 1)
    assert (mesh.normals[:, 2] > 0.0).all()
    # Row 0 is at the greatest y, column 0 at the least x, both about the middle.
    assert mesh.vertices[0] == pytest.approx([-(columns - 1) / 2, (rows - 1) / 2, heights[0, 0]], abs=1e-5)
    assert mesh.vertices[-1] == pytest.approx([(columns - 1) / 2, -(rows - 1) / 2, heights[-1, -1]], abs=1e-5)


def test_chessboard_has_squares_of_half_the_area_each() -> None:
    light, dark = geometry.chessboard(4)
    assert len(light.triangles) == len(dark.triangles) == 16
    assert light.bounds[0] == pytest.approx([-0.5, -0.5, 0.0]) and light.bounds[1] == pytest.approx([0.5, 0.5, 0.0])
    assert len(geometry.chessboard(3)[0].triangles) == 10 and len(geometry.chessboard(1)[1].triangles) == 0


def test_sharp_edges_stay_sharp() -> None:
    corners = np.array(list(np.ndindex(2, 2, 2)), float) - 0.5
    from scipy.spatial import ConvexHull

    faces = geometry._outwards(corners, ConvexHull(corners).simplices)
    sources, triangles = geometry.split_at_edges(corners, faces)
    assert len(sources) == 24  # three at each corner
    assert (sources[triangles] == faces).all()
    normals = geometry.smooth_normals(corners[sources], triangles)
    assert np.sort(np.abs(normals), axis=1) == pytest.approx(np.tile([0.0, 0.0, 1.0], (24, 1)))


def test_round_surfaces_are_not_split() -> None:
    ball = geometry.sphere(2)
    sources, _ = geometry.split_at_edges(ball.vertices, ball.triangles)
    assert sorted(sources) == list(range(len(ball.vertices)))
