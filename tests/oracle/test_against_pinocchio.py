"""Dynamics of robots that others modelled, beside Pinocchio's: `make test-third-party` brings both."""

from __future__ import annotations

import importlib.util
import re
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from pydart2 import Skeleton, World
from pydart2.sensors import IMU, ForceTorque

pytestmark = pytest.mark.third_party
Array = NDArray[np.float64]

#: Robots of example-robot-data.
ROBOTS = [
    "ur_description/urdf/ur5_robot.urdf",
    "panda_description/urdf/panda.urdf",
    "kinova_description/robots/kinova.urdf",
    "z1_description/urdf/z1.urdf",
    "xarm_description/urdf/xarm7.urdf",
    "solo_description/robots/solo12.urdf",
    "anymal_b_simple_description/robots/anymal.urdf",
    "a1_description/urdf/a1.urdf",
    "hyq_description/robots/hyq_no_sensors.urdf",
    "talos_data/robots/talos_reduced.urdf",
    "icub_description/robots/icub.urdf",
    "bolt_description/robots/bolt.urdf",
]
G = [0.0, 0.0, -9.81]


def folder() -> Path:
    """Where example-robot-data keeps its robots."""
    found = importlib.util.find_spec("pinocchio")
    assert found and found.origin, "run `make test-third-party`, which brings Pinocchio and its robots"
    return Path(found.origin).parents[4] / "share" / "example-robot-data" / "robots"


def kinematic_xml(path: Path) -> str:
    """A robot without its shapes."""
    text = re.sub(r"<\?xml.*?\?>", "", path.read_text())
    root = ElementTree.fromstring(re.sub(r"(?<=[\s</])\w+:(?=\w)", "", text))  # prefixes that no file declares
    for link in root.iter("link"):
        for shape in link.findall("visual") + link.findall("collision"):
            link.remove(shape)
    for joint in root.iter("joint"):
        for mimic in joint.findall("mimic"):  # which Pinocchio leaves out
            joint.remove(mimic)
    for part in ("transmission", "gazebo", "sensor"):
        for element in root.findall(part):
            root.remove(element)
    return ElementTree.tostring(root, encoding="unicode").replace(
        '"world"', '"base_of_all"'
    )  # the engine welds "world"


class Pair:
    """One robot in one random state, here and in Pinocchio; `order` takes Pinocchio's velocities to ours."""

    def __init__(self, path: Path, floating: bool) -> None:
        import pinocchio

        self.pin: Any = pinocchio
        xml = kinematic_xml(path)
        root = (pinocchio.JointModelFreeFlyer(),) if floating else ()
        self.model = pinocchio.buildModelFromXML(xml, *root)
        self.data = self.model.createData()
        world = World(0.001)
        world.set_gravity(G)
        self.skel: Skeleton = world.add_skeleton(xml, massless=True)
        if not floating:
            self.skel.set_root_joint_to_weld()
        n = self.skel.ndofs
        assert n == self.model.nv
        self.order = [3, 4, 5, 0, 1, 2] if floating else []
        index = {name: self.model.joints[i].idx_v for i, name in enumerate(self.model.names) if i > 0}
        self.order += [index[dof.name] for dof in self.skel.dofs[len(self.order) :]]
        rng = np.random.default_rng(len(path.name))
        q, self.dq, self.ddq = rng.uniform(-1.0, 1.0, (3, n))
        self.skel.q, self.skel.dq = q, self.dq
        steps = np.zeros(n)
        steps[self.order] = q
        if floating:
            steps[:6] = 0.0
        self.q = pinocchio.integrate(self.model, pinocchio.neutral(self.model), steps)
        if floating:
            self.q[:3] = q[3:6]
            self.q[3:7] = Rotation.from_rotvec(q[:3]).as_quat()
        self.v, self.a = self.theirs(self.dq), self.theirs(self.ddq)

    def theirs(self, vector: Array) -> Array:
        out = np.zeros(len(vector))
        out[self.order] = vector
        return out

    def columns(self, matrix: Array) -> Array:
        """Columns in our order."""
        return np.asarray(matrix)[:, self.order]


