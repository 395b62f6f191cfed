"""Muscles."""

from __future__ import annotations

import math
import re
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

import pydart2.muscle
from pydart2 import World
from pydart2.muscle import model_geyer_2010
from pydart2.muscle.route import AttachmentPoint, Route
from pydart2.muscle.skeleton import MusculoSkeleton
from pydart2.muscle.tendon_unit import MusculoTendonUnit

from .table import row, rows

POINTS = [("pelvis", [0, 0, 0.1]), ("ltorso", [0, 0.1, 0]), ("mtorso", [0, 0, 0.2])]


@pytest.fixture
def route(atlas: pydart2.Skeleton) -> Any:
    """A route along the back of Atlas."""
    route = Route(POINTS)
    route.initialize_points(atlas)
    return route


@pytest.fixture
def robot() -> Any:
    """Atlas with a muscle along its back."""
    world = World(0.001)
    robot = world.add_skeleton(pydart2.data_path("sdf/atlas/atlas_v3_no_head.sdf"), MusculoSkeleton)
    robot.add_muscle(unit(), Route(POINTS))
    return robot


def unit(**others: Any) -> Any:
    return MusculoTendonUnit(4000.0, 0.04, 6.0, 0.26, **others)


class Pen:
    """A renderer that notes what it is asked for."""

    def __init__(self) -> None:
        self.calls: dict[str, Any] = {}

    def __getattr__(self, name: str) -> Any:
        return lambda *args: self.calls.__setitem__(name, args)


@row("muscle.MTU", "muscle.Route")
def test_names_of_the_package() -> None:
    assert pydart2.muscle.MTU is MusculoTendonUnit
    assert pydart2.muscle.Route is Route


# Routes


@row(
    "muscle.route.AttachmentPoint",
    "muscle.route.AttachmentPoint.bodyname",
    "muscle.route.AttachmentPoint.offset",
    "muscle.route.AttachmentPoint.skeleton",
    "muscle.route.AttachmentPoint.body",
    "muscle.route.AttachmentPoint.is_initialized",
    "muscle.route.AttachmentPoint.initialize",
    "muscle.route.AttachmentPoint.to_world",
    "muscle.route.AttachmentPoint.__str__",
)
def test_attachment_point(atlas: pydart2.Skeleton) -> None:
    point = AttachmentPoint("ltorso", [0, 0.1, 0])
    assert (point.bodyname, point.is_initialized()) == ("ltorso", False)
    assert_allclose(point.offset, [0, 0.1, 0])
    point.initialize(atlas)
    assert (point.is_initialized(), point.skeleton, point.body) == (True, atlas, atlas.body("ltorso"))
    assert_allclose(point.to_world(), atlas.body("ltorso").to_world([0, 0.1, 0]))
    assert "ltorso" in str(point) and "0.1" in str(point)


@row(
    "muscle.route.Route",
    "muscle.route.Route.points",
    "muscle.route.Route.num_points",
    "muscle.route.Route.add_point",
    "muscle.route.Route.len",
)
def test_route() -> None:
    route = Route()
    for name, offset in POINTS:
        route.add_point(name, offset)
    assert route.num_points() == len(route.points) == len(route) == 3
    assert [point.bodyname for point in route.points] == [name for name, _ in POINTS]


@row(
    "muscle.route.Route.initialize_points",
    "muscle.route.Route.update_geometry_variables",
    "muscle.route.Route.world_points",
    "muscle.route.Route.world_directions",
    "muscle.route.Route.length",
)
def test_geometry(route: Any, atlas: pydart2.Skeleton) -> None:
    for angle in (0.0, 0.5):
        atlas.dof("back_bky").set_position(angle)
        route.update_geometry_variables()
        points = np.array([atlas.body(name).to_world(offset) for name, offset in POINTS])
        segments = np.diff(points, axis=0)
        lengths = np.linalg.norm(segments, axis=1)
        assert_allclose(route.world_points, points)
        assert_allclose(route.world_directions, segments / lengths[:, None])
        assert route.length == pytest.approx(lengths.sum())


