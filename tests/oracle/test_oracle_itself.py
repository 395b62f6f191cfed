"""The oracles against closed forms, known facts and each other: what the other tests may rely on."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from .cpp_oracle import CppOracle
from .dartpy_oracle import DartpyOracle, Simulation
from .models import dart_model
from .wire import OracleError, OracleMissing

CUBES = "skel/cubes.skel"  # a ground and three cubes on top of each other
ATLAS = "sdf/atlas/atlas_v3_no_head.sdf"
CHAIN = "skel/test/serial_chain_eulerxyz_joint.skel"  # Euler joints only, so dq is the derivative of q
NICK = "vsk/Nick01.vsk"
State = tuple[NDArray[np.float64], NDArray[np.float64]]


def random_states(simulation: Simulation, seed: int) -> list[State]:
    """Return a random q (rad or m) and dq for every skeleton, small enough for any joint."""
    rng = np.random.default_rng(seed)
    sizes = [len(skeleton["dofs"]) for skeleton in simulation.skeletons]
    return [(rng.uniform(-0.5, 0.5, n), rng.uniform(-1.0, 1.0, n)) for n in sizes]


# ---- dartpy against closed forms ---------------------------------------------------------------------------


def test_free_fall_is_semi_implicit_euler(oracle: DartpyOracle) -> None:
    """v_n = v_0 + n g dt and y_n = y_0 + n v_0 dt + g dt² n (n + 1) / 2, for cubes far from everything."""
    n, dt, g = 200, 0.002, -9.81
    q0 = [np.array([0, 0, 0, 10.0 * i, 20.0 + i, 0]) for i in range(3)]
    dq0 = [np.array([0, 0, 0, 0.3, 0.5 * i, -0.1]) for i in range(3)]
    falling = [None, *zip(q0, dq0, strict=True)]
    fall = oracle.simulate(dart_model(CUBES), dt=dt, skeleton_states=falling, steps=n)
    assert fall.dt == dt
    assert fall[n].time == pytest.approx(n * dt)
    assert len(fall[n].contacts) == 0
    for i in range(3):
        cube = fall[n].skeletons[i + 1]
        expected_dq = dq0[i] + np.array([0, 0, 0, 0, n * g * dt, 0])
        expected_q = q0[i] + n * dt * dq0[i] + np.array([0, 0, 0, 0, g * dt**2 * n * (n + 1) / 2, 0])
        np.testing.assert_allclose(cube["dq"], expected_dq, rtol=1e-12, atol=1e-13)
        np.testing.assert_allclose(cube["q"], expected_q, rtol=1e-12, atol=1e-13)
        np.testing.assert_allclose(cube["ddq"], [0, 0, 0, 0, g, 0], rtol=1e-12, atol=1e-13)


def test_constant_force_on_a_free_cube(oracle: DartpyOracle) -> None:
    """A force set before every step accelerates by tau / m in every step; gravity is the one asked for."""
    n, dt = 100, 0.001
    high: list[Any] = [None, None, None, (np.array([0, 0, 0, 0, 9.0, 0]), np.zeros(6))]
    tau: list[Any] = [None, None, None, [0, 0, 0, 2.0, 0, 0]]
    pushed = oracle.simulate(dart_model(CUBES), dt=dt, gravity=[0, 0, 1.5], skeleton_states=high, forces=tau, steps=n)
    np.testing.assert_array_equal(pushed.gravity, [0, 0, 1.5])
    mass = pushed.skeletons[3]["mass"]
    expected = n * dt * np.array([0, 0, 0, 2.0 / mass, 0, 1.5])
    np.testing.assert_allclose(pushed[n].skeletons[3]["dq"], expected, rtol=1e-12, atol=1e-13)


def test_jacobians_match_finite_differences(oracle: DartpyOracle) -> None:
    """J dq is the velocity of each body's origin, Jang dq its angular velocity, dC the centre of mass's."""
    path, h = dart_model(CHAIN), 1e-6
    [(q, dq)] = random_states(oracle.simulate(path), seed=1)
    here, ahead, behind = (
        oracle.simulate(path, skeleton_states=[(q + s * h * dq, dq)])[0].skeletons[0] for s in (0, 1, -1)
    )
    dT = (ahead["T"] - behind["T"]) / (2 * h)
    np.testing.assert_allclose(here["J"] @ dq, dT[:, :3, 3], atol=1e-8)
    spin = dT[:, :3, :3] @ here["T"][:, :3, :3].transpose(0, 2, 1)  # the cross-product matrix of omega
    omega = np.stack([spin[:, 2, 1], spin[:, 0, 2], spin[:, 1, 0]], axis=1)
    np.testing.assert_allclose(here["Jang"] @ dq, omega, atol=1e-8)
    np.testing.assert_allclose(here["dC"], (ahead["C"] - behind["C"]) / (2 * h), atol=1e-8)
    assert here["kinetic"] == pytest.approx(0.5 * dq @ here["M"] @ dq, rel=1e-12)
    dV = (ahead["potential"] - behind["potential"]) / (2 * h)
    assert here["g"] @ dq == pytest.approx(dV, rel=1e-7)


def test_equation_of_motion(oracle: DartpyOracle) -> None:
    """M ddq + c = tau at the state before the step, since the joints have no damping."""
    path = dart_model("skel/test/double_pendulum.skel")
    [state] = random_states(oracle.simulate(path), seed=2)
    tau = np.array([0.3, -0.2])
    run = oracle.simulate(path, skeleton_states=[state], forces=[tau], steps=1)
    before, after = run[0].skeletons[0], run[1].skeletons[0]
    np.testing.assert_allclose(before["M"] @ after["ddq"] + before["c"], tau, rtol=1e-10)
    np.testing.assert_allclose(after["dq"], before["dq"] + run.dt * after["ddq"], rtol=1e-13)


def test_contact_forces_are_the_constraint_forces(oracle: DartpyOracle) -> None:
    """Constraint forces are the sum of J_pᵀ f over the contacts: f on the first body, -f on the second."""
    last = 40
    run = oracle.simulate(dart_model(CUBES), steps=last, report_at=[last - 1, last])
    before, after = run[last - 1], run[last]  # the contacts of a step belong to the pose before it
    total = [np.zeros(6) for _ in run.skeletons]
    for contact in after.contacts:
        for sign, s, b in ((1, contact["skel1"], contact["body1"]), (-1, contact["skel2"], contact["body2"])):
            body = before.skeletons[s]
            if body["q"].size:
                arm = contact["point"] - body["T"][b, :3, 3]
                J_p = body["J"][b] + np.cross(body["Jang"][b].T, arm).T
                total[s] += sign * J_p.T @ contact["force"]
    assert len(after.contacts) >= 4
    for s in (1, 2, 3):
        np.testing.assert_allclose(after.skeletons[s]["constraint_forces"], total[s], atol=1e-9)


# ---- dartpy: known facts -----------------------------------------------------------------------------------


def test_atlas(oracle: DartpyOracle) -> None:
    atlas = oracle.simulate(dart_model(ATLAS))
    np.testing.assert_array_equal(atlas.gravity, [0, -9.81, 0])
    [names] = atlas.skeletons
    assert names["mass"] == pytest.approx(146.554, abs=1e-9) == names["body_masses"].sum()
    assert len(names["dofs"]) == 33
    assert names["dofs"][6:9] == ["back_bkz", "back_bky", "back_bkx"]
    assert names["joint_types"][:2] == ["FreeJoint", "RevoluteJoint"]
    assert names["q_lower"][0] == -np.inf
    assert (names["q_lower"][6], names["q_upper"][6]) == (-0.663225, 0.663225)  # as in the file
    M = atlas[0].skeletons[0]["M"]
    np.testing.assert_allclose(M, M.T, rtol=1e-9, atol=1e-12)
    np.testing.assert_allclose(M[3:6, 3:6], names["mass"] * np.eye(3), atol=1e-9)


def test_skeletons_are_added_in_order(oracle: DartpyOracle) -> None:
    world = oracle.simulate([dart_model("sdf/ground.world"), dart_model(ATLAS)])
    assert [skeleton["name"] for skeleton in world.skeletons] == ["ground_plane", "drc_skeleton"]
    np.testing.assert_array_equal(world.gravity, [0, 0, -9.81])  # the file's
    with pytest.raises(OracleError, match="only the first model may be a world"):
        oracle.simulate([dart_model(ATLAS), dart_model(CUBES)])


def test_urdf_with_package_meshes_and_blanks_in_its_path(oracle: DartpyOracle) -> None:
    hubo = dart_model("urdf/drchubo/drchubo.urdf")
    with pytest.raises(OracleError, match="package 'drchubo'"):
        oracle.simulate(hubo)
    assert oracle.simulate(hubo, packages={"drchubo": hubo.parent}).skeletons[0]["mass"] > 40
    assert len(oracle.simulate(dart_model("urdf/KR5/KR5 sixx R650.urdf")).skeletons[0]["dofs"]) == 6


def test_fullbody_meets_the_ground(oracle: DartpyOracle) -> None:
    run = oracle.simulate(dart_model("skel/fullbody1.skel"), steps=400, fields=["q"])
    contacts = run[400].contacts
    assert len(contacts) > 5
    assert np.count_nonzero(np.linalg.norm(contacts["force"], axis=1)) > 5
    assert set(contacts["skel1"]) | set(contacts["skel2"]) == {0, 1}
    assert list(run[400].skeletons[1]) == ["q"]


@pytest.mark.parametrize("detector", ["fcl", "dart", "bullet", "ode"])
def test_the_ground_gives_the_momentum_that_gravity_does_not(oracle: DartpyOracle, detector: str) -> None:
    """M v_n = M v_0 + n M g dt + dt times the sum of all ground contact forces, vertically, for the cubes."""
    n = 300
    run = oracle.simulate(dart_model(CUBES), detector=detector, steps=n, report_at=range(n + 1), fields=["dC"])
    support = 0.0
    for frame in run.frames.values():
        contacts = frame.contacts
        support += contacts["force"][contacts["skel2"] == 0, 1].sum()
        support -= contacts["force"][contacts["skel1"] == 0, 1].sum()
    mass = np.array([skeleton["mass"] for skeleton in run.skeletons[1:]])
    speed = np.array([skeleton["dC"][1] for skeleton in run[n].skeletons[1:]])
    assert support * run.dt == pytest.approx(mass @ speed + n * run.dt * 9.81 * mass.sum(), rel=1e-3)


# ---- dartpy: the child process -----------------------------------------------------------------------------


def test_doubles_survive_bit_for_bit(oracle: DartpyOracle, cpp_oracle: CppOracle) -> None:
    path = dart_model("skel/test/double_pendulum.skel")
    state = (np.array([5e-324, 1 / 3]), np.array([-np.pi, 1e-300]))
    for answer in (
        oracle.simulate(path, skeleton_states=[state])[0].skeletons[0],
        cpp_oracle.ask("dynamics", path, 0, skeleton_states=[state])["skeletons"][0],
    ):
        assert answer["q"].tobytes() == state[0].tobytes()
        assert answer["dq"].tobytes() == state[1].tobytes()


def test_reporting_and_repeating_change_nothing(oracle: DartpyOracle) -> None:
    path = dart_model("skel/fullbody1.skel")
    once = oracle.simulate(path, steps=300)
    often = oracle.simulate(path, steps=300, report_at=range(0, 301, 3))
    assert len(once[300].contacts) > 0
    for name, value in once[300].skeletons[1].items():
        np.testing.assert_array_equal(often[300].skeletons[1][name], value)
    np.testing.assert_array_equal(often[300].contacts, once[300].contacts)


def test_an_abort_is_an_error_and_the_next_question_is_answered(oracle: DartpyOracle) -> None:
    path = dart_model("skel/test/double_pendulum.skel")
    with pytest.raises(OracleError, match=r"SIGABRT[\s\S]*Assertion"):
        oracle.simulate(path, skeleton_states=[([np.nan, 0], [0, 0])], steps=1)
    with pytest.raises(OracleError, match=r"q of double_pendulum: expected shape \(2,\), got \(3,\)"):
        oracle.simulate(path, skeleton_states=[([0, 0, 0], [0, 0])])
    with pytest.raises(OracleError, match=r"could not load[\s\S]*No such file"):
        oracle.simulate("no_such_file.skel")
    with pytest.raises(ValueError, match="report_at"):
        oracle.simulate(path, steps=3, report_at=[4])
    assert oracle.simulate(path).skeletons[0]["name"] == "double_pendulum"


def test_a_question_that_takes_too_long_is_given_up() -> None:
    with DartpyOracle(patience=1) as impatient, pytest.raises(OracleError, match="SIGALRM"):
        impatient.simulate(dart_model("skel/fullbody1.skel"), steps=10**7)


def test_what_to_install_is_said(tmp_path: Path) -> None:
    bare = tmp_path / "python3"
    bare.write_text('#!/bin/sh\nexec /usr/bin/python3 -S "$@"\n')  # -S: without Debian's packages
    bare.chmod(0o755)
    for python in (bare, tmp_path / "missing"):
        with (
            DartpyOracle(str(python)) as oracle,
            pytest.raises(OracleMissing, match=r"apt-get install .*python3-dartpy"),
        ):
            oracle.simulate("any.skel")
    with pytest.raises(OracleMissing, match="apt-get install dart-doc"):
        dart_model("skel/no_such_model.skel")


# ---- models ------------------------------------------------------------------------------------------------


def test_models_are_unpacked_beside_their_meshes() -> None:
    assert "<mujoco" in dart_model("mjcf/openai/ant.xml").read_text()
    atlas = dart_model(ATLAS)
    meshes = set(re.findall(r"<uri>(\S+?)</uri>", atlas.read_text()))
    assert meshes and all((atlas.parent / mesh).is_file() for mesh in meshes)


# ---- the C++ program ---------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "name",
    [
        CUBES,
        CHAIN,
        ATLAS,
        "skel/fullbody1.skel",
        "skel/biped.skel",  # asks for Bullet
        "skel/softBodies.skel",
        "skel/vehicle.skel",
        "urdf/KR5/KR5 sixx R650.urdf",
    ],
)
def test_both_oracles_agree_bit_for_bit(oracle: DartpyOracle, cpp_oracle: CppOracle, name: str) -> None:
    path, steps = dart_model(name), 200
    states = None if "soft" in name else random_states(oracle.simulate(path), seed=3)
    one = oracle.simulate(path, skeleton_states=states, steps=steps)[steps]
    two = cpp_oracle.ask("dynamics", path, steps, skeleton_states=states)
    assert one.time == two["time"]
    for by_dartpy, by_cpp in zip(one.skeletons, two["skeletons"], strict=True):
        for field in ("q", "dq", "M", "c", "C"):
            assert by_dartpy[field].tobytes() == by_cpp[field].tobytes(), field
        np.testing.assert_array_equal(by_dartpy["T"], by_cpp["T"])


def test_markers_move_with_their_bodies(cpp_oracle: CppOracle) -> None:
    """World position = T local; the local one is the file's, in millimetres there."""
    path = dart_model(NICK)
    skeleton = cpp_oracle.ask("vsk", path)
    rng = np.random.default_rng(4)
    state = (rng.uniform(-0.5, 0.5, len(skeleton["dofs"])), np.zeros(len(skeleton["dofs"])))
    T = cpp_oracle.ask("dynamics", path, 0, skeleton_states=[state])["skeletons"][0]["T"]
    frames = dict(zip([body["name"] for body in skeleton["bodies"]], T, strict=True))
    markers = cpp_oracle.ask("markers", path, skeleton_states=[state])["skeletons"][0]["markers"]
    assert len(markers) == len(re.findall(r"<Marker ", path.read_text())) == 53
    for marker in markers:
        expected = frames[marker["body"]] @ [*marker["local"], 1]
        np.testing.assert_allclose(marker["world"], expected[:3], atol=1e-14)
    assert (markers[0]["name"], markers[0]["body"]) == ("LFWT", "Hips")
    np.testing.assert_allclose(markers[0]["local"], [0.0663418, 0.0689531, 0.13114], rtol=1e-12)


