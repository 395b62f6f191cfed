"""Recordings as arrays, tables, files and plots."""

from __future__ import annotations

import csv
from pathlib import Path

import matplotlib
import numpy as np
import pytest

import pydart2
from physics.models import make_world, pendulum, save_skeleton, slider

matplotlib.use("agg")


@pytest.fixture
def world(tmp_path: Path) -> pydart2.World:
    """A pendulum that swings for 20 steps, and a slider that comes after the first 5."""
    world = make_world(tmp_path, pendulum(), recording=True)
    world.skeletons[0].dq = [2.0]
    world.step(5)
    world.add_skeleton(save_skeleton(tmp_path, slider()))
    world.skeletons[1].dq = [3.0]
    world.step(15)
    return world


def recording(world: pydart2.World) -> pydart2.Recording:
    assert world.recording is not None
    return world.recording


def test_arrays_are_what_each_frame_says(world: pydart2.World) -> None:
    data, swing = recording(world), world.skeletons[0]
    np.testing.assert_allclose(data.t, 0.001 * np.arange(21), atol=1e-15)
    states = np.array([data.states(i)[:2] for i in range(21)])
    np.testing.assert_array_equal(data.q(swing), states[:, :1])
    np.testing.assert_array_equal(data.dq(swing), states[:, 1:])
    for which in (swing.name, 0, -2):
        np.testing.assert_array_equal(data.q(which), states[:, :1])
    name = swing.dofs[0].name
    np.testing.assert_array_equal(data.q(swing)[name], states[:, 0])
    np.testing.assert_array_equal(data[f"{swing.name}.{name}"], states[:, 0])


def test_frames_before_a_skeleton_came_are_nan(world: pydart2.World) -> None:
    q, dq = recording(world).q(1), recording(world).dq(1)
    assert np.isnan(q[:6]).all() and np.isfinite(q[6:]).all() and np.isnan(dq[:6]).all()
    np.testing.assert_allclose(np.diff(q[6:, 0]), 0.001 * dq[7:, 0], rtol=1e-9)
    world.remove_skeleton(world.skeletons[0])
    assert np.isnan(recording(world).q(0)).all()  # what was recorded is another world's


def test_rows_begin_at_the_first_frame_that_is_kept(world: pydart2.World) -> None:
    data = recording(world)
    data.limit_bytes = data.num_bytes // 2
    kept = data.num_frames() - data.first_frame
    assert 0 < kept < 21 and len(data.t) == len(data.q(0)) == kept
    assert data.t[0] == pytest.approx(0.001 * data.first_frame)


def test_times_are_those_of_the_world(tmp_path: Path) -> None:
    world = make_world(tmp_path, pendulum(), recording=True)
    world.step(2)
    world.set_time_step(0.01)
    world.step()
    world.t = 5.0
    world.step()
    recording(world).bake()
    np.testing.assert_allclose(recording(world).t, [0.0, 0.001, 0.002, 0.012, 5.01, 5.01])


def test_what_is_not_there_is_named(world: pydart2.World) -> None:
    data, dof = recording(world), world.skeletons[0].dofs[0].name
    with pytest.raises(pydart2.NameNotFound, match=rf"no dof '{dof}x' in .*; did you mean '{dof}'\?"):
        data[dof + "x"]
    with pytest.raises(ValueError, match="2 skeletons have dofs: say which"):
        data.q()
    with pytest.raises(pydart2.NameNotFound, match="no skeleton 'nobody'"):
        data.q("nobody")
    with pytest.raises(IndexError):
        data.q(2)
    twice = pydart2.World(0.001)
    for name in ("a", "b"):
        twice.add_box((1, 1, 1), name=name)
    shared = {dof.name for dof in twice["a"].dofs} & {dof.name for dof in twice["b"].dofs}
    for name in shared:
        with pytest.raises(ValueError, match="2 skeletons have a dof"):
            recording(twice)[name]


def test_contacts_of_a_frame_as_arrays(cubes: pydart2.World) -> None:
    cubes.step(300)
    result = recording(cubes).contacts(300)
    assert isinstance(result, pydart2.CollisionResult) and result.num_contacts() > 0
    np.testing.assert_array_equal(result.points, [contact.p for contact in result.contacts])
    np.testing.assert_array_equal(result.forces, [contact.f for contact in result.contacts])
    assert result.normals.shape == result.points.shape and result.depths.shape == (len(result.points),)
    np.testing.assert_allclose(np.linalg.norm(result.normals, axis=1), 1.0)
    assert [b[1].skeleton.id for b in result.contact_sets if b[1]] and result.bodies.shape == (len(result.points), 4)