@row(
    "muscle.route.Route.local_points",
    "muscle.route.Route.bodynodes",
    "muscle.route.Route.local_points_as_pair",
    "muscle.route.Route.bodynodes_as_pair",
)
def test_pairs(route: Any, atlas: pydart2.Skeleton) -> None:
    bodies = [atlas.body(name) for name, _ in POINTS]
    assert list(route.bodynodes) == bodies
    assert list(route.bodynodes_as_pair()) == [(bodies[0], bodies[1]), (bodies[1], bodies[2])]
    offsets = np.array([offset for _, offset in POINTS])
    assert_allclose(np.array(route.local_points), offsets)
    assert_allclose(list(route.local_points_as_pair()), [offsets[:2], offsets[1:]])


@row("muscle.route.Route.render_with_ri")
def test_draw_route(route: Any) -> None:
    pen = Pen()
    route.render_with_ri(pen)
    assert pen.calls["set_line_width"] == (3,)
    assert_allclose(pen.calls["render_lines"][0], route.world_points)


@row("muscle.route.Route.__repr__")
def test_repr_of_route(route: Any) -> None:
    assert "ltorso" in repr(Route(POINTS))
    assert float(re.findall(r"\d\.\d+", repr(route))[-1]) == pytest.approx(route.length, rel=1e-3)


# Muscles


CONSTANTS = {
    "W": 0.56,
    "C": math.log(0.05),
    "N": 1.5,
    "K": 5,
    "E_REF_PE": 0.56,
    "E_REF_BE": 0.28,
    "E_REF_BE2": 0.44,
    "E_REF": 0.04,
    "TAU_ACT": 0.01,
    "TAU_DACT": 0.04,
    "R_S": [0.01, 1],
}


@rows("muscle.tendon_unit.MusculoTendonUnit.", {name: (name, value) for name, value in CONSTANTS.items()})
def test_constant(case: tuple[str, Any]) -> None:
    name, value = case
    assert_allclose(getattr(MusculoTendonUnit, name), value)


PREFIX = "muscle.tendon_unit.MusculoTendonUnit"


@row(PREFIX, PREFIX + ".F_mtu", PREFIX + ".a", PREFIX + ".l_ce", PREFIX + ".reset")
def test_unit() -> None:
    muscle = unit(name="soleus", L_MTU=0.31)
    assert (muscle.F_mtu, muscle.a, muscle.name) == (None, 0.01, "soleus")
    assert muscle.l_ce == pytest.approx(0.05)
    muscle.update(1.0, 0.33)
    assert muscle.F_mtu > 0 and muscle.a > 0.01 and muscle.l_ce != 0.05
    muscle.reset()
    assert (muscle.F_mtu, muscle.a) == (None, 0.01)
    assert muscle.l_ce == pytest.approx(0.05)


@row(PREFIX + ".update", PREFIX + ".l_se", PREFIX + ".v_ce")
def test_isometric_force() -> None:
    muscle = unit()
    for _ in range(3000):
        force = muscle.update(1.0, 0.3 + 0.04 * 0.26)  # the tendon at its reference strain when l_ce is L_OPT
    assert muscle.a == pytest.approx(1.0, abs=1e-6)
    assert muscle.v_ce == pytest.approx(0.0, abs=1e-6)
    assert muscle.l_se + muscle.l_ce == pytest.approx(0.3104, abs=1e-6)
    assert force == muscle.F_mtu == pytest.approx(4000.0, rel=1e-3)
    assert force == pytest.approx(4000.0 * ((muscle.l_se / 0.26 - 1) / 0.04) ** 2, rel=1e-3)


@row(PREFIX + ".fn_ECC")
def test_activation() -> None:
    muscle = unit(A=0.5)
    assert muscle.fn_ECC(1.0) == pytest.approx(0.5 + 0.001 * 0.5 / 0.01)
    assert muscle.fn_ECC(0.0) == pytest.approx(0.5 - 0.001 * 0.5 / 0.04)


MODEL = "muscle.model_geyer_2010"