def test_markers_of_a_skel_file(cpp_oracle: CppOracle, tmp_path: Path) -> None:
    path = tmp_path / "marker.skel"
    path.write_text(
        """<?xml version="1.0"?><skel version="1.0"><world name="w"><skeleton name="s">
        <body name="b"><transformation>0 1 0 0 0 0</transformation>
        <inertia><mass>2</mass><offset>0 0 0</offset></inertia>
        <marker name="tip"><offset>0.1 0.2 0.3</offset></marker></body>
        <joint type="free" name="j"><parent>world</parent><child>b</child></joint>
        </skeleton></world></skel>"""
    )
    [marker] = cpp_oracle.ask("markers", path)["skeletons"][0]["markers"]
    assert (marker["name"], marker["body"]) == ("tip", "b")
    np.testing.assert_allclose(marker["world"], [0.1, 1.2, 0.3], rtol=1e-14)


def test_vsk_skeleton(cpp_oracle: CppOracle) -> None:
    skeleton = cpp_oracle.ask("vsk", dart_model(NICK))
    segments = re.findall(r'<Segment NAME="(\w+)"', dart_model(NICK).read_text())
    assert [body["name"] for body in skeleton["bodies"]] == segments
    assert skeleton["bodies"][0]["parent"] is None
    assert skeleton["joints"][0]["type"] == "FreeJoint"
    assert skeleton["mass"] == pytest.approx(sum(body["mass"] for body in skeleton["bodies"]))
    assert skeleton["q"].shape == (len(skeleton["dofs"]),)
    assert np.all(np.linalg.eigvalsh(skeleton["M"]) > 0)