@pytest.fixture(params=[(name, floating) for name in ROBOTS for floating in (False, True)], ids=str)
def pair(request: pytest.FixtureRequest) -> Pair:
    name, floating = request.param
    return Pair(folder() / name, floating)


def close(ours: Array, theirs: Array) -> None:
    """Equal to 1e-9 of the largest number."""
    assert_allclose(ours, theirs, rtol=0.0, atol=1e-9 * max(1.0, np.abs(theirs).max()))


def test_terms(pair: Pair) -> None:
    """M, c, gravity, inverse and forward dynamics."""
    pin, skel, model, data = pair.pin, pair.skel, pair.model, pair.data
    M = np.array(pin.crba(model, data, pair.q))
    M = np.triu(M) + np.triu(M, 1).T
    close(skel.M, M[np.ix_(pair.order, pair.order)])
    close(skel.c, pin.nonLinearEffects(model, data, pair.q, pair.v)[pair.order])
    close(skel.gravity_forces(), pin.computeGeneralizedGravity(model, data, pair.q)[pair.order])
    rnea = np.array(pin.rnea(model, data, pair.q, pair.v, pair.a))[pair.order]
    close(skel.inverse_dynamics(pair.ddq, damping=False, springs=False), rnea)
    tau = np.linspace(-2.0, 2.0, skel.ndofs)
    aba = np.array(pin.aba(model, data, pair.q, pair.v, pair.theirs(tau)))[pair.order]
    assert_allclose(skel.forward_dynamics(tau, damping=False, springs=False), aba, rtol=1e-8, atol=1e-8)


def test_derivatives(pair: Pair) -> None:
    pin, skel, model, data = pair.pin, pair.skel, pair.model, pair.data
    theirs = pin.computeRNEADerivatives(model, data, pair.q, pair.v, pair.a)
    for ours, matrix in zip(skel.inverse_dynamics_derivatives(pair.ddq), theirs, strict=True):
        matrix = np.array(matrix)
        if matrix is not theirs[0] and np.allclose(matrix, np.triu(matrix)):  # M
            matrix = np.triu(matrix) + np.triu(matrix, 1).T
        close(ours, matrix[np.ix_(pair.order, pair.order)])
    tau = np.linspace(-2.0, 2.0, skel.ndofs)
    pin.computeABADerivatives(model, data, pair.q, pair.v, pair.theirs(tau))
    ours_forward = skel.forward_dynamics_derivatives(tau)
    for ours, matrix in zip(ours_forward, (data.ddq_dq, data.ddq_dv, data.Minv), strict=True):
        close(ours, np.array(matrix)[np.ix_(pair.order, pair.order)])


def test_centre_of_mass_and_momentum(pair: Pair) -> None:
    """A welded root counts in ours, and not in theirs, so the COM is compared where the root floats."""
    pin, skel, model, data = pair.pin, pair.skel, pair.model, pair.data
    if len(pair.order) > 6 and pair.order[0] == 3:
        close(skel.C, pin.centerOfMass(model, data, pair.q))
        close(skel.com_linear_jacobian(), pair.columns(pin.jacobianCenterOfMass(model, data, pair.q)))
        Ag = np.array(pin.computeCentroidalMap(model, data, pair.q))
        close(skel.centroidal_momentum_matrix(), pair.columns(np.vstack([Ag[3:], Ag[:3]])))
    pin.computeKineticEnergy(model, data, pair.q, pair.v)
    close(np.array([skel.kinetic_energy()]), np.array([data.kinetic_energy]))


def test_jacobians(pair: Pair) -> None:
    """Of each link that a joint moves, world axes, and its pose."""
    pin, skel, model, data = pair.pin, pair.skel, pair.model, pair.data
    pin.computeJointJacobians(model, data, pair.q)
    pin.framesForwardKinematics(model, data, pair.q)
    for body in skel.bodynodes:
        frame = model.getFrameId(body.name, pin.FrameType.BODY)
        close(body.T, data.oMf[frame].homogeneous)
        J = np.array(pin.getFrameJacobian(model, data, frame, pin.LOCAL_WORLD_ALIGNED))
        close(body.world_jacobian(), pair.columns(np.vstack([J[3:], J[:3]])))


