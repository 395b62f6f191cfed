"""What is read is that of the present state, whatever was read or set before."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.testing import assert_allclose

from pydart2 import Skeleton, World

READ: dict[str, Callable[[Skeleton], object]] = {
    "M": lambda skel: skel.M,
    "Minv": lambda skel: skel.Minv,
    "aug": lambda skel: skel.aug_mass_matrix(),
    "c": lambda skel: skel.c,
    "coriolis": lambda skel: skel.coriolis_forces(),
    "gravity": lambda skel: skel.gravity_forces(),
    "C": lambda skel: skel.C,
    "dC": lambda skel: skel.dC,
    "ddC": lambda skel: skel.ddC,
    "J": lambda skel: skel.com_linear_jacobian(),
    "dJ": lambda skel: skel.com_linear_jacobian_deriv(),
    "momenta": lambda skel: skel.centroidal_momentum_matrix(),
    "kinetic": lambda skel: skel.kinetic_energy(),
    "potential": lambda skel: skel.potential_energy(),
    "pose": lambda skel: skel.bodynodes[-1].T,
    "velocity": lambda skel: skel.bodynodes[-1].com_spatial_velocity(),
    "acceleration": lambda skel: skel.bodynodes[-1].com_spatial_acceleration(),
    "jacobian": lambda skel: skel.bodynodes[-1].world_jacobian(),
    "derivatives": lambda skel: skel.inverse_dynamics_derivatives(np.ones(skel.ndofs)),
    "external": lambda skel: skel.external_forces(),
}


@pytest.mark.parametrize("model", ["skel/fullbody1.skel", "skel/chain.skel", "skel/cubes.skel"])
def test_reading_in_any_order(model: str) -> None:
    draw = np.random.default_rng(0)
    skel = World(0.001, model).skeletons[-1]
    for _ in range(150):
        set_ = draw.choice(["q", "dq", "ddq"])
        if set_ == "ddq":
            skel.set_accelerations(draw.uniform(-1.0, 1.0, skel.ndofs))
        else:
            setattr(skel, set_, draw.uniform(-1.0, 1.0, skel.ndofs))
        fresh = World(0.001, model).skeletons[-1]
        fresh.q, fresh.dq = skel.q, skel.dq
        fresh.set_accelerations(skel.ddq)
        for name in draw.choice(list(READ), 4, replace=False):
            got, want = READ[name](skel), READ[name](fresh)
            assert_allclose(got, want, rtol=0.0, atol=1e-9 * max(1.0, float(np.abs(want).max())), err_msg=name)  # type: ignore[arg-type]
