"""The flat functions, one a line: ``name(parameters) -> result``.

The object that the ids find has a method of the function's own name in snake case without "get", or of the name behind
``=``; with a leading underscore that is a function of `api`. ``: text`` is the docstring where `World`, `Skeleton`
and so on have no method of this name. For a joint, `index` is one of its dofs.
"""

from __future__ import annotations

import re
from typing import NamedTuple

TABLE = """
init(verbose=True) -> None = _init
destroy() -> None = _destroy_all
setVerbose(verbose=True) -> None = _set_verbose
getVerbose() -> bool = _verbose

marker__getBodyNode(wid, skid, mid) -> int = bodynode: Id of the body.
marker__getLocalPosition(wid, skid, mid) -> (3,)
marker__setLocalPosition(wid, skid, mid, position) -> None
marker__getWorldPosition(wid, skid, mid) -> (3,)

collisionresult__getNumContacts(wid) -> int
collisionresult__getContacts(wid, nout) -> (nout,) = _contacts
collisionresult__getCollidingBodyNodes(wid) -> tuple of int = _colliding_bodies
addBallJointConstraint(wid, skid1, bid1, skid2, bid2, position) -> int = _add_ball_joint_constraint

createWorld(timestep) -> int = _create_world
createWorldFromSkel(path) -> int = _create_world_from_skel
destroyWorld(wid) -> None = _destroy_world
world__addSkeleton(wid, path) -> int = _add_skeleton
world__getNumSkeletons(wid) -> int
world__reset(wid) -> None
world__step(wid) -> None = _step
world__checkCollision(wid) -> None
world__setTimeStep(wid, time_step) -> None
world__getTimeStep(wid) -> float
world__setTime(wid, time) -> None
world__getTime(wid) -> float
world__getSimFrames(wid) -> int = frame: Steps since the last reset.
world__getIndex(wid, i) -> int = _index_of_first_dof
world__setGravity(wid, gravity) -> None
world__getGravity(wid) -> (3,)
world__setCollisionDetector(wid, detector_type) -> None = _set_collision_detector
world__getCollisionDetector(wid) -> int = _collision_detector
world__removeAllConstraints(wid) -> None

skeleton__getName(wid, skid) -> str: Name of the skeleton.
skeleton__getMass(wid, skid) -> float
skeleton__isMobile(wid, skid) -> bool
skeleton__setMobile(wid, skid, mobile) -> None
skeleton__getSelfCollisionCheck(wid, skid) -> bool
skeleton__setSelfCollisionCheck(wid, skid, enable) -> None
skeleton__getAdjacentBodyCheck(wid, skid) -> bool
skeleton__setAdjacentBodyCheck(wid, skid, enable) -> None
skeleton__setRootJointToTransAndEuler(wid, skid) -> None
skeleton__setRootJointToWeld(wid, skid) -> None
skeleton__getNumBodyNodes(wid, skid) -> int = num_bodynodes
skeleton__getNumJoints(wid, skid) -> int
skeleton__getNumDofs(wid, skid) -> int
skeleton__getNumMarkers(wid, skid) -> int: How many markers there are.
skeleton__getPositions(wid, skid, ndofs) -> (ndofs,) = _positions
skeleton__setPositions(wid, skid, q) -> None
skeleton__getVelocities(wid, skid, ndofs) -> (ndofs,) = _velocities
skeleton__setVelocities(wid, skid, dq) -> None
skeleton__getAccelerations(wid, skid, ndofs) -> (ndofs,) = _accelerations
skeleton__setForces(wid, skid, tau) -> None
skeleton__getPositionDifferences(wid, skid, q1, q2, ndofs) -> (ndofs,)
skeleton__getVelocityDifferences(wid, skid, dq1, dq2, ndofs) -> (ndofs,)
skeleton__getPositionLowerLimits(wid, skid, ndofs) -> (ndofs,)
skeleton__getPositionUpperLimits(wid, skid, ndofs) -> (ndofs,)
skeleton__getForceLowerLimits(wid, skid, ndofs) -> (ndofs,)
skeleton__getForceUpperLimits(wid, skid, ndofs) -> (ndofs,)
skeleton__getCOM(wid, skid) -> (3,)
skeleton__getCOMLinearVelocity(wid, skid) -> (3,) = com_velocity
skeleton__getCOMLinearAcceleration(wid, skid) -> (3,) = com_acceleration
skeleton__getMassMatrix(wid, skid, out) -> None
skeleton__getCoriolisAndGravityForces(wid, skid, ndofs) -> (ndofs,)
skeleton__getConstraintForces(wid, skid, ndofs) -> (ndofs,)

bodynode__getName(wid, skid, bid) -> str: Name of the body.
bodynode__getParentBodyNode(wid, skid, bid) -> int = parent_bodynode: Id of the parent body, -1 for none.
bodynode__getNumChildBodyNodes(wid, skid, bid) -> int = num_child_bodynodes
bodynode__getChildBodyNode(wid, skid, bid, i) -> int = child_bodynode: Id of a body that hangs from it.
bodynode__getParentJoint(wid, skid, bid) -> int: Id of the joint to its parent.
bodynode__getNumChildJoints(wid, skid, bid) -> int
bodynode__getChildJoint(wid, skid, bid, i) -> int: Id of a joint that hangs from it.
bodynode__getNumDependentDofs(wid, skid, bid) -> int
bodynode__getDependentDof(wid, skid, bid, i) -> int: Id of a dof that moves it.
bodynode__getNumShapeNodes(wid, skid, bid) -> int = num_shapenodes
bodynode__getIndexInSkeleton(wid, skid, bid) -> int
bodynode__getIndexInTree(wid, skid, bid) -> int
bodynode__getTreeIndex(wid, skid, bid) -> int
bodynode__setGravityMode(wid, skid, bid, gravity_mode) -> None
bodynode__getGravityMode(wid, skid, bid) -> bool
bodynode__isCollidable(wid, skid, bid) -> bool
bodynode__setCollidable(wid, skid, bid, is_collidable) -> None
bodynode__getMass(wid, skid, bid) -> float
bodynode__setMass(wid, skid, bid, mass) -> None
bodynode__getInertia(wid, skid, bid) -> (3, 3)
bodynode__setInertia(wid, skid, bid, inertia) -> None
bodynode__getLocalCOM(wid, skid, bid) -> (3,)
bodynode__getCOM(wid, skid, bid) -> (3,)
bodynode__getCOMLinearVelocity(wid, skid, bid) -> (3,)
bodynode__getCOMSpatialVelocity(wid, skid, bid) -> (6,)
bodynode__getCOMLinearAcceleration(wid, skid, bid) -> (3,)
bodynode__getCOMSpatialAcceleration(wid, skid, bid) -> (6,)
bodynode__setFrictionCoeff(wid, skid, bid, coeff) -> None
bodynode__getFrictionCoeff(wid, skid, bid) -> float
bodynode__setRestitutionCoeff(wid, skid, bid, coeff) -> None
bodynode__getRestitutionCoeff(wid, skid, bid) -> float
bodynode__getTransform(wid, skid, bid) -> (4, 4)
bodynode__getWorldTransform(wid, skid, bid) -> (4, 4) = transform
bodynode__getRelativeTransform(wid, skid, bid) -> (4, 4)
bodynode__addExtForce(wid, skid, bid, force, offset, is_force_local, is_offset_local) -> None
bodynode__setExtForce(wid, skid, bid, force, offset, is_force_local, is_offset_local) -> None
bodynode__addExtTorque(wid, skid, bid, torque, is_local) -> None
bodynode__setExtTorque(wid, skid, bid, torque, is_local) -> None
bodynode__getJacobian(wid, skid, bid, offset, out) -> None
bodynode__getLinearJacobian(wid, skid, bid, offset, out) -> None
bodynode__getAngularJacobian(wid, skid, bid, out) -> None
bodynode__getWorldJacobian(wid, skid, bid, offset, out) -> None
bodynode__getLinearJacobianDeriv(wid, skid, bid, offset, out) -> None
bodynode__getAngularJacobianDeriv(wid, skid, bid, out) -> None

dof__getName(wid, skid, dofid) -> str: Name of the dof.
dof__getIndexInSkeleton(wid, skid, dofid) -> int
dof__getIndexInTree(wid, skid, dofid) -> int
dof__getIndexInJoint(wid, skid, dofid) -> int
dof__getTreeIndex(wid, skid, dofid) -> int
dof__getPosition(wid, skid, dofid) -> float
dof__setPosition(wid, skid, dofid, position) -> None
dof__getInitialPosition(wid, skid, dofid) -> float
dof__setInitialPosition(wid, skid, dofid, position) -> None
dof__hasPositionLimit(wid, skid, dofid) -> bool
dof__getPositionLowerLimit(wid, skid, dofid) -> float
dof__setPositionLowerLimit(wid, skid, dofid, limit) -> None
dof__getPositionUpperLimit(wid, skid, dofid) -> float
dof__setPositionUpperLimit(wid, skid, dofid, limit) -> None
dof__getVelocity(wid, skid, dofid) -> float
dof__setVelocity(wid, skid, dofid, velocity) -> None
dof__getInitialVelocity(wid, skid, dofid) -> float
dof__setInitialVelocity(wid, skid, dofid, velocity) -> None
dof__getVelocityLowerLimit(wid, skid, dofid) -> float
dof__setVelocityLowerLimit(wid, skid, dofid, limit) -> None
dof__getVelocityUpperLimit(wid, skid, dofid) -> float
dof__setVelocityUpperLimit(wid, skid, dofid, limit) -> None
dof__getSpringStiffness(wid, skid, dofid) -> float
dof__setSpringStiffness(wid, skid, dofid, stiffness) -> None
dof__getRestPosition(wid, skid, dofid) -> float
dof__setRestPosition(wid, skid, dofid, position) -> None
dof__getDampingCoefficient(wid, skid, dofid) -> float
dof__setDampingCoefficient(wid, skid, dofid, coefficient) -> None
dof__getCoulombFriction(wid, skid, dofid) -> float
dof__setCoulombFriction(wid, skid, dofid, friction) -> None
dof__getConstraintImpulse(wid, skid, dofid) -> float
dof__setConstraintImpulse(wid, skid, dofid, impulse) -> None

joint__getName(wid, skid, jid) -> str: Name of the joint.
joint__setName(wid, skid, jid, name, rename_dofs) -> str
joint__isKinematic(wid, skid, jid) -> bool
joint__isDynamic(wid, skid, jid) -> bool
joint__getType(wid, skid, jid) -> str
joint__setActuatorType(wid, skid, jid, actuator_type) -> None = _set_actuator_type
joint__getActuatorType(wid, skid, jid) -> int = _actuator_type
joint__getParentBodyNode(wid, skid, jid) -> int = parent_bodynode: Id of the parent body, -1 for the world.
joint__getChildBodyNode(wid, skid, jid) -> int = child_bodynode: Id of the child body.
joint__setTransformFromParentBodyNode(wid, skid, jid, transform) -> None
joint__setTransformFromChildBodyNode(wid, skid, jid, transform) -> None
joint__getTransformFromParentBodyNode(wid, skid, jid) -> (4, 4)
joint__getTransformFromChildBodyNode(wid, skid, jid) -> (4, 4)
joint__setPositionLimitEnforced(wid, skid, jid, is_position_limit_enforced) -> None
joint__isPositionLimitEnforced(wid, skid, jid) -> bool
joint__getDof(wid, skid, jid, i) -> int: Id of its dof `i`.
joint__getNumDofs(wid, skid, jid) -> int
joint__hasPositionLimit(wid, skid, jid, index) -> bool
joint__getPositionLowerLimit(wid, skid, jid, index) -> float
joint__setPositionLowerLimit(wid, skid, jid, index, position) -> None
joint__getPositionUpperLimit(wid, skid, jid, index) -> float
joint__setPositionUpperLimit(wid, skid, jid, index, position) -> None
joint__getSpringStiffness(wid, skid, jid, index) -> float
joint__setSpringStiffness(wid, skid, jid, index, stiffness) -> None
joint__getRestPosition(wid, skid, jid, index) -> float
joint__setRestPosition(wid, skid, jid, index, position) -> None
joint__getDampingCoefficient(wid, skid, jid, index) -> float
joint__setDampingCoefficient(wid, skid, jid, index, coefficient) -> None
joint__getCoulombFriction(wid, skid, jid, index) -> float
joint__setCoulombFriction(wid, skid, jid, index, friction) -> None

revolute_joint__getAxis(wid, skid, jid) -> (3,)
revolute_joint__setAxis(wid, skid, jid, axis) -> None
prismatic_joint__getAxis(wid, skid, jid) -> (3,)
prismatic_joint__setAxis(wid, skid, jid, axis) -> None
universal_joint__getAxis1(wid, skid, jid) -> (3,)
universal_joint__setAxis1(wid, skid, jid, axis) -> None
universal_joint__getAxis2(wid, skid, jid) -> (3,)
universal_joint__setAxis2(wid, skid, jid, axis) -> None
euler_joint__getAxisOrder(wid, skid, jid) -> str
euler_joint__setAxisOrder(wid, skid, jid, axisorder) -> None

shapenode__getOffset(wid, skid, bid, sid) -> (3,)
shapenode__setOffset(wid, skid, bid, sid, offset) -> None
shapenode__getRelativeTransform(wid, skid, bid, sid) -> (4, 4)
shapenode__setRelativeTransform(wid, skid, bid, sid, transform) -> None
shapenode__hasVisualAspect(wid, skid, bid, sid) -> bool
shapenode__hasCollisionAspect(wid, skid, bid, sid) -> bool
shapenode__getVisualAspectRGBA(wid, skid, bid, sid) -> (4,) = rgba: Colour, 0 to 1.
shapenode__setVisualAspectRGBA(wid, skid, bid, sid, rgba) -> None = set_rgba: Set the colour, shape (4,), 0 to 1.

shape__getVolume(wid, skid, bid, sid) -> float
shape__getType(wid, skid, bid, sid) -> str
shape__getTypeID(wid, skid, bid, sid) -> int = _shape_type_id
shape__getBoundingBoxMin(wid, skid, bid, sid) -> (3,): Lowest corner, m, in the shape's frame.
shape__getBoundingBoxMax(wid, skid, bid, sid) -> (3,): Highest corner, m, in the shape's frame.
sphere_shape__getRadius(wid, skid, bid, sid) -> float
sphere_shape__setRadius(wid, skid, bid, sid, radius) -> None
box_shape__getSize(wid, skid, bid, sid) -> (3,)
box_shape__setSize(wid, skid, bid, sid, size) -> None
ellipsoid_shape__getSize(wid, skid, bid, sid) -> (3,)
ellipsoid_shape__setSize(wid, skid, bid, sid, size) -> None
cylindershape__getRadius(wid, skid, bid, sid) -> float
cylindershape__setRadius(wid, skid, bid, sid, radius) -> None
cylindershape__getHeight(wid, skid, bid, sid) -> float
cylindershape__setHeight(wid, skid, bid, sid, height) -> None
capsuleshape__getRadius(wid, skid, bid, sid) -> float
capsuleshape__setRadius(wid, skid, bid, sid, radius) -> None
capsuleshape__getHeight(wid, skid, bid, sid) -> float
capsuleshape__setHeight(wid, skid, bid, sid, height) -> None
coneshape__getRadius(wid, skid, bid, sid) -> float
coneshape__setRadius(wid, skid, bid, sid, radius) -> None
coneshape__getHeight(wid, skid, bid, sid) -> float
coneshape__setHeight(wid, skid, bid, sid, height) -> None
planeshape__getNormal(wid, skid, bid, sid) -> (3,)
planeshape__setNormal(wid, skid, bid, sid, normal) -> None
planeshape__getOffset(wid, skid, bid, sid) -> float
planeshape__setOffset(wid, skid, bid, sid, offset) -> None
multisphereshape__addSphere(wid, skid, bid, sid, sphere) -> None = _add_sphere
multisphereshape__getSpheres(wid, skid, bid, sid, nout) -> (nout,): Radius and centre of each sphere, m.
multisphereshape__getNumSpheres(wid, skid, bid, sid) -> int
mesh_shape__getScale(wid, skid, bid, sid) -> (3,)
mesh_shape__getMeshPath(wid, skid, bid, sid) -> str = path
"""


class Row(NamedTuple):
    """A line of the table; what it leaves out is None."""

    name: str
    parameters: str
    result: str
    method: str | None
    doc: str | None


_ROW = re.compile(r"(\w+)\((.*?)\) -> (.+?)(?: = (\w+))?(?:: (.+))?")
ROWS = [Row(*found.groups()) for line in TABLE.splitlines() if (found := _ROW.fullmatch(line))]