def test_accelerometers_and_gyroscopes(pair: Pair) -> None:
    """On each link, in its axes: R.T (a - g), and the angular velocity."""
    pin, skel, model, data = pair.pin, pair.skel, pair.model, pair.data
    skel.ddq = pair.ddq
    pin.forwardKinematics(model, data, pair.q, pair.v, pair.a)
    pin.updateFramePlacements(model, data)
    for body in skel.bodynodes:
        frame = model.getFrameId(body.name, pin.FrameType.BODY)
        a = pin.getFrameClassicalAcceleration(model, data, frame, pin.LOCAL).linear
        gyroscope = pin.getFrameVelocity(model, data, frame, pin.LOCAL).angular
        close(IMU(body).read(), np.concatenate([a - data.oMf[frame].rotation.T @ G, gyroscope]))


def test_force_sensors(pair: Pair) -> None:
    """In each joint that moves, after a step from a random state; Newton and Euler say what it carried."""
    pin, skel, model, data = pair.pin, pair.skel, pair.model, pair.data
    for dof in skel.dofs:  # those of a step are implicit
        dof.set_damping_coefficient(0.0)
        dof.set_coulomb_friction(0.0)
    ddq = skel.forward_dynamics(np.zeros(skel.ndofs))  # after the step a free joint's are in the axes of its new pose
    skel.world.step()
    pin.rnea(model, data, pair.q, pair.v, pair.theirs(ddq))
    for joint in skel.joints:
        if joint.num_dofs() > 0 and model.existJointName(joint.name):
            carried = data.f[model.getJointId(joint.name)]
            close(ForceTorque(joint).read(), np.concatenate([carried.angular, carried.linear]))


def airo_models() -> Path:
    """Where airo-models keeps its robots."""
    found = importlib.util.find_spec("airo_models")
    assert found and found.origin, "airo-models is not installed: pip install airo-models"
    return Path(found.origin).parent


def relative(ours: Array, theirs: Array) -> float:
    """The greatest difference, of the largest number or of 1."""
    return float(np.abs(ours - theirs).max(initial=0.0) / max(1.0, np.abs(theirs).max(initial=0.0)))


def worst_of(pair: Pair) -> float:
    """Of M, c, and each body's pose and Jacobian."""
    pin, skel, model, data = pair.pin, pair.skel, pair.model, pair.data
    M = np.array(pin.crba(model, data, pair.q))
    M = np.triu(M) + np.triu(M, 1).T
    found = [relative(skel.M, M[np.ix_(pair.order, pair.order)])]
    found.append(relative(skel.c, pin.nonLinearEffects(model, data, pair.q, pair.v)[pair.order]))
    pin.computeJointJacobians(model, data, pair.q)
    pin.framesForwardKinematics(model, data, pair.q)
    for body in skel.bodynodes:
        frame = model.getFrameId(body.name, pin.FrameType.BODY)
        found.append(relative(body.T, data.oMf[frame].homogeneous))
        J = np.array(pin.getFrameJacobian(model, data, frame, pin.LOCAL_WORLD_ALIGNED))
        found.append(relative(body.world_jacobian(), pair.columns(np.vstack([J[3:], J[:3]]))))
    return max(found)


def test_every_robot(capsys: Any) -> None:
    """All URDF files of example-robot-data and airo-models that Pinocchio reads and that move, to 1e-12."""
    worst: dict[str, float] = {}
    refused = []
    for path in sorted([*folder().rglob("*.urdf"), *airo_models().rglob("*.urdf")]):
        for floating in (False, True):
            try:
                pair = Pair(path, floating)
            except ValueError as error:
                assert "does not contain a valid URDF model" in str(error), f"{path}: {error}"  # says Pinocchio
                refused.append(path.name)
                continue
            if pair.model.nv > 0:  # Pinocchio's frames have no Jacobian then
                worst[f"{path.name}{' floating' * floating}"] = worst_of(pair)
    with capsys.disabled():
        name = max(worst, key=lambda name: worst[name])
        print(f"\n{len(worst)} robots, at most {worst[name]:.1e} apart ({name}); Pinocchio refuses {set(refused)}")
    assert len(worst) >= 130
    assert {name: difference for name, difference in worst.items() if not difference < 1e-12} == {}
