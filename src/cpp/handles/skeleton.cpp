#include "handles/skeleton.hpp"

#include <algorithm>
#include <dart/constraint/ConstraintSolver.hpp>
#include <dart/dynamics/FreeJoint.hpp>

#include "base/checks.hpp"
#include "collision/detector.hpp"
#include "loading/root_joint.hpp"
#include "state/clone.hpp"

namespace pydart2 {

using dart::dynamics::DegreeOfFreedom;
using dart::dynamics::Joint;

namespace {

void copy(const Eigen::VectorXd& values, Output& out)
{
  vector(out, values.size()) = values;
}

} // namespace

SkeletonHandle::SkeletonHandle(WorldRef world, SkeletonRef skeleton)
  : skeleton_(world, skeleton, skeleton->skeleton.get())
{
}

SkeletonHandle::Passes& SkeletonHandle::passes()
{
  auto& skel = std::as_const(*this).skeleton();
  if (!passes_)
    passes_.reset(new Passes{LinkTree(skel), {}, {}});
  return *passes_;
}

void SkeletonHandle::gather(const std::vector<const double*>& places, Output& out) const
{
  skeleton_.get();
  double* value = out.vector(static_cast<long>(places.size()));
  for (const double* place : places)
    *value++ = *place;
}

template <class Read>
void SkeletonHandle::each_dof(Output& out, Read read) const
{
  const auto& dofs = this->dofs();
  double* value = out.vector(static_cast<long>(dofs.size()));
  for (const DegreeOfFreedom* dof : dofs)
    *value++ = read(*dof);
}

const Eigen::VectorXd& SkeletonHandle::per_dof(const VectorIn& values, const char* what)
{
  const auto& dofs = std::as_const(*this).dofs();
  std::string named = what;
  if (values.size + 6 == static_cast<long>(dofs.size()) && dofs.front()->getJoint()->getNumDofs() == 6)
    named += " (the first 6 are of the base, which floats; base=\"fixed\" welds it)";
  check::size(values.size, dofs.size(), named.c_str());
  check::finite(values, what);
  scratch_ = values.eigen();
  return scratch_;
}

int SkeletonHandle::id() const
{
  skeleton_.world->check();
  return skeleton_.world->index_of(skeleton_.skeleton->skeleton);
}

std::string SkeletonHandle::name() const
{
  return skeleton().getName();
}

std::string SkeletonHandle::set_name(const std::string& name)
{
  if (name.find_first_not_of(" \t\r\n") == std::string::npos)
    throw Error(Kind::value, "a skeleton needs a name");
  const auto other = skeleton_.world->world->getSkeleton(name);
  if (other && other != skeleton_.skeleton->skeleton)
    throw Error(Kind::value, "the world has a skeleton '" + name + "' already; names are distinct");
  return skeleton().setName(name);
}

double SkeletonHandle::mass() const
{
  return skeleton().getMass();
}

bool SkeletonHandle::is_mobile() const
{
  return skeleton().isMobile() || skeleton_.skeleton->island != 0;
}

void SkeletonHandle::set_mobile(bool mobile)
{
  skeleton().setMobile(mobile);
}

bool SkeletonHandle::is_asleep() const
{
  skeleton(); // still there
  return skeleton_.skeleton->island != 0;
}

void SkeletonHandle::set_controlled(bool controlled)
{
  skeleton_.get();
  skeleton_.skeleton->controlled = controlled;
}

bool SkeletonHandle::self_collision_check() const
{
  return skeleton().getSelfCollisionCheck();
}

void SkeletonHandle::set_self_collision_check(bool enable)
{
  skeleton().setSelfCollisionCheck(enable);
}

bool SkeletonHandle::adjacent_body_check() const
{
  return skeleton().getAdjacentBodyCheck();
}

void SkeletonHandle::set_adjacent_body_check(bool enable)
{
  skeleton().setAdjacentBodyCheck(enable);
}

int SkeletonHandle::num_bodynodes() const
{
  return static_cast<int>(skeleton().getNumBodyNodes());
}

int SkeletonHandle::num_joints() const
{
  return static_cast<int>(skeleton().getNumJoints());
}

int SkeletonHandle::num_dofs() const
{
  return static_cast<int>(skeleton().getNumDofs());
}

int SkeletonHandle::num_markers() const
{
  return static_cast<int>(skeleton().getNumMarkers());
}

BodyNodeHandle SkeletonHandle::bodynode(long index) const
{
  auto& skel = skeleton();
  auto* body = skel.getBodyNode(check::index(index, skel.getNumBodyNodes(), "bodynode"));
  return {skeleton_.world, skeleton_.skeleton, body};
}

JointHandle SkeletonHandle::joint(long index) const
{
  auto& skel = skeleton();
  auto* joint = skel.getJoint(check::index(index, skel.getNumJoints(), "joint"));
  return {skeleton_.world, skeleton_.skeleton, joint};
}

DofHandle SkeletonHandle::dof(long index) const
{
  auto& skel = skeleton();
  auto* dof = skel.getDof(check::index(index, skel.getNumDofs(), "dof"));
  return {skeleton_.world, skeleton_.skeleton, dof};
}

MarkerHandle SkeletonHandle::marker(long index) const
{
  auto& skel = skeleton();
  auto* marker = skel.getMarker(check::index(index, skel.getNumMarkers(), "marker"));
  return {skeleton_.world, skeleton_.skeleton, marker};
}

DynamicsHandle SkeletonHandle::dynamics() const
{
  return {skeleton_.world, skeleton_.skeleton};
}

InverseKinematicsHandle SkeletonHandle::inverse_kinematics() const
{
  return {skeleton_.world, skeleton_.skeleton};
}

TargetsHandle SkeletonHandle::targets() const
{
  return {skeleton_.world, skeleton_.skeleton};
}

std::vector<std::string> SkeletonHandle::dof_names() const
{
  std::vector<std::string> names;
  for (const auto* dof : dofs())
    names.push_back(dof->getName());
  return names;
}

const DofState& SkeletonHandle::state() const
{
  return skeleton_.skeleton->dofs();
}

void SkeletonHandle::positions(Output& like) const
{
  gather(state().positions, like);
}

void SkeletonHandle::velocities(Output& like) const
{
  gather(state().velocities, like);
}

void SkeletonHandle::accelerations(Output& like) const
{
  gather(state().accelerations, like);
}

void SkeletonHandle::forces(Output& like) const
{
  each_dof(like, [](const DegreeOfFreedom& dof) { return dof.getForce(); });
}

void SkeletonHandle::commands(Output& like) const
{
  each_dof(like, [](const DegreeOfFreedom& dof) { return dof.getCommand(); });
}

void SkeletonHandle::set_positions(const VectorIn& positions)
{
  // Joint by joint; a method of dart::dynamics::Skeleton would make every dof a change of its own.
  const auto& values = per_dof(positions, "positions");
  skeleton_.world->become_numbers(*skeleton_.skeleton);
  const auto& dofs = this->dofs();
  for (std::size_t i = 0; i < dofs.size();) {
    auto& joint = *dofs[i]->getJoint();
    const auto size = joint.getNumDofs();
    if (size == 1)
      joint.setPosition(0, values[static_cast<long>(i)]);
    else {
      auto& of_joint = joint_scratch_[size];
      of_joint = values.segment(static_cast<long>(i), static_cast<long>(size));
      joint.setPositions(of_joint);
    }
    i += size;
  }
}

void SkeletonHandle::set_velocities(const VectorIn& velocities)
{
  skeleton().setVelocities(per_dof(velocities, "velocities"));
}

void SkeletonHandle::set_accelerations(const VectorIn& accelerations)
{
  skeleton().setAccelerations(per_dof(accelerations, "accelerations"));
}

void SkeletonHandle::set_forces(const VectorIn& forces)
{
  if (skeleton_.skeleton->not_numbers)
    return; // nothing moves, and what a controller makes of NaN is NaN
  const auto& values = per_dof(forces, "forces");
  const auto& dofs = skeleton_.get_to_push(!values.isZero(0.0))->getDofs();
  for (std::size_t i = 0; i < dofs.size(); ++i)
    dofs[i]->setForce(values[static_cast<long>(i)]);
}

void SkeletonHandle::set_commands(const VectorIn& commands)
{
  if (skeleton_.skeleton->not_numbers)
    return;
  const auto& values = per_dof(commands, "commands");
  skeleton_.get_to_push(!values.isZero(0.0))->setCommands(values);
}

void SkeletonHandle::states(Output& into) const
{
  double* value = into.vector(2 * static_cast<long>(dofs().size()));
  const auto& from = state();
  for (const auto* places : {&from.positions, &from.velocities})
    for (const double* place : *places)
      *value++ = *place;
}

void SkeletonHandle::set_states(const VectorIn& states)
{
  auto& skel = skeleton();
  check::size(states.size, 2 * dofs().size(), "states [q, dq]");
  check::finite(states, "states");
  skeleton_.world->become_numbers(*skeleton_.skeleton);
  skel.setPositions(states.eigen().head(states.size / 2));
  skel.setVelocities(states.eigen().tail(states.size / 2));
}

void SkeletonHandle::position_differences(const VectorIn& q1, const VectorIn& q2, Output& out) const
{
  auto& skel = skeleton();
  for (const auto* q : {&q1, &q2}) {
    check::size(q->size, dofs().size(), "positions");
    check::finite(*q, "positions");
  }
  copy(skel.getPositionDifferences(q1.eigen(), q2.eigen()), out);
}

void SkeletonHandle::integrate_positions(const VectorIn& q, const VectorIn& velocities, Output& out) const
{
  auto& skel = skeleton();
  for (const auto* numbers : {&q, &velocities}) {
    check::size(numbers->size, dofs().size(), "positions and velocities");
    check::finite(*numbers, "positions and velocities");
  }
  const Eigen::VectorXd before = skel.getPositions(), rates = skel.getVelocities();
  skel.setPositions(q.eigen());
  skel.setVelocities(velocities.eigen());
  skel.integratePositions(1.0);
  copy(skel.getPositions(), out);
  skel.setPositions(before);
  skel.setVelocities(rates);
}

void SkeletonHandle::velocity_differences(const VectorIn& dq1, const VectorIn& dq2, Output& out) const
{
  auto& skel = skeleton();
  for (const auto* dq : {&dq1, &dq2}) {
    check::size(dq->size, dofs().size(), "velocities");
    check::finite(*dq, "velocities");
  }
  copy(skel.getVelocityDifferences(dq1.eigen(), dq2.eigen()), out);
}

void SkeletonHandle::position_lower_limits(Output& out) const
{
  each_dof(out, [](const DegreeOfFreedom& dof) { return dof.getPositionLowerLimit(); });
}

void SkeletonHandle::position_upper_limits(Output& out) const
{
  each_dof(out, [](const DegreeOfFreedom& dof) { return dof.getPositionUpperLimit(); });
}

void SkeletonHandle::force_lower_limits(Output& out) const
{
  each_dof(out, [](const DegreeOfFreedom& dof) { return dof.getForceLowerLimit(); });
}

void SkeletonHandle::force_upper_limits(Output& out) const
{
  each_dof(out, [](const DegreeOfFreedom& dof) { return dof.getForceUpperLimit(); });
}

void SkeletonHandle::mass_matrix(Output& into)
{
  auto& [tree, mass_matrix, bias_forces] = passes();
  const Eigen::MatrixXd& M = mass_matrix.update(tree);
  // M is symmetric, so its columns are its rows.
  double* to = into.matrix(M.rows(), M.cols());
  std::copy(M.data(), M.data() + M.size(), to);
  for (const auto& [dof, inertia] : skeleton_.skeleton->armature)
    to[static_cast<long>(dof->getIndexInSkeleton()) * (M.cols() + 1)] += inertia;
}

void SkeletonHandle::inv_mass_matrix(Output& into) const
{
  const auto& armature = skeleton_.skeleton->armature;
  if (armature.empty()) {
    const Eigen::MatrixXd& inverse = skeleton().getInvMassMatrix();
    matrix(into, inverse.rows(), inverse.cols()) = inverse;
    return;
  }
  Eigen::MatrixXd M = skeleton().getMassMatrix();
  for (const auto& [dof, inertia] : armature)
    M.diagonal()[static_cast<long>(dof->getIndexInSkeleton())] += inertia;
  matrix(into, M.rows(), M.cols()) = M.llt().solve(Eigen::MatrixXd::Identity(M.rows(), M.cols()));
}

void SkeletonHandle::coriolis_and_gravity_forces(Output& into)
{
  auto& [tree, mass_matrix, bias_forces] = passes();
  copy(bias_forces.update(tree), into);
}

void SkeletonHandle::coriolis_forces(Output& out) const
{
  copy(skeleton().getCoriolisForces(), out);
}

void SkeletonHandle::gravity_forces(Output& out) const
{
  copy(skeleton().getGravityForces(), out);
}

void SkeletonHandle::external_forces(Output& out) const
{
  copy(skeleton().getExternalForces(), out);
}

void SkeletonHandle::constraint_forces(Output& into) const
{
  copy(skeleton().getConstraintForces(), into);
}

dart::dynamics::Skeleton& SkeletonHandle::with_mass() const
{
  auto& skeleton = this->skeleton();
  if (skeleton.getMass() == 0) // the engine asserts
    throw Error(Kind::value, "skeleton '" + skeleton.getName() + "' has no mass, so it has no centre of mass");
  return skeleton;
}

void SkeletonHandle::com(Output& into) const
{
  const auto& skel = with_mass();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero(); // as Skeleton::getCOM(), which copies the transform of each body twice
  for (const auto* body : skel.getBodyNodes())
    sum += body->getMass() * (body->getWorldTransform() * body->getLocalCOM());
  vector(into, 3) = sum / skel.getMass();
}

Eigen::Vector3d SkeletonHandle::com_velocity() const
{
  return with_mass().getCOMLinearVelocity();
}

Eigen::Vector3d SkeletonHandle::com_acceleration() const
{
  return with_mass().getCOMLinearAcceleration();
}

Vector6d SkeletonHandle::com_spatial_velocity() const
{
  return with_mass().getCOMSpatialVelocity();
}

double SkeletonHandle::kinetic_energy() const
{
  double energy = skeleton().computeKineticEnergy();
  for (const auto& [dof, inertia] : skeleton_.skeleton->armature)
    energy += inertia * dof->getVelocity() * dof->getVelocity() / 2.0;
  return energy;
}

double SkeletonHandle::potential_energy() const
{
  // The engine takes a body's weight at its origin, not at its centre of mass.
  const auto& skel = skeleton();
  double energy = 0.0;
  for (const auto* body : skel.getBodyNodes()) {
    if (body->asSoftBodyNode() != nullptr)
      energy += body->computePotentialEnergy(skel.getGravity());
    else if (body->getGravityMode())
      energy -= body->getMass() * skel.getGravity().dot(body->getCOM());
    energy += body->getParentJoint()->computePotentialEnergy();
  }
  return energy;
}

void SkeletonHandle::clear_external_forces()
{
  skeleton().clearExternalForces();
}

void SkeletonHandle::clear_impulse()
{
  skeleton().clearConstraintImpulses();
}

void SkeletonHandle::update_fk() const
{
  skeleton().computeForwardKinematics();
}

void SkeletonHandle::check_root_can_change(const char* what) const
{
  if (skeleton().getNumBodyNodes() == 0)
    throw Error(Kind::value, std::string(what) + " needs a skeleton with a body; '" + name() + "' has none");
  check_tree_can_change(what);
}

void SkeletonHandle::check_tree_can_change(const char* what) const
{
  if (skeleton_.skeleton->motors.targets())
    throw Error(
        Kind::value,
        std::string(what) + " cannot change skeleton '" + name() + "' while its dofs have targets; call clear_targets() first");
  for (const auto& record : skeleton_.world->constraints)
    if (record.skeleton1 == skeleton_.skeleton->skeleton || record.skeleton2 == skeleton_.skeleton->skeleton)
      throw Error(
          Kind::value,
          std::string(what) + " cannot change skeleton '" + name()
              + "' while a constraint holds it; call world.remove_all_constraints() first");
}

void SkeletonHandle::forget_root_armature()
{
  auto& joint = *skeleton().getRootJoint();
  for (std::size_t i = 0; i < joint.getNumDofs(); ++i)
    skeleton_.skeleton->armature.erase(joint.getDof(i));
}

void SkeletonHandle::set_root_joint_to_trans_and_euler()
{
  check_root_can_change("set_root_joint_to_trans_and_euler()");
  forget_root_armature();
  change_root_to_trans_and_euler(skeleton());
  tree_changed(RootChange::trans_and_euler);
}

void SkeletonHandle::set_root_joint_to_weld()
{
  check_root_can_change("set_root_joint_to_weld()");
  forget_root_armature();
  change_root_to_weld(skeleton());
  tree_changed(RootChange::weld);
}

void SkeletonHandle::set_root_joint_to_free()
{
  check_root_can_change("set_root_joint_to_free()");
  const Joint& joint = *skeleton().getRootJoint();
  if (joint.getType() == dart::dynamics::FreeJoint::getStaticType())
    return;
  if (joint.getNumDofs() > 0)
    throw Error(
        Kind::value,
        "the root of skeleton '" + name() + "' is on a " + joint.getType() + ", '" + joint.getName()
            + "'; only a root that is fixed can be made free");
  change_root_to_free(skeleton());
  tree_changed(RootChange::free);
}

long SkeletonHandle::integrator_fallbacks() const
{
  skeleton(); // still there
  return skeleton_.skeleton->integrator_fallbacks;
}

void SkeletonHandle::tree_changed(RootChange change)
{
  if (!skeleton_.skeleton->built)
    skeleton_.skeleton->root_changes.push_back(change);
  skeleton_.world->tree_changed(*skeleton_.skeleton);
}

} // namespace pydart2
