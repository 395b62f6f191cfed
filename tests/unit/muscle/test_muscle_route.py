"""Routes of muscles."""

from __future__ import annotations

import numpy as np
import pytest

from pydart2 import NameNotFound, PydartError
from pydart2.muscle import Route
from pydart2.muscle.route import AttachmentPoint
from pydart2.muscle.skeleton import MusculoSkeleton

POINTS = [("thigh", [0.05, -0.1, 0.0]), ("thigh", [0.06, -0.35, 0.0]), ("shank", [0.04, -0.05, 0.02])]


def test_attachment_point(leg: MusculoSkeleton) -> None:
    point = AttachmentPoint("shank", [0.1, 0.2, 0.3])
    assert not point.is_initialized()
    assert str(point) == "(shank, [0.1, 0.2, 0.3])"
    with pytest.raises(PydartError, match="no skeleton yet"):
        point.to_world()
    point.initialize(leg)
    assert point.is_initialized()
    assert point.skeleton is leg
    assert point.body is leg.body("shank")
    pose = leg.body("shank").T
    np.testing.assert_allclose(point.to_world(), pose[:3, :3] @ [0.1, 0.2, 0.3] + pose[:3, 3])


def test_route_before_initialization() -> None:
    route = Route(POINTS)
    assert repr(Route()) == "[Route: , length = None]"
    assert repr(route).startswith("[Route: (thigh, [0.05, -0.1, 0]) - (thigh, ")
    assert repr(route).endswith("length = None]")
    assert len(route) == route.num_points() == 3
    assert route.length is None
    assert len(route.world_points) == len(route.world_directions) == 0
    with pytest.raises(PydartError, match="no skeleton yet"):
        route.update_geometry_variables()


def test_route_geometry(leg: MusculoSkeleton) -> None:
    route = Route()
    for name, offset in POINTS:
        route.add_point(name, offset)
    route.initialize_points(leg)
    world = [leg.body(name).to_world(offset) for name, offset in POINTS]
    first, second = world[1] - world[0], world[2] - world[1]
    np.testing.assert_allclose(route.world_points, world)
    assert route.length == pytest.approx(np.linalg.norm(first) + np.linalg.norm(second))
    np.testing.assert_allclose(route.world_directions[0] * np.linalg.norm(first), first)
    np.testing.assert_allclose(route.world_directions[1] * np.linalg.norm(second), second)
    assert route.bodynodes == [leg.body(name) for name, _ in POINTS]
    np.testing.assert_array_equal(route.local_points, [offset for _, offset in POINTS])
    assert f"length = {route.length:.6g} m" in repr(route)


def test_route_follows_the_pose(leg: MusculoSkeleton) -> None:
    route = Route(POINTS)
    route.initialize_points(leg)
    before = route.length
    leg.set_positions(knee=1.2)
    assert route.length == before
    route.update_geometry_variables()
    assert route.length != pytest.approx(before, abs=1e-3)


def test_pairs(leg: MusculoSkeleton) -> None:
    route = Route(POINTS)
    route.initialize_points(leg)
    names = [(first.name, second.name) for first, second in route.bodynodes_as_pair()]
    assert names == [("thigh", "thigh"), ("thigh", "shank")]
    pairs = list(route.local_points_as_pair())
    np.testing.assert_array_equal(pairs, [[POINTS[0][1], POINTS[1][1]], [POINTS[1][1], POINTS[2][1]]])


def test_segment_of_length_zero(leg: MusculoSkeleton) -> None:
    route = Route([POINTS[0], POINTS[0], POINTS[2]])
    route.initialize_points(leg)
    np.testing.assert_array_equal(route.world_directions[0], np.zeros(3))
    assert np.linalg.norm(route.world_directions[1]) == pytest.approx(1.0)


def test_offset_is_copied() -> None:
    offset = np.zeros(3)
    point = AttachmentPoint("thigh", offset)
    offset[0] = 1.0
    np.testing.assert_array_equal(point.offset, np.zeros(3))


def test_wrong_routes(leg: MusculoSkeleton) -> None:
    with pytest.raises(ValueError, match=r"shape \(3,\) expected, got \(2,\)"):
        Route([("thigh", [1, 2])])
    with pytest.raises(ValueError, match="two points at least"):
        Route(POINTS[:1]).initialize_points(leg)
    with pytest.raises(NameNotFound, match="did you mean 'thigh'"):
        Route([("thig", [0, 0, 0]), ("shank", [0, 0, 0])]).initialize_points(leg)


class Recorder:
    """A renderer that writes down its calls."""

    def __init__(self) -> None:
        self.calls: list[tuple[str, tuple[object, ...]]] = []

    def __getattr__(self, name: str) -> object:
        return lambda *args: self.calls.append((name, args))


def test_render(leg: MusculoSkeleton) -> None:
    route = Route(POINTS)
    route.initialize_points(leg)
    ri = Recorder()
    route.render_with_ri(ri)
    assert ri.calls[0] == ("set_line_width", (3,))
    assert ri.calls[1][0] == "render_lines"
    np.testing.assert_array_equal(ri.calls[1][1][0], route.world_points)
