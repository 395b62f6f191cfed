"""Muscles on a skeleton: what their forces do."""

from __future__ import annotations

import numpy as np
import pytest

from pydart2 import ExportError, NameNotFound, PydartError, Skeleton
from pydart2.muscle import MTU, Route
from pydart2.muscle.skeleton import MusculoSkeleton

ROUTES = {
    "front": [("thigh", [0.06, -0.1, 0.01]), ("thigh", [0.07, -0.38, 0.0]), ("shank", [0.05, -0.06, 0.02])],
    "back": [("thigh", [-0.05, -0.2, 0.0]), ("shank", [-0.04, -0.1, -0.03]), ("foot", [-0.06, -0.02, 0.01])],
}
N_MUSCLES = len(ROUTES)
TINY = 1e-7  # s: the engine gives ddq in the coordinates of a free joint after the step


@pytest.fixture
def limb(leg: MusculoSkeleton) -> MusculoSkeleton:
    """The leg with a muscle in front of the knee and one behind knee and ankle."""
    for name, points in ROUTES.items():
        route = Route(points)
        route.initialize_points(leg)
        assert route.length is not None
        tendon = 0.7 * route.length
        leg.add_muscle(MTU(600.0, 0.3 * route.length, 8.0, tendon, L_MTU=route.length, name=name), route)
    return leg


def lengths(skel: MusculoSkeleton, q: np.ndarray) -> np.ndarray:
    """Length of each muscle in a pose."""
    skel.q = q
    skel.update_route_geometry()
    return np.array([route.length for _, route in skel.muscles])


def angular_momenta(skel: Skeleton) -> np.ndarray:
    """Of each body about the skeleton's centre of mass, from masses, inertias and velocities."""
    momenta = []
    for body in skel.bodynodes:
        omega = body.angular_jacobian() @ skel.dq
        turn = body.T[:3, :3]
        momenta.append(
            turn @ body.I @ turn.T @ omega + body.m * np.cross(body.C - skel.C, body.dC - skel.dC)  # König
        )
    return np.array(momenta)


def contract(skel: MusculoSkeleton, steps: int, stimulation: float = 0.8) -> None:
    for _ in range(steps):
        skel.stimulate(np.full(N_MUSCLES, stimulation))
        skel.apply_muscle_forces()
        skel.world.step()


def test_generalized_force_is_virtual_work(limb: MusculoSkeleton) -> None:
    """``tau = -F dl/dq`` for each muscle, with dl/dq by differences: lengths know nothing of forces."""
    limb.q = np.r_[np.zeros(3), limb.q[3:]]  # at zero rotation the root's dq are the derivatives of its q
    q, h = np.array(limb.q), 1e-6
    slopes = np.array([(lengths(limb, q + h * e) - lengths(limb, q - h * e)) / (2.0 * h) for e in np.eye(len(q))])
    limb.q = q
    for _ in range(100):
        limb.stimulate([0.8, 0.5])
    forces = np.array([mtu.F_mtu for mtu, _ in limb.muscles])
    assert np.all(forces > 50.0)
    mass_matrix = limb.M
    limb.world.set_time_step(TINY)
    limb.apply_muscle_forces()
    limb.world.step()
    np.testing.assert_allclose(mass_matrix @ limb.ddq, -slopes @ forces, rtol=1e-6, atol=1e-5)


def test_internal_forces_give_no_momentum(limb: MusculoSkeleton) -> None:
    """Linear or angular, up to the integrator's error, which is of first order in the time step."""
    start, drift = np.array(limb.q), []
    for timestep in (2e-4, 1e-4):
        limb.q, limb.dq = start, np.zeros(limb.ndofs)
        limb.world.set_time_step(timestep)
        limb.reset_muscles()
        for mtu, _ in limb.muscles:
            mtu.TIMESTEP = timestep
        contract(limb, round(0.1 / timestep))
        momenta = angular_momenta(limb)
        drift.append([limb.P, momenta.sum(axis=0)])
    assert max(body.m * np.linalg.norm(body.dC) for body in limb.bodynodes) > 1.0
    assert np.linalg.norm(momenta, axis=1).max() > 0.5
    coarse, fine = np.array(drift)
    np.testing.assert_allclose(np.linalg.norm(coarse, axis=1), 2.0 * np.linalg.norm(fine, axis=1), rtol=0.02)
    np.testing.assert_allclose(2.0 * fine - coarse, np.zeros((2, 3)), atol=1e-4)  # extrapolated to a time step of 0


def test_no_net_force_and_torque(limb: MusculoSkeleton) -> None:
    """The root's share of the generalized forces, about any point, is zero."""
    for _ in range(100):
        limb.stimulate([0.8, 0.5])
    limb.apply_muscle_forces()
    mass_matrix = limb.M
    limb.world.set_time_step(TINY)
    limb.world.step()
    tau = mass_matrix @ limb.ddq
    np.testing.assert_allclose(tau[:6], np.zeros(6), atol=1e-9 * np.abs(tau).max())
    assert np.abs(tau[6:]).min() > 0.1


def test_forces_act_for_one_step(limb: MusculoSkeleton) -> None:
    contract(limb, 20)
    limb.dq = np.zeros(limb.ndofs)
    limb.world.step()
    np.testing.assert_allclose(limb.ddq, np.zeros(limb.ndofs), atol=1e-9)