@row(MODEL, MODEL + ".fn_inv_f_vce0")
def test_force_velocity() -> None:
    inverse = model_geyer_2010.fn_inv_f_vce0
    assert_allclose([inverse(f, 5.0, 1.5) for f in (0.0, 0.5, 1.0)], [-1.0, -1 / 7, 0.0], atol=1e-12)
    v = inverse(1.25, 5.0, 1.5)
    assert 1.5 + 0.5 * (v - 1) / (7.56 * 5 * v + 1) == pytest.approx(1.25)


@row(MODEL + ".fn_f_lce0", MODEL + ".fn_f_p0", MODEL + ".fn_f_p0_ext")
def test_force_length() -> None:
    assert_allclose([model_geyer_2010.fn_f_lce0(x, 0.56, math.log(0.05)) for x in (1.0, 1.56, 0.44)], [1, 0.05, 0.05])
    assert_allclose([model_geyer_2010.fn_f_p0(x, 0.04) for x in (0.9, 1.0, 1.04, 1.08)], [0, 0, 1, 4], atol=1e-12)
    assert_allclose([model_geyer_2010.fn_f_p0_ext(x, 0.28, 0.44) for x in (0.9, 0.44, 0.16)], [0, 0, 1], atol=1e-12)


# Skeletons with muscles

SKELETON = "muscle.skeleton.MusculoSkeleton"


@row(SKELETON, SKELETON + ".muscles", SKELETON + ".num_muscles", SKELETON + ".add_muscle", SKELETON + ".__repr__")
def test_skeleton(robot: Any) -> None:
    muscle, route = unit(), Route(POINTS[:2])
    robot.add_muscle(muscle, route)
    assert robot.num_muscles() == len(robot.muscles) == 2
    assert robot.muscles[1] == (muscle, route)
    assert route.length > 0
    assert repr(robot) == "[MusculoSkeleton(0): drc_skeleton # Muscles = 2]"


@row(SKELETON + ".update", SKELETON + ".update_route_geometry")
def test_update_geometry(robot: Any) -> None:
    route = robot.muscles[0][1]
    for update, angle in ((robot.update, 0.5), (robot.update_route_geometry, 0.1)):
        before = route.length
        robot.dof("back_bky").set_position(angle)
        update()
        assert abs(route.length - before) > 1e-4


@row(SKELETON + ".stimulate", SKELETON + ".reset_muscles")
def test_stimulate(robot: Any) -> None:
    muscle = robot.muscles[0][0]
    robot.stimulate([1.0])
    assert muscle.a == pytest.approx(0.01 + 0.001 * 0.99 / 0.01)
    assert muscle.l_se == pytest.approx(robot.muscles[0][1].length - 0.04)
    robot.reset_muscles()
    assert muscle.a == 0.01


@row(SKELETON + ".apply_muscle_forces")
def test_apply_forces(robot: Any) -> None:
    robot.world.set_gravity([0, 0, 0])
    robot.stimulate([0.5])
    muscle, route = robot.muscles[0]
    muscle.F_mtu = 10.0
    expected = np.zeros(robot.ndofs)
    for i, u in enumerate(route.world_directions):
        for sign, (name, offset) in ((1, POINTS[i]), (-1, POINTS[i + 1])):
            expected += sign * 10.0 * robot.body(name).linear_jacobian(offset).T @ u
    robot.apply_muscle_forces()
    damping = np.array([dof.damping_coefficient() for dof in robot.dofs])
    robot.world.step()
    inertia = robot.M + 0.001 * np.diag(damping)  # damping is implicit; the pose has hardly changed
    assert np.abs(robot.dq).max() > 1e-5
    assert_allclose(inertia @ robot.dq / 0.001, expected, atol=0.05 * np.abs(expected).max())


@row(SKELETON + ".render_with_ri")
def test_draw_skeleton(robot: Any) -> None:
    pen = Pen()
    robot.muscles[0][0].a = 1.0
    robot.render_with_ri(pen)
    assert_allclose(pen.calls["set_color"][:3], [1, 0, 0])
    assert_allclose(pen.calls["render_lines"][0], robot.muscles[0][1].world_points)