def test_a_file_keeps_all_of_it(cubes: pydart2.World, tmp_path: Path) -> None:
    cubes.step(50)
    recording(cubes).save(tmp_path / "run.npz")
    run = pydart2.Run.load(tmp_path / "run.npz")
    assert list(run.dofs) == [skel.name for skel in cubes.skeletons] and len(run) == 51
    np.testing.assert_array_equal(run.t, recording(cubes).t)
    for skel in cubes.skeletons:
        np.testing.assert_array_equal(run.q(skel.name), recording(cubes).q(skel))
        np.testing.assert_array_equal(run.dq(skel), recording(cubes).dq(skel))
    for i in range(51):
        np.testing.assert_array_equal(run.contacts(i).forces, recording(cubes).contacts(i).forces)
        np.testing.assert_array_equal(run.contacts(i).bodies, recording(cubes).contacts(i).bodies)
    (tmp_path / "other.npz").write_bytes(b"no")
    with pytest.raises(ValueError, match="is not a saved recording"):
        pydart2.Run.load(tmp_path / "other.npz")


def test_an_empty_world_has_an_empty_run(tmp_path: Path) -> None:
    world = pydart2.World(0.001)
    world.step(3)
    recording(world).save(tmp_path / "run.npz")
    run = pydart2.Run.load(tmp_path / "run.npz")
    assert len(run) == 4 and run.dofs == {} and run.states.shape == (4, 0) and len(run.contacts(3)) == 0


def test_tables(world: pydart2.World, tmp_path: Path) -> None:
    data = recording(world)
    swing, slide = (f"{skel.name}.q.{skel.dofs[0].name}" for skel in world.skeletons)
    table = data.to_pandas()
    np.testing.assert_array_equal(table.index, data.t)
    np.testing.assert_array_equal(table[swing], data.q(0)[:, 0])
    assert table.index.name == "t" and len(table.columns) == 4 and table[slide].isna().sum() == 6
    dataset = data.to_xarray()
    assert dict(dataset.sizes) == {"t": 21, "dof": 2}
    np.testing.assert_array_equal(dataset["dq"].sel(dof=swing.replace(".q.", ".")), data.dq(0)[:, 0])
    data.to_csv(tmp_path / "run.csv")
    with open(tmp_path / "run.csv", newline="", encoding="utf-8") as file:
        header, *rows = csv.reader(file)
    assert header == ["t", *table.columns] and len(rows) == 21
    numbers = np.array(rows, dtype=float)
    np.testing.assert_array_equal(numbers, np.column_stack([data.t, table.to_numpy()]))


def test_a_plot(world: pydart2.World) -> None:
    from matplotlib import pyplot

    data = recording(world)
    names = [f"{skel.name}.{skel.dofs[0].name}" for skel in world.skeletons]
    _, axes = pyplot.subplots()
    assert data.plot(names[0], axes=axes) is axes
    [line] = axes.lines
    np.testing.assert_array_equal(line.get_ydata(), data[names[0]])
    assert line.get_label() == names[0] and axes.get_xlabel() == "t / s"
    assert len(data.plot(axes=pyplot.subplots()[1]).lines) == 2
    pyplot.close("all")


def test_what_an_extra_brings_is_named(world: pydart2.World, monkeypatch: pytest.MonkeyPatch) -> None:
    import sys

    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(pydart2.PydartError, match=r"needs pandas: pip install 'pydart2\[data\]'"):
        recording(world).to_pandas()


def test_reprs_are_short(world: pydart2.World) -> None:
    assert repr(recording(world)) == f"[Recording: 21 frames from 0, {recording(world).num_bytes / 1e6:.3g} MB]"
    names = ", ".join(skel.name for skel in world.skeletons)
    assert repr(recording(world).run) == f"[Run: 21 frames, 0 to 0.02 s, {names}]"
    assert recording(world)._ipython_key_completions_() == [skel.dofs[0].name for skel in world.skeletons]
