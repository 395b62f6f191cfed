"""The calls of tools/probe_features.py: for each feature and library the least that uses it.

A call that begins with ``#`` only looks whether a name is there; None is a library without the feature, by its authors.
Where a library has no call, its public names are searched for the words of the feature.
"""

from __future__ import annotations

_URDF = """<robot name="arm">
<link name="base"/>
<link name="upper"><inertial><mass value="1"/><inertia ixx=".1" iyy=".1" izz=".1" ixy="0" ixz="0" iyz="0"/></inertial>
<collision><geometry><box size=".1 .1 .4"/></geometry></collision></link>
<link name="lower"><inertial><mass value="1"/><inertia ixx=".1" iyy=".1" izz=".1" ixy="0" ixz="0" iyz="0"/></inertial>
<collision><geometry><sphere radius=".1"/></geometry></collision></link>
<joint name="shoulder" type="revolute"><parent link="base"/><child link="upper"/><axis xyz="0 1 0"/>
<limit lower="-1" upper="1" effort="9" velocity="9"/></joint>
<joint name="elbow" type="revolute"><parent link="upper"/><child link="lower"/><origin xyz="0 0 .4"/><axis xyz="0 1 0"/>
<limit lower="-1" upper="1" effort="9" velocity="9"/></joint></robot>"""

_SDF = """<sdf version="1.6"><model name="ball"><link name="ball"><collision name="c"><geometry><sphere>
<radius>0.1</radius></sphere></geometry></collision></link></model></sdf>"""
_MJCF = """<mujoco model="pole"><worldbody><body name="pole"><joint name="j" axis="0 1 0"/>
<geom type="capsule" fromto="0 0 0 0 0 -.5" size=".03"/></body></worldbody></mujoco>"""

_MJCF_BALL = '<mujoco><worldbody><body><joint name="j"/><geom size=".1"/></body></worldbody>{}</mujoco>'
_MJCF_FLEX = (
    '<mujoco><worldbody><flexcomp name="f" type="grid" dim="{}" count="3 3 {}"'
    ' spacing=".1 .1 .1"/></worldbody></mujoco>'
)

#: What the calls may read.
TEXTS = {
    "URDF": _URDF,
    "SDF": _SDF,
    "MJCF": _MJCF,
    "TENDON": _MJCF_BALL.format('<tendon><fixed><joint joint="j" coef="1"/></fixed></tendon>'),
    "MUSCLE": _MJCF_BALL.format('<actuator><muscle joint="j" lengthrange="0 1"/></actuator>'),
    "CLOTH": _MJCF_FLEX.format(2, 1),
    "SOFT": _MJCF_FLEX.format(3, 3),
}

#: Name → what each of its calls begins with, an expression for the version, and the module to search; nothing for
#: what no interpreter here has.
LIBRARIES = {
    "pydart2": (
        "import pydart2, numpy as np\nw = pydart2.World(0.001, up='z')\ns = w.add_skeleton(URDF, base='fixed')\n"
        "h = s.body('lower')",
        "pydart2.__version__",
        "pydart2",
    ),
    "pydart2 0.7": ("", "", ""),
    "dartpy": (
        "import dartpy, numpy as np\nw = dartpy.simulation.World()\nL = getattr(dartpy.utils, 'DartLoader', None) or "
        "dartpy.io.DartLoader\ns = L().parseSkeleton(PATH)\nw.addSkeleton(s)\nh = s.getBodyNode('lower')",
        "getattr(dartpy, '__version__', None) or '(Debian)'",
        "dartpy",
    ),
    "MuJoCo": (
        "import mujoco, numpy as np\nm = mujoco.MjModel.from_xml_string(URDF)\nd = mujoco.MjData(m)\n"
        "mujoco.mj_forward(m, d)\nn = m.nv",
        "mujoco.__version__",
        "mujoco",
    ),
    "PyBullet": (
        "import pybullet as p\nc = p.connect(p.DIRECT)\nr = p.loadURDF(PATH, useFixedBase=True)",
        "importlib.metadata.version('pybullet')",
        "pybullet",
    ),
    "Drake": (
        "import numpy as np\nfrom pydrake.all import *\nb = DiagramBuilder()\n"
        "P, g = AddMultibodyPlantSceneGraph(b, 0.001)\nParser(P).AddModels(PATH)\n"
        "P.WeldFrames(P.world_frame(), P.GetFrameByName('base'))\nP.Finalize()\nx = P.CreateDefaultContext()\n"
        "h = P.GetFrameByName('lower')",
        "importlib.metadata.version('drake')",
        "pydrake.all",
    ),
    "Pinocchio": (
        "import pinocchio as p, numpy as np\nm = p.buildModelFromXML(URDF)\nd = m.createData()\nq = p.neutral(m)\n"
        "v = np.zeros(m.nv)",
        "p.__version__",
        "pinocchio",
    ),
}

