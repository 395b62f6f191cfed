"""The calls of tools/probe_features.py: for each feature and library the least that uses it."""

from __future__ import annotations

URDF = """<robot name="arm">
<link name="base"/>
<link name="upper"><inertial><mass value="1"/><inertia ixx=".1" iyy=".1" izz=".1" ixy="0" ixz="0" iyz="0"/></inertial>
<collision><geometry><box size=".1 .1 .4"/></geometry></collision></link>
<link name="lower"><inertial><mass value="1"/><inertia ixx=".1" iyy=".1" izz=".1" ixy="0" ixz="0" iyz="0"/></inertial>
<collision><geometry><sphere radius=".1"/></geometry></collision></link>
<joint name="shoulder" type="revolute"><parent link="base"/><child link="upper"/><axis xyz="0 1 0"/>
<limit lower="-1" upper="1" effort="9" velocity="9"/></joint>
<joint name="elbow" type="revolute"><parent link="upper"/><child link="lower"/><origin xyz="0 0 .4"/><axis xyz="0 1 0"/>
<limit lower="-1" upper="1" effort="9" velocity="9"/></joint></robot>"""

#: Name → what each of its calls begins with, and an expression for the version; none for what has no package.
LIBRARIES = {
    "pydart2": (
        "import pydart2, numpy as np\nw = pydart2.World(0.001, up='z')\ns = w.add_skeleton(URDF, base='fixed')\n"
        "h = s.body('lower')",
        "pydart2.__version__",
    ),
    "pydart2 0.7": ("", ""),
    "dartpy": (
        "import dartpy, numpy as np\nw = dartpy.simulation.World()\nL = getattr(dartpy.utils, 'DartLoader', None) or "
        "dartpy.io.DartLoader\ns = L().parseSkeleton(PATH)\nw.addSkeleton(s)\nh = s.getBodyNode('lower')",
        "getattr(dartpy, '__version__', None) or '(Debian)'",
    ),
    "MuJoCo": (
        "import mujoco, numpy as np\nm = mujoco.MjModel.from_xml_string(URDF)\nd = mujoco.MjData(m)\n"
        "mujoco.mj_forward(m, d)\nn = m.nv",
        "mujoco.__version__",
    ),
    "PyBullet": (
        "import pybullet as p\nc = p.connect(p.DIRECT)\nr = p.loadURDF(PATH, useFixedBase=True)",
        "importlib.metadata.version('pybullet')",
    ),
    "Drake": (
        "import numpy as np\nfrom pydrake.all import *\nb = DiagramBuilder()\n"
        "P, g = AddMultibodyPlantSceneGraph(b, 0.001)\nParser(P).AddModels(PATH)\n"
        "P.WeldFrames(P.world_frame(), P.GetFrameByName('base'))\nP.Finalize()\nx = P.CreateDefaultContext()\n"
        "h = P.GetFrameByName('lower')",
        "importlib.metadata.version('drake')",
    ),
    "Pinocchio": (
        "import pinocchio as p, numpy as np\nm = p.buildModelFromXML(URDF)\nd = m.createData()\nq = p.neutral(m)\n"
        "v = np.zeros(m.nv)",
        "p.__version__",
    ),
}