def test_a_muscle_within_one_body_does_nothing(leg: MusculoSkeleton) -> None:
    leg.add_muscle(MTU(600.0, 0.05, 8.0, 0.2), Route([("thigh", [0, 0, 0]), ("thigh", [0, -0.3, 0])]))
    for _ in range(100):
        leg.stimulate([1.0])
    assert leg.muscles[0][0].F_mtu > 100.0
    leg.apply_muscle_forces()
    leg.world.step()
    np.testing.assert_array_equal(leg.dq, np.zeros(leg.ndofs))


def test_stimulate_uses_the_present_length(limb: MusculoSkeleton) -> None:
    twins = [MTU(mtu.F_MAX, mtu.L_OPT, mtu.V_MAX, mtu.L_SLACK, L_MTU=mtu.L_MTU) for mtu, _ in limb.muscles]
    for knee in np.linspace(-0.6, 0.1, 30):
        limb.set_positions(knee=knee)
        limb.stimulate([0.9, 0.4])
        for twin, s, length in zip(twins, (0.9, 0.4), lengths(limb, limb.q)):
            twin.update(s, length)
    assert [mtu.F_mtu for mtu, _ in limb.muscles] == [twin.F_mtu for twin in twins]


def test_reset_and_update(limb: MusculoSkeleton) -> None:
    before = lengths(limb, limb.q)
    contract(limb, 50)
    assert limb.muscles[0][0].a > 0.5
    limb.update()
    after = [route.length for _, route in limb.muscles]
    assert not np.allclose(before, after)
    limb.reset_muscles()
    assert [mtu.F_mtu for mtu, _ in limb.muscles] == [None, None]
    assert [mtu.a for mtu, _ in limb.muscles] == [0.01, 0.01]


def test_order_of_calls(limb: MusculoSkeleton) -> None:
    with pytest.raises(PydartError, match=r"front.*stimulate\(\) comes before"):
        limb.apply_muscle_forces()


@pytest.mark.parametrize("stimulation", [0.5, [0.5], [0.1, 0.2, 0.3], [0.5, np.nan]])
def test_wrong_stimulation(limb: MusculoSkeleton, stimulation: object) -> None:
    with pytest.raises(ValueError, match="2 finite numbers expected"):
        limb.stimulate(stimulation)
    assert limb.muscles[0][0].F_mtu is None


def test_wrong_body_adds_no_muscle(leg: MusculoSkeleton) -> None:
    with pytest.raises(NameNotFound, match="shin"):
        leg.add_muscle(MTU(600.0, 0.05, 8.0, 0.2), Route([("thigh", [0, 0, 0]), ("shin", [0, 0, 0])]))
    assert leg.num_muscles() == 0


def test_names(leg: MusculoSkeleton) -> None:
    assert repr(leg) == "[MusculoSkeleton(0): leg # Muscles = 0]"
    leg.add_muscle(MTU(600.0, 0.05, 8.0, 0.2), Route([("thigh", [0, 0, 0]), ("foot", [0, 0, 0])]))
    assert repr(leg) == "[MusculoSkeleton(0): leg # Muscles = 1]"
    assert leg.num_muscles() == 1
    assert isinstance(leg, Skeleton)


def test_muscles_survive_a_new_root_joint(limb: MusculoSkeleton) -> None:
    limb.set_root_joint_to_weld()
    contract(limb, 20)
    assert [body for _, route in limb.muscles for body in route.bodynodes if body not in limb.bodynodes] == []
    assert np.abs(limb.dq).max() > 0.0


class Recorder:
    """A renderer that writes down its calls."""

    def __init__(self) -> None:
        self.calls: list[tuple[str, tuple[object, ...]]] = []

    def __getattr__(self, name: str) -> object:
        return lambda *args: self.calls.append((name, args))


def test_render(limb: MusculoSkeleton) -> None:
    for mtu, activation in zip((mtu for mtu, _ in limb.muscles), (0.0, 0.75)):
        mtu.a = activation
    limb.set_positions(knee=0.3)
    ri = Recorder()
    limb.render_with_ri(ri)
    assert [args for name, args in ri.calls if name == "set_color"] == [(0.0, 0.0, 1.0), (0.75, 0.0, 0.25)]
    drawn = [args[0] for name, args in ri.calls if name == "render_lines"]
    for points, (_, route) in zip(drawn, limb.muscles):
        expected = [point.to_world() for point in route.points]
        np.testing.assert_array_equal(points, expected)


def test_a_body_with_a_muscle_stays(limb: MusculoSkeleton) -> None:
    names = [body.name for body in limb.bodynodes]
    with pytest.raises(ValueError, match=r"a muscle of .* is fixed to 'foot'; take it from `muscles` before"):
        limb.detach("foot")
    assert [body.name for body in limb.bodynodes] == names
    limb.attach("foot", "thigh")  # within the skeleton the muscles go on
    limb.update_route_geometry()
    limb.muscles.clear()
    assert limb.detach("foot").bodynodes[0].name == "foot"


def test_a_file_has_no_muscles(limb: MusculoSkeleton) -> None:
    with pytest.raises(ExportError, match=r"muscles \('front', 'back'\)"):
        limb.to_skel(strict=True)


def test_a_clone_has_muscles_of_its_own(limb: MusculoSkeleton) -> None:
    copy = limb.world.clone().skeletons[0]
    assert isinstance(copy, MusculoSkeleton)
    assert all(point.body in copy.bodynodes for _, route in copy.muscles for point in route.points)
    for skel in (limb, copy):
        contract(skel, 20)
    assert limb.q.tobytes() == copy.q.tobytes()