#: What other public names would have of it, where no call is known; as a regular expression.
WORDS = {
    "mass matrix": "mass_?matrix",
    "inverse dynamics": "inverse_?dynamics|rnea",
    "derivatives of forward dynamics": "derivatives",
    "derivatives of a step": "transitionFD|linearize|linearise",
    "automatic differentiation": "autodiff|jax|casadi|cppad",
    "symbolic equations of motion": "symbolic|casadi",
    "regressor of the parameters": "regressor",
    "centroidal momentum matrix": "centroidal|angmommat",
    "Jacobian of a body": "jacobian|jacbody",
    "step with contacts": "^step|simulate",
    "soft contacts of chosen stiffness": "contact_?stiffness|solref|compliance",
    "contacts spread over a patch": "hydroelastic",
    "rolling friction": "rolling|condim",
    "round friction cone": "elliptic|cone_?friction",
    "stops fast bodies at thin walls": "ccd|sweep_?sphere|continuous_?collision",
    "weld two bodies while it runs": "weld|fixed_?constraint",
    "four-bar closed by a constraint, energy kept": "rk4|loop_?joint",
    "position targets by stable PD": "stable_?pd|spd",
    "position targets": "position_?control|servo|pid",
    "tendons and pulleys": "tendon",
    "muscles": "muscle",
    "drag of air and water": "fluid|viscosity|propeller|^drag$",
    "inverse kinematics": "inverse_?kinematics|getorcreateik",
    "inverse kinematics that keeps a distance": "minimum_?distance",
    "planning of motions": "planner|trajectory_?optimi[sz]ation|collocation",
    "one ray": "^ray_?(cast|test)|_ray",
    "distance of two bodies": "distance|closest",
    "convex parts of a mesh": "convex_?decomposition|vhacd|coacd",
    "accelerometer and gyroscope": "accelerometer|gyro|^imu",
    "lidar": "lidar|rangefinder",
    "depth picture without a display": "depth_?(image|render)|camera|render",
    "picture of who is seen where": "segmentation|label_?image|mode_?ids",
    "window": "viewer|visuali[sz]|gui",
    "viewer in a browser": "meshcat|meldis|viser|web_?viewer",
    "soft bodies, built in code": "soft|deformable|flex",
    "cloth and ropes of soft material": "cloth|cable|deformable",
    "fluids of particles": "sph_|particle",
    "many worlds in one call": "rollout|batch|monte_?carlo",
    "on a graphics card": "cuda|gpu|mjx|warp",
    "environments for reinforcement learning": "gym|_env",
    "snapshots": "snapshot|save_?state|get_?state$",
    "pickle of the whole world": "pickle",
    "reads URDF": "urdf",
    "reads SDF": "sdf",
    "reads MJCF": "mjcf|from_xml",
    "reads USD": "usd",
    "save as URDF": "save.*urdf|to_?urdf",
    "save as MJCF": "save.*mjcf|to_?mjcf|lastxml",
    "sleeping": "sleeping|deactivation",
    "recording as arrays": "log_?sink|recording|start_?state_?logging",
    "ROS": "ros2?_|rviz|rclpy",
    "types for checkers": "py\\.typed",
}

