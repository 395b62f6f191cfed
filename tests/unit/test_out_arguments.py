"""Methods with `out` write to the caller's array; any other array than one that fits is refused untouched."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import pydart2

SKELETON = [
    "positions",
    "velocities",
    "accelerations",
    "commands",
    "states",
    "mass_matrix",
    "inv_mass_matrix",
    "coriolis_and_gravity_forces",
    "constraint_forces",
    "com",
]
BODY = [
    "transform",
    "world_transform",
    "jacobian",
    "world_jacobian",
    "linear_jacobian",
    "angular_jacobian",
    "linear_jacobian_deriv",
    "world_jacobian_classic_deriv",
    "angular_jacobian_deriv",
]


def moving(world: pydart2.World) -> pydart2.Skeleton:
    skel = world.skeletons[1]
    rng = np.random.default_rng(1)
    skel.q, skel.dq = rng.uniform(-1, 1, skel.ndofs), rng.uniform(-1, 1, skel.ndofs)
    skel.comms = rng.uniform(-1, 1, skel.ndofs)
    return skel


def methods(world: pydart2.World) -> list[Callable[..., Any]]:
    skel = moving(world)
    of_skeleton = [getattr(skel, name) for name in SKELETON]
    return [*of_skeleton, *(getattr(skel.bodynodes[-1], name) for name in BODY), world.states]


def test_out_is_filled_and_returned(fullbody: pydart2.World) -> None:
    for method in methods(fullbody):
        fresh = method()
        out = np.full(fresh.shape, np.nan)
        assert method(out=out) is out
        np.testing.assert_array_equal(out, fresh, err_msg=method.__name__)


def test_a_vector_with_names_can_be_filled_again(fullbody: pydart2.World) -> None:
    skel = moving(fullbody)
    q = skel.q
    skel.q = np.zeros(skel.ndofs)
    assert skel.positions(out=q) is q
    assert q["j_head_1"] == 0.0


def test_what_does_not_fit_is_refused_untouched(fullbody: pydart2.World) -> None:
    for method in methods(fullbody):
        shape = method().shape
        read_only = np.zeros(shape)
        read_only.flags.writeable = False
        wrong: list[Any] = [
            np.zeros((*shape, 1)),
            np.zeros(shape, np.float32),
            np.zeros((2, *shape)).T,
            read_only,
            [0.0],
        ]
        wrong.append(np.zeros((*shape[:-1], shape[-1] + 1)))
        for out in wrong:
            with pytest.raises(
                (TypeError, ValueError),
                match=r"out needs to be (an array of float64|a writeable array in C order of shape)",
            ):
                method(out=out)
            assert not np.any(np.asarray(out)), method.__name__


def test_a_fresh_array_is_writeable_and_its_own(fullbody: pydart2.World) -> None:
    for method in methods(fullbody):
        first = method()
        first[...] = 7.0
        assert not np.any(method() == 7.0), method.__name__
