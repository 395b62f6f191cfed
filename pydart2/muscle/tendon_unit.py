"""A muscle with its tendon."""

from __future__ import annotations

import math
from typing import ClassVar

from pydart2.muscle.model_geyer_2010 import fn_f_lce0, fn_f_p0, fn_f_p0_ext, fn_inv_f_vce0


class MusculoTendonUnit:
    """A Hill-type muscle–tendon unit after H. Geyer and H. Herr (2010), see model_geyer_2010.

    A contractile element (CE) with a parallel and a buffer elasticity (PE, BE) is in series with a tendon (SE). With
    all forces in units of F_MAX, the activation a, and the force–length and force–velocity curves f_l and f_v ::

        f_se = (a f_l + f_pe) f_v - f_be

    As in the original model the parallel elasticity is scaled by f_v, so that f_v can be found at any activation; at
    rest f_v = 1.

    Parameters
    ----------
    F_MAX
        Maximum isometric force, N.
    L_OPT
        Optimal length of the CE, m.
    V_MAX
        Maximum shortening speed of the CE, L_OPT/s; the sign does not matter.
    L_SLACK
        Length of the slack tendon, m.
    L_MTU
        Length at the begin, m, more than L_SLACK; the tendon is slack then. Default: L_OPT + L_SLACK.
    A
        Activation at the begin.
    DEL_T
        Delay of the reflex, s: for controllers, update() does not use it.
    name
        For people.
    TIMESTEP
        Time from one update() to the next, s: the world's time step.

    Attributes
    ----------
    l_ce : float
        Length of the CE, m, at the end of the last step.
    a : float
        Activation.
    F_mtu : float or None
        Force, N; None before the first update().
    l_se : float
        Length of the tendon, m, at the last update().
    v_ce : float
        Velocity of the CE, m/s, < 0 for shortening.

    Raises
    ------
    ValueError
        If F_MAX, L_OPT, V_MAX, L_SLACK or TIMESTEP is not positive, or L_MTU not more than L_SLACK.
    """

    W = 0.56
    C = math.log(0.05)
    N = 1.5
    K = 5.0
    E_REF_PE = W
    E_REF_BE = 0.5 * W
    E_REF_BE2 = 1.0 - W
    E_REF = 0.04
    TAU_ACT = 0.01
    TAU_DACT = 0.04
    R_S: ClassVar[list[float]] = [0.01, 1.0]

    l_ce: float
    a: float
    F_mtu: float | None
    l_se: float
    v_ce: float

    def __init__(
        self,
        F_MAX: float,
        L_OPT: float,
        V_MAX: float,
        L_SLACK: float,
        L_MTU: float | None = None,
        A: float = 0.01,
        DEL_T: float = 0.02,
        name: str | None = None,
        TIMESTEP: float = 0.001,
    ) -> None:
        positive = {"F_MAX": F_MAX, "L_OPT": L_OPT, "|V_MAX|": abs(V_MAX), "L_SLACK": L_SLACK, "TIMESTEP": TIMESTEP}
        for what, value in positive.items():
            if not (math.isfinite(value) and value > 0.0):
                raise ValueError(f"{what} must be positive, got {value}")
        self.F_MAX = F_MAX
        self.L_OPT = L_OPT
        self.V_MAX = V_MAX
        self.L_SLACK = L_SLACK
        self.L_MTU = L_OPT + L_SLACK if L_MTU is None else L_MTU
        if not self.L_MTU > L_SLACK:
            raise ValueError(f"L_MTU must be more than L_SLACK {L_SLACK}, got {L_MTU}")
        self.A = A
        self.DEL_T = DEL_T
        self.name = name
        self.TIMESTEP = TIMESTEP
        self.reset()

    def reset(self) -> None:
        """Go back to the begin."""
        self.l_ce = self.L_MTU - self.L_SLACK
        self.a = self.A
        self.F_mtu = None
        self.l_se = self.L_SLACK
        self.v_ce = 0.0

    def update(self, s: float, l_mtu: float) -> float:
        """Take a step of TIMESTEP, by the explicit Euler method.

        Parameters
        ----------
        s
            Stimulation; confined to R_S.
        l_mtu
            Length of the whole unit now, m.

        Returns
        -------
        float
            The force F_mtu now, N, >= 0.

        Raises
        ------
        ValueError
            If an argument is not finite.
        """
        if not (math.isfinite(s) and math.isfinite(l_mtu)):
            raise ValueError(f"stimulation and length must be finite, got {s} and {l_mtu}")
        self.a = self.fn_ECC(min(max(s, self.R_S[0]), self.R_S[1]))
        self.l_se = l_mtu - self.l_ce
        l_ce0 = self.l_ce / self.L_OPT
        f_se0 = fn_f_p0(self.l_se / self.L_SLACK, self.E_REF)
        f_be0 = fn_f_p0_ext(l_ce0, self.E_REF_BE, self.E_REF_BE2)
        f_pe0 = fn_f_p0(l_ce0, self.E_REF_PE)
        f_vce0 = (f_se0 + f_be0) / (self.a * fn_f_lce0(l_ce0, self.W, self.C) + f_pe0)
        self.v_ce = fn_inv_f_vce0(f_vce0, self.K, self.N) * abs(self.V_MAX) * self.L_OPT
        self.l_ce += self.TIMESTEP * self.v_ce
        self.F_mtu = self.F_MAX * f_se0
        return self.F_mtu

    def fn_ECC(self, S: float) -> float:  # noqa: N802 (the original's; excitation–contraction coupling)
        """The activation after TIMESTEP at stimulation S: ``da/dt = (S - a) / tau``.

        tau is TAU_ACT while the activation rises and TAU_DACT while it falls.
        """
        tau = self.TAU_ACT if self.a < S else self.TAU_DACT
        return self.a + self.TIMESTEP * (S - self.a) / tau

    def __repr__(self) -> str:
        force = "None" if self.F_mtu is None else f"{self.F_mtu:.6g} N"
        return f"[MusculoTendonUnit({self.name}): F_mtu = {force}, l_ce = {self.l_ce:.6g} m, a = {self.a:.6g}]"