#: Library → its package, whose wheels are asked for; None without any.
PACKAGES = {
    "pydart2": None,
    "dartpy": "dartpy",
    "MuJoCo": "mujoco",
    "PyBullet": "pybullet",
    "Drake": "drake",
    "Pinocchio": "pin",
}
PLATFORMS = {"a wheel for Windows": "win_amd64", "a wheel for macOS": "macosx_15_0_arm64"}

#: Feature → library → the call.
FEATURES: dict[str, dict[str, str | None]] = {
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
        "pydart2": "s.forward_dynamics_derivatives(np.zeros(2))",
        "Pinocchio": "p.computeABADerivatives(m, d, q, v, np.zeros(2))",
    },
    "derivatives of a step": {
        "Drake": "#Linearize",
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
    "position targets by stable PD": {
        "pydart2": "s.set_targets({'elbow': 0.5}, kp=1e4, kd=100.0); w.step()",
        "PyBullet": "#p.STABLE_PD_CONTROL",
    },
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
        "dartpy": "#dartpy.collision.RaycastOption",
        "pydart2": "w.raycast([0, 0, 9], [0, 0, -1])",
        "MuJoCo": "mujoco.mj_ray(m, d, np.array([0, 0, 9.0]), np.array([0, 0, -1.0]), None, 1, -1,"
        " np.zeros(1, np.int32))",
        "PyBullet": "p.rayTest([0, 0, 9], [0, 0, -1])",
    },
    "accelerometer and gyroscope": {
        "pydart2": "from pydart2.sensors import IMU; IMU(h).read()",
        "MuJoCo": "#mujoco.mjtSensor.mjSENS_ACCELEROMETER",
        "Drake": "#Accelerometer; Gyroscope",
    },
    "lidar": {
        "MuJoCo": "#mujoco.mjtSensor.mjSENS_RANGEFINDER",
        "pydart2": "from pydart2.sensors import Lidar; Lidar(h, Lidar.fan(1.0, 9), noise=0.01, rate=10.0).read()",
    },
    "depth picture without a display": {
        "Drake": "RgbdSensor; MakeRenderEngineVtk(RenderEngineVtkParams())",
        "pydart2": "pydart2.gui.render(w, 32, 24, mode='depth')",
        "MuJoCo": "R = mujoco.Renderer(m, 24, 32); R.enable_depth_rendering(); R.update_scene(d); R.render()",
        "PyBullet": "p.getCameraImage(32, 24)[3]",
    },
    "soft bodies, built in code": {
        "pydart2": "w.add_soft_box([0.1, 0.1, 0.1]); w.step()",
        "MuJoCo": "mujoco.MjModel.from_xml_string(SOFT)",
        "PyBullet": "#p.loadSoftBody",
        "Drake": "MultibodyPlant(0.001).mutable_deformable_model()",
    },
    "many worlds in one call": {
        "Drake": "#MonteCarloSimulation",
        "MuJoCo": "#from mujoco import rollout",
        "pydart2": "pydart2.Batch(w, 4).step(10)",
    },
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
        "dartpy": "#dartpy.simulation.DeactivationOptions",
        "PyBullet": "#p.URDF_ENABLE_SLEEPING",
        "MuJoCo": "#mujoco.mjtEnableBit.mjENBL_SLEEP",
        "pydart2": "w.set_sleeping(); w.step()",
    },
    "recording as arrays": {
        "pydart2": "w.step(3); w.recording.q(s)",
        "PyBullet": "#p.startStateLogging",
        "Drake": "#VectorLogSink",
    },
    "automatic differentiation": {
        "pydart2": None,
        "Drake": "A = P.ToAutoDiffXd(); c = A.CreateDefaultContext(); A.CalcMassMatrix(c)",
        "MuJoCo": "#import mujoco.mjx, jax; jax.grad; mujoco.mjx.step",
        "Pinocchio": "import pinocchio.casadi",
    },
    "symbolic equations of motion": {
        "pydart2": None,
        "Drake": "P.ToSymbolic()",
        "Pinocchio": "import pinocchio.casadi",
    },
    "regressor of the parameters": {
        "pydart2": None,
        "Pinocchio": "p.computeJointTorqueRegressor(m, d, q, v, v)",
    },
    "soft contacts of chosen stiffness": {
        "pydart2": None,
        "MuJoCo": "m.geom_solref[:] = -100.0, -10.0; mujoco.mj_step(m, d)",
        "PyBullet": "p.changeDynamics(r, 1, contactStiffness=1e4, contactDamping=1e2); p.stepSimulation()",
        "Drake": "AddCompliantHydroelasticProperties(0.1, 1e6, ProximityProperties())",
    },
    "contacts spread over a patch": {
        "pydart2": None,
        "Drake": "P2 = MultibodyPlant(0.001); P2.set_contact_model(ContactModel.kHydroelastic)",
    },
    "rolling friction": {
        "pydart2": None,
        "MuJoCo": "m.geom_condim[:] = 6; mujoco.mj_step(m, d)",
        "PyBullet": "p.changeDynamics(r, 1, rollingFriction=0.01); p.stepSimulation()",
    },
    "round friction cone": {
        "pydart2": "w.set_constraint_solver('iterative', friction='cone'); w.step()",
        "MuJoCo": "m.opt.cone = mujoco.mjtCone.mjCONE_ELLIPTIC; mujoco.mj_step(m, d)",
        "Drake": "P2 = MultibodyPlant(0.001); P2.set_discrete_contact_approximation(DiscreteContactApproximation.kSap)",
    },
    "stops fast bodies at thin walls": {
        "pydart2": None,
        "PyBullet": "p.changeDynamics(r, 1, ccdSweptSphereRadius=0.05); p.stepSimulation()",
    },
    "tendons and pulleys": {
        "pydart2": None,
        "MuJoCo": "mujoco.MjModel.from_xml_string(TENDON)",
    },
    "muscles": {
        "pydart2": "from pydart2.muscle import MTU",
        "MuJoCo": "mujoco.MjModel.from_xml_string(MUSCLE)",
    },
    "drag of air and water": {
        "pydart2": None,
        "MuJoCo": "m.opt.density = 1000.0; m.opt.viscosity = 0.001; mujoco.mj_step(m, d)",
        "Drake": "Propeller(P.GetBodyByName('lower').index())",
        "PyBullet": "p.changeDynamics(r, 1, linearDamping=0.1); p.stepSimulation()",
    },
    "inverse kinematics that keeps a distance": {
        "pydart2": None,
        "Drake": "i = InverseKinematics(P, P.GetMyContextFromRoot(b.Build().CreateDefaultContext()));"
        " i.AddMinimumDistanceLowerBoundConstraint(0.01)",
    },
    "planning of motions": {
        "pydart2": None,
        "Drake": "KinematicTrajectoryOptimization(2, 8); DirectCollocation; GcsTrajectoryOptimization(2)",
    },
    "distance of two bodies": {
        "pydart2": "w.add_sphere(0.1, 1.0, [1, 0, 0], name='ball'); w.distance('ball', s)",
        "dartpy": "#dartpy.collision.DistanceOption",
        "MuJoCo": "mujoco.mj_geomDistance(m, d, 0, 1, 9.0, np.zeros(6))",
        "PyBullet": "p.getClosestPoints(r, r, 9.0, 0, 1)",
        "Drake": "X = b.Build(); c = g.GetMyContextFromRoot(X.CreateDefaultContext());"
        " g.get_query_output_port().Eval(c).ComputeSignedDistancePairwiseClosestPoints(9.0)",
        "Pinocchio": "G = p.buildGeomFromUrdf(m, PATH, p.GeometryType.COLLISION); G.addAllCollisionPairs();"
        " p.computeDistances(m, d, G, G.createData(), q)",
    },
    "convex parts of a mesh": {"pydart2": None, "PyBullet": "#p.vhacd"},
    "picture of who is seen where": {
        "pydart2": "pydart2.gui.render(w, 32, 24, mode='segmentation')",
        "MuJoCo": "R = mujoco.Renderer(m, 24, 32); R.enable_segmentation_rendering(); R.update_scene(d); R.render()",
        "PyBullet": "p.getCameraImage(32, 24)[4]",
        "Drake": "#RgbdSensor.label_image_output_port",
    },
    "window": {
        "pydart2": "#pydart2.gui.viewer.launch",
        "dartpy": "#dartpy.gui",
        "MuJoCo": "#import mujoco.viewer; mujoco.viewer.launch",
        "PyBullet": "#p.GUI",
        "Drake": "#ModelVisualizer",
        "Pinocchio": "#import pinocchio.visualize; pinocchio.visualize.GepettoVisualizer",
    },
    "viewer in a browser": {
        "pydart2": None,
        "Drake": "Meshcat()",
        "Pinocchio": "#import pinocchio.visualize; pinocchio.visualize.MeshcatVisualizer",
    },
    "cloth and ropes of soft material": {
        "pydart2": None,
        "MuJoCo": "mujoco.MjModel.from_xml_string(CLOTH)",
        "PyBullet": "p.resetSimulation(p.RESET_USE_DEFORMABLE_WORLD)",
    },
    "fluids of particles": {"pydart2": None},
    "on a graphics card": {"pydart2": None, "MuJoCo": "#import mujoco.mjx; mujoco.mjx.put_model"},
    "environments for reinforcement learning": {
        "pydart2": None,
        "PyBullet": "#importlib.util.find_spec('pybullet_envs').origin",
    },
    "reads URDF": {
        "pydart2": "w.add_skeleton(PATH)",
        "dartpy": "s.getNumDofs()",
        "MuJoCo": "m.nv",
        "PyBullet": "p.loadURDF(PATH)",
        "Drake": "P2 = MultibodyPlant(0.001); Parser(P2).AddModels(PATH)",
        "Pinocchio": "p.buildModelFromUrdf(PATH)",
    },
    "reads SDF": {
        "pydart2": "w.add_skeleton(SDF)",
        "dartpy": "getattr(dartpy.utils, 'SdfParser', None) or dartpy.io.SdfParser",
        "MuJoCo": "mujoco.MjModel.from_xml_string(SDF)",
        "PyBullet": "open(PATH + '.sdf', 'w').write(SDF); p.loadSDF(PATH + '.sdf')",
        "Drake": "P2 = MultibodyPlant(0.001); Parser(P2).AddModelsFromString(SDF, 'sdf')",
        "Pinocchio": "open(PATH + '.sdf', 'w').write(SDF);"
        " p.buildModelFromSdf(PATH + '.sdf', p.StdVec_StdString(), 'm')",
    },
    "reads MJCF": {
        "pydart2": "pydart2.World(0.001, MJCF)",
        "dartpy": "getattr(dartpy.utils, 'MjcfParser', None) or dartpy.io.MjcfParser",
        "MuJoCo": "mujoco.MjModel.from_xml_string(MJCF)",
        "PyBullet": "open(PATH + '.xml', 'w').write(MJCF); p.loadMJCF(PATH + '.xml')",
        "Drake": "P2 = MultibodyPlant(0.001); Parser(P2).AddModelsFromString(MJCF, 'xml')",
        "Pinocchio": "open(PATH + '.xml', 'w').write(MJCF); p.buildModelFromMJCF(PATH + '.xml')",
    },
    "reads USD": {"pydart2": None},
    "ROS": {"pydart2": None, "Pinocchio": "#import pinocchio.visualize; pinocchio.visualize.RVizVisualizer"},
    "types for checkers": {
        "pydart2": "has_types('pydart2')",
        "dartpy": "has_types('dartpy')",
        "MuJoCo": "has_types('mujoco')",
        "PyBullet": "has_types('pybullet')",
        "Drake": "has_types('pydrake')",
        "Pinocchio": "has_types('pinocchio')",
    },
}