#: Feature → library → the call.
FEATURES: dict[str, dict[str, str]] = {
    "mass matrix": {
        "pydart2": "s.M",
        "dartpy": "s.getMassMatrix()",
        "MuJoCo": "M = np.zeros((n, n)); mujoco.mj_fullM(m, d, M)",
        "PyBullet": "p.calculateMassMatrix(r, [0, 0])",
        "Drake": "P.CalcMassMatrix(x)",
        "Pinocchio": "p.crba(m, d, q)",
    },
    "inverse dynamics": {
        "pydart2": "s.inverse_dynamics(np.ones(2))",
        "dartpy": "s.setAccelerations(np.ones(2)); s.computeInverseDynamics()",
        "MuJoCo": "mujoco.mj_inverse(m, d)",
        "PyBullet": "p.calculateInverseDynamics(r, [0, 0], [0, 0], [1, 1])",
        "Drake": "P.CalcInverseDynamics(x, np.ones(2), MultibodyForces(P))",
        "Pinocchio": "p.rnea(m, d, q, v, np.ones(2))",
    },
    "derivatives of forward dynamics": {
        "Drake": "P.ToAutoDiffXd()",
        "pydart2": "s.forward_dynamics_derivatives(np.zeros(2))",
        "Pinocchio": "p.computeABADerivatives(m, d, q, v, np.zeros(2))",
    },
    "derivatives of a step": {
        "pydart2": "w.linearize()",
        "MuJoCo": "mujoco.mjd_transitionFD(m, d, 1e-6, True, np.zeros((2 * n, 2 * n)), None, None, None)",
    },
    "centroidal momentum matrix": {
        "MuJoCo": "mujoco.mj_angmomMat(m, d, np.zeros((3, n)), 1)",
        "pydart2": "s.centroidal_momentum_matrix()",
        "Pinocchio": "p.computeCentroidalMap(m, d, q)",
    },
    "Jacobian of a body": {
        "pydart2": "h.J",
        "dartpy": "h.getLinearJacobian()",
        "MuJoCo": "mujoco.mj_jacBody(m, d, np.zeros((3, n)), None, 1)",
        "PyBullet": "p.calculateJacobian(r, 1, [0, 0, 0], [0, 0], [0, 0], [0, 0])",
        "Drake": "P.CalcJacobianSpatialVelocity(x, JacobianWrtVariable.kV, h, np.zeros(3), P.world_frame(),"
        " P.world_frame())",
        "Pinocchio": "p.computeJointJacobians(m, d, q)",
    },
    "step with contacts": {
        "pydart2": "w.add_ground(); w.step(10)",
        "dartpy": "[w.step() for _ in range(10)]; w.getLastCollisionResult()",
        "MuJoCo": "mujoco.mj_step(m, d); d.contact",
        "PyBullet": "p.stepSimulation(); p.getContactPoints()",
        "Drake": "Simulator(b.Build()).AdvanceTo(0.01)",
    },
    "weld two bodies while it runs": {
        "pydart2": "k = pydart2.constraints.WeldJointConstraint(h); k.add_to_world(w); k.remove()",
        "dartpy": "w.getConstraintSolver().addConstraint(dartpy.constraint.WeldJointConstraint(h))",
        "PyBullet": "p.createConstraint(r, 1, -1, -1, p.JOINT_FIXED, [0, 0, 0], [0, 0, 0], [0, 0, 0])",
    },
    "position targets by stable PD": {"pydart2": "s.set_targets({'elbow': 0.5}, kp=1e4, kd=100.0); w.step()"},
    "position targets": {
        "MuJoCo": "a = mujoco.MjSpec.from_string(URDF)\nb = a.add_actuator(name='a', target='elbow',"
        " trntype=mujoco.mjtTrn.mjTRN_JOINT)\nb.set_to_position(kp=9.0)\na.compile()",
        "dartpy": "s.getJoint(1).setActuatorType(dartpy.dynamics.ActuatorType.SERVO)",
        "Drake": "PidController(np.ones(2), np.ones(2), np.ones(2))",
        "pydart2": "s.set_targets([0.1, 0.1], kp=100.0, kd=1.0); w.step()",
        "PyBullet": "p.setJointMotorControl2(r, 1, p.POSITION_CONTROL, 0.5)",
    },
    "inverse kinematics": {
        "pydart2": "s.inverse_kinematics({'lower': [0.1, 0.0, 0.3]})",
        "dartpy": "h.getOrCreateIK()",
        "PyBullet": "p.calculateInverseKinematics(r, 1, [0.1, 0.0, 0.3])",
        "Drake": "InverseKinematics(P)",
    },
    "one ray": {
        "dartpy": "dartpy.collision.RaycastOption",
        "pydart2": "w.raycast([0, 0, 9], [0, 0, -1])",
        "MuJoCo": "mujoco.mj_ray(m, d, np.array([0, 0, 9.0]), np.array([0, 0, -1.0]), None, 1, -1,"
        " np.zeros(1, np.int32))",
        "PyBullet": "p.rayTest([0, 0, 9], [0, 0, -1])",
    },
    "accelerometer and gyroscope": {
        "pydart2": "from pydart2.sensors import IMU; IMU(h).read()",
        "MuJoCo": "mujoco.mjtSensor.mjSENS_ACCELEROMETER",
        "Drake": "Accelerometer; Gyroscope",
    },
    "lidar with noise and rate": {
        "pydart2": "from pydart2.sensors import Lidar; Lidar(h, Lidar.fan(1.0, 9), noise=0.01, rate=10.0).read()"
    },
    "depth picture without a display": {
        "Drake": "RgbdSensor; MakeRenderEngineVtk(RenderEngineVtkParams())",
        "pydart2": "pydart2.gui.render(w, 32, 24, mode='depth')",
        "MuJoCo": "R = mujoco.Renderer(m, 24, 32); R.enable_depth_rendering(); R.update_scene(d); R.render()",
        "PyBullet": "p.getCameraImage(32, 24)[3]",
    },
    "soft bodies, built in code": {
        "pydart2": "w.add_soft_box([0.1, 0.1, 0.1]); w.step()",
        "MuJoCo": 'mujoco.MjModel.from_xml_string(\'<mujoco><worldbody><flexcomp name="f" type="grid" dim="3"'
        ' count="3 3 3" spacing=".1 .1 .1"/></worldbody></mujoco>\')',
        "PyBullet": "p.loadSoftBody",
        "Drake": "MultibodyPlant(0.001).mutable_deformable_model()",
    },
    "many worlds in one call": {"MuJoCo": "from mujoco import rollout", "pydart2": "pydart2.Batch(w, 4).step(10)"},
    "snapshots": {
        "pydart2": "w.restore(w.snapshot())",
        "dartpy": "s.setPositions(s.getPositions()); s.setVelocities(s.getVelocities())",
        "MuJoCo": "mujoco.mj_getState(m, d, np.zeros(mujoco.mj_stateSize(m, 1)), 1)",
        "PyBullet": "p.restoreState(p.saveState())",
        "Drake": "x.Clone()",
    },
    "pickle of the whole world": {
        "pydart2": "import pickle; pickle.loads(pickle.dumps(w))",
        "dartpy": "import pickle; pickle.loads(pickle.dumps(w))",
        "MuJoCo": "import pickle; pickle.loads(pickle.dumps((m, d)))",
        "Drake": "import pickle; pickle.loads(pickle.dumps(P))",
        "Pinocchio": "import pickle; pickle.loads(pickle.dumps(m))",
    },
    "save as URDF": {"pydart2": "s.save(PATH + '.out.urdf')"},
    "save as MJCF": {"pydart2": "s.to_mjcf()", "MuJoCo": "mujoco.mj_saveLastXML(PATH + '.xml', m)"},
    "sleeping": {
        "PyBullet": "p.URDF_ENABLE_SLEEPING",
        "MuJoCo": "mujoco.mjtEnableBit.mjENBL_SLEEP",
        "pydart2": "w.set_sleeping(); w.step()",
    },
    "recording as arrays": {"pydart2": "w.step(3); w.recording.q(s)"},
}
