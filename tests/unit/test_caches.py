"""What is read is that of the present state, whatever was read or set before."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import ArrayLike, NDArray

from pydart2 import Skeleton, World

Array = NDArray[np.float64]

READ: dict[str, Callable[[Skeleton], ArrayLike]] = {
    "M": lambda skel: skel.M,
    "Minv": lambda skel: skel.Minv,
    "aug": lambda skel: skel.aug_mass_matrix(),
    "c": lambda skel: skel.c,
    "c of another object": lambda skel: Skeleton(skel.world, _id=skel.id).c,
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


#: What changes a skeleton, or one of its bodies or dofs, by random numbers.
CHANGES: dict[str, Callable[[Skeleton, int, Array], object]] = {
    "q": lambda skel, i, x: setattr(skel, "q", x),
    "dq": lambda skel, i, x: setattr(skel, "dq", x),
    "ddq": lambda skel, i, x: skel.set_accelerations(x),
    "dof's q": lambda skel, i, x: skel.dofs[i % skel.ndofs].set_position(x[0]),
    "dof's dq": lambda skel, i, x: skel.dofs[i % skel.ndofs].set_velocity(x[0]),
    "damping": lambda skel, i, x: skel.dofs[i % skel.ndofs].set_damping_coefficient(abs(x[0])),
    "stiffness": lambda skel, i, x: skel.dofs[i % skel.ndofs].set_spring_stiffness(abs(x[0])),
    "mass": lambda skel, i, x: skel.bodynodes[i % skel.num_bodynodes()].set_mass(1.0 + abs(x[0])),
    "inertia": lambda skel, i, x: skel.bodynodes[i % skel.num_bodynodes()].set_inertia(np.eye(3) * (1.0 + abs(x[0]))),
    "gravity": lambda skel, i, x: skel.world.set_gravity(10.0 * x[:3]),
    "gravity mode": lambda skel, i, x: skel.bodynodes[i % skel.num_bodynodes()].set_gravity_mode(x[0] > 0.0),
    "force": lambda skel, i, x: skel.bodynodes[i % skel.num_bodynodes()].add_ext_force(x[:3]),
    "step": lambda skel, i, x: skel.world.step(),
}


@pytest.mark.parametrize("model", ["skel/fullbody1.skel", "skel/chain.skel", "skel/cubes.skel"])
@pytest.mark.parametrize("seed", range(4))
def test_reading_in_any_order(model: str, seed: int) -> None:
    """Beside a skeleton to which the same was done, and of which nothing was read."""
    draw = np.random.default_rng(seed)
    read = World(0.001, model).skeletons[-1]
    done: list[tuple[str, int, Array]] = []
    for _ in range(25):
        done.append((str(draw.choice(list(CHANGES))), int(draw.integers(1000)), draw.uniform(-1.0, 1.0, read.ndofs)))
        CHANGES[done[-1][0]](read, *done[-1][1:])
        fresh = World(0.001, model).skeletons[-1]
        for name, index, numbers in done:
            CHANGES[name](fresh, index, numbers)
        for name in draw.choice(list(READ), 4, replace=False):
            for got, want in zip(*(np.atleast_1d(READ[name](skel)) for skel in (read, fresh)), strict=True):
                message = f"{name} after {done[-1][0]}"
                assert_allclose(got, want, rtol=0.0, atol=1e-9 * max(1.0, np.abs(want).max()), err_msg=message)
