"""The muscle's curves and its equations, evaluated on their own here."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from pydart2.muscle import MTU, MusculoTendonUnit
from pydart2.muscle import model_geyer_2010 as model

# The soleus of Geyer and Herr (2010), table I
F_MAX, L_OPT, V_MAX, L_SLACK = 4000.0, 0.04, 6.0, 0.26
SPEED = V_MAX * L_OPT


def soleus(**kwargs: object) -> MTU:
    return MTU(F_MAX, L_OPT, V_MAX, L_SLACK, **kwargs)


# The equations of the paper, with lengths in m, v_max < 0 and forces in N


def force_length(l_ce: float) -> float:
    return math.exp(math.log(0.05) * abs((l_ce - L_OPT) / (L_OPT * 0.56)) ** 3)


def force_velocity(v: float, v_max: float = -SPEED, n: float = 1.5, k: float = 5.0) -> float:
    if v < 0.0:
        return (v_max - v) / (v_max + k * v)
    return n + (n - 1.0) * (v_max + v) / (7.56 * k * v - v_max)


def tendon_force(l_se: float) -> float:
    return F_MAX * ((l_se - L_SLACK) / (0.04 * L_SLACK)) ** 2 if l_se > L_SLACK else 0.0


def parallel_force(l_ce: float) -> float:
    return F_MAX * ((l_ce - L_OPT) / (0.56 * L_OPT)) ** 2 if l_ce > L_OPT else 0.0


def buffer_force(l_ce: float) -> float:
    rest = L_OPT * (1.0 - 0.56)
    return F_MAX * ((rest - l_ce) / (0.28 * L_OPT)) ** 2 if l_ce < rest else 0.0


def imbalance(l_ce: float, v: float, a: float, l_mtu: float) -> float:
    """Force of the muscle minus that of the tendon."""
    muscle = (a * F_MAX * force_length(l_ce) + parallel_force(l_ce)) * force_velocity(v) - buffer_force(l_ce)
    return muscle - tendon_force(l_mtu - l_ce)


def test_names_and_constants() -> None:
    assert MTU is MusculoTendonUnit
    assert (MTU.W, MTU.N, MTU.K, MTU.E_REF, MTU.TAU_ACT, MTU.TAU_DACT) == (0.56, 1.5, 5, 0.04, 0.01, 0.04)
    assert (MTU.E_REF_PE, MTU.E_REF_BE, round(MTU.E_REF_BE2, 15)) == (0.56, 0.28, 0.44)
    assert math.exp(MTU.C) == pytest.approx(0.05)
    assert MTU.R_S == [0.01, 1]


# Curves


@given(st.floats(-1.0, 1.0))
def test_inverse_force_velocity(v: float) -> None:
    assert model.fn_inv_f_vce0(force_velocity(v, v_max=-1.0), 5.0, 1.5) == pytest.approx(v, abs=1e-9)


def test_inverse_force_velocity_at_its_ends() -> None:
    assert model.fn_inv_f_vce0(0.0, 5.0, 1.5) == -1.0
    assert model.fn_inv_f_vce0(1.0, 5.0, 1.5) == 0.0
    assert [model.fn_inv_f_vce0(f, 5.0, 1.5) for f in (1.5, 1.5132275, 1.6, 100.0)] == [1.0] * 4
    speeds = [model.fn_inv_f_vce0(f, 5.0, 1.5) for f in np.linspace(0.0, 2.0, 500)]
    assert np.all(np.diff(speeds) >= 0.0)


def test_force_length() -> None:
    assert model.fn_f_lce0(1.0, 0.56, math.log(0.05)) == 1.0
    assert model.fn_f_lce0(1.56, 0.56, math.log(0.05)) == pytest.approx(0.05)
    for ratio in (0.3, 0.44, 0.9, 1.2, 1.7):
        assert model.fn_f_lce0(ratio, 0.56, math.log(0.05)) == pytest.approx(force_length(ratio * L_OPT))


def test_elasticities() -> None:
    assert [model.fn_f_p0(length, 0.04) for length in (0.5, 1.0)] == [0.0, 0.0]
    assert model.fn_f_p0(1.04, 0.04) == pytest.approx(1.0)
    assert model.fn_f_p0(1.02, 0.04) == pytest.approx(0.25)
    assert [model.fn_f_p0_ext(length, 0.28, 0.44) for length in (0.44, 1.0)] == [0.0, 0.0]
    assert model.fn_f_p0_ext(0.16, 0.28, 0.44) == pytest.approx(1.0)
    assert model.fn_f_p0_ext(0.30, 0.28, 0.44) == pytest.approx(0.25)


# Activation


@pytest.mark.parametrize(("start", "stimulation", "tau"), [(0.01, 0.8, 0.01), (1.0, 0.3, 0.04)])
def test_activation_is_first_order(start: float, stimulation: float, tau: float) -> None:
    mtu = soleus(A=start, TIMESTEP=1e-5)
    for step in range(1, 5001):
        mtu.update(stimulation, 0.3)
        if step % 1000 == 0:
            exact = stimulation + (start - stimulation) * math.exp(-step * 1e-5 / tau)
            assert mtu.a == pytest.approx(exact, abs=1e-3 * abs(start - stimulation))


def test_activation_step_is_explicit_euler() -> None:
    mtu = soleus(A=0.5)
    assert mtu.fn_ECC(0.7) == pytest.approx(0.5 + 0.001 / 0.01 * 0.2)
    assert mtu.fn_ECC(0.1) == pytest.approx(0.5 - 0.001 / 0.04 * 0.4)
    assert mtu.a == 0.5


@pytest.mark.parametrize(("stimulation", "end"), [(-3.0, 0.01), (0.0, 0.01), (0.4, 0.4), (7.0, 1.0)])
def test_stimulation_is_confined(stimulation: float, end: float) -> None:
    mtu = soleus(A=0.2)
    for _ in range(1000):
        mtu.update(stimulation, 0.3)
    assert mtu.a == pytest.approx(end)


# The muscle


def test_one_update() -> None:
    mtu = soleus(A=0.5, L_MTU=0.3)
    assert mtu.F_mtu is None
    assert (mtu.l_ce, mtu.l_se, mtu.v_ce) == (pytest.approx(0.04), 0.26, 0.0)
    force = mtu.update(0.5, 0.305)
    assert mtu.F_mtu == force == pytest.approx(tendon_force(0.265))
    assert mtu.l_se == pytest.approx(0.265)
    assert imbalance(0.04, mtu.v_ce, 0.5, 0.305) == pytest.approx(0.0, abs=1e-8 * F_MAX)
    assert mtu.v_ce < 0.0
    assert mtu.l_ce == pytest.approx(0.04 + 0.001 * mtu.v_ce)


@pytest.mark.parametrize("stimulation", [0.05, 0.3, 1.0])
@pytest.mark.parametrize("l_mtu", [0.272, 0.28, 0.3, 0.31, 0.32])
def test_isometric_contraction(stimulation: float, l_mtu: float) -> None:
    mtu = soleus()
    for _ in range(20000):  # 20 s: a stretched muscle lengthens slowly
        force = mtu.update(stimulation, l_mtu)
    l_ce = brentq(imbalance, 0.005, 0.08, args=(0.0, stimulation, l_mtu), xtol=1e-14)
    assert mtu.l_ce == pytest.approx(l_ce, rel=1e-6)
    assert force == pytest.approx(tendon_force(l_mtu - l_ce), rel=1e-4, abs=1e-3)
    assert mtu.v_ce == pytest.approx(0.0, abs=1e-6)


@pytest.mark.parametrize("speed", [-0.2, -0.1, 0.02, 0.1])
def test_isokinetic_contraction(speed: float) -> None:
    """Against the same equations by another solver, implicit in velocity; speed in m/s, down to nearly v_max."""
    a, l_start = 0.6, 0.3

    def velocity(l_ce: float, l_mtu: float) -> float:
        return brentq(imbalance_of_velocity, -SPEED, SPEED, args=(l_ce, l_mtu), xtol=1e-14)

    def imbalance_of_velocity(v: float, l_ce: float, l_mtu: float) -> float:
        return imbalance(l_ce, v, a, l_mtu)

    l_rest = brentq(imbalance, 0.02, 0.05, args=(0.0, a, l_start), xtol=1e-15)
    seconds = 0.05
    solution = solve_ivp(
        lambda t, y: [velocity(y[0], l_start + speed * t)],
        (0.0, seconds),
        [l_rest],
        method="LSODA",
        rtol=1e-9,
        atol=1e-12,
    )
    mtu = soleus(A=a, TIMESTEP=1e-6)
    mtu.l_ce = l_rest
    steps = round(seconds / mtu.TIMESTEP)
    for i in range(steps):
        force = mtu.update(a, l_start + speed * i * mtu.TIMESTEP)
    l_ce = solution.y[0, -1]
    assert mtu.l_ce == pytest.approx(l_ce, rel=1e-4)
    assert force == pytest.approx(tendon_force(l_start + speed * seconds - l_ce), rel=2e-3)
    assert np.sign(mtu.v_ce) == np.sign(speed)


def test_force_velocity_of_a_moving_muscle() -> None:
    """Where the tendon does not change its length, the muscle has the speed of the whole unit."""
    mtu = soleus(A=1.0, TIMESTEP=1e-5)
    mtu.l_ce = 1.2 * L_OPT
    speed = -0.3 * SPEED
    stretch = 0.04 * L_SLACK * math.sqrt(force_velocity(speed))
    force_at = {}
    for i in range(20000):
        l_ce_wanted = 1.2 * L_OPT + speed * i * mtu.TIMESTEP
        if l_ce_wanted < 0.8 * L_OPT:
            break
        force_at[l_ce_wanted] = mtu.update(1.0, L_SLACK + l_ce_wanted + stretch)
    force = force_at[min(force_at, key=lambda l_ce: abs(l_ce - L_OPT))]
    assert force / F_MAX == pytest.approx(force_velocity(speed), rel=0.02)


def test_a_slack_muscle_shortens_at_the_maximum_speed_without_force() -> None:
    mtu = soleus(A=1.0)
    assert mtu.update(1.0, 0.25) == 0.0
    assert mtu.v_ce == pytest.approx(-SPEED)


def test_extreme_lengths_stay_finite() -> None:
    mtu = soleus()
    for l_mtu in [0.0] * 500 + [0.5] * 500 + [-1.0] * 500:
        assert 0.0 <= mtu.update(1.0, l_mtu) < 1e9
        assert 0.0 < mtu.l_ce < 0.5


def test_sign_of_the_maximum_speed_does_not_matter() -> None:
    forces = []
    for v_max in (6.0, -6.0):
        mtu = MTU(F_MAX, L_OPT, v_max, L_SLACK)
        forces.append([mtu.update(0.5, 0.3) for _ in range(50)])
    assert forces[0] == forces[1]
    assert forces[0][-1] > 0.0


def test_reset() -> None:
    mtu = soleus(A=0.1, L_MTU=0.31, name="SOL")
    first = [mtu.update(0.9, 0.31) for _ in range(20)]
    mtu.reset()
    assert (mtu.a, mtu.F_mtu, mtu.l_se, mtu.v_ce) == (0.1, None, 0.26, 0.0)
    assert mtu.l_ce == pytest.approx(0.05)
    assert [mtu.update(0.9, 0.31) for _ in range(20)] == first


def test_repr() -> None:
    mtu = soleus(name="SOL")
    assert repr(mtu) == "[MusculoTendonUnit(SOL): F_mtu = None, l_ce = 0.04 m, a = 0.01]"
    mtu.update(1.0, 0.3)
    assert "F_mtu = 0 N" in repr(mtu)


@pytest.mark.parametrize(
    ("kwargs", "what"),
    [
        ({"F_MAX": 0.0}, "F_MAX"),
        ({"L_OPT": -1.0}, "L_OPT"),
        ({"V_MAX": 0.0}, "V_MAX"),
        ({"L_SLACK": math.nan}, "L_SLACK"),
        ({"TIMESTEP": 0.0}, "TIMESTEP"),
        ({"L_MTU": 0.2}, "L_MTU"),
    ],
)
def test_wrong_parameters(kwargs: dict[str, float], what: str) -> None:
    good = {"F_MAX": F_MAX, "L_OPT": L_OPT, "V_MAX": V_MAX, "L_SLACK": L_SLACK}
    with pytest.raises(ValueError, match=what):
        MTU(**{**good, **kwargs})


@pytest.mark.parametrize(("s", "l_mtu"), [(math.nan, 0.3), (0.5, math.inf)])
def test_wrong_update(s: float, l_mtu: float) -> None:
    with pytest.raises(ValueError, match="finite"):
        soleus().update(s, l_mtu)