def test_soft_bodies(oracle: DartpyOracle, cpp_oracle: CppOracle) -> None:
    """Local = resting + q, world = T local, and each surface is closed: V - E + F = 2 with E = 3 F / 2."""
    path, steps = dart_model("skel/softBodies.skel"), 300
    rigid = oracle.simulate(path, steps=steps)[steps]
    assert len(rigid.contacts) > 0
    soft = cpp_oracle.ask("soft", path, steps)
    counts = []
    for by_dartpy, by_cpp in zip(rigid.skeletons, soft["skeletons"], strict=True):
        assert by_dartpy["q"].tobytes() == by_cpp["q"].tobytes()
        for body in by_cpp["soft_bodies"]:
            points, faces = len(body["q"]), body["faces"]
            counts.append(points)
            assert points - 3 * len(faces) // 2 + len(faces) == 2
            assert set(faces.ravel()) == set(range(points))
            np.testing.assert_allclose(body["local"], body["resting"] + body["q"], atol=1e-15)
            T = by_dartpy["T"][0]
            np.testing.assert_allclose(body["world"], body["local"] @ T[:3, :3].T + T[:3, 3], atol=1e-14)
            assert body["mass"].sum() == pytest.approx(0.5)  # the file's <total_mass>
    assert counts == [26, 58, 58, 122, 26]
    assert max(np.abs(body["q"]).max() for s in soft["skeletons"] for body in s["soft_bodies"]) > 1e-4


def test_a_blacklisted_pair_does_not_touch(oracle: DartpyOracle, cpp_oracle: CppOracle) -> None:
    path, steps = dart_model(CUBES), 100
    answer = cpp_oracle.ask("filter", path, steps, 0, 0, 1, 0)

    def pairs(which: str) -> set[tuple[int, int]]:
        return {(int(min(a, b)), int(max(a, b))) for a, _, b, _ in answer[which]["bodies"]}

    assert (0, 1) in pairs("allowed")
    assert (0, 1) not in pairs("blacklisted")
    assert (1, 2) in pairs("blacklisted")
    unfiltered = oracle.simulate(path, steps=steps)[steps].contacts
    for field in ("point", "force"):
        np.testing.assert_array_equal(answer["allowed"][field], unfiltered[field])


def test_a_mimic_joint_follows_its_reference(cpp_oracle: CppOracle) -> None:
    """Each step takes the joint to multiplier · reference + offset of the reference before that step."""
    path, steps = dart_model("skel/test/double_pendulum.skel"), 200
    q = cpp_oracle.ask("mimic", path, steps, 0, 1, 0, -0.5, 0.001)["q"]
    assert np.ptp(q[:, 0]) > 0.05
    np.testing.assert_allclose(q[1:, 1], -0.5 * q[:-1, 0] + 0.001, atol=1e-9)


def test_wrong_questions_are_refused(cpp_oracle: CppOracle) -> None:
    path = dart_model(CUBES)
    with pytest.raises(OracleError, match="usage: oracle"):
        cpp_oracle.ask("weather", path)
    with pytest.raises(OracleError, match="no skeleton 9"):
        cpp_oracle.ask("filter", path, 1, 9, 0, 1, 0)
    with pytest.raises(OracleError, match="too few numbers"):
        cpp_oracle.ask("dynamics", path, 1, skeleton_states=[([0.0], [0.0])])
    with pytest.raises(OracleError, match="could not load"):
        cpp_oracle.ask("dynamics", "no_such_file.skel", 1)
